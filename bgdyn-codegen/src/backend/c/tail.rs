//! What follows the blocks of a function in C: loops over columns, tables of inner products, stores.

use super::block::BlockText;
use super::context::FunctionContext;
use super::result::{CheckedValues, FlatResult, element};
use super::style::Style;
use crate::column_loop::ResultSource;
use crate::expr::Signed;
use crate::function::Function;
use crate::plan::{ColumnPlan, LoopArrays, ProductPlan, ProductTable};

/// What loops over columns read, and the code around them.
#[derive(Clone, Copy)]
pub(super) struct BeforeLoops<'a> {
    /// The results of the blocks.
    pub(super) values: &'a [String],
    /// The names in the code around the loops.
    pub(super) names: &'a [&'a str],
}

/// Returns the stores of values at their destinations.
pub(super) fn stores(values: &[String], flat: &FlatResult) -> Vec<String> {
    let store = |(value, destinations): (&String, &Vec<usize>)| {
        let lines = destinations
            .iter()
            .map(|&k| format!("{} = {value};", element(&flat.fields, k)));
        lines.collect::<Vec<_>>()
    };
    values
        .iter()
        .zip(&flat.destinations)
        .flat_map(store)
        .collect()
}

/// Returns an array of the outputs that must be finite, where they are no elements of the result.
pub(super) fn checked(values: &[String], flat: &FlatResult, style: &Style) -> Vec<String> {
    let CheckedValues::Outputs(outputs) = &flat.checked else {
        return Vec::new();
    };
    if outputs.is_empty() {
        return Vec::new();
    }
    let (real, count) = (style.real(), outputs.len());
    let all: Vec<&str> = outputs.iter().map(|&k| values[k].as_str()).collect();
    let all = all.join(", ");
    vec![format!("const {real} checked[{count}] = {{{all}}};")]
}

/// Returns the loops over columns, and the stores of the result.
pub(super) fn columns(
    function: &Function,
    loops: &[ColumnPlan<'_>],
    stage: BeforeLoops<'_>,
    flat: &FlatResult,
    context: &FunctionContext<'_>,
) -> Vec<String> {
    let groups = loops.iter().enumerate();
    let mut lines: Vec<String> = groups
        .flat_map(|(k, plan)| column_group(function, plan, LoopArrays::of(k), stage, context))
        .collect();
    let value = |part: &ResultSource| match *part {
        ResultSource::Stage(k) => stage.values[k].clone(),
        ResultSource::Column { group, column, row } => {
            format!("{}[{row}][{column}]", LoopArrays::of(group).found)
        }
    };
    let parts = function.loops.iter().flat_map(|loops| &loops.parts);
    let values: Vec<String> = parts.map(value).collect();
    lines.extend(checked(&values, flat, context.style));
    lines.extend(stores(&values, flat));
    lines
}

fn column_group(
    function: &Function,
    plan: &ColumnPlan<'_>,
    arrays: LoopArrays,
    stage: BeforeLoops<'_>,
    context: &FunctionContext<'_>,
) -> Vec<String> {
    let (real, group) = (context.style.real(), plan.group);
    let (count, height) = (group.own.len(), plan.column.outputs.len());
    let mut lines =
        vec!["/* the same for each column: row by row what it reads, and its results */".into()];
    if !group.shared.is_empty() {
        let values = group.shared.iter().map(|&k| stage.values[k].clone());
        let values: Vec<String> = values.collect();
        let (name, values) = (&arrays.shared, braced(&values));
        lines.push(format!(
            "const {real} {name}[{}] = {values};",
            group.shared.len()
        ));
    }
    let rows = plan.own_rows();
    if !rows.is_empty() {
        let row = |row: &Vec<usize>| {
            braced(
                &row.iter()
                    .map(|&k| stage.values[k].clone())
                    .collect::<Vec<_>>(),
            )
        };
        let values: Vec<String> = rows.iter().map(row).collect();
        let (name, values) = (&arrays.own, braced(&values));
        lines.push(format!(
            "const {real} {name}[{}][{count}] = {values};",
            rows.len()
        ));
    }
    lines.push(format!("{real} {}[{height}][{count}];", arrays.found));
    lines.push(format!("for (int c = 0; c < {count}; ++c) {{"));
    let found = arrays.found.clone();
    let (style, naming) = (context.style, context.naming);
    let mut text = BlockText::within(&plan.column, function, style, naming, stage.names);
    text.arrays = Some(arrays);
    lines.extend(text.lines().into_iter().map(|line| format!("    {line}")));
    for (row, &output) in plan.column.outputs.iter().enumerate() {
        lines.push(format!("    {found}[{row}][c] = {};", text.value(output)));
    }
    lines.push("}".into());
    lines
}

/// Returns a matrix of inner products, with the block before it.
pub(super) fn products(
    function: &Function,
    plan: &ProductPlan<'_>,
    context: &FunctionContext<'_>,
) -> Vec<String> {
    let text = BlockText::new(&plan.block, function, context.style, context.naming);
    let mut lines = text.lines();
    for ((row, column), value) in plan.entries() {
        let value = text.value(value);
        lines.push(format!("result[{}] = {value};", row * context.nv + column));
        if row != column {
            lines.push(format!("result[{}] = {value};", column * context.nv + row));
        }
    }
    for (number, table) in plan.tables.iter().enumerate() {
        lines.extend(table_lines(&text, table, number, context));
    }
    lines
}

/// Returns the loops that compute the entries of a table: a vector for each run, the rows' vectors component by
/// component.
fn table_lines(
    text: &BlockText<'_>,
    table: &ProductTable,
    number: usize,
    context: &FunctionContext<'_>,
) -> Vec<String> {
    let (real, n) = (context.style.real(), context.style.constant("NV"));
    let zero = context.style.number(0.0);
    let component = |values: &Vec<Option<Signed>>| {
        let value = |value: &Option<_>| value.map_or_else(|| zero.clone(), |e| text.value(e));
        braced(&values.iter().map(value).collect::<Vec<_>>())
    };
    let rows: Vec<String> = table.components.iter().map(component).collect();
    let column =
        |values: &Vec<_>| braced(&values.iter().map(|&e| text.value(e)).collect::<Vec<_>>());
    let columns: Vec<String> = table.columns.iter().map(column).collect();
    let run = |run: &[usize; 3]| braced(&run.map(|k| k.to_string()));
    let runs: Vec<String> = table.runs.iter().map(run).collect();
    let (terms, height, count) = (
        rows.len(),
        table.components.first().map_or(0, Vec::len),
        runs.len(),
    );
    let multiply = context.style.global("mul_add");
    vec![
        format!(
            "const {real} rows{number}[{terms}][{height}] = {};",
            braced(&rows)
        ),
        format!(
            "const {real} columns{number}[{count}][{terms}] = {};",
            braced(&columns)
        ),
        format!("const int runs{number}[{count}][3] = {};", braced(&runs)),
        format!("for (int k = 0; k < {count}; ++k) {{"),
        format!("    const int column = runs{number}[k][0];"),
        format!("    for (int i = runs{number}[k][1]; i < runs{number}[k][2]; ++i) {{"),
        format!("        {real} sum = rows{number}[0][i] * columns{number}[k][0];"),
        format!("        for (int c = 1; c < {terms}; ++c) {{"),
        format!("            sum = {multiply}(rows{number}[c][i], columns{number}[k][c], sum);"),
        "        }".into(),
        format!("        result[i * {n} + column] = sum;"),
        format!("        result[column * {n} + i] = sum;"),
        "    }".into(),
        "}".into(),
    ]
}

fn braced(values: &[String]) -> String {
    format!("{{{}}}", values.join(", "))
}
