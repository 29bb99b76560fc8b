//! Contact of a sphere of a link with a plane or another sphere.
//!
//! | file | has |
//! |---|---|
//! | `compliant.rs` | the effect with a compliant normal force |
//! | `normal.rs` | the law of the normal force: Hunt and Crossley |
//! | `friction.rs` | the laws of friction along the plane of contact |

mod compliant;
mod friction;
mod normal;

pub(super) use compliant::CompliantContact;
