//! Rigid contacts of a scene: their state, and how their impulses change the velocities.

/// The largest number of rigid contacts of a scene.
pub const MOST_CONTACTS: usize = 32;

/// The largest number of rigid contacts of a scene that is solved from event to event.
pub const MOST_EVENT_CONTACTS: usize = 8;

/// A rigid contact in a state of its scene. Components are along (x, y, normal) of the contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidContact<T> {
    /// g, the distance of the surfaces, m; negative where they overlap.
    pub gap: T,
    /// γ, the velocity of the sphere relative to its partner, m/s. A positive normal component separates.
    pub velocity: [T; 3],
    /// μ, the coefficient of friction.
    pub friction: T,
    /// e, the restitution: normal speed after an impact to that before it.
    pub restitution: T,
}

/// How a rigid contact and the velocities of a state act on each other. Only the components of velocities differ from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactMap<Y> {
    /// The rows of J: γ = J v and the motion of what is prescribed.
    pub rows: [Y; 3],
    /// The columns of M⁻¹ Jᵀ: the change of the velocities by a unit of impulse, 1/(N·s).
    pub columns: [Y; 3],
}

/// The law of restitution at impacts from event to event.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ImpactLaw {
    /// Newton's: γ_n⁺ ≥ −e γ_n⁻. Where it would add energy, which it can with friction, Poisson's law is taken, and the
    /// jump tells.
    #[default]
    Newton,
    /// Poisson's: the normal impulse of expansion is e times that of compression.
    Poisson,
}

impl ImpactLaw {
    /// All laws.
    pub const ALL: [ImpactLaw; 2] = [ImpactLaw::Newton, ImpactLaw::Poisson];

    /// Returns its name in scenes.
    pub fn name(self) -> &'static str {
        match self {
            ImpactLaw::Newton => "newton",
            ImpactLaw::Poisson => "poisson",
        }
    }

    /// Returns the law with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|law| law.name() == name)
    }
}
