//! What closes a planar loop in closed form: the numbers of its form, sines that are computed together, and the joints
//! that turn its links.

use bgdyn_runtime::Dd;

use crate::mechanism::closure::{AngleTerm, PlaneJoint, PlaneVector, Polygon, TurnedVector};

/// Sums of angles whose sines are computed together.
#[derive(Default)]
pub struct AngleSums {
    /// The terms of each sum.
    pub all: Vec<Vec<AngleTerm>>,
}

impl AngleSums {
    /// Returns the index of the angle by which a vector is turned, which is added if it is new; `None` if the vector is
    /// not turned.
    pub fn index(&mut self, turned: &TurnedVector) -> Option<usize> {
        if turned.angle.is_empty() {
            return None;
        }
        let known = self.all.iter().position(|angle| *angle == turned.angle);
        Some(known.unwrap_or_else(|| {
            self.all.push(turned.angle.clone());
            self.all.len() - 1
        }))
    }
}

/// Returns (a + b)², (a − b)² and a² − b² of the arms a and b of a triangle, m², and the inverse of a b.
pub fn triangle_numbers(arms: [&TurnedVector; 2]) -> ([Dd; 3], Dd) {
    let [a, b] = arms.map(|arm| length(arm.vector));
    let [outer, inner] = [a + b, a - b].map(|x| x * x);
    ([outer, inner, a * a - b * b], Dd::ONE / (a * b))
}

/// Returns the square of the arm a of a slider, m², and the inverse of a.
pub fn slider_numbers(arm: &TurnedVector) -> [Dd; 2] {
    let a = length(arm.vector);
    [a * a, Dd::ONE / a]
}

/// Returns the dependent joints of a polygon whose positions are angles, each with the `links` whose turns its change is
/// the sum of, and whether these are subtracted.
pub fn turned_joints(
    polygon: &Polygon,
    links: &[&TurnedVector],
) -> Vec<(PlaneJoint, Vec<(usize, bool)>)> {
    let dependents = polygon.dependents();
    let own = |link: usize| -> Vec<AngleTerm> {
        let terms = links[link].angle.iter().copied();
        terms
            .filter(|term| dependents.contains(&term.joint))
            .collect()
    };
    let mut order: Vec<usize> = (0..links.len()).collect();
    order.sort_by_key(|&k| own(k).len());
    let mut found: Vec<(PlaneJoint, Vec<(usize, bool)>)> = vec![];
    for link in order {
        let terms = own(link);
        let known = |term: &AngleTerm| found.iter().find(|(joint, _)| *joint == term.joint);
        let Some(last) = terms.iter().find(|term| known(term).is_none()) else {
            continue;
        };
        let mut sum = vec![(link, last.opposite)];
        for other in &terms {
            for &(k, negative) in known(other).iter().flat_map(|(_, terms)| terms) {
                // The turn of this link less that of the joint before.
                sum.push((k, negative != (other.opposite == last.opposite)));
            }
        }
        found.push((last.joint, sum));
    }
    found
}

fn length([x, y]: PlaneVector) -> Dd {
    (x * x + y * y).sqrt()
}
