//! A test case: a scene with its reference and its configurations.

use bgdyn_runtime::{Dd, ImpactLaw};
use bgdyn_sim::{Integrator, WithIntegrator, with_integrator};
use nalgebra::SVector;

use crate::configuration::{Configuration, Grid, RunError, StepControl};
use crate::priced::Priced;

/// Returns the measured output at each sample, in double-double, with a tolerance.
pub type References = Box<dyn Fn(&Grid, f64) -> Result<Vec<Vec<Dd>>, RunError>>;

/// A scene for a study.
pub struct TestCase {
    /// The scene's name.
    pub scene: String,
    /// Its description, in a line.
    pub description: String,
    /// The measured output: a site or a coordinate.
    pub output: String,
    /// The measured output's unit.
    pub unit: String,
    /// End of the run, s.
    pub end: f64,
    /// The scene's own integrator and step control, with which effects are compared.
    pub own: (String, StepControl),
    /// Whether its laws have kinks; the accuracy of steps that end there is limited by that of the event
    /// search.
    pub kinked: bool,
    /// The reference.
    pub reference: Option<References>,
    /// Tolerances of the reference and of the coarser run for its error estimate.
    pub tolerances: (f64, f64),
    /// Configurations for the scene with all effects, each with its own sequence of steps or tolerances.
    pub configurations: Vec<Configuration>,
    /// The scene with fewer effects, each at the scene's own step control.
    pub ablations: Vec<Configuration>,
    /// The scene with all effects, and without each: the cost of a call and of a run.
    pub prices: Vec<Priced>,
}

impl TestCase {
    /// Returns a test case without data: names, unit, end and the scene's own settings.
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

/// Prints all fields except the closures.
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

/// Returns the properties of an integrator.
struct Known;

impl WithIntegrator<SVector<f64, 1>> for Known {
    type Output = (u32, bool);

    fn with<M: Integrator<SVector<f64, 1>>>(self, integrator: M) -> Self::Output {
        let info = integrator.info();
        (info.order, info.estimate.is_some())
    }
}

/// Returns whether an integrator has a law of impacts: `moreau` has Newton's.
pub fn has_law(integrator: &str, law: ImpactLaw) -> bool {
    integrator != "moreau" || law == ImpactLaw::Newton
}

/// Returns the order of an integrator and whether it has step control, by its name in scenes; the prefix
/// `canonical_` means the integrator of the canonical form. `None` if the name is unknown.
pub fn order(name: &str) -> Option<(u32, bool)> {
    with_integrator(name.strip_prefix("canonical_").unwrap_or(name), Known)
}
