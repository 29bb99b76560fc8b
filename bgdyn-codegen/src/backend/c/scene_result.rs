//! Where the outputs of a scene's function are in its flat result.
//!
//! State, rates and momenta have the order of Rust's vectors: positions, velocities, first-order states. The rate of a
//! position is the velocity of its coordinate, or an output of its own after the others.

use std::ops::Range;

use crate::layout::StateLayout;
use crate::method::{Argument, SceneFunction};

/// The flat result of a scene's function.
pub(super) struct SceneResult {
    /// The destination of each output.
    pub(super) destinations: Vec<usize>,
    /// Other elements: their destinations and values in C.
    pub(super) others: Vec<(usize, String)>,
    /// Number of elements in C, as a sum of products of sizes: "N * N + N".
    pub(super) size: &'static str,
    /// The elements that must be finite.
    pub(super) checked: Range<usize>,
}

impl SceneResult {
    /// Returns the result of a function with this number of outputs.
    pub(super) fn new(role: SceneFunction, layout: &StateLayout, outputs: usize) -> Self {
        let (nq, nv, nx) = (layout.nq(), layout.nv(), layout.nx());
        let rates = nv + nx;
        let in_order = |size| SceneResult {
            destinations: (0..outputs).collect(),
            others: Vec::new(),
            size,
            checked: 0..0,
        };
        let kept = |argument: Argument, destinations: Range<usize>| -> Vec<(usize, String)> {
            let value = |k: usize| (k, format!("{}[{k}]", argument.name()));
            destinations.map(value).collect()
        };
        match role {
            SceneFunction::Derivative => {
                let velocity = |j: usize| format!("{}[{}]", Argument::State.name(), nq + j);
                let positions = layout.positions.iter().enumerate();
                let own = positions
                    .filter_map(|(p, position)| position.coordinate.map(|j| (p, velocity(j))));
                SceneResult {
                    others: own.collect(),
                    destinations: (nq..nq + rates).chain(coupled(layout)).collect(),
                    size: "N",
                    checked: nq..nq + rates,
                }
            }
            SceneFunction::Jacobian => jacobian(layout),
            SceneFunction::InputJacobian => input_jacobian(layout),
            SceneFunction::ToCanonical => SceneResult {
                destinations: (nq..nq + nv).collect(),
                others: [0..nq, nq + nv..nq + rates]
                    .into_iter()
                    .flat_map(|destinations| kept(Argument::State, destinations))
                    .collect(),
                ..in_order("N")
            },
            SceneFunction::FromCanonical => SceneResult {
                destinations: (nq..nq + nv).collect(),
                others: [0..nq, nq + nv..nq + rates]
                    .into_iter()
                    .flat_map(|destinations| kept(Argument::Canonical, destinations))
                    .collect(),
                checked: nq..nq + nv,
                ..in_order("N")
            },
            SceneFunction::CanonicalRates => SceneResult {
                checked: 0..outputs,
                ..in_order("N")
            },
            SceneFunction::PositionRates | SceneFunction::ClosingStep => in_order("NQ"),
            SceneFunction::Inverse => in_order("NV"),
            SceneFunction::Inputs => in_order("NU"),
            SceneFunction::Events => in_order("NE"),
            SceneFunction::Contacts => in_order("4 * NM"),
            SceneFunction::RigidContactStates => in_order("6 * NK"),
            SceneFunction::RigidContactMaps => in_order("6 * NK * NV"),
            SceneFunction::RigidContactBiases => in_order("3 * NK"),
            SceneFunction::Power => in_order("3 * NB"),
            SceneFunction::Energy => in_order("NB"),
            SceneFunction::Outputs => in_order("NY"),
        }
    }
}

/// Returns the positions whose rates are outputs of their own.
fn coupled(layout: &StateLayout) -> impl Iterator<Item = usize> + Clone {
    let positions = layout.positions.iter().enumerate();
    positions.filter_map(|(p, position)| position.coordinate.is_none().then_some(p))
}

/// The matrix of a rate's row by the inputs' columns. The outputs are columns.
fn input_jacobian(layout: &StateLayout) -> SceneResult {
    let (nq, inputs) = (layout.nq(), layout.inputs.len());
    let n = nq + layout.nv() + layout.nx();
    let rows: Vec<usize> = (nq..n).chain(coupled(layout)).collect();
    let of_column = |column: usize| rows.iter().map(move |&row| row * inputs + column);
    let positions = layout.positions.iter().enumerate();
    let own = positions.filter(|(_, position)| position.coordinate.is_some());
    let zeros =
        |(p, _): (usize, _)| (0..inputs).map(move |column| (p * inputs + column, "0".into()));
    SceneResult {
        destinations: (0..inputs).flat_map(of_column).collect(),
        others: own.flat_map(zeros).collect(),
        size: "N * NU",
        checked: 0..n * inputs,
    }
}

/// The matrix of a rate's row by the state's columns, then the column of time. The outputs are columns.
fn jacobian(layout: &StateLayout) -> SceneResult {
    let nq = layout.nq();
    let rates = layout.nv() + layout.nx();
    let n = nq + rates;
    let destination = |row: usize, column: usize| match column < n {
        true => row * n + column,
        false => n * n + row,
    };
    let rows: Vec<usize> = (nq..n).chain(coupled(layout)).collect();
    let of_column = |column: usize| rows.iter().map(move |&row| destination(row, column));
    let positions = layout.positions.iter().enumerate();
    let of_position = |(p, j): (usize, usize)| {
        let slope = move |column: usize| {
            let value = if column == nq + j { "1" } else { "0" };
            (destination(p, column), value.to_string())
        };
        (0..=n).map(slope)
    };
    let own = positions.filter_map(|(p, position)| Some((p, position.coordinate?)));
    SceneResult {
        destinations: (0..=n).flat_map(of_column).collect(),
        others: own.flat_map(of_position).collect(),
        size: "N * N + N",
        checked: 0..n * n + n,
    }
}
