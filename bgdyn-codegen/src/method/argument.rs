//! The arguments of methods.

/// An argument of a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Argument {
    /// Positions q: rad, m.
    Q,
    /// Velocities v: rad/s, m/s.
    V,
    /// Accelerations a: rad/s², m/s².
    A,
    /// Joint efforts tau: N·m, N.
    Tau,
    /// Velocities q̇ of the open tree of a mechanism with loops: rad/s, m/s.
    TreeV,
    /// Efforts on the joints of the open tree: N·m, N.
    TreeTau,
    /// Efforts of the actuated joints, where these are not the independent ones: N·m, N.
    ActuatedTau,
    /// Velocities of a reference, v_r: rad/s, m/s.
    ReferenceV,
    /// Accelerations of a reference, a_r: rad/s², m/s².
    ReferenceA,
    /// A number for each velocity, s.
    Direction,
    /// Parameters of the bodies, π: kg, kg·m, kg·m².
    BodyParameters,
    /// Direction of the positions, dq: a number for each velocity, rad, m.
    AlongQ,
    /// Direction of the velocities, dv: rad/s, m/s.
    AlongV,
    /// Direction of the accelerations, da: rad/s², m/s².
    AlongA,
    /// Direction of the efforts, dtau: N·m, N.
    AlongTau,
    /// Factors l of the results of which an adjoint is the derivative.
    Cotangent,
    /// State of a scene.
    State,
    /// Inputs of a scene.
    Input,
    /// Accelerations of a scene's coordinates.
    Accelerations,
    /// State of a scene with momenta in place of velocities.
    Canonical,
    /// Modes of a scene, beside [`Argument::Canonical`].
    Modes,
    /// Time, s.
    Time,
}

impl Argument {
    /// Returns whether only functions of scenes have it.
    pub fn belongs_to_scene(self) -> bool {
        matches!(
            self,
            Argument::State
                | Argument::Input
                | Argument::Accelerations
                | Argument::Canonical
                | Argument::Modes
                | Argument::Time
        )
    }

    /// Returns its name in signatures.
    pub fn name(self) -> &'static str {
        match self {
            Argument::Q => "q",
            Argument::V => "v",
            Argument::A => "a",
            Argument::Tau | Argument::TreeTau | Argument::ActuatedTau => "tau",
            Argument::TreeV => "qd",
            Argument::ReferenceV => "v_r",
            Argument::ReferenceA => "a_r",
            Argument::Direction => "s",
            Argument::BodyParameters => "pi",
            Argument::AlongQ => "dq",
            Argument::AlongV => "dv",
            Argument::AlongA => "da",
            Argument::AlongTau => "dtau",
            Argument::Cotangent => "l",
            Argument::State => "state",
            Argument::Input => "input",
            Argument::Accelerations => "acceleration",
            Argument::Canonical => "z",
            Argument::Modes => "modes",
            Argument::Time => "t",
        }
    }
}
