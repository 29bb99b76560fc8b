//! The attributes that are read, by element.

/// The attributes of a pose.
const POSE: &[&str] = &["pos", "quat", "axisangle", "xyaxes", "zaxis", "euler"];

/// The attributes that give an orientation.
pub(super) const ORIENTATION: [&str; 5] = ["quat", "axisangle", "xyaxes", "zaxis", "euler"];

const GEOM: &[&str] = &[
    "name",
    "class",
    "type",
    "size",
    "fromto",
    "mass",
    "density",
    "group",
    "shellinertia",
    "mesh",
];

const JOINT: &[&str] = &[
    "name",
    "class",
    "type",
    "pos",
    "axis",
    "ref",
    "limited",
    "range",
    "stiffness",
    "springref",
    "damping",
    "frictionloss",
    "armature",
];

const INERTIAL: &[&str] = &["mass", "diaginertia", "fullinertia"];

/// Returns the attributes of an element that are read.
pub(super) fn known(element: &str) -> Vec<&'static str> {
    match element {
        "joint" => JOINT.to_vec(),
        "freejoint" => vec!["name", "align"],
        "equality" => vec!["active"],
        "geom" => [POSE, GEOM].concat(),
        "site" => [POSE, &["name", "class", "fromto"]].concat(),
        "body" => [POSE, &["name", "childclass", "mocap", "gravcomp"]].concat(),
        "frame" => [POSE, &["name", "childclass"]].concat(),
        "inertial" => [POSE, INERTIAL].concat(),
        _ => Vec::new(),
    }
}
