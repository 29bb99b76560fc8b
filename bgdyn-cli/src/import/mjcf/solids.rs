//! Mass and inertia of geoms: homogeneous solids of five shapes.

use super::pose::{between, exact, orientation, position};
use super::settings::Settings;
use crate::import::attributes::{finite, numbers};
use crate::import::model::Inertial;
use crate::import::naming::shown;
use crate::import::number::Num;
use crate::import::placement::{Placement, Pose};
use crate::import::tally::plural;
use crate::import::xml::{Element, fault};
use anyhow::Result;
use bgdyn_codegen::math::{Mat3, Vec3};
use bgdyn_runtime::Dd;

/// kg/m³, of a geom that gives neither mass nor density.
const DENSITY: f64 = 1000.0;

/// Geoms lighter than this count for nothing, kg.
const LEAST_MASS: f64 = 1e-15;

/// Entries below this, relative to the largest one, are rounding errors of zero.
const ROUNDING: f64 = 1e-25;

/// A body of one geom: its tensor is about its own centre, in the axes of the pose.
pub(super) struct Solid {
    pub(super) mass: Dd,
    pub(super) pose: Pose,
    pub(super) moments: [Dd; 3],
}

/// What a geom adds to the inertia of its body.
pub(super) enum Part {
    Nothing,
    Solid(Box<Solid>),
    /// A shape whose inertia is not computed here, with a name for it.
    Unknown(String),
}

/// The shape of a geom with its dimensions.
enum Shape {
    Sphere(Dd),
    /// Radius, half the length without the caps.
    Capsule(Dd, Dd),
    Cylinder(Dd, Dd),
    Ellipsoid([Dd; 3]),
    Box([Dd; 3]),
}

/// Returns what a geom, given with the attributes of its class, adds to the inertia of its body.
pub(super) fn part(geom: &Element, settings: &Settings) -> Result<Part> {
    let group = match geom.get("group") {
        Some(_) => finite(geom, "group")?.value,
        None => 0.0,
    };
    let [least, most] = settings.groups;
    let kind = geom.get("type").unwrap_or("sphere");
    if !(least..=most).contains(&group) || matches!(kind, "plane" | "hfield") {
        return Ok(Part::Nothing);
    }
    let number = |attribute: &str| match geom.get(attribute) {
        Some(_) => finite(geom, attribute).map(Some),
        None => Ok(None),
    };
    let (mass, density) = (number("mass")?, number("density")?);
    let weightless = match (&mass, &density) {
        (Some(mass), _) => mass.value < LEAST_MASS,
        (None, Some(density)) => density.value <= 0.0,
        (None, None) => false,
    };
    if weightless {
        return Ok(Part::Nothing);
    }
    if let Some(mesh) = geom.get("mesh") {
        return Ok(Part::Unknown(format!("mesh `{}`", shown(mesh))));
    }
    if geom.get("shellinertia").is_some_and(|word| word == "true") {
        return Ok(Part::Unknown("`shellinertia`".into()));
    }
    if matches!(kind, "mesh" | "sdf") {
        return Ok(Part::Unknown(format!("type {kind}")));
    }
    let (shape, pose) = shape(geom, kind, settings)?;
    let mass = match (mass, density) {
        (Some(mass), _) => mass.exact(),
        (None, Some(density)) => density.exact() * shape.volume(),
        (None, None) => Dd::from_f64(DENSITY) * shape.volume(),
    };
    Ok(match mass.to_f64() < LEAST_MASS {
        true => Part::Nothing,
        false => Part::Solid(Box::new(Solid {
            mass,
            pose,
            moments: shape.moments(mass),
        })),
    })
}

/// Returns shape and pose of a geom; with `fromto` the two ends of its z axis give pose and length.
fn shape(geom: &Element, kind: &str, settings: &Settings) -> Result<(Shape, Pose)> {
    let long = matches!(kind, "capsule" | "cylinder" | "box" | "ellipsoid");
    let ends = match long {
        true => between(geom)?,
        false => None,
    };
    let (half, pose) = match ends {
        Some((pose, half)) => (Some(half), pose),
        None => {
            let pose = Pose {
                translation: exact(&position(geom)?),
                ..orientation(geom, settings)?
            };
            (None, pose)
        }
    };
    let sizes = sizes(geom)?;
    let size = |index: usize| -> Result<Dd> {
        let given = sizes.get(index).map(Num::exact);
        let fits = given.filter(|size| size.to_f64() > 0.0);
        fits.ok_or_else(|| {
            let count = plural(index + 1, "number");
            let what = format!("`size` of this `<geom>` of type {kind} needs {count} above 0");
            fault(geom.at, what)
        })
    };
    let round = |index: usize| half.map_or_else(|| size(index), Ok);
    let edges = || -> Result<[Dd; 3]> {
        let x = size(0)?;
        match half {
            Some(half) => Ok([x, x, half]),
            None => Ok([x, size(1)?, size(2)?]),
        }
    };
    let shape = match kind {
        "sphere" => Shape::Sphere(size(0)?),
        "capsule" => Shape::Capsule(size(0)?, round(1)?),
        "cylinder" => Shape::Cylinder(size(0)?, round(1)?),
        "ellipsoid" => Shape::Ellipsoid(edges()?),
        "box" => Shape::Box(edges()?),
        other => {
            let message = format!("a `<geom>` has no type `{}`", shown(other));
            return Err(fault(geom.at, message));
        }
    };
    Ok((shape, pose))
}

/// Returns up to three sizes.
fn sizes(geom: &Element) -> Result<Vec<Num>> {
    let count = geom
        .get("size")
        .map_or(0, |text| text.split_whitespace().count());
    Ok(match count {
        0 => Vec::new(),
        1 => numbers::<1>(geom, "size")?.into(),
        2 => numbers::<2>(geom, "size")?.into(),
        _ => numbers::<3>(geom, "size")?.into(),
    })
}

impl Shape {
    /// Volume, m³.
    fn volume(&self) -> Dd {
        let n = Dd::from_f64;
        match *self {
            Shape::Sphere(r) => n(4.0) / n(3.0) * Dd::PI * r * r * r,
            Shape::Capsule(r, h) => Dd::PI * r * r * (n(2.0) * h + n(4.0) / n(3.0) * r),
            Shape::Cylinder(r, h) => n(2.0) * Dd::PI * r * r * h,
            Shape::Ellipsoid([a, b, c]) => n(4.0) / n(3.0) * Dd::PI * a * b * c,
            Shape::Box([a, b, c]) => n(8.0) * a * b * c,
        }
    }

    /// Principal moments about the centre for a mass, kg·m².
    fn moments(&self, mass: Dd) -> [Dd; 3] {
        let n = Dd::from_f64;
        let sums = |[a, b, c]: [Dd; 3], by: Dd| {
            let [a, b, c] = [a * a, b * b, c * c].map(|square| mass * square * by);
            [b + c, a + c, a + b]
        };
        match *self {
            Shape::Sphere(r) => [n(2.0) / n(5.0) * mass * r * r; 3],
            Shape::Ellipsoid(axes) => sums(axes, n(1.0) / n(5.0)),
            Shape::Box(edges) => sums(edges, n(1.0) / n(3.0)),
            Shape::Cylinder(r, h) => {
                let across = mass * (r * r / n(4.0) + h * h / n(3.0));
                [across, across, mass * r * r / n(2.0)]
            }
            Shape::Capsule(r, h) => {
                // The two caps are a ball cut in half; their centres are 3/8 r outside of the cylinder.
                let caps = mass * n(2.0) * r / (n(2.0) * r + n(3.0) * h);
                let rod = mass - caps;
                let ball = n(2.0) / n(5.0) * caps * r * r;
                let across = rod * (r * r / n(4.0) + h * h / n(3.0))
                    + ball
                    + caps * h * (h + n(3.0) / n(4.0) * r);
                [across, across, rod * r * r / n(2.0) + ball]
            }
        }
    }
}

/// Returns mass, centre of mass and tensor about it of several solids; `None` without a solid.
pub(super) fn sum(solids: &[Solid]) -> Option<Inertial> {
    if solids.is_empty() {
        return None;
    }
    let zero = Vec3([Dd::ZERO; 3]);
    let mass = solids.iter().fold(Dd::ZERO, |sum, solid| sum + solid.mass);
    let first = solids.iter().fold(zero, |sum, solid| {
        sum + solid.pose.translation.scale(solid.mass)
    });
    let com = first.map(|x| x / mass);
    let start = Mat3([[Dd::ZERO; 3]; 3]);
    let tensor = solids.iter().fold(start, |sum, solid| {
        let d = solid.pose.translation - com;
        let square = d.dot(d);
        let turn = solid.pose.rotation;
        let own = Mat3::from_fn(|i, j| {
            let diagonal = if i == j { square } else { Dd::ZERO };
            let turned = (0..3).fold(Dd::ZERO, |sum, k| {
                sum + turn.0[i][k] * solid.moments[k] * turn.0[j][k]
            });
            turned + (diagonal - d.0[i] * d.0[j]) * solid.mass
        });
        sum + own
    });
    let largest = tensor.0.iter().flatten();
    let largest = largest.fold(0.0, |size: f64, x| size.max(x.to_f64().abs()));
    let entry = |i: usize, j: usize| written(tensor.0[i][j], largest);
    Some(Inertial {
        mass: Num::computed(mass.to_f64()),
        com: com.0.map(|x| written(x, 1.0)),
        rpy: Placement::identity().rpy,
        tensor: [
            entry(0, 0),
            entry(1, 1),
            entry(2, 2),
            entry(0, 1),
            entry(0, 2),
            entry(1, 2),
        ],
    })
}

/// Returns a computed number; rounding errors of zero become zero.
fn written(x: Dd, scale: f64) -> Num {
    match x.to_f64().abs() <= ROUNDING * scale {
        true => Num::zero(),
        false => Num::computed(x.to_f64()),
    }
}
