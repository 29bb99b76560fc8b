use bgdyn_identification::Identification;
use super::IdentifiedMachine;
pub(crate) struct Written(String);
impl Written { pub(crate) fn named(&self, _: &str) -> String { self.0.clone() } }
pub(crate) fn write(t: &str, _: &IdentifiedMachine, _: &Identification) -> Result<Written, String> { Ok(Written(t.into())) }
