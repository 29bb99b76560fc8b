//! The law of a compliant contact, as on its page.

use bgdyn_runtime::Dd;
use serde_yaml::Value;

use super::contact::{Contact, Meeting, Partner};
use super::laws::{Effect, loss};
use super::mechanism::{Mechanism, Wrench};
use super::scene::Scene;
use super::state::{At, Sums};
use super::vector::{V3, ZERO, add, dd, dot, norm, scale, sub};

/// What a contact does: its outputs, and its entry of the balance of power.
#[derive(Clone, Copy, Debug)]
pub struct Reading {
    pub gap: Dd,
    /// λ, and what the bristles add to it.
    pub normal: Dd,
    /// Along x and y of the plane.
    pub friction: [Dd; 2],
    /// The size of the friction.
    pub rubbing: Dd,
    pub slip: Dd,
    pub stored: Dd,
    pub stored_rate: Dd,
    pub dissipated: Dd,
    /// 1 + (3/2) d δ̇: the force pushes where it is positive.
    pub pushes: Dd,
    /// z·γ_t: the slip turns against the bristles where it is negative.
    pub with_bristles: Dd,
}

/// Friction at a contact.
struct Friction {
    force: V3,
    /// Force along the normal because bristles store energy.
    lift: Dd,
    stored: Dd,
    stored_rate: Dd,
    along: Dd,
}

/// δ = max(0, −g), λ = k δ^{3/2} (1 + (3/2) d δ̇) ≥ 0; stored (2/5) k δ^{5/2}.
pub fn law(e: &Effect, at: &At<'_>, sums: &mut Sums) {
    let contact = at.mechanism.contact(e.text("contact"));
    let meeting = contact.meeting(at.motions);
    let (n, stiffness) = (meeting.normal, e.number("stiffness"));
    let away = dot(n, meeting.velocity);
    let along = sub(meeting.velocity, scale(n, away));
    let depth = (-meeting.gap).max(Dd::ZERO);
    let elastic = stiffness * depth * depth.sqrt();
    let pushes = Dd::ONE - dd(1.5) * damping(e) * away;
    let pressed = (elastic * pushes).max(Dd::ZERO);
    let rubs = friction(e, at, &meeting, (depth, elastic, pressed), along, sums);
    let force = add(scale(n, pressed + rubs.lift), rubs.force);
    let bodies = [contact.centre.body, contact.partner_body()];
    for (body, sign) in bodies.into_iter().zip([1.0, -1.0]) {
        if let Some(body) = body {
            sums.wrenches.push(Wrench {
                body,
                at: meeting.at,
                force: scale(force, dd(sign)),
                moment: ZERO,
            });
        }
    }
    let stored = dd(2.0) / dd(5.0) * elastic * depth + rubs.stored;
    let stored_rate = rubs.stored_rate - elastic * away;
    sums.stored += stored;
    let reading = Reading {
        gap: meeting.gap,
        normal: pressed + rubs.lift,
        friction: meeting.axes.map(|axis| dot(axis, rubs.force)),
        rubbing: norm(rubs.force),
        slip: norm(along),
        stored,
        stored_rate,
        // What the force takes from the bodies, less what is stored.
        dissipated: -dot(force, meeting.velocity) - stored_rate,
        pushes,
        with_bristles: rubs.along,
    };
    sums.contacts.insert(e.name.clone(), reading);
}

/// d, or (2/3) y/v₀ with (1 + e) y = ln((1 + y)/(1 − e y)).
fn damping(e: &Effect) -> Dd {
    if e.has("restitution") {
        loss(e.number("restitution")) / (dd(1.5) * e.number("impact_speed"))
    } else {
        e.or("damping", 0.0)
    }
}

/// μ = μ_k + (μ_s − μ_k) exp(−|γ_t|²/v_s²)
fn coefficient(e: &Effect, along: V3) -> Dd {
    let kinetic = e.number("kinetic");
    if !e.has("static") {
        return kinetic;
    }
    let speed = e.number("stribeck_speed");
    let curve = (-(dot(along, along) / (speed * speed))).exp();
    kinetic + (e.number("static") - kinetic) * curve
}

/// Smooth: −μ λ γ_t/√(|γ_t|² + w²). Otherwise by bristles.
fn friction(
    e: &Effect,
    at: &At<'_>,
    meeting: &Meeting,
    normal: (Dd, Dd, Dd),
    along: V3,
    sums: &mut Sums,
) -> Friction {
    let mut force = ZERO;
    if e.has("bristles") {
        return bristles(e, at, meeting, normal, along, sums);
    }
    if e.has("width") {
        let width = e.number("width");
        let root = (dot(along, along) + width * width).sqrt();
        force = scale(along, -(coefficient(e, along) * normal.2 / root));
    }
    Friction {
        force,
        lift: Dd::ZERO,
        stored: Dd::ZERO,
        stored_rate: Dd::ZERO,
        along: Dd::ZERO,
    }
}

/// −E (σ₀ z + σ₁ ż), ż = γ_t − σ₀ |γ_t| z/μ; stored ½ σ₀ E |z|², which pushes with ½ σ₀ |z|² ∂E/∂δ.
/// Without contact ż = −z/release.
fn bristles(
    e: &Effect,
    at: &At<'_>,
    meeting: &Meeting,
    (depth, elastic, _): (Dd, Dd, Dd),
    along: V3,
    sums: &mut Sums,
) -> Friction {
    let names = bristle_names(&e.name);
    let [x, y] = names.each_ref().map(|name| at.state.x[name]);
    let world = |[x, y]: [Dd; 2]| add(scale(meeting.axes[0], x), scale(meeting.axes[1], y));
    let (z, stiffness) = (world([x, y]), e.number("bristles"));
    let rate = if meeting.gap < Dd::ZERO {
        let bent = stiffness * norm(along) / coefficient(e, along);
        sub(along, scale(z, bent))
    } else {
        scale(z, -(Dd::ONE / e.number("release")))
    };
    for (name, axis) in names.into_iter().zip(meeting.axes) {
        sums.rates.insert(name, dot(axis, rate));
    }
    let bent = add(
        scale(z, stiffness),
        scale(rate, e.or("bristle_damping", 0.0)),
    );
    let half = dd(0.5) * stiffness * dot(z, z);
    let lift = half * dd(1.5) * e.number("stiffness") * depth.sqrt();
    let away = dot(meeting.normal, meeting.velocity);
    Friction {
        force: scale(bent, -elastic),
        lift,
        stored: half * elastic,
        stored_rate: stiffness * elastic * dot(z, rate) - lift * away,
        along: dot(z, along),
    }
}

fn bristle_names(effect: &str) -> [String; 2] {
    ["x", "y"].map(|axis| format!("{effect}_bristles_{axis}"))
}

/// The effects that one entry of a scene declares: one for each contact that it names.
pub fn each(e: Effect, all: &[Contact]) -> Vec<Effect> {
    let asked = e.keys.get("contacts").or_else(|| e.keys.get("contact"));
    let asked: Vec<&str> = match asked.expect("contacts") {
        Value::Sequence(names) => names.iter().filter_map(Value::as_str).collect(),
        name => vec![name.as_str().expect("a name")],
    };
    let meant = |c: &&Contact| {
        asked == ["all"] || asked.contains(&c.name.as_str()) || asked.contains(&c.entry.as_str())
    };
    let one = |c: &Contact| {
        let mut one = e.clone();
        if !(e.has("contact") && c.name == c.entry) {
            one.name = format!("{}_{}", e.name, c.name);
        }
        one.keys["contact"] = c.name.clone().into();
        one
    };
    all.iter().filter(meant).map(one).collect()
}

/// The names of an effect's outputs; none of other effects.
pub fn outputs(e: &Effect, scene: &Scene) -> Vec<String> {
    if e.kind() != "compliant_contact" {
        return vec![];
    }
    let contact = scene.mechanism.contact(e.text("contact"));
    let friction: &[&str] = match contact.partner {
        Partner::Plane { .. } => &["friction_x", "friction_y", "slip"],
        Partner::Sphere { .. } => &["friction", "slip"],
    };
    let parts = ["gap", "normal"].iter().chain(friction);
    parts.map(|part| format!("{}_{part}", e.name)).collect()
}

/// What is special about an effect's contact and its law.
pub fn kinds(e: &Effect, mechanism: &Mechanism) -> Vec<String> {
    if e.kind() != "compliant_contact" {
        return vec![];
    }
    let contact = mechanism.contact(e.text("contact"));
    let partner = match contact.partner {
        Partner::Plane { named: false, .. } => "with the ground",
        Partner::Plane { body: None, .. } => "with a plane of the world",
        Partner::Plane { .. } => "with a plane of a link",
        Partner::Sphere { .. } => "with a sphere",
    };
    let mut kinds = vec![format!("of a {}", contact.shape), partner.into()];
    for (key, what) in [
        ("width", "with smooth friction"),
        ("bristles", "with bristles"),
        ("static", "with a static coefficient"),
        ("damping", "with damping"),
        ("restitution", "with a restitution"),
    ] {
        kinds.extend(e.has(key).then(|| what.to_owned()));
    }
    if !e.has("kinetic") {
        kinds.push("without friction".into());
    }
    if e.keys["stiffness"].is_mapping() {
        kinds.push("with a parameter".into());
    }
    kinds.iter().map(|kind| format!("contact {kind}")).collect()
}
