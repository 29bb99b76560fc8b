//! The parts that laws add to a scene: ports, power balances, contacts, readings, conditions.

use bgdyn_runtime::Dd;

use crate::expr::Expr;

/// The port of an effort: a displacement s(q), its rate, and the transformers ∂s/∂q_j.
#[derive(Clone, Debug)]
pub struct Port<'g> {
    /// s, rad or m.
    pub displacement: Expr<'g>,
    /// ṡ = Σ ∂s/∂q_j q̇_j
    pub rate: Expr<'g>,
    /// Coordinates with their ∂s/∂q_j.
    pub transformers: Vec<(usize, Expr<'g>)>,
}

impl Port<'_> {
    /// Returns the velocity of the port per unit velocity of its coordinate, for the port of a joint: 1, or the
    /// ratio to the joint that it follows.
    pub(super) fn factor(&self) -> Dd {
        let first = self.transformers.first();
        first
            .and_then(|(_, transformer)| transformer.as_constant())
            .unwrap_or(Dd::ONE)
    }
}

/// The power and energy that an element supplies, stores and dissipates.
#[derive(Clone, Copy, Debug)]
pub struct Balance<'g> {
    /// Power from outside, W.
    pub supplied: Expr<'g>,
    /// Energy stored, J.
    pub stored: Expr<'g>,
    /// Dissipated power, W.
    pub dissipated: Expr<'g>,
}

/// A contact that can hold a coordinate at the rate of a counterpart: dry friction, the limit of a rate.
#[derive(Clone, Copy, Debug)]
pub struct Contact<'g> {
    /// Index of its element in the scene.
    pub element: usize,
    /// The mode that is 0 if it holds.
    pub mode: usize,
    /// The coordinate it acts on.
    pub coordinate: usize,
    /// Rate of the coordinate relative to the counterpart.
    pub slip: Expr<'g>,
    /// Speed and acceleration of the counterpart.
    pub reference: [Expr<'g>; 2],
    /// The efforts with which it can hold.
    pub hold: Hold<'g>,
}

/// The efforts that a contact can hold with.
#[derive(Clone, Copy, Debug)]
pub enum Hold<'g> {
    /// Up to this size in both directions: dry friction.
    Within(Expr<'g>),
    /// Between these two, with 0 in the range: the losses of a gear under load.
    Between([Expr<'g>; 2]),
    /// Any effort that lowers the rate: an upper limit.
    Lowers,
    /// Any effort that raises the rate: a lower limit.
    Raises,
}

impl<'g> Hold<'g> {
    /// Returns the efforts on a coordinate, which are `factor` times these.
    pub(super) fn times(self, factor: Dd) -> Self {
        let turned = factor < Dd::ZERO;
        match self {
            Hold::Within(limit) if turned => Hold::Within(limit * -factor),
            Hold::Within(limit) => Hold::Within(limit * factor),
            Hold::Between([least, most]) => match (least * factor, most * factor) {
                (least, most) if turned => Hold::Between([most, least]),
                (least, most) => Hold::Between([least, most]),
            },
            Hold::Lowers if turned => Hold::Raises,
            Hold::Raises if turned => Hold::Lowers,
            hold => hold,
        }
    }

    /// Returns the least and the largest effort of a friction; `None` for the limit of a rate.
    pub fn range(&self) -> Option<[Expr<'g>; 2]> {
        match *self {
            Hold::Within(limit) => Some([-limit, limit]),
            Hold::Between(range) => Some(range),
            Hold::Lowers | Hold::Raises => None,
        }
    }
}

/// An output quantity: a force, a pressure.
#[derive(Clone, Debug)]
pub struct Reading<'g> {
    /// `belt_force`
    pub name: String,
    /// Its value.
    pub value: Expr<'g>,
    /// Its SI unit.
    pub unit: &'static str,
    /// Unit and meaning.
    pub about: String,
}

/// A value that must be positive.
#[derive(Clone, Debug)]
pub(crate) struct Condition<'g> {
    /// Index of its element in the scene.
    pub element: usize,
    /// The value.
    pub value: Expr<'g>,
    /// Description, with the unit.
    pub what: String,
    /// Advice if it is not positive.
    pub way_out: &'static str,
}

/// The role of the drives (joint efforts, voltages) of the coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ActuatorEfforts {
    /// Inputs, if the scene has them.
    FromInputs,
    /// Unknown: the laws run with zero drives, and no drive has a limit.
    Unknown,
    /// One per coordinate, in place of its acceleration among the leaves; no drive has a limit. Inverse of
    /// [`ActuatorEfforts::Unknown`].
    Each,
}

/// The spring of a compliant contact.
#[derive(Clone, Copy, Debug)]
pub struct ContactSpring<'g> {
    /// The index of its element.
    pub element: usize,
    /// The index of its contact among those of the mechanism.
    pub contact: usize,
    /// k, N/m^1.5 or N/m.
    pub stiffness: Expr<'g>,
    /// Whether the force is k δ^{3/2} (Hertz), and not k δ.
    pub hertz: bool,
}

/// The law of a rigid contact.
#[derive(Clone, Copy, Debug)]
pub struct RigidLaw<'g> {
    /// The index of its element.
    pub element: usize,
    /// The index of its contact among those of the mechanism.
    pub contact: usize,
    /// μ
    pub friction: Expr<'g>,
    /// e
    pub restitution: Expr<'g>,
}
