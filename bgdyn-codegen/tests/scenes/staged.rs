//! Writes `docs/staged.md`: the two stages of a study (Kuzmin 2007), point masses and then distributed
//! masses, on the SCARA and the PUMA 560: the cost of the second stage, and its influence. The page is
//! written with `BGDYN_WRITE=1`; otherwise the test checks that its numbers are up to date.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::Path;

use bgdyn_accuracy::plot::{self, Axis, FAINT, Sign, Stroke, VERMILION, curve, draw, legend, px};
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::system::SceneEquations;

use super::common::{read, scene};

/// Points of a path.
const POINTS: usize = 200;

/// A mechanism under study.
struct Study {
    name: &'static str,
    title: &'static str,
    /// Its scenes: `NAME_lumped`, `NAME_distributed`.
    scenes: &'static str,
    /// Travel of each joint on the path, rad or m, and its duration, s.
    path: &'static [f64],
    period: f64,
}

const STUDIES: [Study; 2] = [
    Study {
        name: "scara",
        title: "SCARA",
        scenes: "scara",
        path: &[1.6, 1.2, 0.1, 3.0],
        period: 0.8,
    },
    Study {
        name: "puma560",
        title: "PUMA 560",
        scenes: "puma",
        path: &[1.6, 0.8, 0.8, 1.6, 1.0, 2.0],
        period: 1.2,
    },
];

const LUMPED: Stroke = Stroke::new(FAINT, 1.0).dashed(5.0, 4.0);
const DISTRIBUTED: Stroke = Stroke::new(VERMILION, 2.0);

/// A panel of the drawing: a curve of each stage.
struct Panel {
    joint: String,
    unit: &'static str,
    stages: [Vec<f64>; 2],
}

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// Returns lumped and distributed scenes, every joint free.
fn free(study: &Study) -> [SceneEquations; 2] {
    let file = root().join(format!("specs/{}.yaml", study.name));
    let mechanism = std::fs::read_to_string(file).expect("a mechanism");
    ["", ", inertia"].map(|inertia| {
        let text = format!(
            "scene: 1\nmechanism: m.yaml\neffects: [gravity, velocity_products{inertia}]\n"
        );
        scene(&text, &mechanism)
    })
}

/// The scenes that move.
fn moving(study: &Study) -> [SceneEquations; 2] {
    ["lumped", "distributed"].map(|stage| {
        let file = format!("specs/scenes/{}_{stage}.scene.yaml", study.scenes);
        read(&root().join(file))
    })
}

/// Returns the efforts along the path: forward and back, at rest at both ends.
fn efforts(study: &Study, system: &SceneEquations) -> Vec<Vec<f64>> {
    let inverse = system.function(SceneFunction::Inverse);
    let mut at = system.start();
    let point = |k: usize| {
        let w = TAU / study.period;
        let angle = TAU * k as f64 / POINTS as f64;
        for (j, reach) in study.path.iter().enumerate() {
            at.q[j] = reach * 0.5 * (1.0 - angle.cos());
            at.v[j] = reach * 0.5 * w * angle.sin();
            let a = reach * 0.5 * w * w * angle.cos();
            at.a.resize(study.path.len(), 0.0);
            at.a[j] = a;
        }
        inverse.evaluate(at.clone()).0
    };
    (0..=POINTS).map(point).collect()
}

/// Positions over time, at `POINTS` + 1 instants, and the time at the end.
fn motion(system: &SceneEquations) -> (Vec<Vec<f64>>, f64) {
    let derivative = system.function(SceneFunction::Derivative);
    let inputs = system.function(SceneFunction::Inputs);
    let (h, end) = (1e-3, system.scene.integration.end);
    let steps = (end / h).round() as usize;
    let mut at = system.start();
    let mut path = Vec::new();
    for k in 0..=steps {
        if k % (steps / POINTS) == 0 {
            path.push(at.q.clone());
        }
        at = stepped(&derivative, &inputs, &at, h);
    }
    (path, end)
}

/// A step of the classical Runge–Kutta method.
fn stepped(derivative: &Function, inputs: &Function, at: &Inputs<f64>, h: f64) -> Inputs<f64> {
    let rates = |at: &Inputs<f64>| {
        let mut at = at.clone();
        at.u = inputs.evaluate(at.clone()).0;
        let (rates, refused) = derivative.evaluate(at.clone());
        assert_eq!(refused, None, "no rates");
        [at.v, rates].concat()
    };
    let moved = |k: &[f64], h: f64| {
        let mut to = at.clone();
        let parts = to.q.iter_mut().chain(&mut to.v);
        parts.zip(k).for_each(|(x, k)| *x += h * k);
        to.t = at.t.map(|t| t + h);
        to
    };
    let k1 = rates(at);
    let k2 = rates(&moved(&k1, 0.5 * h));
    let k3 = rates(&moved(&k2, 0.5 * h));
    let k4 = rates(&moved(&k3, h));
    let mean: Vec<f64> = (0..k1.len())
        .map(|i| (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]) / 6.0)
        .collect();
    moved(&mean, h)
}

/// Component j of each point.
fn column(rows: &[Vec<f64>], j: usize) -> Vec<f64> {
    rows.iter().map(|row| row[j]).collect()
}

fn largest(x: impl Iterator<Item = f64>) -> f64 {
    x.fold(0.0, |most, x| most.max(x.abs()))
}

fn apart([lumped, distributed]: &[Vec<f64>; 2]) -> f64 {
    largest(lumped.iter().zip(distributed).map(|(x, y)| y - x))
}

fn unit(system: &SceneEquations, j: usize) -> (&'static str, &'static str) {
    let rotates = system.graph.coordinates[j].motion == bgdyn_codegen::mechanism::Motion::Rotation;
    if rotates { ("rad", "N·m") } else { ("m", "N") }
}

/// The names of the coordinates that move.
fn names(system: &SceneEquations) -> Vec<String> {
    let coordinates = system.graph.coordinates.iter();
    coordinates.map(|c| c.name.clone()).collect()
}

/// Draws a panel for each joint, over the time to `end`.
fn figure(panels: &[Panel], end: f64) -> String {
    let rows = panels.len().div_ceil(3);
    draw((990, 200 * rows as u32 + 40), |area| {
        let (all, below) = area.split_vertically(px(200 * rows as u32));
        for (panel, part) in panels.iter().zip(all.split_evenly((rows, 3))) {
            let y = Axis::around(panel.stages.iter().flatten().copied(), 7);
            let x = Axis::linear(0.0, end, 7).label("time, s");
            let title = format!("{}, {}", y.quantity(&panel.joint), y.unit(panel.unit));
            let chart = plot::Panel::new(&title, x, y)
                .sides([56, 18, 32, 46])
                .draw(&part)?;
            for (stage, stroke) in panel.stages.iter().zip([LUMPED, DISTRIBUTED]) {
                let last = (stage.len() - 1) as f64;
                let points = stage.iter().enumerate();
                let points = points.map(|(i, x)| (end * i as f64 / last, *x));
                curve(chart.plotting_area(), points, stroke)?;
            }
        }
        let entries = [
            (Sign::Line(LUMPED), "point masses"),
            (Sign::Line(DISTRIBUTED), "distributed masses"),
        ];
        legend(&below, (56.0, 18.0), &entries)
    })
}

/// Operations of a function, and its sines.
fn count(system: &SceneEquations, role: SceneFunction) -> String {
    let o = system.function(role).operations();
    format!("{} ({} sincos)", o.mul + o.add, o.sincos)
}

fn section(study: &Study, write: bool) -> String {
    let (free, moving) = (free(study), moving(study));
    let mut text = format!(
        "## {}\n\n| multiplications and additions | point masses | distributed |\n|---|---|---|\n",
        study.title
    );
    let locked = if moving[0].graph.coordinates.len() < free[0].graph.coordinates.len() {
        ", wrist locked"
    } else {
        ""
    };
    let mut rows = vec![("`inverse`".to_owned(), &free, SceneFunction::Inverse)];
    if !locked.is_empty() {
        rows.push((
            format!("`inverse`{locked}"),
            &moving,
            SceneFunction::Inverse,
        ));
    }
    rows.push((
        format!("`derivative`{locked}"),
        &moving,
        SceneFunction::Derivative,
    ));
    for (what, systems, role) in rows {
        let [lumped, distributed] = [0, 1].map(|k| count(&systems[k], role));
        writeln!(text, "| {what} | {lumped} | {distributed} |").unwrap();
    }
    let along = [0, 1].map(|k| efforts(study, &free[k]));
    text += "\nEfforts along a path on which every joint moves to and fro once";
    writeln!(text, " ({} s):\n", study.period).unwrap();
    text += "| joint | largest effort | largest difference | |\n|---|---|---|---|\n";
    let mut panels = Vec::new();
    for (j, name) in names(&free[1]).into_iter().enumerate() {
        let stages = [0, 1].map(|k| column(&along[k], j));
        let (most, off) = (largest(stages[1].iter().copied()), apart(&stages));
        let (_, unit) = unit(&free[1], j);
        writeln!(
            text,
            "| {name} | {most:.3} {unit} | {off:.3} {unit} | {:.0} % |",
            100.0 * off / most
        )
        .unwrap();
        panels.push(Panel {
            joint: name,
            unit,
            stages,
        });
    }
    let path = format!("images/staged/{}_efforts.svg", study.name);
    writeln!(text, "\n![Efforts along the path]({path})\n").unwrap();
    save(&path, &figure(&panels, study.period), write);
    let [(lumped, end), (distributed, _)] = [0, 1].map(|k| motion(&moving[k]));
    writeln!(text, "The scenes `{0}_lumped` and `{0}_distributed`{locked}, the same efforts and controllers:\n\n| joint | largest difference in {end} s |\n|---|---|", study.scenes).unwrap();
    let mut panels = Vec::new();
    for (j, name) in names(&moving[1]).into_iter().enumerate() {
        let stages = [column(&lumped, j), column(&distributed, j)];
        let (unit, _) = unit(&moving[1], j);
        writeln!(text, "| {name} | {:.3} {unit} |", apart(&stages)).unwrap();
        panels.push(Panel {
            joint: name,
            unit,
            stages,
        });
    }
    let path = format!("images/staged/{}_motion.svg", study.name);
    writeln!(text, "\n![Motion]({path})\n").unwrap();
    save(&path, &figure(&panels, end), write);
    text
}

fn save(path: &str, figure: &str, write: bool) {
    let path = root().join("docs").join(path);
    if write {
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("the folder of figures");
        std::fs::write(path, figure).expect("a figure");
    } else {
        assert!(path.exists(), "{} is missing", path.display());
    }
}

const HEAD: &str = "# A study in two stages

The first stage takes every link as a point mass at its centre of mass; the second adds the terms of the inertia tensors, ρ·(K̇ − M), to the same equations (Kuzmin 2007). A scene says which: without `inertia` the first, with it the second. This page shows on two arms what the second stage costs and what it changes.

With point masses the inverse dynamics is sound for every arm, but a joint may move nothing that has inertia: the PUMA's hand is such a joint, so the scene in which it moves by itself has the wrist locked. Its waist, too, turns a trunk without mass: where next to nothing is left of a joint's own inertia, `derivative` takes articulated bodies with an error bound on every pivot, which costs more than the elimination that the distributed arm gets. On the SCARA the tensors change numbers only: they fold into constants that are there anyway. Counts are of what is generated.

";

#[test]
fn the_staged_study_is_up_to_date() {
    let write = std::env::var_os("BGDYN_WRITE").is_some();
    let mut page = HEAD.to_owned();
    for study in &STUDIES {
        page += &section(study, write);
    }
    page += "To write this page again: `BGDYN_WRITE=1 cargo test --release -p bgdyn-codegen --test scenes staged`.\n";
    let path = root().join("docs/staged.md");
    if write {
        std::fs::write(path, page).expect("the page");
    } else {
        let found = std::fs::read_to_string(path).expect("docs/staged.md");
        assert!(found == page, "docs/staged.md is not up to date");
    }
}
