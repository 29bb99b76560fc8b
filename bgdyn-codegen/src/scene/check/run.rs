//! Checks a scene's settings of integration: integrator, step or tolerance, end.

use bgdyn_runtime::{Dd, ImpactLaw};

use super::super::{Integration, IntegratorName, StepControl};
use crate::fault::wording::expected;
use crate::fault::{Fault, Faults, Location, wording};
use crate::format::{Dimension, Field, Fields, Key, Located, ParsedValue, Raw, Reads};

/// Default step of a run, s.
const STEP: f64 = 1e-3;
const END: f64 = 1.0;

/// Tolerance of an integrator with step control, if the scene gives neither step nor tolerance.
const TOLERANCE: f64 = 1e-8;

const METHOD: Key = key("method", Reads::Word(&[]), "integration method");
const STEP_LENGTH: Key = key(
    "step",
    Reads::Number(&[Dimension::Time]),
    "length of a step",
);
const STEP_ERROR: Key = key(
    "tolerance",
    Reads::Number(&[Dimension::One]),
    "error of a step",
);
const END_TIME: Key = key(
    "end",
    Reads::Number(&[Dimension::Time]),
    "when the run ends",
);

pub(super) const IMPACTS: Key = key("impacts", Reads::Word(&[]), "law of restitution at impacts");

/// The keys of `integration`.
const KEYS: [Key; 5] = [METHOD, STEP_LENGTH, STEP_ERROR, END_TIME, IMPACTS];

const fn key(name: &'static str, reads: Reads, about: &'static str) -> Key {
    Key {
        name,
        reads,
        needed: false,
        about,
    }
}

/// Returns the settings of a run, with defaults for missing ones.
pub(super) fn integration(field: &Field<Raw>, faults: &mut Faults) -> Integration {
    let given = field.value().and_then(|raw| settings(raw, faults));
    given.unwrap_or(Integration {
        method: IntegratorName::Rk4,
        step_control: StepControl::Step(STEP),
        end: END,
        impacts: ImpactLaw::Newton,
    })
}

fn settings(raw: &Raw, faults: &mut Faults) -> Option<Integration> {
    let what = expected::INTEGRATION;
    let fields = raw.fields(what, &KEYS, faults)?;
    let method = method(&fields, faults);
    let end = positive(&fields, &END_TIME, "a time such as `5 s`", faults);
    let step = positive(&fields, &STEP_LENGTH, "a time such as `1 ms`", faults);
    let tolerance = positive(&fields, &STEP_ERROR, "a number such as `1e-8`", faults);
    let impacts = impacts(&fields, faults);
    let method = method?;
    let step_control = match (step, tolerance) {
        (None, None) if method.controls_its_error() => StepControl::Tolerance(TOLERANCE),
        (None, None) => StepControl::Step(STEP),
        (Some((step, _)), None) => StepControl::Step(step),
        (step, Some((tolerance, location))) => {
            faults.0.extend(misplaced(method, step.is_some(), location));
            StepControl::Tolerance(tolerance)
        }
    };
    let end = end.map_or(END, |(end, _)| end);
    Some(Integration {
        method,
        step_control,
        end,
        impacts,
    })
}

/// Returns the law of restitution, by default Newton's; reports an unknown name.
fn impacts(fields: &Fields, faults: &mut Faults) -> ImpactLaw {
    let Some(Located {
        value: ParsedValue::Text(word),
        location,
    }) = fields.get(&IMPACTS)
    else {
        return ImpactLaw::Newton;
    };
    ImpactLaw::named(word).unwrap_or_else(|| {
        let known = ImpactLaw::ALL.map(ImpactLaw::name);
        faults.push(wording::unknown_impact_law(location, word, &known));
        ImpactLaw::Newton
    })
}

/// Returns the fault of a tolerance at this location, if it is invalid.
fn misplaced(method: IntegratorName, stepped: bool, location: &Location) -> Option<Fault> {
    let name = method.name();
    let choosing = IntegratorName::ALL.into_iter();
    let choosing = choosing.filter(|m| m.controls_its_error());
    let choosing: Vec<&str> = choosing.map(IntegratorName::name).collect();
    match (method.controls_its_error(), stepped) {
        (false, _) => Some(wording::no_step_control(location, name, &choosing)),
        (true, true) => Some(wording::step_and_tolerance(location, name)),
        (true, false) => None,
    }
}

/// Returns the number of a key and its location; reports a number that is not positive.
fn positive<'a>(
    fields: &'a Fields,
    key: &Key,
    example: &str,
    faults: &mut Faults,
) -> Option<(f64, &'a Location)> {
    let Some(Located {
        value: ParsedValue::Number(number),
        location,
    }) = fields.get(key)
    else {
        return None;
    };
    if number.value <= Dd::ZERO {
        let text = &number.text;
        faults.push(wording::integration_not_positive(
            location, key.name, text, example,
        ));
    }
    Some((number.value.to_f64(), location))
}

/// Returns the integrator, by default RK4; `None` for an unknown name.
fn method(fields: &Fields, faults: &mut Faults) -> Option<IntegratorName> {
    let Some(Located {
        value: ParsedValue::Text(word),
        location,
    }) = fields.get(&METHOD)
    else {
        return Some(IntegratorName::Rk4);
    };
    let found = IntegratorName::named(word);
    if found.is_none() {
        let known = IntegratorName::ALL.map(IntegratorName::name);
        faults.push(wording::unknown_integrator(location, word, &known));
    }
    found
}
