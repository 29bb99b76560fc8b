//! `bgdyn generate`.

use std::fs;
use std::path::Path;

use bgdyn_codegen::SpecText;
use bgdyn_codegen::emit::OutputOptions;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::pipeline::generate_module;

use crate::{bgdyn, root, scratch};

const SCARA: &str = "tests/golden/specs/scara4.yaml";

#[test]
fn the_source_is_the_same_in_every_run_and_in_every_place() {
    let first = bgdyn(&["generate", SCARA]).good();
    assert_eq!(first, bgdyn(&["generate", SCARA]).good());
    let text = fs::read_to_string(root().join(SCARA)).expect("the spec");
    let elsewhere = scratch("generate_same", "scara4.yaml", text);
    assert_eq!(first, bgdyn(&["generate", &elsewhere]).good());
    let output = scratch("generate_same", "scara4.rs", "");
    let run = bgdyn(&["generate", SCARA, "-o", &output]);
    assert_eq!(run.good(), "");
    assert_eq!(fs::read_to_string(output).expect("the output"), first);
}

#[test]
fn the_source_is_what_the_macro_gets() {
    let text = fs::read_to_string(root().join(SCARA)).expect("the spec");
    let place = OutputOptions::source_text("scara4.yaml".into());
    let spec = SpecText::mechanism(&text, "scara4");
    let (tokens, _) = generate_module(&spec, &Options::default(), &place).expect("a good spec");
    let source = bgdyn(&["generate", SCARA]).good();
    let parsed: proc_macro2::TokenStream = source.parse().expect("Rust");
    // Trailing commas in lists and the quotes of documentation depend on the formatting; the titles above
    // statements are comments in the source.
    let plain = |t: String| -> String {
        let t = t.replace("doc = r\"", "doc = \"");
        let mut parts = t.split("# [doc = \"//");
        let first = parts.next().unwrap_or_default().to_string();
        let rest = parts.map(|p| p.split_once("\"]").expect("the end of a title").1);
        let t = first + &rest.collect::<String>();
        t.chars().filter(|c| !" ,\n".contains(*c)).collect()
    };
    assert!(plain(parsed.to_string()) == plain(tokens.to_string()));
    let title = "            // l_j2: ω, U = [ω̇]× + [ω]×[ω]×, ";
    assert!(source.contains(title) && !source.contains("#[doc = \"//"));
    assert!(source.contains("pub mod scara4 {") && source.contains("pub struct Scara4<T = f64>"));
    assert!(!source.contains("include_bytes"));
}

#[test]
fn formulations_differ() {
    let literal = bgdyn(&["generate", SCARA, "--formulation", "literal"]).good();
    assert_ne!(literal, bgdyn(&["generate", SCARA]).good());
    assert!(literal.contains("| literal"));
}

#[test]
fn what_cannot_be_generated_or_written() {
    let run = bgdyn(&["generate", "specs/invalid/negative_mass.yaml"]);
    assert_eq!(run.stdout, "");
    let stderr = run.bad_input();
    assert_eq!(stderr.matches("[negative-mass]").count(), 1, "{stderr}");
    let stderr = bgdyn(&["generate", SCARA, "-o", "no/such/folder/a.rs"]).bad_input();
    assert!(
        stderr.starts_with("bgdyn: no/such/folder/a.rs cannot be written: "),
        "{stderr}"
    );
}

#[test]
fn a_kept_file_is_compared() {
    let kept = scratch("generate_check", "kept.rs", "");
    let asked = ["--methods", "gravity,pose_l_j4", "--module", "kept"];
    let run =
        |more: &[&str]| bgdyn(&[&["generate", SCARA, "-o", &kept], &asked[..], more].concat());
    assert!(
        run(&["--check"])
            .bad_input()
            .contains("kept.rs:1:1: this is not what")
    );
    run(&[]).good();
    let text = fs::read_to_string(&kept).expect("the output");
    assert!(text.contains("pub mod kept {") && !text.contains("fn bias"));
    assert_eq!(run(&["--check"]).good(), "");
    fs::write(&kept, text.replacen("pub mod kept {", "pub mod kept  {", 1)).expect("a file");
    let line = 1 + text
        .lines()
        .position(|l| l == "pub mod kept {")
        .expect("a line");
    let stderr = run(&["--check"]).bad_input();
    assert!(stderr.contains(&format!("kept.rs:{line}:1: ")), "{stderr}");
    fs::write(&kept, text + "\n").expect("a file");
    run(&["--check"]).bad_input();
    let stderr = bgdyn(&["generate", SCARA, "--check"]).bad_usage();
    assert!(stderr.contains("--output"), "{stderr}");
}

#[test]
fn names_asked_for_in_vain_are_bad_usage() {
    let stderr = bgdyn(&["generate", SCARA, "--frames", "l_j", "--methods", "bia"]).bad_usage();
    assert!(stderr.contains("`bia`: did you mean `bias`?"), "{stderr}");
    assert!(stderr.contains("`l_j`: did you mean `l_j1`?"), "{stderr}");
    let stderr = bgdyn(&["generate", SCARA, "--module", "Arm"]).bad_usage();
    assert!(stderr.contains("`Arm` cannot name a module"), "{stderr}");
}

/// With `--plain` formulas are infix; the statements, their names and their order do not change.
#[test]
fn plain_text_has_the_same_statements() {
    let statements = |text: &str| -> Vec<String> {
        let words = text.split_whitespace().collect::<Vec<_>>();
        let names = words.windows(2).filter(|pair| pair[0] == "let");
        names.map(|pair| pair[1].to_owned()).collect()
    };
    for spec in [
        "specs/scara.yaml",
        "specs/puma560.yaml",
        "specs/scenes/scara_friction.scene.yaml",
    ] {
        let compiled = bgdyn(&["generate", "--no-verify", spec]).good();
        let plain = bgdyn(&["generate", "--no-verify", "--plain", spec]).good();
        assert!(plain.contains("FOR READING, NOT FOR COMPILING"), "{spec}");
        let (_, body) = plain.split_once("pub mod").expect("a module");
        assert!(!body.contains("mul_add("), "{spec}");
        assert!(!body.contains(" k(") && !body.contains("(k("), "{spec}");
        let mut wanted = statements(&compiled);
        // `k`, which converts a number to a scalar, is not in plain text.
        wanted.retain(|name| name != "k");
        assert!(wanted.len() > 100, "{spec}");
        assert_eq!(statements(&plain), wanted, "{spec}");
        syn::parse_file(&plain).unwrap_or_else(|e| panic!("{spec}: {e}"));
    }
}

#[test]
fn backends_write_their_files() {
    let blocked = scratch("generate_c", "file", "");
    let folder = format!("{blocked}_beside/new");
    let _ = fs::remove_dir_all(&folder);
    let folder = folder.as_str();
    let (header, source) = (format!("{folder}/scara4.h"), format!("{folder}/scara4.c"));
    let asked = ["generate", SCARA, "--backend", "c", "-o", folder];
    assert_eq!(bgdyn(&asked).good(), "");
    let written = fs::read_to_string(&header).expect("the header");
    assert!(written.contains("void scara4_inverse_dynamics(const double q[SCARA4_NQ]"));
    let written = fs::read_to_string(&source).expect("the source");
    assert!(written.contains("#include \"scara4.h\"") && !written.contains("sinf"));
    let check = [&asked[..], &["--check"]].concat();
    assert_eq!(bgdyn(&check).good(), "");
    let single = [&check[..], &["--option", "float=float"]].concat();
    let stderr = bgdyn(&single).bad_input();
    assert!(stderr.contains("scara4.h:"), "{stderr}");
    let library = [&asked[..], &["--option", "cmake=yes"]].concat();
    assert_eq!(bgdyn(&library).good(), "");
    let written = fs::read_to_string(format!("{folder}/scara4.cmake")).expect("the file");
    assert!(written.contains("add_library(scara4 STATIC ${CMAKE_CURRENT_LIST_DIR}/scara4.c)"));
    // Nothing is written where one file cannot be.
    fs::remove_file(&header).expect("the header");
    fs::remove_file(&source).expect("the source");
    fs::create_dir(&source).expect("a folder");
    let stderr = bgdyn(&asked).bad_input();
    assert!(
        stderr.contains("scara4.c cannot be written: it is a folder"),
        "{stderr}"
    );
    assert!(!Path::new(&header).exists());
    fs::remove_dir(&source).expect("the folder");
    // Nor over files of another spec.
    let other = "/* Dynamics of `a`. Generated by bgdyn 0.1.0 from other.yaml. */\n";
    fs::write(&source, other).expect("a file");
    let stderr = bgdyn(&asked).bad_input();
    assert!(
        stderr.contains("is generated from other.yaml and would be"),
        "{stderr}"
    );
    assert_eq!(fs::read_to_string(&source).expect("the file"), other);
    let named_as_file = ["generate", SCARA, "--backend", "c", "-o", "no/such/gen.c"];
    let stderr = bgdyn(&named_as_file).bad_usage();
    assert!(
        stderr.contains("`-o no/such/gen.c` is the folder of scara4.h and scara4.c"),
        "{stderr}"
    );
    let into_a_file = ["generate", SCARA, "--backend", "c", "-o", &blocked];
    let stderr = bgdyn(&into_a_file).bad_input();
    assert!(stderr.contains("file cannot be created: "), "{stderr}");
}

#[test]
fn backends_and_their_options_are_checked() {
    let c = |more: &[&str]| bgdyn(&[&["generate", SCARA, "--backend", "c"], more].concat());
    let stderr = bgdyn(&["generate", SCARA, "--backend", "fortran"]).bad_usage();
    assert!(stderr.contains("`rust`, `c`"), "{stderr}");
    let stderr = c(&["--module", "arm"]).bad_usage();
    assert!(stderr.contains("no option `module`"), "{stderr}");
    let stderr = c(&["--option", "prefix"]).bad_usage();
    assert!(stderr.contains("NAME=VALUE"), "{stderr}");
    let stderr = c(&["--option", "prefix=a", "--option", "prefix=b"]).bad_usage();
    assert!(
        stderr.contains("`prefix` is given twice: `a` and `b`"),
        "{stderr}"
    );
    let stderr = c(&["--option", "sincos=fast"]).bad_usage();
    assert!(stderr.contains("`own` or `libm`"), "{stderr}");
}

#[test]
fn scenes_are_written_in_c() {
    let header = scratch("generate_c_scene", "stick_slip.h", "");
    let folder = header.strip_suffix("/stick_slip.h").expect("a folder");
    let scene = "specs/scenes/stick_slip.scene.yaml";
    let asked = ["generate", scene, "--backend", "c", "-o", folder];
    assert_eq!(bgdyn(&asked).good(), "");
    let written = fs::read_to_string(&header).expect("the header");
    assert!(written.contains("int stick_slip_derivative("), "{written}");
}
