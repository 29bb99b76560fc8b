//! The model of a spec: its links and joints as they are identified.

use bgdyn_codegen::bond_graph;
use bgdyn_codegen::machine::Machine;
use bgdyn_codegen::mechanism::{Link, Mechanism, Value};
use bgdyn_identification::pseudo_inertia::{from_centre, transport};
use bgdyn_identification::{JointPart, LinkPart, Model};
use nalgebra::{Matrix3, Vector3};

use super::friction::{EffectNumber, effect_numbers, of_each_joint};
use super::rows::{GeneratedRows, Places};

/// What is to be identified.
#[derive(Clone, Debug, Default)]
pub(crate) struct Wanted {
    /// Links; all of them if there are none.
    pub(crate) only: Vec<String>,
    /// Which columns of joints.
    pub(crate) columns: [bool; 4],
}

/// A machine whose numbers can be identified.
pub(crate) struct IdentifiedMachine {
    rows: GeneratedRows,
    places: Places,
    /// Numbers of its effects.
    pub(crate) effects: Vec<EffectNumber>,
    /// Moving links without mass and tensor, which are kept so.
    pub(crate) massless: Vec<String>,
    links: Vec<LinkPart>,
    joints: Vec<JointPart>,
    columns: [bool; 4],
}

impl IdentifiedMachine {
    /// Returns the machine.
    ///
    /// # Errors
    /// All that hinders: joints of other types, unknown names, effects of several joints at once.
    pub(crate) fn new(machine: &Machine, wanted: &Wanted) -> Result<Self, Vec<String>> {
        let mechanism = &machine.mechanism;
        let graph = bond_graph::build(mechanism);
        let tree = GeneratedRows::new(mechanism, &graph).map_err(|what| {
            vec![format!("{what}: only trees of revolute, prismatic and helical joints can be identified; write a spec of such a part")]
        })?;
        let (rows, places) = tree;
        let effects = effect_numbers(&of_each_joint(machine));
        let mut found = IdentifiedMachine {
            rows,
            places,
            joints: joints(mechanism, &graph, &effects),
            effects,
            massless: Vec::new(),
            links: Vec::new(),
            columns: wanted.columns,
        };
        found.take_links(mechanism, wanted);
        let unknown = wanted
            .only
            .iter()
            .filter(|name| !found.links.iter().any(|l| &l.name == *name));
        let names: Vec<&str> = found.links.iter().map(|l| l.name.as_str()).collect();
        let faults: Vec<String> = unknown
            .map(|name| {
                format!(
                    "`--only {name}`: no moving link with a mass of this name: there are {}",
                    names.join(", ")
                )
            })
            .collect();
        match faults.is_empty() {
            true => Ok(found),
            false => Err(faults),
        }
    }

    fn take_links(&mut self, mechanism: &Mechanism, wanted: &Wanted) {
        for (link, place) in mechanism.links().iter().zip(&self.places) {
            let Some((body, rotation, translation)) = place else {
                continue;
            };
            let file = of_file(link, mechanism);
            if file.amax() == 0.0 {
                let own =
                    !link.hidden && rotation.is_identity(0.0) && *translation == Vector3::zeros();
                self.massless.extend(own.then(|| link.name.clone()));
                continue;
            }
            self.links.push(LinkPart {
                name: link.name.clone(),
                body: *body,
                in_body: transport(rotation, translation),
                file,
                free: wanted.only.is_empty() || wanted.only.contains(&link.name),
            });
        }
    }

    /// Returns the model.
    pub(crate) fn model(&self) -> Model<'_> {
        Model {
            rows: &self.rows,
            links: self.links.clone(),
            joints: self.joints.clone(),
            columns: self.columns,
        }
    }
}

fn joints(
    mechanism: &Mechanism,
    graph: &bond_graph::BondGraph,
    effects: &[EffectNumber],
) -> Vec<JointPart> {
    let of_link = |name: &str| mechanism.links().iter().find(|l| l.joint.name == name);
    let joints = graph.coordinates.iter();
    joints
        .map(|coordinate| {
            let limits = of_link(&coordinate.name)
                .map(|l| l.joint.limits)
                .unwrap_or_default();
            let mut file = [0.0; 4];
            for effect in effects.iter().filter(|e| e.joint == coordinate.name) {
                file[effect.column] += effect.value * effect.factor;
            }
            JointPart {
                name: coordinate.name.clone(),
                linear: coordinate.linear,
                range: [limits.lower, limits.upper],
                speed: limits.velocity,
                effort: limits.effort,
                file,
            }
        })
        .collect()
}

/// Returns the parameters of a link in the file, about its origin, link axes.
fn of_file(link: &Link, mechanism: &Mechanism) -> bgdyn_identification::model::Parameters {
    let number = |value: &Value| match value {
        Value::Fixed(x) => x.to_f64(),
        Value::Parameter(p) => mechanism.parameters()[p.0].default.to_f64(),
    };
    let c = Vector3::from(link.inertial.com.0.map(|x| number(&x)));
    let e = link.inertial.inertia.entries.map(|x| number(&x));
    let tensor = Matrix3::new(e[0], e[3], e[4], e[3], e[1], e[5], e[4], e[5], e[2]);
    let axes = Matrix3::from_fn(|i, j| link.inertial.inertia.axes.0[i][j].to_f64());
    from_centre(
        number(&link.inertial.mass),
        &c,
        &(axes * tensor * axes.transpose()),
    )
}
