//! Tests a crate outside the workspace that uses bgdyn under another name, by the macro and by a build
//! script: a changed spec rebuilds it, and so does the changed mechanism of a scene; every folder is
//! searched, and a spec in two folders is refused.

mod outside;

use std::fs;
use std::path::Path;
use std::process::Output;

use outside::Outside;

const BUILD: &str = r#"
fn main() -> Result<(), bgdyn_codegen::build_script::Error> {
    let build = bgdyn_codegen::Build::new("built.yaml").bgdyn("::dyn_gen").module("from_script");
    build.visibility("").write()?;
    bgdyn_codegen::Build::new("hang.scene.yaml").bgdyn("::dyn_gen").visibility("").write()?;
    Ok(())
}
"#;

const MAIN: &str = r#"
#![deny(warnings)]
dyn_gen::bgdyn!("beside.yaml");
dyn_gen::bgdyn!("in_package.yaml");
mod inner;
dyn_gen::bgdyn!("fall.scene.yaml");
include!(concat!(env!("OUT_DIR"), "/from_script.rs"));
include!(concat!(env!("OUT_DIR"), "/hang.rs"));

fn main() {
    let q = dyn_gen::nalgebra::SVector::from_element(0.0);
    let force = beside::Beside::<f64>::default().gravity(&q)[0];
    let built = from_script::Built::<f64>::default().gravity(&q)[0];
    print!("{} {} {} {force:.2} {built:.2}", beside::NV, in_package::NV, inner::in_specs::NV);
    let (state, input) = (fall::State::default(), fall::Input::default());
    let held = fall::Coordinates { slide: 0.0 };
    let fall = fall::Fall::<f64>::default().inverse(&state, &held, &input, 0.0).slide;
    let (state, input) = (hang::State::default(), hang::Input::default());
    let held = hang::Coordinates { slide: 0.0 };
    let hang = hang::Hang::<f64>::default().inverse(&state, &held, &input, 0.0).slide;
    println!(" {fall:.2} {hang:.2}");
}
"#;

fn spec(mass: f64) -> String {
    format!(
        "format: 1\nlinks:\n  - name: platform\n    joint: {{ name: slide, type: prismatic }}\n    mass: {mass}\n"
    )
}

fn scene(mechanism: &str) -> String {
    format!("scene: 1\nmechanism: {mechanism}\neffects: [gravity]\n")
}

/// The package of these tests.
struct Scratch(Outside);

impl Scratch {
    fn new() -> Self {
        let bgdyn = Path::new(env!("CARGO_MANIFEST_DIR"));
        let package = Outside::new(bgdyn, "scratch", "dyn_gen");
        for old in ["src", "specs"] {
            fs::remove_dir_all(package.folder.join(old)).ok();
        }
        Scratch(package)
    }

    fn write(&self, file: &str, text: &str) {
        self.0.write(file, text);
    }

    fn run(&self) -> Output {
        let mut command = self.0.cargo(&["run", "--quiet"]);
        command.output().expect("cargo runs")
    }

    fn printed(&self) -> String {
        let output = self.run();
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{stderr}");
        String::from_utf8_lossy(&output.stdout).trim().to_string()
    }

    fn refused(&self) -> String {
        let output = self.run();
        assert!(!output.status.success());
        String::from_utf8_lossy(&output.stderr).into_owned()
    }
}

#[test]
fn a_crate_of_its_own() {
    let scratch = Scratch::new();
    scratch.write("src/main.rs", MAIN);
    scratch.write("src/inner/mod.rs", "dyn_gen::bgdyn!(\"in_specs.yaml\");\n");
    scratch.write("src/beside.yaml", &spec(1.0));
    scratch.write("in_package.yaml", &spec(1.0));
    scratch.write("specs/in_specs.yaml", &spec(1.0));
    scratch.write("build.rs", BUILD);
    scratch.write("built.yaml", &spec(4.0));
    scratch.write("specs/scenes/fall.scene.yaml", &scene("../falling.yaml"));
    scratch.write("specs/falling.yaml", &spec(1.0));
    scratch.write("hang.scene.yaml", &scene("specs/hanging.yaml"));
    scratch.write("specs/hanging.yaml", &spec(2.0));
    assert_eq!(scratch.printed(), "1 1 1 9.81 39.24 9.81 19.62");

    // A scene's mechanism, by the macro and by the build script.
    scratch.write("specs/falling.yaml", &spec(3.0));
    assert_eq!(scratch.printed(), "1 1 1 9.81 39.24 29.43 19.62");
    scratch.write("specs/hanging.yaml", &spec(4.0));
    assert_eq!(scratch.printed(), "1 1 1 9.81 39.24 29.43 39.24");
    scratch.write("specs/falling.yaml", &spec(1.0));
    scratch.write("specs/hanging.yaml", &spec(2.0));

    scratch.write("src/beside.yaml", &spec(2.0));
    assert_eq!(scratch.printed(), "1 1 1 19.62 39.24 9.81 19.62");
    let second =
        "  - { name: top, parent: platform, joint: { name: turn, type: revolute }, mass: 1 }\n";
    scratch.write("specs/in_specs.yaml", &(spec(1.0) + second));
    assert_eq!(scratch.printed(), "1 1 2 19.62 39.24 9.81 19.62");
    scratch.write("built.yaml", &spec(-1.0));
    let stderr = scratch.refused();
    let fault = "built.yaml:5:11: links[0].mass: ";
    assert!(
        stderr.contains(fault) && !stderr.contains("panicked"),
        "{stderr}"
    );
    scratch.write("built.yaml", &spec(5.0));
    assert_eq!(scratch.printed(), "1 1 2 19.62 49.05 9.81 19.62");

    scratch.write("src/beside.yaml", &spec(-2.0));
    let stderr = scratch.refused();
    assert!(
        stderr.starts_with("error: beside.yaml:5:11: links[0].mass: "),
        "{stderr}"
    );
    assert_eq!(stderr.matches("\nerror").count(), 1, "{stderr}");
    scratch.write("src/beside.yaml", &spec(3.0));
    assert_eq!(scratch.printed(), "1 1 2 29.43 49.05 9.81 19.62");

    // A file in another folder is found at the next compilation.
    scratch.write("specs/beside.yaml", &spec(3.0));
    scratch.write("src/main.rs", MAIN);
    let stderr = scratch.refused();
    let both = "error: bgdyn: `beside.yaml` could mean any of\n         src/beside.yaml\n         specs/beside.yaml\n";
    assert!(stderr.starts_with(both), "{stderr}");
}
