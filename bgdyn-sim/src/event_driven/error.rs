//! The errors of contacts that are solved from event to event.

use core::fmt;

use bgdyn_runtime::MOST_EVENT_CONTACTS;

/// Why there are no rates or modes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EventError<E> {
    /// The plant has none.
    Plant(E),
    /// Painlevé's paradox: a contact slips, and no finite force keeps it from overlapping. Only an impulse does, which
    /// [`crate::Moreau`] finds.
    Paradox {
        /// The contact, in the order of the plant's.
        contact: usize,
    },
    /// The plant does not say how a contact and its velocities act on each other: one in canonical form.
    NoMap {
        /// The contact.
        contact: usize,
    },
    /// No modes fulfil all inequalities to rounding.
    NoModes,
    /// There are more contacts than this solver takes.
    TooManyContacts {
        /// The number of contacts.
        number: usize,
    },
}

impl<E: fmt::Debug> fmt::Display for EventError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Plant(error) => write!(f, "{error:?}"),
            Self::Paradox { contact } => write!(
                f,
                "contact {contact} slips, and no finite force keeps it from overlapping (Painlevé's paradox); `moreau` finds an impulse"
            ),
            Self::NoMap { contact } => write!(
                f,
                "the plant has no map of the contact {contact}: contacts are solved in velocities, not in momenta"
            ),
            Self::NoModes => f.write_str(
                "no choice of open, sticking and slipping contacts fulfils all conditions; `moreau` may go on",
            ),
            Self::TooManyContacts { number } => write!(
                f,
                "{number} rigid contacts are more than the {MOST_EVENT_CONTACTS} that are solved from event to event; `moreau` takes more"
            ),
        }
    }
}
