//! `bgdyn graph`.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::PathBuf;

use bgdyn_codegen::bond_graph;
use bgdyn_codegen::files::{beside, stem};
use bgdyn_codegen::mechanism::{CoordinateId, LinkId, Mechanism, Value as MassValue};
use bgdyn_codegen::read_scene;
use bgdyn_runtime::Dd;

use crate::{bgdyn, root, scratch};

/// The files of a folder.
fn files(folder: &str) -> Vec<PathBuf> {
    let entries = root().join(folder).read_dir().expect("the folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut files: Vec<_> = paths.filter(|path| path.is_file()).collect();
    files.sort();
    files
}

/// Every mechanism and every scene of `specs/`.
fn all() -> Vec<String> {
    let all = [files("specs"), files("specs/scenes")].concat();
    all.iter().map(|path| path.display().to_string()).collect()
}

/// Every spec of `specs/`, with its mechanism.
fn specs() -> Vec<(String, Mechanism)> {
    let specs = files("specs");
    let read = |path: PathBuf| {
        let text = fs::read_to_string(&path).expect("the spec");
        let stem = path.file_stem().expect("a name").to_string_lossy();
        let (mechanism, _) = bgdyn_codegen::read(&text, Some(&stem));
        let mechanism = mechanism.expect("a good spec");
        (path.display().to_string(), mechanism)
    };
    specs.into_iter().map(read).collect()
}

fn svg(file: &str) -> String {
    bgdyn(&["graph", file]).good()
}

fn dot(file: &str) -> String {
    bgdyn(&["graph", file, "--format", "dot"]).good()
}

#[test]
fn a_cart_and_pole_as_svg() {
    insta::assert_snapshot!(svg("specs/cart_pole.yaml"));
}

#[test]
fn a_cart_and_pole_as_dot() {
    insta::assert_snapshot!(dot("specs/cart_pole.yaml"));
}

#[test]
fn a_scara_as_dot() {
    insta::assert_snapshot!(dot("specs/scara.yaml"));
}

/// Links that have neither mass nor inertia.
fn massless(mechanism: &Mechanism) -> Vec<usize> {
    let nothing = |value: &MassValue| *value == MassValue::Fixed(Dd::ZERO);
    let all = mechanism.links().iter().enumerate();
    let none = all.filter(|(_, link)| {
        nothing(&link.inertial.mass) && link.inertial.inertia.entries.iter().all(nothing)
    });
    none.map(|(i, _)| i).collect()
}

/// The drawing has all transformers of the data, and every name.
#[test]
fn what_is_drawn_is_what_is_there() {
    let specs = specs();
    assert!(specs.len() > 10);
    for (file, mechanism) in specs {
        let graph = bond_graph::build(&mechanism);
        let massless = massless(&mechanism);
        let into_massless = |t: &&bond_graph::Transformer| {
            let flows = massless.iter().map(|&i| LinkId(i));
            let mut flows = flows.flat_map(|i| [graph.translation(i), graph.rotation(i)]);
            flows.any(|flow| flow == t.to)
        };
        let folded = graph.transformers.iter().filter(into_massless).count();
        let there = graph.transformers.len() - folded;
        let (svg, dot) = (svg(&file), dot(&file));
        let (drawing, _legend) = svg.split_once("Pⱼ = Σᵢ").expect("a legend");
        let signs = [">MTF</text>", ">TF</text>"].map(|sign| drawing.matches(sign).count());
        assert_eq!(signs[0] + signs[1], there, "{file}");
        let signs = ["\"MTF\\n", "\"TF\\n"].map(|sign| dot.matches(sign).count());
        assert_eq!(signs[0] + signs[1], there, "{file}");
        assert!(
            !dot.contains("(0, 0, 0)") && !drawing.contains("(0, 0, 0)"),
            "{file}"
        );
        for &i in &massless {
            let name = &mechanism.links()[i].name;
            assert!(drawing.contains(name.as_str()), "{file}: {name}");
        }
        let links = mechanism.links().iter().enumerate();
        let links = links
            .filter(|(i, _)| !massless.contains(i))
            .map(|(_, link)| &link.name);
        let joints = (0..mechanism.nv()).map(|j| &mechanism.joint(CoordinateId(j)).name);
        for name in links.chain(joints) {
            assert!(
                drawing.contains(&format!(">{name}</text>")),
                "{file}: {name}"
            );
            assert!(dot.contains(name.as_str()), "{file}: {name}");
        }
    }
}

/// A bond of a DOT file: its ends, and the end with the causal stroke.
struct Bond<'a> {
    ends: [&'a str; 2],
    strokes: [bool; 2],
}

/// Nodes with their labels, and bonds.
fn parsed(dot: &str) -> (BTreeMap<&str, &str>, Vec<Bond<'_>>) {
    let (mut nodes, mut bonds) = (BTreeMap::new(), Vec::new());
    for line in dot.lines().map(str::trim) {
        let Some((name, style)) = line.split_once(" [") else {
            continue;
        };
        let style = style.strip_suffix("];").expect("the end of a statement");
        if let Some((from, to)) = name.split_once(" -> ") {
            let strokes = [
                style.contains("arrowtail=tee"),
                style.contains("arrowhead=tee"),
            ];
            let ends = [from, to];
            bonds.push(Bond { ends, strokes });
        } else if name != "node" && name != "edge" {
            let label = style.strip_prefix("label=\"").expect("a label");
            let label = label.strip_suffix('"').expect("a label");
            assert!(nodes.insert(name, label).is_none(), "{name} is drawn twice");
        }
    }
    (nodes, bonds)
}

/// The DOT text is valid: matching brackets, valid names, bonds between existing nodes.
#[test]
fn dot_is_sound() {
    for file in all() {
        let dot = dot(&file);
        for (open, close) in [("{", "}"), ("[", "]")] {
            assert_eq!(
                dot.matches(open).count(),
                dot.matches(close).count(),
                "{file}"
            );
        }
        let quotes = dot.replace("\\\"", "").matches('"').count();
        assert!(quotes.is_multiple_of(2), "{file}");
        let (nodes, bonds) = parsed(&dot);
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
        assert!(nodes.keys().all(|name| name.chars().all(plain)), "{file}");
        let joined: BTreeSet<&str> = bonds.iter().flat_map(|bond| bond.ends).collect();
        assert_eq!(joined, nodes.keys().copied().collect(), "{file}");
    }
}

#[test]
fn causal_strokes_obey_the_junctions() {
    for file in all() {
        obeys_causality(&file);
    }
}

/// Checks the rules of causality: one effort determines a 0-junction, one flow a 1-junction; one stroke at
/// a transformer, none or two at a gyrator. A velocity's 1-junction, or a drive behind a gear, may be
/// undetermined. A pressure that is drawn elsewhere determines its effort.
fn obeys_causality(file: &str) {
    let dot = dot(file);
    let (nodes, bonds) = parsed(&dot);
    for (name, label) in nodes {
        let at = |bond: &Bond<'_>| {
            let end = bond.ends.iter().position(|end| *end == name)?;
            Some(bond.strokes[end])
        };
        let own: Vec<bool> = bonds.iter().filter_map(at).collect();
        let strokes = own.iter().filter(|stroke| **stroke).count();
        let words: Vec<&str> = label.split(&[':', '\\'][..]).collect();
        let allowed = match (words[0], own.len()) {
            ("0", 3..) => strokes == 1,
            ("0", 2) if label.starts_with("0\\n") => strokes == 1,
            ("0", 1) => strokes == 0 && label.ends_with(", see above"),
            ("1", bonds) => strokes + 1 == bonds,
            (velocity, bonds) if velocity.starts_with('q') => bonds - strokes <= 1,
            ("MTF" | "TF", 2) if label.contains("\\n(") => strokes == 1,
            ("TF", 2) => strokes <= 1,
            ("GY", 2) => strokes != 1,
            ("I" | "R", 1) => true,
            ("Sf", 1) => strokes == 1,
            ("Se" | "C", 1) => strokes == 0,
            _ => false,
        };
        assert!(allowed, "{file}: {name}, {label}: {own:?}");
    }
}

/// A vane actuator behind a four-way valve, with leakage between its sides and two orifices in series into
/// a soft hose.
const VANE: &str = "\
format: 1
links:
  - { name: arm, joint: { name: shoulder, type: revolute, axis: y }, mass: 1, com: [1, 0, 0] }
effects:
  oil: { type: fluid, bulk_modulus: 1 GPa }
  pump: { type: supply, pressure: 20 MPa }
  sump: { type: tank }
  vane: { type: cylinder, joint: shoulder, area_a: 9e-5, area_b: 8e-5, dead_a: 1e-4, dead_b: 1e-4 }
  valve: { type: four_way_valve, supply: pump, tank: sump, a: vane_a, b: vane_b, flow: 1e-7 }
  leak: { type: leakage, from: vane_a, to: vane_b, conductance: 1e-13 }
  bend: { type: junction }
  hose: { type: line, volume: 1e-5 }
  first: { type: orifice, from: vane_a, to: bend, flow: 1e-7 }
  second: { type: orifice, from: bend, to: hose, flow: 2e-7 }
";

#[test]
fn hydraulics_of_a_joint() {
    scratch("graph_hydraulics", "arm.yaml", VANE);
    let text = "scene: 1\nmechanism: arm.yaml\neffects: [gravity, inertia, hydraulics]\n";
    let file = scratch("graph_hydraulics", "run.scene.yaml", text);
    obeys_causality(&file);
    let dot = dot(&file);
    let (nodes, bonds) = parsed(&dot);
    let count = |words: &str| nodes.values().filter(|label| label.contains(words)).count();
    // The four paths of the valve, two of them to each side; the leakage once; the series on one junction.
    for (words, times) in [
        ("R: valve, open where x > 0", 2),
        ("R: valve, open where x < 0", 2),
        ("R: leak", 1),
        ("R: first", 1),
        ("C: oil in ", 3),
        ("Se: pump, p = 20 MPa", 2),
        ("vane_a, see above", 0),
        ("vane_b, see above", 1),
        ("TF: vane, A = 9e-5", 1),
        ("TF: vane, A = −8e-5", 1),
        ("bend", 0),
    ] {
        assert_eq!(count(words), times, "{words}: {dot}");
    }
    let named = |label: &str| {
        let found = nodes.iter().find(|(_, words)| words.contains(label));
        *found.expect("a node").0
    };
    let beside = |name: &str| {
        let own = bonds.iter().find(|bond| bond.ends.contains(&name));
        let ends = own.expect("a bond").ends;
        if ends[0] == name { ends[1] } else { ends[0] }
    };
    assert_eq!(beside(named("R: first")), beside(named("R: second")));
}

/// All effects of a scene are in its drawing.
#[test]
fn every_effect_of_a_scene_is_named() {
    for path in files("specs/scenes") {
        let text = fs::read_to_string(&path).expect("the scene");
        let load = |name: &str| fs::read_to_string(beside(&path, name)).map_err(|e| e.to_string());
        let (system, _) = read_scene(&text, &stem(&path), load).expect("a good scene");
        let file = path.display().to_string();
        let (svg, dot) = (svg(&file), dot(&file));
        let elements = system.scene.elements.iter();
        for element in elements.filter(|e| !e.effect.built_in()) {
            let name = &element.name;
            assert!(svg.contains(name) && dot.contains(name), "{file}: {name}");
        }
    }
    let everywhere = svg("specs/scenes/ur5_contact.scene.yaml");
    assert!(!everywhere.contains("Not drawn: "));
    for words in [
        "flange, rad/s and m/s",
        "V₂",
        "wall (wrench)",
        "elbow_water (drag)",
    ] {
        assert!(everywhere.contains(words), "{words}");
    }
    let crane = svg("specs/scenes/crane.scene.yaml");
    assert!(!crane.contains("Not drawn: ") && crane.contains("slew_friction (viscous)"));
}

#[test]
fn an_elastic_drive_as_dot() {
    insta::assert_snapshot!(dot("specs/scenes/series_elastic_arm.scene.yaml"));
}

#[test]
fn the_format_is_what_the_name_ends_with() {
    let scara = "specs/scara.yaml";
    for (name, wanted) in [
        ("a.svg", svg(scara)),
        ("a.gv", dot(scara)),
        ("a.DOT", dot(scara)),
    ] {
        let output = scratch("graph_format", name, "");
        assert_eq!(bgdyn(&["graph", scara, "-o", &output]).good(), "");
        assert_eq!(fs::read_to_string(&output).expect("the output"), wanted);
    }
    let output = scratch("graph_format", "a.txt", "");
    bgdyn(&["graph", scara, "-o", &output, "--format", "dot"]).good();
    assert_eq!(fs::read_to_string(&output).expect("the output"), dot(scara));
    let stderr = bgdyn(&["graph", scara, "-o", &output]).bad_usage();
    assert!(
        stderr.contains("`.txt` is no format of drawings"),
        "{stderr}"
    );
}

/// Faults are printed as by `bgdyn check`, except the last line.
#[test]
fn a_bad_file_is_refused_as_by_check() {
    for name in ["negative_mass", "unknown_parent"] {
        let file = format!("specs/invalid/{name}.yaml");
        let told = |command: &str| {
            let run = bgdyn(&[command, &file]);
            assert_eq!(run.stdout, "");
            let stderr = run.bad_input();
            let (faults, _) = stderr.trim_end().rsplit_once('\n').expect("lines");
            faults.to_owned()
        };
        assert_eq!(told("graph"), told("check"));
    }
    let stderr = bgdyn(&["graph", "nowhere.yaml"]).bad_input();
    assert!(
        stderr.starts_with("bgdyn: nowhere.yaml cannot be read: "),
        "{stderr}"
    );
    let stderr = bgdyn(&["graph", "specs/scara.yaml", "-o", "no/such/folder/a.svg"]).bad_input();
    assert!(stderr.contains("a.svg cannot be written: "), "{stderr}");
}

/// Names with special characters are escaped in the drawing.
#[test]
fn words_are_escaped() {
    let text = "\
format: 1
label: 'A \"small\" <arm> & \\ more'
links:
  - name: base
    joint: { type: fixed }
    mass: 1
  - name: arm
    parent: base
    joint: { name: shoulder, type: revolute, axis: y }
    mass: { parameter: load, value: 2 kg }
    com: [{ parameter: reach, value: 1 m }, 0, 0]
";
    let file = scratch("graph_words", "arm.yaml", text);
    let (svg, dot) = (svg(&file), dot(&file));
    assert!(
        svg.contains("A \"small\" &lt;arm&gt; &amp; \\ more: bond graph"),
        "{svg}"
    );
    assert!(
        dot.contains("\"A \\\"small\\\" <arm> & \\\\ more: bond graph\""),
        "{dot}"
    );
    assert!(svg.contains("No joint moves base") && dot.contains("No joint moves base"));
    assert!(dot.contains("I: m₂ = load kg") && dot.contains("Se: R₂ = load·(0, 0, −9.81) N"));
    parsed(&dot);
}

/// `docs/graph.md` contains the commands that made them.
#[test]
fn the_pictures_of_the_page_are_up_to_date() {
    for (name, file) in [
        ("cart_pole", "specs/cart_pole.yaml"),
        ("scara", "specs/scara.yaml"),
        ("torso", "specs/torso.yaml"),
        (
            "hydraulic_cylinder",
            "specs/scenes/hydraulic_cylinder.scene.yaml",
        ),
        ("crane", "specs/scenes/crane.scene.yaml"),
    ] {
        let picture = format!("docs/images/graph_{name}.svg");
        let kept = fs::read_to_string(root().join(&picture)).expect("the picture");
        assert!(kept == svg(file), "bgdyn graph {file} -o {picture}");
    }
}

/// The base is no link of the drawing; a note says that it moves.
#[test]
fn a_base_whose_motion_is_given_is_a_note() {
    let file = root().join("tests/free_joints/boom.yaml");
    let drawn = bgdyn(&["graph", &file.display().to_string()]).good();
    let words: String = drawn
        .split('<')
        .filter_map(|part| part.split_once('>'))
        .fold(String::new(), |text, (_, words)| text + words.trim() + " ");
    assert!(words.contains("4 velocities, 2 links"), "{words}");
    assert!(words.contains("The base moves"), "{words}");
    assert!(!words.contains("moving_base"), "{words}");
}
