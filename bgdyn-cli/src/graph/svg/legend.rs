//! Draws the legend below a drawing.

use super::drawing::{Anchor, Drawing, GRID, INK};

use super::super::chart::{Chart, Component, Port};
use super::super::layout::{MARGIN, text_width};
use super::style::{LINE, SUM, SUM_BAR, VELOCITY, VELOCITY_BAR};
use super::symbols::{Bond, Point, bar, bond, junction};

/// Left edge of the text.
const WORDS: f64 = 88.0;
const SPACE: f64 = 9.0;
const SIZE: u32 = 12;

/// A sign with its meaning, line by line.
pub(super) struct LegendEntry {
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
const LINE_RATE: &str = "rate of the length between two places, m/s; the transformers on the way there are ∂s/∂qⱼ, one number each";
const SITE: &str = "motion [ω; v] of a place of a link, rad/s and m/s; the transformers on the way there are the columns of its Jacobian J, of six numbers each";
const LOOP: &str = "velocity of place b of a loop relative to its place a, one number for each row: the flow source holds it at 0, and its effort are the multipliers λ; the transformers on the way there are rows of B";
const CONTACT: &str = "velocity of a sphere relative to what it touches, at the contact point, m/s; the transformers on the way there are the columns of its Jacobian, of three numbers each";
const TF: &str = "transformer whose modulus is the same at all times";
const PARAMETER: &str = "the same at all times, but a run-time parameter";
const STORE: &str = "inertial store: mass m, kg; inertia J, kg·m², about the centre of mass in the link's axes. Derivative causality: every link's flow follows from the q̇, so the stores meet in the mass matrix";
const INTEGRAL: &str = ". Where its stroke is at the store, its own state gives the flow.";
const SOURCE: &str = "source of effort: P the drive of a joint, R the weight of a link, N; u a voltage, p a pressure";

const FLOW: &str = "source of flow: a reference that moves by itself";
const LOOP_FLOW: &str = "source of flow: 0 in a loop";
const GEAR: &str = "on a joint's drive: a gear, at the joint's scale, with its efficiency η";
const CYLINDER: &str = "on a joint or a line: a side of a cylinder, of area A: effort = A · pressure, flow of fluid = A · velocity";
const RESISTOR: &str =
    "resistor: friction, a damper, a winding, an orifice; takes power and stores none";
const COMPLIANCE: &str = "compliance: a spring, a stop, a contact, a soft drive, fluid under pressure; stores by displacement";
const GYRATOR: &str = "gyrator, a DC motor: effort on the joint = k N · current, induced voltage = k N · velocity; u is the voltage fed to it, V";

/// Returns the entries for a drawing, in lines of this width.
pub(super) fn lines(chart: &Chart, width: f64) -> Vec<LegendEntry> {
    let entry = |(sign, words): (Sign, String)| {
        let room = match sign {
            Sign::None => width,
            _ => width - WORDS,
        };
        LegendEntry {
            sign,
            lines: wrapped(&words, SIZE, room),
        }
    };
    let all = [junctions_and_bonds(chart), elements(chart)].concat();
    all.into_iter().map(entry).collect()
}

/// Returns the entries for the junctions and bonds in the drawing.
fn junctions_and_bonds(chart: &Chart) -> Vec<(Sign, String)> {
    let mut entries = vec![(Sign::None, EQUATION.into()), (Sign::One, ONE.into())];
    if chart.flows().any(|flow| flow.sums()) || chart.has(|port| port.symbol == "0") {
        entries.push((Sign::Zero, ZERO.into()));
    }
    let asked = chart.has(|port| port.on_junction.is_none());
    let drives = if asked { DRIVES } else { "." };
    entries.push((Sign::Bond, [BOND, drives].concat()));
    entries.push((Sign::Triple, TRIPLE.into()));
    entries
}

/// Returns the entries for transformers, stores and other elements.
fn elements(chart: &Chart) -> Vec<(Sign, String)> {
    let of_symbol = |symbol| chart.transformers().any(|t| t.symbol() == symbol);
    let mut components = chart.transformers().flat_map(|t| &t.modulus);
    let integral = chart.has(|p| p.symbol == "I" && p.on_junction == Some(false));
    let own = if integral { INTEGRAL } else { "." };
    let store = [STORE, own].concat();
    let flow = match chart.loops.is_empty() {
        true => FLOW,
        false => LOOP_FLOW,
    };
    let stands = |symbol| chart.has(|port| port.symbol == symbol);
    let filled = |port: &Port| port.ports.iter().any(|behind| behind.symbol == "0");
    let entries = [
        ("MTF", MTF, of_symbol("MTF")),
        ("ṡ", LINE_RATE, !chart.lines.is_empty()),
        ("V", SITE, !chart.sites.is_empty()),
        ("ċ", LOOP, !chart.loops.is_empty()),
        ("γ", CONTACT, !chart.contacts.is_empty()),
        ("TF", TF, of_symbol("TF")),
        (
            "p",
            PARAMETER,
            components.any(|c| *c == Component::Parameter),
        ),
        ("I", store.as_str(), stands("I")),
        ("Se", SOURCE, stands("Se")),
        ("Sf", flow, stands("Sf")),
        ("TF", GEAR, chart.has(|p| p.symbol == "TF" && !filled(p))),
        ("TF", CYLINDER, chart.has(|p| p.symbol == "TF" && filled(p))),
        ("R", RESISTOR, stands("R")),
        ("C", COMPLIANCE, stands("C")),
        ("GY", GYRATOR, stands("GY")),
    ];
    let there = entries.into_iter().filter(|(_, _, there)| *there);
    there
        .map(|(symbol, words, _)| (Sign::Word(symbol), words.to_owned()))
        .collect()
}

/// Returns the height of the entries, with the margin below.
pub(super) fn height(entries: &[LegendEntry]) -> f64 {
    entries.iter().map(entry_height).sum::<f64>() + 24.0 + MARGIN
}

fn entry_height(entry: &LegendEntry) -> f64 {
    LINE * entry.lines.len() as f64 + SPACE
}

/// Draws the entries below `top`.
pub(super) fn draw(d: &mut Drawing, entries: &[LegendEntry], top: f64) {
    let mut y = top + 28.0;
    d.line((MARGIN, top + 8.0), (d.width() - MARGIN, top + 8.0), GRID);
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

/// Breaks a text into lines of this width.
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
