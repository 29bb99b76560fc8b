//! The types of frames in a module.

use bgdyn_codegen::SpecText;
use bgdyn_codegen::emit::OutputOptions;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::pipeline::generate_module;

#[test]
fn frames_of_different_names_are_different_types() {
    let names = [
        "tool", "tool1", "tool_1", "tool_1_2", "tool_12", "too_l", "t_ool",
    ];
    let frames = names.map(|name| format!("{{ name: {name}, link: arm }}"));
    let spec = format!(
        "{{ format: 1, name: one, links: [{{ name: arm, joint: {{ name: hinge, type: revolute, axis: y }}, mass: 1 }}], frames: [{}] }}",
        frames.join(", ")
    );
    let output = OutputOptions::source_text("one.yaml".into());
    let spec = SpecText::mechanism(&spec, "one");
    let (module, _) = generate_module(&spec, &Options::default(), &output).expect("a module");
    let module = module.to_string();
    let wanted = [
        "Tool", "Tool1", "Tool_1", "Tool_1_2", "Tool_12", "TooL", "TOol",
    ];
    for (name, kind) in names.into_iter().zip(wanted) {
        let named = format!("Frame for {kind} {{ const NAME : & 'static str = \"{name}\"");
        assert!(module.contains(&named), "{name}: no {named:?} in {module}");
    }
}
