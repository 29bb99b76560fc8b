//! The functions of a scene: what each of them computes.

/// What a function of a scene is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Role {
    /// v̇ and ẋ.
    Derivative,
    /// Efforts at the coordinates behind given accelerations.
    Inverse,
    /// The inputs that the scene itself drives.
    Inputs,
    /// Values whose fall through zero is an event.
    Events,
    /// Slip, its acceleration, holding effort and limit of each mode.
    Contacts,
    /// Power supplied, stored and dissipated by each effect.
    Power,
    /// Energy stored by each effect.
    Energy,
    /// The outputs asked for.
    Outputs,
    /// ∂ẏ/∂y and ∂ẏ/∂t, the inputs that the scene drives included: without the rows of q̇, column by
    /// column.
    Jacobian,
    /// Momenta of a state.
    ToCanonical,
    /// Velocities of momenta.
    FromCanonical,
    /// q̇, ṗ and ẋ at momenta, the inputs that the scene drives included.
    CanonicalRates,
}

impl Role {
    /// Every role.
    pub const ALL: [Role; 12] = [
        Role::Derivative,
        Role::Inverse,
        Role::Inputs,
        Role::Events,
        Role::Contacts,
        Role::Power,
        Role::Energy,
        Role::Outputs,
        Role::Jacobian,
        Role::ToCanonical,
        Role::FromCanonical,
        Role::CanonicalRates,
    ];

    /// Those of the canonical form.
    pub const CANONICAL: [Role; 3] = [Role::ToCanonical, Role::FromCanonical, Role::CanonicalRates];

    /// The method's name.
    pub fn name(self) -> &'static str {
        match self {
            Role::Derivative => "derivative",
            Role::Inverse => "inverse",
            Role::Inputs => "input",
            Role::Events => "events",
            Role::Contacts => "contacts",
            Role::Power => "power",
            Role::Energy => "energy",
            Role::Outputs => "output",
            Role::Jacobian => "jacobian",
            Role::ToCanonical => "to_canonical",
            Role::FromCanonical => "from_canonical",
            Role::CanonicalRates => "canonical_rates",
        }
    }

    /// What the result is: one line of documentation.
    pub fn summary(self) -> &'static str {
        match self {
            Role::Derivative => {
                "Rates of the state: accelerations, and rates of first-order states."
            }
            Role::Inverse => {
                "Efforts at the coordinates that produce these accelerations, as if no coordinate had an effort of its own: a force or torque at a joint, a voltage at a winding."
            }
            Role::Inputs => "The inputs: what the scene drives itself, and what is `given`.",
            Role::Events => "Values whose fall through zero is an event.",
            Role::Contacts => {
                "For each mode: slip, its acceleration, the effort that holds, the most that can hold."
            }
            Role::Power => {
                "Balance of power, W: Σ supplied = Σ rate of the energy stored + Σ dissipated."
            }
            Role::Energy => "Energy stored, J, effect by effect.",
            Role::Outputs => "The outputs that the scene asks for.",
            Role::Jacobian => {
                "(∂ẏ/∂y, ∂ẏ/∂t) of the rates under the inputs that the scene drives itself; `input` is what is `given`."
            }
            Role::ToCanonical => {
                "The state with the momenta p = M v in place of the velocities: kg·m²/s for a rotation, kg·m/s for a translation, the flux linkage V·s of a winding."
            }
            Role::FromCanonical => "The state of momenta: v = M⁻¹ p in place of p.",
            Role::CanonicalRates => {
                "Rates of the state with momenta: q̇ = M⁻¹ p, ṗ and ẋ, under the inputs that the scene drives itself; `input` is what is `given`."
            }
        }
    }
}
