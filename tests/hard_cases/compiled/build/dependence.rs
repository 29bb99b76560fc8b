//! Determines the inputs that the components of a function depend on, from its expression graph.

use bgdyn_codegen::expr::{Leaf, Node};
use bgdyn_codegen::function::Function;

/// Largest number of inputs of each kind.
const MOST: usize = 24;

/// Returns the bit of an input in a mask: positions from 0, velocities from 24, accelerations or a scene's
/// first-order states from 48, inputs (efforts) from 72, 127 for all others. A mechanism has no
/// first-order states, and a scene's derivative has no accelerations as arguments. Components beyond 24
/// share the last bit.
fn bit(leaf: Leaf) -> u128 {
    let place = |from: usize, i: usize| if i < MOST { 1 << (from + i) } else { 1 << 127 };
    match leaf {
        Leaf::Position(i) => place(0, i),
        Leaf::Velocity(i) => place(MOST, i),
        Leaf::Acceleration(i) | Leaf::State(i) => place(2 * MOST, i),
        Leaf::Input(i) => place(3 * MOST, i),
        Leaf::Mode(_) | Leaf::Parameter(_) | Leaf::Time | Leaf::BlockResult { .. } => 1 << 127,
    }
}

/// Returns, for each result of a function without loops over columns, the mask of its inputs.
pub(crate) fn masks(function: &Function) -> Vec<u128> {
    assert!(
        function.loops.is_none(),
        "{}: its blocks are not all of it",
        function.name()
    );
    let mut passed: Vec<Vec<u128>> = vec![];
    for block in &function.blocks {
        // Operands precede their users.
        let mut of_nodes = vec![0_u128; function.graph.len()];
        for i in 0..of_nodes.len() {
            let id = bgdyn_codegen::expr::NodeId::at(i);
            let node = function.graph.node(id);
            let mut mask = match node {
                Node::Leaf(Leaf::BlockResult { block, index }) => {
                    // Results of a later block are not read here.
                    passed.get(*block).map_or(0, |results| results[*index])
                }
                Node::Leaf(leaf) => bit(*leaf),
                _ => 0,
            };
            node.for_each_operand(|operand| mask |= of_nodes[operand.index()]);
            of_nodes[i] = mask;
        }
        let results = block.outputs.iter().map(|e| of_nodes[e.node.index()]);
        passed.push(results.collect());
    }
    passed.pop().expect("at least one block")
}

/// Returns the masks as a list in Rust.
pub(crate) fn text(function: &Function) -> String {
    let masks = masks(function);
    let masks: Vec<String> = masks.iter().map(|mask| format!("{mask:#x}")).collect();
    format!("&[{}]", masks.join(", "))
}
