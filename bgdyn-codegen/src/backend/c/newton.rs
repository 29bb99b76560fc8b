//! Newton's method for positions that close, in C.

use bgdyn_runtime::closure::{Dependent, LARGEST, STEPS};

use super::position_function::PositionFunction;
use super::style::Style;

/// Newton's method for positions that close, in a function of the file itself.
pub(super) struct Newton<'a> {
    pub(super) style: &'a Style,
    /// The name of the function.
    pub(super) name: &'static str,
    /// Whether other loops are closed before: the function has the number of the first one that does not close as its
    /// last argument, and returns it if there is one.
    pub(super) is_last: bool,
    /// The joints that close, with the index of each velocity in a step.
    pub(super) joints: Vec<Dependent>,
    /// The index of the first loop among the causes.
    pub(super) first: usize,
    /// The name of the vector that has the positions, and its size in C.
    pub(super) argument: &'static str,
    pub(super) size: String,
    /// The statement that computes the step `change`, and its size in C.
    pub(super) step: String,
    pub(super) steps: String,
    /// The statement that moves positions by `change`; `None` where each joint that closes has one position, less its
    /// step.
    pub(super) moved: Option<String>,
    /// The declaration of the run-time parameters, with a comma.
    pub(super) parameters: String,
}

impl Newton<'_> {
    /// The function returns 0, or the number of the first loop that does not close.
    pub(super) fn function(&self) -> PositionFunction {
        let (style, real) = (self.style, self.style.real());
        let [zero, largest, one] = [0.0, LARGEST, 1.0].map(|x| style.number(x));
        let closed = style.closing_step();
        let row = |joint: &Dependent| {
            let cause = self.first + joint.closes + 1;
            format!("{{{}, {}, {cause}}}", joint.velocity, joint.position)
        };
        let rows: Vec<String> = self.joints.iter().map(row).collect();
        let (count, absolute) = (rows.len(), style.of_library("fabs"));
        let [larger, held] = ["larger", "is_held"].map(|name| style.global(name));
        let mut body = vec![
            "/* velocity, position and cause of each joint that closes */".into(),
            format!("const int joints[{count}][3] = {{{}}};", rows.join(", ")),
            format!("{real} change[{}];", self.steps),
            "int refused = 1;".into(),
            format!("for (int k = 0; refused != 0 && k < {STEPS}; ++k) {{"),
            format!("    {real} last = {zero};"),
            format!(
                "    refused = {};",
                if self.is_last { "before" } else { "0" }
            ),
            format!("    {}", self.step),
            format!("    for (int i = 0; i < {count}; ++i) {{"),
            format!("        const {real} size = {absolute}(change[joints[i][0]]);"),
            format!("        last = {larger}(last, size);"),
            format!("        (void){held}({closed} - size, joints[i][2], &refused);"),
            "    }".into(),
            format!("    const {real} scale = ({largest} < last) ? {largest} / last : {one};"),
        ];
        let back = self.step_back("change[@] * scale");
        body.extend(back.iter().map(|line| format!("    {line}")));
        body.extend(["}".into(), self.step.clone()]);
        body.extend(self.step_back("change[@]"));
        body.push("return refused;".into());
        let (name, parameters) = (style.global(self.name), &self.parameters);
        let (argument, size) = (self.argument, &self.size);
        let before = if self.is_last { ", int before" } else { "" };
        PositionFunction {
            about: Vec::new(),
            signature: format!("static int {name}({parameters}{real} {argument}[{size}]{before})"),
            body,
        }
    }

    /// Returns the statements that subtract a step from the positions; `@` is the index of a velocity in it.
    fn step_back(&self, step: &str) -> Vec<String> {
        if let Some(moved) = &self.moved {
            let step = step.replace('@', "j");
            return vec![
                format!("for (int j = 0; j < {}; ++j) {{", self.steps),
                format!("    change[j] = -({step});"),
                "}".into(),
                moved.clone(),
            ];
        }
        let (q, step) = (self.argument, step.replace('@', "joints[i][0]"));
        vec![
            format!("for (int i = 0; i < {}; ++i) {{", self.joints.len()),
            format!("    {q}[joints[i][1]] = {q}[joints[i][1]] - {step};"),
            "}".into(),
        ]
    }
}
