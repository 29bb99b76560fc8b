//! Calls of prepared functions by several threads, and what is refused.

use std::path::Path;

use bgdyn_codegen::engine::{CallArguments, Callable, Engine, Status};
use bgdyn_codegen::expr::{Builder, Expr, Inputs, Leaf};
use bgdyn_codegen::function::{Block, Function};
use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::selection;
use bgdyn_jit::{Jit, MOST_INSTRUCTIONS, OftenCalled, Refusal};

fn scara() -> Mechanism {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs/scara.yaml");
    let text = std::fs::read_to_string(path).expect("a spec");
    bgdyn_codegen::read(&text, Some("scara")).0.expect("sound")
}

fn function(mechanism: &Mechanism, method: Method) -> Function {
    selection::function(mechanism, method, &Options::default()).expect("every formulation knows it")
}

fn jit() -> Jit {
    Jit::new().expect("machine code on this machine")
}

/// Returns a function of q₀ and q₁ with one result.
fn small(of: impl for<'g> Fn(&'g Builder, Expr<'g>, Expr<'g>) -> Expr<'g>) -> Function {
    let b = Builder::new();
    let [x, y] = [0, 1].map(|i| b.leaf(Leaf::Position(i)));
    let outputs = vec![of(&b, x, y).signed()];
    let mut function = function(&scara(), Method::Gravity);
    function.graph = b.into_graph();
    function.loops = None;
    function.blocks = vec![Block {
        outputs,
        products: vec![],
    }];
    function
}

#[test]
fn calls_from_several_threads_do_not_disturb_each_other() {
    let mechanism = scara();
    let methods = [
        Method::InverseDynamics,
        Method::MassMatrix,
        Method::ForwardDynamics,
    ];
    let functions = methods.map(|method| function(&mechanism, method));
    let prepared = functions.each_ref().map(|f| jit().prepare(f));
    std::thread::scope(|scope| {
        for thread in 0..4 {
            let (functions, prepared) = (&functions, &prepared);
            scope.spawn(move || {
                let mut random = Random(thread);
                let mut four = || (0..4).map(|_| 3.0 * random.signed()).collect::<Vec<f64>>();
                for (function, prepared) in functions.iter().zip(prepared).cycle().take(600) {
                    let at = Inputs {
                        q: four(),
                        v: four(),
                        a: four(),
                        u: four(),
                        ..Inputs::default()
                    };
                    let (wanted, _) = function.evaluate(at.clone());
                    assert_eq!(prepared.value(&(&at).into()).0, wanted, "{}", function.name);
                }
            });
        }
    });
}

/// A thread can prepare what another one calls and drops.
#[test]
fn functions_move_between_threads() {
    let function = small(|b, x, y| (x * y).exp() + b.number(1.0));
    let prepared = std::thread::spawn(move || jit().prepare(&function));
    let prepared = prepared.join().expect("no panic");
    let at = CallArguments {
        q: &[0.5, 2.0],
        ..CallArguments::default()
    };
    assert_eq!(
        prepared.value(&at).0,
        [bgdyn_runtime::Scalar::exp(1.0_f64) + 1.0]
    );
}

#[test]
#[should_panic(expected = "1 of 2 arguments")]
fn an_array_that_is_too_short_is_found_before_the_call() {
    let code = jit()
        .compile(&small(|_, x, y| x + y))
        .expect("machine code");
    let at = CallArguments {
        q: &[0.5],
        ..CallArguments::default()
    };
    code.value(&at);
}

#[test]
#[should_panic(expected = "the number of results")]
fn results_of_another_number_are_found_before_the_call() {
    let code = jit()
        .compile(&small(|_, x, y| x + y))
        .expect("machine code");
    let at = CallArguments {
        q: &[0.5, 0.5],
        ..CallArguments::default()
    };
    code.call(&at, &mut [0.0; 2]);
}

/// What is too large is left to the tape, which says so.
#[test]
fn a_large_function_is_left_to_the_tape() {
    let large = small(|b, x, y| {
        let mut sum = x;
        for k in 0..=MOST_INSTRUCTIONS {
            sum = sum * y + b.number(1.0 / (k + 1) as f64);
        }
        sum
    });
    let jit = jit();
    let refusal = jit.compile(&large).expect_err("it is too large");
    assert!(matches!(refusal, Refusal::TooLarge { .. }), "{refusal}");
    assert!(
        refusal.to_string().contains("are more than 50000"),
        "{refusal}"
    );
    let prepared = jit.prepare(&large);
    assert_eq!(prepared.engine(), "tape");
    let at = Inputs {
        q: vec![0.5, 0.25],
        ..Inputs::default()
    };
    assert_eq!(prepared.value(&(&at).into()).0, large.evaluate(at).0);
}

/// A comparison by bits finds a constant that is off by its last digit, and an exchanged operation.
#[test]
fn a_small_difference_is_found() {
    let x = 0.1_f64;
    let right = small(|b, q, p| q * b.number(x) - p);
    let wrong = [
        small(|b, q, p| q * b.number(x.next_up()) - p),
        small(|b, q, p| p - q * b.number(x)),
    ];
    let at = Inputs {
        q: vec![1.0, 0.09],
        ..Inputs::default()
    };
    let value = |f: &Function| jit().prepare(f).value(&(&at).into()).0[0].to_bits();
    let wanted = right.evaluate(at.clone()).0[0].to_bits();
    assert_eq!(value(&right), wanted);
    for wrong in &wrong {
        assert_ne!(value(wrong), wanted);
    }
}

/// The tape computes the first calls, machine code the others, with the same bits; threads may come at the same time.
#[test]
fn what_is_called_often_becomes_machine_code() {
    let function = function(&scara(), Method::InverseDynamics);
    let at = Inputs {
        q: vec![0.1, -2.0, 0.3, 7.0],
        v: vec![1.0, 2.0, -3.0, 4.0],
        a: vec![-4.0, 3.0, 2.0, 1.0],
        ..Inputs::default()
    };
    let (expected, _) = function.evaluate(at.clone());
    let engine = OftenCalled::after(100, jit());
    let prepared = engine.prepare(&function);
    let call = || {
        let (values, status) = prepared.value(&CallArguments::from(&at));
        assert_eq!(status, Status::Done);
        assert!(
            values
                .iter()
                .zip(&expected)
                .all(|(x, y)| x.to_bits() == y.to_bits())
        );
    };
    (0..100).for_each(|_| call());
    assert_eq!(prepared.engine(), "tape");
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| (0..50).for_each(|_| call()));
        }
    });
    assert_eq!(prepared.engine(), "machine code");
}
