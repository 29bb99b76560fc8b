//! A scene's module in a crate that allows no warning, by the names of its parts and by the traits;
//! its method of integration brings the Jacobian, the canonical form comes for asking.
#![deny(warnings, clippy::all, missing_docs, rust_2018_idioms)]
#![forbid(unsafe_code)]

use bgdyn::runtime::{Canonical, FixedVector, Slope, StateVector};

bgdyn::bgdyn!("swing.scene.yaml");
bgdyn::bgdyn!("swing.scene.yaml", module = both, visibility = pub(crate), canonical = true);

fn rate<S: Slope<f64> + Canonical<f64>>(scene: &S) -> f64 {
    let ((y, modes), given) = (scene.start(), S::Inputs::zero_vector());
    let z = scene.to_canonical(&y, &modes, &given, 0.0);
    let back = scene.from_canonical(&z, &modes, &given, 0.0).expect("regular");
    let size = |x: &[f64]| x.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    assert!(size(back.plus(-1.0, &y).entries()) < 1e-12);
    let (slope, along_time) = scene.slope(&y, &modes, &given, 0.0).expect("regular");
    size(S::State::columns(&slope)) + size(along_time.entries())
}

fn main() -> Result<(), bgdyn::Singular> {
    let scene = swing::Swing::<f64> { damping: 0.3 };
    let state = swing::State { elbow: 0.2, ..swing::State::default() };
    let given = swing::Input { shoulder: 2.0, ..swing::Input::default() };
    let input = scene.input(&state, &given, 0.0);
    let rates = scene.derivative(&state, &input, 0.0)?;
    assert_eq!(rates.shoulder, state.shoulder_rate);
    let power = scene.power(&state, &input, 0.0)?;
    assert_eq!(power.bearing.dissipated, 0.0);
    assert_eq!(scene.output(&state, &input, 0.0).elbow, 0.2);
    let (slope, _) = scene.jacobian(&state, &given, 0.0)?;
    assert_eq!(slope[(0, swing::NQ)], 1.0);
    assert_eq!(swing::STATE_NAMES[swing::NQ], "shoulder_rate");
    assert!(rate(&both::Swing::<f64>::default()) > 1.0);
    Ok(())
}
