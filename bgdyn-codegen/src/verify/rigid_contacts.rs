//! Both sides of the laws of rigid contacts: the rate of the gap, J v, M (M⁻¹ Jᵀ) = Jᵀ, and the rate of γ at v̇ = 0.

use bgdyn_runtime::Dd;

use super::compare::minus;
use super::dual::{Direction, Dual, along, rates, with_rates};
use crate::expr::Inputs;
use crate::function::Function;
use crate::layout::Level;
use crate::system::SceneEquations;

/// The numbers of a contact's state: gap, velocity along (x, y, normal), friction, restitution.
const STATE: usize = 6;

/// Returns the normal velocity at each contact, and the rate of its gap along the motion.
pub(super) fn gap_rates(
    states: &Function,
    system: &SceneEquations,
    at: &Inputs<Dd>,
) -> (Vec<Dd>, Vec<Dd>) {
    let moving = rates(&states.evaluate(moving(system, at)).0);
    let found = states.evaluate(at.clone()).0;
    let normals = found.chunks(STATE).map(|state| state[3]);
    let of_gaps = moving.chunks(STATE).map(|state| state[0]);
    (normals.collect(), of_gaps.collect())
}

/// Returns the rate of γ of all contacts along the motion with constant velocities.
pub(super) fn velocity_rates(
    states: &Function,
    system: &SceneEquations,
    at: &Inputs<Dd>,
) -> Vec<Dd> {
    let moving = rates(&states.evaluate(moving(system, at)).0);
    let of_velocities = moving.chunks(STATE).flat_map(|state| state[1..4].to_vec());
    of_velocities.collect()
}

/// Returns the state that moves with constant velocities and, where they are prescribed, accelerations: q̇ = N(q) S(q) v.
fn moving(system: &SceneEquations, at: &Inputs<Dd>) -> Inputs<Dual> {
    let none = |n: usize| vec![Dd::ZERO; n];
    let mut q = system.graph.position_rates(&at.q, &at.v);
    // Coordinates that effects add move no contact.
    q.resize(at.q.len(), Dd::ZERO);
    let motion = Direction {
        q,
        v: none(at.v.len()),
        x: none(at.x.len()),
        t: Dd::ZERO,
    };
    let layout = &system.scene.layout;
    let input = |joint: &str, level: Level| {
        let name = level.name(joint);
        layout.inputs.iter().position(|input| input.name == name)
    };
    let mut u = none(at.u.len());
    let steps = [
        (Level::Position, Level::Rate),
        (Level::Rate, Level::Acceleration),
    ];
    for joint in &layout.prescribed {
        for (from, to) in steps {
            if let (Some(from), Some(to)) = (input(joint, from), input(joint, to)) {
                u[from] = at.u[to];
            }
        }
    }
    Inputs {
        u: with_rates(&at.u, &u),
        ..along(at, &motion)
    }
}

/// Returns the rows of J times v, and γ(v) − γ(0), for all contacts.
pub(super) fn relative_velocities(
    states: &Function,
    maps: &[Dd],
    at: &Inputs<Dd>,
) -> (Vec<Dd>, Vec<Dd>) {
    let still = Inputs {
        v: vec![Dd::ZERO; at.v.len()],
        ..at.clone()
    };
    let [moving, still] = [at.clone(), still].map(|at| {
        let all = states.evaluate(at).0;
        let velocities = all.chunks(STATE).flat_map(|state| state[1..4].to_vec());
        velocities.collect::<Vec<Dd>>()
    });
    let nv = at.v.len();
    let row = |row: &[Dd]| {
        let terms = row.iter().zip(&at.v);
        terms.fold(Dd::ZERO, |sum, (&a, &b)| sum + a * b)
    };
    let by_rows = maps.chunks(6 * nv).flat_map(|map| map[..3 * nv].chunks(nv));
    (by_rows.map(row).collect(), minus(&moving, &still))
}

/// Returns M times each column of M⁻¹ Jᵀ, and the rows of J. `inertial` are the efforts P at accelerations.
pub(super) fn mass_times_columns(
    maps: &[Dd],
    nv: usize,
    inertial: impl Fn(&[Dd]) -> Vec<Dd>,
) -> (Vec<Dd>, Vec<Dd>) {
    let still = inertial(&vec![Dd::ZERO; nv]);
    let (mut products, mut rows) = (Vec::new(), Vec::new());
    for map in maps.chunks(6 * nv) {
        let (of_rows, columns) = map.split_at(3 * nv);
        rows.extend_from_slice(of_rows);
        for column in columns.chunks(nv) {
            products.extend(minus(&inertial(column), &still));
        }
    }
    (products, rows)
}
