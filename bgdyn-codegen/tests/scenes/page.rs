//! Writes `docs/effects.md`: every effect with its equation, its keys, its element on the graph, its cost
//! and its influence. The page is written with `BGDYN_WRITE=1`; otherwise the test checks that it is up to
//! date.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use bgdyn_accuracy::plot::{
    Area, Axis, Drawn, FAINT, INK, Panel, Sign, Stroke, VERMILION, at, curve, draw, legend, px,
    text, write,
};
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

const WITH: Stroke = Stroke::new(VERMILION, 2.0);
const WITHOUT: Stroke = Stroke::new(FAINT, 1.0).dashed(5.0, 4.0);

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
    // Typical inputs of a caller: 4 V, 4 N, a valve opened by a fifth: the piston stays within its stroke.
    for (value, part) in at.u.iter_mut().zip(&layout.inputs) {
        *value = if part.name.ends_with("fx") || part.drives.is_some() {
            4.0
        } else {
            0.0
        };
        if part.name == "valve" {
            *value = 0.2;
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

/// Draws a bond graph in a line, and the motion with the effect and without.
fn figure(effect: &dyn Effect, paths: [&[[f64; 2]]; 2]) -> String {
    draw((860, 265), |area| {
        let (left, rest) = area.split_horizontally(px(200));
        graph(&left, effect)?;
        let (panels, below) = rest.split_vertically(px(235));
        for (k, part) in panels.split_evenly((1, 2)).iter().enumerate() {
            let (name, unit) = [("turn", "rad"), ("slide", "m")][k];
            let points = |path: &[[f64; 2]]| {
                let every = path.iter().enumerate().step_by(16);
                let points = every.map(|(i, x)| (i as f64 * STEP, x[k]));
                points.filter(|p| p.1.is_finite()).collect::<Vec<_>>()
            };
            let paths = paths.map(points);
            let y = Axis::around(paths.iter().flatten().map(|p| p.1), 7);
            let x = Axis::linear(0.0, STEPS as f64 * STEP, 5).label("time, s");
            let title = format!("{}, {}", y.quantity(name), y.unit(unit));
            let panel = Panel::new(&title, x, y).sides([56, 18, 32, 46]);
            let chart = panel.draw(part)?;
            for (points, stroke) in paths.into_iter().zip([WITH, WITHOUT]) {
                curve(chart.plotting_area(), points, stroke)?;
            }
        }
        let entries = [
            (Sign::Line(WITH), "with the effect"),
            (Sign::Line(WITHOUT), "without"),
        ];
        legend(&below, (56.0, 14.0), &entries)
    })
}

/// Draws the element on its junction: a bond with its half arrow.
fn graph(area: &Area<'_>, effect: &dyn Effect) -> Drawn {
    let junction = match effect.family() {
        "hydraulics" => "0  p",
        "gravity" | "inertia" => "1  ṙ, ω",
        "contact" => "1  γ",
        _ => "1  q̇",
    };
    let symbol = text(18, INK);
    write(area, (20.0, 124.0), junction, symbol.clone())?;
    write(area, (158.0, 124.0), effect.symbol(), symbol.clone())?;
    let bond = [at(92.0, 124.0), at(150.0, 124.0), at(141.0, 116.0)];
    curve(area, bond, Stroke::new(INK, 1.5))?;
    write(area, (20.0, 156.0), effect.keyword(), text(13, FAINT))
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
        Reads::Contact => "a contact".into(),
        Reads::Contacts => "`all` or a list of contacts".into(),
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

What a [scene](scenes.md) can call for. Each effect is an element of the bond graph: a store (`I`, `C`), a resistor (`R`), a gyrator or transformer (`GY`, `TF`, `MTF`), a source (`Se`, `Sf`). The figures show it on its junction, and what it does to one mechanism: an arm that turns under gravity and carries a sled on a slide, for two seconds, from 0.5 rad and 0.05 m at 0.6 m/s. Inputs that a caller would give are 4 in their unit, a valve is open by a fifth; the hydraulic elements act together, as one circuit with a cylinder on the slide. The cost is what the scene's `derivative` takes more than without the effect.

Equations, sources and refused values in detail: [friction](effects/friction.md), [springs, dampers, stops](effects/springs.md), [contact](effects/contact.md), [drives](effects/drives.md)MORE.

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
