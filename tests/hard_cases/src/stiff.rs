//! Stiff motions: by integrators with steps much longer than the fastest time constant, and by the
//! integrator of order 8 where that is resolved.

use bgdyn_sim::{Dop853, Gauss3, HybridState, Rodas4, Run, ScenePlant};
use nalgebra::SVector;

use crate::follow::{alike, controlled, fixed, of, relative};
use crate::outcome::Outcome;
use crate::reference::reference;
use crate::{Extent, scenes};

/// Time at which the cylinder's pressures have settled, s.
const SETTLED: f64 = 0.02;

/// A motor whose current settles within 1e-5 s, with steps of 1e-2 s.
pub(crate) fn motor_linear_stiff(_: Extent) -> Vec<Outcome> {
    let case = "motor_linear_stiff";
    let reference = reference!("motor_linear_stiff").only(|_, t| t >= 0.1);
    let scene = scenes::motor_linear_stiff::MotorLinearStiff::<f64>::default();
    let (plant, begin) = (ScenePlant::with_slope(&scene), Run::begin(&scene));
    let states = fixed(Rodas4, 1e-2, &plant, &begin, &reference.times);
    // State: angle, rate, current.
    let found = of(&states, |y| vec![y[1], y[0]]);
    let deviations = reference.relative(&["omega", "theta"], &found, 1e-6);
    let quantity = "rate, angle, relative; rodas4, 10 ms";
    vec![Outcome::worst(case, "9", quantity, deviations)]
}

/// A load on a hydraulic cylinder: pressures that settle within 1e-5 s … 1e-3 s, a load that oscillates on
/// the oil at 200 rad/s. With step control; and, from 20 ms on, with steps 50 times longer than the
/// fastest time constant.
pub(crate) fn hydraulic_cylinder(_: Extent) -> Vec<Outcome> {
    let case = "hydraulic_cylinder";
    let reference = reference!("hydraulic_cylinder").only(|_, t| t >= SETTLED);
    let scene = scenes::hydraulic_cylinder::HydraulicCylinder::<f64>::default();
    let (plant, begin) = (ScenePlant::with_slope(&scene), Run::begin(&scene));
    let settled = controlled(Rodas4, relative(1e-11), &plant, &begin, &[SETTLED]);
    let from = HybridState {
        t: SETTLED,
        y: settled[0],
        modes: begin.modes,
    };
    let times = &reference.times;
    let controlled = controlled(Rodas4, relative(1e-9), &plant, &begin, times);
    let fixed = fixed(Rodas4, 5e-4, &plant, &from, times);
    let runs = [
        (
            controlled,
            "place, rate, relative; rodas4 at 1e-9",
            "pressures, relative; rodas4 at 1e-9",
        ),
        (
            fixed,
            "place, rate, relative; rodas4, 0.5 ms",
            "pressures, relative; rodas4, 0.5 ms",
        ),
    ];
    let mut outcomes = vec![];
    for (states, motion, pressures) in runs {
        let outputs = of(&states, |y| {
            let output = plant.output(0.0, y, &begin.modes);
            output.as_slice().to_vec()
        });
        let moved = of(&outputs, |output| output[..2].to_vec());
        let pressed = of(&outputs, |output| output[2..].to_vec());
        let moved = reference.relative(&["x", "v"], &moved, 1e-6);
        let pressed = reference.relative(&["p1", "p2", "pl"], &pressed, 1e-5);
        outcomes.push(Outcome::worst(case, "9", motion, moved));
        outcomes.push(Outcome::worst(case, "9", pressures, pressed));
    }
    outcomes
}

/// A mass that swings on a stiff spring and oscillates along it at 1600 times the frequency. Its length is
/// 1 m plus the stretch.
pub(crate) fn stiff_spring_pendulum(_: Extent) -> Vec<Outcome> {
    let case = "stiff_spring_pendulum";
    let reference = reference!("stiff_spring_pendulum");
    let scene = scenes::stiff_spring_stretch::StiffSpringStretch::<f64>::default();
    let (plant, begin) = (ScenePlant::with_slope(&scene), Run::begin(&scene));
    let times = &reference.times;
    let resolved = controlled(Dop853, alike(1e-14), &plant, &begin, times);
    let long = fixed(Rodas4, 4e-3, &plant, &begin, times);
    let kept = fixed(Gauss3::new(), 4e-3, &plant, &begin, times);
    // State: angle, stretch, their rates.
    let swing = |states: &[SVector<f64, 4>], allowed| {
        let found = of(states, |y| vec![y[0], y[2]]);
        reference.some(&["theta", "theta_dot"], &found, allowed)
    };
    let length = of(&resolved, |y| vec![1.0 + y[1]]);
    let length = reference.some(&["r"], &length, 1e-15);
    vec![
        Outcome::worst(
            case,
            "9",
            "angle, rate; dop853 at 1e-14",
            swing(&resolved, 1e-10),
        ),
        Outcome::worst(case, "9", "length; dop853 at 1e-14", length),
        Outcome::worst(case, "9", "angle, rate; rodas4, 4 ms", swing(&long, 1e-6)),
        Outcome::worst(case, "9", "angle, rate; gauss3, 4 ms", swing(&kept, 1e-6)),
    ]
}

/// Two masses that oscillate together on a soft spring, and 2100 times as fast against each other: the
/// whole motion, and its slow part with steps 120 times longer than a radian of the fast one.
pub(crate) fn stiff_spring_two_mass(_: Extent) -> Vec<Outcome> {
    let case = "stiff_spring_two_mass";
    let reference = reference!("stiff_spring_two_mass");
    let scene = scenes::stiff_spring_two_mass::StiffSpringTwoMass::<f64>::default();
    let (plant, begin) = (ScenePlant::with_slope(&scene), Run::begin(&scene));
    let times = &reference.times;
    // State: position of the first, distance of the second from it, their rates.
    let apart = |y: &SVector<f64, 4>| vec![y[0], y[0] + y[1], y[2], y[2] + y[3]];
    let resolved = controlled(Dop853, alike(1e-14), &plant, &begin, times);
    let resolved = reference.all(&of(&resolved, apart), |_| 1e-9);
    let long = fixed(Rodas4, 1e-2, &plant, &begin, times);
    let columns = ["x1", "x2", "v1", "v2"];
    let slow = reference.parts(&columns, &of(&long, apart), slow_mode, 1e-6);
    vec![
        Outcome::worst(case, "9", "state; dop853 at 1e-14", resolved),
        Outcome::worst(case, "9", "slow mode; rodas4, 10 ms", slow),
    ]
}

/// Returns the component of the two masses' slow mode in positions and rates. In it the second mass moves
/// 1 + (k₁/m₁ − ω²)/(k/m₁) times as far as the first, with ω² = 33.3 s⁻².
fn slow_mode(x: &[f64]) -> Vec<f64> {
    let (first, second) = (1.0, 2.0);
    let further = 1.0 + (100.0 - 100.0 / 3.0) / 1e8;
    let size = first + second * further * further;
    let share = |a: f64, b: f64| (first * a + second * further * b) / size;
    vec![share(x[0], x[1]), share(x[2], x[3])]
}
