//! Tests operational space, derivatives along directions and adjoints: equal to equation (6) on random trees, joints of
//! every type, loops and constraints; a singular posture is an error with a direction; counts of operations.

use bgdyn_codegen::bond_graph::SiteId;
use bgdyn_codegen::expr::{Builder, Graph, Inputs, Leaf, copy_into};
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::{Directional, Method, Operational, Shape};
use bgdyn_codegen::verify::check_functions;
use bgdyn_runtime::{Cause, Dd, TASKS};

use crate::checked::{
    checked_methods, counted, every_turned_sign_is_refused, of_folder, quick_loops,
};
use crate::common::random::Draft;
use crate::common::rng::Rng;
use crate::common::{Robot, golden};

/// Returns the methods of a mechanism, those of a frame for its last one.
fn methods(robot: &Robot) -> Vec<Method> {
    let last = robot.graph.sites.len().checked_sub(1).map(SiteId);
    let of_this = |method: &Method| match method {
        Method::Operational(of) => of.site().is_none() || of.site() == last,
        Method::Directional(of) => !of.is_second(),
        _ => false,
    };
    let all = Method::possible_of(robot.graph).into_iter();
    all.filter(of_this).collect()
}

fn passes(robot: &Robot, what: &str) {
    checked_methods(robot, &methods(robot), what);
}

#[test]
fn random_trees_equal_equation_6() {
    let mut rng = Rng::new(223);
    for _ in 0..16 {
        let text = Draft::random(&mut rng, 8).yaml();
        passes(&Robot::read(&text, None), &text);
    }
}

#[test]
fn every_spec_equals_equation_6() {
    for (name, text) in of_folder("specs") {
        passes(&Robot::read(&text, Some(&name)), &name);
    }
}

/// Free bases, balls, screws: directions are along the velocities.
#[test]
fn joints_of_every_type_equal_equation_6() {
    let specs = of_folder("tests/golden/joints");
    assert!(specs.len() > 5);
    let small = |text: &str| text.matches("joint:").count() <= 8;
    for (name, text) in specs.iter().filter(|(_, text)| small(text)) {
        passes(&Robot::read(text, Some(name)), name);
    }
}

/// Mimics, gears, prescribed joints and wheels; with conditions on velocities alone without directions.
#[test]
fn constrained_mechanisms_equal_equation_6() {
    let mut without = 0;
    for (name, text) in of_folder("specs/constraints") {
        let robot = Robot::read(&text, Some(&name));
        without += usize::from(Method::directional_of(robot.graph).is_err());
        passes(&robot, &name);
    }
    assert!(without > 2);
}

#[test]
fn loops_equal_equation_6() {
    for (name, text) in quick_loops() {
        passes(&Robot::read(&text, Some(&name)), &name);
    }
}

#[test]
fn turned_signs_are_refused() {
    let robot = golden::robot("puma560");
    let model = checked_methods(&robot, &methods(&robot), "puma560");
    // Some entries are zero in every posture, but no constants.
    let at = Inputs {
        q: vec![0.3, -0.4, 0.7, 0.2, 0.9, 0.5],
        v: vec![0.4, -0.9, 0.3, 1.2, -0.5, 0.8],
        a: vec![0.6, 0.2, -0.7, 0.9, 1.3, -0.4],
        u: vec![3.0, -5.0, 2.0, 1.0, -2.0, 0.7],
        x: vec![0.7, 0.3, -0.8, 0.6, 1.1, -0.9],
        modes: vec![0.2, -0.6, 0.9, 1.4, -0.3, 0.5],
        ..Inputs::default()
    };
    let only_checked = |function: &Function| match function.shape() {
        Shape::Checked(_) => robot.nv(),
        _ => 0,
    };
    every_turned_sign_is_refused(&model, |function, k| {
        let values: Vec<f64> = function.evaluate(at.clone()).0;
        k >= only_checked(function) && values[k].abs() > 1e-9
    });
}

/// A stretched wrist turns in two directions only: Λ has no result, and the error names a direction. Λ⁻¹ has one.
#[test]
fn a_singular_posture_names_a_direction() {
    let robot = golden::robot("puma560");
    let site = SiteId(robot.graph.sites.len() - 1);
    let at = Inputs {
        q: vec![0.3, -0.4, 0.7, 0.2, 0.0, 0.5],
        v: vec![0.1; 6],
        ..Inputs::default()
    };
    for of in Operational::of_site(site) {
        let function = robot.emitted(Method::Operational(of));
        let (_, refused): (Vec<f64>, Option<usize>) = function.evaluate(at.clone());
        assert_eq!(refused.is_some(), of.inverts_task(), "{of:?}");
        if let Some(pivot) = refused {
            assert!((TASKS + 6..TASKS + 12).contains(&pivot), "{of:?}: {pivot}");
            assert_eq!(Cause::of_pivot(pivot, 6).0, Cause::Posture);
        }
    }
}

#[test]
fn a_frame_of_four_joints_has_an_inverse_inertia_only() {
    let robot = golden::robot("scara4");
    let last = &robot.graph.sites.last().expect("a site").name;
    let named = |prefix: &str| Method::named(robot.graph, &format!("{prefix}_{last}"));
    assert!(named("operational_inverse").is_ok());
    let why = named("operational_inertia").expect_err("too few joints");
    assert!(why.contains("by 4 of its velocities"), "{why}");
}

/// ∂P/∂q l is no (∂P/∂q)ᵀ l.
#[test]
fn a_transposed_adjoint_is_refused() {
    let robot = golden::robot("puma560");
    let emitted = |of| robot.emitted(Method::Directional(of));
    let along = emitted(Directional::InverseAlong);
    let mut wrong = emitted(Directional::InverseAdjoint);
    let b = Builder::from(wrong.graph.clone());
    // The direction of the positions has the leaves of the factors.
    let only_positions = |g: &mut Graph, leaf| match leaf {
        Leaf::Mode(_) | Leaf::Input(_) => Some(g.constant(Dd::ZERO)),
        _ => None,
    };
    let products =
        b.with_graph(|g| copy_into(g, &along.graph, &along.blocks[0].outputs, only_positions));
    let right = check_functions("adjoint", robot.graph, std::slice::from_ref(&wrong));
    assert!(right.is_empty());
    wrong.blocks[0].outputs[..robot.nv()].copy_from_slice(&products);
    wrong.graph = b.into_graph();
    assert_eq!(check_functions("adjoint", robot.graph, &[wrong]).len(), 1);
}

/// Multiplications and additions by robot, before loops and blocks: M⁻¹; Λ⁻¹, Λ, J̄ and μ of the last link; along a
/// direction and adjoint, of inverse dynamics and then of forward dynamics. Zeros: no such method.
const COUNTS: [(&str, [usize; 9]); 6] = [
    ("scara_rrpr", [47, 75, 0, 0, 0, 106, 111, 173, 185]),
    (
        "stanford_gen",
        [374, 561, 771, 1299, 1231, 903, 888, 1483, 1473],
    ),
    (
        "puma_gen",
        [437, 645, 855, 1384, 1370, 1015, 999, 1655, 1642],
    ),
    ("ur5_gen", [399, 644, 854, 1377, 1285, 941, 923, 1459, 1449]),
    (
        "panda_gen",
        [633, 1079, 1289, 1973, 1942, 1285, 1269, 2210, 2197],
    ),
    (
        "iiwa_gen",
        [591, 861, 1071, 1749, 1668, 1218, 1201, 2067, 2057],
    ),
];

#[test]
fn counts_do_not_grow() {
    let found = COUNTS.map(|(name, _)| {
        let robot = golden::robot(name);
        let [a, b, c, d] = Operational::of_site(SiteId(robot.graph.sites.len() - 1));
        let [a, b, c, d] = [a, b, c, d].map(Method::Operational);
        let [e, f, g, h] = [
            Directional::InverseAlong,
            Directional::InverseAdjoint,
            Directional::ForwardAlong,
            Directional::ForwardAdjoint,
        ]
        .map(Method::Directional);
        let inverse = Method::Operational(Operational::InverseMassMatrix);
        (name, counted(&robot, [inverse, a, b, c, d, e, f, g, h]))
    });
    assert_eq!(found, COUNTS);
}
