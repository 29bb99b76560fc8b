//! Prints equations as plain text for a terminal.

use std::fmt::Write as _;

use bgdyn_runtime::Dd;

use super::form::{Atom, ClosedForm, Sum};
use super::notation::{Decimal, Notation, effort, sum, terms, unit};
use crate::mechanism::{Motion, NumberSymbol};

/// Longer lines are broken.
const WIDTH: usize = 96;

/// Prints P_j, their symbols and their values to a number of significant digits (1 to 17), as plain
/// Unicode text. `≈` marks rounded values.
pub fn text(form: &ClosedForm, digits: usize) -> String {
    let n = Plain { form, digits };
    let mut text = format!("{}: driving efforts in closed form\n\n", form.name);
    let rows = form.joints.iter().enumerate();
    let rows = rows.map(|(j, (name, motion))| {
        let j_th = subscript(&[j + 1]);
        let kind = match motion {
            Motion::Rotation => "angle, rad",
            _ => "displacement, m",
        };
        let unit = write_unit(&unit(effort(form, j)));
        [
            format!("q{j_th}"),
            name.clone(),
            kind.to_owned(),
            format!("P{j_th} in {unit}"),
        ]
    });
    text += &table(&rows.collect::<Vec<_>>());
    for (j, effort) in form.efforts.iter().enumerate() {
        text.push('\n');
        let name = format!("P{}", subscript(&[j + 1]));
        text += &equation(&name, &n, effort);
    }
    for (i, constant) in form.constants.iter().enumerate() {
        text.push('\n');
        let name = format!("a{}", subscript(&[i + 1]));
        let whole = format!("{name} = {}", sum(&n, &constant.definition));
        let value = n.value(constant.value, constant.dimension);
        let indent = " ".repeat(name.chars().count());
        text += &wrap_line(&whole, &indent);
        writeln!(text, "{indent} {value}").expect("a string");
    }
    let rows = form.letters_met().into_iter().map(|l| {
        let letter = &form.letters[l];
        let value = n.value(letter.value, letter.dimension);
        [symbol(letter), value, letter.meaning.clone()]
    });
    let rows: Vec<_> = rows.collect();
    if !rows.is_empty() {
        text.push('\n');
        text += &table(&rows);
    }
    text
}

/// Prints columns two spaces apart.
fn table<const N: usize>(rows: &[[String; N]]) -> String {
    let width = |s: &String| s.chars().count();
    let widths: [usize; N] =
        std::array::from_fn(|c| rows.iter().map(|r| width(&r[c])).max().unwrap_or(0));
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (cell, wide) in row.iter().zip(widths) {
            line += cell;
            line += &" ".repeat(wide - width(cell) + 2);
        }
        text += line.trim_end();
        text.push('\n');
    }
    text
}

/// Prints `name = …`: in one line, or one line per term.
fn equation(name: &str, n: &Plain<'_>, right: &Sum) -> String {
    let whole = format!("{name} = {}", sum(n, right));
    if whole.chars().count() <= WIDTH {
        return whole + "\n";
    }
    let indent = " ".repeat(name.chars().count());
    let mut text = String::new();
    for (i, term) in terms(n, right).iter().enumerate() {
        let line = match i {
            0 => format!("{name} = {term}"),
            _ => format!("{indent} {term}"),
        };
        text += &wrap_line(&line, &indent);
    }
    text
}

/// Breaks a long line before additions or subtractions.
fn wrap_line(line: &str, indent: &str) -> String {
    let mut pieces = vec![String::new()];
    let mut in_angle = false;
    for word in line.split_inclusive(' ') {
        match pieces.last_mut() {
            Some(piece) if in_angle || !matches!(word, "+ " | "− ") => *piece += word,
            _ => pieces.push(word.to_owned()),
        }
        // The next closing parenthesis is that of the last sine or cosine.
        in_angle = match word.rfind("sin(").max(word.rfind("cos(")) {
            Some(at) => !word[at..].contains(')'),
            None => in_angle && !word.contains(')'),
        };
    }
    let width = |s: &str| s.trim_end().chars().count();
    let (mut text, mut open) = (String::new(), String::new());
    for piece in pieces {
        if width(&open) > 0 && open.chars().count() + width(&piece) > WIDTH {
            text += open.trim_end();
            text.push('\n');
            open = format!("{indent}     ");
        }
        open += &piece;
    }
    text + open.trim_end() + "\n"
}

/// The notation for a terminal.
struct Plain<'a> {
    form: &'a ClosedForm,
    digits: usize,
}

impl Notation for Plain<'_> {
    const TIMES: &'static str = "·";
    const MINUS: &'static str = "−";
    const ABOUT: &'static str = "≈";
    const GAP: &'static str = " ";

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
            Some(n) => format!("{}e{n}", decimal.digits),
        }
    }

    fn symbol(&self, atom: &Atom, power: u32) -> String {
        let base = match atom {
            Atom::Letter(l) => symbol(&self.form.letters[*l]),
            Atom::Constant(i) => format!("a{}", subscript(&[i + 1])),
            Atom::Position(j) => format!("q{}", subscript(&[j + 1])),
            Atom::Velocity(j) => format!("q\u{307}{}", subscript(&[j + 1])),
            Atom::Acceleration(j) => format!("q\u{308}{}", subscript(&[j + 1])),
            Atom::Sine(_) | Atom::Cosine(_) => String::new(),
        };
        base + &superscript(power)
    }

    fn wave(&self, sine: bool, angle: &str, _: bool, power: u32) -> String {
        let name = if sine { "sin" } else { "cos" };
        format!("{name}({angle}){}", superscript(power))
    }

    fn parentheses(&self, inside: &str, power: u32) -> String {
        format!("({inside}){}", superscript(power))
    }
}

/// Prints `m₂`, `Jzz₁`, `l₁,₂`; the name of a run-time parameter.
fn symbol(letter: &NumberSymbol) -> String {
    let of = subscript(&letter.of);
    format!("{}{}{of}", letter.symbol, letter.component)
}

fn subscript(numbers: &[usize]) -> String {
    let digits = |n: &usize| shifted(*n, '₀');
    let all: Vec<String> = numbers.iter().map(digits).collect();
    all.join(",")
}

/// Prints a power; nothing for the first power.
fn superscript(power: u32) -> String {
    let digit = |c: char| match c {
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        c => shift(c, '⁰'),
    };
    match power {
        1 => String::new(),
        n => n.to_string().chars().map(digit).collect(),
    }
}

fn shifted(n: usize, zero: char) -> String {
    n.to_string().chars().map(|c| shift(c, zero)).collect()
}

/// Returns a digit in the character range that begins at `zero`.
fn shift(digit: char, zero: char) -> char {
    let n = digit.to_digit(10).unwrap_or(0);
    char::from_u32(zero as u32 + n).unwrap_or(digit)
}

/// Prints `kg·m²`, `N·m`, `m/s²`.
fn write_unit(unit: &[(&str, i32)]) -> String {
    let join = |sign: i32| {
        let parts = unit.iter().filter(|(_, n)| n.signum() == sign);
        let part = |(name, n): &(&str, i32)| format!("{name}{}", superscript(n.unsigned_abs()));
        parts.map(part).collect::<Vec<_>>().join("·")
    };
    match (join(1), join(-1)) {
        (above, below) if below.is_empty() => above,
        (above, below) if above.is_empty() => format!("1/{below}"),
        (above, below) => format!("{above}/{below}"),
    }
}
