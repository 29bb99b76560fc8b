//! Scenes with loops: reference motions to the digits of the files, order, energy, what closes, what is refused.

use bgdyn::nalgebra::SVector;
use bgdyn::runtime::wide::f64x4;
use bgdyn::runtime::{Dd, HybridSystem, StateVector as _};
use bgdyn_sim::lanes::{LaneRun, SmoothScene, packed, unpacked};
use bgdyn_sim::{
    Dop853, Gauss2, HybridState, Integrator, Midpoint, Reason, Rk4, Rodas4, Run, ScenePlant,
    SemiImplicitEuler, Tolerance,
};

use crate::andrews_run::AndrewsRun;
use crate::crank_run::{self, CrankRun};
use crate::five_bar_run::FiveBarRun;
use crate::motions::{numbers, reference};
use crate::slider_stop::SliderStop;
use crate::stewart_run::StewartRun;
use crate::swing::{self, Swing};

/// Runs to each sample of a reference by order 8, and compares all positions and velocities that the scene has.
fn follows<S: HybridSystem<f64>>(scene: &S, file: &str, velocities: &[usize], tolerance: f64) {
    let file = reference(file);
    let samples = file["samples"].as_array().expect("samples");
    let allowed = numbers(&file["tolerance_f64_per_sample"]);
    let nq = scene.positions();
    let run = Run::by(Dop853, ScenePlant::new(scene), Run::begin(scene));
    let mut run = run.with_tolerance(Tolerance {
        absolute: tolerance,
        relative: tolerance,
    });
    for (sample, &allowed) in samples.iter().zip(&allowed) {
        let sample = numbers(sample);
        while run.t() < sample[0] {
            let left = sample[0] - run.t();
            run.advance_densely(left).expect("it moves");
        }
        let y = run.y().entries().to_vec();
        let columns = (1..=nq).chain(velocities.iter().map(|&j| 1 + nq + j));
        for (k, column) in columns.enumerate() {
            let off = (y[k] - sample[column]).abs();
            let size = sample[column].abs().max(1.0);
            assert!(
                off <= allowed * size,
                "{} s, component {k}: {off:e}",
                sample[0]
            );
        }
    }
}

#[test]
fn scenes_follow_the_references() {
    follows(
        &CrankRun::<f64>::default(),
        "slider_crank.json",
        &[0],
        1e-13,
    );
    follows(
        &FiveBarRun::<f64>::default(),
        "five_bar_parallel.json",
        &[0, 2],
        1e-13,
    );
}

/// Three loops that meet in one pin, 50 ms: K1 turns to 34 rad, a rounding error of the start grows 24,000-fold.
#[test]
fn andrews_mechanism_follows_its_reference() {
    follows(&AndrewsRun::<f64>::default(), "andrews.json", &[0], 1e-13);
}

/// Springs, dampers and drives in 6 dependent joints.
#[test]
fn a_platform_on_driven_legs_follows_its_reference() {
    let platform = [0, 1, 2, 3, 4, 5];
    follows(
        &StewartRun::<f64>::default(),
        "stewart_platform.json",
        &platform,
        1e-13,
    );
}

/// The largest opening of the loops of the slider-crank: the step that would close them.
fn opening(scene: &CrankRun<f64>, y: &SVector<f64, { crank_run::N }>) -> f64 {
    let modes = SVector::zeros();
    scene
        .closing_step(&crank_run::State::from_vectors(y, &modes))
        .amax()
}

/// Errors against half the step, by method: the order is that of the method, and loops stay closed.
#[test]
fn methods_keep_their_order_in_loops() {
    fn end<M: Integrator<SVector<f64, { crank_run::N }>> + Clone>(method: &M, h: f64) -> f64 {
        let scene = CrankRun::<f64>::default();
        let plant = ScenePlant::with_differences(&scene);
        let mut run = Run::by(method.clone(), plant, Run::begin(&scene));
        let steps = (0.512 / h).round() as usize;
        for _ in 0..steps {
            run.step(h).expect("it moves");
            assert!(opening(&scene, run.y()) < 4.0 * f64::EPSILON);
        }
        run.y()[0]
    }
    fn order<M: Integrator<SVector<f64, { crank_run::N }>> + Clone>(method: &M, h: f64) -> f64 {
        let [a, b, c] = [h, h / 2.0, h / 4.0].map(|h| end(method, h));
        ((a - b) / (b - c)).abs().log2()
    }
    let orders = [
        ("semi_implicit_euler", 1.0, order(&SemiImplicitEuler, 2e-3)),
        ("midpoint", 2.0, order(&Midpoint::default(), 8e-3)),
        ("rk4", 4.0, order(&Rk4, 16e-3)),
        ("gauss2", 4.0, order(&Gauss2::default(), 16e-3)),
        ("rodas4", 4.0, order(&Rodas4, 8e-3)),
    ];
    for (name, wanted, found) in orders {
        assert!(found > wanted - 0.2, "{name}: order {found}");
    }
}

/// Stops, friction of bristles and friction that holds, a drive on a dependent joint: no energy is lost unaccounted.
#[test]
fn the_energy_of_a_slider_with_a_stop_adds_up() {
    let scene = SliderStop::<f64>::default();
    let mut run = Run::new(&scene);
    while run.t() < 2.0 {
        run.step(1e-4).expect("it moves");
    }
    assert!(run.events > 4, "stop and friction: {} events", run.events);
    let audit = run.audit();
    let (supplied, dissipated) = (audit.supplied.sum(), audit.dissipated.sum());
    assert!(dissipated > 1.0, "{dissipated} J are dissipated");
    let closed = audit.drift();
    assert!(
        closed.abs() < 1e-6 * dissipated,
        "{closed} J of {supplied} J"
    );
}

/// The start is closed to the rounding of the numbers in the code, and the velocity of a dependent joint is that of the
/// file.
#[test]
fn the_start_is_closed() {
    let scene = CrankRun::<f64>::default();
    let (y, modes) = HybridSystem::start(&scene);
    let step = scene.closing_step(&crank_run::State::from_vectors(&y, &modes));
    assert!(step.amax() < 4.0 * f64::EPSILON, "{step:?}");
    let scene = CrankRun::<f32>::default();
    let (mut y, modes) = HybridSystem::start(&scene);
    assert_eq!(HybridSystem::close(&scene, &mut y), Ok(true));
    let step = scene.closing_step(&crank_run::State::from_vectors(&y, &modes));
    assert!(step.amax() < 2.0 * f32::EPSILON, "{step:?}");
    let scene = CrankRun::<Dd>::default();
    let (mut y, modes) = HybridSystem::start(&scene);
    assert_eq!(HybridSystem::close(&scene, &mut y), Ok(true));
    let step = scene.closing_step(&crank_run::State::from_vectors(&y, &modes));
    assert!(step.iter().all(|x| x.to_f64().abs() < 1e-30), "{step:?}");
    let scene = SliderStop::<f64>::default();
    let (y, _) = HybridSystem::start(&scene);
    let mut rates = y;
    assert!(HybridSystem::position_rates(&scene, &y, &mut rates));
    assert!(
        (rates[2] - 0.3).abs() < 1e-15,
        "the slider starts at 0.3 m/s: {rates:?}"
    );
}

/// Gauss's method of order 4 in positions and independent velocities, 1 ms: the energy does not drift. The bound is that
/// of the reference table, 1.9e-10 of 3.139 J, times 1.5.
fn keeps_its_energy(steps: u32) {
    let scene = Swing::<f64>::default();
    let plant = ScenePlant::new(&scene);
    let mut run = Run::by(Gauss2::default(), plant, Run::begin(&scene));
    let energy = |run: &Run<ScenePlant<'_, Swing<f64>, f64>, Gauss2<f64>>| -> f64 {
        let (y, modes, none) = (run.y(), SVector::zeros(), SVector::zeros());
        HybridSystem::energy(&scene, y, &modes, &none, 0.0)
            .iter()
            .sum()
    };
    let start = energy(&run);
    let mut worst = 0.0_f64;
    for _ in 0..steps {
        run.step(1e-3).expect("it turns");
        worst = worst.max((energy(&run) - start).abs());
        let state = swing::State::from_vectors(run.y(), &SVector::zeros());
        let open = scene.closing_step(&state).amax();
        assert!(open <= 4.0 * f64::EPSILON, "open by {open:e}");
    }
    assert!(worst < 1.5 * 1.9e-10 * 3.139, "{worst:e} J");
}

#[test]
fn a_slider_crank_without_losses_keeps_its_energy() {
    keeps_its_energy(5000);
}

#[test]
#[ignore = "1e6 steps: .ci/long"]
fn a_slider_crank_without_losses_keeps_its_energy_for_a_million_steps() {
    keeps_its_energy(1_000_000);
}

/// A crank that cannot turn fully ends at a singular position, with the loop's name.
#[test]
fn a_dead_point_names_its_loop() {
    let scene = crate::short_rod::ShortRod::<f64>::default();
    let mut run = Run::new(&scene);
    let failure = loop {
        match run.step(1e-3) {
            Ok(_) => assert!(run.t() < 10.0, "it stops before"),
            Err(failure) => break failure,
        }
    };
    assert!(failure.y.iter().all(|x| x.is_finite()));
    let Reason::Singular(singular) = failure.reason else {
        panic!("{failure:?}");
    };
    assert!(format!("{singular}").contains("rod_pin"), "{singular}");
}

#[test]
fn loops_move_in_lanes_as_alone() {
    type Wide = SVector<f64x4, { crank_run::N }>;
    let scene = CrankRun::<f64>::default();
    let HybridState { t, y, modes } = Run::begin(&scene);
    let starts: [SVector<f64, { crank_run::N }>; 4] = std::array::from_fn(|k| {
        let mut y = y;
        y[3] += 0.3 * k as f64;
        y
    });
    let alone = starts.map(|y| {
        let from = HybridState { t, y, modes };
        let mut run = Run::by(Rk4, ScenePlant::new(&scene), from);
        (0..200).for_each(|_| {
            run.step(1e-3).expect("it turns");
        });
        *run.y()
    });
    let wide = CrankRun::<f64x4>::default();
    let ode = SmoothScene::new(&wide);
    let mut run = LaneRun::<Wide>::new(packed(&starts));
    (0..200).for_each(|_| run.step(&Rk4, &ode, 1e-3));
    for (k, wanted) in alone.iter().enumerate() {
        let found = unpacked(run.y(), k);
        assert!((found - wanted).amax() < 1e-14, "lane {k}");
        assert_eq!(run.ended(k), None);
    }
}
