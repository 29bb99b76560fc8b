//! The source file: helpers, names, default parameters, functions.

use super::context::FunctionContext;
use super::function::{CFunction, definition};
use super::header::{beginning, documentation};
use super::helpers::helpers;
use super::style::Style;
use super::words::field;
use crate::backend::given::BackendError;
use crate::model::Model;
use crate::plan::Naming;

/// Returns an error for what the backend cannot write.
pub(super) fn check_supported(model: &Model) -> Result<(), BackendError> {
    let name = model.mechanism.name();
    let message = if model.mechanism.nv() == 0 {
        format!("the backend `c` writes mechanisms with moving joints: `{name}` has none")
    } else if model.bond_graph.closed.is_some() {
        format!(
            "the backend `c` does not write mechanisms with loops or wheels, such as `{name}`: use the backend `rust`"
        )
    } else {
        return Ok(());
    };
    Err(BackendError::Unsupported(message))
}

/// Returns the text of the source file.
pub(super) fn source(model: &Model, style: &Style) -> String {
    let naming = Naming::of_model(model);
    let context = FunctionContext {
        style,
        naming: &naming,
        nv: model.mechanism.nv(),
    };
    let function = |f| {
        let CFunction { blocks, whole } = definition(f, &context);
        let lines = documentation(f, model).into_iter();
        let documentation: String = lines.map(|line| line + "\n").collect();
        blocks + &documentation + &whole
    };
    let functions: String = model.functions.iter().map(function).collect();
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
    lines.push(table(
        &style.global("joint_names"),
        &style.constant("NV"),
        &naming.joints,
    ));
    lines.push(table(
        &style.global("position_names"),
        &style.constant("NQ"),
        &naming.positions,
    ));
    lines.extend(default_parameters(model, style));
    let head: String = lines.iter().map(|line| format!("{line}\n")).collect();
    let text = head + &helpers(&functions, style) + &functions;
    text.trim_end().to_string() + "\n"
}

fn table(name: &str, count: &str, names: &[&str]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    format!(
        "const char *const {name}[{count}] = {{{}}};\n",
        names.join(", ")
    )
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
