//! The functions that generated C calls: sines, pivots, and what C99 has no operator for.
//!
//! They compute what the runtime of bgdyn computes, in the same order, so that results have the same bits.

use bgdyn_runtime::Dd;
use bgdyn_runtime::closure::polygon;

use super::style::{Real, Style};

/// Names of the helpers without the prefix, each after those that it calls.
const HELPERS: [&str; 54] = [
    "mul_add",
    "smaller",
    "larger",
    "sign",
    "checked_pivot",
    "status",
    "add_angle",
    "sin_cos_of_rest",
    "sin_cos_near",
    "turn",
    "sin_cos_far",
    "sin_cos",
    "sin_cos_sum",
    "sin_cos_lanes",
    "sin_cos_pair",
    "sin_cos_all",
    "sines",
    "sine_ratio",
    "cross",
    "quaternion_turn",
    "quaternion_product",
    "quaternion_exponential",
    "spherical_normalize",
    "arc_ratio",
    "quaternion_logarithm",
    "spherical_position_rates",
    "spherical_integrate",
    "floating_normalize",
    "floating_position_rates",
    "floating_integrate",
    "planar_normalize",
    "planar_position_rates",
    "planar_integrate",
    "spherical_difference",
    "floating_difference",
    "planar_difference",
    "spherical_sample",
    "floating_sample",
    "planar_sample",
    "polygon_check",
    "polygon_root",
    "polygon_triangle",
    "polygon_slider",
    "polygon_cylinder",
    "polygon_is_other",
    "polygon_is_nearer",
    "polygon_arc_tangent",
    "polygon_turn",
    "polygon_small_turn",
    "polygon_are_exact",
    "polygon_check_angle",
    "is_held",
    "shortest_step",
    "block_determinant",
];

/// Number of terms of the series of sines.
const SERIES: u32 = 18;

/// Number of terms of the series of the arc tangent.
const TERMS: u32 = 16;

/// Returns the helpers that a text calls, directly or by others.
pub(super) fn helpers(text: &str, style: &Style) -> String {
    let mut called = text.to_string();
    for helper in HELPERS.iter().rev() {
        if called.contains(&format!("{}(", style.global(helper))) {
            called = format!("{}\n{called}", written(helper, style));
        }
    }
    called.truncate(called.len() - text.len());
    called
}

/// Returns the template of a helper: `@` is the prefix, words in capitals stand for types, numbers and a macro
/// ([`written`]); numbers and functions of libm are in backquotes.
fn template(name: &str, style: &Style) -> &'static str {
    match (name, style.real) {
        ("mul_add", _) => include_str!("helpers/mul_add.h"),
        ("smaller", _) => include_str!("helpers/smaller.h"),
        ("larger", _) => include_str!("helpers/larger.h"),
        ("sign", _) => include_str!("helpers/sign.h"),
        ("checked_pivot", _) => include_str!("helpers/checked_pivot.h"),
        ("status", _) => include_str!("helpers/status.h"),
        ("add_angle", _) => include_str!("helpers/add_angle.h"),
        ("sin_cos_of_rest", Real::Double) => include_str!("helpers/sin_cos_of_rest_double.h"),
        ("sin_cos_of_rest", Real::Float) => include_str!("helpers/sin_cos_of_rest_float.h"),
        ("sin_cos_near", Real::Double) => include_str!("helpers/sin_cos_near_double.h"),
        ("sin_cos_near", Real::Float) => include_str!("helpers/sin_cos_near_float.h"),
        ("turn", Real::Double) => include_str!("helpers/turn_double.h"),
        ("turn", Real::Float) => include_str!("helpers/turn_float.h"),
        ("sin_cos_far", Real::Double) => include_str!("helpers/sin_cos_far_double.h"),
        ("sin_cos_far", Real::Float) => include_str!("helpers/sin_cos_far_float.h"),
        ("sin_cos", _) if style.libm => include_str!("helpers/sin_cos_of_library.h"),
        ("sin_cos", _) => include_str!("helpers/sin_cos.h"),
        ("sin_cos_sum", _) if style.libm => include_str!("helpers/sin_cos_sum_of_library.h"),
        ("sin_cos_sum", _) => include_str!("helpers/sin_cos_sum.h"),
        ("sin_cos_lanes", _) => include_str!("helpers/sin_cos_lanes_double.h"),
        ("sin_cos_pair", _) => include_str!("helpers/sin_cos_pair_double.h"),
        // On processors with registers for four of them, and everywhere else.
        ("sin_cos_all", Real::Double) => concat!(
            include_str!("helpers/sin_cos_all_in_lanes.h"),
            include_str!("helpers/sin_cos_all.h"),
            "#endif\n"
        ),
        ("sin_cos_all", Real::Float) => include_str!("helpers/sin_cos_all.h"),
        (name, _) => manifold_template(name),
    }
}

/// Returns the template of a function of joints with several velocities, those of `bgdyn_runtime::manifold`.
fn manifold_template(name: &str) -> &'static str {
    match name {
        "sines" => include_str!("helpers/sines.h"),
        "sine_ratio" => include_str!("helpers/sine_ratio.h"),
        "cross" => include_str!("helpers/cross.h"),
        "quaternion_turn" => include_str!("helpers/quaternion_turn.h"),
        "quaternion_product" => include_str!("helpers/quaternion_product.h"),
        "quaternion_exponential" => include_str!("helpers/quaternion_exponential.h"),
        "spherical_normalize" => include_str!("helpers/spherical_normalize.h"),
        "spherical_position_rates" => include_str!("helpers/spherical_position_rates.h"),
        "spherical_integrate" => include_str!("helpers/spherical_integrate.h"),
        "floating_normalize" => include_str!("helpers/floating_normalize.h"),
        "floating_position_rates" => include_str!("helpers/floating_position_rates.h"),
        "floating_integrate" => include_str!("helpers/floating_integrate.h"),
        "planar_normalize" => include_str!("helpers/planar_normalize.h"),
        "planar_position_rates" => include_str!("helpers/planar_position_rates.h"),
        "planar_integrate" => include_str!("helpers/planar_integrate.h"),
        "arc_ratio" => include_str!("helpers/arc_ratio.h"),
        "quaternion_logarithm" => include_str!("helpers/quaternion_logarithm.h"),
        "spherical_difference" => include_str!("helpers/spherical_difference.h"),
        "floating_difference" => include_str!("helpers/floating_difference.h"),
        "planar_difference" => include_str!("helpers/planar_difference.h"),
        "spherical_sample" => include_str!("helpers/spherical_sample.h"),
        "floating_sample" => include_str!("helpers/floating_sample.h"),
        "planar_sample" => include_str!("helpers/planar_sample.h"),
        name => closing_template(name),
    }
}

/// Returns the template of a function that closes or assembles positions, those of `bgdyn_runtime::closure`.
fn closing_template(name: &str) -> &'static str {
    match name {
        "polygon_check" => include_str!("helpers/polygon_check.h"),
        "polygon_root" => include_str!("helpers/polygon_root.h"),
        "polygon_triangle" => include_str!("helpers/polygon_triangle.h"),
        "polygon_slider" => include_str!("helpers/polygon_slider.h"),
        "polygon_cylinder" => include_str!("helpers/polygon_cylinder.h"),
        "polygon_is_other" => include_str!("helpers/polygon_is_other.h"),
        "polygon_is_nearer" => include_str!("helpers/polygon_is_nearer.h"),
        "polygon_arc_tangent" => include_str!("helpers/polygon_arc_tangent.h"),
        "polygon_turn" => include_str!("helpers/polygon_turn.h"),
        "polygon_small_turn" => include_str!("helpers/polygon_small_turn.h"),
        "polygon_are_exact" => include_str!("helpers/polygon_are_exact.h"),
        "polygon_check_angle" => include_str!("helpers/polygon_check_angle.h"),
        "is_held" => include_str!("helpers/is_held.h"),
        "shortest_step" => include_str!("helpers/shortest_step.h"),
        "block_determinant" => include_str!("helpers/block_determinant.h"),
        _ => unreachable!("the names of HELPERS"),
    }
}

/// Returns 1/first!, 1/(first + 2)!, …
fn inverse_factorials(first: u32, style: &Style) -> String {
    let inverse = |n: u32| {
        let factors = (2..=n).map(|k| Dd::from(f64::from(k)));
        style.number(factors.fold(Dd::ONE, |x, k| x / k).to_f64())
    };
    let all = (0..SERIES).map(|k| inverse(first + 2 * k));
    all.collect::<Vec<_>>().join(", ")
}

/// Returns 1, 1/3, 1/5, …
fn odd_reciprocals(style: &Style) -> String {
    let all = (0..TERMS).map(|k| Dd::ONE / Dd::from(f64::from(2 * k + 1)));
    let all: Vec<String> = all.map(|x| style.number(x.to_f64())).collect();
    all.join(", ")
}

/// Returns a helper with the types, numbers and names of the style.
fn written(name: &str, style: &Style) -> String {
    filled(template(name, style), style)
}

/// Returns a template with the types, numbers and names of the style.
pub(super) fn filled(template: &str, style: &Style) -> String {
    let (largest, floor) = match style.real {
        Real::Double => (f64::MAX, 64.0 * f64::EPSILON),
        Real::Float => (f64::from(f32::MAX), 64.0 * f64::from(f32::EPSILON)),
    };
    // Angles, and rounding errors of their sums, up to these take the short path, as in Rust.
    let (near, small_tail) = match style.real {
        Real::Double => (1e5, 1.0 / 2_097_152.0),
        Real::Float => (1e4, 1.0 / 2048.0),
    };
    let (closing_step, [fine, coarse]) = (style.closing_step(), polygon::NEAR);
    let short_turn = match style.real {
        Real::Double => fine,
        Real::Float => coarse,
    };
    let arc_tangent = polygon::ARC_TANGENT.iter().rev();
    let arc_tangent: Vec<String> = arc_tangent.map(|&x| style.number(x)).collect();
    // Names of the mechanism come last: they may contain any of the words.
    let text = template.replace("REAL", style.real());
    let text = text.replace("LARGEST", &style.number(largest));
    let text = text.replace("PIVOT_FLOOR", &style.number(floor));
    let text = text.replace("SERIES", &SERIES.to_string());
    let text = text.replace("TERMS", &TERMS.to_string());
    let text = text.replace("RECIPROCALS", &odd_reciprocals(style));
    let text = text.replace("EVEN", &inverse_factorials(2, style));
    let text = text.replace("ODD", &inverse_factorials(3, style));
    let text = text.replace("SMALL_TAIL", &style.number(small_tail));
    let text = text.replace("NEAR", &style.number(near));
    let text = text.replace("CLOSING_STEP", &closing_step);
    let text = text.replace("SHORT_TURN", &style.number(short_turn));
    let text = text.replace("FLAT_SINE", &style.number(polygon::FLAT));
    let text = text.replace("ARC_TANGENT", &arc_tangent.join(", "));
    let sizes = ["NQ", "NT", "NC"].into_iter();
    let text = sizes.fold(text, |text, size| {
        text.replace(&format!("SIZE_{size}"), &style.constant(size))
    });
    let text = text.replace('@', &style.prefix);
    let text = text.replace("INLINED", &style.constant("INLINE"));
    let text = text.replace("HAS_LANES", &style.constant("HAS_LANES"));
    let text = text.replace("NO_LANES", &style.constant("NO_LANES"));
    let quoted = |(index, part): (usize, &str)| match (index % 2 == 1, part.parse::<f64>()) {
        (false, _) => part.to_string(),
        (true, Ok(number)) => style.number(number),
        (true, Err(_)) => style.of_library(part),
    };
    text.split('`').enumerate().map(quoted).collect()
}
