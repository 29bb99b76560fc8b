//! Tests the evaluator and the tangent of every kind of node: `f64` against double-double, derivatives
//! against differences in double-double, refused pivots.

use bgdyn_codegen::expr::{Graph, Inputs, Leaf, Signed, Tangent, evaluate};
use bgdyn_runtime::{Dd, Scalar};

/// A function of two arguments, each kind of node by its name.
type Make = fn(&mut Graph, Signed, Signed) -> Signed;

const KINDS: [(&str, Make); 26] = [
    ("constant", |g, _, _| g.constant(Dd::from_f64(1.5))),
    ("leaf", |_, x, _| x),
    ("add", |g, x, y| g.add(x, y)),
    ("subtract", |g, x, y| g.add(minus(x), y)),
    ("mul", |g, x, y| g.mul(x, y)),
    ("mul by itself", |g, x, _| g.mul(x, x)),
    ("div", |g, x, y| g.div(x, y)),
    ("mul_add", |g, x, y| g.mul_add(x, y, x)),
    ("mul_add, flipped", |g, x, y| {
        g.mul_add(minus(x), y, minus(y))
    }),
    ("sqrt", |g, x, y| {
        let square = g.mul(x, x);
        let positive = g.add(square, minus(y));
        g.sqrt(positive)
    }),
    ("sin", |g, x, _| g.sin(x)),
    ("cos", |g, _, y| g.cos(y)),
    ("sin of a sum", |g, x, y| {
        let angle = g.angle(&[x, minus(y)], Dd::ONE);
        g.sin(angle)
    }),
    ("cos of a flipped sum", |g, x, y| {
        let angle = g.angle(&[minus(y), minus(x), minus(x)], -Dd::PI);
        g.cos(angle)
    }),
    ("sin of a value", |g, x, y| {
        let product = g.mul(x, y);
        g.sin(minus(product))
    }),
    ("exp", |g, x, _| g.exp(minus(x))),
    ("ln", |g, _, y| g.ln(minus(y))),
    ("tanh", |g, x, _| g.tanh(x)),
    ("abs", |g, _, y| g.abs(y)),
    ("min", |g, x, y| g.min(x, y)),
    ("max", |g, x, y| g.max(minus(x), y)),
    ("sign", |g, _, y| g.sign(y)),
    ("select, true", |g, x, y| {
        let condition = g.less(y, x);
        let square = g.mul(x, y);
        g.select(condition, minus(square), x)
    }),
    ("select, false", |g, x, y| {
        let condition = g.less(x, y);
        let square = g.mul(x, y);
        g.select(condition, x, square)
    }),
    ("pivot", |g, x, y| {
        let square = g.mul(x, x);
        g.pivot(square, y, 3)
    }),
    ("a mixture", |g, x, y| {
        let (sin, half) = (g.sin(x), g.constant(Dd::from_f64(0.5)));
        let quotient = g.div(sin, y);
        let root = g.exp(quotient);
        let scaled = g.mul(half, root);
        g.add(scaled, minus(x))
    }),
];

fn minus(e: Signed) -> Signed {
    Signed {
        negative: !e.negative,
        ..e
    }
}

/// x in q, y in v: both kinds of leaf.
fn graph(make: Make) -> (Graph, Signed) {
    let mut g = Graph::default();
    let (x, y) = (g.leaf(Leaf::Position(0)), g.leaf(Leaf::Velocity(0)));
    let e = make(&mut g, x, y);
    (g, e)
}

fn at<T: Scalar<Refused = Option<usize>>>(g: &Graph, e: Signed, x: T, y: T) -> T {
    let inputs = Inputs {
        q: vec![x],
        v: vec![y],
        a: vec![],
        x: vec![],
        u: vec![],
        modes: vec![],
        parameters: vec![],
        t: None,
        passed: vec![],
    };
    let mut refused = None;
    let value = evaluate(g, &[e], &inputs, &mut refused)[0];
    assert_eq!(refused, None);
    value
}

/// Arguments of the tests: x > 0 > y, x² > y.
const POINTS: [(f64, f64); 3] = [(0.75, -1.25), (2.5, -0.3), (0.1, -3.0)];

#[test]
fn every_kind_in_f64_and_double_double() {
    for (name, make) in KINDS {
        let (g, e) = graph(make);
        for (x, y) in POINTS {
            let rough = at(&g, e, x, y);
            let fine = at(&g, e, Dd::from_f64(x), Dd::from_f64(y));
            let off = (fine - Dd::from_f64(rough)).abs().to_f64();
            let size = fine.abs().to_f64().max(1.0);
            assert!(
                off <= 1e-15 * size,
                "{name} at {x}, {y}: {rough}, off by {off:e}"
            );
        }
    }
}

/// Checks the values themselves, not only that scalars agree.
#[test]
fn known_values() {
    let value = |name: &str| {
        let (_, make) = KINDS.iter().find(|(n, _)| *n == name).expect("a kind");
        let (g, e) = graph(*make);
        at(&g, e, 0.75, -1.25)
    };
    for (name, expected) in [
        ("constant", 1.5),
        ("add", -0.5),
        ("subtract", -2.0),
        ("mul", -0.9375),
        ("div", -0.6),
        ("mul_add", -0.1875),
        ("mul_add, flipped", 2.1875),
        ("sqrt", 1.8125_f64.sqrt()),
        ("sin of a sum", 3.0_f64.sin()),
        ("cos of a flipped sum", -(0.25_f64.cos())),
        ("sin of a value", 0.9375_f64.sin()),
        ("exp", (-0.75_f64).exp()),
        ("ln", 1.25_f64.ln()),
        ("abs", 1.25),
        ("min", -1.25),
        ("max", -0.75),
        ("sign", -1.0),
        ("select, true", 0.9375),
        ("select, false", -0.9375),
        ("pivot", 0.5625),
    ] {
        let found = value(name);
        assert!(
            (found - expected).abs() < 2e-16 * 4.0,
            "{name}: {found}, not {expected}"
        );
    }
}

/// The tangent against the central difference, step 1e-10 in double-double: h² is 1e-20, rounding
/// 1e-32 / 1e-10.
#[test]
fn derivative_of_every_kind() {
    let step = Dd::from_f64(1e-10);
    for (name, make) in KINDS {
        let (mut g, e) = graph(make);
        let seed = |g: &mut Graph, leaf| {
            let rate = if leaf == Leaf::Position(0) { 1.0 } else { -0.5 };
            Some(g.constant(Dd::from_f64(rate)))
        };
        let tangent = Tangent::new(seed).of(&mut g, e);
        for (x, y) in POINTS {
            let (x, y) = (Dd::from_f64(x), Dd::from_f64(y));
            let half = step * Dd::from_f64(0.5);
            let (ahead, back) = (at(&g, e, x + step, y - half), at(&g, e, x - step, y + half));
            let slope = (ahead - back) / (step + step);
            let found = at(&g, tangent, x, y);
            let off = (found - slope).abs().to_f64();
            let size = slope.abs().to_f64().max(1.0);
            let place = format!("{name} at {}, {}", x.to_f64(), y.to_f64());
            assert!(
                off <= 1e-17 * size,
                "{place}: {} against {}",
                found.to_f64(),
                slope.to_f64()
            );
        }
    }
}

/// Leaves without a tangent have zero rates.
#[test]
fn leaves_without_a_rate() {
    let (mut g, e) = graph(|g, x, y| g.mul(x, y));
    let only_x = |g: &mut Graph, leaf| match leaf {
        Leaf::Position(_) => Some(g.constant(Dd::ONE)),
        _ => None,
    };
    let slope = Tangent::new(only_x).of(&mut g, e);
    let y = g.leaf(Leaf::Velocity(0));
    assert_eq!(slope, y);
}

#[test]
fn pivots() {
    let (g, e) = graph(|g, x, y| g.pivot(x, y, 5));
    let check = |x: f64, magnitude: f64| {
        let mut refused = None;
        let inputs = Inputs {
            q: vec![x],
            v: vec![magnitude],
            ..Inputs::default()
        };
        let value = evaluate(&g, &[e], &inputs, &mut refused)[0];
        (value, refused)
    };
    // A small pivot is accepted if it exceeds the rounding of the subtracted terms.
    assert_eq!(check(0.5, 1.0), (0.5, None));
    assert_eq!(check(2.0_f64.powi(-100), 0.0), (2.0_f64.powi(-100), None));
    assert_eq!(check(2e-14, 1.0), (2e-14, None));
    // Zero, negative, below rounding, NaN: the value is returned unchanged, with the joint's index.
    for (x, magnitude) in [
        (0.0, 0.0),
        (-1.0, 1.0),
        (1e-14, 1.0),
        (f64::NAN, 1.0),
        (1.0, f64::NAN),
        (f64::INFINITY, 1.0),
    ] {
        let (value, refused) = check(x, magnitude);
        assert_eq!(
            (value.to_bits(), refused),
            (x.to_bits(), Some(5)),
            "{x}, {magnitude}"
        );
    }
}

/// The first refusal is not overwritten.
#[test]
fn the_first_refused_joint_is_named() {
    let mut g = Graph::default();
    let (x, y) = (g.leaf(Leaf::Position(0)), g.leaf(Leaf::Velocity(0)));
    let pivots = [g.pivot(x, y, 4), g.pivot(y, x, 2)];
    let mut refused = f64::none_refused();
    let inputs = Inputs {
        q: vec![0.0_f64],
        v: vec![0.0],
        ..Inputs::default()
    };
    let values = evaluate(&g, &pivots, &inputs, &mut refused);
    assert_eq!((values, refused), (vec![0.0, 0.0], Some(4)));
}

/// NaN and infinity are not lost in operations.
#[test]
fn what_is_not_a_number_stays_so() {
    for (name, make) in KINDS {
        if ["constant", "sign", "select, true", "select, false", "pivot"].contains(&name) {
            continue; // by their meaning
        }
        let (g, e) = graph(make);
        let value = at(&g, e, f64::NAN, f64::NAN);
        assert!(value.is_nan(), "{name}: {value}");
    }
}
