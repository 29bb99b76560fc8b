//! Frames that are kept on one side of planes.

use bgdyn_codegen::bond_graph::{BondGraph, SiteId};
use bgdyn_codegen::engine::{CallArguments, Callable, Engine};
use bgdyn_codegen::format::Dimension;
use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::selection::function;
use bgdyn_codegen::tape::Tape;
use bgdyn_identification::excite::{Keep, Points};

use crate::quantity::value;

/// The origins of frames.
#[derive(Debug, Default)]
pub(crate) struct FramePoints {
    poses: Vec<(usize, Box<dyn Callable>)>,
    parameters: Vec<f64>,
}

impl FramePoints {
    /// Returns the index of the origin of a site; prepares its pose where it is new.
    fn index(&mut self, mechanism: &Mechanism, site: usize) -> usize {
        if let Some(known) = self.poses.iter().position(|(own, _)| *own == site) {
            return known;
        }
        let pose = function(mechanism, Method::Pose(SiteId(site)), &Options::default());
        let pose = Tape.prepare(&pose.expect("every formulation knows poses"));
        self.poses.push((site, pose));
        let parameters = mechanism.parameters().iter();
        self.parameters = parameters.map(|p| p.default.to_f64()).collect();
        self.poses.len() - 1
    }
}

impl Points for FramePoints {
    fn point(&self, index: usize, q: &[f64]) -> [f64; 3] {
        let (values, _) = self.poses[index].1.value(&CallArguments {
            q,
            parameters: &self.parameters,
            ..CallArguments::default()
        });
        [values[9], values[10], values[11]]
    }
}

/// A plane as it is written: `tool.z>0.1 m`, a frame or link, an axis of the world, a side, a height.
pub(crate) struct Plane {
    text: String,
    frame: String,
    axis: usize,
    side: f64,
    /// m
    level: f64,
}

impl Plane {
    /// Reads a plane.
    ///
    /// # Errors
    /// What is wrong with the text.
    pub(crate) fn read(text: &str) -> Result<Self, String> {
        let wrong = |why: String| format!("`--keep {text}`: {why}");
        let form =
            || wrong("write FRAME.AXIS>LENGTH or FRAME.AXIS<LENGTH, such as `tool.z>0.1 m`".into());
        let (place, length) = text.split_once(['<', '>']).ok_or_else(form)?;
        let (frame, axis) = place.trim().rsplit_once('.').ok_or_else(form)?;
        let axis = ["x", "y", "z"].iter().position(|own| *own == axis.trim());
        let level = value(length.trim(), &[Dimension::Length]).map_err(wrong)?;
        Ok(Plane {
            text: text.to_owned(),
            frame: frame.trim().to_owned(),
            axis: axis.ok_or_else(form)?,
            side: if text.contains('>') { 1.0 } else { -1.0 },
            level: level.to_f64(),
        })
    }

    /// Returns what is kept, with the origin of the frame among the points.
    ///
    /// # Errors
    /// If the mechanism has no such frame.
    pub(crate) fn keep(
        &self,
        mechanism: &Mechanism,
        graph: &BondGraph,
        points: &mut FramePoints,
    ) -> Result<Keep, String> {
        let site = graph.sites.iter().position(|site| site.name == self.frame);
        let site = site.ok_or_else(|| {
            let known: Vec<&str> = graph.sites.iter().map(|s| s.name.as_str()).collect();
            format!(
                "`--keep {}`: no frame or link `{}`: there are {}",
                self.text,
                self.frame,
                known.join(", ")
            )
        })?;
        Ok(Keep {
            name: self.text.clone(),
            point: points.index(mechanism, site),
            axis: self.axis,
            side: self.side,
            level: self.level,
        })
    }
}
