//! The table of the loads that are statically undetermined: those of the four-bar linkage, and none where all loads are
//! determined.

use std::process::Command;

use crate::c_program::{build, compilers, write};
use crate::same_bits::{files, model, selected};

/// A planar loop of revolute joints leaves out the force along the axes, and two moments across them.
#[test]
fn loads_along_the_axes_of_a_planar_loop() {
    let path = "specs/loops/four_bar.yaml";
    let files = files(&model(path, &selected(&["reactions"])), &[]);
    let main = "#include <stdio.h>
#include \"four_bar.h\"

int main(void)
{
    for (int k = 0; k < FOUR_BAR_NS; ++k) {
        const struct four_bar_undetermined *load = &four_bar_undetermined_loads[k];
        printf(\"%s %s\", four_bar_reaction_names[load->reaction], load->row);
        for (int i = 0; i < 3; ++i) {
            printf(\" %.1f\", load->force[i]);
        }
        for (int i = 0; i < 3; ++i) {
            printf(\" %.1f\", load->moment[i]);
        }
        printf(\"\\n\");
    }
    return 0;
}
";
    for compiler in compilers() {
        let folder = write(&format!("undetermined_{compiler}"), &files);
        let program = build(&compiler, &folder, "four_bar", main, &[]);
        let output = Command::new(program).output().expect("the program runs");
        let text = String::from_utf8(output.stdout).expect("text");
        assert_eq!(text, EXPECTED, "{compiler}");
    }
}

const EXPECTED: &str = "rocker_pin rocker_pin z 0.0 0.0 1.0 0.0 0.0 0.0
rocker_pin rocker_pin tilt x 0.0 0.0 0.0 1.0 0.0 0.0
rocker_pin rocker_pin tilt y 0.0 0.0 0.0 0.0 1.0 0.0
";

/// Without functions that return loads, and where rows determine all of them.
#[test]
fn no_table_where_there_is_nothing_to_say() {
    for (path, methods) in [
        ("specs/loops/four_bar.yaml", ["gravity"]),
        ("specs/loops/stewart_platform.yaml", ["reactions"]),
        ("specs/scara.yaml", ["gravity"]),
    ] {
        for file in files(&model(path, &selected(&methods)), &[]) {
            assert!(!file.text.contains("undetermined"), "{}", file.name);
        }
    }
}
