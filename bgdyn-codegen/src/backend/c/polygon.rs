//! The dependent positions of planar loops in closed form, one loop after the other.
//!
//! They are `bgdyn_runtime::closure::polygon` for the polygons of a mechanism, in the order of the Rust module.

use bgdyn_runtime::Dd;

use super::position_function::PositionFunction;
use super::style::Style;
use super::words::in_comment;
use crate::bond_graph::ClosedTree;
use crate::mechanism::closure::{
    AngleTerm, PlaneJoint, Polygon, PolygonForm, TurnedVector, snapped,
};
use crate::plan::{AngleSums, slider_numbers, triangle_numbers, turned_joints};

/// Returns the function that closes all loops that are polygons: it returns 0, or the number of the first one that does
/// not close. `first` is the index of the first loop among the causes.
pub(super) fn polygon_function(
    polygons: &[Polygon],
    closed: &ClosedTree,
    first: usize,
    style: &Style,
) -> PositionFunction {
    let (real, nq) = (style.real(), style.constant("NQ"));
    let mut body = vec!["int refused = 0;".to_string()];
    for polygon in polygons {
        let name = in_comment(&closed.closure.loops[polygon.closes].name);
        let cause = first + polygon.closes + 1;
        let text = LoopText {
            polygon,
            style,
            cause,
        };
        body.push(format!("{{ /* {name} */"));
        body.extend(indented(text.closing()));
        body.push("}".into());
    }
    body.push("return refused;".into());
    PositionFunction {
        about: Vec::new(),
        signature: format!(
            "static int {}({real} q[{nq}], const {real} *from)",
            style.global("close_polygons")
        ),
        body,
    }
}

fn indented(lines: Vec<String>) -> impl Iterator<Item = String> {
    lines.into_iter().map(|line| format!("    {line}"))
}

/// A loop.
struct LoopText<'a> {
    polygon: &'a Polygon,
    style: &'a Style,
    /// The number of the loop among the causes.
    cause: usize,
}

/// Vectors whose sines are computed together.
struct TurnedVectors<'a> {
    style: &'a Style,
    /// Begins the names of the sines.
    prefix: &'static str,
    sums: AngleSums,
}

impl<'a> TurnedVectors<'a> {
    fn new(prefix: &'static str, style: &'a Style) -> Self {
        TurnedVectors {
            style,
            prefix,
            sums: AngleSums::default(),
        }
    }

    /// Returns the components of a vector.
    fn components(&mut self, turned: &TurnedVector) -> [String; 2] {
        let v = snapped(turned.vector);
        let [x, y] = v.map(|x| self.style.number(x.hi()));
        let Some(k) = self.sums.index(turned) else {
            return [x, y];
        };
        let [sine, cosine] = ["sine", "cosine"].map(|name| format!("{}_{name}{k}", self.prefix));
        match v.map(|x| x.hi() == 0.0) {
            [_, true] => [format!("{x} * {cosine}"), format!("{x} * {sine}")],
            [true, _] => [format!("-({y} * {sine})"), format!("{y} * {cosine}")],
            _ => [
                format!("{x} * {cosine} - {y} * {sine}"),
                format!("{x} * {sine} + {y} * {cosine}"),
            ],
        }
    }

    /// Returns the vectors as an initializer.
    fn list(&mut self, vectors: &[&TurnedVector]) -> String {
        let vectors = vectors.iter().map(|one| pair(&self.components(one)));
        format!("{{{}}}", vectors.collect::<Vec<_>>().join(", "))
    }

    /// Returns the statements that compute the sines at the positions of this name.
    fn sines(&self, q: &str) -> Vec<String> {
        let (real, prefix) = (self.style.real(), self.prefix);
        let term = |term: &AngleTerm| {
            let sign = if term.opposite { "-" } else { "" };
            format!("{sign}{}", position(q, term.joint))
        };
        let mut lines = Vec::new();
        for (k, angle) in self.sums.all.iter().enumerate() {
            let results = format!("&{prefix}_sine{k}, &{prefix}_cosine{k}");
            lines.push(format!("{real} {prefix}_sine{k};"));
            lines.push(format!("{real} {prefix}_cosine{k};"));
            if let [one] = &angle[..] {
                let function = self.style.global("sin_cos");
                lines.push(format!("{function}({}, {results});", term(one)));
                continue;
            }
            let (sum, tail) = (format!("{prefix}_sum{k}"), format!("{prefix}_tail{k}"));
            let mut terms = angle.iter().map(term);
            let zero = self.style.number(0.0);
            let first = terms.next().unwrap_or_else(|| zero.clone());
            lines.push(format!("{real} {sum} = {first};"));
            lines.push(format!("{real} {tail} = {zero};"));
            let add = self.style.global("add_angle");
            lines.extend(terms.map(|term| format!("{add}(&{sum}, &{tail}, {term});")));
            let function = self.style.global("sin_cos_sum");
            lines.push(format!("{function}({sum}, {tail}, {results});"));
        }
        lines
    }
}

impl LoopText<'_> {
    /// Returns the statements that set its dependent positions.
    fn closing(&self) -> Vec<String> {
        match &self.polygon.form {
            PolygonForm::Triangle { first, second, .. } => self.triangle([first, second]),
            PolygonForm::Slider {
                arm, along, slide, ..
            } => self.slider(arm, along, *slide),
            PolygonForm::Cylinder {
                along,
                start,
                across,
                slide,
                ..
            } => self.cylinder(along, [*start, *across], *slide),
        }
    }

    fn number(&self, x: Dd) -> String {
        self.style.number(x.hi())
    }

    /// Returns the arguments that tell the branch and the loop.
    fn branch(&self) -> String {
        let positive = i32::from(self.polygon.positive);
        format!("{positive}, {}, &refused", self.cause)
    }

    /// Returns the vector D as an initializer.
    fn known(&self, vectors: &mut TurnedVectors<'_>) -> String {
        let sides = self.polygon.known.iter().map(|side| {
            let turned = vectors.components(&side.turned);
            match side.slide {
                None => turned.map(|x| format!("({x})")),
                Some(joint) => turned.map(|x| format!("({x}) * {}", position("q", joint))),
            }
        });
        let sides: Vec<[String; 2]> = sides.collect();
        if sides.is_empty() {
            return pair(&[0.0; 2].map(|x| self.style.number(x)));
        }
        pair(&[0, 1].map(|k| {
            let components = sides.iter().map(|side| side[k].as_str());
            components.collect::<Vec<_>>().join(" + ")
        }))
    }

    /// Returns a condition on the vectors of the links at the branch's positions: whether they are on the other branch.
    fn is_other(&self, links: &[&TurnedVector], value: &str, unit: Dd) -> Vec<String> {
        let mut there = TurnedVectors::new("from", self.style);
        let list = there.list(links);
        let mut lines = there.sines("from");
        let (real, count) = (self.style.real(), links.len());
        let (function, unit) = (self.style.global("polygon_is_other"), self.number(unit));
        let positive = i32::from(self.polygon.positive);
        lines.push(format!("const {real} there[{count}][2] = {list};"));
        lines.push(format!(
            "other = {function}(({value}) * {unit}, {positive});"
        ));
        lines
    }

    fn triangle(&self, arms: [&TurnedVector; 2]) -> Vec<String> {
        let (style, real) = (self.style, self.style.real());
        let mut vectors = TurnedVectors::new("known", style);
        let (known, here) = (self.known(&mut vectors), vectors.list(&arms));
        let ([outer, inner, difference], unit) = triangle_numbers(arms);
        let [outer, inner, difference] = [outer, inner, difference].map(|x| self.number(x));
        let mut lines = vectors.sines("q");
        lines.extend([
            format!("const {real} known[2] = {known};"),
            format!("const {real} here[2][2] = {here};"),
            format!("{real} found[2][2][2];"),
            format!(
                "{}(known, {outer}, {inner}, {difference}, {}, found);",
                style.global("polygon_triangle"),
                self.branch()
            ),
        ]);
        let cross = "there[0][0] * there[1][1] - there[0][1] * there[1][0]";
        lines.extend(self.turning(&arms, Some(self.is_other(&arms, cross, unit))));
        lines
    }

    fn slider(&self, arm: &TurnedVector, along: &TurnedVector, slide: PlaneJoint) -> Vec<String> {
        let (style, real) = (self.style, self.style.real());
        let mut vectors = TurnedVectors::new("known", style);
        let (known, here) = (self.known(&mut vectors), vectors.list(&[arm]));
        let direction = pair(&vectors.components(along));
        let [square, unit] = slider_numbers(arm);
        let mut lines = vectors.sines("q");
        lines.extend([
            format!("const {real} known[2] = {known};"),
            format!("const {real} here[1][2] = {here};"),
            format!("const {real} along[2] = {direction};"),
            format!("{real} found[2][1][2];"),
            format!("{real} slides[2];"),
            format!(
                "{}(known, along, {}, {}, found, slides);",
                style.global("polygon_slider"),
                self.number(square),
                self.branch()
            ),
        ]);
        let dot = "there[0][0] * there[1][0] + there[0][1] * there[1][1]";
        let is_other = self.is_other(&[arm, along], dot, unit);
        lines.extend(self.turning(&[arm], Some(is_other)));
        lines.push(format!("{} = slides[other];", position("q", slide)));
        lines
    }

    fn cylinder(&self, along: &TurnedVector, lengths: [Dd; 2], slide: PlaneJoint) -> Vec<String> {
        let (style, real) = (self.style, self.style.real());
        let mut vectors = TurnedVectors::new("known", style);
        let (known, here) = (self.known(&mut vectors), vectors.list(&[along]));
        let [start, across] = snapped(lengths).map(|x| self.number(x));
        let [x, there] = ["q", "from"].map(|q| position(q, slide));
        let mut lines = vectors.sines("q");
        lines.extend([
            format!("const {real} known[2] = {known};"),
            format!("const {real} here[1][2] = {here};"),
            format!("const {real} length = ((from != NULL) ? {there} : {x}) + {start};"),
            format!("{real} found[2][1][2];"),
            format!("{real} slides[2];"),
            format!(
                "const int other = {}(length, {});",
                style.global("polygon_is_other"),
                i32::from(self.polygon.positive)
            ),
            format!(
                "{}(known, {start}, {across}, {}, found, slides);",
                style.global("polygon_cylinder"),
                self.branch()
            ),
        ]);
        lines.extend(self.turning(&[along], None));
        lines.push(format!("{x} = slides[other];"));
        lines
    }

    /// Returns the statements that turn links from the directions `here` to those `found` on either branch, by their
    /// dependent joints: first nearly, then to rounding. `is_other` are the statements that tell the branch of the
    /// positions `from`, if there are any; without them the branch is that with the shorter way.
    fn turning(&self, links: &[&TurnedVector], is_other: Option<Vec<String>>) -> Vec<String> {
        let (style, real, count) = (self.style, self.style.real(), links.len());
        let joints = turned_joints(self.polygon, links);
        let [turn, small, exact, check] = ["turn", "small_turn", "are_exact", "check_angle"]
            .map(|name| style.global(&format!("polygon_{name}")));
        let mut lines = vec![format!("{real} turns[{count}];")];
        if let Some(is_other) = is_other {
            lines.extend(["int other;".into(), "if (from != NULL) {".into()]);
            lines.extend(indented(is_other));
            lines.push("} else {".into());
            lines.extend(indented(self.nearer(&joints, count, &turn)));
            lines.push("}".into());
        }
        let each = |function: &str, from: &str| {
            let statement = |k| format!("turns[{k}] = {function}({from}[{k}], found[other][{k}]);");
            (0..count).map(statement).collect::<Vec<_>>()
        };
        let moved = || {
            joints.iter().map(|(joint, terms)| {
                let (q, change) = (position("q", *joint), sum(terms));
                format!("{q} = {q} + {};", in_brackets(terms, change))
            })
        };
        lines.extend(each(&turn, "here"));
        lines.extend(moved());
        lines.push(format!("if (!{exact}(turns, {count})) {{"));
        let mut near = TurnedVectors::new("nearly", style);
        let list = near.list(links);
        lines.extend(indented(near.sines("q")));
        lines.push(format!("    const {real} nearly[{count}][2] = {list};"));
        lines.extend(indented(each(&small, "nearly")));
        lines.extend(indented(moved().collect()));
        lines.push("}".into());
        lines.extend(joints.iter().map(|(joint, _)| {
            format!(
                "{check}({}, {}, &refused);",
                position("q", *joint),
                self.cause
            )
        }));
        lines
    }

    /// Returns the statements that choose the branch with the shorter way.
    fn nearer(&self, joints: &[(PlaneJoint, Turns)], count: usize, turn: &str) -> Vec<String> {
        let (real, changed) = (self.style.real(), joints.len());
        let mut lines = vec![
            format!("{real} changes[2][{changed}];"),
            "for (int k = 0; k < 2; ++k) {".into(),
        ];
        let turns =
            (0..count).map(|j| format!("    turns[{j}] = {turn}(here[{j}], found[k][{j}]);"));
        lines.extend(turns);
        let changes = joints.iter().enumerate();
        lines.extend(
            changes.map(|(j, (_, terms))| format!("    changes[k][{j}] = {};", sum(terms))),
        );
        let nearer = self.style.global("polygon_is_nearer");
        lines.extend([
            "}".into(),
            format!("other = {nearer}(changes[0], changes[1], {changed});"),
        ]);
        lines
    }
}

/// Indices of turns, and whether each is subtracted.
type Turns = Vec<(usize, bool)>;

/// Returns a sum of turns.
fn sum(terms: &Turns) -> String {
    let term = |(at, &(k, negative)): (usize, &(usize, bool))| match (at, negative) {
        (0, false) => format!("turns[{k}]"),
        (0, true) => format!("-turns[{k}]"),
        (_, false) => format!(" + turns[{k}]"),
        (_, true) => format!(" - turns[{k}]"),
    };
    terms.iter().enumerate().map(term).collect()
}

fn in_brackets(terms: &Turns, sum: String) -> String {
    match terms[..] {
        [(_, false)] => sum,
        _ => format!("({sum})"),
    }
}

fn position(q: &str, joint: PlaneJoint) -> String {
    format!("{q}[{}]", joint.position.0)
}

fn pair([x, y]: &[String; 2]) -> String {
    format!("{{{x}, {y}}}")
}
