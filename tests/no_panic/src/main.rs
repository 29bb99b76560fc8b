//! Links only if no generated function and no helper that it calls can panic: each is called in a function
//! of `no-panic`, whose unwinding would need a symbol that does not exist.
#![forbid(unsafe_code)]

mod helpers;

// Every method of every model.
include!(concat!(env!("OUT_DIR"), "/models.rs"));

fn main() {
    let (models, helpers) = (all(), helpers::all());
    println!("{models} generated functions and {helpers} helpers cannot panic");
}
