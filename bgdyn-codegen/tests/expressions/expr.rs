//! Tests the expression graph: folding, sharing of nodes, counting.

use bgdyn_codegen::expr::{Builder, Expr, Graph, Leaf, Node, Operations, Signed, count, reachable};
use bgdyn_runtime::Dd;

/// Three arguments of a graph.
fn xyz(g: &mut Graph) -> [Signed; 3] {
    [0, 1, 2].map(|k| g.leaf(Leaf::Position(k)))
}

fn number(g: &mut Graph, x: f64) -> Signed {
    g.constant(Dd::from_f64(x))
}

fn minus(e: Signed) -> Signed {
    Signed {
        negative: !e.negative,
        ..e
    }
}

fn operations(mul: usize, add: usize) -> Operations {
    Operations {
        mul,
        add,
        ..Operations::default()
    }
}

#[test]
fn nothing_and_one_fold_away() {
    let mut g = Graph::default();
    let [x, ..] = xyz(&mut g);
    let (zero, one) = (number(&mut g, 0.0), number(&mut g, 1.0));
    let before = g.len();
    assert_eq!(g.mul(x, zero), zero);
    assert_eq!(g.mul(zero, minus(x)).node, zero.node);
    assert_eq!(g.mul(one, x), x);
    assert_eq!(g.mul(x, minus(one)), minus(x));
    assert_eq!(g.add(x, zero), x);
    assert_eq!(g.add(zero, minus(x)), minus(x));
    assert_eq!(g.div(x, one), x);
    assert_eq!(g.div(zero, x), zero);
    assert_eq!(g.len(), before, "folding makes no node");
    assert_eq!(number(&mut g, -0.0).node, zero.node);
    let (two, three) = (number(&mut g, 2.0), number(&mut g, 3.0));
    let six = g.mul(two, minus(three));
    assert_eq!(g.constant_of(six), Some(Dd::from_f64(-6.0)));
    let five = g.add(two, three);
    assert_eq!(g.constant_of(five), Some(Dd::from_f64(5.0)));
}

#[test]
fn constant_factors_merge() {
    let mut g = Graph::default();
    let [x, ..] = xyz(&mut g);
    let (two, three) = (number(&mut g, 2.0), number(&mut g, 3.0));
    let six = number(&mut g, 6.0);
    let twice = g.mul(two, x);
    let outer = g.mul(minus(three), twice);
    let whole = g.mul(six, x);
    assert_eq!(outer, minus(whole));
    assert_eq!(count(&g, &[outer]), operations(1, 0));
    // Cancelled by its inverse.
    let half = number(&mut g, 0.5);
    assert_eq!(g.mul(half, twice), x);
    // Division by a constant is a product.
    let quotient = g.div(x, minus(two));
    let halved = g.mul(half, x);
    assert_eq!(quotient, minus(halved));
}

#[test]
fn equal_terms_merge() {
    let mut g = Graph::default();
    let [x, y, _] = xyz(&mut g);
    let (two, three, five) = (
        number(&mut g, 2.0),
        number(&mut g, 3.0),
        number(&mut g, 5.0),
    );
    let gone = g.add(x, minus(x));
    assert_eq!(g.constant_of(gone), Some(Dd::ZERO));
    let (twice, thrice, fivefold) = (g.mul(two, x), g.mul(three, x), g.mul(five, x));
    assert_eq!(g.add(twice, thrice), fivefold);
    assert_eq!(g.add(twice, minus(thrice)), minus(x));
    assert_eq!(g.add(x, x), twice);
    let gone = g.add(twice, minus(twice));
    assert_eq!(g.constant_of(gone), Some(Dd::ZERO));
    // The rounding error of (1/3 + 1/3 + 1/3) − 1 in double-double counts as zero.
    let third = g.constant(Dd::ONE / Dd::from_f64(3.0));
    let (mut sum, minus_one) = (g.mul(third, y), number(&mut g, -1.0));
    for _ in 0..2 {
        let part = g.mul(third, y);
        sum = g.add(sum, part);
    }
    let whole = g.mul(minus_one, y);
    let gone = g.add(sum, whole);
    assert_eq!(g.constant_of(gone), Some(Dd::ZERO));
}

#[test]
fn constant_terms_merge() {
    let mut g = Graph::default();
    let [x, ..] = xyz(&mut g);
    let (two, three, five) = (
        number(&mut g, 2.0),
        number(&mut g, 3.0),
        number(&mut g, 5.0),
    );
    let inner = g.add(x, two);
    let outer = g.add(three, inner);
    assert_eq!(outer, g.add(x, five));
    assert_eq!(g.add(inner, minus(two)), x);
    let turned = g.add(minus(inner), two);
    assert_eq!(turned, minus(x));
    assert_eq!(count(&g, &[outer]), operations(0, 1));
}

#[test]
fn one_node_for_both_signs_and_orders() {
    let mut g = Graph::default();
    let [x, y, z] = xyz(&mut g);
    let ahead = g.add(x, minus(y));
    let back = g.add(y, minus(x));
    assert_eq!(ahead.node, back.node);
    assert_eq!(ahead, minus(back));
    assert_eq!(g.add(minus(x), y), back);
    let (sum, other) = (g.add(x, y), g.add(minus(y), minus(x)));
    assert_eq!(sum, minus(other));
    assert_ne!(sum.node, ahead.node);
    assert_eq!(g.mul(x, y), g.mul(y, x));
    assert_eq!(g.mul(minus(x), y), minus(g.mul(x, y)));
    assert_eq!(g.mul(minus(x), minus(z)), g.mul(z, x));
    assert_eq!(g.div(minus(x), y), minus(g.div(x, y)));
    // Odd and even functions.
    assert_eq!(g.sin(minus(x)), minus(g.sin(x)));
    assert_eq!(g.cos(minus(x)), g.cos(x));
    assert_eq!(g.tanh(minus(x)), minus(g.tanh(x)));
    assert_eq!(g.sign(minus(x)), minus(g.sign(x)));
    assert_eq!(g.abs(minus(x)), g.abs(x));
    assert_ne!(g.exp(minus(x)).node, g.exp(x).node);
    assert_eq!(g.min(x, y), g.min(y, x));
    assert_eq!(g.max(x, y), g.max(y, x));
    assert_eq!(g.min(x, x), x);
    let condition = g.less(x, y);
    assert_eq!(g.select(condition, z, z), z);
}

#[test]
fn sums_of_angles() {
    let mut g = Graph::default();
    let [x, y, z] = xyz(&mut g);
    let zero = Dd::ZERO;
    // The order does not matter, opposite angles cancel, a single angle is not a sum.
    let sum = g.angle(&[x, y, z], zero);
    assert_eq!(sum, g.angle(&[z, x, y], zero));
    assert_eq!(g.angle(&[x, y, minus(x)], zero), y);
    assert_eq!(g.angle(&[minus(x)], zero), minus(x));
    let none = g.angle(&[x, minus(x)], Dd::PI);
    assert_eq!(g.constant_of(none), Some(Dd::PI));
    // A sum and its opposite are one node with a sign; so cosines are shared.
    let (ahead, back) = (g.angle(&[x, minus(y)], zero), g.angle(&[y, minus(x)], zero));
    assert_eq!(ahead, minus(back));
    assert_eq!(g.cos(ahead), g.cos(back));
    let offset = g.angle(&[x], Dd::ONE);
    let opposite = g.angle(&[minus(x)], -Dd::ONE);
    assert_eq!(offset, minus(opposite));
    assert_ne!(offset.node, g.angle(&[x], -Dd::ONE).node);
    // Twice the same angle is not simplified.
    let twice = g.angle(&[x, x], zero);
    assert!(matches!(g.node(twice.node), Node::Angle(terms, ..) if terms.len() == 2));
}

#[test]
fn constants_pass_through_functions() {
    let mut g = Graph::default();
    let (two, quarter) = (number(&mut g, 2.0), g.constant(Dd::FRAC_PI_2));
    let folded = [
        (g.sin(quarter), 1.0),
        (g.sqrt(two), std::f64::consts::SQRT_2),
        (g.exp(two), 2.0_f64.exp()),
        (g.ln(two), std::f64::consts::LN_2),
        (g.tanh(minus(two)), -(2.0_f64.tanh())),
        (g.sign(minus(two)), -1.0),
        (g.abs(minus(two)), 2.0),
        (g.min(two, quarter), std::f64::consts::FRAC_PI_2),
        (g.max(two, quarter), 2.0),
    ];
    for (e, x) in folded {
        let value = g.constant_of(e).expect("a constant");
        assert!((value.to_f64() - x).abs() < 1e-15, "{value:?} against {x}");
    }
    // A pivot that is a positive constant without subtraction needs no check.
    let zero = number(&mut g, 0.0);
    assert_eq!(g.pivot(two, zero, 0), two);
    assert_ne!(g.pivot(zero, zero, 0), zero);
    assert_ne!(g.pivot(two, two, 0), two);
}

#[test]
fn counting() {
    let b = Builder::new();
    let [x, y, z] = [0, 1, 2].map(|k| b.leaf(Leaf::Velocity(k)));
    let counted = |outputs: &[Expr<'_>]| {
        let outputs: Vec<Signed> = outputs.iter().map(|e| e.signed()).collect();
        b.with_graph(|g| count(g, &outputs))
    };
    // A distinct product counts once, signs and arguments are free, unread nodes do not count.
    let dead = (x + z) * (y + z);
    assert!(!dead.is_zero());
    assert_eq!(counted(&[x, -y]), operations(0, 0));
    assert_eq!(counted(&[x * y, -(y * x), x * y + z]), operations(1, 1));
    assert_eq!(counted(&[x - y, y - x]), operations(0, 1));
    // A constant times a variable counts, ±1 does not.
    let two = b.number(2.0);
    assert_eq!(counted(&[two * x, b.number(-1.0) * y]), operations(1, 0));
    assert_eq!(counted(&[two * b.number(3.0) + two]), operations(0, 0));
    // Sine and cosine of one angle are a pair, the sums of angles inside are part of it.
    let (cos, sin) = b.cos_sin(&[x, y], Dd::ONE);
    let (_, other) = b.cos_sin(&[x, -y], Dd::ZERO);
    let sines = counted(&[cos * sin, other]);
    assert_eq!((sines.sincos, sines.mul, sines.add), (2, 1, 0));
    // Divisions and roots apart, the rest is `other`.
    let all = counted(&[(x / y).sqrt(), z.pivot(y, 0)]);
    assert_eq!((all.div, all.sqrt, all.other, all.total()), (1, 1, 1, 0));
}

#[test]
fn other_operations() {
    let mut g = Graph::default();
    let [x, y, z] = xyz(&mut g);
    let fused = g.mul_add(x, minus(y), z);
    assert_eq!(count(&g, &[fused]), operations(1, 1));
    let condition = g.less(x, y);
    let outputs = [
        g.select(condition, x, z),
        g.min(x, y),
        g.max(x, y),
        g.abs(x),
        g.sign(x),
        g.tanh(x),
        g.exp(x),
        g.ln(x),
    ];
    // The comparison inside the selection is one more.
    assert_eq!(count(&g, &outputs).other, outputs.len() + 1);
    let needed = reachable(&g, &outputs[..2]);
    assert!(!needed.is_empty() && needed.iter().filter(|n| **n).count() == 6);
}

#[test]
fn operands_stand_before_their_users() {
    let mut g = Graph::default();
    let [x, y, z] = xyz(&mut g);
    let condition = g.less(x, y);
    let chosen = g.select(condition, z, x);
    let angle = g.angle(&[chosen, y], Dd::ONE);
    let (sin, cos) = (g.sin(angle), g.cos(angle));
    let product = g.mul_add(sin, cos, z);
    let last = g.pivot(product, x, 0);
    let needed = reachable(&g, &[last]);
    assert_eq!(needed.len(), g.len());
    let mut ids = vec![last.node];
    while let Some(id) = ids.pop() {
        g.node(id).for_each_operand(|operand| {
            assert!(operand < id);
            ids.push(operand);
        });
    }
}
