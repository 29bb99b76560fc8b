//! Tests the outputs of motors other than their torque.

use bgdyn_codegen::method::SceneFunction;

use super::common::scene;
use super::one::{BLOCK, Tried, close, text};

/// Returns the voltage at the motor for a required voltage, at this speed of the joint and this current.
fn applied(motor: &str, asked: f64, speed: f64, current: Option<f64>) -> f64 {
    let more = "inputs: { it: given }\noutputs: [it_voltage]\n";
    let tried = Tried::new(scene(&text(&[motor], more), BLOCK));
    let outputs = tried.system.function(SceneFunction::Outputs);
    let rates: Vec<f64> = [speed].into_iter().chain(current).collect();
    let (values, _) = outputs.evaluate(tried.at(&[0.0], &rates, &[], &[asked]));
    assert_eq!(tried.system.outputs[0].unit, "V");
    values[0]
}

/// R = 2 ohm, k N = 3 V s/m; the supply gives 24 V.
#[test]
fn the_voltage_is_the_one_that_is_left_by_the_limits() {
    let plain =
        "it: { type: dc_motor, joint: slide, resistance: 2, torque_constant: 0.5, ratio: 6 }";
    let with = |more: &str| plain.replace(" }", &format!(", {more} }}"));
    for asked in [-100.0, -7.3, 0.0, 11.1, 100.0] {
        // Without a limit the required voltage, to the last bit.
        assert_eq!(applied(plain, asked, 1.7, None), asked);
        let supply = asked.clamp(-24.0, 24.0);
        assert_eq!(
            applied(&with("voltage_limit: 24"), asked, 1.7, None),
            supply
        );
        // At most the voltage for 4 A: 8 V more than the induced voltage, or 8 V less.
        let both = with("voltage_limit: 24, current_limit: 4");
        for speed in [-2.0, 0.5, 1.7] {
            let wanted = supply.clamp(3.0 * speed - 8.0, 3.0 * speed + 8.0);
            close(applied(&both, asked, speed, None), wanted);
        }
    }
}

/// With inductance the current is a state; below its limit, only the supply limits.
#[test]
fn the_voltage_of_a_winding() {
    let winding = "it: { type: dc_motor, joint: slide, resistance: 2, inductance: 1 mH, torque_constant: 0.5, ratio: 6, voltage_limit: 24 }";
    for (asked, wanted) in [(-30.0, -24.0), (5.5, 5.5), (24.5, 24.0)] {
        close(applied(winding, asked, 1.7, Some(1.0)), wanted);
    }
}
