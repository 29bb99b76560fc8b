//! Generates mechanisms for programs that time them or count their instructions.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs};

use bgdyn_codegen::build_script::Build;
use bgdyn_codegen::emit::struct_ident;
use bgdyn_codegen::files::stem;
use bgdyn_codegen::mechanism::Mechanism;

/// Generates the mechanisms of these specs: `models.rs` contains their modules, `robots.rs` a call of the macro `robots!`,
/// which the including file defines, with a line for each mechanism: its module, its struct, and the text that `robot`
/// returns beside its build.
pub fn generate(paths: &[PathBuf], robot: impl Fn(&Path, &Mechanism) -> (Build, String)) {
    let out = PathBuf::from(env::var("OUT_DIR").unwrap());
    let (mut models, mut robots) = (String::new(), String::new());
    for path in paths {
        let name = stem(path);
        let (build, text) = robot(path, &mechanism(path));
        build.write().unwrap_or_else(|error| panic!("{error}"));
        let include = format!("include!(concat!(env!(\"OUT_DIR\"), \"/{name}.rs\"));");
        writeln!(models, "{include}").unwrap();
        writeln!(robots, "{name} {} {text},", struct_ident(&name)).unwrap();
    }
    fs::write(out.join("models.rs"), models).unwrap();
    fs::write(out.join("robots.rs"), format!("robots! {{\n{robots}}}\n")).unwrap();
}

fn mechanism(path: &Path) -> Mechanism {
    let shown = path.display().to_string();
    let text = fs::read_to_string(path).unwrap_or_else(|error| panic!("{shown}: {error}"));
    let (mechanism, faults) = bgdyn_codegen::read(&text, Some(&stem(path)));
    mechanism.unwrap_or_else(|| panic!("{}", faults.render(&shown, &text)))
}
