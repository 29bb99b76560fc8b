//! What laws add to a scene: ports, power balances, contacts, readings, conditions.

use crate::expr::Expr;

/// Where an effort acts: a displacement s(q), its rate, and the transformers ∂s/∂q_j.
#[derive(Clone, Debug)]
pub struct Port<'g> {
    /// s, rad or m.
    pub displacement: Expr<'g>,
    /// ṡ = Σ ∂s/∂q_j q̇_j
    pub rate: Expr<'g>,
    /// Coordinates with their ∂s/∂q_j.
    pub transformers: Vec<(usize, Expr<'g>)>,
}

/// What an element supplies, stores and dissipates.
#[derive(Clone, Copy, Debug)]
pub struct Balance<'g> {
    /// Power that comes from outside, W.
    pub supplied: Expr<'g>,
    /// Energy stored, J.
    pub stored: Expr<'g>,
    /// Power that is lost, W.
    pub dissipated: Expr<'g>,
}

/// What can hold a coordinate at the rate of a counterpart: dry friction, the limit of a rate.
#[derive(Clone, Copy, Debug)]
pub struct Contact<'g> {
    /// The element it belongs to, by its place in the scene.
    pub element: usize,
    /// The mode that tells whether it holds.
    pub mode: usize,
    /// The coordinate it acts on.
    pub coordinate: usize,
    /// Rate of the coordinate against the counterpart.
    pub slip: Expr<'g>,
    /// Speed and acceleration of the counterpart.
    pub reference: [Expr<'g>; 2],
    /// The efforts it can hold with.
    pub hold: Hold<'g>,
}

/// The efforts that a contact can hold with.
#[derive(Clone, Copy, Debug)]
pub enum Hold<'g> {
    /// As large as this in both directions: dry friction.
    Within(Expr<'g>),
    /// From the first to the second, with 0 among them: the losses of a gear under load.
    Between([Expr<'g>; 2]),
    /// Of any size that lowers the rate: an upper limit.
    Lowers,
    /// Of any size that raises the rate: a lower limit.
    Raises,
}

impl<'g> Hold<'g> {
    /// The least and the largest effort of a friction; `None` of the limit of a rate.
    pub fn range(&self) -> Option<[Expr<'g>; 2]> {
        match *self {
            Hold::Within(limit) => Some([-limit, limit]),
            Hold::Between(range) => Some(range),
            Hold::Lowers | Hold::Raises => None,
        }
    }
}

/// A quantity worth knowing: a force, a pressure.
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
    /// The element that asks for it, by its place in the scene.
    pub element: usize,
    /// The value.
    pub value: Expr<'g>,
    /// What it is, with its unit.
    pub what: String,
    /// What to do where it is not.
    pub way_out: &'static str,
}

/// What the coordinates' own efforts (joint efforts, voltages) are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ActuatorEfforts {
    /// Inputs, where the scene has them.
    FromInputs,
    /// Unknown: the laws run as if there were none, and no drive has a limit.
    Unknown,
    /// One at every coordinate, in place of its acceleration among the leaves; no drive has a
    /// limit. Undoes what [`ActuatorEfforts::Unknown`] finds.
    Each,
}
