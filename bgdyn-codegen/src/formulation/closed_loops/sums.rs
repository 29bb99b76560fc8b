//! Angles and rates of joints in loops as sums of those of independent joints and of the unknown ones of polygons.

use std::collections::BTreeMap;

use crate::mechanism::closure::{AngleTerm, PlaneJoint, Polygon, PolygonForm};

/// A sum with whole factors: of the positions or velocities of the open tree with these numbers, and of the unknown
/// angles or rates with these numbers, two for each polygon.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct JointSum {
    pub own: BTreeMap<usize, i32>,
    pub unknown: BTreeMap<usize, i32>,
}

impl JointSum {
    fn of_unknown(k: usize) -> Self {
        JointSum {
            unknown: BTreeMap::from([(k, 1)]),
            ..JointSum::default()
        }
    }

    pub(super) fn add(&mut self, other: &JointSum, factor: i32) {
        let pairs = [
            (&mut self.own, &other.own),
            (&mut self.unknown, &other.unknown),
        ];
        for (own, others) in pairs {
            for (&k, &n) in others {
                *own.entry(k).or_default() += factor * n;
            }
            own.retain(|_, n| *n != 0);
        }
    }
}

/// What the angles (or displacements) and the rates of the open tree's joints are sums of.
#[derive(Clone, Debug, Default)]
pub(super) struct JointSums {
    /// By position: of the dependent joints.
    positions: BTreeMap<usize, JointSum>,
    /// By velocity: of the dependent joints.
    velocities: BTreeMap<usize, JointSum>,
}

/// The number of the first unknown of a polygon: the angle of `first`, `arm` or `along`. The other one is the angle of
/// `second` or the displacement of the slide.
pub(super) fn unknown(polygon: usize) -> usize {
    2 * polygon
}

impl JointSums {
    pub(super) fn new(polygons: &[Polygon]) -> Self {
        let mut sums = JointSums::default();
        for (p, polygon) in polygons.iter().enumerate() {
            let first = unknown(p);
            match &polygon.form {
                PolygonForm::Triangle {
                    first: a,
                    second: b,
                    ..
                } => {
                    let mut angles = [(&a.angle, first), (&b.angle, first + 1)];
                    // The angle with one dependent joint first.
                    angles.sort_by_key(|(angle, _)| {
                        let open = angle
                            .iter()
                            .filter(|t| polygon.dependents().contains(&t.joint));
                        open.count()
                    });
                    angles
                        .iter()
                        .for_each(|(angle, k)| sums.set_last(angle, polygon, *k));
                }
                PolygonForm::Slider { arm, slide, .. } => {
                    sums.set_last(&arm.angle, polygon, first);
                    sums.set(
                        *slide,
                        &JointSum::of_unknown(first + 1),
                        &JointSum::of_unknown(first + 1),
                    );
                }
                PolygonForm::Cylinder { along, slide, .. } => {
                    sums.set_last(&along.angle, polygon, first);
                    sums.set(
                        *slide,
                        &JointSum::of_unknown(first + 1),
                        &JointSum::of_unknown(first + 1),
                    );
                }
            }
        }
        sums
    }

    fn set(&mut self, joint: PlaneJoint, position: &JointSum, velocity: &JointSum) {
        self.positions.insert(joint.position.0, position.clone());
        self.velocities.insert(joint.velocity.0, velocity.clone());
    }

    /// Sets the joint of this angle that is not known yet: the unknown angle less the others.
    fn set_last(&mut self, angle: &[AngleTerm], polygon: &Polygon, k: usize) {
        let open = |term: &&AngleTerm| {
            let joint = term.joint;
            polygon.dependents().contains(&joint) && !self.positions.contains_key(&joint.position.0)
        };
        let Some(last) = angle.iter().find(open).copied() else {
            return;
        };
        let others: Vec<AngleTerm> = angle
            .iter()
            .filter(|t| t.joint != last.joint)
            .copied()
            .collect();
        let sign = if last.opposite { -1 } else { 1 };
        let solved = |sum: JointSum| {
            let mut solved = JointSum::default();
            solved.add(&JointSum::of_unknown(k), sign);
            solved.add(&sum, -sign);
            solved
        };
        let (position, velocity) = (solved(self.angle(&others)), solved(self.rate(&others)));
        self.set(last.joint, &position, &velocity);
    }

    /// Returns whether a position is that of a dependent joint.
    pub(super) fn depends(&self, position: usize) -> bool {
        self.positions.contains_key(&position)
    }

    /// Returns the position of a joint.
    pub(super) fn position(&self, p: usize) -> JointSum {
        let own = || JointSum {
            own: BTreeMap::from([(p, 1)]),
            ..JointSum::default()
        };
        self.positions.get(&p).cloned().unwrap_or_else(own)
    }

    /// Returns the velocity of a joint.
    pub(super) fn velocity(&self, j: usize) -> JointSum {
        let own = || JointSum {
            own: BTreeMap::from([(j, 1)]),
            ..JointSum::default()
        };
        self.velocities.get(&j).cloned().unwrap_or_else(own)
    }

    /// Returns the angle of a link.
    pub(super) fn angle(&self, angle: &[AngleTerm]) -> JointSum {
        self.total(angle, |joint| self.position(joint.position.0))
    }

    /// Returns the rate of a link's angle.
    pub(super) fn rate(&self, angle: &[AngleTerm]) -> JointSum {
        self.total(angle, |joint| self.velocity(joint.velocity.0))
    }

    fn total(&self, angle: &[AngleTerm], of: impl Fn(PlaneJoint) -> JointSum) -> JointSum {
        let mut sum = JointSum::default();
        for term in angle {
            sum.add(&of(term.joint), if term.opposite { -1 } else { 1 });
        }
        sum
    }
}
