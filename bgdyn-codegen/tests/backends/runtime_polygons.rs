//! Planar loops in closed form by the functions of the runtime, as the Rust module calls them.

use bgdyn_codegen::bond_graph::ClosedTree;
use bgdyn_codegen::mechanism::closure::{
    PlaneJoint, Polygon, PolygonForm, TurnedVector, closing_polygons, snapped,
};
use bgdyn_codegen::plan::dependent_joint;
use bgdyn_codegen::plan::{slider_numbers, triangle_numbers, turned_joints};
use bgdyn_runtime::Dd;
use bgdyn_runtime::closure::polygon::{self as plane, PlaneVector, PolygonBranch, Polygons};
use bgdyn_runtime::closure::{Closing, Dependent};

use crate::runtime_positions::{ROOM, Vector};
use crate::values::CNumber;

/// Positions with those of planar loops in closed form.
pub struct ClosedPolygons<T: CNumber> {
    pub closing: Closing<Vector<T>>,
    /// The joints of all other loops.
    pub others: Vec<Dependent>,
}

/// Closes planar loops, on the branch of the positions `from` if there are any; `None` if there are no such loops.
pub fn close_polygons<T: CNumber>(
    closed: &ClosedTree,
    q: &Vector<T>,
    from: Option<&Vector<T>>,
) -> Option<ClosedPolygons<T>> {
    let (polygons, others) = closing_polygons(&closed.closure);
    if polygons.is_empty() {
        return None;
    }
    let (mut q, mut loops) = (*q, Polygons::new());
    for polygon in &polygons {
        close(polygon, &mut q, from, &mut loops);
    }
    let [q] = q.data.0;
    Some(ClosedPolygons {
        closing: loops.finish(q),
        others: others
            .into_iter()
            .map(|j| dependent_joint(closed, j))
            .collect(),
    })
}

/// The directions of links on either branch, and the displacements of the slide.
struct Found<T> {
    links: [Vec<PlaneVector<T>>; 2],
    slides: Option<(PlaneJoint, [T; 2])>,
    /// Whether the branch is the other one, where positions tell it.
    other: Option<bool>,
}

fn close<T: CNumber>(
    polygon: &Polygon,
    q: &mut Vector<T>,
    from: Option<&Vector<T>>,
    loops: &mut Polygons<T>,
) {
    let branch = PolygonBranch {
        positive: polygon.positive,
        place: ROOM + polygon.closes,
    };
    let sides = polygon.known.iter().map(|side| {
        let turned = at(&side.turned, q);
        side.slide
            .map_or(turned, |joint| plane::scaled(turned, q[joint.position.0]))
    });
    let known = sides
        .reduce(|a, b| plane::sum([a, b]))
        .unwrap_or(plane::sum([]));
    let is_other = |value: T, unit| plane::is_other(value, unit, polygon.positive);
    let (links, found) = match &polygon.form {
        PolygonForm::Triangle { first, second, .. } => {
            let (lengths, unit) = triangle_numbers([first, second]);
            let links = loops.triangle(known, lengths.map(constant), branch);
            let other = |q| is_other(plane::cross(at(first, q), at(second, q)), constant(unit));
            let found = Found {
                links: links.map(|both| both.to_vec()),
                slides: None,
                other: from.map(other),
            };
            (vec![first, second], found)
        }
        PolygonForm::Slider {
            arm, along, slide, ..
        } => {
            let [square, unit] = slider_numbers(arm).map(constant);
            let both = loops.slider((known, at(along, q)), square, branch);
            let other = |q| is_other(plane::dot(at(arm, q), at(along, q)), unit);
            let found = Found {
                links: both.map(|one| vec![one.0]),
                slides: Some((*slide, both.map(|one| one.1))),
                other: from.map(other),
            };
            (vec![arm], found)
        }
        PolygonForm::Cylinder {
            along,
            start,
            across,
            slide,
            ..
        } => {
            let [start, across] = snapped([*start, *across]).map(constant);
            let both = loops.cylinder(known, [start, across], branch);
            let length = from.unwrap_or(q)[slide.position.0] + plane::number(start);
            let found = Found {
                links: both.map(|one| vec![one.0]),
                slides: Some((*slide, both.map(|one| one.1))),
                other: Some(is_other(length, (1.0, 0.0))),
            };
            (vec![along], found)
        }
    };
    turn(polygon, &links, found, q, loops);
}

/// Turns links from their directions at q to those found, by their dependent joints: first nearly, then to rounding.
fn turn<T: CNumber>(
    polygon: &Polygon,
    links: &[&TurnedVector],
    found: Found<T>,
    q: &mut Vector<T>,
    loops: &mut Polygons<T>,
) {
    let joints = turned_joints(polygon, links);
    let moved = |turns: &[T]| -> Vec<T> {
        let term = |&(k, negative): &(usize, bool)| if negative { -turns[k] } else { turns[k] };
        let sum = |terms: &Vec<(usize, bool)>| terms.iter().map(term).reduce(|a, b| a + b);
        joints.iter().filter_map(|(_, terms)| sum(terms)).collect()
    };
    let here: Vec<PlaneVector<T>> = links.iter().map(|link| at(link, q)).collect();
    let turns = |to: &[PlaneVector<T>]| -> Vec<T> {
        here.iter()
            .zip(to)
            .map(|(&a, &b)| plane::turn(a, b))
            .collect()
    };
    let other = found.other.unwrap_or_else(|| {
        let changes = found.links.each_ref().map(|to| moved(&turns(to)));
        // Numbers beside those of the joints change no sum of squares.
        let padded = changes.map(|all| [0, 1].map(|k| all.get(k).copied().unwrap_or_default()));
        plane::is_nearer(padded)
    });
    let to = &found.links[usize::from(other)];
    let turns = turns(to);
    let add = |q: &mut Vector<T>, turns: &[T]| {
        for ((joint, _), change) in joints.iter().zip(moved(turns)) {
            q[joint.position.0] = q[joint.position.0] + change;
        }
    };
    add(q, &turns);
    let are_exact = match turns[..] {
        [a] => plane::are_exact([a]),
        [a, b] => plane::are_exact([a, b]),
        _ => unreachable!("one or two links"),
    };
    if !are_exact {
        let left = links
            .iter()
            .zip(to)
            .map(|(link, &to)| plane::small_turn(at(link, q), to));
        let left: Vec<T> = left.collect();
        add(q, &left);
    }
    for (joint, _) in &joints {
        loops.check_angle(q[joint.position.0], polygon.closes + ROOM);
    }
    if let Some((joint, slides)) = found.slides {
        q[joint.position.0] = slides[usize::from(other)];
    }
}

/// Returns a vector at positions.
fn at<T: CNumber>(turned: &TurnedVector, q: &Vector<T>) -> PlaneVector<T> {
    let vector = snapped(turned.vector).map(constant);
    if turned.angle.is_empty() {
        return plane::constant(vector);
    }
    let terms = turned.angle.iter().map(|term| {
        let q = q[term.joint.position.0];
        if term.opposite { -q } else { q }
    });
    let terms: Vec<T> = terms.collect();
    let [sines] = T::sin_cos_all([&terms[..]], [(0.0, 0.0)]);
    plane::turned(sines, vector)
}

fn constant(x: Dd) -> (f64, f64) {
    (x.hi(), x.lo())
}
