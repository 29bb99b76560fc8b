//! What results do not depend on: signs and lengths of quaternions, the place of a floating root.

use std::sync::Arc;

use bgdyn_codegen::SpecText;
use bgdyn_codegen::emit::OutputOptions;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::pipeline;
use bgdyn_runtime::Dd;

use super::robot::{Robot, State, WAYS, dd, golden_text, largest};
use super::specs;

fn bits(x: &[f64]) -> Vec<u64> {
    x.iter().map(|x| x.to_bits()).collect()
}

/// The functions of this robot, with all its places.
fn functions(robot: &Robot) -> Vec<Arc<Function>> {
    let methods = Method::possible(&robot.graph.sites).into_iter();
    let small = robot.nv() <= 12;
    let kept = methods.filter(|m| small || m.of_trait());
    let each = kept.flat_map(|m| WAYS.map(|way| robot.function(way, m)));
    each.collect()
}

#[test]
fn both_quaternions_of_a_rotation_give_the_same_bits() {
    let mut compared = 0;
    for (name, robot) in specs::robots() {
        let quaternions = robot.quaternions();
        let functions = functions(&robot);
        for seed in [5, 6] {
            let s = robot.state(seed).rounded();
            let mut turns: Vec<Vec<usize>> = quaternions.iter().map(|&at| vec![at]).collect();
            turns.push(quaternions.clone());
            for turned in turns.iter().filter(|turned| !turned.is_empty()) {
                let mut other = s.clone();
                for &at in turned {
                    other.q[at..at + 4].iter_mut().for_each(|x| *x = -*x);
                }
                for f in &functions {
                    let (a, b) = (s.value(f), other.value(f));
                    let what = (name, &f.name, &f.formulation, turned);
                    assert_eq!(bits(&a), bits(&b), "{what:?}: {a:?} against {b:?}");
                    compared += a.len();
                }
            }
        }
    }
    assert!(compared > 10_000);
}

/// Golden mechanisms and others that accept quaternions of any length.
fn of_any_length() -> Vec<(&'static str, Robot)> {
    let specs = specs::all().into_iter();
    let any = specs.map(|(name, text)| {
        let mut text = text;
        for word in ["floating", "spherical"] {
            let plain = format!("type: {word}");
            text = text.replace(&plain, &format!("{plain}, quaternion: any"));
        }
        (name, text)
    });
    let any = any.filter(|(_, text)| text.contains("quaternion: any"));
    any.map(|(name, text)| (name, Robot::read(&text))).collect()
}

fn longer(s: &State<f64>, quaternions: &[usize], factor: f64) -> State<f64> {
    let mut other = s.clone();
    for &at in quaternions {
        other.q[at..at + 4].iter_mut().for_each(|x| *x *= factor);
    }
    other
}

#[test]
fn a_quaternion_of_any_length_has_no_length() {
    let of_interest = [
        Method::InverseDynamics,
        Method::MassMatrix,
        Method::Bias,
        Method::Gravity,
        Method::KineticEnergy,
        Method::PotentialEnergy,
    ];
    let any = of_any_length();
    assert!(any.len() >= 6);
    for (name, robot) in any {
        let quaternions = robot.quaternions();
        for way in WAYS {
            for method in of_interest.into_iter().chain([Method::ForwardDynamics]) {
                let f = robot.function(way, method);
                for seed in [7, 8] {
                    let s = robot.state(seed).rounded();
                    let plain = s.value(&f);
                    let what = |factor: f64| format!("{name}, {way:?}, {}, by {factor}", f.name);
                    for factor in [0.5, 0.0625, 16.0] {
                        let found = longer(&s, &quaternions, factor).value(&f);
                        assert_eq!(bits(&found), bits(&plain), "{}", what(factor));
                    }
                    // Three times is rounded. Forward dynamics amplifies that by the condition of M; the
                    // literal sum has more roundings. Both obey the law in double-double, below.
                    if method == Method::ForwardDynamics || way == Some("literal") {
                        continue;
                    }
                    let found = longer(&s, &quaternions, 3.0).value(&f);
                    let size = largest(&dd(&plain));
                    for (k, (x, y)) in found.iter().zip(&plain).enumerate() {
                        let off = (x - y).abs();
                        assert!(
                            off <= 4.0 * f64::EPSILON * size,
                            "{}: entry {k}: {x} against {y}: {} eps",
                            what(3.0),
                            off / (size * f64::EPSILON)
                        );
                    }
                }
            }
        }
    }
}

/// In double-double: the unit form at the quaternion of length 1 and the form for any length at one of
/// length 3 are one function.
#[test]
fn any_length_equals_length_one() {
    for (name, any) in of_any_length() {
        let text = specs::all().into_iter().find(|(n, _)| *n == name);
        let unit = Robot::read(&text.expect("the same spec").1);
        let s = unit.state(9);
        let mut longer = s.clone();
        for at in unit.quaternions() {
            longer.q[at..at + 4]
                .iter_mut()
                .for_each(|x| *x *= Dd::from_f64(3.0));
        }
        for (way, method) in WAYS
            .into_iter()
            .flat_map(|way| Method::OF_TRAIT.map(|m| (way, m)))
        {
            let expected = s.value(&unit.function(way, method));
            let found = longer.value(&any.function(way, method));
            let what = format!("{name}, {way:?}, {method:?}");
            super::robot::close(&found, &expected, 1e-25, 0.0, &what);
        }
    }
}

/// A quaternion of zeros is no rotation: NaN, never a finite number.
#[test]
fn a_quaternion_of_zeros_is_no_number() {
    for (name, robot) in of_any_length() {
        for way in WAYS {
            for method in [
                Method::InverseDynamics,
                Method::Gravity,
                Method::PotentialEnergy,
            ] {
                if name == "satellite_arm6" {
                    continue; // without gravity nothing reads the orientation
                }
                let f = robot.function(way, method);
                for at in robot.quaternions() {
                    let s = robot.state(10).rounded();
                    let plain = s.value(&f);
                    let mut zero = s.clone();
                    zero.q[at..at + 4].fill(0.0);
                    let mut turned = s.clone();
                    // A quarter turn about another axis: what changes depends on the orientation.
                    turned.q[at..at + 4].copy_from_slice(&[0.0, 0.6, 0.0, 0.8]);
                    let (zero, turned) = (zero.value(&f), turned.value(&f));
                    let mut reads = 0;
                    for k in 0..plain.len() {
                        let depends = (plain[k] - turned[k]).abs() > 1e-9;
                        reads += usize::from(depends);
                        assert!(
                            !depends || zero[k].is_nan(),
                            "{name}, {way:?}, {}, q[{at}..]: entry {k} is {}",
                            f.name,
                            zero[k]
                        );
                    }
                    assert!(
                        reads > 0,
                        "{name}, {}: nothing depends on q[{at}..]",
                        f.name
                    );
                }
            }
        }
    }
}

/// A NaN in a component of a quaternion reaches every result that this component changes, and at least one
/// result of inverse dynamics if they depend on the orientation. (An entry of the rotation matrix of a unit quaternion reads three
/// components at most on its diagonal, so a result can be independent of a component.)
#[test]
fn nan_in_a_quaternion_stays_nan() {
    for (name, robot) in specs::robots() {
        for method in [Method::InverseDynamics, Method::PotentialEnergy] {
            let f = robot.function(None, method);
            for at in robot.quaternions() {
                let s = robot.state(11).rounded();
                let plain = s.value(&f);
                let mut turned = s.clone();
                turned.q[at..at + 4].copy_from_slice(&[0.0, 0.6, 0.0, 0.8]);
                let turned = turned.value(&f);
                let mut changes = plain.iter().zip(&turned);
                let oriented = changes.any(|(x, y)| (x - y).abs() > 1e-9);
                for component in at..at + 4 {
                    let with = |x: f64| {
                        let mut other = s.clone();
                        other.q[component] = x;
                        other.value(&f)
                    };
                    let (moved, broken) = (with(s.q[component] + 0.25), with(f64::NAN));
                    let mut reached = 0;
                    for k in 0..plain.len() {
                        let depends = (plain[k] - moved[k]).abs() > 1e-9;
                        reached += usize::from(broken[k].is_nan());
                        assert!(
                            !depends || broken[k].is_nan(),
                            "{name}, {}: entry {k} for NaN in q[{component}]",
                            f.name
                        );
                    }
                    assert!(
                        reached > 0 || !oriented || method == Method::PotentialEnergy,
                        "{name}, {}: no entry is NaN for NaN in q[{component}]",
                        f.name
                    );
                }
            }
        }
    }
}

/// Methods that the place of a floating root never enters.
const PLACELESS: [Method; 6] = [
    Method::InverseDynamics,
    Method::MassMatrix,
    Method::Bias,
    Method::Gravity,
    Method::ForwardDynamics,
    Method::KineticEnergy,
];

/// The literal sum subtracts places in the world, as the equation has it: it is left out.
#[test]
fn the_place_of_a_floating_root_changes_no_bit() {
    for (name, first) in [
        ("quadrotor_arm", "free_x"),
        ("satellite_arm6", "free_x"),
        ("anymal_floating", "root_joint_x"),
        ("helical_universal_test", "drone_free_x"),
        ("planar_base_ur5", "base_x"),
    ] {
        let robot = Robot::golden(name);
        let names = robot.mechanism.position_names();
        let at = names.iter().position(|n| n == first).expect("the root");
        // The z of a planar joint is none of its positions.
        let count = if name == "planar_base_ur5" { 2 } else { 3 };
        for way in [None, Some("subspaces")] {
            for method in PLACELESS {
                let f = robot.function(way, method);
                let s = robot.state(12).rounded();
                let near = s.value(&f);
                for far in [[1e9, -3e9, 7e8], [f64::NAN; 3], [f64::INFINITY; 3]] {
                    let mut other = s.clone();
                    other.q[at..at + count].copy_from_slice(&far[..count]);
                    let found = other.value(&f);
                    let what = format!("{name}, {way:?}, {}, {far:?}", f.name);
                    assert_eq!(bits(&found), bits(&near), "{what}");
                }
            }
        }
    }
}

/// A floating joint on a moving link: its position is felt.
#[test]
fn the_place_of_a_floating_link_on_another_is_read() {
    let robot = Robot::golden("helical_universal_test");
    let names = robot.mechanism.position_names();
    let at = names.iter().position(|n| n == "buoy_free_x").expect("it");
    for way in WAYS {
        let f = robot.function(way, Method::MassMatrix);
        let s = robot.state(12).rounded();
        for k in 0..3 {
            let mut other = s.clone();
            other.q[at + k] += 0.5;
            assert_ne!(bits(&other.value(&f)), bits(&s.value(&f)), "{way:?}, {k}");
        }
    }
}

/// Returns what the documentation of a method says that it does not read.
fn unread(module: &str, method: &str) -> String {
    let at = module.find(&format!("pub fn {method} "));
    let before = &module[..at.unwrap_or_else(|| panic!("no {method}"))];
    // Its documentation: what follows the function before it.
    let start = before.rfind("pub fn ").unwrap_or(0);
    let said = before[start..].rfind("Does not read: ");
    let said = said.map_or("", |said| &before[start + said..]);
    said.split(". \"")
        .next()
        .unwrap_or("")
        .split(".\"")
        .next()
        .unwrap_or("")
        .to_owned()
}

#[test]
fn the_documentation_lists_what_is_not_read() {
    let text = golden_text("quadrotor_arm.yaml");
    let output = OutputOptions::source_text("quadrotor_arm.yaml".into());
    let spec = SpecText::mechanism(&text, "quadrotor_arm");
    let generated = pipeline::generate_module(&spec, &Options::default(), &output);
    let module = generated.expect("a module").0.to_string();
    let places = ["`q[0]` (free_x)", "`q[1]` (free_y)", "`q[2]` (free_z)"];
    for method in ["inverse_dynamics", "bias", "gravity", "forward_dynamics"] {
        let unread = unread(&module, method);
        for place in places {
            assert!(unread.contains(place), "{method}: {unread:?}");
        }
        assert!(!unread.contains("q[3]"), "{method}: {unread:?}");
        assert!(!unread.contains("(shoulder)"), "{method}: {unread:?}");
    }
    // M reads nothing of the base's pose.
    let of_mass = unread(&module, "mass_matrix");
    for k in 0..7 {
        assert!(of_mass.contains(&format!("`q[{k}]`")), "{of_mass:?}");
    }
    assert!(!of_mass.contains("`q[8]`"), "{of_mass:?}");
    // The potential energy reads the position, and the tool's pose all of it.
    let of_pose = unread(&module, "pose_tool");
    assert!(!of_pose.contains("free"), "{of_pose:?}");
    let of_energy = unread(&module, "potential_energy");
    assert!(
        of_energy.contains("free_x") && !of_energy.contains("free_z"),
        "{of_energy:?}"
    );
}

/// A free body at its mass centre: M is constant and reads nothing.
#[test]
fn a_constant_mass_matrix_is_a_function_of_nothing() {
    let robot = Robot::read(
        "format: 1\nname: body\nlinks:\n  - name: body\n    joint: { name: free, type: floating }\n    mass: 2\n    \
         com: [0.1, 0, 0]\n    inertia: { xx: 0.1, yy: 0.2, zz: 0.25 }\n",
    );
    for way in [None, Some("subspaces")] {
        let f = robot.function(way, Method::MassMatrix);
        assert_eq!(f.operations().to_string(), "0 mul, 0 add", "{way:?}");
        let s = State {
            q: vec![f64::NAN; 7],
            v: vec![f64::NAN; 6],
            a: vec![f64::NAN; 6],
            u: vec![f64::NAN; 6],
        };
        let found = super::robot::full(&s.value(&f), 6);
        // m·1, −[m c]×, and J about the link's origin.
        assert_eq!(found[0], [2.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(found[1], [0.0, 2.0, 0.0, 0.0, 0.0, 0.2]);
        assert_eq!(found[2], [0.0, 0.0, 2.0, 0.0, -0.2, 0.0]);
        let about_origin = [0.1, 0.2 + 2.0 * 0.01, 0.25 + 2.0 * 0.01];
        for (k, x) in about_origin.into_iter().enumerate() {
            assert!((found[3 + k][3 + k] - x).abs() < 1e-15);
        }
    }
}
