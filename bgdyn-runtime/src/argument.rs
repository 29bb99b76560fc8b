//! Arguments of generated functions, as a failed function shows them.

/// What a generated function shows its arguments to, one after the other, after it has failed: the
/// argument, the names of its components, their values.
pub type Look<'a, T> = dyn FnMut(Argument, &'static [&'static str], &[T]) + 'a;

/// An argument of a function that has an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Argument {
    /// Positions `q`.
    Q,
    /// Velocities `v`.
    V,
    /// Joint efforts `tau`.
    Tau,
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
    /// Its name in signatures.
    pub const fn name(self) -> &'static str {
        match self {
            Argument::Q => "q",
            Argument::V => "v",
            Argument::Tau => "tau",
            Argument::State => "state",
            Argument::Input => "input",
            Argument::Modes => "modes",
            Argument::Canonical => "z",
            Argument::Time => "t",
            Argument::Parameters => "self",
        }
    }
}
