//! The source file: helpers, names, default parameters, functions.

use super::context::FunctionContext;
use super::function::{CFunction, definition, written_functions};
use super::header::{beginning, comment, documentation};
use super::helpers::helpers;
use super::positions::{PositionFunction, position_functions};
use super::style::Style;
use super::tables::tables;
use super::words::field;
use crate::model::Model;
use crate::plan::Naming;

/// Returns the text of the source file.
pub(super) fn source(model: &Model, style: &Style) -> String {
    let naming = Naming::of_model(model);
    let context = FunctionContext::new(model, style, &naming);
    let function = |f| {
        let CFunction { blocks, whole } = definition(f, &context);
        blocks + &lines_of(documentation(f, &context)) + &whole
    };
    let functions: String = written_functions(&context).map(function).collect();
    let positions = position_functions(&context).into_iter();
    let functions: String = functions + &positions.map(position_function).collect::<String>();
    let mut lines = beginning(model, style);
    lines.extend([
        format!("#include \"{}.h\"", style.file),
        String::new(),
        "#include <math.h>".into(),
        "#include <stdint.h>".into(),
        "#include <string.h>".into(),
        String::new(),
        "#ifdef __FAST_MATH__".into(),
        "#error \"-ffast-math removes the rounding errors that the sines add: compile this file without it\"".into(),
        "#endif".into(),
        String::new(),
    ]);
    for table in tables(&context) {
        let elements = table.elements.join(", ");
        lines.push(format!("{} = {{{elements}}};\n", table.declaration));
    }
    lines.extend(default_parameters(model, style));
    let text = lines_of(lines) + &helpers(&functions, style) + &functions;
    text.trim_end().to_string() + "\n"
}

fn lines_of(lines: Vec<String>) -> String {
    lines.into_iter().map(|line| line + "\n").collect()
}

fn position_function(function: PositionFunction) -> String {
    let PositionFunction {
        about,
        signature,
        body,
    } = function;
    let body: String = body.iter().map(|line| format!("    {line}\n")).collect();
    lines_of(comment(&about)) + &format!("{signature}\n{{\n{body}}}\n\n")
}

fn default_parameters(model: &Model, style: &Style) -> Vec<String> {
    let parameters = model.mechanism.parameters();
    if parameters.is_empty() {
        return Vec::new();
    }
    let name = style.global("parameters");
    let mut lines = vec![
        format!("struct {name} {name}_default(void)"),
        "{".into(),
        format!("    struct {name} parameters;"),
    ];
    for parameter in parameters {
        let (field, value) = (
            field(&parameter.name),
            style.number(parameter.default.to_f64()),
        );
        lines.push(format!("    parameters.{field} = {value};"));
    }
    lines.extend(["    return parameters;".into(), "}".into(), String::new()]);
    lines
}
