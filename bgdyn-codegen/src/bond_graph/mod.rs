//! The bond graph of a mechanism, as plain data (Kuzmin 2007).
//!
//! Each generalized velocity has a 1-junction with a drive P_j. Each link has a translational and a
//! rotational junction, each with an inertial store and an effort source. Modulated transformers ∂r_i/∂q_j
//! and ρ_j^i connect them. A transformer that is structurally zero is omitted; a component that is zero or
//! constant is marked. This is the sparsity of the graph. Moduli are functions of the poses of the link
//! frames, which are part of the graph's data.

mod build;
mod causality;
mod free_base;
mod joint_segments;
mod massless;
mod moved_masses;
mod multibody;
mod network;
mod node;
mod pattern;
mod prescribed;
mod released;
mod transformers;

use std::ops::Deref;

use bgdyn_runtime::Dd;

use crate::math::Vec3;
use crate::mechanism::closure::{Actuated, Closure};
use crate::mechanism::{CoordinateId, LinkId, Mechanism, Value};

pub use build::build;
pub use causality::Causality;
pub use free_base::{FreeBase, snap, tidy};
pub use joint_segments::{JointSegment, joint_segments};
pub use moved_masses::with_moved_masses;
pub use multibody::{
    Coordinate, Gyrostat, LinkFrame, Multibody, PositionVariable, Rotor, Site, SiteId,
};
pub use network::BondNetwork;
pub use node::{Bond, GraphNode, GraphNodeId, NodeKind, NodePart, PlacePort, PortSite, PowerTerm};
pub use pattern::Modulus;
pub use prescribed::{FreeArgument, PrescribedVelocity};

/// A junction of [`BondGraph::junctions`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct JunctionId(pub usize);

/// The flow that a 1-junction carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Junction {
    /// The generalized velocity q̇_j, with the drive P_j as an effort source on it.
    Velocity(CoordinateId),
    /// ṙ_i, the velocity of a link's centre of mass, fixed axes.
    Translation(LinkId),
    /// ω_i, the angular velocity of a link, fixed axes.
    Rotation(LinkId),
}

/// The inertia of an inertial store.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StoreInertia {
    /// Mass m_i, kg.
    Mass(Value),
    /// Tensor J_i⁰ about the centre of mass in [`LinkFrame::tensor_axes`], kg·m²: xx, yy, zz, xy,
    /// xz, yz.
    Tensor([Value; 6]),
}

/// An inertial store on a junction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Store {
    /// The junction of the store.
    pub junction: JunctionId,
    /// The inertia.
    pub inertia: StoreInertia,
}

/// An active effort other than a drive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Effort {
    /// Weight: m_i g in fixed axes, N.
    Weight {
        /// m_i, kg.
        mass: Value,
        /// g, m/s².
        gravity: Vec3<Dd>,
    },
}

/// An effort source: R_i or M_i, the sum of its efforts.
#[derive(Clone, Debug, PartialEq)]
pub struct EffortSource {
    /// The junction of the source.
    pub junction: JunctionId,
    /// The efforts in the sum; with none the source is zero.
    pub efforts: Vec<Effort>,
}

/// A modulated transformer from a generalized velocity to a link's flow.
#[derive(Clone, Debug, PartialEq)]
pub struct Transformer {
    /// The junction of q̇_j.
    pub from: JunctionId,
    /// The junction of ṙ_i or ω_i.
    pub to: JunctionId,
    /// ∂r_i/∂q_j or ρ_j^i, fixed axes, component by component.
    pub modulus: Vec3<Modulus>,
}

/// The bond graph of a mechanism. It dereferences to its [`Multibody`].
#[derive(Clone, Debug, PartialEq)]
pub struct BondGraph {
    /// The bodies, joints and rotors of the mechanism.
    pub multibody: Multibody,
    /// 1-junctions: velocities first, then a translational and a rotational one per link.
    pub junctions: Vec<Junction>,
    /// Inertial stores, two per link.
    pub stores: Vec<Store>,
    /// Effort sources R_i and M_i, two per link.
    pub sources: Vec<EffortSource>,
    /// Modulated transformers.
    pub transformers: Vec<Transformer>,
    /// The mechanism in which the prescribed joints are free, if there are such joints. In this one they have no
    /// coordinates, and their frames no poses.
    pub released: Option<Box<Released>>,
    /// The loops, with the graph of the open tree; then the coordinates are the independent ones.
    pub closed: Option<Box<ClosedTree>>,
    /// The names of the loops that are closed by joints that follow, whose multipliers no equation contains.
    pub parallel: Vec<String>,
}

/// An open tree with loops that close it.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosedTree {
    /// The graph of the open tree.
    pub tree: BondGraph,
    /// The loops; their coordinates are those of the tree.
    pub closure: Closure,
}

impl ClosedTree {
    /// Returns the names of actuated joints.
    pub fn joint_names(&self, actuated: &Actuated) -> Vec<&str> {
        let all = &self.tree.coordinates;
        let joints = actuated.joints.iter();
        joints.map(|j| all[j.0].name.as_str()).collect()
    }

    /// Returns the names of the actuated joints, if they are not the independent ones; else none.
    pub fn drive_names(&self) -> Vec<&str> {
        let drives = self.closure.drives();
        drives.map_or_else(Vec::new, |actuated| self.joint_names(actuated))
    }
}

/// The mechanism in which the prescribed joints are free. It dereferences to its bond graph.
#[derive(Clone, Debug, PartialEq)]
pub struct Released {
    graph: BondGraph,
    /// The prescribed joints, in the order of the links.
    pub prescribed: Vec<PrescribedVelocity>,
    /// The origins of its positions.
    pub positions: Vec<FreeArgument>,
    /// The origins of its velocities.
    pub velocities: Vec<FreeArgument>,
}

impl Deref for Released {
    type Target = BondGraph;

    fn deref(&self) -> &BondGraph {
        &self.graph
    }
}

impl Deref for BondGraph {
    type Target = Multibody;

    fn deref(&self) -> &Multibody {
        &self.multibody
    }
}

impl BondGraph {
    /// Returns the graph without weights, link tensors and velocity products. Every scene starts from it
    /// and adds these.
    pub fn without_loads(mut self) -> Self {
        let rotational = |s: &Store| matches!(s.inertia, StoreInertia::Tensor(_));
        self.stores.retain(|s| !rotational(s));
        for source in &mut self.sources {
            source.efforts.clear();
        }
        self.multibody.gravity = Vec3([Dd::ZERO; 3]);
        self.multibody.velocity_products = false;
        for inertial in &mut self.multibody.inertials {
            inertial.inertia.entries = [Value::Fixed(Dd::ZERO); 6];
        }
        self
    }

    /// Returns the graph with the junctions of all joints: prescribed ones, with the flow sources of their velocities,
    /// and those of the open tree of a mechanism with loops.
    pub fn of_all_joints(&self) -> &BondGraph {
        match (&self.released, &self.closed) {
            (Some(released), _) => released,
            (None, Some(closed)) => &closed.tree,
            (None, None) => self,
        }
    }

    /// Adds its weight to every link.
    pub fn add_gravity(&mut self, gravity: Vec3<Dd>) {
        self.multibody.gravity = gravity;
        for i in 0..self.frames.len() {
            let mass = self.inertial(LinkId(i)).mass;
            let junction = self.translation(LinkId(i));
            let own = self.sources.iter_mut().find(|s| s.junction == junction);
            if let Some(source) = own {
                source.efforts = vec![Effort::Weight { mass, gravity }];
            }
        }
    }

    /// Adds its inertia tensor to every link.
    pub fn add_link_inertia(&mut self, mechanism: &Mechanism) {
        for (i, link) in mechanism.links().iter().enumerate() {
            let entries = link.inertial.inertia.entries;
            self.multibody.inertials[i].inertia.entries = entries;
            self.stores.push(Store {
                junction: self.rotation(LinkId(i)),
                inertia: StoreInertia::Tensor(entries),
            });
        }
    }

    /// Returns q̇ = N(q) v; with loops q̇ = N(q) S(q) v.
    ///
    /// # Panics
    /// At a singular position of a loop.
    pub fn position_rates(&self, q: &[Dd], v: &[Dd]) -> Vec<Dd> {
        let Some(closed) = &self.closed else {
            return self.multibody.position_rates(q, v);
        };
        let map = closed.closure.velocity_map(q);
        let map = map.expect("a regular position of the loops");
        let sum = |row: &Vec<Dd>| {
            let terms = row.iter().zip(v);
            terms.fold(Dd::ZERO, |sum, (s, v)| sum + *s * *v)
        };
        let all: Vec<Dd> = map.iter().map(sum).collect();
        closed.tree.multibody.position_rates(q, &all)
    }

    /// Returns the number of directions along which derivatives with respect to positions are taken: the velocities, or
    /// those of the open tree where conditions on velocities alone leave more ways to move.
    pub fn directions(&self) -> usize {
        let closed = self.closed.as_ref();
        let slips = closed.filter(|closed| closed.closure.nonholonomic());
        slips.map_or(self.coordinates.len(), |closed| {
            closed.tree.coordinates.len()
        })
    }

    /// Returns the rates of the positions along these directions: q̇ = N(q) v, or along velocities of the open tree, after
    /// the least change with which positions stay closed.
    ///
    /// # Panics
    /// At a singular position of a loop.
    pub fn rates_along(&self, q: &[Dd], direction: &[Dd]) -> Vec<Dd> {
        let closed = self.closed.as_ref();
        let Some(closed) = closed.filter(|closed| closed.closure.nonholonomic()) else {
            return self.position_rates(q, direction);
        };
        let moved = closed.closure.closed_along(q, direction);
        let moved = moved.expect("a regular position of the loops");
        closed.tree.multibody.position_rates(q, &moved)
    }

    /// Returns the junction of q̇_j.
    pub fn velocity(&self, j: CoordinateId) -> JunctionId {
        JunctionId(j.0)
    }

    /// Returns the junction of ṙ_i.
    pub fn translation(&self, i: LinkId) -> JunctionId {
        JunctionId(self.coordinates.len() + 2 * i.0)
    }

    /// Returns the junction of ω_i.
    pub fn rotation(&self, i: LinkId) -> JunctionId {
        JunctionId(self.coordinates.len() + 2 * i.0 + 1)
    }

    /// Returns the transformers that feed a junction.
    pub fn into(&self, junction: JunctionId) -> impl Iterator<Item = &Transformer> {
        self.transformers.iter().filter(move |t| t.to == junction)
    }
}
