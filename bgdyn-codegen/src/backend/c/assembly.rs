//! Positions that are assembled from anywhere, by Levenberg and Marquardt's method.
//!
//! The functions are `bgdyn_runtime::closure::assemble` around `constraint_residual` and `constraint_jacobian` of the file.

use bgdyn_runtime::closure::LARGEST;
use bgdyn_runtime::closure::assembly::{ATTEMPTS, CLOSED, DAMPING};

use super::context::ModelContext;
use super::helpers::filled;
use super::parameters::of_model;
use super::position_function::PositionFunction;
use super::style::Real;
use crate::bond_graph::ClosedTree;
use crate::plan::{AssemblyConditions, BranchConditions};

/// Returns the functions, each after those that it calls.
pub(super) fn assembly_functions(
    closed: &ClosedTree,
    context: &ModelContext<'_>,
) -> Vec<PositionFunction> {
    let text = AssemblyText {
        conditions: AssemblyConditions::new(&closed.closure),
        closed,
        context,
    };
    let descend = include_str!("assembly_descend.h");
    vec![
        PositionFunction::of_definition(&text.filled(descend), Vec::new()),
        text.is_assembled(),
        text.assemble(),
    ]
}

struct AssemblyText<'a> {
    conditions: AssemblyConditions,
    closed: &'a ClosedTree,
    context: &'a ModelContext<'a>,
}

impl AssemblyText<'_> {
    /// Returns a template with what it says of this mechanism.
    fn filled(&self, template: &str) -> String {
        let (style, conditions) = (self.context.style, &self.conditions);
        let parameters = of_model(self.context.naming, style, true);
        let (declared, given) = match &parameters {
            Some(p) => (format!("{}, ", p.declaration), "parameters, "),
            None => (String::new(), ""),
        };
        let are_conditions = conditions.rows.iter().map(|row| i32::from(row.is_some()));
        let start = self.closed.closure.start.iter();
        let start = start.map(|x| style.number(x.hi()));
        let joints = conditions.joints.iter();
        let joints = joints.map(|(velocity, position)| format!("{{{velocity}, {position}}}"));
        let [(_, first), others @ ..] = ATTEMPTS;
        let first = match conditions.joints.is_empty() {
            true => ATTEMPTS.iter().map(|(_, steps)| steps).sum(),
            false => first,
        };
        let [at_first, after_success, after_failure, least] = DAMPING.map(|x| style.number(x));
        let text = template
            .replace("DECLARED ", &declared)
            .replace("GIVEN ", given)
            .replace("CONDITIONS", &list(are_conditions))
            .replace("START", &list(start))
            .replace("JOINT_COUNT", &conditions.joints.len().to_string())
            .replace("JOINTS", &list(joints))
            .replace(
                "SHARES",
                &list(others.map(|(share, _)| style.number(share))),
            )
            .replace("FIRST_STEPS", &first.to_string())
            .replace("STEPS", &list(others.map(|(_, steps)| steps)))
            .replace("DAMPING_AT_FIRST", &at_first)
            .replace("DAMPING_AFTER_SUCCESS", &after_success)
            .replace("DAMPING_AFTER_FAILURE", &after_failure)
            .replace("LEAST_DAMPING", &least)
            .replace("LONGEST_STEP", &style.number(LARGEST))
            .replace("WITHIN", &self.within());
        filled(&text, style)
    }

    /// Returns the residual after which one more step is exact to rounding.
    fn within(&self) -> String {
        let [fine, coarse] = CLOSED;
        let style = self.context.style;
        style.number(match style.real {
            Real::Double => fine,
            Real::Float => coarse,
        })
    }

    /// The function that returns whether all loops close on the branch of the mechanism.
    fn is_assembled(&self) -> PositionFunction {
        let (style, conditions) = (self.context.style, &self.conditions);
        let (real, held) = (style.real(), style.global("is_held"));
        let first = self.context.model.mechanism.nq() + 1;
        let causes = conditions.rows.iter();
        let causes = causes.map(|row| row.map_or(0, |closes| first + closes));
        let (causes, within, absolute) = (list(causes), self.within(), style.of_library("fabs"));
        let mut body = vec![
            format!("const int causes[SIZE_NC] = {{{causes}}};"),
            format!("{real} residual[SIZE_NC];"),
            "int fits = 1;".into(),
            "@_constraint_residual(GIVEN q, residual);".into(),
            "for (int i = 0; i < SIZE_NC; ++i) {".into(),
            "    if (causes[i] != 0) {".into(),
            format!(
                "        fits &= {held}({within} - {absolute}(residual[i]), causes[i], refused);"
            ),
            "    }".into(),
            "}".into(),
        ];
        if !conditions.blocks.is_empty() {
            body.push(format!("{real} jacobian[SIZE_NC * SIZE_NT];"));
            body.push("@_constraint_jacobian(GIVEN q, jacobian);".into());
        }
        for (k, block) in conditions.blocks.iter().enumerate() {
            body.extend(self.branch(k, block));
        }
        body.push("return fits;".into());
        let signature =
            format!("static int @_is_assembled(DECLARED const {real} q[SIZE_NQ], int *refused)");
        PositionFunction {
            about: Vec::new(),
            signature: self.filled(&signature),
            body: body.iter().map(|line| self.filled(line)).collect(),
        }
    }

    /// Returns the statements that check the branch of a block.
    fn branch(&self, k: usize, block: &BranchConditions) -> [String; 3] {
        // The causes of loops that do not close come first.
        let first = self.context.model.mechanism.nq() + 1;
        let cause = 2 * first - 1 + self.closed.closure.loops.len() + block.closes;
        let (count, sign) = (block.rows.len(), if block.positive { "" } else { "-" });
        let determinant = format!("@_block_determinant(jacobian, rows{k}, columns{k}, {count})");
        [
            format!("const int rows{k}[{count}] = {{{}}};", list(&block.rows)),
            format!(
                "const int columns{k}[{count}] = {{{}}};",
                list(&block.columns)
            ),
            format!("fits &= @_is_held({sign}{determinant}, {cause}, refused);"),
        ]
    }

    fn assemble(&self) -> PositionFunction {
        let (template, ways) = match self.conditions.joints.is_empty() {
            true => (
                include_str!("assembly_once.h"),
                "The attempt begins at guess.",
            ),
            false => (
                include_str!("assembly_assemble.h"),
                "The first attempt begins at guess, further ones on the way from there to the position `neutral`.",
            ),
        };
        let about = vec![
            "Positions at which all wheels touch and all loops close, those on the branch of `neutral`, from anywhere:",
            "Levenberg and Marquardt's method, at most 64 steps, each the shortest for its damping. The positions that change",
            "are those of the velocities of the open tree with a number other than 0 in is_free.",
            ways,
            "Returns 0; the number, from 1, in the table of closing names, of the first loop or contact that does not close;",
            "this number + NQ + NR where the loop closes on another branch; or -1 where a position is not finite.",
        ];
        PositionFunction::of_definition(&self.filled(template), about)
    }
}

fn list<T: ToString>(values: impl IntoIterator<Item = T>) -> String {
    let values: Vec<String> = values.into_iter().map(|x| x.to_string()).collect();
    values.join(", ")
}
