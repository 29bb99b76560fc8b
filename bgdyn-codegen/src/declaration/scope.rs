//! The names that effects may refer to, and the names that effects define.

use super::{Declaration, EffectKind, RejectedEffects};
use crate::fault::{Faults, wording};
use crate::format::Key;
use crate::mechanism::{
    CoordinateId, Coupling, DependentVelocity, Joint, Limits, LinkId, Mechanism, Motion,
    SiteOrigins,
};

/// The names that an effect may refer to.
#[derive(Clone, Debug, Default)]
pub struct NameScope {
    /// Moving joints and the coordinates that effects add, with their motions.
    pub coordinates: Vec<(String, Motion)>,
    /// Velocities that are not the rate of a position, with their joint's type.
    pub quasi_velocities: Vec<(String, &'static str)>,
    /// Joints that follow others, with the names of those, and their motions.
    pub followers: Vec<(String, Vec<String>, Motion)>,
    /// Joints whose velocities follow from others through loops, with their motions.
    pub dependents: Vec<(String, Motion)>,
    /// Limits of the joints that have limits.
    pub limits: Vec<(String, Limits)>,
    /// Names of the coordinates that are no joints.
    pub added: Vec<String>,
    /// Joints that a scene locks.
    pub locked: Vec<String>,
    /// Joints whose motion is prescribed.
    pub prescribed: Vec<String>,
    /// Links and frames.
    pub(crate) sites: SiteOrigins,
    /// Contacts.
    pub contacts: Vec<String>,
    /// Hydraulic nodes.
    pub nodes: Vec<String>,
    /// The names that refused effects may have defined.
    pub refused: RejectedEffects,
}

impl NameScope {
    /// Returns the names of a mechanism; `locked` are joints that a scene locks.
    pub fn of(mechanism: &Mechanism, locked: Vec<String>) -> NameScope {
        let names = mechanism.joint_names();
        let motion = |linear: bool| match linear {
            true => Motion::Translation,
            false => Motion::Rotation,
        };
        let coordinate =
            |(j, name): (usize, &String)| (name.clone(), motion(mechanism.linear(CoordinateId(j))));
        let kind = |(j, name): (usize, &String)| {
            let joint = mechanism.joint(CoordinateId(j));
            let quasi = mechanism.is_quasi_velocity(CoordinateId(j));
            quasi.then(|| (name.clone(), joint.kind.keyword))
        };
        let follower = |(joint, coupling, linear): (&Joint, &Coupling, bool)| {
            (
                joint.name.clone(),
                mechanism.leaders(coupling),
                motion(linear),
            )
        };
        let joints = || mechanism.links().iter().map(|link| &link.joint);
        let limits = |&link: &LinkId| {
            let joint = &mechanism.links()[link.0].joint;
            (joint.name.clone(), joint.limits)
        };
        let of_loops = || joints().filter(|joint| !joint.degrees.dependent.is_empty());
        let dependents = mechanism.dependent_velocities();
        let of_followers = mechanism.followers();
        let of_followers = of_followers.map(|(joint, ..)| (joint.name.clone(), joint.limits));
        let quasi = |own: &DependentVelocity| (own.name.clone(), own.kind);
        NameScope {
            coordinates: names.iter().enumerate().map(coordinate).collect(),
            quasi_velocities: (names.iter().enumerate().filter_map(kind))
                .chain(
                    dependents
                        .iter()
                        .filter(|own| own.position.is_none())
                        .map(quasi),
                )
                .collect(),
            followers: mechanism.followers().map(follower).collect(),
            dependents: (dependents.iter())
                .map(|own| (own.name.clone(), motion(own.linear)))
                .collect(),
            limits: (mechanism.coordinates().iter().map(limits))
                .chain(of_followers)
                .chain(of_loops().map(|joint| (joint.name.clone(), joint.limits)))
                .collect(),
            added: Vec::new(),
            locked,
            prescribed: mechanism.prescribed_names(),
            sites: SiteOrigins::new(mechanism),
            contacts: contact_names(mechanism),
            nodes: Vec::new(),
            refused: RejectedEffects::default(),
        }
    }

    /// Returns the names with those that these effects add.
    pub fn with<'a>(mut self, declared: impl Iterator<Item = &'a Declaration> + Clone) -> Self {
        for d in declared.clone().filter(|d| d.effect.adds_coordinate()) {
            let on = d.joint().and_then(|joint| self.motion_of(joint));
            let motion = on.unwrap_or(Motion::Rotation);
            self.coordinates.push((d.name.value.clone(), motion));
            self.added.push(d.name.value.clone());
        }
        self.nodes.extend(declared.flat_map(Declaration::nodes));
        self
    }

    /// Returns the default of a missing key of an effect from the limits of its joint.
    pub(super) fn limit_for(
        &self,
        effect: &dyn EffectKind,
        joint: Option<&str>,
        key: &Key,
    ) -> Option<f64> {
        let (_, limits) = self
            .limits
            .iter()
            .find(|(name, _)| Some(name.as_str()) == joint)?;
        effect.limit_for(key, limits)
    }

    pub(super) fn motion_of(&self, coordinate: &str) -> Option<Motion> {
        let found = self.coordinates.iter().find(|(name, _)| name == coordinate);
        let mut followers = self.followers.iter();
        let follower = followers.find(|(name, ..)| name == coordinate);
        let mut dependents = self.dependents.iter();
        let dependent = dependents.find(|(name, _)| name == coordinate);
        let own = found.or(dependent).map(|(_, motion)| *motion);
        own.or(follower.map(|(.., motion)| *motion))
    }
}

/// Returns the names of the entries of `contacts`, and those of the contacts of each with several.
fn contact_names(mechanism: &Mechanism) -> Vec<String> {
    let pairs = mechanism.contact_pairs();
    let mut names: Vec<String> = pairs.iter().map(|pair| pair.entry.clone()).collect();
    names.dedup();
    let several = pairs.iter().filter(|pair| pair.name != pair.entry);
    names.extend(several.map(|pair| pair.name.clone()));
    names
}

/// Checks that the names of effects and of their nodes are unique and not those of joints, because they
/// are names of parts of the state.
pub(crate) fn check_unique_names(all: &[Declaration], mechanism: &Mechanism, faults: &mut Faults) {
    let joints = mechanism.links().iter().map(|l| &l.joint.name);
    let bodies = mechanism.links().iter().map(|l| &l.name);
    let frames = mechanism.frames().iter().map(|f| &f.name);
    let known: Vec<&String> = joints.chain(bodies).chain(frames).collect();
    let own = |declared: &Declaration| {
        let mut own = declared.nodes();
        own.push(declared.name.value.clone());
        own.sort();
        own.dedup();
        own
    };
    for (i, declared) in all.iter().enumerate() {
        let location = &declared.name.location;
        for name in own(declared) {
            if known.contains(&&name) {
                faults.push(wording::effect_has_name_of_body(location, &name));
            }
            let other = all[..i].iter().find(|other| own(other).contains(&name));
            if let Some(other) = other.filter(|other| other.name.value != declared.name.value) {
                let other = &other.name.value;
                faults.push(wording::effect_has_name_of_effect(location, &name, other));
            }
        }
    }
}
