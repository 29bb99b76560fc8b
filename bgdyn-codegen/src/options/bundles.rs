//! The bundles that are asked for.

use std::collections::BTreeSet;

use super::unknown::{OptionName, UnknownName};
use crate::bond_graph::BondGraph;
use crate::method::Method;
use crate::name::is_identifier;

/// A bundle in [`Options::bundles`](super::Options::bundles): `control = [mass_matrix, bias, pose_tool]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BundleOption {
    /// The name of its method; that of the struct with its results in UpperCamelCase.
    pub name: String,
    /// The names of its methods.
    pub methods: Vec<String>,
}

/// Names that other functions of a generated struct have.
const TAKEN: [&str; 5] = [
    "assemble",
    "close",
    "close_polygons",
    "default",
    "set_base_motion",
];

/// Returns the name and the methods of each bundle; adds what is wrong with them to `unknown`.
pub(super) fn selected(
    bundles: &[BundleOption],
    graph: &BondGraph,
    unknown: &mut Vec<UnknownName>,
) -> Vec<(String, Vec<Method>)> {
    let mut selected = Vec::new();
    let mut names = BTreeSet::new();
    for (k, bundle) in bundles.iter().enumerate() {
        let mut refuse = |index: usize, message: String| {
            unknown.push(UnknownName {
                option: OptionName::Bundle(k),
                index,
                message,
            });
        };
        if let Some(message) = wrong_name(&bundle.name, graph, !names.insert(&bundle.name)) {
            refuse(0, message);
        }
        let mut methods: Vec<Method> = Vec::new();
        for (index, name) in bundle.methods.iter().enumerate() {
            match of_bundle(graph, name, &methods) {
                Ok(method) => methods.push(method),
                Err(message) => refuse(index + 1, message),
            }
        }
        if bundle.methods.is_empty() {
            refuse(
                0,
                format!(
                    "the bundle `{}` has no methods: write `{} = [mass_matrix, bias]`",
                    bundle.name, bundle.name
                ),
            );
        }
        selected.push((bundle.name.clone(), methods));
    }
    selected
}

/// Returns why a bundle cannot have this name.
fn wrong_name(name: &str, graph: &BondGraph, is_repeated: bool) -> Option<String> {
    if !is_identifier(name) {
        return Some(format!(
            "`{name}` cannot name a bundle: write it in snake_case"
        ));
    }
    if is_repeated {
        return Some(format!("two bundles are named `{name}`"));
    }
    let closed = graph.closed.as_deref();
    let possible = Method::possible_of(graph).into_iter();
    let is_method = possible
        .map(|m| m.name_in(closed, &graph.sites))
        .any(|taken| taken == name);
    (is_method || TAKEN.contains(&name)).then(|| {
        format!("`{name}` cannot name a bundle: a function of the mechanism has this name")
    })
}

/// Returns the method with this name, if it can be a part of the bundle after `others`.
fn of_bundle(graph: &BondGraph, name: &str, others: &[Method]) -> Result<Method, String> {
    let method = Method::named(graph, name)?;
    if others.contains(&method) {
        return Err(format!("`{name}` is given twice"));
    }
    let together: Vec<Method> = others.iter().copied().chain([method]).collect();
    if !method.may_be_bundled() || Method::bundle(&together).is_none() {
        return Err(format!(
            "`{name}` cannot be in a bundle: it takes velocities or efforts of the open tree, or its error names other joints; call it by itself"
        ));
    }
    Ok(method)
}
