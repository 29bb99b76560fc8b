//! Tests the weighted cost: its terms, and the choices by it.

use crate::common::{Robot, golden};
use bgdyn_codegen::expr::{Builder, Cost, Graph, Leaf, Signed, cost};
use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

/// x·y + z, with another value that is not used.
fn product_and_sum(g: &mut Graph) -> (Signed, Signed) {
    let [x, y, z] = [0, 1, 2].map(|k| g.leaf(Leaf::Position(k)));
    let product = g.mul(x, y);
    g.add(y, z);
    (product, g.add(product, z))
}

fn parts(cost: &Cost) -> (usize, usize, usize, usize) {
    let o = &cost.operations;
    (o.mul, o.add, cost.fusable, cost.depth)
}

#[test]
fn a_product_that_one_sum_reads_can_be_fused() {
    let mut g = Graph::default();
    let (product, sum) = product_and_sum(&mut g);
    let once = cost(&g, &[sum]);
    assert_eq!(parts(&once), (1, 1, 1, 2));
    let twice = cost(&g, &[sum, product]);
    assert_eq!(parts(&twice), (1, 1, 0, 2));
    assert!(once.weighted() < twice.weighted());
}

#[test]
fn a_sum_takes_one_product_with_it() {
    let mut g = Graph::default();
    let (product, _) = product_and_sum(&mut g);
    let (w, half) = (g.leaf(Leaf::Velocity(0)), g.constant(Dd::from_f64(0.5)));
    let other = g.mul(w, half);
    let sum = g.add(product, other);
    assert_eq!(parts(&cost(&g, &[sum])), (2, 1, 1, 2));
}

#[test]
fn a_tree_of_sums_costs_less_than_a_chain() {
    let b = Builder::new();
    let x: Vec<_> = (0..8).map(|k| b.leaf(Leaf::Velocity(k))).collect();
    let chain = x[1..].iter().fold(x[0], |sum, &y| sum + y).signed();
    let pairs: Vec<_> = x.chunks(2).map(|p| p[0] + p[1]).collect();
    let tree = ((pairs[0] + pairs[1]) + (pairs[2] + pairs[3])).signed();
    let graph = b.into_graph();
    let (chain, tree) = (cost(&graph, &[chain]), cost(&graph, &[tree]));
    assert_eq!(parts(&chain), (0, 7, 0, 7));
    assert_eq!(parts(&tree), (0, 7, 0, 3));
    assert!(tree.weighted() < chain.weighted());
}

#[test]
fn an_operation_outweighs_what_decides_between_equals() {
    // One more addition costs more than fusing one saves.
    let mut g = Graph::default();
    let [x, y, z, w] = [0, 1, 2, 3].map(|k| g.leaf(Leaf::Position(k)));
    let (a, b) = (g.mul(x, y), g.mul(z, w));
    let sum = g.add(a, b);
    let (one, more) = (g.mul(a, b), g.add(sum, x));
    let one = cost(&g, &[one]);
    let more = cost(&g, &[more]);
    assert_eq!(one.operations.total() + 1, more.operations.total());
    assert!(one.weighted() < more.weighted());
}

#[test]
fn a_pair_of_sine_and_cosine_counts_once() {
    let mut g = Graph::default();
    let q = g.leaf(Leaf::Position(0));
    let (sin, cos) = (g.sin(q), g.cos(q));
    let (one, both) = (cost(&g, &[sin]), cost(&g, &[sin, cos]));
    assert_eq!(one, both);
    let quotient = g.div(sin, cos);
    let all = cost(&g, &[quotient]);
    assert!(all.weighted() > both.weighted());
    assert!(all.depth > both.depth);
}

#[test]
fn a_cost_is_told_part_by_part() {
    let mut g = Graph::default();
    let (_, sum) = product_and_sum(&mut g);
    let told = cost(&g, &[sum]).to_string();
    assert_eq!(
        told,
        "2.2 = 1 mul + 1 add − 0.2 × 1 fusable + 0.2 × 2 in a row"
    );
    assert_eq!(Cost::default().to_string(), "0 = 0 mul + 0 add");
}

/// The search results of a function are true: the chosen one costs no more than the others.
#[test]
fn the_cheapest_is_taken() {
    for name in ["scara_rrpr", "puma_arm"] {
        let robot = golden::robot(name);
        for method in Method::OF_TRAIT {
            let chosen = robot.chosen(method);
            let weight = chosen.cost().weighted();
            let place = format!("{name}, {method:?}");
            // The costs of plans are without sums of angles, each of which may save up to five operations
            // of unrotated axes.
            let operations = chosen.cost().operations.total();
            for plan in &chosen.plans {
                let most = plan.cost.operations.total() + 5;
                assert!(operations <= most, "{place}: {}", plan.what);
            }
            for other in &chosen.rejected {
                assert!(weight <= other.cost.weighted(), "{place}: {}", other.what);
            }
            let other = robot.function("literal", method).cost();
            assert!(weight <= other.weighted(), "{place}: {other}");
        }
    }
}

/// For a larger mechanism, the plan that costs least before factoring is chosen; the others are listed in
/// the order of their cost.
#[test]
fn plans_stand_in_the_order_of_their_cost() {
    let robot: Robot = golden::robot("puma_arm");
    for method in [Method::InverseDynamics, Method::InverseDynamicsDerivatives] {
        let plans = robot.chosen(method).plans;
        let weights: Vec<usize> = plans.iter().map(|p| p.cost.weighted()).collect();
        assert!(weights.len() > 2, "{weights:?}");
        assert!(weights.is_sorted_by(|a, b| a < b), "{weights:?}");
        let told: Vec<&str> = plans.iter().map(|p| p.what.as_str()).collect();
        for (i, what) in told.iter().enumerate() {
            assert!(!told[..i].contains(what), "twice: {what}");
        }
    }
}
