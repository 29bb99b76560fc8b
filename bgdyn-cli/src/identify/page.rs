use bgdyn_identification::{Identification, Model};
pub(crate) fn page(_: &str, _: &Model<'_>, _: &Identification, _: &str) -> String { String::new() }
