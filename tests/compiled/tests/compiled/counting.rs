//! Checks that a method executes the operations stated in its module, and counted by the generator.

use compiled::State;

use crate::agreement::generated;
use crate::counted::{Counted, executed};

impl crate::tested::Tested for Counted {
    const WIDTH: usize = 1;
    fn pack(numbers: &[f64]) -> Self {
        Counted(numbers[0])
    }
    fn numbers(self) -> Vec<f64> {
        vec![self.0]
    }
}

#[test]
fn executed_operations_are_those_stated() {
    let mut counted = 0;
    for compiled in compiled::all::<Counted>() {
        let model = generated(&*compiled);
        let origin = compiled.origin();
        let some = |scale: f64| {
            let number = |j: usize| Counted(scale + j as f64);
            (0..model.mechanism.nv()).map(number).collect()
        };
        let state = State {
            q: some(0.3),
            v: some(-1.1),
            a: some(2.7),
            tau: some(0.9),
        };
        assert_eq!(model.functions.len(), origin.operations.len());
        for (number, function) in model.functions.iter().enumerate() {
            let (method, stated) = origin.operations[number];
            let executed = executed(|| compiled.run(number, &state));
            assert_eq!(executed, stated, "{}, {method}", origin.name);
            let generated = (function.name(), function.operations());
            assert_eq!(generated, (method, stated), "{}", origin.name);
            counted += 1;
        }
    }
    assert!(counted > 300, "{counted}");
}
