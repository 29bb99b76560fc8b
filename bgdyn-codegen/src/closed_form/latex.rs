//! Prints equations in LaTeX, for the package amsmath.

use std::fmt::Write as _;

use bgdyn_runtime::Dd;

use super::form::{Atom, ClosedForm, Sum};
use super::notation::{Decimal, Notation, effort, terms, unit};
use crate::mechanism::NumberSymbol;

/// Prints P_j and their symbols as two environments `align*`, values with this number of significant
/// digits (1 to 17). Comments name the joint of each coordinate.
pub fn latex(form: &ClosedForm, digits: usize) -> String {
    let n = Typeset { form, digits };
    let mut text = format!("% {}: driving efforts in closed form\n", form.name);
    for (j, (name, motion)) in form.joints.iter().enumerate() {
        let (q, j_th) = (motion.unit(), j + 1);
        let effort = write_unit(&unit(effort(form, j)));
        writeln!(text, "% q_{j_th}: {name}, {q}; P_{j_th} in ${effort}$").expect("a string");
    }
    let mut rows = Vec::new();
    for (j, effort) in form.efforts.iter().enumerate() {
        rows.push(format!("P_{{{}}}{}", j + 1, right(&n, effort)));
    }
    text += &align(&rows);
    let mut rows = Vec::new();
    for (i, constant) in form.constants.iter().enumerate() {
        let definition = right(&n, &constant.definition);
        let value = n.value(constant.value, constant.dimension);
        rows.push(format!("a_{{{}}}{definition} \\\\\n  &{value}", i + 1));
    }
    for l in form.letters_met() {
        let letter = &form.letters[l];
        let value = n.value(letter.value, letter.dimension);
        let meaning = escaped(&letter.meaning);
        rows.push(format!(
            "{} &{value} && \\text{{{meaning}}}",
            symbol(letter)
        ));
    }
    if !rows.is_empty() {
        text += &align(&rows);
    }
    text
}

fn align(rows: &[String]) -> String {
    let rows = rows.join(" \\\\\n");
    format!("\\begin{{align*}}\n{rows}\n\\end{{align*}}\n")
}

/// Prints the right-hand side, one line for each term.
fn right(n: &Typeset<'_>, sum: &Sum) -> String {
    let lines: Vec<String> = terms(n, sum);
    format!(" &= {}", lines.join(" \\\\\n  &\\quad "))
}

/// The notation of LaTeX.
struct Typeset<'a> {
    form: &'a ClosedForm,
    digits: usize,
}

impl Notation for Typeset<'_> {
    const TIMES: &'static str = "\\, ";
    const MINUS: &'static str = "-";
    const ABOUT: &'static str = "\\approx";
    const GAP: &'static str = "\\,";

    fn digits(&self) -> usize {
        self.digits
    }

    fn unit(&self, parts: &[(&str, i32)]) -> String {
        write_unit(parts)
    }

    fn number(&self, x: Dd) -> String {
        let decimal = Decimal::new(x, self.digits);
        match decimal.exponent {
            None => decimal.digits,
            Some(n) => format!("{} \\cdot 10^{{{n}}}", decimal.digits),
        }
    }

    fn symbol(&self, atom: &Atom, power: u32) -> String {
        let base = match atom {
            Atom::Letter(l) => symbol(&self.form.letters[*l]),
            Atom::Constant(i) => format!("a_{{{}}}", i + 1),
            Atom::Position(j) => format!("q_{{{}}}", j + 1),
            Atom::Velocity(j) => format!("\\dot{{q}}_{{{}}}", j + 1),
            Atom::Acceleration(j) => format!("\\ddot{{q}}_{{{}}}", j + 1),
            Atom::Sine(_) | Atom::Cosine(_) => String::new(),
        };
        base + &superscript(power)
    }

    fn wave(&self, sine: bool, angle: &str, single: bool, power: u32) -> String {
        let name = if sine { "\\sin" } else { "\\cos" };
        let power = superscript(power);
        match single {
            true => format!("{name}{power} {angle}"),
            false => format!("{name}{power}({angle})"),
        }
    }

    fn parentheses(&self, inside: &str, power: u32) -> String {
        format!("\\left({inside}\\right){}", superscript(power))
    }
}

/// Prints `m_{2}`, `J_{zz,1}`; the name of a run-time parameter, upright.
fn symbol(letter: &NumberSymbol) -> String {
    if letter.run_time {
        return format!("\\mathrm{{{}}}", escaped(&letter.symbol));
    }
    let component = (!letter.component.is_empty()).then(|| letter.component.to_owned());
    let of = letter.of.iter().map(usize::to_string);
    let parts: Vec<String> = component.into_iter().chain(of).collect();
    match parts.is_empty() {
        true => letter.symbol.clone(),
        false => format!("{}_{{{}}}", letter.symbol, parts.join(",")),
    }
}

fn superscript(power: u32) -> String {
    match power {
        1 => String::new(),
        n => format!("^{{{n}}}"),
    }
}

fn escaped(name: &str) -> String {
    name.replace('_', "\\_").replace('−', "$-$")
}

fn write_unit(unit: &[(&str, i32)]) -> String {
    let part = |(name, n): &(&str, i32)| match n {
        1 => format!("\\mathrm{{{name}}}"),
        n => format!("\\mathrm{{{name}}}^{{{n}}}"),
    };
    unit.iter().map(part).collect::<Vec<_>>().join("\\,")
}
