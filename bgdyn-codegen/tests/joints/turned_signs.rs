//! The generator's check refuses each function in which the sign of one output is turned.

use bgdyn_codegen::model::Model;
use bgdyn_codegen::verify::check_functions;

/// Turns the sign of each output that is no constant.
pub fn assert_turned_signs_are_refused(name: &str, model: &Model) {
    for function in &model.functions {
        for k in 0..function.blocks[0].outputs.len() {
            let mut wrong = function.clone();
            let output = &mut wrong.blocks[0].outputs[k];
            if wrong.graph.constant_of(*output).is_some() {
                continue;
            }
            output.negative = !output.negative;
            let found = check_functions(name, &model.bond_graph, &[wrong]);
            assert_eq!(found.len(), 1, "{} output {k}", function.name);
        }
    }
}
