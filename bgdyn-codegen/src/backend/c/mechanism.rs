//! The files of a mechanism: its functions, and those of its positions.

use super::context::ModelContext;
use super::files::{CFiles, comment, lines_of};
use super::function::{CFunction, definition, signature, written_functions};
use super::positions::position_functions;
use super::style::Style;
use super::tables::{sizes, tables};
use super::undetermined::{undetermined, undetermined_type};
use crate::function::Function;
use crate::method::{Entries, Method, ParameterSet, Shape};
use crate::model::Model;
use crate::plan::{Naming, summary_of, unread};

/// Returns what the files of a mechanism have.
pub(super) fn mechanism_files<'a>(model: &'a Model, style: &Style) -> CFiles<'a> {
    let naming = Naming::of_model(model);
    let context = ModelContext::new(model, style, &naming);
    let (mut prototypes, mut functions) = (Vec::new(), String::new());
    for function in written_functions(&model.functions, &context) {
        let about = documentation(function, &context);
        prototypes.extend(about.iter().cloned());
        prototypes.extend([format!("{};", signature(function, &context)), String::new()]);
        let CFunction { blocks, whole } = definition(function, &context);
        functions += &(blocks + &lines_of(about) + &whole);
    }
    let mut types = undetermined_type(&context);
    for bundle in &model.bundles {
        let Some(bundle) = super::bundle::bundle(bundle, &context) else {
            continue;
        };
        types.extend(bundle.structure);
        prototypes.extend(bundle.prototype);
        functions += &bundle.definition;
    }
    for function in position_functions(&context) {
        prototypes.extend(function.prototype());
        functions += &function.definition();
    }
    CFiles {
        title: format!("Dynamics of `{}`", model.mechanism.name()),
        description: model.mechanism.description().unwrap_or_default(),
        sizes: sizes(&context),
        types,
        tables: tables(&context),
        parameters: model.mechanism.parameters(),
        prototypes,
        functions,
    }
}

/// Returns the documentation of a function.
fn documentation(function: &Function, context: &ModelContext<'_>) -> Vec<String> {
    let (method, model) = (function.method, context.model);
    let mut lines = vec![
        with_tables(&summary_of(method, model), context.style),
        format!("Units: {}.", method.units()),
        format!(
            "Operations: {} ({}).",
            function.operations(),
            function.formulation
        ),
    ];
    let unread = unread(function, model);
    if !unread.is_empty() {
        lines.push(format!("Does not read: {}.", unread.join(", ")));
    }
    lines.extend(result_order(function.shape()).map(String::from));
    if method.has_loads() && !undetermined(context).is_empty() {
        lines.push(format!(
            "Loads along those of {} are left out, and not determined.",
            context.style.global("undetermined_loads")
        ));
    }
    if function.shape().checked() {
        lines.extend(causes(function, context));
    }
    comment(&lines)
}

/// Returns a sentence with the tables of C in place of the constants of Rust.
fn with_tables(sentence: &str, style: &Style) -> String {
    const TABLES: [(&str, &str); 7] = [
        ("[`CONSTRAINT_NAMES`]", "constraint_names"),
        ("[`REACTION_NAMES`]", "reaction_names"),
        ("[`LINK_NAMES`]", "link_names"),
        ("[`BODY_NAMES`]", "body_names"),
        ("[`BASE_PARAMETERS`]", "base_parameter_names"),
        ("[`ACTUATED`]", "actuated_names"),
        ("[`CONTACT_NAMES`]", "contact_names"),
    ];
    let replaced = |text: String, (constant, table): &(&str, &str)| {
        text.replace(constant, &format!("`{}`", style.global(table)))
    };
    TABLES.iter().fold(sentence.to_string(), replaced)
}

/// Describes the order of a result that consists of several parts.
fn result_order(shape: Shape) -> Option<&'static str> {
    Some(match shape {
        Shape::SlopesByTree => {
            "Result: the NV x NT matrix by positions, along the velocities of the open tree; then the NV x NV matrix by v."
        }
        Shape::CheckedSlopesByTree => {
            "Result: the NV x NT matrix by positions, along the velocities of the open tree; then those by v and by tau."
        }
        Shape::VectorTriple | Shape::Checked(Entries::VectorTriple) => {
            "Result: NV numbers by positions, NV by v, NV by the third argument."
        }
        Shape::Checked(Entries::TaskColumns) => "Result: NV x 6, row by row.",
        Shape::Checked(Entries::Columns(_)) => {
            "Result: NV rows, columns for x, y and n of each contact, row by row."
        }
        Shape::Rows(_) => "Result: rows for x, y and n of each contact, row by row; NV columns.",
        Shape::Poses(_) => {
            "Result: for each contact the rotation, row by row, then the contact point."
        }
        Shape::CheckedTreeAndRows => "Result: NT accelerations, then NC multipliers.",
        Shape::TreeMatrix => "Result: NT x NV.",
        Shape::RowMatrix => "Result: NC x NT.",
        Shape::FourSquares => {
            "Result: four NV x NV matrices, by q and q, by q and v, by v and v, by a and q."
        }
        Shape::FourCubes => {
            "Result: NV x NV matrices, one for each effort, by q and q; then those by q and v, by v and v, by a and q."
        }
        Shape::Checked(Entries::ParameterColumns(ParameterSet::Base)) => {
            "Result: NV x NBP, row by row."
        }
        Shape::Checked(Entries::ParameterColumns(_)) => {
            "Result: NV rows, a column for each parameter, row by row."
        }
        Shape::ParameterColumns(ParameterSet::Bodies) => "Result: NV x 10 NB, row by row.",
        Shape::ParameterColumns(ParameterSet::Payload) => "Result: NV x 10, row by row.",
        Shape::ParameterColumns(ParameterSet::Base) => "Result: NV x NBP, row by row.",
        Shape::CheckedWrenches => {
            "Result: for each loop and contact a force, then a moment, each x, y, z; axes as in docs/methods.md."
        }
        Shape::LinkWrenches => {
            "Result: for each link a force, then a moment, each x, y, z; axes as in docs/methods.md."
        }
        _ => return None,
    })
}

/// Describes what a function returns that may have no result.
fn causes(function: &Function, context: &ModelContext<'_>) -> Vec<String> {
    let method = function.method;
    let names = match method {
        _ if method.inverts_task() => "operational_pivot_names",
        _ if context.model.bond_graph.closed.is_none() => {
            return [
                "Returns 0; the number, from 1, of the joint whose pivot vanishes where the mass matrix is singular;",
                "or -1 where the result is not finite.",
            ]
            .map(String::from)
            .to_vec();
        }
        Method::ActuatedInverse(_) => "actuated_pivot_names",
        method if method.of_tree() => "tree_pivot_names",
        _ => "pivot_names",
    };
    let what = match method {
        _ if method.inverts_task() => {
            "a joint whose pivot vanishes where the mass matrix is singular, or a direction in which the frame cannot be accelerated"
        }
        Method::ActuatedInverse(_) => "a joint that does not follow the actuated ones",
        _ => "a joint whose pivot vanishes where the mass matrix is singular",
    };
    vec![
        format!(
            "Returns 0; the number, from 1, of the cause among {}: {what},",
            context.style.global(names)
        ),
        match context.model.bond_graph.closed {
            Some(_) => "or a loop or contact at a singular position or beyond one; or -1 where the result is not finite.",
            None => "or -1 where the result is not finite.",
        }
        .into(),
    ]
}
