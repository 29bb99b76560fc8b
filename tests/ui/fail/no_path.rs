//! The path is a literal.

bgdyn::bgdyn!(good_arm);

fn main() {}
