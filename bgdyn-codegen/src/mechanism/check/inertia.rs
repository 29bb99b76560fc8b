//! Checks inertia tensors and converts them to the centre of mass and to link axes.
//!
//! A tensor is given by entries, products or a solid. It must be positive semidefinite and satisfy the
//! triangle inequality.

use bgdyn_runtime::Dd;
use bgdyn_runtime::nalgebra::Matrix3;

use super::direction::Directions;
use super::parameters::Parameters;
use super::solid;
use crate::fault::{Faults, Location, wording};
use crate::format::{Dimension, Field, InertiaSpec, LinkSpec};
use crate::math::Mat3;
use crate::mechanism::{Pose, Tensor, Value};

/// Largest violation of a rule, relative to the largest principal moment.
const TOLERANCE: f64 = 1e-9;
/// Bound, with a margin, for the rounding error of the double-double operations in J = R·J'·Rᵀ.
const NOISE: f64 = 1e-28;
/// Rows and columns of xx, yy, zz, xy, xz, yz.
const PLACES: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

/// Returns the tensor of `link`: in its axes, or, if an entry is a run-time parameter, in the axes of the
/// file.
pub(super) fn tensor(
    link: &LinkSpec,
    directions: &Directions,
    parameters: &mut Parameters<'_>,
    faults: &mut Faults,
) -> Option<Tensor> {
    let allowed = allows_nonphysical(link, faults);
    let straight = Pose::IDENTITY.rotation;
    let inertia = match &link.inertia {
        Field::Absent => {
            return Some(Tensor {
                entries: [Value::Fixed(Dd::ZERO); 6],
                axes: straight,
            });
        }
        Field::Broken => return None,
        Field::Given(inertia) => inertia,
    };
    let rotation = directions.rotation(&inertia.value.rpy, faults);
    let entries = match read_tensor(link, &inertia.value, directions, parameters, faults)? {
        InertiaNotation::AboutCentre(entries) => entries,
        InertiaNotation::AboutOrigin(numbers, shift) => {
            let about = minus(turned(numbers, rotation?), shift);
            physical(&inertia.location, &about, allowed, faults);
            return Some(Tensor {
                entries: about.map(Value::Fixed),
                axes: straight,
            });
        }
    };
    let numbers = entries.map(|entry| parameters.default_of(entry));
    physical(&inertia.location, &numbers, allowed, faults);
    let known = entries.iter().all(|e| matches!(e, Value::Fixed(_)));
    Some(match (inertia.value.rpy.is_absent(), known) {
        (true, _) => Tensor {
            entries,
            axes: straight,
        },
        (false, true) => Tensor {
            entries: turned(numbers, rotation?).map(Value::Fixed),
            axes: straight,
        },
        (false, false) => Tensor {
            entries,
            axes: rotation?,
        },
    })
}

/// A tensor in its own axes.
enum InertiaNotation {
    /// About the centre of mass.
    AboutCentre([Value; 6]),
    /// About the link's origin, with the parallel-axis term of the mass, in link axes.
    AboutOrigin([Dd; 6], [Dd; 6]),
}

fn read_tensor(
    link: &LinkSpec,
    inertia: &InertiaSpec,
    directions: &Directions,
    parameters: &mut Parameters<'_>,
    faults: &mut Faults,
) -> Option<InertiaNotation> {
    if inertia.solid.is_broken() || solid::conflicts(inertia, faults) {
        return None;
    }
    if let Some(word) = inertia.solid.given() {
        let tensor = solid::tensor(word, link, inertia, directions, faults)?;
        return Some(InertiaNotation::AboutCentre(tensor.map(Value::Fixed)));
    }
    let entries = entries(link, inertia, parameters, faults);
    let about = match &inertia.about {
        Field::Absent => return entries.map(InertiaNotation::AboutCentre),
        Field::Broken => return None,
        Field::Given(about) => about,
    };
    match about.value.as_str() {
        "com" => entries.map(InertiaNotation::AboutCentre),
        "origin" => {
            let shift = parallel_axis(link, &about.location, faults);
            let fixed = entries?.map(|entry| match entry {
                Value::Fixed(x) => Some(x),
                Value::Parameter(_) => None,
            });
            let numbers: Option<Vec<Dd>> = fixed.into_iter().collect();
            let Some(numbers) = numbers.and_then(|n| <[Dd; 6]>::try_from(n).ok()) else {
                faults.push(wording::parameter_about_origin(&about.location, "entry"));
                return None;
            };
            Some(InertiaNotation::AboutOrigin(numbers, shift?))
        }
        word => {
            faults.push(wording::about_word(&about.location, word));
            None
        }
    }
}

/// Returns m (c·c 1 − c cᵀ) of the link's mass and centre of mass.
fn parallel_axis(link: &LinkSpec, about: &Location, faults: &mut Faults) -> Option<[Dd; 6]> {
    let mass = link.mass.given().map(|m| &m.value);
    let com = link.com.given().map(|c| &c.value);
    let centre = com.into_iter().flatten().map(|x| &x.value);
    if mass
        .into_iter()
        .chain(centre)
        .any(|x| x.parameter.is_some())
    {
        faults.push(wording::parameter_about_origin(
            about,
            "mass or centre of mass",
        ));
        return None;
    }
    if link.mass.is_broken() || link.com.is_broken() {
        return None;
    }
    let mass = mass.map_or(Dd::ZERO, |m| m.value);
    let c = com.map_or([Dd::ZERO; 3], |c| c.each_ref().map(|x| x.value.value));
    let square = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
    Some(PLACES.map(|(i, j)| {
        let product = c[i] * c[j];
        mass * if i == j { square - product } else { -product }
    }))
}

fn minus(a: [Dd; 6], b: [Dd; 6]) -> [Dd; 6] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn allows_nonphysical(link: &LinkSpec, faults: &mut Faults) -> bool {
    match &link.nonphysical {
        Field::Absent => false,
        // Unreadable, and already reported: no further fault about the tensor.
        Field::Broken => true,
        Field::Given(word) => {
            if word.value != "allow" {
                faults.push(wording::nonphysical_word(&word.location, &word.value));
            }
            true
        }
    }
}

fn entries(
    link: &LinkSpec,
    inertia: &InertiaSpec,
    parameters: &mut Parameters<'_>,
    faults: &mut Faults,
) -> Option<[Value; 6]> {
    let link = link.name.value().map_or("", String::as_str);
    let mut entries = [Value::Fixed(Dd::ZERO); 6];
    let mut whole = !inertia.products.is_broken();
    let names = ["xx", "yy", "zz", "xy", "xz", "yz"];
    if let Some(products) = inertia.products.value() {
        // The tensor's entry is minus the product.
        for (entry, product) in entries[3..].iter_mut().zip(products) {
            whole &= !product.is_broken();
            if let Some(product) = product.value() {
                *entry = Value::Fixed(-product.value);
            }
        }
    }
    for ((entry, field), name) in entries.iter_mut().zip(&inertia.entries).zip(names) {
        match field {
            Field::Absent => {}
            Field::Broken => whole = false,
            Field::Given(number) => {
                let meaning = || format!("entry {name} of the inertia tensor of link `{link}`");
                *entry = parameters.value(number, Dimension::Inertia, meaning, faults);
            }
        }
    }
    whole.then_some(entries)
}

/// Refuses a tensor (xx, yy, zz, xy, xz, yz about the centre of mass) that no body can have.
pub(crate) fn check_tensor(location: &Location, entries: &[Dd; 6], faults: &mut Faults) {
    physical(location, entries, false, faults);
}

fn physical(location: &Location, entries: &[Dd; 6], allowed: bool, faults: &mut Faults) {
    let moments = principal_moments(entries);
    let [small, middle, large] = moments;
    let slack = TOLERANCE * large.abs().max(small.abs());
    if small < -slack {
        faults.push(wording::not_semidefinite(location, moments));
    } else if !allowed && large > small + middle + slack {
        faults.push(wording::triangle_inequality(location, moments));
    }
}

/// Returns the principal moments, smallest first.
fn principal_moments(entries: &[Dd; 6]) -> [f64; 3] {
    let [xx, yy, zz, xy, xz, yz] = entries.map(Dd::to_f64);
    let largest = [xx, yy, zz, xy, xz, yz]
        .iter()
        .fold(0.0_f64, |m, x| m.max(x.abs()));
    if largest == 0.0 {
        return [0.0; 3];
    }
    let tensor = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz) / largest;
    let values = tensor.symmetric_eigenvalues() * largest;
    let mut moments = [values.x, values.y, values.z];
    moments.sort_by(f64::total_cmp);
    moments
}

/// Returns J = R·J'·Rᵀ.
fn turned(entries: [Dd; 6], r: Mat3<Dd>) -> [Dd; 6] {
    let mut own = Mat3([[Dd::ZERO; 3]; 3]);
    for (entry, (i, j)) in entries.into_iter().zip(PLACES) {
        (own.0[i][j], own.0[j][i]) = (entry, entry);
    }
    let tensor = r * own * r.transpose();
    without_noise(PLACES.map(|(i, j)| tensor.0[i][j]))
}

/// Sets entries to 0 that are rounding errors relative to the largest one, and makes moments equal that
/// differ only by rounding.
fn without_noise(mut entries: [Dd; 6]) -> [Dd; 6] {
    let largest = entries.iter().fold(0.0_f64, |m, x| m.max(x.to_f64().abs()));
    let noise = |x: Dd| x.to_f64().abs() <= NOISE * largest;
    for entry in &mut entries {
        if noise(*entry) {
            *entry = Dd::ZERO;
        }
    }
    for (i, j) in [(0, 1), (0, 2), (1, 2)] {
        if noise(entries[j] - entries[i]) {
            entries[j] = entries[i];
        }
    }
    entries
}
