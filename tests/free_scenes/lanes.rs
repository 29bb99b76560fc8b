//! Runs in lanes: each lane is the run alone, bit for bit.

use bgdyn::nalgebra::SVector;
use bgdyn::runtime::wide::f64x4;
use bgdyn_sim::lanes::{LaneRun, SmoothScene, packed, unpacked};
use bgdyn_sim::{HybridState, Integrator, Rk4, Run, ScenePlant, SemiImplicitEuler};

use crate::heavy_top_run::{HeavyTopRun, N};

type Top = SVector<f64, N>;
type Tops = SVector<f64x4, N>;

const STEPS: usize = 200;
const STEP: f64 = 1e-3;

fn a_lane_is_a_run_alone<M: Integrator<Top> + Integrator<Tops> + Clone>(method: M) {
    let scene = HeavyTopRun::<f64>::default();
    let HybridState { t, y, modes } = Run::begin(&scene);
    let starts: [Top; 4] = std::array::from_fn(|k| {
        let mut y = y;
        y[N - 1] += 0.3 * k as f64;
        y
    });
    let alone = starts.map(|y| {
        let from = HybridState { t, y, modes };
        let mut run = Run::by(method.clone(), ScenePlant::new(&scene), from);
        (0..STEPS).for_each(|_| {
            run.step(STEP).expect("it turns");
        });
        *run.y()
    });
    let wide = HeavyTopRun::<f64x4>::default();
    let ode = SmoothScene::new(&wide);
    let mut run = LaneRun::new(packed::<f64x4, N>(&starts));
    (0..STEPS).for_each(|_| run.step(&method, &ode, STEP));
    for (k, wanted) in alone.iter().enumerate() {
        assert_eq!(unpacked(run.y(), k), *wanted, "lane {k}");
    }
    assert_ne!(alone[0], alone[1]);
}

#[test]
fn quaternions_move_in_lanes_as_alone() {
    a_lane_is_a_run_alone(Rk4);
    a_lane_is_a_run_alone(SemiImplicitEuler);
}
