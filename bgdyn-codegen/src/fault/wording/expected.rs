//! What belongs at each place of a file: a description with an example of its syntax, and the keys that are missing.

use super::Wanted;

// Values

pub(crate) const SPEC: Wanted<'static> = ("a mapping", "`format: 1`, `links: …`");
pub(crate) const SCENE: Wanted<'static> = ("a mapping", "`scene: 1`, `mechanism: …`");
pub(crate) const LINKS: Wanted<'static> =
    ("a list of links", "each link after a dash: `- name: …`");
pub(crate) const FRAMES: Wanted<'static> = (
    "a list of frames",
    "each frame after a dash: `- { name: …, link: … }`",
);
pub(crate) const CONSTRAINTS: Wanted<'static> =
    ("constraints by name", "`name: { type: gear, … }`");
pub(crate) const PLANES: Wanted<'static> =
    ("planes by name", "`ground: { normal: z, offset: 0 m }`");
pub(crate) const CONTACTS: Wanted<'static> = (
    "contacts by name",
    "`foot: { link: shank, at: [0, 0, -0.2], radius: 18 mm, on: ground }`",
);
pub(crate) const LOOPS: Wanted<'static> = (
    "a list of loops",
    "each loop after a dash: `- { name: …, type: hinge, … }`",
);
pub(crate) const LISTED_JOINTS: Wanted<'static> = ("a list of joints", "`[crank, wrist]`");
pub(crate) const EFFECTS: Wanted<'static> = ("effects by name", "`name: { type: viscous, … }`");
pub(crate) const LINK: Wanted<'static> = ("a link", "`- name: …` and its other keys below");
pub(crate) const JOINT: Wanted<'static> = ("a joint", "`{ name: …, type: revolute, axis: z }`");
pub(crate) const MIMIC: Wanted<'static> = ("a mapping", "`{ joint: …, ratio: 1, offset: 0 }`");
pub(crate) const ORIGIN: Wanted<'static> = (
    "a placement",
    "`{ xyz: [x, y, z], rpy: [roll, pitch, yaw] }`",
);
pub(crate) const LIMITS: Wanted<'static> = (
    "a mapping",
    "`{ lower: …, upper: …, velocity: …, effort: … }`",
);
pub(crate) const INERTIA: Wanted<'static> = (
    "a tensor or a solid",
    "`{ xx: …, yy: …, zz: … }` or `{ solid: box, size: [x, y, z] }`",
);
pub(crate) const PRODUCTS: Wanted<'static> = ("products of inertia", "`{ xy: …, xz: …, yz: … }`");
pub(crate) const FRAME: Wanted<'static> = (
    "a frame",
    "`- { name: …, link: …, origin: { xyz: [x, y, z] } }`",
);
pub(crate) const LOCKS: Wanted<'static> = ("joints with their coordinates", "`wrist: 30 deg`");
pub(crate) const INPUTS: Wanted<'static> = ("inputs by name", "`shoulder: { constant: 2 }`");
pub(crate) const INITIAL: Wanted<'static> = ("initial values by name", "`shoulder: 10 deg`");
pub(crate) const OUTPUTS: Wanted<'static> = ("a list of names", "`[shoulder, tool]`");
pub(crate) const NEAR: Wanted<'static> = ("positions by joint", "`{ elbow: 30 deg }`");
pub(crate) const LOOP_END: Wanted<'static> = (
    "a place",
    "`{ link: …, origin: { xyz: [x, y, z] } }` or `{ frame: … }`",
);
pub(crate) const WORDS: Wanted<'static> = ("a list of words", "`[fx, fz]`");
pub(crate) const COEFFICIENTS: Wanted<'static> =
    ("coefficients by joint", "`{ left: 1, right: -1 }`");
pub(crate) const SITES: Wanted<'static> = ("two names", "`[one, other]`");
pub(crate) const PARAMETER: Wanted<'static> =
    ("a parameter", "`{ parameter: payload, value: 1.5 }`");
pub(crate) const NUMBER: Wanted<'static> = ("a number", "`1.5`, or with a unit: `5 mm`");
pub(crate) const TRIPLE: Wanted<'static> = ("a list of three numbers", "`[x, y, z]`");
pub(crate) const CALLS: Wanted<'static> =
    ("a list of effects", "each effect after a dash: `- gravity`");
pub(crate) const LOOP: Wanted<'static> = (
    "a loop",
    "`- { name: …, type: hinge, a: { link: … }, b: { link: … } }`",
);

// Parts of a scene and planes

pub(crate) const TEXT: Wanted<'static> = ("text", "it between quotes: `\"…\"`");
pub(crate) const INPUT: Wanted<'static> = ("what drives the input", "`{ constant: 2 }`");
pub(crate) const COURSE: Wanted<'static> = ("a course in time", "`{ constant: 2 }`");
pub(crate) const RAMP: Wanted<'static> = ("a ramp", "`{ from: 0, rate: 0.1 }`");
pub(crate) const LIMIT_OF_INPUT: Wanted<'static> = ("a limit", "`20`, or `[-5, 20]`");
pub(crate) const CONTROL: Wanted<'static> = (
    "how controllers are sampled",
    "`{ period: 1 ms, delay: 0.5 ms }`",
);
pub(crate) const CONTROLLER_MODEL: Wanted<'static> = (
    "the model of the controllers",
    "`{ mechanism: nominal.yaml }`",
);
pub(crate) const PARAMETERS: Wanted<'static> = ("values of parameters", "`{ payload_mass: 2 kg }`");
pub(crate) const SENSORS: Wanted<'static> = (
    "what sensors measure",
    "`{ position: 0.1 deg, velocity: 0.01 }`",
);
pub(crate) const SENSORS_BY_NAME: Wanted<'static> = (
    "a size for each joint",
    "`{ shoulder: 0.1 deg, slide: 1 mm }`",
);
pub(crate) const STEP: Wanted<'static> = ("a step", "`{ before: 0, after: 1, time: 0.5 s }`");
pub(crate) const TRAPEZOIDAL: Wanted<'static> = (
    "a motion with a trapezoidal velocity",
    "`{ from: 0, to: 1, duration: 2 s, acceleration: 2 }`",
);
pub(crate) const QUINTIC: Wanted<'static> = (
    "a motion of fifth order",
    "`{ from: 0, to: 1, duration: 2 s }`",
);
pub(crate) const TERMS: Wanted<'static> = (
    "a list of courses",
    "`[0.3, { harmonic: { amplitude: 2, frequency: 1 Hz } }]`",
);
pub(crate) const POINTS: Wanted<'static> = ("a list of points", "`[[0 s, 0], [1 s, 2]]`");
pub(crate) const POINT: Wanted<'static> = ("a point", "`[0.5 s, 2]`");
pub(crate) const CONTROLLER: Wanted<'static> = (
    "a controller",
    "`{ target: 0.5, stiffness: 100, damping: 20 }`",
);
pub(crate) const HARMONIC: Wanted<'static> =
    ("a harmonic course", "`{ amplitude: 2, frequency: 1 Hz }`");
pub(crate) const ORIENTATION: Wanted<'static> = ("an orientation", "`{ rpy: [0, 0, 90 deg] }`");
pub(crate) const INTEGRATION: Wanted<'static> = (
    "how the scene is run",
    "`{ method: rk4, step: 1 ms, end: 5 s }`",
);
pub(crate) const CONTACT: Wanted<'static> = (
    "a contact's keys",
    "`{ link: shank, radius: 18 mm, on: ground }`",
);
pub(crate) const PLANE: Wanted<'static> = ("a plane's keys", "`{ normal: z, offset: 0 m }`");

// Keys that a mapping needs

pub(crate) const FORMAT_KEY: &str = "`format: 1`, the version of the format";
pub(crate) const LINKS_KEY: &str = "`links: …`, the list of links";
pub(crate) const LINK_NAME_KEY: &str = "`name: …`, the link's name";
pub(crate) const JOINT_TYPE_KEY: &str =
    "`type: …`: `revolute`, `prismatic`, `floating`, `fixed` or another joint type";
pub(crate) const MIMIC_JOINT_KEY: &str = "`joint: …`, the joint it mimics";
pub(crate) const FRAME_NAME_KEY: &str = "`name: …`, the frame's name";
pub(crate) const FRAME_LINK_KEY: &str = "`link: …`, the link it is fixed to, or `world`";
pub(crate) const SCENE_KEY: &str = "`scene: 1`, the version of the format";
pub(crate) const MECHANISM_KEY: &str =
    "`mechanism: …`, the path of the mechanism's file, from this one";
pub(crate) const PARAMETER_KEY: &str = "`parameter: …`, the parameter's name";
pub(crate) const VALUE_KEY: &str = "`value: …`, the value that `Default` takes";
pub(crate) const LOOP_NAME_KEY: &str = "`name: …`, the loop's name";
pub(crate) const LOOP_TYPE_KEY: &str =
    "`type: …`: `hinge`, `point`, `slider` or another type of loop";
pub(crate) const LOOP_A_KEY: &str = "`a: { link: … }`, one place";
pub(crate) const LOOP_B_KEY: &str = "`b: { link: … }`, the place it is connected to";

// Examples of parts of poses

pub(crate) const POSE: &str = "`{ xyz: [0, 0, 1], rpy: [0, 0, 90 deg] }`";
pub(crate) const ROTATION: &str = "`{ rpy: [0, 0, 90 deg] }`";
pub(crate) const THREE_NUMBERS: &str = "`[0, 0, 1]`";
pub(crate) const QUATERNION: &str = "x, y, z, w: `[0, 0, 0, 1]`";
pub(crate) const HOLD_OF_ANGLE: &str = "`{ angle: { target: 90 deg, stiffness: 8, damping: 2 } }`";
pub(crate) const HOLD_OF_ATTITUDE: &str =
    "`{ attitude: { target: { rpy: [0, 0, 0] }, stiffness: 8, damping: 2 } }`";
pub(crate) const HOLD: &str = "`{ target: …, stiffness: 8, damping: 2 }`";
pub(crate) const TWO_LIMITS: &str = "`[-5, 20]`";
pub(crate) const TRAPEZOIDAL_NUMBERS: &str =
    "`trapezoidal` is given by two of `duration`, `velocity`, `acceleration`";
pub(crate) const QUINTIC_NUMBERS: &str =
    "`quintic` is given by `duration`, or by limits: `velocity`, `acceleration`";
pub(crate) const TWO_NUMBERS: &str = "`[0, 1]`";
