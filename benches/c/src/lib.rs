//! Generated functions of the timed arms, in Rust and in C.

/// The Rust modules.
pub mod models {
    include!(concat!(env!("OUT_DIR"), "/models.rs"));
}

/// The C functions, compiled by gcc and by clang.
#[allow(unsafe_code)] // Calls of C: the header has these arguments and results, arrays of these sizes.
pub mod c {
    include!(concat!(env!("OUT_DIR"), "/c.rs"));
}
