//! Mechanisms of many links: mass matrices in common axes, and their inner products in loops.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use crate::common::random::Draft;
use crate::common::rng::Rng;
use crate::common::{Robot, State, assert_close, golden, natural_inertia};
use bgdyn_codegen::expr::count;
use bgdyn_codegen::function::{Function, InnerProducts, in_triangle};
use bgdyn_codegen::method::Method;
use bgdyn_codegen::passes::factor;
use bgdyn_runtime::Dd;

const M: Method = Method::MassMatrix;

/// Of double-double results, relative to their natural size.
const EXACT: f64 = 1e-28;

fn products(function: &Function) -> &[InnerProducts] {
    &function.blocks.last().expect("a block").products
}

/// The emitted function equals the joint-by-joint method and, for short chains, the literal sum.
fn equals_the_other_ways(name: &str, robot: &Robot, rng: &mut Rng) {
    let found = robot.function("common_axes", M);
    let state = State::random(rng, &robot.motions());
    let x: Vec<Dd> = state.value(&found);
    for way in ["recursion", "literal"] {
        if way == "literal" && robot.nv() > 24 {
            continue;
        }
        let y: Vec<Dd> = state.value(&robot.whole(way, M));
        let size = natural_inertia(robot, &state).1;
        let what = || format!("{name}: {way}\n{state:?}");
        assert_close(&x, &y, EXACT * size, what);
    }
}

#[test]
fn common_axes_equal_the_other_ways() {
    for seed in 0..12 {
        let mut rng = Rng::new(4000 + seed);
        let draft = Draft::moving(&mut rng, 16 + 2 * seed as usize);
        let robot = Robot::read(&draft.yaml(), None);
        equals_the_other_ways(&format!("seed {seed}"), &robot, &mut rng);
    }
    let branched = include_str!("../../../tests/chains/branched.yaml");
    let branched = Robot::read(branched, Some("branched"));
    equals_the_other_ways("branched", &branched, &mut Rng::new(1));
    let found = branched.function("common_axes", M);
    let looped = products(&found)
        .iter()
        .flat_map(InnerProducts::entries)
        .count();
    assert!(looped > 100, "{looped} entries in loops");
    for name in ["chain32", "chain64"] {
        equals_the_other_ways(name, &golden::robot(name), &mut Rng::new(1));
    }
}

/// The largest error in `f64` of an entry, in roundings of √(M_ii M_jj).
fn lost(robot: &Robot, way: &str) -> f64 {
    let (function, mut rng) = (robot.function(way, M), Rng::new(7));
    let mut worst = 0.0_f64;
    for _ in 0..5 {
        let state = State::random(&mut rng, &robot.motions());
        let rounded: Vec<f64> = state.value(&function);
        let exact: Vec<Dd> = state.value(&function);
        let diagonal = |i: usize| exact[in_triangle(i, i)].to_f64();
        for (i, j) in (0..robot.nv()).flat_map(|i| (0..=i).map(move |j| (i, j))) {
            let k = in_triangle(i, j);
            let off = (Dd::from_f64(rounded[k]) - exact[k]).abs().to_f64();
            worst = worst.max(off / (diagonal(i) * diagonal(j)).sqrt());
        }
    }
    worst / f64::EPSILON
}

/// Moments about a distant origin are larger than those about the joint; but the resulting error is not
/// larger than that of the joint-by-joint method.
#[test]
fn common_axes_lose_no_more_digits() {
    for name in ["chain8", "chain32", "chain64"] {
        let robot = golden::robot(name);
        let (common, carried) = (lost(&robot, "common_axes"), lost(&robot, "recursion"));
        println!("{name}: {common:.1} roundings in common axes, {carried:.1} joint by joint");
        assert!(
            common <= 2.0 * carried,
            "{name}: {common} against {carried}"
        );
    }
}

/// Counting chooses common axes for chains in general position from some length on, and the joint-by-joint
/// method for short ones.
#[test]
fn counting_chooses() {
    for (name, operations) in [
        ("chain8", None),
        ("chain32", Some(9961)),
        ("chain64", Some(31543)),
    ] {
        let robot = golden::robot(name);
        let chosen = robot.chosen(M);
        let total = chosen.operations().total();
        let common = chosen.formulation.starts_with("common_axes");
        assert_eq!(
            operations.is_some(),
            common,
            "{name}: {}",
            chosen.formulation
        );
        assert!(
            operations.is_none_or(|most| total <= most),
            "{name}: {total}"
        );
        let other = if common { "recursion" } else { "common_axes" };
        let other = robot.function(other, M).operations().total();
        assert!(total <= other, "{name}: {total} against {other}");
    }
}

/// Blocks and loops change neither the count nor the entries; no entry is computed twice.
#[test]
fn loops_compute_what_is_counted() {
    for name in ["chain32", "chain64"] {
        let robot = golden::robot(name);
        let (whole, cut) = (robot.chosen(M), robot.function("common_axes", M));
        assert_eq!(whole.operations(), cut.operations(), "{name}");
        let last = cut.blocks.last().expect("a block");
        let [products] = products(&cut) else {
            panic!("{name}: one table")
        };
        let entries: Vec<(usize, usize)> = products.entries().collect();
        let distinct: BTreeSet<_> = entries.iter().collect();
        assert_eq!(distinct.len(), entries.len(), "{name}");
        let n = robot.nv();
        assert!(
            entries.len() >= (n - 3) * (n - 3) / 2,
            "{name}: {}",
            entries.len()
        );
        // Each entry of the table is the sum of its products, and no other entries remain.
        let mut terms = 0;
        for &(row, column) in &entries {
            let entry = [last.outputs[in_triangle(row, column)]];
            let found = count(&cut.graph, &entry);
            let wanted = products.rows[&row].len();
            assert_eq!(products.columns[&column].len(), wanted);
            assert_eq!((found.mul, found.add), (wanted, wanted - 1));
            terms += found.total();
        }
        assert_eq!(count(&cut.graph, &last.outputs).total(), terms, "{name}");
    }
}

/// Every count of the page's table.
#[test]
fn the_page_holds_what_is_generated() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let page = fs::read_to_string(root.join("docs/chains.md")).expect("a page");
    for (links, spec) in [
        (16, "tests/chains/chain16.yaml"),
        (32, "tests/golden/specs/chain32.yaml"),
        (64, "tests/golden/specs/chain64.yaml"),
    ] {
        let text = fs::read_to_string(root.join(spec)).expect("a spec");
        let robot = Robot::read(&text, Some("chain"));
        let count = |f: &Function| {
            let o = f.operations();
            (o.total(), format!("({}/{})", o.mul, o.add))
        };
        let [id, m, fd] = [Method::InverseDynamics, M, Method::ForwardDynamics]
            .map(|method| count(&robot.chosen(method)));
        let carried = count(&factor(robot.whole("recursion", M)));
        let row = format!(
            "| {links} | {} {} | **{}** {} | {} {} | {} {} |",
            id.0, id.1, m.0, m.1, carried.0, carried.1, fd.0, fd.1
        );
        assert!(page.contains(&row), "not on the page: {row}");
    }
}
