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

/// Names that functions of positions have, and types in generated C.
const TAKEN: [&str; 14] = [
    "assemble",
    "close",
    "close_polygons",
    "default",
    "difference",
    "integrate",
    "neutral",
    "normalize",
    "parameters",
    "parameters_default",
    "position_rates",
    "sample",
    "set_base_motion",
    "undetermined",
];

/// Endings of the names of tables in generated C, and of functions of single joints.
const ENDINGS: [&str; 5] = ["_names", "_limits", "_loads", "_pose", "_rotation"];

/// Returns the name and the methods of each bundle of the mechanism of this name.
///
/// # Errors
/// All that is wrong with them.
pub(super) fn selected(
    bundles: &[BundleOption],
    graph: &BondGraph,
    mechanism: &str,
) -> Result<Vec<(String, Vec<Method>)>, Vec<UnknownName>> {
    let (mut selected, mut unknown) = (Vec::new(), Vec::new());
    let mut names = BTreeSet::from([mechanism]);
    for (k, bundle) in bundles.iter().enumerate() {
        let mut refuse = |index: usize, message: String| {
            unknown.push(UnknownName {
                option: OptionName::Bundle(k),
                index,
                message,
            });
        };
        let name = bundle.name.as_str();
        if let Some(why) = wrong_name(name, graph, names.replace(name).is_some()) {
            refuse(0, format!("`{name}` cannot name a bundle: {why}"));
        }
        let mut methods: Vec<Method> = Vec::new();
        for (index, name) in bundle.methods.iter().enumerate() {
            match of_bundle(graph, name, &methods) {
                Ok(method) => methods.push(method),
                Err(message) => refuse(index + 1, message),
            }
        }
        if bundle.methods.is_empty() {
            let example = format!("write `{name} = [mass_matrix, bias]`");
            refuse(0, format!("the bundle `{name}` has no methods: {example}"));
        }
        selected.push((bundle.name.clone(), methods));
    }
    match unknown.is_empty() {
        true => Ok(selected),
        false => Err(unknown),
    }
}

/// Returns why a bundle cannot have this name.
fn wrong_name(name: &str, graph: &BondGraph, is_repeated: bool) -> Option<String> {
    if !is_identifier(name) {
        return Some("write it in snake_case".into());
    }
    if is_repeated {
        return Some("the mechanism, or another bundle, has this name".into());
    }
    let closed = graph.closed.as_deref();
    let possible = Method::possible_of(graph).into_iter();
    let mut names = possible.map(|m| m.name_in(closed, &graph.sites));
    if TAKEN.contains(&name) || names.any(|taken| taken == name) {
        return Some("a function of the mechanism has this name".into());
    }
    let ending = ENDINGS.iter().find(|ending| name.ends_with(**ending))?;
    Some(format!(
        "names with `{ending}` are those of tables and of functions of joints"
    ))
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
            "`{name}` cannot be in this bundle: it has arguments that a bundle does not have together with those of the other methods, or its error names other joints; call it by itself"
        ));
    }
    Ok(method)
}
