//! Checks the model of a scene's controllers: a scene of its own, of which all arguments are those of the plant.

use super::super::Scene;
use super::super::signal::InputSource;
use super::{Verdict, effects};
use crate::declaration::EffectKinds;
use crate::fault::{Faults, wording};
use crate::format::{ControllerModelSpec, Dimension, Field, Located, Raw, SceneSpec};
use crate::layout::StateLayout;
use crate::machine::Machine;

/// Adds the model of the controllers to a valid scene: the effects of the file, or those of the scene, on `machine`, with
/// the computed torques of the scene.
pub fn with_controller_model(
    plant: Scene,
    spec: &SceneSpec,
    machine: &Machine,
    kinds: &EffectKinds,
) -> (Scene, Faults) {
    let mut faults = Faults::default();
    let Some(own) = spec.controller_model.given() else {
        return (plant, faults);
    };
    let own = &own.value;
    let followed = |drive: &InputSource| matches!(drive, InputSource::ComputedTorque { .. });
    if !plant.drives.iter().any(followed) {
        faults.push(wording::no_computed_torque(&own.location));
        return (plant, faults);
    }
    let inner = inner_spec(spec, own, &plant);
    let (verdict, found) = super::check(&inner, Some(&plant.name), machine, kinds);
    let found = found.0.into_iter().map(wording::of_controller_model);
    faults.0.extend(found);
    let Verdict::Sound(mut model) = verdict else {
        return (plant, faults);
    };
    for raw in effects::given(&own.parameters) {
        set_parameter(&mut model, raw, &mut faults);
    }
    for (what, name) in missing(&model.layout, &plant.layout) {
        faults.push(wording::controller_needs(&own.location, what, name));
    }
    let scene = Scene {
        controller_model: Some(model),
        ..plant
    };
    (scene, faults)
}

/// Returns the model as a scene's file, with the computed torques alone: its other inputs have the signals of the scene.
fn inner_spec(spec: &SceneSpec, own: &ControllerModelSpec, plant: &Scene) -> SceneSpec {
    let parts = plant.layout.inputs.iter().zip(&plant.drives);
    let followed = parts.filter(|(_, drive)| matches!(drive, InputSource::ComputedTorque { .. }));
    let names: Vec<&str> = followed.map(|(part, _)| part.name.as_str()).collect();
    let inputs = effects::given(&spec.inputs).iter();
    let inputs = inputs.filter(|raw| names.contains(&raw.name.value.as_str()));
    let inputs = Located {
        value: inputs.cloned().collect(),
        location: own.location.clone(),
    };
    SceneSpec {
        location: own.location.clone(),
        complete: true,
        effects_read: true,
        description: Field::Absent,
        effects: match &own.effects {
            Field::Absent => spec.effects.clone(),
            effects => effects.clone(),
        },
        inputs: Field::Given(inputs),
        effort_limits: Field::Absent,
        control: Field::Absent,
        controller_model: Field::Absent,
        initial: Field::Absent,
        outputs: Field::Absent,
        integration: Field::Absent,
        ..spec.clone()
    }
}

/// Sets the value that a run-time parameter has in the model.
fn set_parameter(model: &mut Scene, raw: &Raw, faults: &mut Faults) {
    let name = &raw.name.value;
    let Some(at) = model.parameters.iter().position(|p| p.name == *name) else {
        let known: Vec<&str> = model.parameters.iter().map(|p| p.name.as_str()).collect();
        let fault = wording::unknown_parameter_of_controllers(&raw.name.location, name, &known);
        faults.push(fault);
        return;
    };
    let dimension = Dimension::measured_in(model.parameters[at].unit);
    if let Some(number) = raw.number(&[dimension], faults) {
        model.parameters[at].default = number.value.value;
    }
}

/// Returns what a model's layout has and the plant's has not, by kind and name: what a controller could not measure.
pub(in crate::scene) fn missing<'a>(
    model: &'a StateLayout,
    plant: &StateLayout,
) -> Vec<(&'static str, &'a str)> {
    let mut found = Vec::new();
    for own in &model.positions {
        let same =
            |p: &crate::layout::StatePosition| p.name == own.name && p.dimension == own.dimension;
        if !plant.positions.iter().any(same) {
            found.push(("position", own.name.as_str()));
        }
    }
    for own in &model.coordinates {
        let same = |c: &crate::layout::StateCoordinate| {
            c.rate_name == own.rate_name && c.dimensions == own.dimensions
        };
        if !plant.coordinates.iter().any(same) {
            found.push(("velocity", own.rate_name.as_str()));
        }
    }
    let parts = [
        ("state", &model.states, &plant.states),
        ("mode", &model.modes, &plant.modes),
        ("input", &model.inputs, &plant.inputs),
    ];
    for (what, own, plants) in parts {
        let absent = own
            .iter()
            .filter(|part| plants.iter().all(|other| other.name != part.name));
        found.extend(absent.map(|part| (what, part.name.as_str())));
    }
    found
}
