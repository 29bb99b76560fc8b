//! The mechanism's name is not the file's; the module is called after the file.

bgdyn::bgdyn!("other_name.yaml");

fn main() {
    println!("{}", other_name::NV);
}
