//! Checks the functions of a scene against its equations of motion and its balance of power.

use bgdyn_runtime::manifold::{floating, planar, spherical};
use bgdyn_runtime::{Dd, QuasiJointKind};

use super::Difference;
use super::compare::{EXACT, Law, SOLVED, differs, largest, minus, plus, turned};
use super::dual::{Direction, Dual, along, rates, values, with_rates};
use super::rigid_contacts;
use super::states::{direction, of_scene, signed};
use crate::expr::Inputs;
use crate::function::Function;
use crate::method::{Method, SceneFunction};
use crate::random::Random;
use crate::scene::QuasiJoint;
use crate::system::SceneEquations;

/// Compares functions of a scene at two or three states, or at one for more than ten coordinates: the
/// derivative and the inverse with the literal sum under the scene's laws, the power with zero, the
/// Jacobian and the canonical form with the derivative in dual numbers. Returns at most one difference per
/// function. Energies, events, inputs and outputs are used by the others or define themselves.
pub fn check_scene(system: &SceneEquations, functions: &[Function]) -> Vec<Difference> {
    let held = system.mode_coordinates();
    let scene = CheckedScene {
        system,
        functions,
        sides: system.both_sides(),
        inverse: system.literal_inverse(),
        held,
    };
    let states = of_scene(system);
    let found = functions.iter().filter_map(|function| {
        let Method::Scene(role) = function.method else {
            return None;
        };
        states.iter().find_map(|at| scene.check(role, function, at))
    });
    found.collect()
}

/// Rates of first-order states below this, times the permitted error, count as zero: SI units.
const LEAST_RATE: f64 = 1e-12;

/// An opening of the loops, m or rad, that Newton's method reduces to about its square.
const OPENING: f64 = 1e-4;

struct CheckedScene<'a> {
    system: &'a SceneEquations,
    functions: &'a [Function],
    /// P, E and ẋ at given accelerations.
    sides: Function,
    /// The drives for given accelerations.
    inverse: Function,
    /// The coordinate that each mode can hold.
    held: Vec<usize>,
}

impl CheckedScene<'_> {
    fn check(
        &self,
        role: SceneFunction,
        function: &Function,
        at: &Inputs<Dd>,
    ) -> Option<Difference> {
        let (found, refused) = function.evaluate(at.clone());
        if refused.is_some() {
            return None;
        }
        match role {
            SceneFunction::Derivative => self.derivative(function, at, &found),
            SceneFunction::Inverse => {
                let expected = self.inverse.evaluate(at.clone()).0;
                let text = "own efforts = P(q, v, a) − E";
                let size = largest(&self.sides_at(&at.a, at));
                self.compare(function, (text, EXACT), (&found, &expected), size, at)
            }
            SceneFunction::Power => self.power(function, at, &found),
            SceneFunction::Jacobian => self.jacobian(function, at, &found),
            SceneFunction::InputJacobian => self.input_jacobian(function, at, &found),
            SceneFunction::ToCanonical => self.momenta(function, at, &found),
            SceneFunction::FromCanonical => {
                let (found, _) = function.evaluate(self.canonical(at)?);
                let text = "velocities of the momenta of v = v";
                self.compare(function, (text, SOLVED), (&found, &at.v), 0.0, at)
            }
            SceneFunction::CanonicalRates => self.canonical_rates(function, at),
            SceneFunction::Inputs
            | SceneFunction::Events
            | SceneFunction::Contacts
            | SceneFunction::Energy
            | SceneFunction::Outputs => None,
            SceneFunction::PositionRates => {
                let rates = self.system.graph.position_rates(&at.q, &at.v);
                let law = ("q̇ = N(q) S(q) v", EXACT);
                self.compare(function, law, (&found[..rates.len()], &rates), 0.0, at)
            }
            SceneFunction::ClosingStep => self.closing_step(function, at),
            SceneFunction::RigidContactStates => {
                let (normal, rate) = rigid_contacts::gap_rates(function, self.system, at);
                let law = ("γ_n = rate of the gap", EXACT);
                self.compare(function, law, (&normal, &rate), 0.0, at)
            }
            SceneFunction::RigidContactMaps => self.rigid_contact_maps(function, at, &found),
            SceneFunction::RigidContactBiases => {
                let states = self.function(SceneFunction::RigidContactStates)?;
                let expected = rigid_contacts::velocity_rates(states, self.system, at);
                let law = ("J̇ v = the rate of γ at constant velocities", EXACT);
                // The terms that may cancel are products of two velocities.
                let size = largest(&at.v).powi(2);
                self.compare(function, law, (&found, &expected), size, at)
            }
        }
    }

    fn compare(
        &self,
        function: &Function,
        (text, allowed): (&'static str, f64),
        sides: (&[Dd], &[Dd]),
        size: f64,
        at: &Inputs<Dd>,
    ) -> Option<Difference> {
        let law = Law { text, allowed };
        differs((&self.system.scene.name, function), &law, sides, size, at)
    }

    fn function(&self, role: SceneFunction) -> Option<&Function> {
        let wanted = Method::Scene(role);
        self.functions.iter().find(|f| f.method == wanted)
    }

    /// Checks P = E on every coordinate that is free, and the rates ẋ.
    fn derivative(&self, function: &Function, at: &Inputs<Dd>, rates: &[Dd]) -> Option<Difference> {
        let nv = self.system.scene.layout.nv();
        let (accelerations, rest) = rates.split_at(nv);
        let (first_order, coupled) = rest.split_at(self.system.scene.layout.nx());
        let sides = self.sides_at(accelerations, at);
        // The scale includes the terms that the accelerations cancel.
        let still = self.sides_at(&vec![Dd::ZERO; nv], at);
        let (inertial, rest) = sides.split_at(nv);
        let (efforts, expected) = rest.split_at(nv);
        let free: Vec<usize> = (0..nv).filter(|j| !self.holds(*j, at)).collect();
        let pick = |all: &[Dd]| -> Vec<Dd> { free.iter().map(|&j| all[j]).collect() };
        let text = "P(q, v, v̇) = E on free coordinates";
        let size = turned(accelerations)
            .iter()
            .map(|a| largest(&self.sides_at(a, at)[..nv]))
            .fold(largest(&still[..2 * nv]), f64::max);
        let pair = (&pick(inertial)[..], &pick(efforts)[..]);
        self.compare(function, (text, SOLVED), pair, size, at)
            .or_else(|| {
                let law = ("the rates of its effects' laws", EXACT);
                self.compare(function, law, (first_order, expected), LEAST_RATE, at)
            })
            .or_else(|| {
                let layout = &self.system.scene.layout;
                let mut expected = self.system.graph.position_rates(&at.q, &at.v);
                for (p, rate) in layout
                    .quasi_joints
                    .iter()
                    .filter(|joint| joint.is_independent(layout))
                    .flat_map(|joint| coupled_rates(joint, at))
                {
                    expected[p] = rate;
                }
                let of_coupled = layout.coupled().into_iter().map(|p| expected[p]);
                let expected: Vec<Dd> = of_coupled.collect();
                self.compare(
                    function,
                    ("q̇ = N(q) v", EXACT),
                    (coupled, &expected),
                    0.0,
                    at,
                )
            })
    }

    /// Checks that the loops are open by the square of a small opening after one step.
    fn closing_step(&self, function: &Function, at: &Inputs<Dd>) -> Option<Difference> {
        let closure = self.system.scene.mechanism.closure()?;
        let mut opened = at.clone();
        let mut random = Random(23);
        let layout = &self.system.scene.layout;
        // Each component of a quaternion turns by twice its change.
        let turns = |p: usize| {
            let mut joints = layout.quasi_joints.iter();
            joints.any(|joint| joint.quaternion.is_some_and(|k| (k..k + 4).contains(&p)))
        };
        for &(p, _) in &layout.closing {
            let part = if turns(p) { 0.25 } else { 1.0 };
            opened.q[p] += signed(&mut random) * Dd::from_f64(part * OPENING);
        }
        layout.normalize(&mut opened.q);
        let steps = function.evaluate(opened.clone()).0;
        let stepped = minus(&opened.q, &steps);
        let (left, _) = closure.values(&closure.position_rows(), &stepped);
        let closed = vec![Dd::ZERO; left.len()];
        let law = ("loops closed after a step, to its square", OPENING);
        self.compare(function, law, (&left, &closed), OPENING, at)
    }

    /// Checks the rows of J against velocities, and the columns of M⁻¹ Jᵀ against the literal sum.
    fn rigid_contact_maps(
        &self,
        function: &Function,
        at: &Inputs<Dd>,
        maps: &[Dd],
    ) -> Option<Difference> {
        let states = self.function(SceneFunction::RigidContactStates)?;
        let (by_rows, velocities) = rigid_contacts::relative_velocities(states, maps, at);
        let law = ("J v = γ(v) − γ(0)", EXACT);
        let differs = self.compare(function, law, (&by_rows, &velocities), 0.0, at);
        differs.or_else(|| {
            let nv = at.v.len();
            let inertial = |a: &[Dd]| self.sides_at(a, at)[..nv].to_vec();
            let (products, rows) = rigid_contacts::mass_times_columns(maps, nv, inertial);
            let size = largest(&inertial(&vec![Dd::ONE; nv]));
            let law = ("M (M⁻¹ Jᵀ) = Jᵀ", SOLVED);
            self.compare(function, law, (&products, &rows), size, at)
        })
    }

    /// Returns P, E and ẋ at these accelerations.
    fn sides_at(&self, accelerations: &[Dd], at: &Inputs<Dd>) -> Vec<Dd> {
        let a = accelerations.to_vec();
        self.sides.evaluate(Inputs { a, ..at.clone() }).0
    }

    /// Returns whether a mode holds the coordinate in this state.
    fn holds(&self, coordinate: usize, at: &Inputs<Dd>) -> bool {
        let modes = self.held.iter().zip(&at.modes);
        modes
            .filter(|(j, _)| **j == coordinate)
            .any(|(_, mode)| mode.to_f64().abs() < 0.5)
    }

    /// Checks Σ supplied = Σ d(stored)/dt + Σ dissipated, only if no joint is held: a held joint has the
    /// rate of its counterpart, which a random state does not have.
    fn power(&self, function: &Function, at: &Inputs<Dd>, entries: &[Dd]) -> Option<Difference> {
        if at.modes.contains(&Dd::ZERO) {
            return None;
        }
        let sum = |k: usize| {
            let column = entries.iter().skip(k).step_by(3);
            column.fold(Dd::ZERO, |sum, &x| sum + x)
        };
        let (supplied, used) = ([sum(0)], [sum(1) + sum(2)]);
        let text = "Σ supplied = Σ d(stored)/dt + Σ dissipated";
        // Without effects only terms of the kinetic energy's rate are left, which cancel.
        let still = self.sides_at(&vec![Dd::ZERO; at.v.len()], at);
        let terms = still.iter().zip(&at.v).map(|(&effort, &v)| effort * v);
        let size = largest(entries).max(largest(&terms.collect::<Vec<_>>()));
        self.compare(function, (text, SOLVED), (&supplied, &used), size, at)
    }

    /// Checks the Jacobian along a random direction of (q, v, x, t) against the rate of the derivative in
    /// dual numbers, under the inputs that the scene drives.
    fn jacobian(&self, function: &Function, at: &Inputs<Dd>, columns: &[Dd]) -> Option<Difference> {
        let mut random = Random(13);
        let (nq, nv, nx) = (at.q.len(), at.v.len(), at.x.len());
        let moved = Direction {
            q: direction(&mut random, nq),
            v: direction(&mut random, nv),
            // Volumes of fluid and deflections of bristles are small: use steps of the same size.
            x: at.x.iter().map(|&x| x * signed(&mut random)).collect(),
            t: signed(&mut random),
        };
        let derivative = self.rates(&along(at, &moved))?;
        let direction = moved.q.iter().chain(&moved.v).chain(&moved.x);
        let direction = direction.chain(std::iter::once(&moved.t));
        let rows = nv + nx + self.system.scene.layout.coupled().len();
        let columns = columns.chunks(rows.max(1)).zip(direction);
        let mut found = vec![Dd::ZERO; rows];
        for (column, &d) in columns {
            found = plus(&found, &column.iter().map(|&x| x * d).collect::<Vec<_>>());
        }
        let law = ("dẏ = ∂ẏ/∂y dy + ∂ẏ/∂t dt", SOLVED);
        let pair = (&found[..], &rates(&derivative)[..]);
        self.compare(function, law, pair, largest(&values(&derivative)), at)
    }

    /// Checks ∂ẏ/∂u along a random direction of the inputs against the rate of the derivative in dual numbers.
    fn input_jacobian(
        &self,
        function: &Function,
        at: &Inputs<Dd>,
        columns: &[Dd],
    ) -> Option<Difference> {
        let zeros = |of: &[Dd]| vec![Dd::ZERO; of.len()];
        let still = Direction {
            q: zeros(&at.q),
            v: zeros(&at.v),
            x: zeros(&at.x),
            t: Dd::ZERO,
        };
        let moved = direction(&mut Random(17), at.u.len());
        let inputs = Inputs {
            u: with_rates(&at.u, &moved),
            ..along(at, &still)
        };
        let (derivative, refused) = self.function(SceneFunction::Derivative)?.evaluate(inputs);
        if refused.is_some() {
            return None;
        }
        let mut found = vec![Dd::ZERO; derivative.len()];
        for (column, &d) in columns.chunks(derivative.len().max(1)).zip(&moved) {
            found = plus(&found, &column.iter().map(|&x| x * d).collect::<Vec<_>>());
        }
        let law = ("dẏ = ∂ẏ/∂u du", SOLVED);
        let pair = (&found[..], &rates(&derivative)[..]);
        self.compare(function, law, pair, largest(&values(&derivative)), at)
    }

    /// Returns v̇ and ẋ under the inputs that the scene drives.
    fn rates(&self, at: &Inputs<Dual>) -> Option<Vec<Dual>> {
        let derivative = self.function(SceneFunction::Derivative)?;
        let mut driven = at.clone();
        if let Some(inputs) = self.function(SceneFunction::Inputs) {
            driven.u = inputs.evaluate(at.clone()).0;
            // What sampled controllers give is held.
            let control = self.system.scene.control.iter();
            for &i in control.flat_map(|control| &control.controlled) {
                driven.u[i] = at.u[i];
            }
        }
        let (rates, refused) = derivative.evaluate(driven);
        refused.is_none().then_some(rates)
    }

    /// Checks p = M v.
    fn momenta(&self, function: &Function, at: &Inputs<Dd>, found: &[Dd]) -> Option<Difference> {
        let nv = at.v.len();
        let moved = self.sides_at(&at.v, at);
        let still = self.sides_at(&vec![Dd::ZERO; nv], at);
        let expected = minus(&moved[..nv], &still[..nv]);
        let text = "p = P(q, v, v) − P(q, v, 0)";
        let size = largest(&still[..nv]);
        self.compare(function, (text, EXACT), (found, &expected), size, at)
    }

    /// Returns the state with momenta in place of velocities.
    fn canonical(&self, at: &Inputs<Dd>) -> Option<Inputs<Dd>> {
        let momenta = self
            .function(SceneFunction::ToCanonical)?
            .evaluate(at.clone())
            .0;
        Some(Inputs {
            v: momenta,
            ..at.clone()
        })
    }

    /// Checks q̇, ṗ and ẋ, with ṗ from the momenta in dual numbers along the motion.
    fn canonical_rates(&self, function: &Function, at: &Inputs<Dd>) -> Option<Difference> {
        let (found, refused) = function.evaluate(self.canonical(at)?);
        let still = Direction {
            q: vec![Dd::ZERO; at.q.len()],
            v: vec![Dd::ZERO; at.v.len()],
            x: vec![Dd::ZERO; at.x.len()],
            t: Dd::ZERO,
        };
        let derivative = values(&self.rates(&along(at, &still))?);
        if refused.is_some() {
            return None;
        }
        let (nq, nv) = (at.q.len(), at.v.len());
        let motion = Direction {
            q: at.v[..nq].to_vec(),
            v: derivative[..nv].to_vec(),
            x: derivative[nv..].to_vec(),
            t: Dd::ONE,
        };
        let momenta = self.function(SceneFunction::ToCanonical)?;
        let momentum_rates = rates(&momenta.evaluate(along(at, &motion)).0);
        let expected = [&motion.q[..], &momentum_rates, &motion.x].concat();
        let law = ("rates of q, p and x along the motion", SOLVED);
        self.compare(function, law, (&found, &expected), 0.0, at)
    }
}

/// Returns the positions of a joint and their rates, by the formulas of the runtime.
fn coupled_rates(joint: &QuasiJoint, at: &Inputs<Dd>) -> Vec<(usize, Dd)> {
    fn array<const N: usize>(values: &[Dd], from: usize) -> [Dd; N] {
        std::array::from_fn(|k| values[from + k])
    }
    let (q, v) = (joint.positions.start, joint.coordinates.start);
    let rates = match joint.kind {
        QuasiJointKind::Planar => planar::position_rates(array(&at.q, q), array(&at.v, v)).to_vec(),
        QuasiJointKind::Spherical => {
            spherical::position_rates(array(&at.q, q), array(&at.v, v)).to_vec()
        }
        QuasiJointKind::Floating => {
            floating::position_rates(array(&at.q, q), array(&at.v, v)).to_vec()
        }
    };
    joint.positions.clone().zip(rates).collect()
}
