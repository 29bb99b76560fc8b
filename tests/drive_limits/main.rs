//! Tests limits of voltage and current, and losses of gears: motions past them converge with the order of
//! the integrator, and the limits are satisfied to rounding.

use bgdyn::nalgebra::SVector;
use bgdyn_sim::{
    HybridState, Integrator, Plant, Rk4, Run, ScenePlant, Tolerance, WithIntegrator,
    with_integrator,
};

bgdyn::bgdyn!("winding.scene.yaml", jacobian = true);
bgdyn::bgdyn!("at_once.scene.yaml", jacobian = true);
bgdyn::bgdyn!("geared.scene.yaml", jacobian = true);

/// Limit of the current, A.
const LIMIT: f64 = 25.0;

/// The end of the runs, s.
const END: f64 = 0.3;

/// The state after `END` by an integrator in `steps` equal steps, with counts of events.
struct Ended<const N: usize> {
    y: SVector<f64, N>,
    events: usize,
    kinks: usize,
    largest_current: f64,
}

struct Winding(usize);

impl WithIntegrator<SVector<f64, 3>> for Winding {
    type Output = Ended<3>;

    fn with<M: Integrator<SVector<f64, 3>>>(self, method: M) -> Ended<3> {
        let scene = winding::Winding::<f64>::default();
        let begin = Run::begin(&scene);
        let run = Run::by(method, ScenePlant::with_slope(&scene), begin);
        ended(run, self.0, |y| y[2])
    }
}

struct AtOnce(usize);

impl WithIntegrator<SVector<f64, 2>> for AtOnce {
    type Output = Ended<2>;

    fn with<M: Integrator<SVector<f64, 2>>>(self, method: M) -> Ended<2> {
        let scene = at_once::AtOnce::<f64>::default();
        let begin = Run::begin(&scene);
        let run = Run::by(method, ScenePlant::with_slope(&scene), begin);
        ended(run, self.0, |_| 0.0)
    }
}

struct Geared(usize);

impl WithIntegrator<SVector<f64, 3>> for Geared {
    type Output = Ended<3>;

    fn with<M: Integrator<SVector<f64, 3>>>(self, method: M) -> Ended<3> {
        let scene = geared::Geared::<f64>::default();
        let begin = Run::begin(&scene);
        let run = Run::by(method, ScenePlant::with_slope(&scene), begin);
        ended(run, self.0, |y| y[2])
    }
}

fn ended<P, M, const N: usize>(
    mut run: Run<P, M>,
    steps: usize,
    current: impl Fn(&SVector<f64, N>) -> f64,
) -> Ended<N>
where
    P: Plant<State = SVector<f64, N>>,
    M: Integrator<SVector<f64, N>>,
{
    let mut largest = 0.0_f64;
    for k in 0..steps {
        let stepped = run.step(END / steps as f64);
        stepped.unwrap_or_else(|failure| panic!("step {k} of {steps}: {failure:?}"));
        largest = largest.max(current(run.y()).abs());
    }
    Ended {
        y: *run.y(),
        events: run.events,
        kinks: run.kinks,
        largest_current: largest,
    }
}

/// Returns the order from errors with repeatedly halved steps, by least squares over their logarithms: the
/// distance of the steps from the events varies, so that a single halving gives no reliable order.
fn order(errors: &[f64]) -> f64 {
    let middle = (errors.len() as f64 - 1.0) / 2.0;
    let parts = errors.iter().enumerate().map(|(k, e)| {
        let k = k as f64 - middle;
        (-k * e.log2(), k * k)
    });
    let (sum, squares) = parts.fold((0.0, 0.0), |s, p| (s.0 + p.0, s.1 + p.1));
    sum / squares
}

/// Checks an integrator's errors for this order.
fn converges(name: &str, errors: &[f64], wanted: f64) {
    let above: Vec<f64> = errors.iter().copied().filter(|e| *e > ROUNDING).collect();
    let found = order(&above);
    println!("{name}: {errors:?}, order {found:.2}");
    let last = errors[errors.len() - 1];
    assert!(
        last < ROUNDING || found > wanted - 0.35,
        "{name}: {errors:?}"
    );
}

/// Rounding error of the results, rad and rad/s.
const ROUNDING: f64 = 1e-12;

/// Integrators with their orders.
const FIXED: [(&str, f64); 7] = [
    ("rk4", 4.0),
    ("midpoint", 2.0),
    ("gauss2", 4.0),
    ("gauss3", 6.0),
    ("rodas4", 4.0),
    ("dopri5", 5.0),
    ("dop853", 8.0),
];

#[test]
fn a_limited_winding_converges_with_the_order_of_the_method() {
    let run = |name: &str, steps| with_integrator(name, Winding(steps)).expect("in the list");
    let right = run("gauss3", 9600).y;
    for (name, wanted) in FIXED {
        let runs = [1200, 2400, 4800, 9600].map(|steps| run(name, steps));
        for run in &runs {
            assert!(
                run.largest_current <= LIMIT * (1.0 + 4.0 * f64::EPSILON),
                "{name}: {} A",
                run.largest_current
            );
            // The limits of the current are reached four times and left three times, those of the voltage
            // left and reached seven times.
            assert_eq!((run.events, run.kinks), (7, 7), "{name}");
        }
        let errors = runs.map(|run| (run.y - right).fixed_rows::<2>(0).norm());
        converges(name, &errors, wanted);
    }
}

#[test]
fn a_limited_current_without_inductance_converges_with_the_order_of_the_method() {
    let run = |name: &str, steps| with_integrator(name, AtOnce(steps)).expect("in the list");
    let right = run("gauss3", 4800).y;
    for (name, wanted) in FIXED {
        // Within the step that ends at a kink, stages of explicit methods may pass it by O(h³).
        let wanted = wanted.min(4.0);
        let runs = [300, 600, 1200, 2400, 4800].map(|steps| run(name, steps));
        assert!(runs.iter().all(|run| run.kinks == 13), "{name}");
        let errors = runs.map(|run| (run.y - right).fixed_rows::<2>(0).norm());
        converges(name, &errors, wanted);
    }
}

/// A motion that reverses under load, during which the losses hold the joint for a while.
#[test]
fn a_gear_with_losses_converges_with_the_order_of_the_method() {
    let run = |name: &str, steps| with_integrator(name, Geared(steps)).expect("in the list");
    let right = run("gauss3", 4800).y;
    for (name, wanted) in FIXED {
        let runs = [300, 600, 1200, 2400].map(|steps| run(name, steps));
        // The gear holds, is released, reverses; the load changes its sign twice.
        let seen: Vec<_> = runs.iter().map(|run| (run.events, run.kinks)).collect();
        assert_eq!(seen, [(3, 2); 4], "{name}");
        let errors = runs.map(|run| (run.y - right).fixed_rows::<2>(0).norm());
        converges(name, &errors, wanted);
    }
}

/// A gear that its load cannot drive backwards holds it without effort of the motor, and releases it if
/// the load exceeds the losses: a weight G on a motor's τ is between η τ and τ/η.
#[test]
fn a_gear_holds_what_its_losses_can_hold() {
    let scene = geared::Geared::<f64>::default();
    let mut run = Run::new(&scene);
    let mut held = 0;
    for _ in 0..3000 {
        run.step(1e-4).expect("a step");
        let (y, mode) = (run.y(), run.modes()[0]);
        if mode == 0.0 {
            let (load, effort) = (400.0 * y[0], 2.6 * y[2]);
            let (less, more) = (effort * 0.6, effort / 0.6);
            assert!(less.min(more) - 1e-9 < load && load < less.max(more) + 1e-9);
            assert_eq!(y[1], 0.0);
            held += 1;
        } else {
            assert!(mode * y[1] >= 0.0, "mode {mode}, rate {}", y[1]);
        }
    }
    assert!((394..398).contains(&held), "held in {held} steps");
    let audit = run.audit();
    assert!(audit.drift().abs() < 1e-6, "{}", audit.drift());
}

/// With step control the end state does not depend on the sequence of steps.
#[test]
fn controlled_steps_agree_over_the_limits() {
    let scene = winding::Winding::<f64>::default();
    let end = |tolerance: f64| {
        let begin = Run::begin(&scene);
        let run = Run::by(bgdyn_sim::Dop853, ScenePlant::with_slope(&scene), begin);
        let tolerance = Tolerance {
            absolute: tolerance,
            relative: tolerance,
        };
        let ended = ended(run.with_tolerance(tolerance), 1, |y| y[2]);
        assert_eq!(ended.events, 7);
        ended.y
    };
    let (rough, fine) = (end(1e-9), end(1e-13));
    for k in 0..3 {
        let size = fine[k].abs().max(1.0);
        assert!((rough[k] - fine[k]).abs() < 1e-6 * size, "{rough} {fine}");
    }
}

/// While it is held, the current is constant, and the power that the amplifier supplies is that of the
/// winding and the joint.
#[test]
fn a_held_current_keeps_the_balance_of_power() {
    let scene = winding::Winding::<f64>::default();
    let mut run = Run::new(&scene);
    let mut held = 0;
    for _ in 0..500 {
        run.step(1e-4).expect("a step");
        let modes = run.modes();
        if modes.iter().any(|mode| *mode == 0.0) {
            assert_eq!(run.y()[2].abs(), LIMIT);
            held += 1;
        }
    }
    assert!(held > 50, "held in {held} steps");
    let audit = run.audit();
    assert!(audit.drift().abs() < 1e-6, "{}", audit.drift());
}

/// After the limit is lowered between two steps, the current falls to it with the time constant L/R, and
/// is held again.
#[test]
fn a_current_beyond_a_lowered_limit_falls_to_it() {
    let mut scene = winding::Winding::<f64>::default();
    let begin = Run::begin(&scene);
    let mut run = Run::by(Rk4, ScenePlant::new(&scene), begin);
    for _ in 0..20 {
        run.step(1e-4).expect("a step");
    }
    assert_eq!(run.y()[2], LIMIT);
    let from = HybridState {
        t: run.t(),
        y: *run.y(),
        modes: *run.modes(),
    };
    scene.most = 10.0;
    let mut run = Run::by(Rk4, ScenePlant::new(&scene), from);
    for _ in 0..10 {
        run.step(1e-4).expect("a step");
    }
    // L/R = 1 ms.
    let wanted = 10.0 + 15.0 * (-1.0_f64).exp();
    assert!((run.y()[2] - wanted).abs() < 1e-3, "{} A", run.y()[2]);
}
