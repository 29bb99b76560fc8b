//! The reasons why a mechanism has no closed form of a readable length.

use std::fmt;

/// The reason why there is no closed form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoClosedForm {
    /// The equations have more terms than the limit.
    TooLong {
        /// Terms of all P_j.
        terms: usize,
    },
    /// An intermediate sum has too many terms.
    LongSum {
        /// Number of its terms.
        terms: usize,
    },
    /// The expansion needs too many products of two terms.
    ManyProducts {
        /// Number of products at which the expansion was stopped.
        products: usize,
    },
    /// The equations have operations other than sines, cosines, products and sums.
    NotTrigonometric,
    /// The motion of the base is given.
    MovingBase,
    /// It has a kinematic loop.
    Loop {
        /// Its name.
        name: String,
    },
    /// The motion of a joint is prescribed.
    Prescribed {
        /// Its name.
        joint: String,
    },
    /// A joint is neither a rotation nor a translation, or mimics another.
    Joint {
        /// Its name.
        joint: String,
    },
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
            NoClosedForm::MovingBase => {
                write!(f, "the motion of its base is given (`base: given`)")
            }
            NoClosedForm::Loop { name } => write!(f, "it has the loop `{name}`"),
            NoClosedForm::Prescribed { joint } => {
                write!(f, "the motion of the joint `{joint}` is prescribed")
            }
            NoClosedForm::Joint { joint } => write!(
                f,
                "the joint `{joint}` has several degrees of freedom, a lead or `mimic`; equations are printed \
                 for rotations and translations with a coordinate of their own"
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
