//! Sampled controllers of compiled scenes: a block of 2 kg under efforts that are constant between two instants, whose
//! motion follows from them exactly.

use bgdyn::runtime::HybridSystem;
use bgdyn_runtime::random::Random;
use bgdyn_sim::{Dop853, Dopri5, Gauss2, Integrator, Rk4, Rodas4, Run, ScenePlant, Tolerance};

bgdyn::bgdyn!("servo.scene.yaml", jacobian = true);
bgdyn::bgdyn!("late.scene.yaml", jacobian = true);
bgdyn::bgdyn!("rough.scene.yaml", jacobian = true);

const MASS: f64 = 2.0;

/// Runs a scene to its end; `look` sees each step.
fn run<S, M>(scene: &S, integrator: M, step: f64, end: f64, mut look: impl FnMut(f64, &[f64], f64))
where
    S: HybridSystem<f64> + bgdyn_runtime::Slope<f64>,
    M: Integrator<S::State>,
{
    use bgdyn_runtime::StateVector as _;
    let controlled = integrator.info().estimate.is_some();
    let mut run = Run::by(integrator, ScenePlant::with_slope(scene), Run::begin(scene));
    if controlled {
        run = run.with_tolerance(Tolerance {
            absolute: 1e-11,
            relative: 1e-11,
        });
    }
    while end - run.t() > 1e-9 {
        run.step(step.min(end - run.t())).expect("a step");
        let input = run.plant().input(run.t(), run.y(), run.modes());
        look(run.t(), run.y().entries(), input.entries()[0]);
    }
    assert!(run.audit().drift().abs() < 1e-9, "{}", run.audit().drift());
}

/// The same by hand: place, velocity and integral part, under what acts.
#[derive(Clone, Copy, Default)]
struct ByHand {
    t: f64,
    q: f64,
    v: f64,
    z: f64,
    effort: f64,
    integral_rate: f64,
}

impl ByHand {
    fn reach(&mut self, t: f64) {
        let (h, a) = (t - self.t, self.effort / MASS);
        self.q += h * self.v + 0.5 * h * h * a;
        self.v += h * a;
        self.z += h * self.integral_rate;
        self.t = t;
    }
}

/// The block at `end` under a controller that is sampled at k · 50 ms and acts `delay` later.
fn by_hand(delay: f64, end: f64, controller: impl Fn(&ByHand) -> (f64, f64)) -> ByHand {
    let mut block = ByHand::default();
    let mut waiting: Vec<(f64, (f64, f64))> = Vec::new();
    let mut sample = 0.0;
    loop {
        let next = waiting.first().map_or(f64::INFINITY, |(at, _)| *at);
        let instant = f64::min(sample * 0.05, next);
        if instant > end {
            block.reach(end);
            return block;
        }
        block.reach(instant);
        if next <= sample * 0.05 {
            (block.effort, block.integral_rate) = waiting.remove(0).1;
        } else {
            waiting.push((instant + delay, controller(&block)));
            sample += 1.0;
        }
    }
}

/// Compares the ends of runs by integrators of every kind.
macro_rules! all_reach {
    ($scene:expr, $end:expr, $wanted:expr) => {{
        let (scene, wanted) = ($scene, $wanted);
        let check = |_: f64, y: &[f64], _: f64| {
            for (got, wanted) in y.iter().zip(wanted) {
                assert!((got - wanted).abs() < 1e-10, "{y:?}, not {wanted:?}");
            }
        };
        let last = |end: f64| {
            move |t: f64, y: &[f64], u: f64| {
                if end - t < 1e-9 {
                    check(t, y, u)
                }
            }
        };
        for step in [0.05, 0.013, 0.001] {
            run(&scene, Rk4, step, $end, last($end));
            run(&scene, Gauss2::default(), step, $end, last($end));
            run(&scene, Dopri5, step, $end, last($end));
            run(&scene, Dop853, step, $end, last($end));
            run(&scene, Rodas4, step, $end, last($end));
        }
    }};
}

#[test]
fn a_controller_acts_late_and_is_held() {
    let end = 1.013;
    let pd = |block: &ByHand| (10.0 * (1.0 - block.q) - 3.0 * block.v, 0.0);
    let wanted = by_hand(0.02, end, pd);
    all_reach!(servo::Servo::<f64>::default(), end, [wanted.q, wanted.v]);
    // A continuous controller moves the block by other ways.
    let continuous = by_hand(0.0, end, pd);
    assert!((wanted.q - continuous.q).abs() > 1e-3);
}

#[test]
fn a_delay_may_be_longer_than_the_period() {
    let end = 1.4;
    let pid = |block: &ByHand| {
        let target = if block.t < 0.12 { 0.0 } else { 1.0 };
        let error = target - block.q;
        let unlimited: f64 = 10.0 * error - 6.0 * block.v + block.z;
        let limited = unlimited.clamp(-8.0, 8.0);
        (limited, 2.0 * error + (limited - unlimited) / 0.5)
    };
    let wanted = by_hand(0.12, end, pid);
    all_reach!(
        late::Late::<f64>::default(),
        end,
        [wanted.q, wanted.v, wanted.z]
    );
}

#[test]
fn efforts_change_at_their_instants_only() {
    let mut seen: Vec<(f64, f64)> = Vec::new();
    run(
        &servo::Servo::<f64>::default(),
        Rk4,
        1e-3,
        0.2,
        |t, _, u| {
            if seen.last().is_none_or(|last| last.1 != u) {
                seen.push((t, u));
            }
        },
    );
    let instants: Vec<f64> = seen.iter().map(|(t, _)| *t).collect();
    // Nothing acts before the first delay is over.
    assert_eq!(seen[0].1, 0.0);
    for (got, wanted) in instants.iter().zip([0.001, 0.02, 0.07, 0.12, 0.17]) {
        assert!((got - wanted).abs() < 1e-9, "{instants:?}");
    }
    assert_eq!(instants.len(), 5);
    assert_eq!(seen[1].1, 10.0);
}

/// Sensors give multiples of their steps, with normal noise of the seed; efforts are multiples of theirs.
#[test]
fn sensors_have_noise_and_steps() {
    let mut random = Random(7);
    let mut normal = || {
        let radius = (-2.0 * (1.0 - random.unit()).ln()).sqrt();
        radius * (std::f64::consts::TAU * random.unit()).cos()
    };
    let steps = |x: f64, step: f64| (x / step).round() * step;
    let mut block = ByHand::default();
    let mut count = 0;
    run(
        &rough::Rough::<f64>::default(),
        Rk4,
        0.01,
        2.0,
        |t, y, effort| {
            // What has been sampled at the beginning of the step, and acts since.
            let q = steps(block.q + 0.004 * normal(), 0.001);
            let v = steps(block.v + 0.02 * normal(), 0.005);
            block.effort = steps(10.0 * (1.0 - q) - 3.0 * v, 0.25);
            block.reach(t);
            assert!(
                (y[0] - block.q).abs() < 1e-12 && (y[1] - block.v).abs() < 1e-12,
                "{t}: {y:?}"
            );
            assert_eq!((effort / 0.25).fract(), 0.0);
            count += 1;
        },
    );
    assert_eq!(count, 200);
}

/// A continuous law beside it has no sampler; nobody calls `reached`, so controllers are continuous.
#[test]
fn a_plant_that_nobody_samples_is_continuous() {
    let scene = servo::Servo::<f64>::default();
    let plant = ScenePlant::new(&scene);
    let (y, modes) = HybridSystem::<f64>::start(&scene);
    assert_eq!(plant.input(0.3, &y, &modes)[0], 10.0);
}
