//! The subject of a study: a scene with its reference and its contenders.

use bgdyn_runtime::Dd;
use bgdyn_sim::{Integrator, WithIntegrator, with_integrator};
use nalgebra::SVector;

use crate::contender::{Contender, Grid, StepControl, Stop};
use crate::priced::Priced;

/// The measured output at each sample, in double-double, by a tolerance.
pub type References = Box<dyn Fn(&Grid, f64) -> Result<Vec<Vec<Dd>>, Stop>>;

/// A scene as it is studied.
pub struct Subject {
    /// The scene's name.
    pub scene: String,
    /// What it is, in a line.
    pub description: String,
    /// The measured output: a place or a coordinate.
    pub output: String,
    /// The measured output's unit.
    pub unit: String,
    /// When it ends, s.
    pub end: f64,
    /// The scene's own method and step control, by which effects are compared.
    pub own: (String, StepControl),
    /// Whether its laws have kinks, which steps end at only as exactly as they are found.
    pub kinked: bool,
    /// The reference.
    pub reference: Option<References>,
    /// Tolerances of the reference and of the coarser run that its error is taken from.
    pub tolerances: (f64, f64),
    /// Ways to run the scene with all effects, each with its own ladder of steps or tolerances.
    pub contenders: Vec<Contender>,
    /// The scene with fewer effects, each at the scene's own step control.
    pub levels: Vec<Contender>,
    /// The scene with all effects, and without each: what a call and a run cost.
    pub prices: Vec<Priced>,
}

impl Subject {
    /// A scene that nothing is known of yet: names, unit, end and the scene's own way to run.
    pub fn new(
        [scene, description, output, unit]: [&str; 4],
        end: f64,
        method: &str,
        step_control: StepControl,
    ) -> Self {
        Subject {
            scene: scene.into(),
            description: description.into(),
            output: output.into(),
            unit: unit.into(),
            end,
            own: (method.into(), step_control),
            kinked: false,
            reference: None,
            tolerances: (1e-20, 1e-18),
            contenders: Vec::new(),
            levels: Vec::new(),
            prices: Vec::new(),
        }
    }
}

/// Without the closures.
impl std::fmt::Debug for Subject {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Subject")
            .field("scene", &self.scene)
            .field("output", &self.output)
            .field("contenders", &self.contenders)
            .field("levels", &self.levels)
            .field("prices", &self.prices)
            .finish_non_exhaustive()
    }
}

/// What is known of an integrator beforehand.
struct Known;

impl WithIntegrator<SVector<f64, 1>> for Known {
    type Output = (u32, bool);

    fn with<M: Integrator<SVector<f64, 1>>>(self, integrator: M) -> Self::Output {
        let info = integrator.info();
        (info.order, info.estimate.is_some())
    }
}

/// Order of a method and whether it goes by a tolerance, by its name in scenes: one with `canonical_`
/// in front is that method on momenta. `None` where there is no such method.
pub fn order(name: &str) -> Option<(u32, bool)> {
    with_integrator(name.strip_prefix("canonical_").unwrap_or(name), Known)
}
