//! Tapes of random functions.

use bgdyn_codegen::engine::{CallArguments, Engine, Status};
use bgdyn_codegen::expr::{Builder, Leaf};
use bgdyn_codegen::tape::Tape;

use super::agreement::{KINDS, Seen};
use super::common::rng::Rng;
use super::compare;
use super::random_functions::{function, outputs, random};

#[test]
fn tapes_of_random_functions_have_the_bits_of_the_evaluator() {
    let mut seen = Seen::default();
    for seed in 0..300 {
        let function = random(&mut Rng::new(seed));
        compare(&format!("seed {seed}"), &function, None, &mut seen);
    }
    println!("{seen:?}");
    seen.assert_has(&KINDS);
    assert!(seen.refused > 500 && seen.refused < seen.calls, "{seen:?}");
    assert!(seen.finite > seen.calls / 4, "{seen:?}");
}

/// The second pivot is ready long before the first one, and both are refused.
#[test]
fn the_first_refused_pivot_is_reported() {
    let b = Builder::new();
    let q = b.leaf(Leaf::Position(0));
    let mut late = q;
    for _ in 0..20 {
        late = (late * late + q).tanh();
    }
    let first = (-(late * late)).pivot(b.zero(), 5);
    let second = (-(q * q)).pivot(b.zero(), 3);
    let found = outputs(&[first, second]);
    let tape = Tape.prepare(&function(b.into_graph(), vec![found], None));
    let at = CallArguments {
        q: &[0.4],
        ..CallArguments::default()
    };
    assert_eq!(tape.value(&at).1, Status::Refused(5));
}
