//! The base whose motion is given: its hidden link, and its parameters.

use bgdyn_runtime::Dd;

use super::parameters::Parameters;
use crate::fault::{Faults, wording};
use crate::format::Spec;
use crate::math::Vec3;
use crate::mechanism::{
    BASE_PARAMETERS, Degrees, Inertial, Joint, Limits, Link, Parameter, Pose, joint,
};

/// The name of the hidden link. Generated code uses it in the names of intermediate results only.
const NAME: &str = "moving_base";

/// Returns whether the motion of the base is given at run time. Its parameters are fields of their own.
pub(super) fn base_is_given(spec: &Spec, parameters: &Parameters<'_>, faults: &mut Faults) -> bool {
    let Some(base) = spec.base.given() else {
        return false;
    };
    match base.value.as_str() {
        "fixed" => false,
        "given" => {
            for (name, location) in parameters.names() {
                let taken = |(own, ..): &(&str, &str, &str)| name.starts_with(own);
                if BASE_PARAMETERS.iter().any(taken) {
                    faults.push(wording::parameter_of_base(location, name));
                }
            }
            true
        }
        other => {
            faults.push(wording::unknown_base(&base.location, other));
            false
        }
    }
}

/// Returns the parameters of the motion, with the values of a base at rest.
pub(super) fn at_rest(gravity: Vec3<Dd>) -> impl Iterator<Item = Parameter> {
    let defaults = [Vec3([Dd::ZERO; 3]), Vec3([Dd::ZERO; 3]), -gravity];
    let named = BASE_PARAMETERS.into_iter().zip(defaults);
    named.flat_map(|((name, meaning, unit), default)| {
        (0..3).map(move |k| {
            let axis = ["x", "y", "z"][k];
            Parameter {
                name: format!("{name}_{axis}"),
                meaning: format!("{meaning}, along {axis} of the base"),
                default: default.0[k],
                unit,
            }
        })
    })
}

/// Returns the hidden link of the base.
pub(super) fn base_link(massless: Inertial) -> Link {
    Link {
        name: NAME.into(),
        label: None,
        parent: None,
        joint: Joint {
            name: NAME.into(),
            label: None,
            kind: joint::given(),
            axis: Vec3([Dd::ZERO, Dd::ZERO, Dd::ONE]),
            origin: Pose::IDENTITY,
            limits: Limits::default(),
            coordinate: None,
            degrees: Degrees::default(),
        },
        inertial: massless,
        hidden: true,
    }
}
