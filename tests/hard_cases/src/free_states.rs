//! Bars 1 to 5 with quaternions: bodies on spherical and floating joints, in the states of their reference
//! motions and in seeded ones.

use crate::bars::{Digits, Hard, Reference as _, SINGULAR, norm, rounded};
use crate::literal::Literal;
use crate::outcome::{Outcome, Worst};
use crate::reference::{Reference, reference};
use crate::rng::Rng;
use crate::single::{SHORT, STATES};
use crate::{Extent, State};
use hard_cases_compiled::{Compiled, model, spec};

/// A state's positions and velocities, from the columns of a file.
type Columns = fn(&[f64]) -> (Vec<f64>, Vec<f64>);

/// Of the files of tops: ω in body axes, then the quaternion with w first.
fn top(row: &[f64]) -> (Vec<f64>, Vec<f64>) {
    (vec![row[4], row[5], row[6], row[3]], row[..3].to_vec())
}

/// The same of a body whose origin remains where it is: position and velocity are zero.
fn body(row: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let (q, w) = top(row);
    let zero = vec![0.0; 3];
    ([zero.clone(), q].concat(), [zero, w].concat())
}

/// Of files whose columns are the state.
fn own<const NQ: usize>(row: &[f64]) -> (Vec<f64>, Vec<f64>) {
    (row[..NQ].to_vec(), row[NQ..].to_vec())
}

/// A mechanism with its reference motions.
struct Case {
    name: &'static str,
    motions: Vec<(Reference, Columns)>,
}

fn cases() -> Vec<Case> {
    let case = |name, motions| Case { name, motions };
    vec![
        case(
            "free_body_generic",
            vec![(reference!("free_body_generic"), body as Columns)],
        ),
        case(
            "heavy_top",
            vec![
                (reference!("heavy_top_slow_cusp"), top as Columns),
                (reference!("heavy_top_sleeping_stable"), top),
            ],
        ),
        case(
            "spherical_pendulum",
            vec![(reference!("spherical_pendulum"), own::<4>)],
        ),
        case(
            "body_tumbling",
            vec![(reference!("body_tumbling"), own::<7>)],
        ),
        case(
            "satellite_arm6",
            vec![
                (reference!("satellite_cycle"), own::<13> as Columns),
                (reference!("satellite_torques"), own::<13>),
            ],
        ),
    ]
}

/// Checks bars 1 to 5 in a state with the efforts of its accelerations, and with its own ones.
fn both(worst: &mut Worst, name: &str, at: &str, reference: &Literal, state: &State) {
    let driven = State {
        tau: rounded(&reference.inverse(state)),
        ..state.clone()
    };
    for state in [&driven, state] {
        all::<f64>(worst, name, at, reference, state);
        if state.v.len() <= SHORT {
            all::<f32>(worst, name, at, reference, state);
        }
    }
}

/// Checks bars 1 to 5 in one state in the scalar T. By the applied reading of bar 1, the error may be what
/// rounding of each position and velocity changes, if that is larger: the moment of gravity of a body that
/// is almost upright is a difference of squares of the quaternion's components.
fn all<T: Digits + Compiled>(
    worst: &mut Worst,
    name: &str,
    at: &str,
    reference: &Literal,
    state: &State,
) {
    let hard = Hard::new::<T>(reference, state, None);
    let mut found = hard.all::<T>(&model::<T>(name), reference, SINGULAR);
    for found in found.iter_mut().filter(|f| f.bar == "1" && f.asked > 1.0) {
        let changed = norm(&hard.rounded_arguments::<T>(&hard.state.a, reference));
        found.allowed = found.allowed.max(changed);
    }
    worst.add(name, T::MARK, at, found);
}

/// One mechanism: every sample of its motions, moving freely and with seeded accelerations; then seeded
/// states.
fn of_mechanism(case: &Case, states: usize) -> Vec<Outcome> {
    let (name, mut worst) = (case.name, Worst::default());
    let (reference, model) = (Literal::by_definition(spec(name)), model::<f64>(name));
    let mut rng = Rng::new(47);
    for (motion, columns) in &case.motions {
        for (row, t) in motion.rows().iter().zip(&motion.times) {
            let (q, v) = columns(row);
            assert_eq!((q.len(), v.len()), (model.nq(), model.nv()), "{name}");
            let a = (0..v.len()).map(|_| rng.within(3.0)).collect();
            let tau = vec![0.0; v.len()];
            let parameters = vec![];
            let state = State {
                q,
                v,
                a,
                tau,
                parameters,
            };
            both(
                &mut worst,
                name,
                &format!("sample at {t} s"),
                &reference,
                &state,
            );
        }
    }
    for k in 0..states {
        let state = State::oriented(&mut rng, &*model);
        both(&mut worst, name, &format!("state {k}"), &reference, &state);
    }
    worst.finish()
}

/// All of them.
pub(crate) fn free_states(extent: Extent) -> Vec<Outcome> {
    let states = extent.of(STATES, 10);
    let all = cases();
    all.iter()
        .flat_map(|case| of_mechanism(case, states))
        .collect()
}
