//! The operations of a tape.

/// An operation of instructions. Signs of operands are part of it, or an instruction of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// −a.
    Negate,
    /// a + b.
    Add,
    /// a − b.
    Subtract,
    /// a · b.
    Multiply,
    /// a / b.
    Divide,
    /// a · b + c, fused where the scalar fuses.
    MultiplyAdd,
    /// a · b − c.
    MultiplySubtract,
    /// −a · b + c.
    NegativeMultiplyAdd,
    /// −a · b − c.
    NegativeMultiplySubtract,
    /// √a.
    SquareRoot,
    /// Sine and cosine of a sum of angles and a constant: two values.
    Sines,
    /// eᵃ.
    Exponential,
    /// ln a.
    Logarithm,
    /// tanh a.
    HyperbolicTangent,
    /// |a|.
    Absolute,
    /// The smaller value.
    Minimum,
    /// The larger value.
    Maximum,
    /// −1, 0, 1.
    Sign,
    /// c where a < b, else d.
    Select,
    /// a, refused where it is lost in the rounding of b.
    Pivot,
}

impl Operation {
    /// The number of operations.
    pub const COUNT: usize = Operation::Pivot as usize + 1;

    /// Returns the number of values of one instruction.
    pub fn values(self) -> usize {
        match self {
            Operation::Sines => 2,
            _ => 1,
        }
    }
}
