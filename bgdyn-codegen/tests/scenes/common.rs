//! Scenes from files and from text, and states for their tests.

use bgdyn_codegen::random::Random;
use std::path::{Path, PathBuf};

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::files::{beside, stem};
use bgdyn_codegen::read_scene;
use bgdyn_codegen::refusal::Refusal;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::Dd;

/// The repository's scene files.
pub fn specs() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs/scenes");
    let mut found: Vec<PathBuf> = std::fs::read_dir(&folder)
        .expect("the folder of scenes")
        .map(|entry| entry.expect("an entry").path())
        .collect();
    found.sort();
    found.push(folder.join("../contact/ball_in_corner.scene.yaml"));
    found
}

/// The scene in a file.
pub fn read(path: &Path) -> SceneEquations {
    let text = std::fs::read_to_string(path).expect("a scene");
    let load = |mechanism: &str| {
        std::fs::read_to_string(beside(path, mechanism)).map_err(|e| e.to_string())
    };
    match read_scene(&text, &stem(path), load) {
        Ok((system, _)) => system,
        Err(refusal) => panic!("{}: {}", path.display(), told(&refusal, &text)),
    }
}

/// A scene from its text and its mechanism's.
pub fn scene(text: &str, mechanism: &str) -> SceneEquations {
    match try_scene(text, mechanism) {
        Ok((system, _)) => system,
        Err(refusal) => panic!("{}", told(&refusal, text)),
    }
}

/// Returns the scene, or the reason of its refusal.
pub fn try_scene(
    text: &str,
    mechanism: &str,
) -> Result<(SceneEquations, bgdyn_codegen::fault::Faults), Refusal> {
    read_scene(text, "scene", |_| Ok(mechanism.to_owned()))
}

/// Returns the text of a refusal.
pub fn told(refusal: &Refusal, text: &str) -> String {
    match refusal {
        Refusal::Spec(faults) => faults.render("scene.yaml", text),
        Refusal::Mechanism {
            path,
            text: its,
            faults,
            scene,
        } => scene.render("scene.yaml", text) + &faults.render(path, its),
        Refusal::Options(_) => "options".into(),
        Refusal::Unequal(differences) => bgdyn_codegen::verify::explain(differences),
    }
}

/// Returns numbers within `size` of 0.
fn many(random: &mut Random, n: usize, size: f64) -> Vec<Dd> {
    (0..n)
        .map(|_| Dd::from_f64(random.signed() * size))
        .collect()
}

/// Returns the winding, the sign and the size of the limit whose mode has this name.
fn current_limit(system: &SceneEquations, mode: &str) -> Option<(usize, f64, Dd)> {
    let sides = [("_upper_limit", 1.0), ("_lower_limit", -1.0)];
    let (name, side) = sides
        .iter()
        .find_map(|(end, side)| Some((mode.strip_suffix(end)?, *side)))?;
    let element = system.scene.elements.iter().find(|e| e.name == name)?;
    let winding = system.scene.layout.coordinate_named(name)?;
    Some((
        winding,
        side,
        element.quantity(element.effect.key("current_limit"))?.value,
    ))
}

/// A random state of a scene near its start, with random inputs and accelerations; `slipping`
/// modes, or held ones.
pub fn state(system: &SceneEquations, random: &mut Random, slipping: bool) -> Inputs<Dd> {
    let layout = &system.scene.layout;
    let mut around = |start: &[Dd], size: f64| -> Vec<Dd> {
        let offsets = many(random, start.len(), size);
        start.iter().zip(offsets).map(|(&s, o)| s + o).collect()
    };
    let mut q = around(&system.initial.q, 0.3);
    layout.normalize(&mut q);
    let mut v = around(&system.initial.v, 1.0);
    // States with scales of their own: bristles, fluid volumes.
    let x: Vec<Dd> = system
        .initial
        .x
        .iter()
        .map(|&s| {
            let size = if s == Dd::ZERO {
                1e-3
            } else {
                s.to_f64() * 1e-3
            };
            s + Dd::from_f64(random.signed() * size)
        })
        .collect();
    let u = many(random, layout.inputs.len(), 2.0);
    let a = many(random, layout.nv(), 3.0);
    let mut modes = Vec::new();
    let upper = u.first().is_none_or(|u| *u > Dd::ZERO);
    let (coordinates, mut seen) = (system.mode_coordinates(), Vec::new());
    for (k, part) in layout.modes.iter().enumerate() {
        let sign = if random.signed() < 0.0 { -1.0 } else { 1.0 };
        if let Some((motor, side, limit)) = current_limit(system, &part.name) {
            // At one of its limits at a time.
            let held = !slipping && (side > 0.0) == upper;
            modes.push(Dd::from_f64(match (held, slipping) {
                (true, _) => 0.0,
                (false, true) => sign,
                (false, false) => -side,
            }));
            if held {
                v[motor] = limit * Dd::from_f64(side);
            }
            continue;
        }
        let j = coordinates[k];
        if seen.contains(&j) {
            // Another friction or gear has set the motion of this joint.
            let moves = if v[j] < Dd::ZERO { -1.0 } else { 1.0 };
            let mode = if v[j] == Dd::ZERO { 0.0 } else { moves };
            modes.push(Dd::from_f64(mode));
            continue;
        }
        seen.push(j);
        modes.push(Dd::from_f64(if slipping { sign } else { 0.0 }));
        // A held joint moves with its counterpart.
        let element = system.scene.elements.iter().find(|e| e.name == part.name);
        let reference = element.and_then(|e| {
            let mut keys = e.effect.keys().iter();
            e.name(keys.find(|key| key.name == "reference")?)
        });
        let rate = reference.map(|r| format!("{r}_rate"));
        let speed = layout
            .inputs
            .iter()
            .position(|i| Some(&i.name) == rate.as_ref());
        let speed = speed.map_or(Dd::ZERO, |i| u[i]);
        v[j] = if slipping {
            speed + Dd::from_f64(sign * (0.2 + random.signed().abs()))
        } else {
            speed
        };
    }
    Inputs {
        q,
        v,
        a,
        x,
        u,
        modes,
        parameters: system.scene.parameters.iter().map(|p| p.default).collect(),
        t: Some(Dd::from_f64(random.signed().abs())),
        passed: vec![],
    }
}
