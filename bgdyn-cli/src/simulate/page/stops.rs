//! Computes positions of the stops of joints.

use bgdyn_codegen::declaration::Element;
use bgdyn_codegen::math::Vec3;
use bgdyn_codegen::scene::Scene;

use super::body::{Body, Placed, Stop};

/// Returns the stops of a joint: `on` is its pose on the parent body, `body` the body that it moves.
pub(super) fn stops(
    scene: &Scene,
    joint: &str,
    on: &Placed,
    body: &Body,
    slides: bool,
) -> Vec<Stop> {
    let axis = body.axis();
    let radius = outwards(body, axis);
    let own = |e: &&Element| e.effect.keyword() == "stop" && e.joint() == Some(joint);
    let elements = scene.elements.iter().filter(own);
    let ends = elements.flat_map(|e| [(e, "lower", -1.0), (e, "upper", 1.0)]);
    let stop = |(element, key, side): (&Element, &'static str, f64)| {
        let q = value(scene, element, key)?;
        let (at, way) = match slides {
            true => (axis.map(|x| q * x), axis),
            false => ([0.0; 3], rotate(radius, axis, q)),
        };
        Some(Stop {
            name: element.name.clone(),
            at: on.point(at),
            way: on.rotate(way),
            side,
        })
    };
    ends.filter_map(stop).collect()
}

/// Returns a number of an element, or the default of its run-time parameter.
fn value(scene: &Scene, element: &Element, key: &str) -> Option<f64> {
    let quantity = element.quantity(element.effect.key(key))?;
    let named = |name: &String| scene.parameters.iter().find(|p| p.name == *name);
    let parameter = quantity.parameter.as_ref().and_then(named);
    let value = parameter.map_or(quantity.value, |p| p.default);
    Some(value.to_f64()).filter(|x| x.is_finite())
}

/// Returns the unit vector from the axis to the point of the body that is farthest from it; without one,
/// any vector perpendicular to the axis.
fn outwards(body: &Body, axis: [f64; 3]) -> [f64; 3] {
    let axis = Vec3(axis);
    let across = |p: [f64; 3]| {
        let along = axis.dot(Vec3(p));
        std::array::from_fn::<f64, 3, _>(|k| p[k] - along * axis.0[k])
    };
    let size = |p: &[f64; 3]| p.iter().map(|x| x * x).sum::<f64>().sqrt();
    let units = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let largest = |all: &mut dyn Iterator<Item = [f64; 3]>| {
        all.map(across).max_by(|a, b| size(a).total_cmp(&size(b)))
    };
    let found = largest(&mut body.places()).filter(|p| size(p) > 1e-9);
    let found = found.or_else(|| largest(&mut units.into_iter()));
    let found = found.unwrap_or(units[0]);
    found.map(|x| x / size(&found))
}

/// Returns a vector perpendicular to a unit axis, rotated about it by an angle.
fn rotate(x: [f64; 3], axis: [f64; 3], angle: f64) -> [f64; 3] {
    let across = [
        axis[1] * x[2] - axis[2] * x[1],
        axis[2] * x[0] - axis[0] * x[2],
        axis[0] * x[1] - axis[1] * x[0],
    ];
    let (sine, cosine) = angle.sin_cos();
    std::array::from_fn(|k| cosine * x[k] + sine * across[k])
}
