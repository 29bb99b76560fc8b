//! The file's name cannot name a module.

bgdyn::bgdyn!("2-Arms.yaml");

fn main() {}
