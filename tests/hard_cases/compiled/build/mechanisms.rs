//! Generates mechanisms: chains, mass ratios, singular mass matrices, moved bases, gimbals, bodies that turn
//! freely, and the specs of the repository.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use bgdyn_codegen::emit::{OutputOptions, module, source_text, struct_ident};
use bgdyn_codegen::files::stem;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::{DYNAMICS, Options};

use crate::dependence;
use crate::written::{Chain, cases, links_of, sliders_of};

/// Bodies on spherical and floating joints, by name and file.
const FREE: [(&str, &str); 5] = [
    ("free_body_generic", "specs/free_body_generic.yaml"),
    ("heavy_top", "../free_scenes/heavy_top.yaml"),
    ("spherical_pendulum", "specs/spherical_pendulum.yaml"),
    ("body_tumbling", "specs/body_tumbling.yaml"),
    ("satellite_arm6", "../free_joints/satellite_arm6.yaml"),
];

/// The specs by name.
fn specs(root: &Path) -> Vec<(String, String)> {
    let mut specs = vec![];
    for links in [2, 4, 8, 16, 32, 64] {
        for (kind, planar) in [("planar", true), ("spatial", false)] {
            specs.push((format!("{kind}_{links}"), Chain::rods(links, planar).text()));
        }
    }
    let read = |path: &str| fs::read_to_string(root.join(path)).expect(path);
    for (i, case) in cases(&read("static_mass_ratio.json")).iter().enumerate() {
        let links = case["n"].as_u64().expect("n") as usize;
        let last = case["mass_ratio_last"].as_f64().expect("a ratio");
        specs.push((format!("ratio_{i}"), Chain::of_ratio(links, last).text()));
    }
    specs.extend(singular(&read("singular_mass_matrix.json")));
    specs.extend(uneven());
    specs.extend(gimbals());
    specs.extend(moved(
        &read("../../specs/scara.yaml"),
        &read("../../specs/puma560.yaml"),
    ));
    for (name, path) in FREE {
        specs.push((name.to_owned(), read(path)));
    }
    specs.extend(shared(&root.join("../../specs")));
    specs
}

/// Returns cases with exact results: refused ones, and solved ones.
fn singular(file: &str) -> Vec<(String, String)> {
    let whole =
        |links: &str| format!("format: 1\nname: singular\ngravity: [0, 0, 0]\nlinks:\n{links}");
    let mut specs = vec![];
    for (i, case) in cases(file).iter().enumerate() {
        if let Some(items) = case["items"].as_array() {
            for (j, item) in items.iter().enumerate() {
                specs.push((format!("singular_{i}_{j}"), whole(&sliders_of(item))));
            }
        } else {
            let links = links_of(case["bodies"].as_array().expect("bodies"));
            specs.push((format!("singular_{i}"), whole(&links)));
        }
    }
    specs
}

/// Returns chains whose masses span up to 1e12: the first link heavy, masses that increase or decrease
/// from link to link.
fn uneven() -> Vec<(String, String)> {
    let chain = |scales: Vec<f64>| Chain {
        planar: false,
        moments: [1.0 / 512.0, 1.0 / 16.0, 1.0 / 16.0],
        scales,
    };
    let mut specs = vec![];
    for exponent in [3, 6, 9, 12] {
        let first = 10_f64.powi(exponent);
        let text = chain(vec![first, 1.0, 1.0, 1.0]).text();
        specs.push((format!("heavy_first_{exponent}"), text));
        let text = chain(vec![1.0, 1.0, 1.0, first]).text();
        specs.push((format!("heavy_last_{exponent}"), text));
    }
    let graded = vec![1.0, 1e4, 1e8, 1e12];
    specs.push(("growing".into(), chain(graded.clone()).text()));
    specs.push((
        "falling".into(),
        chain(graded.into_iter().rev().collect()).text(),
    ));
    specs
}

/// Returns bodies on two massless rings, whose outer and inner axis are almost parallel if the middle
/// angle is small.
fn gimbals() -> Vec<(String, String)> {
    let rings = "format: 1
name: gimbal
gravity: [0, 0, 0]
links:
  - name: outer
    joint: { name: yaw, type: revolute, axis: z }
  - name: inner
    parent: outer
    joint: { name: tilt, type: revolute, axis: x }
  - name: rotor
    parent: inner
    joint: { name: spin, type: revolute, axis: z }
    mass: 2
";
    let bodies = [
        ("gimbal_round", "    inertia: { xx: 1.5, yy: 1.5, zz: 2 }\n"),
        (
            "gimbal_skew",
            "    com: [0.1, 0.2, 0.3]\n    inertia: { xx: 1, yy: 1.1, zz: 1.2, xy: 0.1, xz: -0.05 }\n",
        ),
    ];
    let spec = |(name, body): (&str, &str)| (name.to_owned(), format!("{rings}{body}"));
    bodies.into_iter().map(spec).collect()
}

/// Returns two arms with their base at the origin and up to 1e9 m away.
fn moved(scara: &str, puma560: &str) -> Vec<(String, String)> {
    let arms = [
        (
            "scara",
            scara,
            "origin: { xyz: [0, 0, 400 mm] }",
            "origin: { xyz: PLACE }",
        ),
        (
            "puma560",
            puma560,
            "name: waist\n",
            "name: waist\n      origin: { xyz: PLACE }\n",
        ),
    ];
    let places = [
        "[0, 0, 0]",
        "[1e3, -1e3, 7]",
        "[0.1, 1e6, -1e6]",
        "[1e9, -3e8, 1e9]",
    ];
    let mut specs = vec![];
    for (name, text, from, to) in arms {
        assert_eq!(text.matches(from).count(), 1, "{name}");
        for (i, place) in places.iter().enumerate() {
            let moved = text.replace(from, &to.replace("PLACE", place));
            specs.push((format!("{name}_at_{i}"), moved));
        }
    }
    specs
}

/// The specs of the repository.
fn shared(folder: &Path) -> Vec<(String, String)> {
    let entries = fs::read_dir(folder).expect("a folder of specs");
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "yaml"));
    paths.sort();
    let spec = |path: &PathBuf| (stem(path), fs::read_to_string(path).unwrap());
    paths.iter().map(spec).collect()
}

/// Writes all modules. Returns the text that includes them and lists them by name: as models, with their
/// specs, and with the dependences of their methods.
pub(crate) fn write(root: &Path, out: &Path) -> String {
    let [mut includes, mut models, mut texts, mut depends] = [const { String::new() }; 4];
    for (name, text) in specs(root) {
        let (mechanism, faults) =
            bgdyn_codegen::read(&text, (!text.contains("\nname:")).then_some(&*name));
        let mechanism = mechanism.unwrap_or_else(|| panic!("{}", faults.render(&name, &text)));
        let options = Options {
            methods: Some(vec![DYNAMICS.into()]),
            ..Options::default()
        };
        let model =
            bgdyn_codegen::selection::model(mechanism, &options).expect("the methods of the trait");
        let place = OutputOptions::source_text(format!("{name}.yaml"));
        let place = place.with_module(&name).expect("a name");
        let (spec, source) = (
            out.join(format!("{name}.yaml")),
            out.join(format!("{name}.rs")),
        );
        let own = struct_ident(model.mechanism.name());
        fs::write(&spec, &text).unwrap();
        fs::write(&source, source_text(module(&model, &place))).unwrap();
        let (nq, nv) = (model.mechanism.nq(), model.mechanism.nv());
        writeln!(includes, "include!({source:?});").unwrap();
        writeln!(
            models,
            "{name:?} => Some(Box::new(Erased::<_, {nq}, {nv}>({name}::{own}::<T>::default()))),"
        )
        .unwrap();
        writeln!(texts, "({name:?}, include_str!({spec:?})),").unwrap();
        let methods = [
            Method::InverseDynamics,
            Method::MassMatrix,
            Method::Bias,
            Method::Gravity,
            Method::ForwardDynamics,
        ];
        let masks = methods.map(|m| dependence::text(model.function(m).expect("a method")));
        writeln!(depends, "({name:?}, [{}]),", masks.join(", ")).unwrap();
    }
    format!(
        "{includes}
fn any<T: Scalar>(name: &str) -> Option<Box<dyn Model<T>>> {{
    match name {{ {models} _ => None }}
}}
/// The specs by name.
pub const TEXTS: &[(&str, &str)] = &[{texts}];
/// For each model, and each component of inverse dynamics, mass matrix, bias, gravity and forward
/// dynamics, the inputs that it depends on: in masks of [`bit`].
pub const DEPENDS: &[(&str, [&[u128]; 5])] = &[{depends}];
"
    )
}
