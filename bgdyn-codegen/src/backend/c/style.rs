//! How numbers and global names are written in one pair of files.

use bgdyn_runtime::Dd;
use bgdyn_runtime::closure::{CLOSED, CLOSED_COARSELY};

use crate::backend::given::{BackendError, GivenOptions};
use crate::name::is_identifier;

/// The type of all numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Real {
    Double,
    Float,
}

/// The options of a pair of files.
pub(super) struct Style {
    /// Beginning of all names.
    pub(super) prefix: String,
    /// Name of the files without an ending.
    pub(super) file: String,
    /// Name of the spec.
    pub(super) source: String,
    pub(super) real: Real,
    /// Whether sines are those of libm.
    pub(super) libm: bool,
}

impl Style {
    pub(super) fn new(mechanism: &str, given: &GivenOptions) -> Result<Self, BackendError> {
        let prefix = given.get("prefix").unwrap_or(mechanism);
        if !is_identifier(prefix) {
            return Err(BackendError::Option(format!(
                "the option `prefix` is `{prefix}`: write words of a–z and digits joined by `_`"
            )));
        }
        let real = match given.choice("float", &["double", "float"])? {
            0 => Real::Double,
            _ => Real::Float,
        };
        Ok(Style {
            prefix: prefix.to_string(),
            file: mechanism.to_string(),
            source: given.source.clone(),
            real,
            libm: given.choice("sincos", &["own", "libm"])? == 1,
        })
    }

    /// Returns whether sines may be computed in wide registers, where the processor has them.
    pub(super) fn has_lanes(&self) -> bool {
        matches!(self.real, Real::Double) && !self.libm
    }

    /// Returns the name of the type of all numbers.
    pub(super) fn real(&self) -> &'static str {
        match self.real {
            Real::Double => "double",
            Real::Float => "float",
        }
    }

    /// Returns a function or a type with the prefix.
    pub(super) fn global(&self, name: &str) -> String {
        format!("{}_{name}", self.prefix)
    }

    /// Returns a macro with the prefix.
    pub(super) fn constant(&self, name: &str) -> String {
        format!("{}_{name}", self.prefix.to_uppercase())
    }

    /// Returns an expression of sizes, such as "NT + 2 * NC", with the prefix before each of its names.
    pub(super) fn sized(&self, sizes: &str) -> String {
        let with_prefix = |word: &str| match word.starts_with(|c: char| c.is_ascii_uppercase()) {
            true => self.constant(word),
            false => word.to_string(),
        };
        let words = sizes.split(' ').map(with_prefix);
        words.collect::<Vec<_>>().join(" ")
    }

    /// Returns a function of `math.h` for the type of all numbers.
    pub(super) fn of_library(&self, name: &str) -> String {
        match self.real {
            Real::Double => name.to_string(),
            Real::Float => format!("{name}f"),
        }
    }

    /// Returns a number in its shortest form that has all digits of the type; an infinite one if it is too large.
    pub(super) fn number(&self, x: f64) -> String {
        let is_finite = match self.real {
            Real::Double => x.is_finite(),
            Real::Float => (x as f32).is_finite(),
        };
        match (is_finite, self.real) {
            (true, Real::Double) => format!("{x:?}"),
            (true, Real::Float) => format!("{:?}F", x as f32),
            (false, _) => format!("{}{}", if x < 0.0 { "-" } else { "" }, self.infinite()),
        }
    }

    /// Returns the step of Newton's method after which one more is exact to rounding.
    pub(super) fn closing_step(&self) -> String {
        self.number(match self.real {
            Real::Double => CLOSED,
            Real::Float => CLOSED_COARSELY,
        })
    }

    /// Returns the macro of `math.h` for an infinite number.
    fn infinite(&self) -> &'static str {
        match self.real {
            Real::Double => "HUGE_VAL",
            Real::Float => "HUGE_VALF",
        }
    }

    /// Returns the two words of a constant, each rounded to the type.
    pub(super) fn two_words(&self, x: Dd) -> [f64; 2] {
        match self.real {
            Real::Double => [x.hi(), x.lo()],
            Real::Float => {
                let high = f64::from(x.hi() as f32);
                [high, (x.hi() - high) + x.lo()]
            }
        }
    }
}
