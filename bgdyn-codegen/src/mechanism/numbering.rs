//! Numbers the positions and velocities of a mechanism's joints, and names them.

use bgdyn_runtime::Dd;

use super::closure::Closure;
use super::{CoordinateId, Coupling, Joint, Leader, LinkId, Mechanism, Motion, PositionId};

impl Mechanism {
    /// Numbers the positions and velocities, in the order of the links; a coupled joint gets those of the
    /// joints that it follows, and a prescribed one has none.
    pub(super) fn number(&mut self) {
        let (mut positions, mut coordinates) = (Vec::new(), Vec::new());
        for (i, link) in self.links.iter_mut().enumerate() {
            let joint = &mut link.joint;
            let motion = joint.kind.motion;
            joint.coordinate = None;
            (joint.degrees.positions, joint.degrees.velocities) = (vec![], vec![]);
            if self.prescribed.iter().any(|p| p.link == LinkId(i)) {
                continue;
            }
            let own_positions = match joint.degrees.own_positions() {
                true => motion.nq(),
                false => 0,
            };
            for _ in 0..own_positions {
                joint.degrees.positions.push(PositionId(positions.len()));
                positions.push(LinkId(i));
            }
            if joint.degrees.coupling.is_some() {
                continue;
            }
            let own = (0..motion.nv()).filter(|k| !joint.degrees.dependent.contains(k));
            let own = own.count();
            if own == 0 {
                continue;
            }
            if matches!(motion, Motion::Rotation | Motion::Translation) {
                joint.coordinate = Some(CoordinateId(coordinates.len()));
            }
            for _ in 0..own {
                joint
                    .degrees
                    .velocities
                    .push(CoordinateId(coordinates.len()));
                coordinates.push(LinkId(i));
            }
        }
        for i in 0..self.links.len() {
            let Some(coupling) = self.links[i].joint.degrees.coupling.clone() else {
                continue;
            };
            let degrees = |leader: &Leader| &self.links[leader.link.0].joint.degrees;
            let first = |leader: &Leader| degrees(leader).velocities.first().copied();
            let velocities = coupling.velocities.iter().filter_map(first).collect();
            let first = |leader: &Leader| degrees(leader).positions.first().copied();
            let positions: Vec<_> = coupling.positions.iter().filter_map(first).collect();
            let own = &mut self.links[i].joint.degrees;
            own.velocities = velocities;
            if coupling.of_positions() {
                own.positions = positions;
            }
        }
        (self.positions, self.coordinates) = (positions, coordinates);
    }

    /// Sets the loops of a numbered tree: their dependent velocities are not numbered any more.
    pub(super) fn close(&mut self, closure: Closure) {
        for j in closure.dependents() {
            let LinkId(i) = self.coordinates[j.0];
            let degrees = &mut self.links[i].joint.degrees;
            let first = degrees.velocities.first().map_or(0, |first| first.0);
            degrees.dependent.push(j.0 - first);
        }
        self.closure = Some(closure);
        self.number();
    }

    /// Returns the open tree: the mechanism without its loops.
    pub fn open(&self) -> Self {
        let mut open = self.clone();
        open.closure = None;
        for link in &mut open.links {
            link.joint.degrees.dependent.clear();
        }
        open.number();
        open
    }

    /// Returns the number of velocities.
    pub fn nv(&self) -> usize {
        self.coordinates.len()
    }

    /// Returns the number of positions.
    pub fn nq(&self) -> usize {
        self.positions.len()
    }

    /// Returns, for each position, the link of its joint.
    pub fn positions(&self) -> &[LinkId] {
        &self.positions
    }

    /// Returns the joint of a coordinate.
    pub fn joint(&self, coordinate: CoordinateId) -> &Joint {
        &self.links[self.coordinates[coordinate.0].0].joint
    }

    /// Returns whether the unit of a coordinate's velocity is m/s, not rad/s.
    pub fn linear(&self, coordinate: CoordinateId) -> bool {
        let joint = self.joint(coordinate);
        let columns = joint.degrees.columns(joint.kind.motion, joint.axis);
        let own = columns.iter().find(|(j, _)| *j == coordinate);
        own.is_some_and(|(_, column)| column.angular.0.iter().all(|&x| x == Dd::ZERO))
    }

    /// Returns the coupled joints, each with its relation, and whether the unit of its own velocity is m/s.
    pub fn followers(&self) -> impl Iterator<Item = (&Joint, &Coupling, bool)> {
        let joints = self.links.iter().map(|link| &link.joint);
        joints.filter_map(|joint| {
            let coupling = joint.degrees.coupling.as_ref()?;
            Some((joint, coupling, joint.kind.motion == Motion::Translation))
        })
    }

    /// Returns the names of the joints that a coupled one follows.
    pub fn leaders(&self, coupling: &Coupling) -> Vec<String> {
        let name = |leader: &Leader| self.links[leader.link.0].joint.name.clone();
        coupling.velocities.iter().map(name).collect()
    }

    /// Returns whether a coordinate's velocity is not the rate of a position.
    pub fn is_quasi_velocity(&self, coordinate: CoordinateId) -> bool {
        let joint = self.joint(coordinate);
        let part = joint.degrees.part(coordinate);
        let positions = joint.kind.motion.velocity_positions();
        part.and_then(|part| positions.into_iter().nth(part))
            .is_some_and(|position| position.is_none())
    }

    /// Returns the names of the joints with one velocity, in the order of the velocities.
    pub fn one_degree_names(&self) -> Vec<String> {
        let single = |j: &usize| self.joint(CoordinateId(*j)).kind.motion.nv() == 1;
        let names = self.joint_names();
        let kept = (0..names.len()).filter(single);
        kept.map(|j| names[j].clone()).collect()
    }

    /// Returns the joints that are not plain: more than one degree, a screw, coupled, or prescribed; that of a
    /// base whose motion is given, too.
    pub fn compound_joints(&self) -> impl Iterator<Item = &Joint> {
        let joints = self.links.iter().map(|link| &link.joint);
        joints.filter(|joint| joint.coordinate.is_none() && joint.kind.motion != Motion::None)
    }

    /// Returns the names of the coordinates: that of the joint, with an ending for each velocity of a
    /// joint with several.
    pub fn joint_names(&self) -> Vec<String> {
        let of = |joint: &Joint, j: usize| {
            let own = joint.degrees.part(CoordinateId(j))?;
            match joint.kind.motion {
                Motion::Compound(motion) => Some(motion.velocities[own].suffix),
                _ => None,
            }
        };
        self.names(&self.coordinates, of)
    }

    /// Returns the names of the positions, in the same way.
    pub fn position_names(&self) -> Vec<String> {
        let of = |joint: &Joint, p: usize| {
            let own = joint.degrees.positions.iter().position(|x| x.0 == p)?;
            match joint.kind.motion {
                Motion::Compound(motion) => Some(motion.positions[own].suffix),
                _ => None,
            }
        };
        self.names(&self.positions, of)
    }

    /// Returns a name for each of these: that of the joint of its link, with an ending.
    fn names(
        &self,
        links: &[LinkId],
        ending: impl Fn(&Joint, usize) -> Option<&'static str>,
    ) -> Vec<String> {
        let name = |(k, link): (usize, &LinkId)| {
            let joint = &self.links[link.0].joint;
            suffixed(&joint.name, ending(joint, k).unwrap_or_default())
        };
        links.iter().enumerate().map(name).collect()
    }
}

fn suffixed(name: &str, suffix: &str) -> String {
    match suffix {
        "" => name.to_owned(),
        _ => format!("{name}_{suffix}"),
    }
}
