//! Checks that runs in lanes and by several threads equal scalar runs bit for bit.

use bgdyn_codegen::random::Random;
use std::num::NonZeroUsize;

use bgdyn::nalgebra::SVector;
use bgdyn::runtime::HybridSystem;
use bgdyn::runtime::wide::{f32x4, f32x8, f64x2, f64x4, f64x8};
use bgdyn::{Dynamics, Scalar};
use bgdyn_sim::batch::{FixedSteps, batch, outcome};
use bgdyn_sim::lanes::{Driven, LaneError, LaneRun, Lanes, SmoothScene, packed, unpacked};
use bgdyn_sim::{HybridState, Integrator, Ode, Rk4, Run, ScenePlant, SemiImplicitEuler, Solver};

use crate::models::scara4::Scara4;
use crate::models::spherical_pendulum::SphericalPendulum;
use crate::models::vector;

bgdyn::bgdyn!("../../specs/scenes/puma_distributed.scene.yaml");
use puma_distributed::PumaDistributed;

const STEPS: usize = 200;

fn starts<S: Scalar, const N: usize>(count: usize, seed: u64) -> Vec<SVector<S, N>> {
    let mut random = Random(seed);
    let mut start = || vector::<N>(&mut random, 0.8).map(S::from_f64);
    (0..count).map(|_| start()).collect()
}

/// Efforts with damping and a function of time.
fn efforts<T: Scalar, const N: usize>(t: T, _: &SVector<T, N>, v: &SVector<T, N>) -> SVector<T, N> {
    let (sine, _) = (t * T::from_f64(7.0)).sin_cos();
    v.map(|v| sine - T::from_f64(0.3) * v)
}

/// Returns the end of a scalar run.
fn alone<O: Ode, M: Integrator<O::State>>(
    ode: &O,
    method: M,
    start: O::State,
    h: bgdyn_sim::ScalarOf<O>,
) -> Option<O::State>
where
    bgdyn_sim::ScalarOf<O>: bgdyn_sim::Real,
{
    let zero = Scalar::from_f64(0.0);
    let mut solver = Solver::new(method, zero, start);
    for _ in 0..STEPS {
        solver.advance(ode, h).ok()?;
    }
    Some(solver.y().clone())
}

/// Returns the ends of runs of a mechanism in lanes, `None` if a lane ended early.
fn together<T, M, D, const N: usize, const Y: usize>(
    model: &D,
    method: &M,
    starts: &[SVector<T::Word, Y>],
    h: f64,
) -> Vec<Option<SVector<T::Word, Y>>>
where
    T: Lanes,
    M: Integrator<SVector<T, Y>>,
    D: Dynamics<T, N, N>,
{
    let ode = Driven::<T, _, _, N, Y>::new(model, efforts);
    let mut run = LaneRun::new(packed::<T, Y>(starts));
    for _ in 0..STEPS {
        run.step(method, &ode, h);
    }
    let end = |k| run.ended(k).is_none().then(|| unpacked(run.y(), k));
    (0..starts.len()).map(end).collect()
}

macro_rules! mechanism_in {
    ($method:expr, $($lanes:ident: $float:ident, $n:literal;)*) => {$({
        let starts = starts::<$float, 8>($n, 5);
        let model = Scara4::<$lanes>::default();
        let found = together::<$lanes, _, _, 4, 8>(&model, &$method, &starts, 1e-3);
        let model = Scara4::<$float>::default();
        let ode = Driven::<$float, _, _, 4, 8>::new(&model, efforts);
        for (k, start) in starts.iter().enumerate() {
            let wanted = alone(&ode, $method, *start, 1e-3_f64 as $float);
            assert!(wanted.is_some());
            let bits = |y: SVector<$float, 8>| y.map($float::to_bits);
            assert_eq!(found[k].map(bits), wanted.map(bits), "lane {k}");
        }
    })*};
}

#[test]
fn a_mechanism_runs_in_lanes_as_alone() {
    mechanism_in!(Rk4, f64x2: f64, 2; f64x4: f64, 4; f64x8: f64, 8; f32x4: f32, 4; f32x8: f32, 8;);
    mechanism_in!(SemiImplicitEuler, f64x4: f64, 4; f64x8: f64, 8;);
}

#[test]
fn a_lane_that_fails_leaves_the_others_alone() {
    for failing in 0..4 {
        let mut starts = starts::<f64, 4>(4, 11);
        for start in &mut starts {
            start[1] += 1.5;
        }
        // In the upright position the azimuth moves no inertia: its pivot vanishes.
        starts[failing] = SVector::zeros();
        let model = SphericalPendulum::<f64x4>::default();
        let found = together::<f64x4, _, _, 2, 4>(&model, &Rk4, &starts, 1e-3);
        let model = SphericalPendulum::<f64>::default();
        let ode = Driven::<f64, _, _, 2, 4>::new(&model, efforts);
        for (k, start) in starts.iter().enumerate() {
            assert_eq!(found[k].is_none(), k == failing, "lane {k}");
            assert_eq!(found[k], alone(&ode, Rk4, *start, 1e-3), "lane {k}");
        }
    }
}

/// Returns the ends of scalar runs of the scene by this number of threads.
fn by_threads(starts: &[SVector<f64, 6>], threads: usize) -> Vec<[SVector<f64, 6>; 4]> {
    let scene = PumaDistributed::<f64>::default();
    let threads = NonZeroUsize::new(threads).expect("some");
    let steps = FixedSteps {
        step: 1e-3,
        steps: STEPS,
    };
    let one = |&y: &SVector<f64, 6>| {
        let modes = SVector::<f64, 0>::zeros();
        let from = HybridState { t: 0.0, y, modes };
        let run = Run::by(Rk4, ScenePlant::new(&scene), from);
        // The array of nalgebra's vector as a slice of numbers.
        let seen = outcome(run, steps, |plant, t, y, modes| {
            <[f64; 6]>::from(plant.output(t, y, modes))
        });
        assert!(seen.failure.is_none());
        let [last, low, high] = [seen.last, seen.low, seen.high].map(SVector::from);
        for i in 0..6 {
            assert!(low[i] <= last[i] && last[i] <= high[i]);
        }
        [seen.end.y, last, low, high]
    };
    let mut heard = 0;
    let found = batch(starts, threads, one, |done| heard = done);
    assert_eq!(heard, starts.len());
    found
}

/// Returns the ends of runs of the scene in lanes, with groups on two threads.
fn in_lanes<T: Lanes<Word = f64>>(starts: &[SVector<f64, 6>]) -> Vec<[SVector<f64, 6>; 2]>
where
    PumaDistributed<T>: Default + Sync,
    PumaDistributed<T>: HybridSystem<
            T,
            State = SVector<T, 6>,
            Modes = SVector<T, 0>,
            Outputs = SVector<T, 6>,
            Singular: LaneError<T>,
        >,
{
    let scene = PumaDistributed::<T>::default();
    let groups: Vec<&[SVector<f64, 6>]> = starts.chunks(T::LANES).collect();
    let one = |group: &&[SVector<f64, 6>]| {
        let ode = SmoothScene::new(&scene);
        let mut run = LaneRun::new(packed::<T, 6>(group));
        for _ in 0..STEPS {
            run.step(&Rk4, &ode, 1e-3);
        }
        let seen = ode.output(run.t(), run.y());
        let end = |k| [unpacked(run.y(), k), unpacked(&seen, k)];
        (0..group.len()).map(end).collect::<Vec<_>>()
    };
    let two = NonZeroUsize::new(2).expect("some");
    batch(&groups, two, one, |_| {}).concat()
}

#[test]
fn a_scene_runs_by_threads_and_in_lanes_as_alone() {
    // Not a multiple of the number of lanes.
    let starts = starts::<f64, 6>(19, 3);
    let wanted = by_threads(&starts, 1);
    for threads in [2, 3] {
        assert_eq!(by_threads(&starts, threads), wanted, "{threads} threads");
    }
    let ends: Vec<_> = wanted.iter().map(|&[y, last, ..]| [y, last]).collect();
    assert_eq!(in_lanes::<f64>(&starts), ends);
    assert_eq!(in_lanes::<f64x4>(&starts), ends);
    assert_eq!(in_lanes::<f64x8>(&starts), ends);
}
