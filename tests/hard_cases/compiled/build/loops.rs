//! Generates mechanisms with loops: the specs of the repository, and a crank that cannot turn fully.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use bgdyn_codegen::emit::{OutputOptions, module, source_text, struct_ident};
use bgdyn_codegen::files::stem;
use bgdyn_codegen::mechanism::closure::polygons;
use bgdyn_codegen::options::Options;

/// Returns the files of the specs.
fn files(root: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(root.join("../../specs/loops")).expect("a folder of specs");
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.push(root.join("../closed_loops/short_rod.yaml"));
    paths.sort_by_key(|path| stem(path));
    paths
}

/// Writes all modules. Returns the text that includes them and lists them by name: as models, and with their
/// specs.
pub(crate) fn write(root: &Path, out: &Path) -> String {
    let [mut includes, mut models, mut texts] = [const { String::new() }; 3];
    for path in files(root) {
        let (name, text) = (stem(&path), fs::read_to_string(&path).unwrap());
        let (mechanism, faults) = bgdyn_codegen::read(&text, Some(&name));
        let mechanism = mechanism.unwrap_or_else(|| panic!("{}", faults.render(&name, &text)));
        // Joints that follow close parallel branches without rows.
        let Some(closure) = mechanism.closure() else {
            continue;
        };
        let whole = polygons(closure).is_some();
        let options = Options {
            frames: Some(vec![]),
            ..Options::default()
        };
        let model = bgdyn_codegen::selection::model(mechanism, &options).expect("known methods");
        let place = OutputOptions::source_text(format!("{name}.yaml"));
        let place = place.with_module(&name).expect("a name");
        let source = out.join(format!("loop_{name}.rs"));
        let own = struct_ident(model.mechanism.name());
        fs::write(&source, source_text(module(&model, &place))).unwrap();
        writeln!(
            includes,
            "include!({source:?});\nclosed!({name}, {own}, {whole});"
        )
        .unwrap();
        writeln!(
            models,
            "{name:?} => Some(Box::new(Erased::<_, {{ {name}::NQ }}, {{ {name}::NV }}>({name}::{own}::<T>::default()))),"
        )
        .unwrap();
        writeln!(texts, "({name:?}, include_str!({path:?})),").unwrap();
    }
    format!(
        "{includes}
fn any<T: Scalar>(name: &str) -> Option<Box<dyn Closed<T>>> {{
    match name {{ {models} _ => None }}
}}
/// The specs by name.
pub const TEXTS: &[(&str, &str)] = &[{texts}];
"
    )
}
