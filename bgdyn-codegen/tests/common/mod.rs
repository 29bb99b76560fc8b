//! Common code of the tests: deterministic states, robots under test, tolerances.
//!
//! Tests go through the public interface only: text → mechanism → functions → evaluator.
#![allow(dead_code)] // each test file uses a part

pub mod bars;
pub mod baseline;
pub mod forward_law;
pub mod golden;
pub mod hard;
pub mod kinematics;
pub mod laws;
pub mod parameters;
pub mod printed;
pub mod random;
pub mod rng;
pub mod values;

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use bgdyn_codegen::bond_graph::{self, BondGraph};
use bgdyn_codegen::choice::{Choice, Preference, prefer};
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::formulation::{self, Formulation, Prepared};
use bgdyn_codegen::function::Function;
use bgdyn_codegen::mechanism::{Mechanism, Motion, Value};
use bgdyn_codegen::method::Method;
use bgdyn_runtime::{Dd, Scalar};
use rng::Rng;

/// Both formulations by name.
pub const FORMULATIONS: [&str; 2] = ["literal", "recursion"];

/// A mechanism with its bond graph, and with what was found of it: the search for plans takes most of the
/// time of a function, and is made once.
pub struct Robot {
    pub mechanism: Mechanism,
    /// Not freed: the rest refers to it.
    pub graph: &'static BondGraph,
    prepared: Prepared<'static>,
    /// By formulation; `None` is the generator's own choice.
    choices: RefCell<BTreeMap<Option<String>, Rc<Choice<'static>>>>,
}

impl Robot {
    /// Reads a spec's text, which must be without faults.
    pub fn read(text: &str, stem: Option<&str>) -> Self {
        let (mechanism, faults) = bgdyn_codegen::read(text, stem);
        let Some(mechanism) = mechanism else {
            panic!("the spec is refused: {faults:?}\n{text}");
        };
        let graph: &'static BondGraph = Box::leak(Box::new(bond_graph::build(&mechanism)));
        Robot {
            mechanism,
            graph,
            prepared: Prepared::new(graph),
            choices: RefCell::default(),
        }
    }

    /// Returns the choice of functions, of one formulation or of all.
    fn choice(&self, formulation: Option<&str>) -> Rc<Choice<'static>> {
        let mut choices = self.choices.borrow_mut();
        let choice = choices.entry(formulation.map(str::to_owned));
        let new = || {
            let named = |name| formulation::by_name(name).expect("a formulation of this name");
            Rc::new(Choice::new(self.graph, formulation.map(named)))
        };
        choice.or_insert_with(new).clone()
    }

    pub fn nv(&self) -> usize {
        self.mechanism.nv()
    }

    /// Names of the moving joints, in the order of q.
    pub fn joints(&self) -> Vec<String> {
        let links = self.mechanism.coordinates().iter();
        links
            .map(|l| self.mechanism.links()[l.0].joint.name.clone())
            .collect()
    }

    /// Returns the motion of each coordinate.
    pub fn motions(&self) -> Vec<Motion> {
        self.graph.coordinates.iter().map(|c| c.motion).collect()
    }

    /// The function of a method by the named formulation, as it is emitted.
    pub fn function(&self, formulation: &str, method: Method) -> Function {
        let choice = self.choice(Some(formulation));
        let made = prefer(&choice, method, Preference::default());
        made.expect("every formulation knows every method")
    }

    /// Returns the generator's own function of a method, as it is emitted.
    pub fn emitted(&self, method: Method) -> Function {
        let made = prefer(&self.choice(None), method, Preference::default());
        made.expect("every method is known")
    }

    /// Returns the default function of a method, in one block.
    pub fn chosen(&self, method: Method) -> Function {
        let found = self.choice(None).function(method);
        found.expect("every method is known").as_ref().clone()
    }

    /// Returns the same before long functions are cut into blocks: one graph, for differentiation.
    pub fn whole(&self, formulation: &str, method: Method) -> Function {
        let formulation = formulation::by_name(formulation).expect("a formulation of this name");
        let made = self.made(formulation, method);
        made.expect("every formulation knows every method")
    }

    /// Returns a method's function by a formulation, in one block; `None` if it cannot create it for this mechanism.
    pub fn made(&self, formulation: &dyn Formulation, method: Method) -> Option<Function> {
        if formulation.reads(method).is_empty() {
            return formulation.function(&self.prepared, method);
        }
        // It reads the functions of other methods, which a choice creates before.
        let made = self.choice(Some(formulation.name())).function(method)?;
        Some(made.as_ref().clone())
    }
}

/// Positions, velocities, accelerations, efforts, and values of the run-time parameters.
#[derive(Clone, Debug)]
pub struct State {
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub a: Vec<f64>,
    pub tau: Vec<f64>,
    pub parameters: Vec<f64>,
}

impl State {
    /// Returns a random state: angles over a whole turn, displacements within 1 m; sometimes an exact 0.
    pub fn random(rng: &mut Rng, motions: &[Motion]) -> Self {
        let mut some = |size: f64| {
            if rng.chance(0.05) {
                0.0
            } else {
                rng.within(size)
            }
        };
        let q = |m: &Motion| if *m == Motion::Rotation { 3.2 } else { 1.0 };
        State {
            q: motions.iter().map(|m| some(q(m))).collect(),
            v: motions.iter().map(|_| some(2.0)).collect(),
            a: motions.iter().map(|_| some(3.0)).collect(),
            tau: motions.iter().map(|_| some(20.0)).collect(),
            parameters: vec![],
        }
    }

    /// The arguments in a scalar type.
    pub fn inputs<T: Scalar>(&self) -> Inputs<T> {
        let all = |x: &[f64]| x.iter().map(|&x| T::from_f64(x)).collect();
        Inputs {
            q: all(&self.q),
            v: all(&self.v),
            a: all(&self.a),
            u: all(&self.tau),
            x: vec![],
            modes: vec![],
            parameters: all(&self.parameters),
            t: None,
            passed: vec![],
        }
    }

    /// The method's value; no pivot may be refused.
    pub fn value<T: Scalar<Refused = Option<usize>>>(&self, f: &Function) -> Vec<T> {
        let (value, refused) = f.evaluate(self.inputs::<T>());
        assert_eq!(refused, None, "a pivot is refused: {}", f.formulation);
        value
    }
}

/// A full matrix from its lower triangle, row by row.
pub fn full<T: Copy>(triangle: &[T], n: usize) -> Vec<Vec<T>> {
    assert_eq!(triangle.len(), n * (n + 1) / 2);
    let at = |i: usize, j: usize| triangle[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)];
    (0..n).map(|i| (0..n).map(|j| at(i, j)).collect()).collect()
}

/// The largest entry, absolute.
pub fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |m, x| m.max(x.abs()))
}

/// The sum of absolute entries.
pub fn sum_abs(x: &[f64]) -> f64 {
    x.iter().map(|x| x.abs()).sum()
}

/// Asserts |x − y| ≤ `tolerance` entry by entry; `what` describes the location of a failure.
pub fn assert_close<T: Into<Dd> + Copy>(
    x: &[T],
    y: &[T],
    tolerance: f64,
    what: impl Fn() -> String,
) {
    assert_eq!(x.len(), y.len(), "{}", what());
    for (k, (&x, &y)) in x.iter().zip(y).enumerate() {
        let (x, y): (Dd, Dd) = (x.into(), y.into());
        let off = (x - y).abs().to_f64();
        assert!(
            off <= tolerance,
            "{}: entry {k}: {} against {}, off by {off:e}, allowed {tolerance:e}",
            what(),
            x.to_f64(),
            y.to_f64()
        );
    }
}

/// Returns a number of the spec, or the value of its run-time parameter.
pub fn fixed(value: Value, parameters: &[f64]) -> f64 {
    match value {
        Value::Fixed(x) => x.to_f64(),
        Value::Parameter(p) => parameters[p.0],
    }
}

/// Returns an effort that no single term of equation (6) exceeds in this state: with L the sum of all
/// lengths and W = Σ m_i L² + |J_i| (L at least 1 m), W (Σ|a| + (Σ|v|)²) + Σ m_i |g| L.
pub fn natural_effort(robot: &Robot, s: &State) -> f64 {
    let (weight, inertia) = natural_inertia(robot, s);
    let speed = sum_abs(&s.v);
    inertia * (sum_abs(&s.a) + speed * speed) + weight
}

/// (Σ m_i |g| L, W) of [`natural_effort`].
pub fn natural_inertia(robot: &Robot, s: &State) -> (f64, f64) {
    let links = robot.mechanism.links();
    let fixed = |x| fixed(x, &s.parameters);
    let mut length = 1.0;
    for link in links {
        if link.parent.is_some() {
            let step = link.joint.origin.translation.0;
            length += step.iter().map(|x| x.to_f64().abs()).sum::<f64>();
        }
        let com = link.inertial.com.0;
        length += com.iter().map(|&x| fixed(x).abs()).sum::<f64>();
    }
    for (q, motion) in s.q.iter().zip(robot.motions()) {
        if motion == Motion::Translation {
            length += q.abs();
        }
    }
    let mass: f64 = links.iter().map(|l| fixed(l.inertial.mass)).sum();
    let tensors = links.iter().flat_map(|l| l.inertial.inertia.entries);
    let inertia = mass * length * length + tensors.map(|x| fixed(x).abs()).sum::<f64>();
    let g = robot.mechanism.gravity().0;
    let gravity: f64 = g.iter().map(|x| x.to_f64().abs()).sum();
    (mass * gravity * length, inertia)
}

/// Returns a size that no single term of the method's result exceeds in this state.
pub fn natural_size(robot: &Robot, s: &State, method: Method) -> f64 {
    let speed = sum_abs(&s.v);
    let (_, inertia) = natural_inertia(robot, s);
    match method {
        Method::MassMatrix => inertia,
        Method::KineticEnergy => inertia * speed * speed,
        Method::PotentialEnergy => natural_effort(robot, s) * reach(robot, s),
        Method::CoriolisMatrix => inertia * speed,
        Method::Pose(_) | Method::Jacobian(_) => reach(robot, s),
        Method::Velocity(_) => reach(robot, s) * speed,
        Method::JacobianDotV(_) => reach(robot, s) * speed * speed,
        _ => natural_effort(robot, s),
    }
}

/// Returns an upper bound of the distance of any centre of mass and any frame from the world's origin, m;
/// at least 1.
pub fn reach(robot: &Robot, s: &State) -> f64 {
    let links = robot.mechanism.links().iter();
    let coms = links.clone().flat_map(|l| l.inertial.com.0);
    let coms = coms.map(|x| fixed(x, &s.parameters));
    let frames = robot.mechanism.frames().iter();
    let steps = links
        .map(|l| l.joint.origin)
        .chain(frames.map(|f| f.origin))
        .flat_map(|origin| origin.translation.0)
        .map(Dd::to_f64);
    let slides = s.q.iter().zip(robot.motions());
    let slides = slides.filter(|(_, m)| *m == Motion::Translation);
    let all = coms.chain(steps).chain(slides.map(|(q, _)| *q));
    1.0 + all.map(f64::abs).sum::<f64>()
}
