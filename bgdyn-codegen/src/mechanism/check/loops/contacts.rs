//! Wheels, balls and knife edges: their places and the chain of joints from there to their plane.

use bgdyn_runtime::Dd;

use super::placed::Context;
use super::planes;
use super::read::ReadLoop;
use super::tree::{Tree, find_site, path, step};
use crate::fault::{Faults, wording};
use crate::math::Vec3;
use crate::mechanism::check::constraint::{ContactEntry, ContactKind, RollingSize, Slip};
use crate::mechanism::closure::{
    Closure, ContactRow, ContactShape, DISC, DISC_ROWS, EDGE_ROWS, ELLIPSOID, KNIFE_EDGE,
    KinematicLoop, LoopChain, PlaneContact, SPHERE, SPHERE_ROWS,
};
use crate::mechanism::joint::DoubleDouble;
use crate::mechanism::{CoordinateId, LinkId, Motion, Pose};

/// Components of constant directions deviate by less.
const ROUNDING: f64 = 1e-24;

/// The least cosine of a wheel's lean at which it has a lowest point.
const FLAT: f64 = 1e-6;

/// Reads a wheel, a ball or a knife edge. `None` if a rule is broken.
pub(super) fn read(
    entry: &ContactEntry,
    (context, planes): (Context<'_>, &planes::Planes<'_>),
    faults: &mut Faults,
) -> Option<ReadLoop> {
    let (_, tree, directions) = context;
    let (link, pose) = find_site(&entry.at, tree, faults)?;
    let on = match &entry.kind {
        ContactKind::Edge { .. } => None,
        ContactKind::Rolling { on, .. } => on.as_ref(),
    };
    let (plane_link, plane) = planes::plane(on, planes, faults)?;
    let contact = |shape, (radius, crown), rows| PlaneContact {
        shape,
        radius,
        crown,
        spin: Vec::new(),
        rows,
        upward: None,
        solved: None,
        place: pose,
    };
    let (kind, contact) = match &entry.kind {
        ContactKind::Edge { direction } => {
            let shape = ContactShape::Edge(directions.axis(direction, faults)?);
            let none = (Dd::ZERO, Dd::ZERO);
            (&KNIFE_EDGE, contact(shape, none, EDGE_ROWS.to_vec()))
        }
        ContactKind::Rolling {
            axle, size, slip, ..
        } => match (axle, *size) {
            (Some(axle), RollingSize::Radius(radius, crown)) => {
                let shape = ContactShape::Disc(directions.axis(axle, faults)?);
                (&DISC, contact(shape, (radius, crown), rows(*slip)))
            }
            (_, RollingSize::HalfAxes([a, b, c])) if a != b || b != c => {
                let shape = ContactShape::Ellipsoid([a, b, c]);
                let largest = [b, c].into_iter().fold(a, |x, y| if y > x { y } else { x });
                let rows = SPHERE_ROWS.to_vec();
                (&ELLIPSOID, contact(shape, (largest, Dd::ZERO), rows))
            }
            (_, RollingSize::Radius(radius, _) | RollingSize::HalfAxes([radius, ..])) => {
                let rows = SPHERE_ROWS.to_vec();
                (
                    &SPHERE,
                    contact(ContactShape::Sphere, (radius, Dd::ZERO), rows),
                )
            }
        },
    };
    let (carrier, start, contact) = on_carrier(tree, (link, pose), contact);
    let path = path(tree, carrier, plane_link);
    let steps = path
        .iter()
        .map(|&(link, outward)| step(tree, link, outward));
    let closes = KinematicLoop {
        name: entry.name.clone(),
        kind,
        links: [link, plane_link],
        chain: LoopChain {
            start,
            steps: steps.collect(),
            end: plane,
        },
        length: Dd::ONE,
        axis: None,
        crossed: false,
        reversible: false,
        contact: Some(contact),
        location: entry.location.clone(),
    };
    if closes.velocities().next().is_none() {
        faults.push(wording::contact_moves_nothing(&entry.location, &entry.name));
        return None;
    }
    Some(ReadLoop {
        closes,
        branch: None,
        parallelogram: false,
        near: Vec::new(),
        redundant: false,
        tolerance: 0.0,
    })
}

fn rows(slip: Slip) -> Vec<(&'static str, ContactRow)> {
    let kept = |(_, row): &(&str, ContactRow)| match row {
        ContactRow::Longitudinal => !slip.longitudinal,
        ContactRow::Lateral => !slip.lateral,
        _ => true,
    };
    DISC_ROWS.into_iter().filter(kept).collect()
}

/// Moves the place of a wheel to the link that carries its axle, as long as joints are rotations about it: then their
/// angles do not enter the rows.
fn on_carrier(
    tree: Tree<'_>,
    (mut link, mut pose): (Option<LinkId>, Pose),
    mut contact: PlaneContact,
) -> (Option<LinkId>, Pose, PlaneContact) {
    while let (ContactShape::Disc(axle), Some(LinkId(i))) = (contact.shape, link) {
        let joint = &tree.links()[i].joint;
        let axle = pose.rotation * axle;
        let small = |v: Vec3<Dd>| v.dot(v).to_f64() <= ROUNDING * ROUNDING;
        let about_axle = small(joint.axis.cross(axle)) && small(joint.axis.cross(pose.translation));
        match joint.kind.motion {
            Motion::None => {}
            Motion::Rotation if about_axle => {
                let along = joint.axis.dot(axle);
                let ratios = joint.degrees.velocity_ratios();
                let own = joint.degrees.velocities.iter().zip(ratios);
                spin(&mut contact, own.map(|(&j, ratio)| (j, ratio * along)));
            }
            _ => break,
        }
        let origin = joint.origin;
        pose = Pose {
            rotation: origin.rotation * pose.rotation,
            translation: origin.translation + origin.rotation * pose.translation,
        };
        link = tree.links()[i].parent;
    }
    (link, pose, contact)
}

/// Adds velocities of rotations about the axle.
fn spin(contact: &mut PlaneContact, own: impl Iterator<Item = (CoordinateId, Dd)>) {
    for (j, factor) in own {
        match contact.spin.iter_mut().find(|(known, _)| *known == j) {
            Some((_, sum)) => *sum += factor,
            None => contact.spin.push((j, factor)),
        }
    }
}

/// Finds the directions from contacts to centres that are constant in the axes of their carriers, and reports wheels
/// whose axle is normal to their plane. `positions` are some of the open tree.
pub(super) fn find_upward(closure: &mut Closure, positions: &[Vec<Dd>], faults: &mut Faults) {
    for one in &mut closure.loops {
        let Some(PlaneContact {
            shape: ContactShape::Disc(axle),
            ..
        }) = one.contact
        else {
            continue;
        };
        let across = |q: &Vec<Dd>| {
            let normal = one.chain.frames(q, &DoubleDouble).last_axes();
            let normal = (normal * one.chain.end.rotation).column(2);
            normal - axle.scale(axle.dot(normal))
        };
        let all: Vec<Vec3<Dd>> = positions.iter().map(across).collect();
        let size = |v: &Vec3<Dd>| v.dot(*v).sqrt();
        let largest = all.iter().map(|v| size(v).to_f64()).fold(0.0, f64::max);
        if largest < FLAT {
            faults.push(wording::wheel_lies_flat(&one.location, &one.name));
            continue;
        }
        let Some(first) = all.first() else { continue };
        let upward = first.scale(Dd::ONE / size(first));
        let parallel = |v: &Vec3<Dd>| {
            v.cross(upward)
                .0
                .iter()
                .all(|x| x.to_f64().abs() < ROUNDING)
        };
        let exact = |x: Dd| {
            let near = Dd::from_f64(x.to_f64().round());
            if (x - near).to_f64().abs() < ROUNDING {
                near
            } else {
                x
            }
        };
        if let (true, Some(contact)) = (all.iter().all(parallel), &mut one.contact) {
            contact.upward = Some(upward.map(exact));
        }
    }
}
