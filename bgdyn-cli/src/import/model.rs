//! A robot as the importer holds it: the part of a file that a mechanism can represent, whatever the
//! format of the file.

use super::joint_type::JointType;
use super::number::Num;
use super::placement::Placement;
use super::xml::At;

/// The part of a robot that a mechanism can represent.
pub(super) struct Model {
    pub(super) name: String,
    /// Its source: the first words of the mechanism's comment.
    pub(super) source: String,
    /// Acceleration of free fall in world axes, m/s²; `None` for the default of a mechanism.
    pub(super) gravity: Option<[Num; 3]>,
    /// Whether the motion of the base is given at run time.
    pub(super) moving_base: bool,
    /// Whether the links without a joint move freely by the file, and are not fixed to the world.
    pub(super) free_roots: bool,
    pub(super) links: Vec<Link>,
    /// In the order of the file.
    pub(super) joints: Vec<Joint>,
    /// Sites on links that are no bodies.
    pub(super) frames: Vec<Frame>,
    /// Places at which links are connected beside the joints.
    pub(super) loops: Vec<Loop>,
    /// Links that are fixed to the world and have a part whose inertia is not known: they must not move.
    pub(super) incomplete: Vec<String>,
    pub(super) warnings: Vec<String>,
}

pub(super) struct Link {
    pub(super) name: String,
    pub(super) at: At,
    pub(super) inertial: Option<Inertial>,
    /// Pose in the world of a link without a joint; by default its origin.
    pub(super) place: Option<Placement>,
}

/// A named site on a link.
pub(super) struct Frame {
    pub(super) name: String,
    /// The name of its link; `None` for the world.
    pub(super) link: Option<String>,
    pub(super) place: Placement,
}

/// A closed loop: two places that meet.
pub(super) struct Loop {
    pub(super) name: String,
    /// Its type in a mechanism.
    pub(super) kind: &'static str,
    /// The axis of a hinge or a slider, in the axes of both places.
    pub(super) axis: Option<[Num; 3]>,
    pub(super) a: LoopPlace,
    pub(super) b: LoopPlace,
}

/// A place on a link.
pub(super) struct LoopPlace {
    /// The name of its link; `None` for the world.
    pub(super) link: Option<String>,
    pub(super) place: Placement,
}

impl Link {
    /// Returns whether it has a mass or a tensor.
    pub(super) fn is_body(&self) -> bool {
        let inertial = self.inertial.as_ref();
        inertial.is_some_and(|it| !it.mass.is_zero() || !it.tensor.iter().all(Num::is_zero))
    }
}

#[derive(Clone, Debug)]
pub(super) struct Inertial {
    pub(super) mass: Num,
    pub(super) com: [Num; 3],
    pub(super) rpy: [Num; 3],
    /// xx, yy, zz, xy, xz, yz.
    pub(super) tensor: [Num; 6],
}

impl Inertial {
    /// Returns the inertia, given in the axes of `shift`, in those in which `shift` is given.
    pub(super) fn shifted(self, shift: &Placement) -> Self {
        let own = Placement {
            xyz: self.com,
            rpy: self.rpy,
        };
        let Placement { xyz: com, rpy } = shift.then(&own);
        Inertial { com, rpy, ..self }
    }
}

pub(super) struct Joint {
    pub(super) name: String,
    pub(super) at: At,
    pub(super) kind: JointType,
    /// The name of the link that carries it; `None` for the world.
    pub(super) parent: Option<String>,
    pub(super) child: String,
    pub(super) origin: Placement,
    pub(super) axis: [Num; 3],
    /// The displacement of a helical joint for each turn, m.
    pub(super) lead: Option<Num>,
    pub(super) limits: Limits,
    pub(super) mimic: Option<Mimic>,
    pub(super) effects: JointEffects,
}

impl Joint {
    /// Returns a fixed joint without limits and effects.
    pub(super) fn fixed(name: &str, at: At, parent: Option<&str>, child: &str) -> Self {
        Joint {
            name: name.to_owned(),
            at,
            kind: JointType::Fixed,
            parent: parent.map(str::to_owned),
            child: child.to_owned(),
            origin: Placement::identity(),
            axis: [Num::zero(), Num::zero(), Num::computed(1.0)],
            lead: None,
            limits: Limits::default(),
            mimic: None,
            effects: JointEffects::default(),
        }
    }

    /// Fixes it at its origin.
    pub(super) fn fix(&mut self) {
        self.kind = JointType::Fixed;
        self.lead = None;
        self.limits = Limits::default();
        self.mimic = None;
        self.effects = JointEffects::default();
    }
}

/// The relation of a follower to its leader: position = ratio · leader + offset.
#[derive(Clone)]
pub(super) struct Mimic {
    /// The name of the leader.
    pub(super) joint: String,
    /// Units of the follower per unit of the leader, rad or m.
    pub(super) ratio: Num,
    /// rad or m.
    pub(super) offset: Num,
}

/// What acts at a joint; `None` where it is 0.
#[derive(Clone, Default)]
pub(super) struct JointEffects {
    /// Viscous damping, N·m·s/rad or N·s/m.
    pub(super) damping: Option<Num>,
    /// Coulomb friction, N·m or N.
    pub(super) friction: Option<Num>,
    /// Stiffness of a spring, N·m/rad or N/m.
    pub(super) stiffness: Option<Num>,
    /// The position at which the spring has no effort, rad or m.
    pub(super) rest: Option<Num>,
    /// Inertia of a rotor as the joint feels it, kg·m² or kg.
    pub(super) rotor: Option<Num>,
}

#[derive(Clone, Default)]
pub(super) struct Limits {
    pub(super) lower: Option<Num>,
    pub(super) upper: Option<Num>,
    pub(super) velocity: Option<Num>,
    pub(super) effort: Option<Num>,
}
