//! Generates the compiled models: the specs of the repository, those of this folder, and random trees.
//! Specs and modules are written to `OUT_DIR`, for the inspection of a failing one.

#[path = "generate.rs"]
mod generate;
#[allow(dead_code)]
#[path = "../../bgdyn-codegen/tests/common/random.rs"]
mod random;
#[allow(dead_code)]
#[path = "../../bgdyn-codegen/tests/common/rng.rs"]
mod rng;

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs};

use bgdyn_codegen::emit::struct_ident;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::{Entries, Shape};
use random::Draft;
use rng::Rng;

/// The number of moving joints of each random tree; its index is its seed.
const TREES: [usize; 22] = [
    1, 2, 2, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 6, 6, 6, 7, 7, 8, 9, 12,
];

/// Models compiled with first derivatives.
const WITH_DERIVATIVES: [&str; 5] = ["double_pendulum", "scara", "gimbal", "panda", "tree_04"];

fn main() {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").unwrap());
    let out = PathBuf::from(env::var("OUT_DIR").unwrap());
    let mut specs = read(&root.join("../../specs"));
    specs.extend(read(&root.join("specs")));
    for (seed, moving) in TREES.into_iter().enumerate() {
        let name = format!("tree_{seed:02}");
        let draft = Draft::moving(&mut Rng::new(seed as u64), moving);
        specs.push((name.clone(), draft.named(&name)));
    }
    let (mut modules, mut all) = (String::new(), String::new());
    for (name, text) in specs {
        let derivatives = WITH_DERIVATIVES.contains(&name.as_str());
        let path = out.join(format!("{name}.yaml"));
        fs::write(&path, text).unwrap();
        let (model, source) = generate::model_and_text(&path, derivatives);
        fs::write(out.join(format!("{name}.rs")), source).unwrap();
        modules += &calls(&name, derivatives, &model.functions);
        writeln!(all, "Box::new({name}::{}::default()),", struct_ident(&name)).unwrap();
    }
    fs::write(out.join("modules.rs"), modules).unwrap();
    fs::write(out.join("all.rs"), format!("vec![{all}]")).unwrap();
}

/// The specs of a folder, by name.
fn read(folder: &Path) -> Vec<(String, String)> {
    println!("cargo::rerun-if-changed={}", folder.display());
    let entries = fs::read_dir(folder).expect("a folder of specs");
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "yaml"));
    paths.sort();
    let spec = |path: &PathBuf| {
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        (name, fs::read_to_string(path).unwrap())
    };
    paths.iter().map(spec).collect()
}

/// Returns a module, and the list of its methods by index.
fn calls(name: &str, derivatives: bool, functions: &[Function]) -> String {
    let mut text = format!("include!(concat!(env!(\"OUT_DIR\"), \"/{name}.rs\"));\n");
    let model = struct_ident(name);
    writeln!(text, "compiled! {{ {name}, {model}, {derivatives};").unwrap();
    for (number, function) in functions.iter().enumerate() {
        let flat = match function.shape() {
            Shape::Scalar => "number",
            Shape::Vector | Shape::Spatial | Shape::Drives(_) => "matrix",
            Shape::Symmetric | Shape::Square | Shape::Jacobian => "matrix",
            Shape::TreeVector | Shape::TreeMatrix => "matrix",
            Shape::Point | Shape::PointJacobian => "matrix",
            Shape::Numbers(_) | Shape::Rows(_) => "matrix",
            Shape::ParameterColumns(_) | Shape::ParameterVector(_) => "matrix",
            Shape::RowVector | Shape::RowMatrix => "matrix",
            Shape::SquarePair | Shape::FourSquares | Shape::VectorTriple => "matrices",
            Shape::CheckedVector => "checked",
            Shape::Checked(Entries::VectorTriple) => "checked_matrices",
            Shape::Checked(_) => "checked",
            Shape::CheckedSquares => "checked_matrices",
            Shape::Pose => "pose",
            Shape::FourCubes
            | Shape::Poses(_)
            | Shape::CheckedActuated(_)
            | Shape::CheckedTree
            | Shape::CheckedTreeAndRows
            | Shape::CheckedWrenches
            | Shape::SlopesByTree
            | Shape::CheckedSlopesByTree
            | Shape::LinkWrenches => unreachable!("these methods are generated on request only"),
            Shape::Parts | Shape::CheckedParts => unreachable!("no scene is among the specs"),
            Shape::Bundle | Shape::CheckedBundle => {
                unreachable!("bundles are not among the functions")
            }
        };
        let arguments = function.method.arguments().iter().map(|a| a.name());
        let arguments = arguments.collect::<Vec<_>>().join(", ");
        writeln!(
            text,
            "    {number} => {flat} {}({arguments}),",
            function.name()
        )
        .unwrap();
    }
    text + "}\n"
}
