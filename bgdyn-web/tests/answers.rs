//! Answers for files of the repository, and for requests that are wrong.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

/// Returns the text of a file of the repository.
fn text(path: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    fs::read_to_string(root.join(path)).expect("a file of the repository")
}

fn ask(request: &Value) -> Value {
    let answer = bgdyn_web::call(&request.to_string(), &mut |_| ());
    serde_json::from_str(&answer).expect("JSON")
}

fn slider() -> Value {
    json!({ "name": "slider.yaml", "text": text("specs/slider.yaml") })
}

fn stick_slip() -> Value {
    let scene = text("specs/scenes/stick_slip.scene.yaml");
    json!({ "name": "stick_slip.scene.yaml", "text": scene, "mechanism": text("specs/slider.yaml") })
}

#[test]
fn limits_are_read() {
    let answer = ask(&json!({ "command": "equations", "file": slider(), "limit": 300 }));
    let found = answer["ok"]["text"].as_str().expect("equations");
    assert!(found.contains("slide"), "{found}");
    let scara = json!({ "name": "scara.yaml", "text": text("specs/scara.yaml") });
    let answer = ask(&json!({ "command": "equations", "file": scara, "limit": 3 }));
    let message = answer["error"].as_str().expect("a refusal");
    assert!(message.contains("the limit is 3 terms"), "{message}");
}

#[test]
fn a_run_is_watched_from_start_to_end() {
    let mut shares = vec![];
    let request = json!({ "command": "run", "file": stick_slip() });
    let answer = bgdyn_web::call(&request.to_string(), &mut |share| shares.push(share));
    let answer: Value = serde_json::from_str(&answer).expect("JSON");
    assert!(
        answer["ok"]["table"]
            .as_str()
            .expect("a table")
            .starts_with("t [s],slide [m]")
    );
    assert_eq!(answer["ok"]["failure"], Value::Null);
    assert!(shares.is_sorted());
    assert!(shares[0] < 0.01 && (shares[shares.len() - 1] - 1.0).abs() < 1e-9);
}

#[test]
fn faults_of_a_mechanism_name_its_file_in_the_report_of_its_scene() {
    let mut file = stick_slip();
    file["mechanism"] = text("specs/slider.yaml")
        .replace("mass: 1 kg", "mass: -1 kg")
        .into();
    let report = ask(&json!({ "command": "check", "file": file }));
    let finding = &report["ok"]["findings"][0];
    assert_eq!(
        (&finding["line"], &finding["file"]),
        (&json!(8), &json!("../slider.yaml"))
    );
    let run = ask(&json!({ "command": "run", "file": file }));
    assert_eq!(run["error"], "../slider.yaml has 1 fault");
}

#[test]
fn mistakes_of_a_page_are_told() {
    for (request, part) in [
        (json!({ "command": "dance" }), "dance"),
        (json!({ "command": "graph" }), "file"),
        (
            json!({ "command": "code", "file": slider(), "backend": "cobol" }),
            "there is no backend `cobol`",
        ),
        (
            json!({ "command": "run", "file": slider() }),
            "What is run is a scene",
        ),
    ] {
        let answer = ask(&request);
        let message = answer["error"].as_str().expect("an error");
        assert!(message.contains(part), "{message}");
    }
}

#[test]
fn files_in_the_wrong_place_are_findings() {
    let mut scene = stick_slip();
    scene["mechanism"] = Value::Null;
    let mut mechanism = slider();
    mechanism["mechanism"] = "".into();
    for (file, rule) in [(scene, "scene-given"), (mechanism, "no-scene")] {
        let report = ask(&json!({ "command": "check", "file": file }));
        assert_eq!(report["ok"]["findings"][0]["rule"], rule);
        assert_eq!(report["ok"]["ok"], false);
    }
}

#[test]
fn a_name_in_the_text_is_that_of_the_file() {
    let named = text("specs/slider.yaml").replace("format: 1", "format: 1\nname: my_block");
    let file = json!({ "name": "mechanism.yaml", "text": named });
    let report = ask(&json!({ "command": "check", "file": file }));
    assert_eq!(report["ok"]["ok"], true, "{report}");
    let code = ask(&json!({ "command": "code", "file": file, "backend": "c" }));
    assert_eq!(code["ok"][0]["name"], "my_block.h");
}

#[test]
fn a_urdf_is_a_finding() {
    let file = json!({ "name": "arm.yaml", "text": "<?xml version='1.0'?>\n<robot name='arm'/>" });
    let report = ask(&json!({ "command": "check", "file": file }));
    let message = report["ok"]["findings"][0]["message"]
        .as_str()
        .expect("a message");
    assert!(message.contains("`bgdyn import`"), "{message}");
}
