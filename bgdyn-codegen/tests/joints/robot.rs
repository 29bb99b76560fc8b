//! A mechanism under test: its functions, states, and q̇ = N(q) v written by hand.

use std::fs;
use std::path::PathBuf;
use std::sync::Arc;

use bgdyn_codegen::bond_graph::{self, BondGraph, SiteId};
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::random::Random;
use bgdyn_runtime::{Dd, Scalar};

use super::maker::{Maker, maker, order};

/// A choice of formulation: the generator's own, or one by name.
pub type Way = Option<&'static str>;

/// The formulations that serve every joint.
pub const WAYS: [Way; 3] = [None, Some("subspaces"), Some("literal")];

/// Returns a file of the golden folder.
pub fn golden_text(file: &str) -> String {
    let path: PathBuf = [env!("CARGO_MANIFEST_DIR"), "../tests/golden/joints", file]
        .iter()
        .collect();
    fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// A mechanism with its bond graph.
pub struct Robot {
    pub mechanism: Mechanism,
    pub graph: Arc<BondGraph>,
    maker: Maker,
}

/// Arguments of all methods.
#[derive(Clone, Debug)]
pub struct State<T> {
    pub q: Vec<T>,
    pub v: Vec<T>,
    pub a: Vec<T>,
    pub u: Vec<T>,
}

impl Robot {
    /// Reads a spec, which must be without faults.
    pub fn read(text: &str) -> Self {
        let (mechanism, faults) = bgdyn_codegen::read(text, None);
        let Some(mechanism) = mechanism else {
            panic!("{}", faults.render("spec.yaml", text));
        };
        let graph = Arc::new(bond_graph::build(&mechanism));
        Robot {
            mechanism,
            maker: maker(text, &graph),
            graph,
        }
    }

    /// Reads a golden mechanism.
    pub fn golden(name: &str) -> Self {
        Robot::read(&golden_text(&format!("{name}.yaml")))
    }

    pub fn nv(&self) -> usize {
        self.mechanism.nv()
    }

    /// Returns the function of a method, as it is emitted; made once for all tests.
    pub fn function(&self, way: Way, method: Method) -> Arc<Function> {
        order(&self.maker, way, method)
    }

    pub fn site(&self, name: &str) -> SiteId {
        let found = self.graph.sites.iter().position(|s| s.name == name);
        SiteId(found.unwrap_or_else(|| panic!("no place `{name}`")))
    }

    /// Returns a random state in double-double with quaternions of length 1 to the last digit.
    pub fn state(&self, seed: u64) -> State<Dd> {
        let mut random = Random(seed);
        let mut some = |n: usize, size: f64| -> Vec<Dd> {
            (0..n)
                .map(|_| Dd::from_f64(size * random.signed()))
                .collect()
        };
        let (nq, nv) = (self.mechanism.nq(), self.nv());
        let mut state = State {
            q: some(nq, 2.5),
            v: some(nv, 2.0),
            a: some(nv, 3.0),
            u: some(nv, 20.0),
        };
        for at in self.quaternions() {
            scale(&mut state.q[at..at + 4], |length| Dd::ONE / length);
        }
        state
    }

    /// Returns where each quaternion starts in q.
    pub fn quaternions(&self) -> Vec<usize> {
        let links = self.mechanism.links().iter();
        let own = links.filter(|link| link.joint.degrees.own_positions());
        let first = |link: &bgdyn_codegen::mechanism::Link| {
            let positions = &link.joint.degrees.positions;
            match link.joint.kind.keyword {
                "floating" => Some(positions[3].0),
                "spherical" => Some(positions[0].0),
                _ => None,
            }
        };
        own.filter_map(first).collect()
    }

    /// Returns q̇ = N(q) v, joint by joint as the definitions have it.
    pub fn rates(&self, q: &[Dd], v: &[Dd]) -> Vec<Dd> {
        let mut rates = vec![Dd::ZERO; q.len()];
        for link in self.mechanism.links() {
            let joint = &link.joint;
            if let Some(coupling) = &joint.degrees.coupling {
                if let (false, Some(p)) = (coupling.of_positions(), joint.degrees.positions.first())
                {
                    let terms = coupling.velocities.iter().zip(&joint.degrees.velocities);
                    let terms = terms.map(|(leader, j)| leader.ratio * v[j.0]);
                    rates[p.0] = terms.fold(Dd::ZERO, |sum, term| sum + term);
                }
                continue;
            }
            let at = joint.degrees.positions.first().map_or(0, |p| p.0);
            let to = joint.degrees.velocities.first().map_or(0, |c| c.0);
            match joint.kind.keyword {
                "spherical" => {
                    let turning = half_product(&q[at..at + 4], &v[to..to + 3]);
                    rates[at..at + 4].copy_from_slice(&turning);
                }
                "floating" => {
                    let quaternion = &q[at + 3..at + 7];
                    let moving = turned(quaternion, &v[to..to + 3]);
                    rates[at..at + 3].copy_from_slice(&moving);
                    let turning = half_product(quaternion, &v[to + 3..to + 6]);
                    rates[at + 3..at + 7].copy_from_slice(&turning);
                }
                "planar" => {
                    let (sin, cos) = q[at + 2].sin_cos();
                    rates[at] = cos * v[to] - sin * v[to + 1];
                    rates[at + 1] = sin * v[to] + cos * v[to + 1];
                    rates[at + 2] = v[to + 2];
                }
                "fixed" => {}
                _ => rates[at] = v[to],
            }
        }
        rates
    }

    /// Returns q + h N(q) v.
    pub fn moved(&self, q: &[Dd], v: &[Dd], h: Dd) -> Vec<Dd> {
        let rates = self.rates(q, v);
        q.iter().zip(rates).map(|(&q, rate)| q + h * rate).collect()
    }
}

/// ½ q∘(ω, 0)
fn half_product(q: &[Dd], w: &[Dd]) -> [Dd; 4] {
    let (x, y, z, s) = (q[0], q[1], q[2], q[3]);
    [
        s * w[0] + y * w[2] - z * w[1],
        s * w[1] + z * w[0] - x * w[2],
        s * w[2] + x * w[1] - y * w[0],
        -(x * w[0] + y * w[1] + z * w[2]),
    ]
    .map(|e| e * 0.5_f64.into())
}

/// The product of two vectors.
pub fn cross(a: &[Dd], b: &[Dd]) -> [Dd; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// The vector part of q∘(u, 0)∘q*, for a unit quaternion.
pub fn turned(q: &[Dd], u: &[Dd]) -> [Dd; 3] {
    let two = Dd::from_f64(2.0);
    let once = cross(&q[..3], u);
    let twice = cross(&q[..3], &once);
    std::array::from_fn(|i| u[i] + two * (q[3] * once[i] + twice[i]))
}

/// Scales a quaternion by a function of its length.
pub fn scale(q: &mut [Dd], factor: impl Fn(Dd) -> Dd) {
    let square = q.iter().fold(Dd::ZERO, |sum, &x| sum + x * x);
    let factor = factor(square.sqrt());
    q.iter_mut().for_each(|x| *x *= factor);
}

impl<T: Scalar> State<T> {
    fn inputs(&self) -> Inputs<T> {
        Inputs {
            q: self.q.clone(),
            v: self.v.clone(),
            a: self.a.clone(),
            u: self.u.clone(),
            x: vec![],
            modes: vec![],
            parameters: vec![],
            t: None,
            passed: vec![],
        }
    }

    /// Returns the value of a function and the refused pivot.
    pub fn checked(&self, f: &Function) -> (Vec<T>, T::Refused) {
        f.evaluate(self.inputs())
    }
}

impl<T: Scalar<Refused = Option<usize>>> State<T> {
    /// Returns the value of a function; no pivot may be refused.
    pub fn value(&self, f: &Function) -> Vec<T> {
        let (value, refused) = self.checked(f);
        assert_eq!(refused, None, "{}: a pivot is refused", f.name);
        value
    }
}

impl State<Dd> {
    /// Returns the state rounded to `f64`.
    pub fn rounded(&self) -> State<f64> {
        let all = |x: &[Dd]| x.iter().map(|x| x.to_f64()).collect();
        State {
            q: all(&self.q),
            v: all(&self.v),
            a: all(&self.a),
            u: all(&self.u),
        }
    }
}

/// A full matrix from its lower triangle, row by row.
pub fn full<T: Copy>(triangle: &[T], n: usize) -> Vec<Vec<T>> {
    assert_eq!(triangle.len(), n * (n + 1) / 2);
    let at = |i: usize, j: usize| triangle[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)];
    (0..n).map(|i| (0..n).map(|j| at(i, j)).collect()).collect()
}

/// Σ x_i y_i
pub fn dot(x: &[Dd], y: &[Dd]) -> Dd {
    assert_eq!(x.len(), y.len());
    let products = x.iter().zip(y).map(|(&x, &y)| x * y);
    products.fold(Dd::ZERO, |sum, p| sum + p)
}

/// A matrix times a vector.
pub fn times(matrix: &[Vec<Dd>], x: &[Dd]) -> Vec<Dd> {
    matrix.iter().map(|row| dot(row, x)).collect()
}

/// The largest magnitude; infinity for a NaN.
pub fn largest(x: &[Dd]) -> f64 {
    x.iter().fold(0.0, |most: f64, x| match x.to_f64().abs() {
        size if size.is_nan() => f64::INFINITY,
        size => most.max(size),
    })
}

/// Asserts that all entries agree, relative to the largest entry or to `size`, if that is larger.
pub fn close(found: &[Dd], expected: &[Dd], relative: f64, size: f64, what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let allowed = relative * largest(expected).max(size);
    for (k, (&x, &y)) in found.iter().zip(expected).enumerate() {
        let off = (x - y).to_f64().abs();
        assert!(
            off <= allowed,
            "{what}: entry {k}: {:e} against {:e}, off by {off:e}, allowed {allowed:e}",
            x.to_f64(),
            y.to_f64()
        );
    }
}

/// The numbers in double-double.
pub fn dd(x: &[f64]) -> Vec<Dd> {
    x.iter().map(|&x| Dd::from_f64(x)).collect()
}
