//! A function in C: its signature, its body, and its blocks.

use super::block::BlockText;
use super::context::FunctionContext;
use super::parameters::{CParameter, block_parameters, parameters};
use super::result::{CheckedValues, FlatResult, element};
use super::style::Style;
use super::tail::{self, BeforeLoops};
use crate::function::Function;
use crate::method::Method;
use crate::plan::{BlockPlan, FunctionPlan, PlanLimits, Tail, block_name};

/// What the plans of C functions keep to: results are a caller's array, so that every output is stored when it is
/// known.
pub(super) const LIMITS: PlanLimits = PlanLimits {
    // `sin_cos_all` has registers for so many.
    sines: 8,
    store_from: 0,
};

/// Returns the functions that have a result: without joints there are no efforts, and C has no empty arrays.
pub(super) fn written_functions<'a>(
    functions: &'a [Function],
    context: &FunctionContext<'_>,
) -> impl Iterator<Item = &'a Function> {
    let has_result = |function: &&Function| !FlatResult::new(function, context).is_empty();
    functions.iter().filter(has_result)
}

/// Returns the signature of a function, without a semicolon.
pub(super) fn signature(function: &Function, context: &FunctionContext<'_>) -> String {
    let style = context.style;
    let kind = if function.shape().checked() {
        "int"
    } else {
        "void"
    };
    let name = style.global(function.name());
    let parameters = parameters(function, context.naming, style);
    let result = match function.method {
        Method::Bundle { .. } => format!("struct {name} *result"),
        _ => {
            let size = FlatResult::new(function, context).size;
            format!("{} result[{size}]", style.real())
        }
    };
    let all = declarations(&parameters, [result]);
    format!("{kind} {name}({all})")
}

/// A function in C.
pub(super) struct CFunction {
    /// The functions of its blocks, if it has several.
    pub(super) blocks: String,
    /// The function.
    pub(super) whole: String,
}

/// Returns the definitions of a function and of its blocks.
pub(super) fn definition(function: &Function, context: &FunctionContext<'_>) -> CFunction {
    definition_with(function, &FlatResult::new(function, context), context)
}

/// Returns the definitions of a function with this result and of its blocks.
pub(super) fn definition_with(
    function: &Function,
    flat: &FlatResult,
    context: &FunctionContext<'_>,
) -> CFunction {
    let style = context.style;
    let plan = FunctionPlan::new(function, Some(flat.elements()), &LIMITS);
    let mut blocks = String::new();
    let mut lines = Vec::new();
    let unread = parameters(function, context.naming, style);
    let unread = unread.into_iter().filter(|p| !p.is_read);
    lines.extend(unread.map(|p| format!("(void){};", p.name)));
    if plan.refuses() {
        lines.push("int refused = 0;".into());
    }
    match plan.blocks.as_slice() {
        [block] if function.blocks.len() == 1 => {
            let mut block = BlockText::new(block, function, style, context.naming);
            block.others = &flat.others;
            block.fields = &flat.fields;
            lines.extend(whole(&plan, block, flat, context));
        }
        _ => {
            for b in 0..plan.blocks.len() {
                let (definition, call) = separate_block(&plan, b, context);
                blocks += &definition;
                lines.extend(call);
            }
            lines.extend(flat.others.iter().cloned());
            lines.extend(after_blocks(&plan, flat, context));
        }
    }
    if function.shape().checked() {
        lines.push(returned(&plan, flat, style));
    }
    let (signature, body) = (signature(function, context), indented(&lines));
    CFunction {
        blocks,
        whole: format!("{signature}\n{{\n{body}}}\n\n"),
    }
}

/// Returns the body of a function in one block.
fn whole(
    plan: &FunctionPlan<'_>,
    block: BlockText<'_>,
    flat: &FlatResult,
    context: &FunctionContext<'_>,
) -> Vec<String> {
    let mut lines = block.lines();
    let outputs = block.listing.block.outputs.iter();
    let stage: Vec<String> = outputs.map(|&e| block.value(e)).collect();
    if let Tail::Columns(loops) = &plan.tail {
        let outer: Vec<&str> = block.listing.all_names().collect();
        let stage = BeforeLoops {
            values: &stage,
            names: &outer,
        };
        lines.extend(tail::columns(plan.function, loops, stage, flat, context));
    } else {
        lines.extend(tail::checked(&stage, flat, context.style));
    }
    lines
}

/// Returns what follows the calls of the blocks.
fn after_blocks(
    plan: &FunctionPlan<'_>,
    flat: &FlatResult,
    context: &FunctionContext<'_>,
) -> Vec<String> {
    let last = block_name(plan.blocks.len() - 1);
    let count = plan.blocks.last().map_or(0, |block| block.outputs.len());
    let stage: Vec<String> = (0..count).map(|k| format!("{last}[{k}]")).collect();
    match &plan.tail {
        Tail::Products(products) => tail::products(plan.function, products, context),
        Tail::Columns(loops) => {
            let stage = BeforeLoops {
                values: &stage,
                names: &[],
            };
            tail::columns(plan.function, loops, stage, flat, context)
        }
        Tail::Nothing => {
            let mut lines = tail::stores(&stage, flat);
            lines.extend(tail::checked(&stage, flat, context.style));
            lines
        }
    }
}

/// Returns the statement that returns 0, or why there is no result.
fn returned(plan: &FunctionPlan<'_>, flat: &FlatResult, style: &Style) -> String {
    let (array, count) = match &flat.checked {
        CheckedValues::Elements(range) if range.start == 0 && flat.fields.is_empty() => {
            ("result".into(), range.len())
        }
        CheckedValues::Elements(range) => {
            let first = element(&flat.fields, range.start);
            (format!("&{first}"), range.len())
        }
        CheckedValues::Outputs(outputs) => ("checked".to_string(), outputs.len()),
    };
    let refused = if plan.refuses() { "refused" } else { "0" };
    format!(
        "return {}({refused}, {array}, {count});",
        style.global("status")
    )
}

/// Returns the definition of a block as a function, and the lines that call it.
fn separate_block(
    plan: &FunctionPlan<'_>,
    b: usize,
    context: &FunctionContext<'_>,
) -> (String, Vec<String>) {
    let (style, block): (_, &BlockPlan<'_>) = (context.style, &plan.blocks[b]);
    let mut text = BlockText::new(block, plan.function, style, context.naming);
    text.separate = true;
    let parameters = block_parameters(&text.listing, &plan.blocks, context.naming, style);
    let (real, count, result) = (style.real(), block.outputs.len(), block_name(b));
    let name = style.global(&format!("{}_block_{b}", plan.function.name()));
    let refused = block.refuses.then(|| "int *refused".to_string());
    let results = [format!("{real} result[{count}]")]
        .into_iter()
        .chain(refused);
    let all = declarations(&parameters, results);
    let body = indented(&text.lines());
    let definition = format!("static void {name}({all})\n{{\n{body}}}\n\n");
    let names = parameters.iter().map(|p| p.name.clone());
    let refused = block.refuses.then(|| "&refused".to_string());
    let names: Vec<String> = names.chain([result.clone()]).chain(refused).collect();
    let lines = vec![
        format!("{real} {result}[{count}];"),
        format!("{name}({});", names.join(", ")),
    ];
    (definition, lines)
}

fn declarations(parameters: &[CParameter], others: impl IntoIterator<Item = String>) -> String {
    let declarations = parameters.iter().map(|p| p.declaration.clone());
    let all: Vec<String> = declarations.chain(others).collect();
    all.join(", ")
}

fn indented(lines: &[String]) -> String {
    lines.iter().map(|line| format!("    {line}\n")).collect()
}
