//! References in double-double: equation (6) by the generator's evaluator, without the code under test.

use bgdyn_codegen::bond_graph;
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::formulation::{Prepared, by_name};
use bgdyn_codegen::function::Function;
use bgdyn_codegen::mechanism::{Mechanism, Motion};
use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;
use bgdyn_runtime::manifold::spherical;

use crate::State;
use crate::bars::Reference;

/// Largest number of joints for which the literal sum is the reference; for more it would take too long,
/// and the recursion with each body's own inertia is used, which other tests compare with it.
const SHORT: usize = 6;

/// A mechanism's methods, to be evaluated.
pub(crate) struct Literal {
    mechanism: Mechanism,
    inverse: Function,
    mass: Function,
    bias: Function,
    gravity: Function,
    forward: Function,
}

impl Literal {
    /// Reads a spec.
    ///
    /// # Panics
    /// If the spec is refused.
    pub fn new(text: &str) -> Literal {
        Literal::up_to(text, SHORT)
    }

    /// Reads a spec; the literal sum is the reference whatever the number of joints.
    ///
    /// # Panics
    /// If the spec is refused.
    pub fn by_definition(text: &str) -> Literal {
        Literal::up_to(text, usize::MAX)
    }

    /// Reads a spec; the literal sum is the reference for up to so many velocities.
    fn up_to(text: &str, short: usize) -> Literal {
        let named = (!text.contains("\nname:")).then_some("reference");
        let (mechanism, faults) = bgdyn_codegen::read(text, named);
        let mechanism = mechanism.unwrap_or_else(|| panic!("{}", faults.render("spec", text)));
        let graph = bond_graph::build(&mechanism);
        let prepared = Prepared::new(&graph);
        let short = mechanism.nv() <= short;
        let [way, forward] = match short {
            true => ["literal", "literal"],
            false => ["recursion_own", "articulated"],
        };
        let of = |way: &str, method: Method| {
            let formulation = by_name(way).expect("a formulation of this name");
            let function = formulation.function(&prepared, method);
            function.expect("every formulation knows every method")
        };
        let forward = of(forward, Method::ForwardDynamics);
        let [inverse, mass, bias, gravity] = [
            Method::InverseDynamics,
            Method::MassMatrix,
            Method::Bias,
            Method::Gravity,
        ]
        .map(|method| of(way, method));
        Literal {
            inverse,
            mass,
            bias,
            gravity,
            forward,
            mechanism,
        }
    }

    /// The arguments in double-double. A quaternion with the digits of a scalar is off length 1 by its
    /// rounding error: the orientation is that of the quaternion divided by its length.
    fn inputs(&self, s: &State) -> Inputs<Dd> {
        let mut inputs = self.as_given(s);
        self.normalize(&mut inputs.q);
        inputs
    }

    /// Scales every quaternion to length 1.
    fn normalize(&self, q: &mut [Dd]) {
        for link in self.mechanism.links() {
            let Motion::Compound(motion) = link.joint.kind.motion else {
                continue;
            };
            if let Some(first) = motion.quaternion() {
                let at = link.joint.degrees.positions[first].0;
                let unit = spherical::normalize([0, 1, 2, 3].map(|i| q[at + i]));
                q[at..at + 4].copy_from_slice(&unit);
            }
        }
    }

    fn as_given(&self, s: &State) -> Inputs<Dd> {
        let all = |x: &[f64]| x.iter().map(|&x| Dd::from_f64(x)).collect();
        let parameters = self.mechanism.parameters().iter();
        Inputs {
            q: all(&s.q),
            v: all(&s.v),
            a: all(&s.a),
            u: all(&s.tau),
            parameters: parameters.map(|p| p.default).collect(),
            ..Inputs::default()
        }
    }

    fn value(&self, f: &Function, inputs: Inputs<Dd>) -> Vec<Dd> {
        let (value, refused) = f.evaluate(inputs);
        assert_eq!(refused, None, "the reference is singular");
        value
    }
}

impl Reference for Literal {
    fn inverse(&self, s: &State) -> Vec<Dd> {
        self.value(&self.inverse, self.inputs(s))
    }

    fn mass(&self, s: &State) -> Vec<Dd> {
        full(&self.value(&self.mass, self.inputs(s)), s.v.len())
    }

    fn bias(&self, s: &State) -> Vec<Dd> {
        self.value(&self.bias, self.inputs(s))
    }

    fn gravity(&self, s: &State) -> Vec<Dd> {
        self.value(&self.gravity, self.inputs(s))
    }

    fn forward_off(&self, s: &State, argument: usize, component: usize, factor: Dd) -> Vec<Dd> {
        let mut inputs = self.as_given(s);
        let argument = match argument {
            0 => &mut inputs.q,
            1 => &mut inputs.v,
            _ => &mut inputs.u,
        };
        argument[component] *= factor;
        self.normalize(&mut inputs.q);
        self.value(&self.forward, inputs)
    }
}

/// A full matrix, row by row, from its lower triangle.
fn full(triangle: &[Dd], n: usize) -> Vec<Dd> {
    let at = |i: usize, j: usize| triangle[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)];
    (0..n * n).map(|k| at(k / n, k % n)).collect()
}
