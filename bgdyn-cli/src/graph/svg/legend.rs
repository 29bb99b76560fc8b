//! What the signs mean, below the drawing.

use bgdyn_accuracy::svg::{Anchor, Drawing, GRID, INK};

use super::super::chart::{Chart, Component};
use super::super::place::{MARGIN, text_width};
use super::symbols::{Bond, Point, bar, bond, junction};
use super::{LINE, SUM, SUM_BAR, VELOCITY, VELOCITY_BAR};

/// Where the words begin.
const WORDS: f64 = 88.0;
const SPACE: f64 = 9.0;
const SIZE: u32 = 12;

/// A sign with its meaning, line by line.
pub(super) struct Entry {
    sign: Sign,
    lines: Vec<String>,
}

#[derive(Clone, Copy)]
enum Sign {
    None,
    One,
    Zero,
    Bond,
    Triple,
    Word(&'static str),
}

const EQUATION: &str = "Pⱼ = Σᵢ [ ∂rᵢ/∂qⱼ · (mᵢ r̈ᵢ − Rᵢ) + ρⱼⁱ · (K̇ᵢ − Mᵢ) ]: the efforts at the junction of q̇ⱼ, read off the graph. Vectors x, y, z in fixed axes.";
const ONE: &str = "1-junction: one flow for all its bonds, the efforts sum to zero. q̇: velocity of a joint; ṙ: velocity of a link's centre of mass, m/s; ω: its angular velocity, rad/s. A bar is the junction stretched; bars that cross are not joined.";
const ZERO: &str = "0-junction: one effort for all its bonds, the flows sum to zero: ṙᵢ = Σⱼ ∂rᵢ/∂qⱼ q̇ⱼ, ωᵢ = Σⱼ ρⱼⁱ q̇ⱼ. Left out where only one velocity moves the link.";
const BOND: &str = "bond: positive power flows to the half arrow, the effort acts on the end with the causal stroke";
const DRIVES: &str = ". On a drive's bond there is none: inverse dynamics takes q̇ and gives P, forward dynamics takes P.";
const TRIPLE: &str = "bond of three components x, y, z";
const MTF: &str = "transformer modulated by the coordinates below its modulus, which is ∂rᵢ/∂qⱼ on the way to ṙ (m/rad; 1 for a slide) and ρⱼⁱ on the way to ω (1). In brackets x, y, z: 0 at all times, a constant (three digits), or · varying.";
const TF: &str = "transformer whose modulus is the same at all times";
const PARAMETER: &str = "the same at all times, but a run-time parameter";
const STORE: &str = "inertial store: mass m, kg; inertia J, kg·m², about the centre of mass in the link's axes. Derivative causality: every link's flow follows from the q̇, so the stores meet in the mass matrix";
const INTEGRAL: &str = ". Where its stroke is at the store, its own state gives the flow.";
const SOURCE: &str = "source of effort: P the drive of a joint, R the weight of a link, N. Moments M on links are zero unless a scene calls for them.";

const RESISTOR: &str = "resistor: friction, a damper, a winding; takes power and stores none";
const COMPLIANCE: &str = "compliance: a spring, a stop, a soft drive; stores by displacement";
const GYRATOR: &str = "gyrator: torque = k N · current, voltage = k N · velocity";

/// The entries for a drawing of this width.
pub(super) fn lines(chart: &Chart, width: f64) -> Vec<Entry> {
    let transformers = || chart.transformers();
    let parameter = |c: &Component| *c == Component::Parameter;
    let all = chart.ports();
    let free = all.iter().any(|port| port.on_junction.is_none());
    let integral = all
        .iter()
        .any(|p| p.symbol == "I" && p.on_junction == Some(false));
    let bond = [BOND, if free { DRIVES } else { "." }].concat();
    let store = [STORE, if integral { INTEGRAL } else { "." }].concat();
    let mut entries = vec![
        (Sign::None, EQUATION),
        (Sign::One, ONE),
        (Sign::Zero, ZERO),
        (Sign::Bond, bond.as_str()),
        (Sign::Triple, TRIPLE),
    ];
    if transformers().any(|t| t.symbol() == "MTF") {
        entries.push((Sign::Word("MTF"), MTF));
    }
    if transformers().any(|t| t.symbol() == "TF") {
        entries.push((Sign::Word("TF"), TF));
    }
    if transformers().any(|t| t.modulus.iter().any(parameter)) {
        entries.push((Sign::Word("p"), PARAMETER));
    }
    entries.extend([
        (Sign::Word("I"), store.as_str()),
        (Sign::Word("Se"), SOURCE),
    ]);
    for (symbol, words) in [("R", RESISTOR), ("C", COMPLIANCE), ("GY", GYRATOR)] {
        if all.iter().any(|port| port.symbol == symbol) {
            entries.push((Sign::Word(symbol), words));
        }
    }
    let entry = |(sign, words): (Sign, &str)| {
        let room = width
            - if matches!(sign, Sign::None) {
                0.0
            } else {
                WORDS
            };
        Entry {
            sign,
            lines: wrapped(words, SIZE, room),
        }
    };
    entries.into_iter().map(entry).collect()
}

/// How high the entries are, with the margin below.
pub(super) fn height(entries: &[Entry]) -> f64 {
    entries.iter().map(entry_height).sum::<f64>() + 24.0 + MARGIN
}

fn entry_height(entry: &Entry) -> f64 {
    LINE * entry.lines.len() as f64 + SPACE
}

/// Writes the entries below `top`.
pub(super) fn draw(d: &mut Drawing, entries: &[Entry], top: f64) {
    let mut y = top + 28.0;
    d.line(
        (MARGIN, top + 8.0),
        (d.width() - MARGIN, top + 8.0),
        GRID,
        "",
    );
    for entry in entries {
        sign(d, entry.sign, (MARGIN, y - 4.5));
        let x = match entry.sign {
            Sign::None => MARGIN,
            _ => MARGIN + WORDS,
        };
        for (k, line) in entry.lines.iter().enumerate() {
            d.text((x, y + LINE * k as f64), SIZE, INK, Anchor::Start, line);
        }
        y += entry_height(entry);
    }
}

fn sign(d: &mut Drawing, sign: Sign, (x, y): Point) {
    let (left, middle, right) = ((x + 8.0, y), (x + 36.0, y), (x + 68.0, y));
    match sign {
        Sign::None => {}
        Sign::One => {
            bar(d, left, right, VELOCITY_BAR);
            junction(d, left, "1", VELOCITY);
        }
        Sign::Zero => {
            bar(d, left, right, SUM_BAR);
            junction(d, right, "0", SUM);
        }
        Sign::Bond => bond(d, &Bond::single(&[left, right]).stroke_at_start()),
        Sign::Triple => bond(d, &Bond::triple(&[left, right]).stroke_at_start()),
        Sign::Word(word) => d.bold((middle.0, y + 4.5), 13, INK, Anchor::Middle, word),
    }
}

/// A text in lines of this width.
pub(super) fn wrapped(text: &str, size: u32, width: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if text_width(&format!("{line} {word}"), size) <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}
