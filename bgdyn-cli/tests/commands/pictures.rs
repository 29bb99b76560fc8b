//! Checks properties of every picture in the repository and of the commands.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::{bgdyn, root, scratch};

/// All drawings below a folder.
fn drawings(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in folder.read_dir().expect("the folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            found.extend(drawings(&path));
        } else if path.extension().is_some_and(|e| e == "svg") {
            found.push(path);
        }
    }
    found
}

/// Checks that a drawing has a style for dark pages, coordinates in tenths, and no code marks.
fn holds(name: &str, svg: &str) {
    let dark = svg.split("prefers-color-scheme: dark").nth(1);
    let (rules, body) = dark.and_then(|d| d.split_once("</style>")).expect(name);
    for attribute in ["fill", "stroke"] {
        let start = format!(" {attribute}=\"");
        let all = body.split(start.as_str()).skip(1);
        let colours: BTreeSet<&str> = all.filter_map(|rest| rest.split('"').next()).collect();
        for colour in colours.into_iter().filter(|c| *c != "none") {
            let rule = format!("[{attribute}=\"{colour}\"]{{{attribute}:#");
            assert!(
                rules.contains(&rule),
                "{name}: no dark {attribute} for {colour}"
            );
        }
    }
    for text in body.split("<text").skip(1) {
        let words = text.split('>').nth(1).and_then(|t| t.split('<').next());
        assert!(!words.expect(name).contains('`'), "{name}: {words:?}");
    }
    for points in body.split(" points=\"").skip(1) {
        let list = points.split('"').next().expect("the end of a list");
        for number in list.split([' ', ',']).filter(|n| !n.is_empty()) {
            let decimals = number.split('.').nth(1).map_or(0, str::len);
            assert!(decimals <= 1, "{name}: {number}");
        }
    }
}

#[test]
fn every_drawing_of_the_docs_is_for_dark_pages_too() {
    let all = drawings(&root().join("docs"));
    assert!(all.len() > 50, "{}", all.len());
    for path in all {
        let svg = fs::read_to_string(&path).expect("text");
        holds(&path.display().to_string(), &svg);
    }
}

/// Curves of plots have tenths of pixels, the units of their drawings: points are not rounded to whole pixels.
#[test]
fn plots_have_tenths_of_pixels() {
    let out: PathBuf = [env!("CARGO_TARGET_TMPDIR"), "pictures"].iter().collect();
    let folder = out.display().to_string();
    let scene = "specs/scenes/stick_slip.scene.yaml";
    bgdyn(&["simulate", scene, "--out", &folder]).good();
    bgdyn(&[
        "simulate",
        scene,
        "--out",
        &folder,
        "--sweep",
        "slide=0:0.02:5",
    ])
    .good();
    for name in ["stick_slip.svg", "stick_slip_batch.svg"] {
        let svg = fs::read_to_string(out.join(name)).expect("a plot");
        holds(name, &svg);
        let size = |key: &str| -> f64 {
            let (_, rest) = svg.split_once(key).expect(key);
            let number = rest.split([' ', '"']).next();
            number.and_then(|n| n.parse().ok()).expect(key)
        };
        assert_eq!(size("viewBox=\"0 0 "), 10.0 * size("width=\""), "{name}");
        let curves = svg.split(" points=\"").skip(1);
        let longest = curves
            .map(|rest| rest.split('"').next().unwrap_or(""))
            .max_by_key(|c| c.len());
        let places = longest.expect("a curve").split([' ', ',']);
        let between = places.filter(|n| !n.ends_with('0')).count();
        assert!(between > 4, "{name}: all places are whole pixels");
    }
}

const MASSLESS: &str = "\
format: 1
links:
  - name: base
    joint: { name: pan, type: revolute, axis: z }
  - name: knuckle
    parent: base
    joint: { name: tilt, type: revolute, axis: y, origin: { xyz: [0, 0, 0.1 m] } }
  - name: arm
    parent: knuckle
    joint: { name: roll, type: revolute, axis: x }
    mass: 2 kg
    com: [0.2 m, 0, 0]
  - name: pointer
    parent: arm
    joint: { name: dial, type: revolute, axis: z }
";

/// Links without junctions are not drawn, but their joints are; a link at the end of the chain without any
/// shows a note.
#[test]
fn massless_links_are_folded() {
    let file = scratch("pictures", "massless.yaml", MASSLESS);
    let svg = bgdyn(&["graph", &file]).good();
    for drawn in ["arm", "pointer", "pan", "tilt", "roll", "dial"] {
        assert!(svg.contains(&format!(">{drawn}</text>")), "{drawn}");
    }
    for folded in ["base", "knuckle"] {
        assert!(!svg.contains(&format!(">{folded}</text>")), "{folded}");
    }
    assert!(svg.contains("4 velocities, 4 links"));
    assert!(
        svg.contains("not drawn, with their transformers: base, knuckle"),
        "{svg}"
    );
    assert_eq!(svg.matches("has no store and no source").count(), 1);
    // Every transformer is below the start of its velocity's bar.
    let dot = bgdyn(&["graph", &file, "--format", "dot"]).good();
    assert_eq!(dot.matches("subgraph cluster_").count(), 2);
    for j in 0..3 {
        assert!(dot.contains(&format!("  v{j} -> l0_0_t{j} ")), "{dot}");
    }
}

/// A prismatic joint with a stop on each side, an arm with one stop, and a load at its tip.
const STOPS: &str = "\
format: 1
parameters: {}
links:
  - name: cart
    joint: { name: slide, type: prismatic, axis: x, origin: { xyz: [0, 0, 0.5 m] } }
    mass: 1 kg
  - name: arm
    parent: cart
    joint: { name: swing, type: revolute, axis: y, origin: { xyz: [0.1 m, 0, 0] } }
    mass: 2 kg
    com: [0, 0, -0.3 m]
frames:
  - { name: tip, link: arm, origin: { xyz: [0, 0, -0.6 m] } }
effects:
  walls: { type: stop, joint: slide, lower: -0.2 m, upper: 0.3 m, stiffness: 1e5, restitution: 0.5, impact_speed: 1 }
  peg: { type: stop, joint: swing, upper: 90 deg, stiffness: 1e4, restitution: 0.5, impact_speed: 1 }
  load: { type: payload, at: tip, mass: 3 kg }
";

#[test]
fn stops_and_payloads_are_on_the_page() {
    let text = STOPS.replace("parameters: {}\n", "");
    scratch("pictures", "stops.yaml", &text);
    let scene = "scene: 1\nmechanism: stops.yaml\neffects: [gravity, inertia, walls, peg, load]\nintegration: { method: rk4, step: 1 ms, end: 0.05 s }\n";
    let scene = scratch("pictures", "stops.scene.yaml", scene);
    let out: PathBuf = [env!("CARGO_TARGET_TMPDIR"), "pictures"].iter().collect();
    bgdyn(&["simulate", &scene, "--out", &out.display().to_string()]).good();
    let page = fs::read_to_string(out.join("stops.html")).expect("a page");
    let (_, rest) = page.split_once("id=\"data\">").expect("data");
    let (data, _) = rest.split_once("</script>").expect("its end");
    let data: Value = serde_json::from_str(data).expect("JSON");
    let stops = |body: usize| {
        data["bodies"][body]["joint"]["stops"]
            .as_array()
            .expect("stops")
    };
    let numbers = |list: &Value| -> Vec<f64> {
        list.as_array()
            .expect("a list")
            .iter()
            .map(|x| x.as_f64().expect("a number"))
            .collect()
    };
    let is = |found: &Value, wanted: [f64; 3]| {
        let apart = numbers(found)
            .iter()
            .zip(wanted)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max);
        assert!(apart < 1e-12, "{found}, not {wanted:?}");
    };
    let [low, high] = &stops(1)[..] else {
        panic!("two walls")
    };
    is(&low["at"], [-0.2, 0.0, 0.5]);
    is(&high["at"], [0.3, 0.0, 0.5]);
    assert_eq!(
        (&low["side"], &high["side"]),
        (&Value::from(-1.0), &Value::from(1.0))
    );
    let [peg] = &stops(2)[..] else {
        panic!("one peg")
    };
    is(&peg["at"], [0.1, 0.0, 0.0]);
    // The arm hangs; a quarter turn about y brings −z to −x.
    is(&peg["way"], [-1.0, 0.0, 0.0]);
    assert_eq!(peg["name"], "peg");
    let points = data["bodies"][2]["points"].as_array().expect("points");
    let loads: Vec<&Value> = points.iter().filter(|p| p["load"] == true).collect();
    let [load] = loads[..] else {
        panic!("one load: {points:?}")
    };
    assert_eq!(
        (&load["name"], &load["mass"]),
        (&Value::from("load"), &Value::from(3.0))
    );
    is(&load["at"], [0.0, 0.0, -0.6]);
}
