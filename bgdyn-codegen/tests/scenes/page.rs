//! Writes `docs/effects.md`: every effect with its equation, its keys, its element on the graph, its cost
//! and its influence. The page is written with `BGDYN_WRITE=1`; otherwise the test checks that it is up to
//! date.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use bgdyn_accuracy::dark::with_dark_mode;
use bgdyn_codegen::declaration::keys_declared;
use bgdyn_codegen::effect::{EFFECTS, Effect};
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::format::{Key, Reads};
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::system::SceneEquations;

use super::common::scene;
use super::written::{ALL, TENSOR, WRITTEN, mechanism, names};

/// Steps of a run, and their length, s.
const STEPS: usize = 4000;
const STEP: f64 = 5e-4;

fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs")
}

/// The scene of the arm and the sled with an effect, and without.
fn pair(effect: &dyn Effect) -> [SceneEquations; 2] {
    let start = "initial: { turn: 0.5, slide: 0.05, slide_rate: 0.6 }\n";
    let all = ALL.replace("inputs: { turn: given, slide: given }\n", start);
    if effect.built_in() {
        let keyword = effect.keyword();
        let arm = mechanism("", TENSOR, "");
        let without = all
            .replace(keyword, "")
            .replace("[, ", "[")
            .replace(", ,", ",");
        let without = without.replace(", ]", "]");
        return [scene(&all, &arm), scene(&without, &arm)];
    }
    let written = WRITTEN.iter().find(|(k, _)| *k == effect.keyword());
    let (_, written) = written.expect("an example of every effect");
    let declared = format!("effects:\n  extra: {written}\n");
    let arm = mechanism("", TENSOR, &declared);
    let called = format!("velocity_products, {}]", names(written));
    let with = all.replace("velocity_products]", &called);
    let with = if written.contains("ram:") {
        with.replace(
            "slide_rate: 0.6 }",
            "slide_rate: 0.6, ram_a: 5 MPa, ram_b: 5 MPa, hose: 10 MPa }",
        )
    } else {
        with
    };
    [scene(&with, &arm), scene(&all, &arm)]
}

/// Positions of turn and slide over time.
fn run(system: &SceneEquations) -> Vec<[f64; 2]> {
    let derivative = system.function(SceneFunction::Derivative);
    let layout = &system.scene.layout;
    let contacts = (!layout.modes.is_empty()).then(|| system.function(SceneFunction::Contacts));
    let mut at = system.start();
    // Typical inputs of a caller: 4 V, 4 N, a half open valve.
    for (value, part) in at.u.iter_mut().zip(&layout.inputs) {
        *value = if part.name.ends_with("fx") || part.drives.is_some() {
            4.0
        } else {
            0.0
        };
        if part.name == "valve" {
            *value = 0.5;
        }
    }
    let mut path = Vec::new();
    for _ in 0..STEPS {
        path.push([at.q[0], at.q[1]]);
        // Stiff laws take shorter steps.
        let (parts, h) = (200, STEP / 200.0);
        let parts = if layout.nx() + layout.nv() > 2 || system.scene.elements.len() > 3 {
            parts
        } else {
            4
        };
        let h = if parts == 4 { STEP / 4.0 } else { h };
        for _ in 0..parts {
            at = stepped(&derivative, layout.nq(), &at, h);
            if let Some(contacts) = &contacts {
                hold_or_slip(contacts, &mut at);
            }
        }
    }
    path
}

fn stepped(derivative: &Function, nq: usize, at: &Inputs<f64>, h: f64) -> Inputs<f64> {
    let rates = |at: &Inputs<f64>| derivative.evaluate(at.clone()).0;
    let moved = |by: &Inputs<f64>, r: &[f64], h: f64| {
        let mut to = at.clone();
        (0..nq).for_each(|j| to.q[j] += h * by.v[j]);
        let nv = to.v.len();
        (0..nv).for_each(|j| to.v[j] += h * r[j]);
        (0..to.x.len()).for_each(|i| to.x[i] += h * r[nv + i]);
        to
    };
    let first = rates(at);
    let middle = moved(at, &first, 0.5 * h);
    let second = rates(&middle);
    moved(&middle, &second, h)
}

/// Determines the mode of the only contact of these scenes: held at rest, slipping after breaking away.
fn hold_or_slip(contacts: &Function, at: &mut Inputs<f64>) {
    let found = contacts.evaluate(at.clone()).0;
    let (slip, holding, limit) = (found[0], found[2], found[3]);
    if at.modes[0] == 0.0 && holding.abs() > limit {
        at.modes[0] = -holding.signum();
    } else if at.modes[0] != 0.0 && slip * at.modes[0] < 0.0 {
        at.modes[0] = 0.0;
        at.v[1] -= slip;
    } else if at.modes[0] == 0.0 && slip.abs() > 1e-9 {
        at.modes[0] = slip.signum();
    }
}

/// A bond graph in a line, and the motion with the effect and without.
fn figure(effect: &dyn Effect, paths: [&[[f64; 2]]; 2]) -> String {
    let mut svg = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"860\" height=\"250\" font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"860\" height=\"250\" fill=\"white\"/>\n",
    );
    graph(&mut svg, effect);
    for (k, what) in ["turn, rad", "slide, m"].into_iter().enumerate() {
        let left = 250.0 + 310.0 * k as f64;
        let all = || {
            paths
                .iter()
                .flat_map(|p| p.iter().map(|x| x[k]))
                .filter(|x| x.is_finite())
        };
        let (low, high) = all().fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(x), h.max(x)));
        let high = if high - low < 1e-9 { low + 1.0 } else { high };
        let y = |x: f64| 205.0 - 165.0 * (x - low) / (high - low);
        writeln!(svg, "<rect x=\"{left}\" y=\"40\" width=\"240\" height=\"165\" fill=\"none\" stroke=\"#999\"/>").unwrap();
        writeln!(svg, "<text x=\"{left}\" y=\"30\">{what}</text>").unwrap();
        for (at, value) in [(40.0 + 8.0, high), (205.0, low)] {
            writeln!(
                svg,
                "<text x=\"{}\" y=\"{at}\" text-anchor=\"end\" font-size=\"11\">{value:.2}</text>",
                left - 5.0
            )
            .unwrap();
        }
        for (at, text) in [(left, "0"), (left + 240.0, "2 s")] {
            writeln!(
                svg,
                "<text x=\"{at}\" y=\"220\" text-anchor=\"middle\" font-size=\"11\">{text}</text>"
            )
            .unwrap();
        }
        for (path, style) in paths.iter().zip([
            "stroke=\"#c0392b\" stroke-width=\"2\"",
            "stroke=\"#555\" stroke-dasharray=\"5 4\"",
        ]) {
            let every = path.iter().enumerate().step_by(16);
            let points: Vec<String> = every
                .filter(|(_, x)| x[k].is_finite())
                .map(|(i, x)| {
                    format!(
                        "{:.1},{:.1}",
                        left + 240.0 * i as f64 / STEPS as f64,
                        y(x[k])
                    )
                })
                .collect();
            writeln!(
                svg,
                "<polyline fill=\"none\" {style} points=\"{}\"/>",
                points.join(" ")
            )
            .unwrap();
        }
    }
    svg += "<line x1=\"330\" y1=\"238\" x2=\"360\" y2=\"238\" stroke=\"#c0392b\" stroke-width=\"2\"/><text x=\"366\" y=\"242\">with the effect</text>\n<line x1=\"490\" y1=\"238\" x2=\"520\" y2=\"238\" stroke=\"#555\" stroke-dasharray=\"5 4\"/><text x=\"526\" y=\"242\">without</text>\n</svg>\n";
    with_dark_mode(&svg)
}

/// The element on its junction: a bond with its half arrow.
fn graph(svg: &mut String, effect: &dyn Effect) {
    let junction = match effect.family() {
        "hydraulics" => "0  p",
        "gravity" | "inertia" => "1  ṙ, ω",
        _ => "1  q̇",
    };
    let (name, symbol) = (effect.keyword(), effect.symbol());
    write!(
        svg,
        "<text x=\"20\" y=\"130\" font-size=\"18\">{junction}</text>\n\
         <line x1=\"75\" y1=\"124\" x2=\"140\" y2=\"124\" stroke=\"black\" stroke-width=\"1.5\"/>\n\
         <line x1=\"140\" y1=\"124\" x2=\"131\" y2=\"116\" stroke=\"black\" stroke-width=\"1.5\"/>\n\
         <text x=\"148\" y=\"130\" font-size=\"18\">{symbol}</text>\n\
         <text x=\"20\" y=\"160\" fill=\"#555\">{name}</text>\n"
    )
    .unwrap();
}

/// Describes the values of a key.
fn reads(key: &Key) -> String {
    match key.reads {
        Reads::Number(fit) => {
            let units: Vec<&str> = fit
                .iter()
                .map(|d| d.si())
                .filter(|u| !u.is_empty())
                .collect();
            match units.as_slice() {
                [] => "number".into(),
                units => units.join(" or "),
            }
        }
        Reads::Vector(fit) => format!("three numbers, {}", fit[0].si()),
        Reads::Axis => "a direction".into(),
        Reads::Plane => "a plane".into(),
        Reads::Word(words) => words.join(" or "),
        Reads::Words(words) => format!("list of {}", words.join(", ")),
        Reads::Coordinate => "a coordinate".into(),
        Reads::Joint => "a joint".into(),
        Reads::Joints => "`all` or a list of coordinates".into(),
        Reads::Site => "a link or frame".into(),
        Reads::Sites => "two links or frames".into(),
        Reads::Node => "a node".into(),
        Reads::Input => "name of an input".into(),
        Reads::Group(..) | Reads::Coefficients(_) => "numbers by name".into(),
    }
}

fn cost(system: &SceneEquations) -> (usize, usize, usize) {
    let operations = system.function(SceneFunction::Derivative).operations();
    let layout = &system.scene.layout;
    let states = layout.nq() + layout.nv() + layout.nx() + layout.modes.len();
    (
        operations.total(),
        operations.other + operations.div + operations.sqrt,
        states,
    )
}

fn signed(more: usize, less: usize) -> String {
    format!("{:+}", more as isize - less as isize)
}

fn section(effect: &dyn Effect, pair: &[SceneEquations; 2]) -> String {
    let mut text = format!("## `{}`\n\n", effect.keyword());
    let summary = effect.summary();
    let mut letters = summary.chars();
    let first: String = letters
        .next()
        .map(|c| c.to_uppercase().collect())
        .unwrap_or_default();
    writeln!(text, "{first}{}.\n", letters.as_str()).unwrap();
    writeln!(text, "![{0}](images/effects/{0}.svg)\n", effect.keyword()).unwrap();
    let ([more, others_more, states_more], [less, others_less, states_less]) = (
        <[usize; 3]>::from(cost(&pair[0])),
        <[usize; 3]>::from(cost(&pair[1])),
    );
    writeln!(
        text,
        "On the arm with the sled: {} multiplications and additions, {} other operations, {} numbers of state.\n",
        signed(more, less),
        signed(others_more, others_less),
        signed(states_more, states_less)
    )
    .unwrap();
    if !effect.keys().is_empty() {
        text += "| key | needed | value | |\n|---|---|---|---|\n";
        for key in &keys_declared(effect) {
            let needed = if key.needed { "yes" } else { "no" };
            let about = key.about.replace('|', "\\|");
            writeln!(
                text,
                "| `{}` | {needed} | {} | {about} |",
                key.name,
                reads(key)
            )
            .unwrap();
        }
        text += "\n";
    }
    text
}

const HEAD: &str = "# Effects

What a [scene](scenes.md) can call for. Each effect is an element of the bond graph: a store (`I`, `C`), a resistor (`R`), a gyrator or transformer (`GY`, `TF`, `MTF`), a source (`Se`, `Sf`). The figures show it on its junction, and what it does to one mechanism: an arm that turns under gravity and carries a sled on a slide, for two seconds, from 0.5 rad and 0.05 m at 0.6 m/s. Inputs that a caller would give are 4 in their unit, a valve is open by half; the hydraulic elements act together, as one circuit with a cylinder on the slide. The cost is what the scene's `derivative` takes more than without the effect.

Equations, sources and refused values in detail: [friction](effects/friction.md), [springs, dampers, stops](effects/springs.md), [drives](effects/drives.md)MORE.

What none of them costs where a scene does not call for it is tested byte for byte (`cargo test -p bgdyn-codegen --test scenes zero`). For your own scene: `bgdyn ops SCENE --per-effect`.

";

#[test]
fn the_page_of_effects_holds_what_there_is() {
    let write = std::env::var_os("BGDYN_WRITE").is_some();
    let others = ["hydraulics", "bodies", "loads"]
        .into_iter()
        .filter(|name| docs().join(format!("effects/{name}.md")).exists());
    let more: String = others
        .map(|name| format!(", [{name}](effects/{name}.md)"))
        .collect();
    let mut page = HEAD.replace("MORE", &more);
    let figures = docs().join("images/effects");
    for effect in EFFECTS {
        let pair = pair(effect);
        page += &section(effect, &pair);
        let figure_path = figures.join(format!("{}.svg", effect.keyword()));
        if write {
            std::fs::create_dir_all(&figures).expect("the folder of figures");
            let paths = [run(&pair[0]), run(&pair[1])];
            let figure = figure(effect, [&paths[0], &paths[1]]);
            std::fs::write(figure_path, figure).expect("a figure");
        } else {
            assert!(figure_path.exists(), "no figure of {}", effect.keyword());
        }
    }
    page += "To write this page again: `BGDYN_WRITE=1 cargo test --release -p bgdyn-codegen --test scenes page`.\n";
    let path = docs().join("effects.md");
    if write {
        std::fs::write(path, page).expect("the page");
    } else {
        let found = std::fs::read_to_string(path).expect("docs/effects.md");
        assert!(found == page, "docs/effects.md is not up to date");
    }
}
