//! Bundles: their parts equal the literal sum, and cost less together than one by one.

use std::fs;
use std::path::{Path, PathBuf};

use bgdyn_codegen::bond_graph;
use bgdyn_codegen::choice::Preference;
use bgdyn_codegen::expr::Signed;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::model::Model;
use bgdyn_codegen::options::{BundleOption, Options};
use bgdyn_codegen::random::Random;
use bgdyn_codegen::read;
use bgdyn_codegen::selection;
use bgdyn_codegen::verify::check_model;

fn specs(folders: &[&str]) -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let files = folders
        .iter()
        .flat_map(|folder| fs::read_dir(root.join(folder)).expect("a folder"));
    let paths = files.map(|file| file.expect("a file").path());
    let mut paths: Vec<PathBuf> = paths
        .filter(|p| p.extension().is_some_and(|end| end == "yaml"))
        .collect();
    paths.sort();
    paths
}

fn mechanism(path: &Path) -> Mechanism {
    let text = fs::read_to_string(path).expect("a spec");
    let stem = path.file_stem().and_then(|stem| stem.to_str());
    read(&text, stem)
        .0
        .unwrap_or_else(|| panic!("{}", path.display()))
}

fn named(name: &str, methods: &[String]) -> BundleOption {
    BundleOption {
        name: name.into(),
        methods: methods.to_vec(),
    }
}

/// Returns the model with these bundles and no other functions.
fn bundled(mechanism: Mechanism, bundles: Vec<BundleOption>, prefer: Preference) -> Model {
    let options = Options {
        methods: Some(Vec::new()),
        bundles,
        prefer,
        ..Options::default()
    };
    selection::model(mechanism, &options).expect("methods that can be in a bundle")
}

/// Returns the names of all methods that can be in a bundle with others.
fn possible(mechanism: &Mechanism) -> Vec<String> {
    let graph = bond_graph::build(mechanism);
    let closed = graph.closed.as_deref();
    let all = Method::possible_of(&graph)
        .into_iter()
        .filter(|m| m.may_be_bundled());
    all.map(|m| m.name_in(closed, &graph.sites)).collect()
}

/// Every spec with two random bundles of up to five methods each.
#[test]
fn random_bundles_of_every_spec_equal_equation_6() {
    let mut random = Random(20_261_128);
    let mut several = 0;
    for path in specs(&["specs", "specs/loops", "specs/constraints"]) {
        let mechanism = mechanism(&path);
        // Derivatives of the largest ones take minutes.
        let slow = match mechanism.nv() {
            0..=4 => &[][..],
            5..=8 => &["curvature", "second"],
            _ => &[
                "derivatives",
                "operational",
                "consistent",
                "along",
                "adjoint",
                "curvature",
                "second",
            ],
        };
        let mut names = possible(&mechanism);
        names.retain(|name| !slow.iter().any(|part| name.contains(part)));
        let graph = bond_graph::build(&mechanism);
        let may_be_together = |names: &[String]| {
            let method = |name: &String| Method::named(&graph, name).expect("a method");
            let all: Vec<Method> = names.iter().map(method).collect();
            Method::bundle(&all).is_some()
        };
        let mut some = || -> Vec<String> {
            let mut left = names.clone();
            let count = 2 + (random.unit() * 4.0) as usize;
            let mut taken: Vec<String> = Vec::new();
            while taken.len() < count && !left.is_empty() {
                let k = (random.unit() * left.len() as f64) as usize;
                taken.push(left.remove(k.min(left.len() - 1)));
                left.retain(|name| {
                    may_be_together(&[&taken[..], std::slice::from_ref(name)].concat())
                });
            }
            taken
        };
        let bundles = vec![
            named("first_bundle", &some()),
            named("second_bundle", &some()),
        ];
        let model = bundled(mechanism, bundles, Preference::Operations);
        assert_eq!(model.bundles.len(), 2, "{}", path.display());
        several += model
            .bundles
            .iter()
            .filter(|b| b.function.shape().checked())
            .count();
        let wrong = check_model(&model);
        assert!(wrong.is_empty(), "{}: {wrong:#?}", path.display());
    }
    assert!(
        several > 10,
        "few bundles have a part that may have no result"
    );
}

/// The comparison with equation (6) sees every part.
#[test]
fn a_wrong_part_is_found() {
    let scara = mechanism(
        &specs(&["specs"])
            .into_iter()
            .find(|p| p.ends_with("scara.yaml"))
            .expect("a spec"),
    );
    let names = ["mass_matrix", "bias", "jacobian_dot_v_world_tool"].map(String::from);
    let model = bundled(
        scara,
        vec![named("control", &names)],
        Preference::Operations,
    );
    assert_eq!(check_model(&model), []);
    for part in 0..3 {
        let mut wrong = Model {
            bundles: model.bundles.clone(),
            ..copy(&model)
        };
        let place = wrong.bundles[0].parts[part].outputs.end - 1;
        let last = wrong.bundles[0]
            .function
            .blocks
            .last_mut()
            .expect("a block");
        let Signed { node, negative } = last.outputs[place - 1];
        last.outputs[place] = Signed {
            node,
            negative: !negative,
        };
        assert_eq!(check_model(&wrong).len(), 1, "part {part}");
    }
}

fn copy(model: &Model) -> Model {
    Model {
        mechanism: model.mechanism.clone(),
        bond_graph: model.bond_graph.clone(),
        assembles: model.assembles,
        functions: model.functions.clone(),
        bundles: Vec::new(),
        base_parameters: Vec::new(),
    }
}

/// The methods of a controller in task space.
fn control(site: &str) -> Vec<String> {
    let of_site = ["pose", "jacobian_world", "jacobian_dot_v_world"];
    let of_site = of_site.map(|method| format!("{method}_{site}"));
    ["mass_matrix", "bias"]
        .map(String::from)
        .into_iter()
        .chain(of_site)
        .collect()
}

/// Operations of a bundle, and of its methods one by one: multiplications and additions, pairs of sine and cosine, and
/// the cost that the choice counts.
fn counts(spec: &str, names: &[String]) -> [[u64; 3]; 2] {
    let path = specs(&["specs"])
        .into_iter()
        .find(|p| p.ends_with(format!("{spec}.yaml")))
        .expect("a spec");
    let options = Options {
        methods: Some(names.to_vec()),
        bundles: vec![named("control", names)],
        ..Options::default()
    };
    let model = selection::model(mechanism(&path), &options).expect("a model");
    let count = |function: &Function| {
        let all = function.operations();
        [
            all.total() as u64,
            all.sincos as u64,
            function.cost().weighted() as u64,
        ]
    };
    let mut separate = [0; 3];
    for function in &model.functions {
        separate
            .iter_mut()
            .zip(count(function))
            .for_each(|(sum, x)| *sum += x);
    }
    [count(&model.bundles[0].function), separate]
}

/// An adjoint, or a direction, with the values themselves: multiplications and additions together, and one by one.
#[test]
fn counts_with_directions() {
    let bundles = [
        ["inverse_dynamics", "inverse_dynamics_adjoint"],
        ["forward_dynamics", "forward_dynamics_adjoint"],
        ["inverse_dynamics", "inverse_dynamics_along"],
        ["forward_dynamics", "forward_dynamics_along"],
    ];
    let found = bundles.map(|names| {
        let names = names.map(String::from);
        let found = counts("panda", &names);
        found.map(|one| one[0])
    });
    let wanted = [[1295, 1792], [2197, 3197], [1310, 1808], [2210, 3210]];
    assert_eq!(found, wanted);
}

/// The table of docs/bundles.md.
#[test]
fn counts_of_arms() {
    let arms = [("ur5", "flange"), ("panda", "tool")];
    let found = arms.map(|(spec, site)| counts(spec, &control(site)));
    let ur5 = [[449, 6], [579, 25]];
    let panda = [[1030, 7], [1392, 32]];
    let short = |all: [[u64; 3]; 2]| all.map(|one| [one[0], one[1]]);
    assert_eq!(found.map(short), [ur5, panda]);
    // With sines a bundle costs at most 0.6 of its methods.
    for [together, separate] in found {
        assert!(
            together[2] * 10 <= separate[2] * 6,
            "{together:?} {separate:?}"
        );
    }
}

/// With `prefer: accuracy` each part is the most accurate function; also where they are cut into blocks.
#[test]
fn accurate_bundles_equal_equation_6() {
    let mut blocks = 0;
    for path in [
        "specs/scara.yaml",
        "specs/spring_pendulum.yaml",
        "tests/golden/specs/chain32.yaml",
    ] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path);
        let names = ["mass_matrix", "bias", "inverse_dynamics"].map(String::from);
        let bundles = vec![named("all", &names)];
        let model = bundled(mechanism(&path), bundles, Preference::Accuracy);
        blocks = model.bundles[0].function.blocks.len().max(blocks);
        assert_eq!(check_model(&model), [], "{}", path.display());
    }
    assert!(blocks > 1, "none of them is cut");
}
