//! `<inertial>` of a body, and the settings that change masses and tensors.

use super::pose::{orientation, position};
use super::report::Report;
use super::settings::Settings;
use crate::import::attributes::{finite, numbers};
use crate::import::inertia::principal_moments;
use crate::import::model::{Inertial, Link};
use crate::import::number::Num;
use crate::import::xml::{Element, fault};
use anyhow::Result;
use nalgebra::{Matrix3, SymmetricEigen, Vector3};

/// Reads an `<inertial>`.
pub(super) fn read(
    element: &Element,
    settings: &Settings,
    report: &mut Report,
) -> Result<Inertial> {
    report.known(element);
    let tensor = match (element.get("diaginertia"), element.get("fullinertia")) {
        (Some(_), Some(_)) => {
            let message = "`diaginertia` and `fullinertia` both give the tensor: leave one";
            return Err(fault(element.at, message));
        }
        // xx, yy, zz, xy, xz, yz in both.
        (None, Some(_)) => numbers::<6>(element, "fullinertia")?,
        (Some(_), None) => {
            let [x, y, z] = numbers::<3>(element, "diaginertia")?;
            [x, y, z, Num::zero(), Num::zero(), Num::zero()]
        }
        (None, None) => Num::zeros(),
    };
    Ok(Inertial {
        mass: finite(element, "mass")?,
        com: position(element)?,
        rpy: orientation(element, settings)?.placement().rpy,
        tensor,
    })
}

/// Applies the least mass and the least moments, and balances tensors that break the triangle inequality, as
/// the settings demand; returns what changed.
pub(super) fn adjust(inertial: &mut Option<Inertial>, settings: &Settings) -> Option<&'static str> {
    let least = settings.least_mass.max(settings.least_inertia);
    if inertial.is_none() && least <= 0.0 {
        return None;
    }
    let own = inertial.get_or_insert_with(|| Inertial {
        mass: Num::zero(),
        com: Num::zeros(),
        rpy: Num::zeros(),
        tensor: Num::zeros(),
    });
    let mut changed = None;
    if own.mass.value < settings.least_mass {
        own.mass = Num::computed(settings.least_mass);
        changed = Some("masses and tensors below `boundmass`, `boundinertia`, raised");
    }
    let entries = own.tensor.each_ref().map(|entry| entry.value);
    let [small, middle, large] = principal_moments(entries);
    let bound = settings.least_inertia;
    if small < bound {
        let raised = SymmetricEigen::new(matrix(entries));
        let moments = raised.eigenvalues.map(|moment| moment.max(bound));
        let axes = raised.eigenvectors;
        let m = axes * Matrix3::from_diagonal(&moments) * axes.transpose();
        let list = [
            m[(0, 0)],
            m[(1, 1)],
            m[(2, 2)],
            m[(0, 1)],
            m[(0, 2)],
            m[(1, 2)],
        ];
        own.tensor = list.map(Num::computed);
        changed = Some("masses and tensors below `boundmass`, `boundinertia`, raised");
    }
    let [small, middle, large] = [small, middle, large].map(|moment| moment.max(bound));
    if settings.balance && small + middle < large {
        let mean = Num::computed((small + middle + large) / 3.0);
        let zero = Num::zero;
        own.tensor = [mean.clone(), mean.clone(), mean, zero(), zero(), zero()];
        own.rpy = Num::zeros();
        changed = Some("tensors that break the triangle inequality, balanced");
    }
    changed
}

fn matrix([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> Matrix3<f64> {
    let diagonal = Matrix3::from_diagonal(&Vector3::new(xx, yy, zz));
    let mut m = diagonal;
    for (i, j, entry) in [(0, 1, xy), (0, 2, xz), (1, 2, yz)] {
        m[(i, j)] = entry;
        m[(j, i)] = entry;
    }
    m
}

/// Scales all masses and tensors to this total mass; returns the factor.
pub(super) fn scale(links: &mut [Link], total: &Num) -> Option<f64> {
    let masses = links.iter().filter_map(|link| link.inertial.as_ref());
    let sum: f64 = masses.map(|inertial| inertial.mass.value).sum();
    if sum <= 0.0 {
        return None;
    }
    let factor = total.value / sum;
    for inertial in links.iter_mut().filter_map(|link| link.inertial.as_mut()) {
        inertial.mass = Num::computed(inertial.mass.value * factor);
        for entry in &mut inertial.tensor {
            *entry = Num::computed(entry.value * factor);
        }
    }
    Some(factor)
}
