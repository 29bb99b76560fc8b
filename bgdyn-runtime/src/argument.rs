//! Arguments of generated functions, as the error of a failed function names them.

/// A callback that receives the arguments of a failed function, one after the other: the argument, the
/// names of its components, their values.
pub type Look<'a, T> = dyn FnMut(Argument, &'static [&'static str], &[T]) + 'a;

/// An argument of a generated function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[repr(u32)] // as wide as the index beside it in an error: loaded and stored with it
pub enum Argument {
    /// Positions `q`.
    Q,
    /// Velocities `v`.
    V,
    /// Velocities `qd` of the open tree of a mechanism with loops.
    Qd,
    /// Accelerations `a`.
    A,
    /// Joint efforts `tau`.
    Tau,
    /// Direction `dq` of the positions.
    Dq,
    /// Direction `dv` of the velocities.
    Dv,
    /// Direction `dtau` of the efforts.
    Dtau,
    /// Factors `l` of an adjoint.
    L,
    /// The `state` of a scene.
    State,
    /// The `input` of a scene.
    Input,
    /// The `modes` of a scene.
    Modes,
    /// The state `z` of a scene with momenta in place of velocities.
    Canonical,
    /// Time `t`.
    Time,
    /// The run-time parameters, fields of `self`.
    Parameters,
}

impl Argument {
    /// Returns the argument's name in signatures.
    pub const fn name(self) -> &'static str {
        match self {
            Argument::Q => "q",
            Argument::V => "v",
            Argument::Qd => "qd",
            Argument::A => "a",
            Argument::Tau => "tau",
            Argument::Dq => "dq",
            Argument::Dv => "dv",
            Argument::Dtau => "dtau",
            Argument::L => "l",
            Argument::State => "state",
            Argument::Input => "input",
            Argument::Modes => "modes",
            Argument::Canonical => "z",
            Argument::Time => "t",
            Argument::Parameters => "self",
        }
    }
}
