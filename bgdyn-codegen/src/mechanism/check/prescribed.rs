//! The run-time parameters of joints whose motion is given.

use bgdyn_runtime::Dd;

use crate::mechanism::{
    Joint, Link, LinkId, Motion, PRESCRIBED_PARAMETERS, Parameter, ParameterId, PrescribedJoint,
};

/// Returns the prescribed joints in the order of the links, after adding their parameters, which are zero by
/// default.
pub(super) fn numbered(
    prescribed: &[LinkId],
    links: &[Link],
    parameters: &mut Vec<Parameter>,
) -> Vec<PrescribedJoint> {
    let mut prescribed = prescribed.to_vec();
    prescribed.sort();
    let number = |link: LinkId| {
        let first = parameters.len();
        parameters.extend(at_rest(&links[link.0].joint));
        let motion = std::array::from_fn(|k| ParameterId(first + k));
        PrescribedJoint { link, motion }
    };
    prescribed.into_iter().map(number).collect()
}

fn at_rest(joint: &Joint) -> impl Iterator<Item = Parameter> + '_ {
    let slides = joint.kind.motion == Motion::Translation;
    let one = move |(ending, units): (&str, [&'static str; 2])| Parameter {
        name: format!("{}_{ending}", joint.name),
        meaning: format!("{ending} of the prescribed joint `{}`", joint.name),
        default: Dd::ZERO,
        unit: units[usize::from(slides)],
    };
    PRESCRIBED_PARAMETERS.into_iter().map(one)
}
