//! Options of the generator: methods, frames, formulation.

use std::collections::BTreeSet;
use std::fmt;

use crate::bond_graph::{Site, SiteId};
pub use crate::choice::Preference;
use crate::fault::unknown_name;
use crate::formulation::{self, FORMULATIONS, Formulation};
use crate::method::Method;

/// Velocities beyond which the Coriolis matrix comes only to those who name it: its code grows with
/// the square of their number.
const COMPACT: usize = 16;

/// Stands in [`Options::methods`] for the methods of the trait `Dynamics`.
pub const DYNAMICS: &str = "dynamics";

/// What the caller asks for. Where nothing is asked for: every method of the trait `Dynamics`, the
/// Coriolis matrix of mechanisms with up to 16 velocities, and the four methods of each named frame
/// and tip.
#[derive(Clone, Debug)]
pub struct Options {
    /// The formulation to use for every method; the cheapest of each where `None`.
    pub formulation: Option<&'static dyn Formulation>,
    /// What to choose by among the formulations, where there is a choice.
    pub prefer: Preference,
    /// Whether first derivatives of inverse and forward dynamics are wanted.
    pub derivatives: bool,
    /// Whether the Jacobian of a scene's rates is wanted, where its method of integration does not
    /// ask for it already.
    pub jacobian: bool,
    /// Whether the canonical form of a scene is wanted, likewise.
    pub canonical: bool,
    /// The methods wanted, by name: `inverse_dynamics`, `pose_tool`; `dynamics` stands for all that
    /// the trait `Dynamics` has.
    pub methods: Option<Vec<String>>,
    /// The links and frames whose pose, velocity, Jacobian and J̇ v are wanted. Where `None`, none
    /// if methods are asked for by name, else the named frames and the tips.
    pub frames: Option<Vec<String>>,
    /// Whether the generated functions are compared with equation (6) before they are written out:
    /// [`crate::verify`].
    pub verify: bool,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            formulation: None,
            prefer: Preference::default(),
            derivatives: false,
            jacobian: false,
            canonical: false,
            methods: None,
            frames: None,
            verify: true,
        }
    }
}

/// An option that may ask for what there is not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// [`Options::methods`]
    Methods,
    /// [`Options::frames`]
    Frames,
    /// An option as such, by its name.
    Whole(&'static str),
}

/// Something asked for that the mechanism or the scene does not have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unknown {
    /// The option that asks for it.
    pub option: Asked,
    /// Its place in the option's list.
    pub index: usize,
    /// What is wrong, and the way out.
    pub message: String,
}

impl fmt::Display for Unknown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl Options {
    /// The methods to generate, in the module's order.
    ///
    /// # Errors
    /// Every name that the mechanism does not have.
    pub fn select(&self, sites: &[Site], velocities: usize) -> Result<Vec<Method>, Vec<Unknown>> {
        let mut unknown = self.of_scenes();
        let mut wanted = BTreeSet::new();
        match &self.methods {
            None => wanted.extend(usual(velocities)),
            Some(names) => wanted.extend(methods(names, sites, &mut unknown)),
        }
        match &self.frames {
            Some(names) => wanted.extend(frames(names, sites, &mut unknown)),
            None if self.methods.is_none() => {
                let prominent = (0..sites.len()).filter(|&i| sites[i].prominent);
                wanted.extend(prominent.flat_map(|i| Method::of_site(SiteId(i))));
            }
            None => {}
        }
        if self.derivatives {
            wanted.insert(Method::InverseDynamicsDerivatives);
            wanted.insert(Method::ForwardDynamicsDerivatives);
        }
        if unknown.is_empty() {
            let all = Method::possible(sites).into_iter();
            Ok(all.filter(|m| wanted.contains(m)).collect())
        } else {
            Err(unknown)
        }
    }
}

impl Options {
    /// What only scenes have.
    fn of_scenes(&self) -> Vec<Unknown> {
        let asked = [
            (self.jacobian, "jacobian", "derivatives"),
            (self.canonical, "canonical", "mass_matrix"),
        ];
        let asked = asked.into_iter().filter(|(wanted, ..)| *wanted);
        let unknown = asked.map(|(_, name, instead)| {
            let way = format!("this is a mechanism: see `{instead}`, or write a scene");
            Unknown::whole(name, format!("`{name}` is of scenes, and {way}"))
        });
        unknown.collect()
    }

    /// What is asked for that only mechanisms have, where a scene is generated.
    pub fn of_mechanisms(&self) -> Vec<Unknown> {
        let asked = [
            (self.methods.is_some(), "methods", "a scene has its own"),
            (self.frames.is_some(), "frames", "see the key `outputs`"),
            (self.derivatives, "derivatives", "see `jacobian`"),
            (
                self.formulation.is_some(),
                "formulation",
                "a scene's functions are chosen by what they cost",
            ),
            (
                self.prefer != Preference::Operations,
                "prefer",
                "a scene's functions are chosen by what they cost",
            ),
        ];
        let asked = asked.into_iter().filter(|(wanted, ..)| *wanted);
        let unknown = asked.map(|(_, name, instead)| {
            let message = format!("`{name}` is of mechanisms, and this is a scene: {instead}");
            Unknown::whole(name, message)
        });
        unknown.collect()
    }
}

impl Unknown {
    /// An option that has no place here.
    fn whole(name: &'static str, message: String) -> Self {
        Unknown {
            option: Asked::Whole(name),
            index: 0,
            message,
        }
    }
}

fn usual(velocities: usize) -> Vec<Method> {
    let coriolis = (velocities <= COMPACT).then_some(Method::CoriolisMatrix);
    Method::OF_TRAIT.into_iter().chain(coriolis).collect()
}

fn methods(names: &[String], sites: &[Site], unknown: &mut Vec<Unknown>) -> Vec<Method> {
    let mut wanted = Vec::new();
    for (index, name) in names.iter().enumerate() {
        if name == DYNAMICS {
            wanted.extend(Method::OF_TRAIT);
            continue;
        }
        match Method::named(sites, name) {
            Ok(method) => wanted.push(method),
            Err(message) => unknown.push(Unknown {
                option: Asked::Methods,
                index,
                message,
            }),
        }
    }
    wanted
}

fn frames(names: &[String], sites: &[Site], unknown: &mut Vec<Unknown>) -> Vec<Method> {
    let mut wanted = Vec::new();
    for (index, name) in names.iter().enumerate() {
        if let Some(i) = sites.iter().position(|s| s.name == *name) {
            wanted.extend(Method::of_site(SiteId(i)));
            continue;
        }
        let known: Vec<&str> = sites.iter().map(|s| s.name.as_str()).collect();
        unknown.push(Unknown {
            option: Asked::Frames,
            index,
            message: unknown_name("link or frame", name, &known, &known.join(", ")),
        });
    }
    wanted
}

/// The formulation with this name.
///
/// # Errors
/// A sentence that names those there are.
pub fn formulation_named(name: &str) -> Result<&'static dyn Formulation, String> {
    let known: Vec<&str> = FORMULATIONS.iter().map(|f| f.name()).collect();
    formulation::by_name(name)
        .ok_or_else(|| unknown_name("formulation", name, &known, &known.join(", ")))
}

/// The preference with this name.
///
/// # Errors
/// A sentence that names those there are.
pub fn preference_named(name: &str) -> Result<Preference, String> {
    let known = Preference::ALL.map(Preference::name);
    let found = Preference::ALL.into_iter().find(|p| p.name() == name);
    found.ok_or_else(|| unknown_name("preference", name, &known, &known.join(", ")))
}
