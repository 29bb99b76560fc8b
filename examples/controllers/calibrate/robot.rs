//! The arm as its controllers know it: functions generated from `specs/panda.yaml`, and numbers.
//!
//! The numbers change when the arm is calibrated, the functions do not: efforts are the generated regressor times the
//! base parameters, so that a controller takes what was found without being compiled again. Run-time parameters in the
//! spec would do the same, but 70 of them would have to be written into a copy of it, and the
//! identification and the adaptive law need the regressor anyway.

use bgdyn::nalgebra::{DMatrix, SVector};
use bgdyn_identification::excite::Points;
use bgdyn_identification::model::{BODY_PARAMETERS, Parameters, Transport, Unknown};
use bgdyn_identification::{Identified, JointPart, LinkPart, Model, Rows};

use crate::panda::{BASE_PARAMETERS, BODY_NAMES, JOINT_LIMITS, JOINT_NAMES, Panda};
use crate::{JOINTS, Joints};

/// Number of the bodies' parameters.
pub const BODIES: usize = BODY_PARAMETERS * JOINTS;
/// Number of base parameters.
pub const NP: usize = BASE_PARAMETERS.len();
/// Base parameters of the bodies.
pub type BaseParameters = SVector<f64, NP>;

/// All numbers of a model.
#[derive(Clone, Debug, PartialEq)]
pub struct Numbers {
    /// Ten of each body: mass, first moments, tensor about the link's origin, link axes; kg, kg·m, kg·m².
    pub bodies: SVector<f64, BODIES>,
    /// Rotor inertias, kg·m².
    pub rotor: Joints,
    /// Viscous friction, N·m·s/rad.
    pub viscous: Joints,
    /// Coulomb friction, N·m.
    pub coulomb: Joints,
    /// Offsets of the efforts, N·m.
    pub offset: Joints,
}

impl Numbers {
    /// Returns the numbers of the spec, which has neither rotors nor friction.
    pub fn of_spec() -> Self {
        Numbers {
            bodies: Panda::<f64>::default().parameters(),
            rotor: Joints::zeros(),
            viscous: Joints::zeros(),
            coulomb: Joints::zeros(),
            offset: Joints::zeros(),
        }
    }

    /// Returns these numbers with those that were found in their places.
    pub fn with(&self, found: &[Identified]) -> Self {
        let mut numbers = self.clone();
        for number in found {
            *numbers.entry(number.unknown) = number.value;
        }
        numbers
    }

    /// Returns a number by its place in the identification.
    pub fn get(&self, unknown: Unknown) -> f64 {
        *self.clone().entry(unknown)
    }

    fn entry(&mut self, unknown: Unknown) -> &mut f64 {
        match unknown {
            Unknown::Link(link, k) => &mut self.bodies[BODY_PARAMETERS * link + k],
            Unknown::Joint(0, joint) => &mut self.rotor[joint],
            Unknown::Joint(1, joint) => &mut self.viscous[joint],
            Unknown::Joint(2, joint) => &mut self.coulomb[joint],
            Unknown::Joint(_, joint) => &mut self.offset[joint],
        }
    }
}

/// The model of a controller: the generated functions with base parameters and numbers of joints.
#[derive(Clone, Debug)]
pub struct ArmModel {
    /// The generated functions.
    pub arm: Panda<f64>,
    /// Base parameters.
    pub base: BaseParameters,
    /// Numbers of joints.
    pub numbers: Numbers,
}

impl ArmModel {
    /// Returns the model with these numbers.
    pub fn new(numbers: &Numbers) -> Self {
        let arm = Panda::default();
        ArmModel {
            base: arm.base_parameters(&numbers.bodies),
            arm,
            numbers: numbers.clone(),
        }
    }

    /// Returns the efforts of bodies and rotors, N·m.
    pub fn inertial_effort(&self, q: &Joints, v: &Joints, a: &Joints) -> Joints {
        self.arm.base_regressor(q, v, a) * self.base + self.numbers.rotor.component_mul(a)
    }

    /// Returns friction and offsets at velocities `v`, N·m; `sign` is that of velocities.
    pub fn friction(&self, v: &Joints, sign: impl Fn(f64) -> f64) -> Joints {
        let dry = self.numbers.coulomb.component_mul(&v.map(sign));
        self.numbers.viscous.component_mul(v) + dry + self.numbers.offset
    }

    /// Returns the inertia that each joint moves alone, kg·m²: the diagonal of M, rotors included.
    pub fn own_inertias(&self, q: &Joints) -> Joints {
        let still = Joints::zeros();
        let held = self.inertial_effort(q, &still, &still);
        Joints::from_fn(|j, _| {
            let unit = Joints::from_fn(|i, _| f64::from(u8::from(i == j)));
            self.inertial_effort(q, &still, &unit)[j] - held[j]
        })
    }
}

/// Rows of the generated regressor, and the place of the tool, for the identification.
pub struct Generated;

impl Rows for Generated {
    fn joints(&self) -> usize {
        JOINTS
    }

    fn bodies(&self) -> usize {
        BODY_NAMES.len()
    }

    fn effort_rows(&self, q: &[f64], v: &[f64], a: &[f64], rows: &mut DMatrix<f64>) {
        let [q, v, a] = [q, v, a].map(Joints::from_column_slice);
        rows.copy_from(&Panda::default().regressor(&q, &v, &a));
    }
}

impl Points for Generated {
    fn point(&self, _: usize, q: &[f64]) -> [f64; 3] {
        place_of_tool(&Joints::from_column_slice(q)).into()
    }
}

/// Returns the place of the tool in world axes, m.
pub fn place_of_tool(q: &Joints) -> SVector<f64, 3> {
    Panda::default().pose_tool(q).translation
}

/// Returns what is identified, from the numbers of the spec: all bodies, rotors, friction and offsets.
pub fn identified_model() -> Model<'static> {
    let file = Panda::<f64>::default().parameters();
    let link = |(body, name): (usize, &&str)| LinkPart {
        name: (*name).to_owned(),
        body,
        in_body: Transport::identity(),
        file: Parameters::from_fn(|k, _| file[BODY_PARAMETERS * body + k]),
        free: true,
    };
    let joint = |j: usize| JointPart {
        name: JOINT_NAMES[j].to_owned(),
        linear: false,
        range: [Some(JOINT_LIMITS[j].lower), Some(JOINT_LIMITS[j].upper)],
        speed: Some(JOINT_LIMITS[j].velocity),
        effort: Some(JOINT_LIMITS[j].effort),
        file: [0.0; 4],
    };
    Model {
        rows: &Generated,
        links: BODY_NAMES.iter().enumerate().map(link).collect(),
        joints: (0..JOINTS).map(joint).collect(),
        columns: [true; 4],
    }
}
