//! YAML text → checked mechanism: reading, then checking, all findings together.

use crate::fault::Faults;
use crate::mechanism::{Mechanism, check};
use crate::spec::parse;

/// Reads and checks a spec. `stem` is the file's name without its ending, if there is a file; only
/// what stands before its first dot counts.
///
/// The mechanism is there exactly if nothing refuses the spec; warnings may come with it. The
/// findings are in the order of the file.
pub fn read(text: &str, stem: Option<&str>) -> (Option<Mechanism>, Faults) {
    let (spec, mut faults) = parse(text);
    let Some(spec) = spec else {
        return (None, faults);
    };
    let (mechanism, more) = check(&spec, stem);
    faults.0.extend(more.0);
    faults.sort();
    (mechanism, faults)
}
