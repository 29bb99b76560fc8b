//! Why a mechanism has no closed form of a useful length.

use std::fmt;

/// Why there is no closed form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoClosedForm {
    /// The equations have more terms than the limit.
    TooLong {
        /// Terms of all P_j.
        terms: usize,
    },
    /// A sum on the way has too many terms for so much to cancel.
    LongSum {
        /// Its terms.
        terms: usize,
    },
    /// The way there takes too many products of two terms.
    ManyProducts {
        /// As many as were asked for when it was given up.
        products: usize,
    },
    /// The equations hold more than sines, cosines, products and sums.
    NotTrigonometric,
}

impl fmt::Display for NoClosedForm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoClosedForm::TooLong { terms } => write!(f, "its equations have {terms} terms"),
            NoClosedForm::LongSum { terms } => {
                write!(f, "a sum on the way to its equations has {terms} terms")
            }
            NoClosedForm::ManyProducts { products } => write!(
                f,
                "the way to its equations takes {products} products of two terms and more"
            ),
            NoClosedForm::NotTrigonometric => {
                write!(
                    f,
                    "its equations hold more than sines, cosines, products and sums"
                )
            }
        }
    }
}

impl std::error::Error for NoClosedForm {}
