//! Operation counts of the robots in README's table, exact: a change of any of them is seen here.

mod common;

use bgdyn_codegen::method::Method;
use bgdyn_codegen::model::{self, Options};
use common::golden;

/// Multiplications and additions.
type Counts = (usize, usize);

/// Inverse dynamics, mass matrix, forward dynamics.
const COUNTS: [(&str, [Counts; 3]); 7] = [
    ("scara_rrpr", [(29, 24), (9, 10), (42, 34)]),
    ("stanford_gen", [(195, 178), (86, 79), (345, 296)]),
    ("puma_gen", [(218, 199), (119, 104), (389, 332)]),
    ("puma_arm", [(148, 118), (71, 53), (258, 196)]),
    ("ur5_gen", [(204, 183), (96, 87), (335, 285)]),
    ("panda_gen", [(269, 245), (152, 143), (527, 473)]),
    ("iiwa_gen", [(256, 228), (133, 120), (495, 431)]),
];

#[test]
fn counts_of_the_seven_robots() {
    let methods = [
        Method::InverseDynamics,
        Method::MassMatrix,
        Method::ForwardDynamics,
    ];
    for (name, expected) in COUNTS {
        let robot = golden::robot(name);
        let counts = methods.map(|method| {
            let made = model::function(&robot.mechanism, method, &Options::default());
            let operations = made.expect("a function").operations();
            (operations.mul, operations.add)
        });
        assert_eq!(counts, expected, "{name}");
    }
}
