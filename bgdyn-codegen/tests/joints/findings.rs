//! Specs with joints, and what the check finds in them.

use bgdyn_codegen::fault::{Fault, Faults, Severity};

use super::robot::Robot;

pub(super) const HEAD: &str = "format: 1\nname: arm\nlinks:\n";
pub(super) const BODY: &str = "mass: 1, inertia: { xx: 1, yy: 1, zz: 1 }";

/// A mechanism of links with these joints, each on the world.
pub(super) fn with_joints(joints: &[&str]) -> String {
    let mut text = HEAD.to_owned();
    for (i, joint) in joints.iter().enumerate() {
        text += &format!("  - {{ name: l{i}, joint: {{ {joint} }}, {BODY} }}\n");
    }
    text
}

pub(super) fn found(text: &str) -> Faults {
    let (mechanism, faults) = bgdyn_codegen::read(text, None);
    assert_eq!(mechanism.is_none(), faults.any_fault(), "{text}");
    faults
}

/// Asserts exactly one finding.
pub(super) fn one(text: &str) -> Fault {
    let faults = found(text);
    assert_eq!(
        faults.0.len(),
        1,
        "{text}\n{}",
        faults.render("arm.yaml", text)
    );
    faults.0[0].clone()
}

/// Asserts exactly one fault with this rule at this path, and these words in message and help.
pub(super) fn refused(joints: &[&str], rule: &str, path: &str, words: &[&str]) {
    finding(joints, Severity::Fault, (rule, path), words);
}

/// Asserts exactly one warning, in the same way.
pub(super) fn warned(joints: &[&str], rule: &str, path: &str, words: &[&str]) {
    finding(joints, Severity::Warning, (rule, path), words);
}

fn finding(joints: &[&str], severity: Severity, at: (&str, &str), words: &[&str]) {
    let fault = finding_in(&with_joints(joints), severity, at, words);
    // The position is that of the line of the link, after its dash.
    let line = 4 + at.1["links[".len()..]
        .split(']')
        .next()
        .map_or(0, |i| i.parse::<usize>().expect("an index"));
    assert_eq!(fault.position.line, line, "{}", at.0);
}

/// Asserts exactly one fault of a text, in the same way.
pub(super) fn refused_text(text: &str, rule: &str, path: &str, words: &[&str]) {
    finding_in(text, Severity::Fault, (rule, path), words);
}

fn finding_in(text: &str, severity: Severity, (rule, path): (&str, &str), words: &[&str]) -> Fault {
    let fault = one(text);
    assert_eq!(fault.severity, severity, "{rule}");
    let help = fault.help.clone().unwrap_or_default();
    let said = format!("{}\n{help}", fault.message);
    assert_eq!(
        (fault.rule, fault.path.as_str()),
        (rule, path),
        "{text}\n{said}"
    );
    assert!(!help.is_empty(), "{rule}: no help");
    assert!(!said.contains("  "), "{rule}: a gap in {said:?}");
    for word in words {
        assert!(said.contains(word), "{rule}: no {word:?} in {said:?}");
    }
    fault
}

pub(super) fn sound(joints: &[&str]) -> Robot {
    let text = with_joints(joints);
    let faults = found(&text);
    assert_eq!(
        faults,
        Faults::default(),
        "{}",
        faults.render("arm.yaml", &text)
    );
    Robot::read(&text)
}

/// A slide that others mimic.
pub(super) const LEADER: &str = "name: grip, type: prismatic, axis: y";
