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
#[derive(Clone, Debug, PartialEq)]
pub struct ContactMap<Y> {
    /// The rows of J: γ = J v and the motion of what is prescribed.
    pub rows: [Y; 3],
    /// The columns of M⁻¹ Jᵀ: the change of the velocities by a unit of impulse, 1/(N·s).
    pub columns: [Y; 3],
}
