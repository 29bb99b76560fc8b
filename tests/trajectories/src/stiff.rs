//! Stiff motions: by methods whose steps are much longer than what settles or shakes first, and where
//! it is to be seen by the method of order 8.

use bgdyn_sim::{Dop853, Rodas4, Run, Scene};

use crate::follow::{alike, controlled, fixed, of, relative};
use crate::outcome::Outcome;
use crate::reference::reference;
use crate::scenes;

/// A motor whose current settles within 1e-5 s, by steps of 1e-2 s.
pub fn motor_linear_stiff() -> Vec<Outcome> {
    let case = "motor_linear_stiff";
    let reference = reference!("motor_linear_stiff").only(|_, t| t >= 0.1);
    let scene = scenes::motor_linear_stiff::MotorLinearStiff::<f64>::default();
    let (plant, begin) = (Scene::with_slope(&scene), Run::begin(&scene));
    let states = fixed(Rodas4, 1e-2, &plant, &begin, &reference.times);
    // State: angle, rate, current.
    let found = of(&states, |y| vec![y[1], y[0]]);
    let deviations = reference.relative(&["omega", "theta"], &found, 1e-6);
    let quantity = "rate, angle, relative; rodas4, 10 ms";
    vec![Outcome::worst(case, quantity, deviations)]
}

/// A load on a hydraulic cylinder: pressures that settle within 1e-5 s … 1e-3 s, a load that swings on
/// the oil at 200 rad/s.
pub fn hydraulic_cylinder() -> Vec<Outcome> {
    let case = "hydraulic_cylinder";
    let reference = reference!("hydraulic_cylinder").only(|_, t| t >= 0.02);
    let scene = scenes::hydraulic_cylinder::HydraulicCylinder::<f64>::default();
    let (plant, begin) = (Scene::with_slope(&scene), Run::begin(&scene));
    let times = &reference.times;
    let controlled = controlled(Rodas4, relative(1e-9), &plant, &begin, times);
    let fixed = fixed(Rodas4, 1e-4, &plant, &begin, times);
    let runs = [
        (
            controlled,
            "place, rate, relative; rodas4 at 1e-9",
            "pressures, relative; rodas4 at 1e-9",
        ),
        (
            fixed,
            "place, rate, relative; rodas4, 0.1 ms",
            "pressures, relative; rodas4, 0.1 ms",
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
        outcomes.push(Outcome::worst(case, motion, moved));
        outcomes.push(Outcome::worst(case, pressures, pressed));
    }
    outcomes
}

/// A mass that swings on a stiff spring and shakes on it 1600 times as often.
pub fn stiff_spring_pendulum() -> Vec<Outcome> {
    let case = "stiff_spring_pendulum";
    let reference = reference!("stiff_spring_pendulum");
    let scene = scenes::stiff_spring_pendulum::StiffSpringPendulum::<f64>::default();
    let (plant, begin) = (Scene::with_slope(&scene), Run::begin(&scene));
    let times = &reference.times;
    let states = controlled(Dop853, alike(1e-13), &plant, &begin, times);
    let long = fixed(Rodas4, 1e-3, &plant, &begin, times);
    // State: angle, length, their rates.
    let swing = ["theta", "theta_dot"];
    let swung = reference.some(&swing, &of(&states, |y| vec![y[0], y[2]]), 1e-10);
    let shaken = reference.some(&["r"], &of(&states, |y| vec![y[1]]), 1e-15);
    let slow = reference.some(&swing, &of(&long, |y| vec![y[0], y[2]]), 1e-6);
    vec![
        Outcome::worst(case, "angle, rate; dop853 at 1e-13", swung),
        Outcome::worst(case, "length; dop853 at 1e-13", shaken),
        Outcome::worst(case, "angle, rate; rodas4, 1 ms", slow),
    ]
}

/// Two masses that swing together on a soft spring, and 2100 times as fast against each other.
pub fn stiff_spring_two_mass() -> Vec<Outcome> {
    let case = "stiff_spring_two_mass";
    let reference = reference!("stiff_spring_two_mass");
    let scene = scenes::stiff_spring_two_mass::StiffSpringTwoMass::<f64>::default();
    let (plant, begin) = (Scene::with_slope(&scene), Run::begin(&scene));
    let times = &reference.times;
    let states = controlled(Dop853, alike(1e-13), &plant, &begin, times);
    // State: place of the first, distance of the second from it, their rates.
    let found = of(&states, |y| vec![y[0], y[0] + y[1], y[2], y[2] + y[3]]);
    let deviations = reference.all(&found, |_| 1e-9);
    vec![Outcome::worst(case, "state; dop853 at 1e-13", deviations)]
}
