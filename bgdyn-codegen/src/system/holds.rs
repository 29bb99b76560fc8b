//! Equations of coordinates that are held: by dry friction, or at the limit of their rate.

use super::coordinate_rows::{link_accelerations, own_inertia};
use super::summed::summed;
use super::{ActuatorEfforts, EffortSums, SceneEquations};
use crate::expr::{Builder, Expr};
use crate::formulation;
use crate::method::Method;

impl SceneEquations {
    /// Returns whether a joint of the links can be held, whose row of M q̈ = f is then replaced.
    pub(super) fn may_hold_joints(&self) -> bool {
        let joints = self.graph.coordinates.len();
        let modes = !self.scene.layout.modes.is_empty();
        modes && self.mode_coordinates().iter().any(|&j| j < joints)
    }
}

/// The additional results if joints are held.
pub(super) struct StuckSolution<'g> {
    /// Accelerations of all coordinates.
    pub accelerations: Vec<Expr<'g>>,
    /// For each contact the effort with which it holds its joint; the residual of the equation, which is
    /// zero if it slips.
    pub holding: Vec<Expr<'g>>,
}

/// Returns the accelerations if some coordinates are held.
pub(super) fn held<'g>(
    system: &SceneEquations,
    sums: &EffortSums<'g, '_>,
    b: &'g Builder,
) -> StuckSolution<'g> {
    let n = system.graph.coordinates.len();
    let own_holding = |j: usize, a: Expr<'g>| own_inertia(sums, j) * a - sums.effort(j);
    if sums.contacts().iter().all(|c| c.coordinate >= n) {
        let ways = system.graph.forward_dynamics();
        let forward = ways.first().expect("there is a way");
        let mut accelerations = link_accelerations(forward, sums, system);
        accelerations.extend(own_accelerations(system, sums, &Holding::new(sums)));
        let contacts = sums.contacts().iter().map(|c| c.coordinate);
        return StuckSolution {
            holding: contacts.map(|j| own_holding(j, accelerations[j])).collect(),
            accelerations,
        };
    }
    let holds = StuckJoints::new(sums);
    let bias = sums.method(Method::Bias);
    let force: Vec<Expr<'g>> = (0..n).map(|j| sums.effort(j) - bias[j]).collect();
    let mut accelerations = holds.solve(b, &force, &holds.at.counterparts);
    accelerations.extend(own_accelerations(system, sums, &holds.at));
    let holding = sums.contacts().iter().map(|c| {
        let j = c.coordinate;
        if j >= n {
            return own_holding(j, accelerations[j]);
        }
        let moved = (0..n).map(|k| holds.entry(j, k) * accelerations[k]);
        moved.fold(-force[j], |sum, x| sum + x)
    });
    StuckSolution {
        holding: holding.collect(),
        accelerations,
    }
}

/// Returns accelerations of the coordinates with a store of their own: I v̇ = E, or held.
pub(super) fn own_accelerations<'g>(
    system: &SceneEquations,
    sums: &EffortSums<'g, '_>,
    holding: &Holding<'g>,
) -> Vec<Expr<'g>> {
    let own = system.graph.coordinates.len()..system.scene.layout.nv();
    let free = |j| sums.effort(j) / own_inertia(sums, j);
    own.map(|j| holding.known(j, free(j), &holding.counterparts[j]))
        .collect()
}

/// The coordinates that can be held, and their motion if they are.
pub(super) struct Holding<'g> {
    half: Expr<'g>,
    /// For each coordinate, r̈ of its possible contacts.
    pub counterparts: Vec<Vec<Expr<'g>>>,
    /// The modes of these contacts.
    modes: Vec<Vec<Expr<'g>>>,
}

impl<'g> Holding<'g> {
    pub(super) fn new(sums: &EffortSums<'g, '_>) -> Self {
        let nv = sums.v.len();
        let mut holding = Holding {
            half: sums.b.number(0.5),
            counterparts: vec![Vec::new(); nv],
            modes: vec![Vec::new(); nv],
        };
        for c in sums.contacts() {
            holding.counterparts[c.coordinate].push(c.reference[1]);
            holding.modes[c.coordinate].push(sums.mode_at(c.mode));
        }
        holding
    }

    /// Returns `yes` if coordinate `j` is held, else `no`.
    pub(super) fn choose(&self, j: usize, yes: Expr<'g>, no: Expr<'g>) -> Expr<'g> {
        let modes = self.modes[j].iter();
        modes.fold(no, |no, mode| mode.abs().if_less(self.half, yes, no))
    }

    /// Returns the entry of `counterparts` for the contact that holds the coordinate, or `free` if none
    /// does.
    pub(super) fn known(&self, j: usize, free: Expr<'g>, counterparts: &[Expr<'g>]) -> Expr<'g> {
        let all = self.modes[j].iter().zip(counterparts);
        all.fold(free, |free, (mode, &reference)| {
            mode.abs().if_less(self.half, reference, free)
        })
    }
}

/// The equations of the links if joints can be held: the rows of held joints in M q̈ = f are replaced by
/// q̈_j = r̈_j, and known terms move to the right-hand side of the other rows. A coordinate with a store
/// of its own has a row of its own, I_j q̈_j = f_j.
pub(super) struct StuckJoints<'g> {
    /// The coordinates that can be held.
    pub at: Holding<'g>,
    /// Lower triangle of M.
    triangle: Vec<Expr<'g>>,
    /// Number of coordinates in M.
    n: usize,
}

impl<'g> StuckJoints<'g> {
    pub(super) fn new(sums: &EffortSums<'g, '_>) -> Self {
        let triangle = sums.method(Method::MassMatrix);
        let n = (0..).find(|n| n * (n + 1) / 2 == triangle.len());
        StuckJoints {
            at: Holding::new(sums),
            n: n.unwrap_or(0),
            triangle,
        }
    }

    /// Returns M_ij.
    pub(super) fn entry(&self, i: usize, j: usize) -> Expr<'g> {
        self.triangle[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)]
    }

    /// Returns the accelerations of the links' coordinates under these forces, with these accelerations of
    /// the counterparts of held coordinates.
    pub(super) fn solve(
        &self,
        b: &'g Builder,
        force: &[Expr<'g>],
        counterparts: &[Vec<Expr<'g>>],
    ) -> Vec<Expr<'g>> {
        let (zero, one) = (b.zero(), b.number(1.0));
        let mut mass: Vec<Vec<Expr<'g>>> = Vec::new();
        let mut right = force.to_vec();
        for i in 0..self.n {
            let row = (0..=i).map(|j| {
                let own = if i == j { one } else { zero };
                self.at
                    .choose(i, own, self.at.choose(j, own, self.entry(i, j)))
            });
            mass.push(row.collect());
            for j in (0..self.n).filter(|&j| j != i) {
                let moved = counterparts[j].iter().map(|&r| self.entry(i, j) * r);
                let moved: Vec<Expr<'g>> = moved.collect();
                right[i] = right[i] - self.at.known(j, zero, &moved);
            }
        }
        let right = right.into_iter().enumerate();
        let right = right.map(|(j, f)| self.at.known(j, f, &counterparts[j]));
        formulation::solve_symmetric(b, mass, right.collect())
    }
}

/// Returns for each mode its slip, the acceleration of its slip, the effort it holds or would have to hold
/// for its present acceleration, and the margin until it breaks away.
pub(super) fn contacts<'g>(system: &SceneEquations, b: &'g Builder) -> Vec<Expr<'g>> {
    let sums = summed(b, &system.scene, &system.graph, ActuatorEfforts::FromInputs);
    contacts_under(system, &sums)
        .into_iter()
        .flatten()
        .collect()
}

/// Returns the same for each mode, under these laws.
pub(super) fn contacts_under<'g>(
    system: &SceneEquations,
    sums: &EffortSums<'g, '_>,
) -> Vec<[Expr<'g>; 4]> {
    let held = held(system, sums, sums.b);
    let mut rows = vec![[sums.b.zero(); 4]; system.scene.layout.modes.len()];
    for (c, holding) in sums.contacts().iter().zip(held.holding) {
        let relative = held.accelerations[c.coordinate] - c.reference[1];
        rows[c.mode] = [c.slip, relative, holding, sums.margin(c, holding)];
    }
    rows
}
