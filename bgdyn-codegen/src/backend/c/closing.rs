//! Positions of mechanisms with loops, wheels or knife edges: those that close, in closed form or by Newton's method, and
//! ways along velocities that constraints allow.
//!
//! They are `bgdyn_runtime::closure` around the functions `closing_step` and `tree_velocity` of the file.

use bgdyn_runtime::closure::Dependent;

use super::assembly::assembly_functions;
use super::context::ModelContext;
use super::newton::Newton;
use super::parameters::of_model;
use super::polygon::polygon_function;
use super::position_function::{PositionFunction, joint_by_joint, signature};
use super::sample::{all_nan, closed_sample};
use super::style::Style;
use crate::bond_graph::{ClosedTree, joint_segments};
use crate::mechanism::closure::{Polygon, closing_polygons};
use crate::method::Method;
use crate::plan::{dependent_joint, independent_positions};

/// What a function that closes returns.
const CAUSES: [&str; 2] = [
    "Returns 0; the number, from 1, in the table of closing names, of the first loop or contact that does not close: it",
    "is out of reach or at a singular position; or -1 where a position is not finite.",
];

/// A mechanism with loops or contacts.
struct ClosingText<'a> {
    closed: &'a ClosedTree,
    context: &'a ModelContext<'a>,
    /// The joints whose positions close.
    joints: Vec<Dependent>,
    /// The loops in closed form, each after those that it depends on.
    polygons: Vec<Polygon>,
    /// The joints of all other loops.
    others: Vec<Dependent>,
}

/// Returns the functions of positions, each after those that it calls.
pub(super) fn closing_functions(
    closed: &ClosedTree,
    context: &ModelContext<'_>,
) -> Vec<PositionFunction> {
    let joints = closed.closure.closing().map(|j| dependent_joint(closed, j));
    let (polygons, others) = closing_polygons(&closed.closure);
    let others = others.into_iter().map(|j| dependent_joint(closed, j));
    let text = ClosingText {
        closed,
        context,
        joints: joints.collect(),
        polygons,
        others: others.collect(),
    };
    let has = |method| context.model.function(method).is_some();
    let closes = has(Method::ClosingStep);
    let along = closed.closure.closes_along();
    let is_along_tree = has(Method::TreeVelocity);
    let integrates = is_along_tree && (closes || closed.closure.position_rows().is_empty());
    let mut functions = Vec::new();
    let assembles = context.model.assembles;
    if (closes && along) || integrates || assembles {
        functions.push(text.moved());
    }
    if assembles {
        functions.extend(assembly_functions(closed, context));
    }
    if closes {
        functions.extend(text.closers());
        functions.push(text.close());
    }
    if is_along_tree {
        functions.push(text.position_rates());
    }
    if integrates {
        functions.push(match along {
            true => text.follow(closes),
            false => text.integrate(),
        });
    }
    let samples = match along && !closed.closure.nonholonomic() {
        true => integrates,
        false => closes || closed.closure.position_rows().is_empty(),
    };
    if samples {
        functions.extend(closed_sample(closed, closes, context));
    }
    functions
}

impl ClosingText<'_> {
    fn style(&self) -> &Style {
        self.context.style
    }

    /// Returns a call of a function of the file, with the run-time parameters if there are any.
    fn call(&self, name: &str, arguments: &str) -> String {
        let parameters = match self.context.naming.parameters.is_empty() {
            true => "",
            false => "parameters, ",
        };
        format!("{}({parameters}{arguments})", self.style().global(name))
    }

    /// Returns the declaration of an array with this size.
    fn array(&self, name: &str, size: &str) -> String {
        let (real, size) = (self.style().real(), self.style().constant(size));
        format!("{real} {name}[{size}];")
    }

    /// Returns the loop over the velocities of the open tree with this statement.
    fn each_velocity(&self, statement: &str) -> Vec<String> {
        let count = self.style().constant("NT");
        vec![
            format!("for (int j = 0; j < {count}; ++j) {{"),
            format!("    {statement}"),
            "}".into(),
        ]
    }

    /// The position after constant velocities of the open tree.
    fn moved(&self) -> PositionFunction {
        let (style, real) = (self.style(), self.style().real());
        let (nq, nt) = (style.constant("NQ"), style.constant("NT"));
        let joints = joint_segments(&self.closed.tree);
        PositionFunction {
            about: Vec::new(),
            signature: format!(
                "static void {}(const {real} q[{nq}], const {real} moved[{nt}], {real} result[{nq}])",
                style.global("moved")
            ),
            body: joint_by_joint(&joints, "integrate", "moved", style),
        }
    }

    /// Returns the functions that close positions in place: all by Newton's method, and where there are planar loops
    /// these in closed form, and then the others.
    fn closers(&self) -> Vec<PositionFunction> {
        let whole = self.newton("newton", &self.joints, false);
        if self.polygons.is_empty() {
            return vec![whole];
        }
        let first = self.context.model.mechanism.nq();
        let polygons = polygon_function(&self.polygons, self.closed, first, self.style());
        let mut functions = vec![whole, polygons];
        if !self.others.is_empty() {
            functions.push(self.newton("close_others", &self.others, true));
        }
        functions
    }

    /// Newton's method for these joints.
    fn newton(&self, name: &'static str, joints: &[Dependent], is_last: bool) -> PositionFunction {
        let style = self.style();
        let parameters = of_model(self.context.naming, style, true);
        let along = self.closed.closure.closes_along();
        let newton = Newton {
            style,
            name,
            is_last,
            joints: joints.to_vec(),
            first: self.context.model.mechanism.nq(),
            argument: "q",
            size: style.constant("NQ"),
            step: self.call("closing_step", "q, change") + ";",
            steps: style.constant("NT"),
            moved: along.then(|| format!("{}(q, change, q);", style.global("moved"))),
            parameters: parameters.map_or(String::new(), |p| p.declaration + ", "),
        };
        newton.function()
    }

    /// Returns the statements that close the positions `found`, and note the cause `refused`; `branch` is the name of
    /// closed positions on whose branch planar loops are to be, or NULL.
    fn closed(&self, branch: &str) -> Vec<String> {
        if self.polygons.is_empty() {
            let call = self.call("newton", "found");
            return vec![format!("const int refused = {call};")];
        }
        let polygons = self.style().global("close_polygons");
        if self.others.is_empty() {
            return vec![format!("const int refused = {polygons}(found, {branch});")];
        }
        let others = self.call("close_others", "found, open");
        vec![
            format!("const int open = {polygons}(found, {branch});"),
            format!("const int refused = {others};"),
        ]
    }

    /// Describes the way in which positions close.
    fn way(&self) -> Vec<&'static str> {
        match (self.polygons.is_empty(), self.others.is_empty()) {
            (true, _) => vec!["Newton's method, at most 11 steps of at most 0.5 rad or m."],
            (false, true) => vec![
                "in closed form, on the branch that is nearer to the dependent positions in q, angles with the whole turns",
                "nearest to those in q.",
            ],
            (false, false) => vec![
                "planar loops in closed form, on the branch that is nearer to the dependent positions in q, angles with the",
                "whole turns nearest to those in q; the others by Newton's method, at most 11 steps of at most 0.5 rad or m.",
            ],
        }
    }

    fn close(&self) -> PositionFunction {
        let about = match self.closed.closure.nonholonomic() {
            true => "The positions, changed so that all wheels touch and all loops close:",
            false if self.others.is_empty() => {
                "The positions with the dependent ones changed so that all loops close:"
            }
            false => {
                "The positions with the dependent ones changed so that all loops close, from those in q:"
            }
        };
        let mut body = vec![
            self.array("found", "NQ"),
            "memcpy(found, q, sizeof found);".into(),
        ];
        body.extend(self.closed("NULL"));
        body.extend(self.returned());
        PositionFunction {
            about: [about]
                .into_iter()
                .chain(self.way())
                .chain(CAUSES)
                .collect(),
            signature: signature(self.context, "int", "close", "q", "NQ"),
            body,
        }
    }

    /// Returns the statements that return the positions `found`, and the cause `refused`.
    fn returned(&self) -> [String; 2] {
        let (status, nq) = (self.style().global("status"), self.style().constant("NQ"));
        [
            "memcpy(result, found, sizeof found);".into(),
            format!("return {status}(refused, found, {nq});"),
        ]
    }

    fn position_rates(&self) -> PositionFunction {
        let joints = joint_segments(&self.closed.tree);
        let mut body = vec![
            self.array("moved", "NT"),
            self.call("tree_velocity", "q, v, moved") + ";",
        ];
        body.extend(joint_by_joint(
            &joints,
            "position_rates",
            "moved",
            self.style(),
        ));
        body.retain(|line| line != "(void)q;");
        PositionFunction {
            about: vec!["Rates of the positions of all joints at the independent velocities v."],
            signature: signature(self.context, "void", "position_rates", "q v", "NQ"),
            body,
        }
    }

    /// The position after independent velocities; along those of the others at q, then closed.
    fn integrate(&self) -> PositionFunction {
        let moved = self.style().global("moved");
        let mut body = vec![
            self.array("rates", "NT"),
            self.array("found", "NQ"),
            self.call("tree_velocity", "q, dv, rates") + ";",
            format!("{moved}(q, rates, found);"),
        ];
        body.extend(self.closed("q"));
        body.extend(self.not_closed(&independent_positions(self.closed)));
        body.extend(self.returned());
        let about = [
            "Positions after the independent velocities dv for one unit of time: along the velocities at q, then closed as by",
            "`close`, on the branch of q. Positions in loops are NaN where a loop does not close.",
        ];
        PositionFunction {
            about: about.into_iter().chain(CAUSES).collect(),
            signature: signature(self.context, "int", "integrate", "q dv", "NQ"),
            body,
        }
    }

    /// Returns the statements that make positions NaN where a loop is open: those that close, and `others`.
    fn not_closed(&self, others: &[usize]) -> Vec<String> {
        let real = self.style().real();
        let mut positions: Vec<usize> = self.joints.iter().map(|joint| joint.position).collect();
        positions.extend(others);
        positions.sort_unstable();
        positions.dedup();
        let store = |p: &usize| format!("    found[{p}] = ({real})NAN;");
        let lines = ["if (refused != 0) {".to_string()].into_iter();
        lines
            .chain(positions.iter().map(store))
            .chain(["}".into()])
            .collect()
    }

    /// The position after independent velocities along a way that conditions on velocities allow: order 4, without
    /// commutators (Celledoni, Marthinsen and Owren 2003).
    fn follow(&self, closes: bool) -> PositionFunction {
        let style = self.style();
        let [half, one, three, twelve] = [0.5, 1.0, 3.0, 12.0].map(|x| style.number(x));
        let (real, moved) = (style.real(), style.global("moved"));
        let rates = |q: &str, k: &str| self.call("tree_velocity", &format!("{q}, dv, {k}")) + ";";
        let move_by = |q: &str, found: &str| format!("{moved}({q}, part, {found});");
        let mut body: Vec<String> = ["k1", "k2", "k3", "k4", "part"]
            .iter()
            .map(|name| self.array(name, "NT"))
            .collect();
        body.extend(["middle", "found"].map(|name| self.array(name, "NQ")));
        body.push(format!("const {real} twelfth = {one} / {twelve};"));
        body.push(rates("q", "k1"));
        body.extend(self.each_velocity(&format!("part[j] = k1[j] * {half};")));
        body.extend([move_by("q", "middle"), rates("middle", "k2")]);
        body.extend(self.each_velocity(&format!("part[j] = k2[j] * {half};")));
        body.extend([move_by("q", "found"), rates("found", "k3")]);
        body.extend(self.each_velocity(&format!("part[j] = k3[j] - k1[j] * {half};")));
        body.extend([move_by("middle", "found"), rates("found", "k4")]);
        for (first, last, from, to) in
            [("k1", "k4", "q", "middle"), ("k4", "k1", "middle", "found")]
        {
            body.extend(self.each_velocity(&format!(
                "part[j] = ((k2[j] + k2[j] + k3[j] + k3[j]) + ({three} * {first}[j] - {last}[j])) * twelfth;"
            )));
            body.push(move_by(from, to));
        }
        let about = [
            "Positions after the independent velocities dv for one unit of time, along the way that the constraints allow: to",
            "fourth order in dv.",
        ];
        let about = about.into_iter();
        if !closes {
            body.push("memcpy(result, found, sizeof found);".into());
            return PositionFunction {
                about: about.collect(),
                signature: signature(self.context, "void", "integrate", "q dv", "NQ"),
                body,
            };
        }
        body.extend(self.closed("NULL"));
        body.extend(all_nan("refused != 0", style));
        body.extend(self.returned());
        let closed = ["Then it closes; all positions are NaN where a wheel or loop does not."];
        PositionFunction {
            about: about.chain(closed).chain(CAUSES).collect(),
            signature: signature(self.context, "int", "integrate", "q dv", "NQ"),
            body,
        }
    }
}
