//! Tests the page that `bgdyn simulate` writes.

use std::fs;
use std::path::PathBuf;

use bgdyn_codegen::bond_graph::SiteId;
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::{Options, formulation_named};
use bgdyn_codegen::selection::function;
use serde_json::Value;

use crate::{bgdyn, root, scratch, table_rows};

/// The page of a scene, its data, its table.
fn page(test: &str, scene: &str, options: &[&str]) -> (String, Value, Vec<Vec<f64>>) {
    let out: PathBuf = [env!("CARGO_TARGET_TMPDIR"), test].iter().collect();
    let folder = out.display().to_string();
    let told = bgdyn(&[&["simulate", scene, "--out", &folder], options].concat()).good();
    assert!(told.contains("replay: "), "{told}");
    let stem = scene.rsplit('/').next().and_then(|f| f.split('.').next());
    let stem = stem.expect("a name");
    let text = fs::read_to_string(out.join(format!("{stem}.html"))).expect("a page");
    let table = fs::read_to_string(out.join(format!("{stem}.csv"))).expect("a table");
    let rows = table_rows(&table).into_iter();
    let rows = rows.map(|row| row.iter().map(|x| x.parse().unwrap()).collect());
    let start = "<script type=\"application/json\" id=\"data\">";
    let (_, rest) = text.split_once(start).expect("data");
    let (data, _) = rest.split_once("</script>").expect("its end");
    let data = serde_json::from_str(data).expect("JSON");
    (text, data, rows.collect())
}

fn numbers(list: &Value) -> Vec<f64> {
    let number = |x: &Value| x.as_f64().expect("a number");
    list.as_array()
        .expect("a list")
        .iter()
        .map(number)
        .collect()
}

#[test]
fn the_page_is_whole_and_needs_no_network() {
    let scene = "specs/scenes/stick_slip.scene.yaml";
    let (text, data, rows) = page("page_whole", scene, &["--points", "101"]);
    // The only word with these letters that is no address.
    assert!(!text.replace("http-equiv", "").contains("http"));
    assert!(!text.contains("src="), "everything is inline");
    assert!(text.starts_with("<!doctype html>"));
    assert!(text.trim_end().ends_with("</html>"));
    let tags = [
        "html", "head", "body", "style", "main", "section", "footer", "pre", "div", "span",
    ];
    for tag in tags {
        // A name ends where an attribute or the tag's end begins.
        let opened = [" ", ">"].map(|end| text.matches(&format!("<{tag}{end}")).count());
        let closed = text.matches(&format!("</{tag}>")).count();
        assert_eq!(opened.iter().sum::<usize>(), closed, "{tag}");
        assert!(closed > 0, "{tag}");
    }
    for mark in ["@NAME@", "@STYLE@", "@DATA@", "@SCRIPT@"] {
        assert!(!text.contains(mark), "{mark}");
    }
    let t = numbers(&data["t"]);
    assert_eq!(t.len(), rows.len());
    assert_eq!(data["events"].as_array().unwrap().len(), 14);
    let levels = data["levels"].as_f64().unwrap();
    for (k, output) in data["outputs"].as_array().unwrap().iter().enumerate() {
        let [low, high] = ["low", "high"].map(|end| output[end].as_f64().unwrap());
        let counts = numbers(&output["counts"]);
        for ((row, count), t) in rows.iter().zip(counts).zip(&t) {
            assert!((row[0] - t).abs() <= 1e-8);
            let value = low + (high - low) * count / levels;
            assert!((value - row[k + 1]).abs() <= 0.51 * (high - low) / levels);
        }
    }
}

/// Runs of a SCARA without outputs: its table has the joints' positions.
#[test]
fn poses_are_those_of_the_literal_equations() {
    let specs = root().join("specs/scara.yaml");
    let text = fs::read_to_string(specs).expect("the SCARA");
    scratch("page_poses", "scara.yaml", &text);
    let scene = "\
scene: 1
mechanism: scara.yaml
effects: [gravity, inertia, velocity_products]
inputs: { shoulder: 3 N*m, stroke: -17.7 N }
initial: { shoulder: 20 deg, elbow: -40 deg, turn_rate: 3 rad/s }
integration: { method: rk4, step: 1 ms, end: 0.5 s }
";
    let scene = scratch("page_poses", "bent.scene.yaml", scene);
    let (_, data, rows) = page("page_poses_out", &scene, &["--points", "26"]);
    let (mechanism, _) = bgdyn_codegen::read(&text, Some("scara"));
    let mechanism = mechanism.expect("sound");
    let options = Options {
        formulation: Some(formulation_named("literal").unwrap()),
        ..Options::default()
    };
    let bodies = data["bodies"].as_array().expect("bodies");
    let grain = data["grain"].as_f64().unwrap();
    assert_eq!(bodies.len(), 1 + mechanism.nv());
    for body in &bodies[1..] {
        let name = body["name"].as_str().unwrap();
        let link = mechanism
            .links()
            .iter()
            .position(|l| l.name == name)
            .unwrap();
        let pose = function(&mechanism, Method::Pose(SiteId(link)), &options).unwrap();
        let (place, turn) = (numbers(&body["place"]), numbers(&body["turn"]));
        assert_eq!((place.len(), turn.len()), (3 * rows.len(), 4 * rows.len()));
        for (i, row) in rows.iter().enumerate() {
            let q = row[1..=mechanism.nq()].to_vec();
            let (wanted, _) = pose.evaluate::<f64>(Inputs {
                q,
                ..Inputs::default()
            });
            let r = rotation(&turn[4 * i..4 * i + 4]);
            for k in 0..9 {
                assert!((r[k] - wanted[k]).abs() < 4e-5, "{name}, row {i}: {r:?}");
            }
            for k in 0..3 {
                let found = grain * place[3 * i + k];
                assert!(
                    (found - wanted[9 + k]).abs() <= 0.51 * grain,
                    "{name}, row {i}"
                );
            }
        }
    }
}

/// The matrix of a quaternion w, x, y, z, row by row.
fn rotation(counts: &[f64]) -> [f64; 9] {
    let size = counts.iter().map(|x| x * x).sum::<f64>().sqrt();
    let [w, x, y, z] = [0, 1, 2, 3].map(|k| counts[k] / size);
    [
        1.0 - 2.0 * (y * y + z * z),
        2.0 * (x * y - w * z),
        2.0 * (x * z + w * y),
        2.0 * (x * y + w * z),
        1.0 - 2.0 * (x * x + z * z),
        2.0 * (y * z - w * x),
        2.0 * (x * z - w * y),
        2.0 * (y * z + w * x),
        1.0 - 2.0 * (x * x + y * y),
    ]
}

#[test]
fn a_long_run_is_thinned_out() {
    let scene = "specs/scenes/cart_and_pole.scene.yaml";
    let options = ["--points", "20001", "--end", "1"];
    let (text, data, rows) = page("page_long", scene, &options);
    assert_eq!(rows.len(), 20_001);
    let t = numbers(&data["t"]);
    assert!(t.len() <= 4_002 && t[0] == 0.0 && *t.last().unwrap() == 1.0);
    assert!(text.len() < 2_000_000, "{} bytes", text.len());
}
