//! The passes over an expression graph, one at a time.

use bgdyn_codegen::expr::{
    Graph, Inputs, Leaf, Node, NodeId, Signed, absorb_negations, cost, count, evaluate,
    fold_reciprocals, fuse, reassociate,
};
use bgdyn_runtime::Dd;

fn xyz(g: &mut Graph) -> [Signed; 3] {
    [0, 1, 2].map(|k| g.leaf(Leaf::Position(k)))
}

fn minus(e: Signed) -> Signed {
    Signed {
        negative: !e.negative,
        ..e
    }
}

/// A late term is added last, whatever the written order of the sum; fused products count as available
/// one multiplication earlier.
#[test]
fn sums_are_arranged_by_arrival() {
    let mut g = Graph::default();
    let [x, y, z] = xyz(&mut g);
    let late = g.div(x, y);
    let late = g.sqrt(late);
    let (xy, yz, xz) = (g.mul(x, y), g.mul(y, z), g.mul(x, z));
    let mut sum = g.add(late, minus(xy));
    for term in [yz, minus(xz), z] {
        sum = g.add(sum, term);
    }
    let total = g.mul(minus(sum), z);
    let before = cost(&g, &[total]);
    let (h, outputs) = reassociate(&g, &[total]);
    let after = cost(&h, &outputs);
    assert_eq!(after.operations, before.operations);
    // √(x/y), one addition, one multiplication.
    assert_eq!((before.depth, after.depth), (14, 11));
    let inputs = || Inputs::<Dd> {
        q: [0.3, 0.7, -1.9].map(Dd::from_f64).to_vec(),
        ..Inputs::default()
    };
    let at = |g: &Graph, outputs: &[Signed]| evaluate(g, outputs, &inputs(), &mut None)[0];
    let off = at(&h, &outputs) - at(&g, &[total]);
    assert!(off.abs() < Dd::from_f64(1e-30), "{off}");
}

/// A sum that is read with the opposite sign is computed with it, if only fused sums read it
/// otherwise.
#[test]
fn signs_move_into_sums() {
    let mut g = Graph::default();
    let [x, y, z] = xyz(&mut g);
    // −(xy + z), also in a fused sum; −(y − z); −(xy + y) under a root.
    let free = g.mul_add(x, y, z);
    let reads = g.mul_add(free, x, y);
    let difference = g.add(y, minus(z));
    let bound = g.mul_add(x, y, y);
    let root = g.sqrt(bound);
    let outputs = [minus(free), reads, minus(difference), minus(bound), root];
    let (moved, found) = absorb_negations(&g, &outputs);
    let negative: Vec<bool> = found.iter().map(|e| e.negative).collect();
    assert_eq!(negative, [false, false, false, true, false]);
    assert_eq!(count(&moved, &found), count(&g, &outputs));
    let inputs = Inputs {
        q: vec![3.0, 5.0, -2.5],
        ..Inputs::default()
    };
    let value = |g: &Graph, outputs: &[Signed]| evaluate(g, outputs, &inputs, &mut None);
    assert_eq!(value(&moved, &found), value(&g, &outputs));
}

/// A reciprocal whose only reader is a product becomes a division; one that is read twice does not.
#[test]
fn a_reciprocal_of_one_product_is_divided_by() {
    let mut g = Graph::default();
    let [x, y, z] = xyz(&mut g);
    let one = g.constant(Dd::ONE);
    let once = g.div(one, x);
    let twice = g.div(one, y);
    let outputs = [
        g.mul(minus(once), z),
        g.mul(twice, z),
        g.mul(twice, x),
        g.div(z, x),
    ];
    let (quotients, found) = fold_reciprocals(g.clone(), outputs[..3].to_vec());
    let [before, after] = [count(&g, &outputs[..3]), count(&quotients, &found)];
    assert_eq!((before.mul, before.div), (3, 2));
    assert_eq!((after.mul, after.div), (2, 2));
    let inputs = Inputs {
        q: vec![3.0, 5.0, -2.5],
        ..Inputs::default()
    };
    let values = evaluate(&quotients, &found, &inputs, &mut None);
    let expected = evaluate(&g, &outputs, &inputs, &mut None);
    assert_eq!(values[0], -expected[3]);
    assert_eq!(values[1..], expected[1..3]);
    // A second application changes nothing.
    assert_eq!(fold_reciprocals(quotients, found.clone()).1, found);
}

/// A product with one sum as its only reader is fused with it; of two such products the later one; a
/// product that is read twice is not. Neither counts nor values change.
#[test]
fn products_are_joined_to_the_sums_that_read_them() {
    let mut g = Graph::default();
    let [x, y, z] = xyz(&mut g);
    let (early, root) = (g.mul(x, y), g.sqrt(z));
    let late = g.mul(root, y);
    let both = g.add(early, minus(late));
    let shared = g.mul(x, z);
    let outputs = [both, g.add(shared, y), shared];
    let (joined, found) = fuse(&g, &outputs);
    let sums = (0..joined.len()).map(|i| joined.node(NodeId::at(i)));
    let sums: Vec<&Node> = sums.filter(|n| matches!(n, Node::MulAdd(..))).collect();
    let [Node::MulAdd(a, b, ..)] = sums[..] else {
        panic!("{sums:?}")
    };
    let is_root = |id: &NodeId| matches!(joined.node(*id), Node::Sqrt(_));
    assert!(is_root(a) || is_root(b));
    assert_eq!(count(&joined, &found), count(&g, &outputs));
    let inputs = Inputs {
        q: vec![3.0, 5.0, 2.25],
        ..Inputs::default()
    };
    let value = |g: &Graph, outputs: &[Signed]| evaluate(g, outputs, &inputs, &mut None);
    assert_eq!(value(&joined, &found), value(&g, &outputs));
}
