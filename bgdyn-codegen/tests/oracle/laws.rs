//! The law of each effect, as on its page: one small function each.

use bgdyn_runtime::Dd;
use serde_yaml::Value;

use super::contact_law;
use super::hydraulics;
use super::mechanism::{line, seen};
use super::state::{At, Sums};
use super::vector::{ZERO, add, apply, dd, norm, scale};
use super::yaml::{list, number, number_or, text};

/// An effect of a scene.
#[derive(Clone, Debug)]
pub struct Effect {
    pub name: String,
    pub keys: Value,
}

impl Effect {
    pub fn kind(&self) -> &str {
        self.text("type")
    }

    pub fn text(&self, key: &str) -> &str {
        text(&self.keys, key).unwrap_or_else(|| panic!("{} has no {key}", self.name))
    }

    pub fn has(&self, key: &str) -> bool {
        self.keys.get(key).is_some()
    }

    pub fn number(&self, key: &str) -> Dd {
        number(&self.keys[key])
    }

    pub fn or(&self, key: &str, otherwise: f64) -> Dd {
        number_or(&self.keys, key, otherwise)
    }

    /// Returns the name of the mode of its gear, if it has one with losses.
    pub fn gear_mode(&self) -> Option<String> {
        match self.kind() {
            "gear" => Some(self.name.clone()),
            "dc_motor" if self.has("efficiency") => Some(format!("{}_gear", self.name)),
            _ => None,
        }
    }

    fn joint(&self) -> &str {
        self.text("joint")
    }

    /// An input that belongs to the moving counterpart; 0 without one.
    fn reference(&self, at: &At<'_>, suffix: &str) -> Dd {
        text(&self.keys, "reference").map_or(Dd::ZERO, |r| at.input(&format!("{r}{suffix}")))
    }

    fn slip(&self, at: &At<'_>) -> Dd {
        at.v(self.joint()) - self.reference(at, "_rate")
    }
}

/// Adds the law of an effect. Rotors and payloads belong to the mechanism, gears to the inputs.
pub fn law(e: &Effect, at: &At<'_>, sums: &mut Sums) {
    match e.kind() {
        "viscous" => sums.push(e.joint(), -(e.number("damping") * e.slip(at))),
        "coulomb" => coulomb(e, at, sums),
        "coulomb_smooth" => {
            let share = (e.slip(at) / e.number("width")).tanh();
            sums.push(e.joint(), -(e.number("kinetic") * share));
        }
        "stribeck" => stribeck(e, at, sums),
        "lugre" => lugre(e, at, sums),
        "spring" => spring(e, at, sums),
        "damper" => damper(e, at, sums),
        "stop" => stop(e, at, sums),
        "series_elastic" => series_elastic(e, at, sums),
        "dc_motor" => dc_motor(e, at, sums),
        "wrench" => wrench(e, at, sums),
        "drag" => drag(e, at, sums),
        "compliant_contact" => contact_law::law(e, at, sums),
        "gear" | "rotor" | "payload" => {}
        _ => hydraulics::law(e, at, sums),
    }
}

/// −1, 0 or 1.
pub fn sign(x: Dd) -> Dd {
    let one = |yes: bool| if yes { Dd::ONE } else { Dd::ZERO };
    one(x > Dd::ZERO) - one(x < Dd::ZERO)
}

fn squared(x: Dd) -> Dd {
    x * x
}

/// Held, or −F_k sgn s.
fn coulomb(e: &Effect, at: &At<'_>, sums: &mut Sums) {
    if at.state.modes[&e.name] == Dd::ZERO {
        sums.held
            .insert(e.joint().into(), e.reference(at, "_acceleration"));
    } else {
        sums.push(e.joint(), -(e.number("kinetic") * sign(e.slip(at))));
    }
}

/// −[F_c + (F_s − F_c) exp(−(s/v_s)²)] tanh(s/w) − b s
fn stribeck(e: &Effect, at: &At<'_>, sums: &mut Sums) {
    let s = e.slip(at);
    let (kinetic, fixed) = (e.number("kinetic"), e.number("static"));
    let curve = (-squared(s / e.number("stribeck_speed"))).exp();
    let size = kinetic + (fixed - kinetic) * curve;
    let effort = size * (s / e.number("width")).tanh() + e.or("damping", 0.0) * s;
    sums.push(e.joint(), -effort);
}

/// −(σ₀ z + σ₁ ż + σ₂ s), ż = s − σ₀ |s| z/g(s)
fn lugre(e: &Effect, at: &At<'_>, sums: &mut Sums) {
    let (s, z, stiffness) = (e.slip(at), at.state.x[&e.name], e.number("stiffness"));
    let kinetic = e.number("kinetic");
    let limit = if e.has("static") {
        let curve = (-squared(s / e.number("stribeck_speed"))).exp();
        kinetic + (e.number("static") - kinetic) * curve
    } else {
        kinetic
    };
    let rate = s - stiffness * s.abs() * z / limit;
    let effort = stiffness * z + e.or("damping", 0.0) * rate + e.or("viscous", 0.0) * s;
    sums.push(e.joint(), -effort);
    sums.rates.insert(e.name.clone(), rate);
    sums.stored += stiffness * z * z * dd(0.5);
}

/// Adds an effort along a joint's coordinate, or between two sites, where positive pushes them apart.
pub fn act(e: &Effect, at: &At<'_>, sums: &mut Sums, effort: Dd) {
    match e.keys.get("between") {
        None => sums.push(e.joint(), effort),
        Some(ends) => {
            let [a, b] = [0, 1].map(|k| at.place(list(ends)[k].as_str().expect("a name")));
            let (unit, ..) = line(a, b, at.motions);
            sums.wrench(at, b, scale(unit, effort), ZERO);
            sums.wrench(at, a, scale(unit, -effort), ZERO);
        }
    }
}

/// Returns the coordinate that an effect acts along, and its rate.
pub fn stretch(e: &Effect, at: &At<'_>) -> (Dd, Dd) {
    match e.keys.get("between") {
        None => (at.q(e.joint()), at.v(e.joint())),
        Some(ends) => {
            let [a, b] = [0, 1].map(|k| at.place(list(ends)[k].as_str().expect("a name")));
            let (_, length, rate) = line(a, b, at.motions);
            (length, rate)
        }
    }
}

/// f = −k (s − r − s₀) − f₀
fn spring(e: &Effect, at: &At<'_>, sums: &mut Sums) {
    let (s, _) = stretch(e, at);
    let (stiffness, preload) = (e.number("stiffness"), e.or("preload", 0.0));
    let off = s - e.reference(at, "") - e.or("rest", 0.0);
    act(e, at, sums, -(stiffness * off + preload));
    sums.stored += stiffness * off * off * dd(0.5) + preload * off;
}

/// f = −b (ṡ − ṙ)
fn damper(e: &Effect, at: &At<'_>, sums: &mut Sums) {
    let (_, rate) = stretch(e, at);
    let effort = e.number("damping") * (rate - e.reference(at, "_rate"));
    act(e, at, sums, -effort);
}

/// Pushed back with k δ (1 + μ δ̇) ≥ 0 at the depth δ beyond an end.
fn stop(e: &Effect, at: &At<'_>, sums: &mut Sums) {
    let (q, rate, stiffness) = (at.q(e.joint()), at.v(e.joint()), e.number("stiffness"));
    let mu = loss(e.number("restitution")) / e.number("impact_speed");
    for (key, outwards) in [("upper", Dd::ONE), ("lower", -Dd::ONE)] {
        let depth = (q - e.number(key)) * outwards;
        if depth > Dd::ZERO {
            let push = stiffness * depth * (Dd::ONE + mu * rate * outwards);
            sums.push(e.joint(), -(push.max(Dd::ZERO) * outwards));
            sums.stored += stiffness * depth * depth * dd(0.5);
        }
    }
}

/// Returns the nonzero y of (1 + e) y = ln((1 + y)/(1 − e y)), by bisection of 0 … 1/e and then by Newton
/// steps.
pub fn loss(e: Dd) -> Dd {
    if e == Dd::ONE {
        return Dd::ZERO;
    }
    // Negative between the root at 0 and the nonzero one.
    let off = |y: Dd| ((Dd::ONE + y) / (Dd::ONE - e * y)).ln() - (Dd::ONE + e) * y;
    let (mut low, mut high) = (dd(1e-6), Dd::ONE / e);
    for _ in 0..80 {
        let middle = (low + high) * dd(0.5);
        if off(middle) > Dd::ZERO {
            high = middle;
        } else {
            low = middle;
        }
    }
    let mut y = low;
    for _ in 0..3 {
        let slope = Dd::ONE / (Dd::ONE + y) + e / (Dd::ONE - e * y) - Dd::ONE - e;
        y -= off(y) / slope;
    }
    y
}

/// N²J θ̈ = τ_m − τ, τ = K (θ − q) + D (θ̇ − q̇) on the joint
fn series_elastic(e: &Effect, at: &At<'_>, sums: &mut Sums) {
    let (twist, rate) = (
        at.q(&e.name) - at.q(e.joint()),
        at.v(&e.name) - at.v(e.joint()),
    );
    let effort = e.number("stiffness") * twist + e.or("damping", 0.0) * rate;
    sums.push(e.joint(), effort);
    sums.push(&e.name, -effort);
    let inertia = squared(e.or("ratio", 1.0)) * e.number("inertia");
    sums.inertia.insert(e.name.clone(), inertia);
    sums.stored += e.number("stiffness") * twist * twist * dd(0.5);
}

/// Returns the effort behind a gear: η τ if the effort drives, τ/η if the joint drives it, τ at rest.
pub fn geared(e: &Effect, effort: Dd, at: &At<'_>, sums: &mut Sums) -> Dd {
    let Some(mode) = e.gear_mode().map(|name| at.state.modes[&name]) else {
        return effort;
    };
    if mode == Dd::ZERO {
        let still = sums.held.entry(e.joint().into());
        still.or_insert(Dd::ZERO);
        effort
    } else if effort * mode >= Dd::ZERO {
        e.number("efficiency") * effort
    } else {
        effort / e.number("efficiency")
    }
}

/// Limits the size, if there is a limit.
fn within(x: Dd, e: &Effect, key: &str) -> Dd {
    if e.has(key) {
        x.max(-e.number(key)).min(e.number(key))
    } else {
        x
    }
}

/// L di/dt + R i + k N q̇ = u, τ = k N i
fn dc_motor(e: &Effect, at: &At<'_>, sums: &mut Sums) {
    let rate = at.v(e.joint());
    let (constant, resistance) = (
        e.number("torque_constant") * e.or("ratio", 1.0),
        e.number("resistance"),
    );
    let left = within(at.input(&e.name), e, "voltage_limit") - constant * rate;
    let current = if e.has("inductance") {
        let (current, inductance) = (at.v(&e.name), e.number("inductance"));
        let mut net = left - resistance * current;
        if e.has("current_limit") {
            let (limit, outwards) = (e.number("current_limit"), sign(current));
            let drop = resistance * limit * outwards;
            // Held at its limit, or returned from beyond it.
            if current.abs() == limit {
                net = Dd::ZERO;
            } else if current.abs() > limit && (left - drop) * outwards > Dd::ZERO {
                net = drop - resistance * current;
            }
        }
        sums.push(&e.name, net);
        sums.inertia.insert(e.name.clone(), inductance);
        current
    } else {
        within(left / resistance, e, "current_limit")
    };
    let arrives = geared(e, constant * current, at, sums);
    sums.push(e.joint(), arrives);
}

/// Adds a moment and a force at a site, in its axes or the world's.
fn wrench(e: &Effect, at: &At<'_>, sums: &mut Sums) {
    let place = at.place(e.text("at"));
    let input = |part: &str| {
        let asked = e
            .keys
            .get("components")
            .is_none_or(|c| list(c).iter().any(|c| c.as_str() == Some(part)));
        if asked {
            at.input(&format!("{}_{part}", e.name))
        } else {
            Dd::ZERO
        }
    };
    let mut moment = ["mx", "my", "mz"].map(input);
    let mut force = ["fx", "fy", "fz"].map(input);
    if text(&e.keys, "axes") == Some("link") {
        let (_, axes, _) = seen(place, at.motions);
        (moment, force) = (apply(axes, moment), apply(axes, force));
    }
    sums.wrench(at, place, force, moment);
}

/// f = −(c₁ + c₂ |v|) v, m = −c_ω ω
fn drag(e: &Effect, at: &At<'_>, sums: &mut Sums) {
    let place = at.place(e.text("at"));
    let velocity = at.velocity(place);
    let per_speed = e.or("linear", 0.0) + e.or("quadratic", 0.0) * norm(velocity);
    let (_, _, carrier) = seen(place, at.motions);
    let moment = scale(carrier.turning, -e.or("angular", 0.0));
    sums.wrench(at, place, add(ZERO, scale(velocity, -per_speed)), moment);
}
