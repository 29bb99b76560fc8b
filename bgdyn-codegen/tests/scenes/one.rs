//! Scenes of one effect, whose law is compared with its equation.

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::Scalar;

use super::common::{scene, told, try_scene};

/// A block of 2 kg that slides along x, 0.4 m from an anchor beside its path at first.
pub const BLOCK: &str = "\
format: 1
links:
  - name: block
    joint: { name: slide, type: prismatic, axis: x, limits: { lower: -300 mm, upper: 200 mm } }
    mass: 2 kg
frames:
  - { name: anchor, link: world, origin: { xyz: [0, 0.4, 0] } }
  - { name: hook, link: block }
";

/// The block's mass, kg.
pub const MASS: f64 = 2.0;

/// A mechanism under effects, and its derivative.
pub struct Tried {
    pub system: SceneEquations,
    derivative: Function,
}

/// Returns the text of a scene with these effects and other keys.
pub fn text(effects: &[&str], more: &str) -> String {
    let list: Vec<String> = effects.iter().map(|e| format!("  - {e}\n")).collect();
    format!(
        "scene: 1\nmechanism: block.yaml\neffects:\n{}{more}",
        list.concat()
    )
}

/// The block under one effect.
pub fn block(effect: &str) -> Tried {
    Tried::new(scene(&text(&[effect], ""), BLOCK))
}

impl Tried {
    pub fn new(system: SceneEquations) -> Self {
        let derivative = system.function(SceneFunction::Derivative);
        Tried { system, derivative }
    }

    /// State and inputs with these values, everything else 0.
    pub fn at<T: Scalar>(&self, q: &[T], v: &[T], x: &[T], u: &[T]) -> Inputs<T> {
        let zero = T::from_f64(0.0);
        let parameters = self.system.scene.parameters.iter();
        let value = |x: bgdyn_runtime::Dd| T::from_parts(x.hi(), x.lo());
        Inputs {
            q: q.to_vec(),
            v: v.to_vec(),
            a: vec![],
            x: x.to_vec(),
            u: u.to_vec(),
            modes: vec![zero; self.system.scene.layout.modes.len()],
            parameters: parameters.map(|p| value(p.default)).collect(),
            t: Some(zero),
            passed: vec![],
        }
    }

    /// Accelerations and rates of first-order states.
    pub fn rates<T: Scalar>(&self, inputs: Inputs<T>) -> Vec<T> {
        self.derivative.evaluate(inputs).0
    }

    /// The effort on the block at place q and speed v.
    pub fn effort(&self, q: f64, v: f64, u: &[f64]) -> f64 {
        MASS * self.rates(self.at(&[q], &[v], &[], u))[0]
    }
}

/// Equal to within rounding.
pub fn close(got: f64, wanted: f64) {
    let off = (got - wanted).abs() / wanted.abs().max(1e-6);
    assert!(off < 1e-13, "{got:e}, not {wanted:e}");
}

/// Checks wrong effects: each with its text, the rule and a part of the message.
pub fn refused(effects: &[(&str, &str, &str, &str)]) {
    for (effect, at, rule, message) in effects {
        let text = text(&[effect], "");
        let shown = match try_scene(&text, BLOCK) {
            Ok((_, warnings)) => warnings.render("scene.yaml", &text),
            Err(refusal) => told(&refusal, &text),
        };
        let column = effect.find(at).expect("what is wrong stands in the text") + 5;
        let first = shown.lines().next().unwrap_or_default();
        let place = format!("scene.yaml:4:{column}: ");
        assert!(first.starts_with(&place), "{place}\n{shown}");
        assert!(first.ends_with(&format!("[{rule}]")), "{rule}\n{shown}");
        assert!(first.contains(message), "{message}\n{shown}");
    }
}
