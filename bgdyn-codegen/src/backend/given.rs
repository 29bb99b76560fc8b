//! The options of a backend that a caller gives, and their errors.

use std::collections::BTreeMap;
use std::fmt;

/// An option of a backend.
#[derive(Clone, Copy, Debug)]
pub struct BackendOption {
    /// Its name.
    pub name: &'static str,
    /// Its meaning, with its values and its default, in one sentence without a full stop.
    pub summary: &'static str,
}

/// Why a backend writes nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BackendError {
    /// An option, or its value, that does not exist.
    Option(String),
}

impl fmt::Display for BackendError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let BackendError::Option(message) = self;
        f.write_str(message)
    }
}

impl std::error::Error for BackendError {}

/// Options of a backend by name, and the name of the spec.
#[derive(Clone, Debug)]
pub struct GivenOptions {
    /// Name of the spec, for the header.
    pub source: String,
    values: BTreeMap<String, String>,
}

impl GivenOptions {
    /// Returns these options.
    ///
    /// # Errors
    /// If one of them is not among `options`, those that the backend takes, or if one is given twice.
    pub fn new(
        source: String,
        backend: &str,
        options: &[BackendOption],
        pairs: impl IntoIterator<Item = (String, String)>,
    ) -> Result<Self, BackendError> {
        let mut values: BTreeMap<String, String> = BTreeMap::new();
        for (name, value) in pairs {
            if let Some(first) = values.insert(name.clone(), value.clone()) {
                return Err(BackendError::Option(format!(
                    "the option `{name}` is given twice: `{first}` and `{value}`"
                )));
            }
        }
        let is_known = |name: &String| options.iter().any(|option| option.name == name);
        if let Some(name) = values.keys().find(|name| !is_known(name)) {
            let names = options.iter().map(|option| format!("`{}`", option.name));
            let names = names.collect::<Vec<_>>().join(", ");
            return Err(BackendError::Option(format!(
                "the backend `{backend}` has no option `{name}`: it has {names}"
            )));
        }
        Ok(GivenOptions { source, values })
    }

    /// Returns the value of an option, if it is given.
    pub fn get(&self, name: &str) -> Option<&str> {
        self.values.get(name).map(String::as_str)
    }

    /// Returns the index of an option's value among `choices`; 0 if it is not given.
    ///
    /// # Errors
    /// If the value is none of them.
    pub fn choice(&self, name: &str, choices: &[&str]) -> Result<usize, BackendError> {
        let Some(value) = self.get(name) else {
            return Ok(0);
        };
        let found = choices.iter().position(|choice| *choice == value);
        found.ok_or_else(|| {
            let choices = choices.iter().map(|choice| format!("`{choice}`"));
            let choices = choices.collect::<Vec<_>>().join(" or ");
            BackendError::Option(format!("the option `{name}` is `{value}`: write {choices}"))
        })
    }
}
