//! The functions of a scene: names and descriptions.

/// A function of a scene, by its result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SceneFunction {
    /// v̇ and ẋ, then the rates of positions that are not velocities: those of q̇ = N(q) v.
    Derivative,
    /// Drives of the coordinates for given accelerations.
    Inverse,
    /// The inputs, with those that the scene drives.
    Inputs,
    /// Event functions; an event occurs where one falls through zero.
    Events,
    /// Slip, its acceleration, holding effort and margin of each mode.
    Contacts,
    /// Gap, velocity, friction and restitution of each rigid contact.
    RigidContactStates,
    /// The Jacobian of each rigid contact, and M⁻¹ Jᵀ.
    RigidContactMaps,
    /// γ̇ of each rigid contact at v̇ = 0.
    RigidContactBiases,
    /// Power supplied, stored and dissipated by each effect.
    Power,
    /// Energy stored by each effect.
    Energy,
    /// The outputs of the scene.
    Outputs,
    /// ∂ẏ/∂y and ∂ẏ/∂t, including the inputs that the scene drives, column by column in the order of the
    /// derivative.
    Jacobian,
    /// ∂ẏ/∂u, column by column in the order of the derivative.
    InputJacobian,
    /// Momenta of a state.
    ToCanonical,
    /// Velocities from momenta.
    FromCanonical,
    /// q̇, ṗ and ẋ from momenta, including the inputs that the scene drives.
    CanonicalRates,
    /// Rates of all positions.
    PositionRates,
    /// Newton steps of the positions that close the loops.
    ClosingStep,
}

impl SceneFunction {
    /// All functions.
    pub const ALL: [SceneFunction; 18] = [
        SceneFunction::Derivative,
        SceneFunction::Inverse,
        SceneFunction::Inputs,
        SceneFunction::Events,
        SceneFunction::Contacts,
        SceneFunction::RigidContactStates,
        SceneFunction::RigidContactMaps,
        SceneFunction::RigidContactBiases,
        SceneFunction::Power,
        SceneFunction::Energy,
        SceneFunction::Outputs,
        SceneFunction::Jacobian,
        SceneFunction::InputJacobian,
        SceneFunction::ToCanonical,
        SceneFunction::FromCanonical,
        SceneFunction::CanonicalRates,
        SceneFunction::PositionRates,
        SceneFunction::ClosingStep,
    ];

    /// The functions of the canonical form.
    pub const CANONICAL: [SceneFunction; 3] = [
        SceneFunction::ToCanonical,
        SceneFunction::FromCanonical,
        SceneFunction::CanonicalRates,
    ];

    /// Returns the method's name.
    pub fn name(self) -> &'static str {
        match self {
            SceneFunction::Derivative => "derivative",
            SceneFunction::Inverse => "inverse",
            SceneFunction::Inputs => "input",
            SceneFunction::Events => "events",
            SceneFunction::Contacts => "contacts",
            SceneFunction::RigidContactStates => "rigid_contact_states",
            SceneFunction::RigidContactMaps => "rigid_contact_maps",
            SceneFunction::RigidContactBiases => "rigid_contact_biases",
            SceneFunction::Power => "power",
            SceneFunction::Energy => "energy",
            SceneFunction::Outputs => "output",
            SceneFunction::Jacobian => "jacobian",
            SceneFunction::InputJacobian => "input_jacobian",
            SceneFunction::ToCanonical => "to_canonical",
            SceneFunction::FromCanonical => "from_canonical",
            SceneFunction::CanonicalRates => "canonical_rates",
            SceneFunction::PositionRates => "position_rates",
            SceneFunction::ClosingStep => "closing_step",
        }
    }

    /// Describes the result: one line of documentation.
    pub fn summary(self) -> &'static str {
        match self {
            SceneFunction::Derivative => {
                "Rates of the state: accelerations, and rates of first-order states."
            }
            SceneFunction::Inverse => {
                "Efforts at the coordinates that produce these accelerations, as if no coordinate had an effort of its own: a force or torque at a joint, a voltage at a winding."
            }
            SceneFunction::Inputs => {
                "The inputs: what the scene drives itself, and what is `given`."
            }
            SceneFunction::Events => "Values whose fall through zero is an event.",
            SceneFunction::Contacts => {
                "For each mode: slip, its acceleration, the effort that holds, the most that can hold."
            }
            SceneFunction::RigidContactStates => {
                "For each rigid contact: gap, velocity along x, y and normal, coefficient of friction, restitution."
            }
            SceneFunction::RigidContactMaps => {
                "For each rigid contact: the rows of its Jacobian along x, y and normal, and the columns of M⁻¹ Jᵀ."
            }
            SceneFunction::RigidContactBiases => {
                "For each rigid contact: γ̇ at v̇ = 0 along x, y and normal, m/s²: γ̇ = J v̇ + this."
            }
            SceneFunction::Power => {
                "Balance of power, W: Σ supplied = Σ rate of the energy stored + Σ dissipated."
            }
            SceneFunction::Energy => "Energy stored, J, effect by effect.",
            SceneFunction::Outputs => "The outputs that the scene asks for.",
            SceneFunction::Jacobian => {
                "(∂ẏ/∂y, ∂ẏ/∂t) of the rates under the inputs that the scene drives itself; `input` is what is `given`."
            }
            SceneFunction::InputJacobian => {
                "∂ẏ/∂u of the rates: `input` is all inputs, as in `derivative`."
            }
            SceneFunction::ToCanonical => {
                "The state with the momenta p = M v in place of the velocities: kg·m²/s for a rotation, kg·m/s for a translation, the flux linkage V·s of a winding."
            }
            SceneFunction::FromCanonical => "The state of momenta: v = M⁻¹ p in place of p.",
            SceneFunction::CanonicalRates => {
                "Rates of the state with momenta: q̇ = M⁻¹ p, ṗ and ẋ, under the inputs that the scene drives itself; `input` is what is `given`."
            }
            SceneFunction::PositionRates => {
                "Rates of the positions: q̇ = S(q) v for joints in loops."
            }
            SceneFunction::ClosingStep => {
                "Newton step of the positions: less this, the loops are open by the square of it."
            }
        }
    }
}
