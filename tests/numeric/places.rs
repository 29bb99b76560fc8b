//! Compares compiled poses, velocities, Jacobians and J̇v with external values, through the trait of
//! frames: those of `tests/golden/places.py`, and of Pinocchio.

use std::fs;

use bgdyn::nalgebra::{SMatrix, SVector};
use bgdyn::{Description, Frame, Kinematics};
use serde_json::Value;

use crate::robots::{
    chain4, chain8, iiwa_gen, panda7, puma560, scara_rrpr, scara4, stanford_gen, ur5_gen,
};

bgdyn::bgdyn!(
    "crane.yaml",
    methods = [gravity],
    frames = [hook, luff_head]
);
bgdyn::bgdyn!("palletiser.yaml", methods = [gravity], frames = [grip]);
bgdyn::bgdyn!(
    "torso.yaml",
    methods = [gravity],
    frames = [eyes, left_grip, right_grip, right_forearm]
);
bgdyn::bgdyn!(
    "../golden/jacobians/anymal.yaml",
    methods = [kinetic_energy],
    frames = [l_lf_kfe]
);

/// Tolerance in roundings, relative to the largest term of a value.
const ROUNDINGS: f64 = 8.0;

struct Golden {
    file: Value,
    /// For each joint of the model its index in the file.
    order: Vec<usize>,
}

impl Golden {
    fn open(path: &str, joints: &[&str]) -> Golden {
        let path = format!("{}/tests/golden/{path}", env!("CARGO_MANIFEST_DIR"));
        let text = fs::read_to_string(&path).expect("the golden file is there");
        let file: Value = serde_json::from_str(&text).expect("the golden file is JSON");
        let names = file["joints"].as_array().expect("joints");
        let place = |j: &&str| {
            names
                .iter()
                .position(|n| n == j)
                .expect("the joint is there")
        };
        let order: Vec<usize> = joints.iter().map(place).collect();
        assert_eq!(order.len(), names.len());
        Golden { file, order }
    }

    fn states(&self) -> &[Value] {
        let states = self.file["states"].as_array().expect("states");
        assert!(states.len() >= 2, "golden states are there");
        states
    }

    /// One number per joint.
    fn joints<const N: usize>(&self, value: &Value) -> SVector<f64, N> {
        SVector::from_fn(|j, _| number(&value[self.order[j]]))
    }

    /// Six rows, a column per joint.
    fn columns<const N: usize>(&self, value: &Value) -> SMatrix<f64, 6, N> {
        SMatrix::from_fn(|i, j| number(&value[i][self.order[j]]))
    }
}

/// JSON numbers are parsed with all digits.
fn number(value: &Value) -> f64 {
    let digits = value.as_number().expect("a number").to_string();
    digits.parse().expect("an f64")
}

fn six(value: &Value) -> SVector<f64, 6> {
    SVector::from_fn(|i, _| number(&value[i]))
}

fn assert_near<const R: usize, const C: usize>(
    what: &str,
    found: SMatrix<f64, R, C>,
    wanted: SMatrix<f64, R, C>,
    size: f64,
) {
    let off = (found - wanted).amax();
    assert!(
        off <= ROUNDINGS * f64::EPSILON * size,
        "{what}: off by {off:e} of {size}:\n{found}instead of{wanted}"
    );
}

/// Returns the largest distance in a Jacobian, at least 1 m.
fn reach<const N: usize>(jacobian: &SMatrix<f64, 6, N>) -> f64 {
    jacobian.amax().max(1.0)
}

fn motion<F, M, const N: usize>(
    what: &str,
    model: &M,
    (q, v): (&SVector<f64, N>, &SVector<f64, N>),
    jacobian: SMatrix<f64, 6, N>,
    rate: SVector<f64, 6>,
) where
    F: Frame,
    M: Kinematics<F, f64, N, N>,
{
    let speed = v.lp_norm(1);
    assert!(speed > 0.1, "{what}: it moves");
    let size = reach(&jacobian);
    assert_near(
        &format!("{what}, J"),
        model.jacobian_world(q),
        jacobian,
        size,
    );
    assert_near(
        &format!("{what}, J v"),
        model.velocity(q, v),
        jacobian * v,
        size * speed,
    );
    let found = model.jacobian_dot_v_world(q, v);
    assert_near(&format!("{what}, J̇ v"), found, rate, size * speed * speed);
}

/// Compares all four methods of a frame.
fn of_the_script<F, M, const N: usize>(robot: &str, model: &M)
where
    F: Frame,
    M: Kinematics<F, f64, N, N> + Description<N>,
{
    let golden = Golden::open(&format!("places/{robot}.json"), &M::JOINT_NAMES);
    for (k, state) in golden.states().iter().enumerate() {
        let what = format!("{robot}, {}, state {k}", F::NAME);
        let (q, v) = (golden.joints(&state["q"]), golden.joints(&state["v"]));
        let place = &state["places"][F::NAME];
        let pose = model.pose(&q);
        let turn = SMatrix::<f64, 3, 3>::from_fn(|i, j| number(&place["rotation"][i][j]));
        assert_near(&format!("{what}, rotation"), pose.rotation, turn, 1.0);
        let origin = SVector::<f64, 3>::from_fn(|i, _| number(&place["translation"][i]));
        let size = origin
            .amax()
            .max(reach(&golden.columns::<N>(&place["jacobian"])));
        assert_near(&format!("{what}, origin"), pose.translation, origin, size);
        let velocity = six(&place["velocity"]);
        assert_near(&what, model.velocity(&q, &v), velocity, size * v.lp_norm(1));
        let (jacobian, rate) = (
            golden.columns(&place["jacobian"]),
            six(&place["jacobian_dot_v"]),
        );
        motion::<F, M, N>(&what, model, (&q, &v), jacobian, rate);
    }
}

/// Compares Jacobian and J̇v with those of Pinocchio.
fn of_pinocchio<F, M, const N: usize>(robot: &str, model: &M)
where
    F: Frame,
    M: Kinematics<F, f64, N, N> + Description<N>,
{
    let golden = Golden::open(&format!("jacobians/{robot}.json"), &M::JOINT_NAMES);
    assert_eq!(golden.file["link"], F::NAME);
    for (k, state) in golden.states().iter().enumerate() {
        let (q, v) = (golden.joints(&state["q"]), golden.joints(&state["v"]));
        let (jacobian, rate) = (golden.columns(&state["J"]), six(&state["Jdot_v"]));
        let what = format!("{robot}, state {k}");
        motion::<F, M, N>(&what, model, (&q, &v), jacobian, rate);
    }
}

macro_rules! check {
    ($($check:ident $module:ident::$model:ident: $($frame:ident)*;)*) => {
        $($($check::<$module::frames::$frame, _, { $module::NV }>(
            stringify!($module),
            &$module::$model::<f64>::default(),
        );)*)*
    };
}

#[test]
fn places_equal_the_values_of_the_script() {
    check! {
        of_the_script puma560::Puma560: LJ6;
        of_the_script panda7::Panda7: LPandaJoint7;
        of_the_script scara4::Scara4: LJ4;
        of_the_script ur5_gen::Ur5Gen: L6;
        of_the_script iiwa_gen::IiwaGen: L7;
        of_the_script stanford_gen::StanfordGen: L6;
        of_the_script scara_rrpr::ScaraRrpr: L4;
        of_the_script chain4::Chain4: LJ4;
        of_the_script chain8::Chain8: LJ8;
        of_the_script crane::Crane: Hook LuffHead;
        of_the_script palletiser::Palletiser: Grip;
        of_the_script torso::Torso: Eyes LeftGrip RightGrip RightForearm;
    }
}

#[test]
fn jacobians_equal_those_of_pinocchio() {
    check! {
        of_pinocchio puma560::Puma560: LJ6;
        of_pinocchio panda7::Panda7: LPandaJoint7;
        of_pinocchio scara4::Scara4: LJ4;
        of_pinocchio anymal::Anymal: LLfKfe;
    }
}
