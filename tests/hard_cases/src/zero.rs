//! Bar 14: effects of zero strength have no influence.

use bgdyn_runtime::{FixedVector, HybridSystem, StateVector};
use nalgebra::SVector;

use crate::outcome::Outcome;
use crate::rng::Rng;
use crate::{Extent, scenes};

/// Rates of the arm and sled in a state: turn, slide, their rates, then their efforts.
type Rates = Box<dyn Fn(&SVector<f64, 4>, &[f64; 2]) -> SVector<f64, 4>>;

/// Returns the rates of a scene, with all inputs except the two efforts at 0.
fn rates<S: HybridSystem<f64, State = SVector<f64, 4>> + 'static>(scene: S) -> Rates {
    let (_, modes) = scene.start();
    let places = ["turn", "slide"].map(|name| {
        let found = scene
            .input_names()
            .as_ref()
            .iter()
            .position(|own| *own == name);
        found.expect("an effort")
    });
    Box::new(move |y, efforts| {
        let mut input = S::Inputs::zero_vector();
        for (place, effort) in places.into_iter().zip(efforts) {
            input.entries_mut()[place] = *effort;
        }
        scene.derivative(y, &modes, &input, 0.0).expect("regular")
    })
}

/// Constant strengths at 0 must give the scene without the effect, bit for bit; run-time ones must agree
/// to 4 eps of the rates due to the efforts and to everything else, each separately: their cancellation is
/// no error.
pub(crate) fn no_strength(extent: Extent) -> Vec<Outcome> {
    macro_rules! of {
        ($module:ident, $scene:ident) => {
            rates(scenes::$module::$scene::<f64>::default())
        };
    }
    let plain = of!(without, Without);
    let constant: [(&str, Rates); 4] = [
        ("viscous", of!(constant_viscous, ConstantViscous)),
        ("spring", of!(constant_spring, ConstantSpring)),
        ("damper", of!(constant_damper, ConstantDamper)),
        ("drag", of!(constant_drag, ConstantDrag)),
    ];
    let run_time: [(&str, Rates); 5] = [
        ("viscous", of!(parameter_viscous, ParameterViscous)),
        ("spring", of!(parameter_spring, ParameterSpring)),
        ("damper", of!(parameter_damper, ParameterDamper)),
        ("drag", of!(parameter_drag, ParameterDrag)),
        ("wrench", of!(input_wrench, InputWrench)),
    ];
    let states = extent.of(1_000_000, 10_000);
    let mut rng = Rng::new(14);
    let (mut differ, mut off) = ([0_usize; 4], [0.0_f64; 5]);
    for _ in 0..states {
        let y = SVector::from_fn(|_, _| rng.within(2.0));
        let efforts = [rng.within(20.0), rng.within(20.0)];
        let wanted = plain(&y, &efforts);
        let rest = plain(&y, &[0.0; 2]);
        let size = rest.amax() + (wanted - rest).amax();
        for (count, (_, found)) in differ.iter_mut().zip(&constant) {
            let found = found(&y, &efforts);
            let same = |(x, w): (&f64, &f64)| x.to_bits() == w.to_bits();
            *count += usize::from(!found.iter().zip(&wanted).all(same));
        }
        for (most, (_, found)) in off.iter_mut().zip(&run_time) {
            *most = most.max((found(&y, &efforts) - wanted).amax() / size);
        }
    }
    let mut outcomes = vec![];
    for ((name, _), count) in constant.iter().zip(differ) {
        let quantity = "states that differ in a bit, constant 0";
        outcomes.push(Outcome::new(*name, "14", quantity, count as f64, 0.0));
    }
    for ((name, _), most) in run_time.iter().zip(off) {
        let quantity = "relative to what efforts and the rest add up to, run-time 0";
        outcomes.push(Outcome::new(
            *name,
            "14",
            quantity,
            most,
            4.0 * f64::EPSILON,
        ));
    }
    outcomes
}
