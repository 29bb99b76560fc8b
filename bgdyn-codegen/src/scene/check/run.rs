//! How the scene is run.

use bgdyn_runtime::Dd;

use super::super::Integration;
use super::super::signal::INTEGRATION;
use crate::fault::{Fault, Faults, unknown_name};
use crate::spec::{Entry, Field, Located, Raw};

/// Step and length of a run whose scene says nothing of them, s.
const STEP: f64 = 1e-3;
const END: f64 = 1.0;

pub(super) fn integration(field: &Field<Raw>, faults: &mut Faults) -> Option<Integration> {
    let mut wanted = Integration {
        method: "rk4".into(),
        step: STEP,
        end: END,
    };
    let raw = match field {
        Field::Absent => return Some(wanted),
        Field::Broken => return None,
        Field::Given(raw) => &raw.value,
    };
    let what = (
        "how the scene is run",
        "`{ method: rk4, step: 1 ms, end: 5 s }`",
    );
    let fields = raw.fields(what, &INTEGRATION, faults)?;
    if let Some(Located {
        value: Entry::Text(word),
        place,
    }) = fields.get("method")
    {
        wanted.method = word.clone();
        if word != "rk4" {
            let message = unknown_name("integration method", word, &["rk4"], "rk4");
            faults.push(Fault::new(place, "unknown-name", message).with_help("write `rk4`"));
        }
    }
    for (key, target) in [("step", &mut wanted.step), ("end", &mut wanted.end)] {
        if let Some(Located {
            value: Entry::Number(number),
            place,
        }) = fields.get(key)
        {
            *target = number.value.to_f64();
            if number.value <= Dd::ZERO {
                let message = format!("`{key}` is {}: it must be greater than 0", number.text);
                let fault = Fault::new(place, "time", message);
                faults.push(fault.with_help("write a time such as `1 ms`"));
            }
        }
    }
    Some(wanted)
}
