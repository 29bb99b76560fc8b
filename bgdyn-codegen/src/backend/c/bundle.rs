//! Bundles in C: the struct with the results of several methods, and the function that fills it.

use super::context::ModelContext;
use super::files::{comment, lines_of};
use super::function::{CFunction, definition_with, signature};
use super::result::FlatResult;
use crate::model::Bundle;
use crate::plan::summary_of;

/// A bundle in C.
pub(super) struct CBundle {
    /// The struct with its documentation.
    pub(super) structure: Vec<String>,
    /// The prototype with its documentation.
    pub(super) prototype: Vec<String>,
    /// The definition with its documentation.
    pub(super) definition: String,
}

/// Returns the bundle in C; `None` if none of its parts has a result.
pub(super) fn bundle(bundle: &Bundle, context: &ModelContext<'_>) -> Option<CBundle> {
    let flat = FlatResult::of_bundle(bundle, context);
    if flat.fields.is_empty() {
        return None;
    }
    let function = &bundle.function;
    let name = context.style.global(function.name());
    let mut structure = comment(&[format!("Results of `{name}`.")]);
    structure.push(format!("struct {name} {{"));
    for field in &flat.fields {
        let part = bundle.parts.iter().find(|part| part.name == field.name);
        let about = part.map(|part| summary_of(part.method, context.model));
        let units = part.map(|part| format!("Units: {}.", part.method.units()));
        let about: Vec<String> = about.into_iter().chain(units).collect();
        structure.extend(
            comment(&about)
                .into_iter()
                .map(|line| format!("    {line}")),
        );
        let real = context.style.real();
        structure.push(format!("    {real} {}[{}];", field.name, field.size));
    }
    structure.extend(["};".into(), String::new()]);
    let about = documentation(bundle);
    let mut prototype = about.clone();
    prototype.extend([format!("{};", signature(function, context)), String::new()]);
    let CFunction { blocks, whole } = definition_with(function, &flat, context);
    Some(CBundle {
        structure,
        prototype,
        definition: blocks + &lines_of(about) + &whole,
    })
}

fn documentation(bundle: &Bundle) -> Vec<String> {
    let function = &bundle.function;
    let parts: Vec<&str> = bundle.parts.iter().map(|part| part.name.as_str()).collect();
    let mut lines = vec![
        format!("{} in one call.", parts.join(", ")),
        format!(
            "Operations: {} ({}).",
            function.operations(),
            function.formulation
        ),
    ];
    if function.shape().checked() {
        lines.push("Returns what those of its methods return that return a number.".into());
    }
    comment(&lines)
}
