//! The effects that a scene can include besides the links: one file per effect, one line each in [`EFFECTS`].
//!
//! An effect is an element of the bond graph. Its file defines the meaning of its keys, its additions to
//! the state ([`EffectKind::declare`]), and its constitutive law ([`Effect::law`]): efforts on junctions,
//! rates of states, and the power that it supplies, stores and dissipates.

mod hunt_crossley;
mod keys;
mod law;
mod nodes;
mod slip;

mod contact;
mod coulomb;
mod coulomb_smooth;
mod damper;
mod dc_motor;
mod drag;
mod gear;
mod gravity;
mod hydraulic;
mod inertia;
mod lugre;
mod orientation_spring;
mod payload;
mod rotor;
mod series_elastic;
mod spring;
mod stop;
mod stribeck;
mod velocity_products;
mod viscous;
mod wrench;

use crate::declaration::{EffectKind, EffectKinds, Element};
pub use law::Effect;

/// All effects.
pub static EFFECTS: [&dyn Effect; 30] = [
    &gravity::Gravity,
    &inertia::LinkInertia,
    &velocity_products::VelocityProducts,
    &viscous::Viscous,
    &coulomb::Coulomb,
    &coulomb_smooth::CoulombSmooth,
    &stribeck::Stribeck,
    &lugre::LuGre,
    &spring::Spring,
    &orientation_spring::OrientationSpring,
    &damper::Damper,
    &stop::Stop,
    &contact::CompliantContact,
    &contact::RigidContact,
    &series_elastic::SeriesElastic,
    &gear::GearEffect,
    &rotor::RotorEffect,
    &dc_motor::DcMotor,
    &hydraulic::Fluid,
    &hydraulic::Supply,
    &hydraulic::Tank,
    &hydraulic::Line,
    &hydraulic::JunctionEffect,
    &hydraulic::Cylinder,
    &hydraulic::Orifice,
    &hydraulic::Leakage,
    &hydraulic::FourWayValve,
    &wrench::WrenchEffect,
    &drag::Drag,
    &payload::Payload,
];

/// Returns their declarations.
pub fn kinds() -> EffectKinds {
    EffectKinds::new(EFFECTS.into_iter().map(|effect| effect as &dyn EffectKind))
}

/// Returns the effect of an element.
pub fn of(element: &Element) -> &'static dyn Effect {
    let keyword = element.effect.keyword();
    let found = EFFECTS.into_iter().find(|e| e.keyword() == keyword);
    found.expect("elements are of the list's kinds")
}
