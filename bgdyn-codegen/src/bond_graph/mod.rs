//! The bond graph of a mechanism, as plain data (Kuzmin 2007).
//!
//! One 1-junction per generalized velocity with a drive P_j on it; per link a translational and a
//! rotational junction, each with an inertial store and an effort source; between them modulated
//! transformers ∂r_i/∂q_j and ρ_j^i. A transformer that the structure makes zero does not exist; a
//! component that is zero or constant says so: that is the graph's sparsity. Moduli are functions
//! of the placement of the link frames, which stand beside the graph.

mod build;
mod causality;
mod inert;
mod network;
mod node;
mod pattern;

use bgdyn_runtime::Dd;

use crate::math::{Mat3, Vec3};
use crate::mechanism::{
    CoordinateId, Inertial, LinkId, Mechanism, Motion, Parameter, Pose, Tensor, Value,
};

pub use build::build;
pub use causality::Causality;
pub use network::BondNetwork;
pub use node::{Bond, GraphNode, GraphNodeId, NodeKind, NodePart, PlacePort, PortPlace, PowerTerm};
pub use pattern::Modulus;

/// A junction of [`BondGraph::junctions`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct JunctionId(pub usize);

/// A place of [`BondGraph::sites`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SiteId(pub usize);

/// A named place whose motion can be asked for: a link's frame, or a frame named in the spec.
#[derive(Clone, Debug, PartialEq)]
pub struct Site {
    /// The link's or the frame's name.
    pub name: String,
    /// The link it is fixed to; `None` for the world.
    pub link: Option<LinkId>,
    /// Its axes and origin in the link's axes.
    pub place: Pose,
    /// Whether the spec names it as a frame, or no other link hangs on it: what a user asks for
    /// who asks for nothing in particular.
    pub prominent: bool,
}

/// What flow a 1-junction carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Junction {
    /// The generalized velocity q̇_j, with the drive P_j as an effort source on it.
    Velocity(CoordinateId),
    /// ṙ_i, the velocity of a link's centre of mass, fixed axes.
    Translation(LinkId),
    /// ω_i, the angular velocity of a link, fixed axes.
    Rotation(LinkId),
}

/// What an inertial store stores.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Inertia {
    /// Mass m_i, kg.
    Mass(Value),
    /// Tensor J_i⁰ about the centre of mass in [`LinkFrame::tensor_axes`], kg·m²: xx, yy, zz, xy,
    /// xz, yz.
    Tensor([Value; 6]),
}

/// An inertial store on a junction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Store {
    /// Where it is.
    pub junction: JunctionId,
    /// What it stores.
    pub inertia: Inertia,
}

/// An active effort that is not a drive.
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
pub struct Source {
    /// Where it is.
    pub junction: JunctionId,
    /// What acts; nothing in the sum is a source of zero effort.
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

/// Placement of a link's frame: what the moduli are functions of.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkFrame {
    /// The link's name.
    pub name: String,
    /// The link that carries it.
    pub parent: Option<LinkId>,
    /// Link axes in the parent's at coordinate zero.
    pub origin: Pose,
    /// What the joint lets it do.
    pub motion: Motion,
    /// Unit vector of the joint's axis in link axes.
    pub axis: Vec3<Dd>,
    /// The coordinate that moves it.
    pub coordinate: Option<CoordinateId>,
    /// Centre of mass in link axes, m.
    pub com: Vec3<Value>,
    /// Columns: axes of the inertia tensor's entries in the link's.
    pub tensor_axes: Mat3<Dd>,
}

/// A generalized coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct Coordinate {
    /// Its joint's name.
    pub name: String,
    /// The link that its joint carries.
    pub link: LinkId,
    /// Angle or displacement.
    pub motion: Motion,
}

/// An inertial store on the junction of a generalized velocity: a rotor behind a gear.
#[derive(Clone, Debug, PartialEq)]
pub struct Rotor {
    /// The velocity q̇_j.
    pub coordinate: CoordinateId,
    /// J, kg·m² (kg for a displacement).
    pub inertia: Value,
    /// N, turns of the rotor per unit of the joint.
    pub ratio: Value,
    /// What it turns with, if it is a full rotor.
    pub carrier: Option<Gyrostat>,
}

/// How a rotor sits on a link: per unit rate of the joint it has the momentum N J e there.
#[derive(Clone, Debug, PartialEq)]
pub struct Gyrostat {
    /// The link.
    pub link: LinkId,
    /// e, its axis in the link's axes.
    pub axis: Vec3<Dd>,
}

/// The bond graph.
#[derive(Clone, Debug, PartialEq)]
pub struct BondGraph {
    /// Generalized coordinates, in the order of q.
    pub coordinates: Vec<Coordinate>,
    /// Frames of the links, parents before children.
    pub frames: Vec<LinkFrame>,
    /// 1-junctions: velocities first, then a translational and a rotational one per link.
    pub junctions: Vec<Junction>,
    /// Inertial stores, two per link.
    pub stores: Vec<Store>,
    /// Effort sources R_i and M_i, two per link.
    pub sources: Vec<Source>,
    /// Modulated transformers.
    pub transformers: Vec<Transformer>,
    /// Gravity, m/s², fixed axes.
    pub gravity: Vec3<Dd>,
    /// Rotors behind gears.
    pub rotors: Vec<Rotor>,
    /// Whether the transformers' rates count: Coriolis, centrifugal and gyroscopic efforts.
    pub velocity_products: bool,
    /// Run-time parameters that values refer to.
    pub parameters: Vec<Parameter>,
    /// The links' frames, then the named ones.
    pub sites: Vec<Site>,
}

impl BondGraph {
    /// The same graph without weights, link tensors and velocity products: what every scene begins
    /// with, and adds to.
    pub fn bare(mut self) -> Self {
        let rotational = |s: &Store| matches!(s.inertia, Inertia::Tensor(_));
        self.stores.retain(|s| !rotational(s));
        for source in &mut self.sources {
            source.efforts.clear();
        }
        self.gravity = Vec3([Dd::ZERO; 3]);
        self.velocity_products = false;
        self
    }

    /// Gives every link its weight.
    pub fn weigh(&mut self, gravity: Vec3<Dd>) {
        self.gravity = gravity;
        for i in 0..self.frames.len() {
            let mass = self.inertial(LinkId(i)).mass;
            let junction = self.translation(LinkId(i));
            let own = self.sources.iter_mut().find(|s| s.junction == junction);
            if let Some(source) = own {
                source.efforts = vec![Effort::Weight { mass, gravity }];
            }
        }
    }

    /// Gives every link its tensor.
    pub fn distribute(&mut self, mechanism: &Mechanism) {
        for (i, link) in mechanism.links().iter().enumerate() {
            self.stores.push(Store {
                junction: self.rotation(LinkId(i)),
                inertia: Inertia::Tensor(link.inertial.inertia.entries),
            });
        }
    }

    /// The coordinate of the joint with this name.
    pub fn coordinate_named(&self, name: &str) -> Option<CoordinateId> {
        let found = self.coordinates.iter().position(|c| c.name == name);
        found.map(CoordinateId)
    }

    /// The junction of q̇_j.
    pub fn velocity(&self, j: CoordinateId) -> JunctionId {
        JunctionId(j.0)
    }

    /// The junction of ṙ_i.
    pub fn translation(&self, i: LinkId) -> JunctionId {
        JunctionId(self.coordinates.len() + 2 * i.0)
    }

    /// The junction of ω_i.
    pub fn rotation(&self, i: LinkId) -> JunctionId {
        JunctionId(self.coordinates.len() + 2 * i.0 + 1)
    }

    /// Mass, centre of mass and tensor of a link, read off its two stores.
    pub fn inertial(&self, i: LinkId) -> Inertial {
        let at = |junction| self.stores.iter().filter(move |s| s.junction == junction);
        let zero = Value::Fixed(Dd::ZERO);
        let mut inertial = Inertial {
            mass: zero,
            com: self.frames[i.0].com,
            inertia: Tensor {
                entries: [zero; 6],
                axes: self.frames[i.0].tensor_axes,
            },
        };
        for store in at(self.translation(i)).chain(at(self.rotation(i))) {
            match store.inertia {
                Inertia::Mass(mass) => inertial.mass = mass,
                Inertia::Tensor(entries) => inertial.inertia.entries = entries,
            }
        }
        inertial
    }

    /// The transformers that feed a junction.
    pub fn into(&self, junction: JunctionId) -> impl Iterator<Item = &Transformer> {
        self.transformers.iter().filter(move |t| t.to == junction)
    }
}
