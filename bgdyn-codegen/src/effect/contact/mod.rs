//! Contact of a sphere of a link with a plane or another sphere.
//!
//! | file | has |
//! |---|---|
//! | `compliant.rs` | the effect with a compliant normal force |
//! | `normal.rs` | the law of the normal force: Hunt and Crossley |
//! | `friction.rs` | the laws of friction along the plane of contact |
//! | `rigid.rs` | the effect of rigid surfaces |

mod compliant;
mod friction;
mod normal;
mod rigid;

pub(super) use compliant::CompliantContact;
pub(super) use rigid::RigidContact;

use crate::declaration::{Element, SceneContext};
use crate::fault::{Faults, wording};
use crate::format::{Key, Reads};

/// The contact at which an effect acts.
const CONTACT: Key = Key {
    name: "contact",
    reads: Reads::Contact,
    needed: true,
    about: "the contact, one of the mechanism's `contacts`",
};

/// Reports a contact at which an effect before this one acts already.
fn one_law(element: &Element, beside: &SceneContext<'_>, faults: &mut Faults) {
    let name = element.needed_name(&CONTACT);
    let mut before = beside
        .elements
        .iter()
        .take_while(|other| other.name != element.name);
    if let Some(other) = before.find(|other| other.contact() == Some(name)) {
        let fault = wording::contact_with_two_laws(&element.location, name, &other.name);
        faults.push(fault);
    }
}
