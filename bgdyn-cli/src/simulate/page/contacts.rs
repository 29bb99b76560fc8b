//! The contacts of a scene: their shapes on the bodies, their planes, and their forces at the rows of a page.

use std::f64::consts::TAU;

use bgdyn_codegen::mechanism::{ContactPair, ContactPartner, ContactSphere};
use bgdyn_codegen::system::SceneEquations;
use serde::Serialize;

use super::bodies::Bodies;
use super::body::Placed;
use super::contact_forces::forces;
use crate::simulate::run_table::Row;

/// Corners of the polygons that are drawn as the circles of a sphere.
const CIRCLE: usize = 20;
/// The unit of forces is the largest one, divided by this number.
const FORCES: f64 = 1000.0;

/// The contacts of a scene.
#[derive(Serialize)]
pub(super) struct Contacts {
    /// Their planes.
    planes: Vec<DrawnPlane>,
    /// The unit of forces, N.
    unit: f64,
    /// Forces of each contact.
    forces: Vec<DrawnForce>,
}

/// A plane, in the axes of its body.
#[derive(Serialize)]
struct DrawnPlane {
    body: usize,
    at: [f64; 3],
    axes: [[f64; 3]; 3],
}

/// The force on the sphere of a contact at all rows, world axes.
#[derive(Serialize)]
struct DrawnForce {
    name: String,
    /// The contact point, in the page's unit of positions, three integers each.
    at: Vec<i64>,
    /// In the unit of forces.
    force: Vec<i64>,
}

/// Draws the spheres and boxes that touch in the scene on their bodies; returns planes and forces. `None` without
/// contacts.
pub(super) fn contacts(
    system: &SceneEquations,
    bodies: &mut Bodies,
    grain: f64,
    rows: &[&Row],
) -> Option<Contacts> {
    let forces = forces(system, rows)?;
    let mechanism = &system.scene.mechanism;
    let of = |name: &String| {
        let mut elements = system.scene.elements.iter();
        let element = elements.find(|element| element.name == *name);
        mechanism.contact_pair(element?.contact()?)
    };
    let pairs: Vec<&ContactPair> = forces.names.iter().filter_map(of).collect();
    let mut planes: Vec<DrawnPlane> = Vec::new();
    let mut spheres: Vec<ContactSphere> = Vec::new();
    for pair in &pairs {
        spheres.push(pair.sphere);
        match &pair.partner {
            ContactPartner::Sphere(other) => spheres.push(*other),
            ContactPartner::Plane { link, pose } => {
                let (body, place) = bodies.carrier(*link);
                let placed = place.then(&Placed::of(pose));
                let known = |plane: &DrawnPlane| {
                    let place = (plane.body, plane.at, plane.axes);
                    place == (body, placed.o, placed.axes())
                };
                if !planes.iter().any(known) {
                    planes.push(DrawnPlane {
                        body,
                        at: placed.o,
                        axes: placed.axes(),
                    });
                }
            }
        }
    }
    for (k, one) in spheres.iter().enumerate() {
        if !spheres[..k].contains(one) {
            sphere(bodies, one);
        }
    }
    boxes(bodies, &pairs);
    let sizes = forces.rows.iter().flatten().map(|(_, force)| {
        let force = force.iter().map(|x| x * x).sum::<f64>().sqrt();
        if force.is_finite() { force } else { 0.0 }
    });
    let unit = sizes.fold(1e-300, f64::max) / FORCES;
    let in_units = |all: Vec<[f64; 3]>, unit: f64| {
        let all = all.into_iter().flatten();
        all.map(|x| (x / unit).round() as i64).collect()
    };
    let of_contact = |(k, name): (usize, &String)| {
        let (at, force) = forces.rows.iter().map(|row| row[k]).unzip();
        DrawnForce {
            name: name.clone(),
            at: in_units(at, grain),
            force: in_units(force, unit),
        }
    };
    Some(Contacts {
        planes,
        unit,
        forces: forces.names.iter().enumerate().map(of_contact).collect(),
    })
}

/// Draws three circles of a sphere; nothing for a point.
fn sphere(bodies: &mut Bodies, sphere: &ContactSphere) {
    let radius = sphere.radius.to_f64();
    let (body, place) = bodies.carrier(sphere.link);
    let centre = sphere.centre.map(|x| x.to_f64()).0;
    if radius <= 0.0 {
        return;
    }
    for axis in 0..3 {
        let corner = |k: usize| {
            let (sin, cos) = (k as f64 * TAU / CIRCLE as f64).sin_cos();
            let mut at = centre;
            at[(axis + 1) % 3] += radius * cos;
            at[(axis + 2) % 3] += radius * sin;
            place.point(at)
        };
        let edges = (0..CIRCLE).map(|k| [corner(k), corner(k + 1)]);
        bodies.all[body].edges.extend(edges);
    }
}

/// Draws the edges of boxes: entries of eight contacts, whose corners differ in x first, then in y, then in z.
fn boxes(bodies: &mut Bodies, pairs: &[&ContactPair]) {
    for corners in pairs.chunk_by(|a, b| a.entry == b.entry) {
        if corners.len() != 8 {
            continue;
        }
        let (body, place) = bodies.carrier(corners[0].sphere.link);
        let at = |k: usize| place.point(corners[k].sphere.centre.map(|x| x.to_f64()).0);
        let beside = |k: usize| [1, 2, 4].map(|bit| (k, k ^ bit));
        let edges = (0..8).flat_map(beside).filter(|(a, b)| a < b);
        let edges: Vec<[[f64; 3]; 2]> = edges.map(|(a, b)| [at(a), at(b)]).collect();
        bodies.all[body].edges.extend(edges);
    }
}
