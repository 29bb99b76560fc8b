//! Computes inertia tensors of homogeneous solids about their centres, from dimensions and mass.

use bgdyn_runtime::Dd;

use super::direction::Directions;
use crate::fault::{Faults, wording};
use crate::format::{Field, InertiaSpec, LENGTHS, LinkSpec, Located, Number, Vector};

/// A kind of solid.
struct SolidKind {
    /// The word of the key `solid`.
    word: &'static str,
    /// Required keys.
    needs: &'static [&'static str],
    /// Optional keys.
    may: &'static [&'static str],
}

/// All kinds.
const KINDS: [SolidKind; 4] = [
    SolidKind {
        word: "box",
        needs: &["size"],
        may: &[],
    },
    SolidKind {
        word: "cylinder",
        needs: &["radius", "length"],
        may: &["inner_radius", "axis"],
    },
    SolidKind {
        word: "sphere",
        needs: &["radius"],
        may: &["inner_radius"],
    },
    // So thin that its radius is neglected.
    SolidKind {
        word: "rod",
        needs: &["length"],
        may: &["axis"],
    },
];

/// Reports keys that contradict each other: a solid has no entries, an off-diagonal entry is given once,
/// and dimensions belong to a solid.
pub(super) fn conflicts(inertia: &InertiaSpec, faults: &mut Faults) -> bool {
    let before = faults.0.len();
    let names = ["xx", "yy", "zz", "xy", "xz", "yz"];
    let given = |k: usize| inertia.entries[k].given().map(|e| (names[k], &e.location));
    if inertia.solid.is_absent() {
        let lengths = inertia.lengths.iter().zip(LENGTHS);
        let lengths = lengths.filter_map(|(l, key)| Some((key, &l.given()?.location)));
        let size = inertia.size.given().map(|s| ("size", &s.location));
        let axis = inertia.axis.given().map(|a| ("axis", &a.location));
        for (key, location) in lengths.chain(size).chain(axis) {
            let words = KINDS.map(|kind| kind.word);
            faults.push(wording::dimension_without_solid(location, key, &words));
        }
        if !inertia.products.is_absent() {
            for (key, location) in (3..6).filter_map(given) {
                faults.push(wording::two_tensors(location, key, "products"));
            }
        }
    } else {
        let products = inertia.products.given().map(|p| ("products", &p.location));
        let about = inertia.about.given().map(|a| ("about", &a.location));
        for (key, location) in (0..6).filter_map(given).chain(products).chain(about) {
            faults.push(wording::two_tensors(location, key, "solid"));
        }
    }
    faults.0.len() > before
}

/// Returns the tensor of the solid: xx, yy, zz, xy, xz, yz in its own axes.
pub(super) fn tensor(
    word: &Located<String>,
    link: &LinkSpec,
    inertia: &InertiaSpec,
    directions: &Directions,
    faults: &mut Faults,
) -> Option<[Dd; 6]> {
    let Some(kind) = KINDS.iter().find(|kind| kind.word == word.value) else {
        let words = KINDS.map(|kind| kind.word);
        faults.push(wording::unknown_solid(&word.location, &word.value, &words));
        return None;
    };
    let complete = keys_fit(kind, word, inertia, faults);
    let mass = mass(word, link, faults);
    let size = edges(&inertia.size, faults);
    let [radius, inner, length] = std::array::from_fn(|k| {
        let least = LENGTHS[k] != "inner_radius";
        positive(&inertia.lengths[k], least, faults)
    });
    let axis = match &inertia.axis {
        Field::Absent => Some([Dd::ZERO, Dd::ZERO, Dd::ONE]),
        Field::Broken => None,
        Field::Given(axis) => directions.axis(axis, faults).map(|a| a.0),
    };
    if let (Some(r), Some(i), Some(location)) = (radius, inner, inertia.lengths[1].given())
        && i >= r
    {
        let outer = inertia.lengths[0].value().map_or("", |r| &r.text);
        faults.push(wording::inner_radius(
            &location.location,
            &location.value.text,
            outer,
        ));
        return None;
    }
    if !complete {
        return None;
    }
    let (mass, hole) = (mass?, inner.unwrap_or(Dd::ZERO));
    Some(match kind.word {
        "box" => of_box(mass, size?),
        "cylinder" => of_cylinder(mass, radius?, hole, length?, axis?),
        "sphere" => of_sphere(mass, radius?, hole),
        _ => of_cylinder(mass, Dd::ZERO, Dd::ZERO, length?, axis?),
    })
}

/// Returns whether the keys are those of the kind.
fn keys_fit(
    kind: &SolidKind,
    word: &Located<String>,
    inertia: &InertiaSpec,
    faults: &mut Faults,
) -> bool {
    let before = faults.0.len();
    let lengths = inertia.lengths.iter().zip(LENGTHS);
    let lengths = lengths.map(|(l, key)| (key, l.is_absent(), l.given().map(|l| &l.location)));
    let (size, axis) = (&inertia.size, &inertia.axis);
    let vectors = [("size", size), ("axis", axis)];
    let vectors = vectors.map(|(key, v)| (key, v.is_absent(), v.given().map(|v| &v.location)));
    for (key, absent, location) in lengths.chain(vectors) {
        let (needed, allowed) = (kind.needs.contains(&key), kind.may.contains(&key));
        if absent && needed {
            faults.push(wording::missing_dimension(&word.location, kind.word, key));
        }
        if let (Some(location), false) = (location, needed || allowed) {
            faults.push(wording::dimension_of_another(location, kind.word, key));
        }
    }
    faults.0.len() == before
}

/// Returns the mass, which must be a number above 0.
fn mass(word: &Located<String>, link: &LinkSpec, faults: &mut Faults) -> Option<Dd> {
    match &link.mass {
        Field::Broken => None,
        Field::Given(mass) if mass.value.parameter.is_some() => {
            faults.push(wording::solid_of_parameter(&word.location));
            None
        }
        Field::Given(mass) if mass.value.value != Dd::ZERO => Some(mass.value.value),
        _ => {
            faults.push(wording::solid_without_mass(&word.location));
            None
        }
    }
}

/// Returns a length above 0, or, if not `strictly`, at least 0.
fn positive(field: &Field<Number>, strictly: bool, faults: &mut Faults) -> Option<Dd> {
    let length = field.given()?;
    let value = length.value.value;
    if value < Dd::ZERO || (strictly && value == Dd::ZERO) {
        faults.push(wording::not_a_length(&length.location, &length.value.text));
        return None;
    }
    Some(value)
}

fn edges(size: &Field<Vector>, faults: &mut Faults) -> Option<[Dd; 3]> {
    let mut edges = [Dd::ZERO; 3];
    for (edge, number) in edges.iter_mut().zip(&size.given()?.value) {
        *edge = positive(&Field::Given(number.clone()), false, faults)?;
    }
    Some(edges)
}

/// Returns m (b² + c²) / 12 about the edge a.
fn of_box(mass: Dd, size: [Dd; 3]) -> [Dd; 6] {
    let [x, y, z] = size.map(|s| mass * s * s / Dd::from_f64(12.0));
    [y + z, x + z, x + y, Dd::ZERO, Dd::ZERO, Dd::ZERO]
}

/// Returns m (R² + r²) / 2 about the axis, m (3 (R² + r²) + l²) / 12 across it: across 1 + (about −
/// across) a aᵀ.
fn of_cylinder(mass: Dd, outer: Dd, inner: Dd, length: Dd, a: [Dd; 3]) -> [Dd; 6] {
    let quarter = mass * (outer * outer + inner * inner) / Dd::from_f64(4.0);
    let across = quarter + mass * length * length / Dd::from_f64(12.0);
    let more = quarter + quarter - across;
    let entry = |i: usize, j: usize| {
        let product = more * a[i] * a[j];
        if i == j { across + product } else { product }
    };
    [
        entry(0, 0),
        entry(1, 1),
        entry(2, 2),
        entry(0, 1),
        entry(0, 2),
        entry(1, 2),
    ]
}

/// Returns 2/5 m (R⁵ − r⁵) / (R³ − r³).
fn of_sphere(mass: Dd, outer: Dd, inner: Dd) -> [Dd; 6] {
    let power = |x: Dd, n: usize| (0..n).fold(Dd::ONE, |product, _| product * x);
    let share = (power(outer, 5) - power(inner, 5)) / (power(outer, 3) - power(inner, 3));
    let moment = mass * share * Dd::from_f64(2.0) / Dd::from_f64(5.0);
    [moment, moment, moment, Dd::ZERO, Dd::ZERO, Dd::ZERO]
}
