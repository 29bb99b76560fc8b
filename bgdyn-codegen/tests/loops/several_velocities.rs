//! Loops through spherical, planar and floating joints against the open tree with multipliers.

use bgdyn_codegen::random::Random;

use super::multipliers::compare;
use super::random_loops::Text;

#[test]
fn loops_through_balls_planes_and_free_bodies_move_as_with_multipliers() {
    for (seed, (kind, joints)) in [
        ("point", &[(2, "spherical")][..]),
        ("hinge", &[(2, "spherical")]),
        ("slider", &[(6, "spherical")]),
        ("weld", &[(1, "planar")]),
        ("universal", &[(8, "spherical"), (3, "planar")]),
        ("hinge", &[(7, "floating")]),
        ("weld", &[(4, "spherical"), (6, "spherical")]),
    ]
    .into_iter()
    .enumerate()
    {
        for root in ["fixed", "floating"] {
            let mut random = Random(2000 + seed as u64);
            let mut text = Text::of_type(&mut random, root, kind);
            for &(number, joint) in joints {
                text = text.with_joint(number, joint);
            }
            compare(&text, &format!("{kind}, {joints:?}, {root}"));
        }
    }
}
