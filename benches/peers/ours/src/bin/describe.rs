//! `describe SPEC FOLDER`: writes a mechanism in the formats of the peers, `NAME.flat` and `NAME.urdf`.
//! Fixed links are part of the bodies they are fixed to; run-time parameters have the values of the spec.
#![forbid(unsafe_code)]

use std::fmt::{self, Display, Write};
use std::path::Path;
use std::process::ExitCode;

use benches::body::{Body, bodies, joint_names, vector};
use benches::joints::joint_kinds;
use benches::states::JointKind;
use bgdyn_codegen::mechanism::Mechanism;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [spec, folder] = &arguments[..] else {
        eprintln!("usage: describe SPEC FOLDER");
        return ExitCode::from(2);
    };
    match describe(Path::new(spec), Path::new(folder)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn describe(spec: &Path, folder: &Path) -> Result<(), String> {
    let mechanism = benches::read(spec)?;
    let (bodies, kinds) = (bodies(&mechanism), joint_kinds(&mechanism)?);
    let texts = [
        ("flat", flat(&mechanism, &bodies, &kinds)),
        ("urdf", urdf(&mechanism, &bodies, &kinds)),
    ];
    for (ending, text) in texts {
        let path = folder.join(format!("{}.{ending}", mechanism.name()));
        let text = text.expect("writing to a text does not fail");
        std::fs::write(&path, text).map_err(|e| format!("{}: {e}", path.display()))?;
    }
    Ok(())
}

/// Numbers in a row, in the shortest form that parses to the same number.
struct Row<I>(I);

impl<'a, I: Iterator<Item = &'a f64> + Clone> Display for Row<I> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, x) in self.0.clone().enumerate() {
            let separator = if i > 0 { " " } else { "" };
            write!(f, "{separator}{x:e}")?;
        }
        Ok(())
    }
}

/// Writes a line for each body: name, index of its parent (−1: the world), joint; rotation (row by row)
/// and origin in the parent, axis, mass, centre of mass, inertia about it (xx xy xz yy yz zz).
fn flat(mechanism: &Mechanism, bodies: &[Body], kinds: &[JointKind]) -> Result<String, fmt::Error> {
    let mut text = String::new();
    writeln!(text, "mechanism {}", mechanism.name())?;
    writeln!(text, "gravity {}", Row(vector(mechanism.gravity()).iter()))?;
    writeln!(text, "bodies {}", bodies.len())?;
    for ((body, kind), name) in bodies.iter().zip(kinds).zip(joint_names(mechanism)) {
        let parent = body.parent.map_or(-1, |p| p as i64);
        let joint = match kind {
            JointKind::Turns => "revolute",
            JointKind::Slides => "prismatic",
            JointKind::Floats => "floating",
        };
        writeln!(
            text,
            "{} {parent} {joint} {} {} {} {:e} {} {}",
            name,
            Row(body.placement.rotation.transpose().iter()),
            Row(body.placement.translation.iter()),
            Row(body.axis.iter()),
            body.mass,
            Row(body.com.iter()),
            Row(tensor(body).iter()),
        )?;
    }
    Ok(text)
}

fn urdf(mechanism: &Mechanism, bodies: &[Body], kinds: &[JointKind]) -> Result<String, fmt::Error> {
    let (mut text, name) = (String::new(), mechanism.name());
    writeln!(text, "<robot name=\"{name}\">\n  <link name=\"world\"/>")?;
    let link = |i: Option<usize>| i.map_or("world".to_owned(), |i| format!("body{i}"));
    let joints = bodies.iter().zip(kinds).zip(joint_names(mechanism));
    for (i, ((body, kind), joint)) in joints.enumerate() {
        let [xx, xy, xz, yy, yz, zz] = tensor(body);
        let kind = match kind {
            JointKind::Turns => "continuous",
            JointKind::Slides => "prismatic",
            JointKind::Floats => "floating",
        };
        let limit = "<limit lower=\"-1e9\" upper=\"1e9\" effort=\"1e9\" velocity=\"1e9\"/>";
        writeln!(
            text,
            "  <link name=\"{name}\"><inertial><origin xyz=\"{com}\"/><mass value=\"{mass:e}\"/>\
             <inertia ixx=\"{xx:e}\" ixy=\"{xy:e}\" ixz=\"{xz:e}\" iyy=\"{yy:e}\" iyz=\"{yz:e}\" izz=\"{zz:e}\"/>\
             </inertial></link>\n  \
             <joint name=\"{joint}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{name}\"/>\
             <origin xyz=\"{xyz}\" rpy=\"{rpy}\"/><axis xyz=\"{axis}\"/>{limit}</joint>",
            name = link(Some(i)),
            com = Row(body.com.iter()),
            mass = body.mass,
            parent = link(body.parent),
            xyz = Row(body.placement.translation.iter()),
            rpy = Row(roll_pitch_yaw(body).iter()),
            axis = Row(body.axis.iter()),
        )?;
    }
    writeln!(text, "</robot>")?;
    Ok(text)
}

fn tensor(body: &Body) -> [f64; 6] {
    let i = &body.inertia;
    [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)].map(|place| i[place])
}

/// Returns rotations about fixed x, y, z, in this order. It uses no arcsine, which would lose half the
/// digits near a quarter turn.
fn roll_pitch_yaw(body: &Body) -> [f64; 3] {
    let r = &body.placement.rotation;
    let level = r[(0, 0)].hypot(r[(1, 0)]);
    let pitch = (-r[(2, 0)]).atan2(level);
    if level > 1e-9 {
        let (roll, yaw) = (r[(2, 1)].atan2(r[(2, 2)]), r[(1, 0)].atan2(r[(0, 0)]));
        return [roll, pitch, yaw];
    }
    // At a pitch of a quarter turn, roll and yaw are about one axis: all of the angle is roll.
    [(-r[(1, 2)]).atan2(r[(1, 1)]), pitch, 0.0]
}
