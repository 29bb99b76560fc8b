//! Inputs with derivatives: moving references, and the motions of prescribed joints.

use super::StateLayout;
use crate::unit::Dimension;

/// Level of a reference's time derivative.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Its position.
    Position,
    /// Its rate.
    Rate,
    /// Its acceleration.
    Acceleration,
}

impl Level {
    /// Returns the name of a reference's input.
    pub fn name(self, reference: &str) -> String {
        match self {
            Level::Position => reference.to_owned(),
            Level::Rate => format!("{reference}_rate"),
            Level::Acceleration => format!("{reference}_acceleration"),
        }
    }
}

impl StateLayout {
    /// Adds the motion of a prescribed joint: three inputs.
    pub fn prescribe(&mut self, joint: &str, dimension: Dimension) {
        self.prescribed.push(joint.to_owned());
        let of = format!("the prescribed joint `{joint}`");
        let words = ["position", "rate", "acceleration"];
        self.levels(
            joint,
            (Level::Position, Level::Acceleration),
            dimension,
            |k| format!("{} of {of}", words[k]),
        );
    }

    /// Adds a moving reference up to a level of its derivatives; several effects may share it.
    pub fn reference(&mut self, name: &str, from: Level, to: Level, dimension: Dimension) {
        let words = ["place", "speed", "acceleration"];
        self.levels(name, (from, to), dimension, |k| {
            format!("{} of the reference `{name}`", words[k])
        });
    }

    /// Adds an input and its derivatives, from one level to another.
    fn levels(
        &mut self,
        name: &str,
        (from, to): (Level, Level),
        dimension: Dimension,
        about: impl Fn(usize) -> String,
    ) {
        let all = [Level::Position, Level::Rate, Level::Acceleration];
        for (k, level) in all.into_iter().enumerate() {
            let own = level.name(name);
            if level < from || level > to || self.inputs.iter().any(|i| i.name == own) {
                continue;
            }
            let about = about(k);
            let dimension = match (level, dimension) {
                (Level::Position, d) => d,
                (Level::Rate, Dimension::Angle) => Dimension::AngularSpeed,
                (Level::Rate, _) => Dimension::Speed,
                (Level::Acceleration, Dimension::Angle) => Dimension::One,
                (Level::Acceleration, _) => Dimension::Acceleration,
            };
            self.input(own, dimension, about);
        }
    }
}
