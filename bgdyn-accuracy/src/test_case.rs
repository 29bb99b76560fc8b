//! A test case: a scene with its reference and its configurations.

use bgdyn_runtime::Dd;
use bgdyn_sim::{Integrator, WithIntegrator, with_integrator};
use nalgebra::SVector;

use crate::configuration::{Configuration, Grid, RunError, StepControl};
use crate::priced::Priced;

/// The measured output at each sample, in double-double, by a tolerance.
pub type References = Box<dyn Fn(&Grid, f64) -> Result<Vec<Vec<Dd>>, RunError>>;

/// A scene as it is studied.
pub struct TestCase {
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
    /// Ways to run the scene with all effects, each with its own sequence of steps or tolerances.
    pub configurations: Vec<Configuration>,
    /// The scene with fewer effects, each at the scene's own step control.
    pub ablations: Vec<Configuration>,
    /// The scene with all effects, and without each: what a call and a run cost.
    pub prices: Vec<Priced>,
}

impl TestCase {
    /// A scene that nothing is known of yet: names, unit, end and the scene's own way to run.
    pub fn new(
        [scene, description, output, unit]: [&str; 4],
        end: f64,
        method: &str,
        step_control: StepControl,
    ) -> Self {
        TestCase {
            scene: scene.into(),
            description: description.into(),
            output: output.into(),
            unit: unit.into(),
            end,
            own: (method.into(), step_control),
            kinked: false,
            reference: None,
            tolerances: (1e-20, 1e-18),
            configurations: Vec::new(),
            ablations: Vec::new(),
            prices: Vec::new(),
        }
    }
}

/// Without the closures.
impl std::fmt::Debug for TestCase {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("TestCase")
            .field("scene", &self.scene)
            .field("output", &self.output)
            .field("configurations", &self.configurations)
            .field("ablations", &self.ablations)
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
