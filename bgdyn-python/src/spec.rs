//! A mechanism that was read, with the functions that were prepared for it.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use bgdyn_codegen::bond_graph::{self, BondGraph};
use bgdyn_codegen::declaration::Declaration;
use bgdyn_codegen::engine::{Callable, Engine};
use bgdyn_codegen::expr::Operations;
use bgdyn_codegen::format::{Number, ParsedValue};
use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::method::{Argument, Method, PARAMETERS_PER_BODY};
use bgdyn_codegen::options::Options;
use bgdyn_codegen::plan::operational_pivot_names;
use bgdyn_codegen::selection;
use bgdyn_codegen::tape::Tape;
use bgdyn_runtime::Cause as Refused;

use crate::lanes::LaneCall;
use crate::parts::{Parts, Sizes};

/// A mechanism, without the values of its run-time parameters.
#[derive(Debug)]
pub struct Spec {
    /// Its text.
    pub text: String,
    /// Its name: the stem of its file.
    pub name: String,
    /// The checked mechanism.
    pub mechanism: Mechanism,
    /// Its bond graph.
    pub graph: BondGraph,
    /// The names of formulation and preference, as given.
    pub choice: (Option<String>, String),
    /// Options of the generator with this choice.
    pub options: Options,
    /// Its methods by their names.
    methods: HashMap<String, Method>,
    prepared: Mutex<HashMap<String, Arc<Prepared>>>,
}

/// A mechanism with the values of its run-time parameters.
#[derive(Clone, Debug)]
pub struct ModelData {
    /// The mechanism.
    pub spec: Arc<Spec>,
    /// The values, SI units.
    pub parameters: Arc<[f64]>,
}

/// A function that can be called.
#[derive(Debug)]
pub struct Prepared {
    /// The function.
    pub call: Box<dyn Callable>,
    /// The same for several states at once.
    pub lanes: LaneCall,
    /// The arrays of its result.
    pub parts: Parts,
    /// What it takes.
    pub operations: Operations,
    /// The formulation that it was made by.
    pub formulation: String,
}

/// The cause of a missing result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Cause {
    /// A joint without inertia.
    Joint(String),
    /// A loop at a singular position, or on another branch.
    Loop(String),
    /// A loop that is out of reach.
    OutOfReach(String),
    /// A joint that does not follow the actuated ones.
    NotActuated(String),
    /// A direction in which a frame cannot be accelerated.
    Posture(String),
}

impl ModelData {
    /// Returns the mechanism with these values of run-time parameters, SI units.
    ///
    /// # Errors
    /// A sentence about an unknown name, or a value that is NaN or infinite.
    pub fn with_parameters(&self, given: &[(String, f64)]) -> Result<ModelData, String> {
        let all = self.spec.mechanism.parameters();
        let mut values = self.parameters.to_vec();
        for (name, value) in given {
            let Some(found) = all.iter().position(|p| p.name == *name) else {
                if let Some(effect) = self.spec.effect_with(name) {
                    return Err(format!(
                        "`{name}` is no parameter of the mechanism: it belongs to its effect `{effect}`, which acts in scenes: see bgdyn.Scene"
                    ));
                }
                let known: Vec<&str> = all.iter().map(|p| p.name.as_str()).collect();
                return Err(match known.as_slice() {
                    [] => format!("no parameter `{name}`: the spec has none"),
                    known => format!("no parameter `{name}`; there are {}", known.join(", ")),
                });
            };
            if !value.is_finite() {
                return Err(format!("`{name}` is {value}"));
            }
            values[found] = *value;
        }
        Ok(ModelData {
            spec: Arc::clone(&self.spec),
            parameters: values.into(),
        })
    }

    /// Returns whether both compute the same from the same text.
    pub fn same(&self, other: &ModelData) -> bool {
        let (own, others) = (&self.spec, &other.spec);
        own.text == others.text
            && own.name == others.name
            && own.choice == others.choice
            && self.parameters == other.parameters
    }
}

impl Spec {
    /// Returns a checked mechanism with its bond graph.
    pub fn new(
        (text, name): (String, String),
        mechanism: Mechanism,
        choice: (Option<String>, String),
        options: Options,
    ) -> Self {
        let graph = bond_graph::build(&mechanism);
        let all = Method::possible_of(&graph).into_iter();
        let closed = graph.closed.as_deref();
        let methods = all.map(|method| (method.name_in(closed, &graph.sites), method));
        Spec {
            methods: methods.collect(),
            graph,
            prepared: Mutex::default(),
            text,
            name,
            mechanism,
            choice,
            options,
        }
    }

    /// Returns the name of the engine that computes methods.
    pub fn engine() -> &'static str {
        Tape.name()
    }

    /// Checks that the selected formulation serves the mechanism.
    ///
    /// # Errors
    /// A message with the joint that it does not serve.
    pub fn checked(&self) -> Result<(), String> {
        let checked = self.options.check_formulation(&self.graph);
        checked.map_err(|all| {
            all.iter()
                .map(ToString::to_string)
                .collect::<Vec<_>>()
                .join("; ")
        })
    }

    /// Returns the sizes that shapes depend on.
    pub fn sizes(&self) -> Sizes {
        let closed = self.graph.closed.as_deref();
        Sizes {
            nv: self.graph.coordinates.len(),
            nt: closed.map_or(0, |closed| closed.tree.coordinates.len()),
            nc: closed.map_or(0, |closed| closed.closure.rows.len()),
        }
    }

    /// Returns the names of the links, parents before children.
    pub fn link_names(&self) -> Vec<&str> {
        let links = self.mechanism.links().iter();
        let shown = links.filter(|link| !link.hidden);
        shown.map(|link| link.name.as_str()).collect()
    }

    /// Returns the names of the pairs that may touch.
    pub fn contact_names(&self) -> Vec<&str> {
        let pairs = self.mechanism.contact_pairs().iter();
        pairs.map(|pair| pair.name.as_str()).collect()
    }

    /// Returns the names of the loops and contacts.
    pub fn reaction_names(&self) -> Vec<&str> {
        let closed = self.graph.closed.iter();
        let loops = closed.flat_map(|closed| &closed.closure.loops);
        loops.map(|one| one.name.as_str()).collect()
    }

    /// Returns the effect in the file that has a run-time parameter with this name.
    fn effect_with(&self, parameter: &str) -> Option<String> {
        let (machine, _) = bgdyn_codegen::read_machine(&self.text, Some(&self.name));
        let named = |number: &Number| {
            number
                .parameter
                .as_ref()
                .is_some_and(|own| own.value == parameter)
        };
        let reads = |effect: &Declaration| {
            let keys = effect.effect.keys().iter();
            let mut values = keys.filter_map(|key| effect.fields.get(key));
            values.any(|entry| match &entry.value {
                ParsedValue::Number(number) => named(number),
                ParsedValue::Group(all) => all.iter().any(|(_, number)| named(&number.value)),
                _ => false,
            })
        };
        let found = machine?.effects.into_iter().find(reads)?;
        Some(found.name.value)
    }

    /// Returns the number of components of an argument.
    pub fn width(&self, argument: Argument) -> usize {
        match argument {
            Argument::Q => self.mechanism.nq(),
            Argument::TreeV | Argument::TreeTau => self.sizes().nt,
            Argument::ActuatedTau => self.mechanism.actuated_names().len(),
            Argument::BodyParameters => PARAMETERS_PER_BODY * self.graph.moving_links().len(),
            _ => self.sizes().nv,
        }
    }

    /// Returns the name of a method in this mechanism.
    pub fn name_of(&self, method: Method) -> String {
        method.name_in(self.graph.closed.as_deref(), &self.graph.sites)
    }

    /// Returns the method with this name.
    ///
    /// # Errors
    /// A sentence with the nearest name, or with all names.
    pub fn method(&self, name: &str) -> Result<Method, String> {
        match self.methods.get(name) {
            Some(method) => Ok(*method),
            None => Method::named(&self.graph, name),
        }
    }

    /// Returns a method's function: chosen and prepared at the first call, then kept.
    ///
    /// # Errors
    /// If the selected formulation does not compute it.
    pub fn prepared(&self, method: Method) -> Result<Arc<Prepared>, String> {
        let name = self.name_of(method);
        let kept = || self.prepared.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = kept().get(&name) {
            return Ok(Arc::clone(found));
        }
        let function = selection::function(&self.mechanism, method, &self.options)
            .ok_or_else(|| format!("the selected formulation does not compute `{name}`"))?;
        let call = Tape.prepare(&function);
        let made = Arc::new(Prepared {
            parts: Parts::of(method, self.sizes(), call.results()),
            lanes: LaneCall::new(&function),
            operations: function.operations(),
            formulation: function.formulation.clone(),
            call,
        });
        // Another thread may have made the same.
        Ok(Arc::clone(kept().entry(name).or_insert(made)))
    }

    /// Returns what a refused pivot of this method means.
    pub fn cause(&self, method: Method, pivot: usize) -> Cause {
        let names = |all: &[bond_graph::Coordinate], i: usize| {
            all.get(i).map_or_else(String::new, |c| c.name.clone())
        };
        let own = &self.graph.coordinates;
        let closed = self.graph.closed.as_deref();
        let rates = match (method.of_tree(), closed) {
            (true, Some(closed)) => &closed.tree.coordinates,
            _ => own,
        };
        let joints = match method {
            Method::ActuatedInverse(number) => number,
            _ => rates.len(),
        };
        let loops = closed.map_or(&[][..], |closed| &closed.closure.loops);
        let named = |k: usize| loops.get(k).map_or_else(String::new, |l| l.name.clone());
        match Refused::of_pivot(pivot, joints) {
            (Refused::Pivot, k) => Cause::Joint(names(rates, k)),
            (Refused::Actuators, k) => Cause::NotActuated(names(own, k - joints - loops.len())),
            (Refused::Posture, k) => {
                let all = operational_pivot_names(closed, &self.graph);
                Cause::Posture(
                    all.get(k)
                        .map_or_else(String::new, |name| (*name).to_owned()),
                )
            }
            (Refused::OutOfReach, k) => Cause::OutOfReach(named(k - joints)),
            (_, k) => Cause::Loop(named(k - joints)),
        }
    }
}
