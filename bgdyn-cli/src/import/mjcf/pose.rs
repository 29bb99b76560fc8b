//! Poses of an MJCF: position, and orientation in five notations.

use super::known::ORIENTATION;
use super::settings::Settings;
use crate::import::attributes::numbers;
use crate::import::number::Num;
use crate::import::placement::{
    Placement, Pose, about, displaced, turned, turned_by_quaternion, unit,
};
use crate::import::xml::{Element, fault};
use anyhow::Result;
use bgdyn_codegen::math::{Mat3, Vec3, rodrigues};
use bgdyn_runtime::Dd;

/// Returns an element's `pos`, zero without it.
pub(super) fn position(element: &Element) -> Result<[Num; 3]> {
    match element.get("pos") {
        Some(_) => numbers(element, "pos"),
        None => Ok(Num::zeros()),
    }
}

/// Returns an element's pose in the axes that it is given in.
pub(super) fn placement(element: &Element, settings: &Settings) -> Result<Placement> {
    Ok(Placement {
        xyz: position(element)?,
        rpy: orientation(element, settings)?.placement().rpy,
    })
}

/// Returns a vector in double-double.
pub(super) fn exact(v: &[Num; 3]) -> Vec3<Dd> {
    Vec3(v.each_ref().map(Num::exact))
}

/// Returns an element's rotation.
pub(super) fn orientation(element: &Element, settings: &Settings) -> Result<Pose> {
    let mut given = ORIENTATION.iter().filter(|it| element.get(it).is_some());
    let Some(first) = given.next() else {
        return Ok(displaced([Dd::ZERO; 3]));
    };
    if let Some(second) = given.next() {
        let message = format!("`{first}` and `{second}` both give an orientation: leave one");
        return Err(fault(element.at, message));
    }
    let zero = |what: &str| fault(element.at, format_args!("{what} of `{first}` is zero"));
    match *first {
        "quat" => {
            let q = numbers::<4>(element, "quat")?;
            if q.iter().all(Num::is_zero) {
                return Err(zero("the quaternion"));
            }
            let [w, x, y, z] = q.each_ref().map(Num::exact);
            Ok(turned_by_quaternion([x, y, z, w]))
        }
        "axisangle" => {
            let [x, y, z, angle] = numbers::<4>(element, "axisangle")?;
            let axis = exact(&[x, y, z]);
            if is_zero(axis) {
                return Err(zero("the axis"));
            }
            Ok(turned(axis, settings.angle(&angle).exact()))
        }
        "xyaxes" => {
            let [x0, x1, x2, y0, y1, y2] = numbers::<6>(element, "xyaxes")?;
            let (x, y) = (exact(&[x0, x1, x2]), exact(&[y0, y1, y2]));
            if is_zero(x) || is_zero(x.cross(y)) {
                return Err(fault(
                    element.at,
                    "the axes of `xyaxes` are parallel or zero",
                ));
            }
            let x = unit(x);
            let y = unit(y - x.scale(x.dot(y)));
            Ok(rotation([x, y, x.cross(y)]))
        }
        "zaxis" => {
            let z = exact(&numbers(element, "zaxis")?);
            if is_zero(z) {
                return Err(zero("the axis"));
            }
            Ok(from_z_to(z))
        }
        _ => {
            let angles = numbers::<3>(element, "euler")?;
            let turns = settings.euler.iter().zip(&angles);
            let start = displaced([Dd::ZERO; 3]);
            Ok(turns.fold(start, |made, (turn, angle)| {
                let next = about(turn.axis, settings.angle(angle).exact());
                match turn.moving {
                    true => made.then(&next),
                    false => next.then(&made),
                }
            }))
        }
    }
}

fn is_zero(v: Vec3<Dd>) -> bool {
    v.0.iter().all(|x| x.to_f64() == 0.0)
}

fn rotation(columns: [Vec3<Dd>; 3]) -> Pose {
    Pose {
        rotation: Mat3::from_fn(|i, j| columns[j].0[i]),
        ..displaced([Dd::ZERO; 3])
    }
}

/// Returns the smallest rotation that takes z to a direction; a half turn about x for −z.
fn from_z_to(direction: Vec3<Dd>) -> Pose {
    let z = unit(direction);
    let across = Vec3([-z.0[1], z.0[0], Dd::ZERO]);
    let sin = across.dot(across).sqrt();
    let (axis, sin) = match sin.to_f64() < 1e-15 {
        true => (Vec3([Dd::ONE, Dd::ZERO, Dd::ZERO]), Dd::ZERO),
        false => (unit(across), sin),
    };
    Pose {
        rotation: rodrigues(axis, (z.0[2], sin), |x| x),
        ..displaced([Dd::ZERO; 3])
    }
}

/// Returns the pose between the two points of `fromto`, z along the line from the second to the first (as
/// MuJoCo 4.0 has it), and half their distance; `None` without the attribute.
pub(super) fn between(element: &Element) -> Result<Option<(Pose, Dd)>> {
    if element.get("fromto").is_none() {
        return Ok(None);
    }
    let [a, b, c, d, e, f] = numbers::<6>(element, "fromto")?;
    let (from, to) = (exact(&[a, b, c]), exact(&[d, e, f]));
    let (along, half) = (from - to, Dd::from_f64(0.5));
    if is_zero(along) {
        return Err(fault(element.at, "the two points of `fromto` are one"));
    }
    let pose = Pose {
        translation: (from + to).scale(half),
        ..from_z_to(along)
    };
    Ok(Some((pose, along.dot(along).sqrt() * half)))
}
