//! Tests the impulses of rigid contacts with Coulomb friction.

mod boxes;
mod closed_forms;
mod conditions;
mod hostile;
mod problems;
mod random;
mod reference;
mod warm;
