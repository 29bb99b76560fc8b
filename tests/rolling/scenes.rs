//! Scenes with wheels and knife edges: reference motions at every sample, orders, energies.

use bgdyn::nalgebra::SVector;
use bgdyn::runtime::{HybridSystem, StateVector as _};
use bgdyn_sim::{
    Dop853, Gauss2, Integrator, Moreau, Rk4, Rodas4, Run, ScenePlant, SemiImplicitEuler, Tolerance,
};

use crate::bicycle_run::{self, BicycleRun};
use crate::effects::Effects;
use crate::motions::Reference;
use crate::robot_run::RobotRun;
use crate::sleigh_run::{self, SleighRun};
use crate::snakeboard_run::SnakeboardRun;

/// Runs to each sample by order 8; `compared` returns pairs of values of the state and of the reference.
fn follows<S: HybridSystem<f64>>(
    scene: &S,
    file: &Reference,
    compared: impl Fn(&[f64], usize) -> Vec<(f64, f64)>,
    allowed: impl Fn(usize) -> f64,
) {
    let run = Run::by(Dop853, ScenePlant::new(scene), Run::begin(scene));
    let mut run = run.with_tolerance(Tolerance {
        absolute: 1e-13,
        relative: 1e-13,
    });
    for k in 0..file.samples.len() {
        let t = file.at(k, "t");
        while run.t() < t {
            run.advance_densely(t - run.t()).expect("it rolls");
        }
        for (i, (found, wanted)) in compared(run.y().entries(), k).into_iter().enumerate() {
            let off = (found - wanted).abs();
            let most = allowed(k) * wanted.abs().max(1.0);
            assert!(
                off <= most,
                "{t} s, value {i}: {found} instead of {wanted}, {off:e}"
            );
        }
    }
}

#[test]
fn sleigh_and_robot_follow_their_references() {
    let file = Reference::read("chaplygin_sleigh.json");
    let columns = ["x", "y", "theta", "v", "omega"];
    let compared = |y: &[f64], k: usize| {
        let pair = |(i, column): (usize, &&str)| (y[i], file.at(k, column));
        columns.iter().enumerate().map(pair).collect()
    };
    follows(&SleighRun::<f64>::default(), &file, compared, |_| 1e-11);
    let file = Reference::read("differential_drive.json");
    let columns = [(0, "x"), (1, "y"), (2, "theta"), (5, "wR"), (6, "wL")];
    let compared = |y: &[f64], k: usize| {
        let pair = |&(i, column): &(usize, &str)| (y[i], file.at(k, column));
        columns.iter().map(pair).collect()
    };
    follows(&RobotRun::<f64>::default(), &file, compared, |_| 1e-11);
}

#[test]
fn the_snakeboard_follows_its_reference() {
    let file = Reference::read("snakeboard.json");
    let allowed = file.tolerances.clone();
    let columns = [
        (0, "x"),
        (1, "y"),
        (2, "board"),
        (3, "rotor"),
        (4, "front_axle"),
        (6, "rotor_rate"),
    ];
    let compared = |y: &[f64], k: usize| {
        let pair = |&(i, column): &(usize, &str)| (y[i], file.at(k, column));
        columns.iter().map(pair).collect()
    };
    follows(&SnakeboardRun::<f64>::default(), &file, compared, |k| {
        allowed[k]
    });
}

/// Both wheels stay on the ground, by the height and the pitch of the frame.
#[test]
fn the_bicycle_follows_its_reference() {
    let file = Reference::read("whipple_bicycle.json");
    let allowed = file.tolerances.clone();
    let names = [
        "x",
        "y",
        "yaw",
        "z",
        "lean",
        "rear_frame",
        "rear_wheel",
        "fork",
        "front_wheel",
    ];
    let rates = ["lean_rate", "rear_wheel_rate", "fork_rate"];
    let scene = BicycleRun::<f64>::default();
    let index = |name: &str| {
        let mut all = bicycle_run::STATE_NAMES.iter();
        all.position(|own| *own == name)
            .expect("a part of the state")
    };
    let own = [
        "ground_x",
        "ground_y",
        "ground_turn",
        "height",
        "lean",
        "pitch",
        "rear_spin",
        "steer",
        "front_spin",
        "lean_rate",
        "rear_spin_rate",
        "steer_rate",
    ];
    let compared = |y: &[f64], k: usize| {
        let all = names.iter().chain(&rates);
        let pair = |(own, column): (&&str, &&str)| (y[index(own)], file.at(k, column));
        own.iter().zip(all).map(pair).collect()
    };
    follows(&scene, &file, compared, |k| allowed[k]);
}

/// q̇ = N(q) S(q) u of a body that turns: each method keeps its order.
#[test]
fn methods_keep_their_order_on_a_blade() {
    type State = SVector<f64, { sleigh_run::N }>;
    fn end<M: Integrator<State> + Clone>(method: &M, h: f64) -> State {
        let scene = SleighRun::<f64>::default();
        let plant = ScenePlant::with_differences(&scene);
        let mut run = Run::by(method.clone(), plant, Run::begin(&scene));
        for _ in 0..(2.048 / h).round() as usize {
            run.step(h).expect("it slides");
        }
        *run.y()
    }
    fn order<M: Integrator<State> + Clone>(method: &M, h: f64) -> f64 {
        let [a, b, c] = [h, h / 2.0, h / 4.0].map(|h| end(method, h));
        ((a - b).norm() / (b - c).norm()).log2()
    }
    let orders = [
        ("semi_implicit_euler", 1.0, order(&SemiImplicitEuler, 8e-3)),
        ("moreau", 2.0, order(&Moreau::default(), 16e-3)),
        ("rk4", 4.0, order(&Rk4, 64e-3)),
        ("gauss2", 4.0, order(&Gauss2::default(), 64e-3)),
        ("rodas4", 4.0, order(&Rodas4, 32e-3)),
    ];
    for (name, wanted, found) in orders {
        assert!(found > wanted - 0.2, "{name}: order {found}");
    }
}

/// Friction that holds at the wheels, dampers at velocities that follow, a force along one, a spring to the world.
#[test]
fn the_energy_of_a_cart_adds_up() {
    let scene = Effects::<f64>::default();
    let mut run = Run::new(&scene);
    while run.t() < 5.0 {
        run.step(1e-3).expect("it rolls");
    }
    assert!(run.events > 2, "friction holds: {} events", run.events);
    let audit = run.audit();
    let (dissipated, closed) = (audit.dissipated.sum(), audit.drift());
    assert!(dissipated > 0.05, "{dissipated} J are dissipated");
    assert!(
        closed.abs() < 1e-7 * dissipated,
        "{closed:e} J of {dissipated} J"
    );
}
