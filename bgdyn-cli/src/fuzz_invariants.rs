//! Invariants of parser, check and importer for any text, called by property tests and by the fuzzer.

use bgdyn_codegen::fault::Faults;
use bgdyn_codegen::format::is_scene;
use bgdyn_codegen::interface::Interface;
use bgdyn_codegen::read;

use crate::import;

/// Passes a text to the parser of mechanisms, to that of scenes and to the importer.
///
/// # Panics
/// If an invariant is violated: a mechanism exists exactly if there is no fault; every fault has a
/// position in the text and one line; the output of the importer can be parsed; its errors start with a
/// line and a column.
pub fn any_text(text: &str) {
    let (mechanism, faults) = read(text, Some("arm"));
    assert_eq!(
        mechanism.is_none(),
        faults.any_fault(),
        "a mechanism and a fault, or neither"
    );
    well_said(&faults, text);
    // The module that the macro writes in place of that of a refused spec.
    let _ = Interface::guess(text, "arm");
    if is_scene(text) {
        scene(text);
    }
    urdf(text);
}

/// A mechanism for scenes, with one element to include.
const ARM: &str = "\
format: 1
links:
  - { name: arm, joint: { name: shoulder, type: revolute, axis: y }, mass: 1, com: [1, 0, 0] }
effects:
  grease: { type: viscous, joint: shoulder, damping: 0.1 }
";

fn scene(text: &str) {
    let read = bgdyn_codegen::read_scene(text, "arm", |_| Ok(ARM.to_owned()));
    if let Err(bgdyn_codegen::refusal::Refusal::Spec(faults)) = read {
        well_said(&faults, text);
    }
}

/// Checks that faults are single lines, each with a position in the text.
fn well_said(faults: &Faults, text: &str) {
    let lines = text
        .split(['\n', '\r', '\u{85}', '\u{2028}', '\u{2029}'])
        .count();
    for fault in &faults.0 {
        let line = fault.headline("arm.yaml");
        assert!(!line.contains(['\n', '\r']), "{line}");
        let at = fault.position.line;
        assert!(
            (1..=lines + 1).contains(&at),
            "line {at} of {lines}: {line}"
        );
    }
    let rendered = faults.render("arm.yaml", text);
    assert_eq!(rendered.is_empty(), faults.0.is_empty(), "{rendered}");
}

fn urdf(text: &str) {
    well_made(import::import(text));
    let all = import::Options {
        frames: vec!["all".into()],
        ..import::Options::default()
    };
    well_made(import::import_with(text, &all));
    let standard = Some(import::Convention::Standard);
    well_made(import::import_table(text, "arm", standard, &all));
}

fn well_made(made: anyhow::Result<import::Import>) {
    match made {
        Ok(made) => {
            let (_, faults) = read(&made.yaml, None);
            let unread = [
                "syntax",
                "unknown-key",
                "missing-key",
                "wrong-type",
                "name",
                "repeated-name",
            ];
            let broken = faults.0.iter().find(|fault| unread.contains(&fault.rule));
            assert!(broken.is_none(), "{broken:?} in\n{}", made.yaml);
            let lines = made
                .notes
                .iter()
                .chain(&made.warnings)
                .chain([&made.written]);
            assert!(lines.into_iter().all(|line| !line.contains('\n')));
        }
        Err(error) => {
            let error = error.to_string();
            let mut parts = error.splitn(3, ':');
            let number = |part: Option<&str>| {
                part.and_then(|p| p.parse::<u64>().ok())
                    .is_some_and(|n| n > 0)
            };
            assert!(number(parts.next()) && number(parts.next()), "{error}");
        }
    }
}
