//! A value with its position in the file, and the state of a key: absent, unreadable, given.

use crate::fault::Location;

/// A value and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Located<T> {
    /// The value.
    pub value: T,
    /// Where it stands.
    pub location: Location,
}

/// What became of a key of a mapping.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Field<T> {
    /// The key is not there.
    #[default]
    Absent,
    /// The key is there, its value is not what belongs there; a fault says so already.
    Broken,
    /// The key is there with a value of the right type.
    Given(Located<T>),
}

impl<T> Field<T> {
    /// The value with its place, if given.
    pub fn given(&self) -> Option<&Located<T>> {
        match self {
            Field::Given(located) => Some(located),
            Field::Absent | Field::Broken => None,
        }
    }

    /// The value, if given.
    pub fn value(&self) -> Option<&T> {
        self.given().map(|located| &located.value)
    }

    /// The value or, for an absent key, `default`; nothing for an unreadable one.
    pub fn value_or<'a>(&'a self, default: &'a T) -> Option<&'a T> {
        match self {
            Field::Absent => Some(default),
            Field::Broken => None,
            Field::Given(located) => Some(&located.value),
        }
    }

    /// Whether the key is not there.
    pub fn is_absent(&self) -> bool {
        matches!(self, Field::Absent)
    }

    /// Whether the key's value could not be read.
    pub fn is_broken(&self) -> bool {
        matches!(self, Field::Broken)
    }
}
