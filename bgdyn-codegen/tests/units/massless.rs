//! Links without mass in the bond graph.

use bgdyn_codegen::bond_graph;
use bgdyn_codegen::mechanism::LinkId;

#[test]
fn links_fixed_beyond_a_joint_are_links_of_their_own() {
    let text = "format: 1\nlinks:\n  - { name: a, joint: { name: turn, type: revolute, axis: z } }\n  - { name: b, parent: a, joint: { type: fixed, origin: { xyz: [1, 0, 0] } }, mass: 1 }\n";
    let (mechanism, _) = bgdyn_codegen::read(text, Some("arm"));
    let graph = bond_graph::build(&mechanism.expect("a sound spec"));
    assert_eq!(graph.without_inertia(), []);
    assert_eq!(graph.frames[LinkId(1).0].coordinate, None);
}
