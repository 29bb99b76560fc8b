//! Friction along the plane of contact, isotropic, at the slip γ with the normal force λ.
//!
//! Smooth: F = −μ(γ) λ γ/√(|γ|² + w²), with the Stribeck curve μ(γ) = μ_k + (μ_s − μ_k) exp(−|γ|²/v_s²). It never holds
//! but creeps: under a force f along the plane at w f/√((μ λ)² − f²).
//!
//! Bristles (LuGre, Canudas de Wit, Olsson, Åström, Lischinsky 1995, with two components and stiffnesses in proportion to
//! the elastic part E(δ) of the normal force): F = −E (σ₀ z + σ₁ ż), ż = γ − σ₀ |γ| z/μ(γ). They store ½ E σ₀ |z|². The
//! stored energy depends on the depth as well, so that bristles push with ½ σ₀ |z|² ∂E/∂δ along the normal: without this
//! force, pressing on deflected bristles would create energy. With it they dissipate E σ₀² |γ| |z|²/μ, and E σ₁ ż·γ.
//! Without contact they store nothing and return to rest in the time `release`.

use bgdyn_runtime::Dd;

use super::super::keys::optional_number;
use super::normal::NormalForce;
use crate::declaration::{Element, ValueCheck};
use crate::effort_sums::{ContactMotion, EffortSums};
use crate::expr::Expr;
use crate::fault::{Help, wording};
use crate::format::{Dimension, Key};
use crate::math::Vec3;

pub(super) const KINETIC: Key = optional_number(
    "kinetic",
    &[Dimension::One],
    "μ_k, the coefficient of friction while slipping; no friction without it",
);
pub(super) const STATIC: Key = optional_number(
    "static",
    &[Dimension::One],
    "μ_s, the coefficient close to rest; μ_k without it",
);
pub(super) const STRIBECK_SPEED: Key = optional_number(
    "stribeck_speed",
    &[Dimension::Speed],
    "v_s, the speed of the Stribeck curve; needed where μ_s is given",
);
pub(super) const WIDTH: Key = optional_number(
    "width",
    &[Dimension::Speed],
    "w, the slip with 71 % of smooth friction; or `bristles`",
);
pub(super) const BRISTLES: Key = optional_number(
    "bristles",
    &[Dimension::InverseLength],
    "σ₀, stiffness of bristles per normal force: they deflect by μ/σ₀; instead of `width`",
);
pub(super) const BRISTLE_DAMPING: Key = optional_number(
    "bristle_damping",
    &[Dimension::InverseSpeed],
    "σ₁, damping of the bristles per normal force",
);
pub(super) const RELEASE: Key = optional_number(
    "release",
    &[Dimension::Time],
    "the time in which bristles without contact return to rest; needed with `bristles`",
);

/// The square of a speed, m²/s², below which bristles do not yield: above it the root of the square has a derivative.
const LEAST: f64 = 1e-30;

/// Returns whether the element has friction.
pub(super) fn acts(element: &Element) -> bool {
    element.quantity(&KINETIC).is_some()
}

/// Returns whether its friction has bristles.
pub(super) fn has_bristles(element: &Element) -> bool {
    acts(element) && element.quantity(&BRISTLES).is_some()
}

/// Returns the names of the states of bristles: their deflections along x and y of the plane.
pub(super) fn states(element: &Element) -> [String; 2] {
    ["x", "y"].map(|axis| format!("{}_bristles_{axis}", element.name))
}

/// Checks the numbers of the law.
pub(super) fn check(check: &mut ValueCheck<'_>) {
    check.not_negative(&[KINETIC, STATIC, BRISTLE_DAMPING], Help::FrictionOpposes);
    check.ordered(&KINETIC, &STATIC, Help::RestHoldsMore);
    check.positive(
        &[STRIBECK_SPEED, WIDTH, BRISTLES, RELEASE],
        Help::ContactWithoutFriction,
    );
    if check.number(&BRISTLES).is_some() {
        check.positive(&[KINETIC], Help::BristlesNeedRest);
    }
    let element = check.element;
    let (location, name) = (element.location.clone(), &element.name);
    let has = |key: &Key| element.quantity(key).is_some();
    if has(&STATIC) && !has(&STRIBECK_SPEED) {
        check.report(wording::no_stribeck_speed(
            &element
                .quantity(&STATIC)
                .map_or(location.clone(), |q| q.location.clone()),
        ));
    }
    if has(&KINETIC) && has(&WIDTH) == has(&BRISTLES) {
        check.report(wording::width_or_bristles(&location, name, has(&WIDTH)));
    }
    if has(&BRISTLES) && !has(&RELEASE) {
        check.report(wording::bristles_without_release(&location, name));
    }
    let of_bristles = [&BRISTLE_DAMPING, &RELEASE]
        .into_iter()
        .filter(|_| !has(&BRISTLES));
    let without = [&STATIC, &STRIBECK_SPEED, &WIDTH, &BRISTLES];
    let without = without.into_iter().filter(|_| !has(&KINETIC));
    for key in of_bristles.chain(without).filter(|key| has(key)) {
        let needed = match key.name {
            "bristle_damping" | "release" => BRISTLES.name,
            _ => KINETIC.name,
        };
        check.report(wording::contact_key_alone(
            &location,
            name,
            [key.name, needed],
        ));
    }
}

/// Returns the force on the sphere along the plane of contact, N, and the force of the bristles along the normal; adds
/// energy, power and the rates of the bristles.
pub(super) fn force<'g>(
    element: &Element,
    sums: &mut EffortSums<'g, '_>,
    (motion, normal): (&ContactMotion<'g>, &NormalForce<'g>),
) -> (Vec3<Expr<'g>>, Expr<'g>) {
    let square = motion.slip.dot(motion.slip);
    let coefficient = coefficient(element, sums, square);
    match (motion.along, has_bristles(element)) {
        (Some(along), true) => bristles(element, sums, (motion, normal), (along, coefficient)),
        _ => {
            let width = sums.number(element, &WIDTH);
            let factor = coefficient * normal.push.force / (square + width * width).sqrt();
            sums.dissipate(factor * square);
            (motion.slip.scale(-factor), sums.b.zero())
        }
    }
}

/// Returns μ_k + (μ_s − μ_k) exp(−|γ|²/v_s²).
fn coefficient<'g>(element: &Element, sums: &EffortSums<'g, '_>, square: Expr<'g>) -> Expr<'g> {
    let kinetic = sums.number(element, &KINETIC);
    let [rest, speed] = [&STATIC, &STRIBECK_SPEED].map(|key| sums.optional(element, key));
    match (rest, speed) {
        (Some(rest), Some(speed)) => {
            kinetic + (rest - kinetic) * (-(square / (speed * speed))).exp()
        }
        _ => kinetic,
    }
}

fn bristles<'g>(
    element: &Element,
    sums: &mut EffortSums<'g, '_>,
    (motion, normal): (&ContactMotion<'g>, &NormalForce<'g>),
    (along, coefficient): ([Vec3<Expr<'g>>; 2], Expr<'g>),
) -> (Vec3<Expr<'g>>, Expr<'g>) {
    let zero = sums.b.zero();
    let z = states(element).map(|name| sums.state(&name));
    let slip = along.map(|axis| axis.dot(motion.slip));
    let dot = |a: [Expr<'g>; 2], b: [Expr<'g>; 2]| a[0] * b[0] + a[1] * b[1];
    let (square, least) = (dot(slip, slip), sums.b.number(LEAST));
    let speed = square.if_less(least, zero, square.max(least).sqrt());
    let [stiffness, damping, release] =
        [&BRISTLES, &BRISTLE_DAMPING, &RELEASE].map(|key| sums.number(element, key));
    let back = stiffness * speed / coefficient;
    let rate = [0, 1].map(|i| slip[i] - back * z[i]);
    for (i, name) in states(element).into_iter().enumerate() {
        // Less than zero: the surfaces overlap.
        sums.flow(&name, motion.gap.if_less(zero, rate[i], -(z[i] / release)));
    }
    let size = normal.elastic;
    let pull = [0, 1].map(|i| size * (stiffness * z[i] + damping * rate[i]));
    let energy = stiffness * dot(z, z) * Dd::from_f64(0.5);
    sums.store(size * energy);
    sums.dissipate(dot(pull, slip) - size * stiffness * dot(z, rate));
    sums.event(&reverses(element), dot(z, slip));
    let [x, y] = along;
    (
        -(x.scale(pull[0]) + y.scale(pull[1])),
        energy * normal.slope,
    )
}

/// Returns the name of the event where the slip reverses against the bristles.
pub(super) fn reverses(element: &Element) -> String {
    format!("{}_reverses", element.name)
}
