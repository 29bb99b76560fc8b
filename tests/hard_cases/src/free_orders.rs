//! Bar 8 with quaternions in the state: the order of every integrator, in double-double, in scenes with
//! spherical and floating joints. A free body alone would not do: its velocities do not depend on its
//! orientation.

use bgdyn_runtime::{Dd, HybridSystem, Slope};
use bgdyn_sim::{
    FixedModes, Gauss, HybridState, INTEGRATORS, Integrator, IntegratorInfo, Ode, Run, ScenePlant,
    Solver, WithIntegrator, with_integrator,
};

use crate::outcome::Outcome;
use crate::problems::{distance, slope};
use crate::{Extent, scenes};

type State<S> = <S as HybridSystem<Dd>>::State;
type Begin<S> = HybridState<State<S>, <S as HybridSystem<Dd>>::Modes>;

/// Steps of the reference solution, by order 12.
const FINE: u32 = 300;

/// A scene from its start to a time.
struct Way<'a, S: HybridSystem<Dd>> {
    plant: &'a ScenePlant<'a, S, Dd>,
    begin: &'a Begin<S>,
    /// Its end, s.
    end: f64,
}

impl<S: HybridSystem<Dd>> Way<'_, S> {
    /// Returns the state at the end after so many equal steps.
    fn after<M: Integrator<State<S>>>(&self, method: M, steps: u32) -> State<S> {
        let (plant, modes) = (self.plant, &self.begin.modes);
        let held = FixedModes { plant, modes };
        // The scene's start has the digits of an `f64`: its quaternion is off length 1 by its rounding error.
        let mut y = self.begin.y;
        held.project(self.begin.t, &mut y).expect("no loop");
        let mut solver = Solver::new(method, self.begin.t, y);
        let h = Dd::from(self.end) / Dd::from(f64::from(steps));
        for _ in 0..steps {
            solver.advance(&held, h).expect("it turns");
        }
        *solver.y()
    }
}

/// The error at the end after a number of halvings of a method's longest step.
struct Error<'a, S: HybridSystem<Dd>> {
    way: &'a Way<'a, S>,
    exact: &'a State<S>,
    halvings: u32,
}

/// Returns the steps from which halvings show the order.
fn coarsest(order: u32) -> u32 {
    match order {
        1 => 400,
        2 => 100,
        3 | 4 => 48,
        5 | 6 => 24,
        7 | 8 => 12,
        _ => 6,
    }
}

impl<S: HybridSystem<Dd>> WithIntegrator<State<S>> for Error<'_, S> {
    type Output = (IntegratorInfo, f64);

    fn with<M: Integrator<State<S>>>(self, method: M) -> Self::Output {
        let info = method.info();
        let steps = coarsest(info.order) << self.halvings;
        (info, distance(&self.way.after(method, steps), self.exact))
    }
}

/// The orders of all integrators in one scene. Those that read slopes are tried without them and, if `known`
/// provides them, with them; Rosenbrock methods need them.
fn of_scene<S: HybridSystem<Dd>>(
    case: &str,
    scene: &S,
    known: Option<ScenePlant<'_, S, Dd>>,
    end: f64,
) -> Vec<Outcome> {
    let begin = &Run::begin(scene);
    let unknown = ScenePlant::new(scene);
    let way = |plant| Way { plant, begin, end };
    let unknown = &way(&unknown);
    let known = known.as_ref().map(way);
    let exact = &unknown.after(Gauss::<Dd, 6>::new(), FINE);
    let mut outcomes = vec![];
    for name in INTEGRATORS {
        let known = known.as_ref().map(|way| (way, ", slopes known"));
        for (way, how) in [(unknown, "")].into_iter().chain(known) {
            if *name == "rodas4" && how.is_empty() {
                continue;
            }
            let error = |halvings| {
                let of = Error {
                    way,
                    exact,
                    halvings,
                };
                with_integrator(name, of).expect("a name of the list")
            };
            let (info, first) = error(0);
            if !info.reads_jacobian && !how.is_empty() {
                continue;
            }
            let errors = [first, error(1).1, error(2).1, error(3).1];
            let short = f64::from(info.order) - slope(&errors);
            let quantity = format!("order {} less the fitted one, {name}{how}", info.order);
            let at = format!("{end} s, errors {errors:?}");
            outcomes.push(Outcome::new(case, "8", quantity, short, 0.2).at(at));
        }
    }
    outcomes
}

/// The orders in scenes with spherical and floating joints.
pub(crate) fn free_orders(extent: Extent) -> Vec<Outcome> {
    macro_rules! of {
        ($module:ident, $model:ident, $end:literal, $slopes:expr) => {{
            let scene = scenes::$module::$model::<Dd>::default();
            of_scene(stringify!($module), &scene, $slopes(&scene), $end)
        }};
    }
    let mut all = of!(heavy_top_slow_cusp, HeavyTopSlowCusp, 0.1, known);
    all.extend(of!(spherical_pendulum, SphericalPendulum, 0.4, known));
    all.extend(of!(body_tumbling, BodyTumbling, 1.0, known));
    if extent == Extent::Full {
        // Its scene is compiled without slopes.
        all.extend(of!(satellite_torques, SatelliteTorques, 1.0, |_| None));
    }
    all
}

/// The scene with its slopes.
fn known<S: HybridSystem<Dd> + Slope<Dd>>(scene: &S) -> Option<ScenePlant<'_, S, Dd>> {
    Some(ScenePlant::with_slope(scene))
}
