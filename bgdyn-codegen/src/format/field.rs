//! A value with its location in the file, and the state of a key: absent, unreadable, given.

use crate::fault::Location;

/// A value and its location.
#[derive(Clone, Debug, PartialEq)]
pub struct Located<T> {
    /// The value.
    pub value: T,
    /// Its location.
    pub location: Location,
}

/// The state of a key of a mapping.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Field<T> {
    /// The key is missing.
    #[default]
    Absent,
    /// The key is present with an invalid value, for which a fault was reported.
    Broken,
    /// The key is present with a value of the right type.
    Given(Located<T>),
}

impl<T> Field<T> {
    /// Returns the value with its location, if given.
    pub fn given(&self) -> Option<&Located<T>> {
        match self {
            Field::Given(located) => Some(located),
            Field::Absent | Field::Broken => None,
        }
    }

    /// Returns the value, if given.
    pub fn value(&self) -> Option<&T> {
        self.given().map(|located| &located.value)
    }

    /// Returns the value or, for an absent key, `default`; `None` for an unreadable one.
    pub fn value_or<'a>(&'a self, default: &'a T) -> Option<&'a T> {
        match self {
            Field::Absent => Some(default),
            Field::Broken => None,
            Field::Given(located) => Some(&located.value),
        }
    }

    /// Returns whether the key is missing.
    pub fn is_absent(&self) -> bool {
        matches!(self, Field::Absent)
    }

    /// Returns whether the key's value was unreadable.
    pub fn is_broken(&self) -> bool {
        matches!(self, Field::Broken)
    }
}
