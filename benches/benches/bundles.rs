//! Times five methods of a controller one by one, and in a bundle, in turn over the same states: medians of the rounds,
//! in `f64` and in four lanes.

use std::hint::black_box;
use std::time::Duration;

use benches::clock;
use bgdyn::nalgebra::SVector;
use bgdyn::runtime::wide::f64x4;
use bgdyn_codegen::random::Random;
use bgdyn_runtime::Scalar;

/// Number of states, and of rounds.
const STATES: usize = 1024;
const ROUNDS: usize = 9;
/// Duration of the timing of one side in a round.
const SPAN: Duration = Duration::from_millis(20);

mod models {
    include!(concat!(env!("OUT_DIR"), "/bundles.rs"));
}

/// Returns random positions and velocities.
fn states<T: Scalar, const N: usize>() -> Vec<[SVector<T, N>; 2]> {
    let mut random = Random(20_261_128);
    let mut vector = |size: f64| SVector::from_fn(|_, _| T::from_f64(size * random.signed()));
    (0..STATES).map(|_| [vector(3.0), vector(2.0)]).collect()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Prints the times of both sides, and their ratio.
fn compare(what: &str, mut alone: impl FnMut(usize), mut together: impl FnMut(usize)) {
    let rounds: Vec<[f64; 2]> = (0..ROUNDS)
        .map(|_| {
            let alone = clock::median(STATES, SPAN, &mut alone);
            [alone, clock::median(STATES, SPAN, &mut together)]
        })
        .collect();
    let of = |f: fn(&[f64; 2]) -> f64| median(rounds.iter().map(f).collect());
    let (alone, together) = (of(|round| round[0]), of(|round| round[1]));
    let ratio = of(|round| round[1] / round[0]);
    println!("| {what} | {alone:.0} | {together:.0} | {ratio:.2} |");
}

macro_rules! arm {
    ($name:literal, $module:ident, $model:ident, $n:literal, $pose:ident, $jacobian:ident, $rate:ident) => {
        arm!($name, $module, $model, $n, $pose, $jacobian, $rate, f64, "");
        arm!(
            $name,
            $module,
            $model,
            $n,
            $pose,
            $jacobian,
            $rate,
            f64x4,
            ", four states"
        );
    };
    ($name:literal, $module:ident, $model:ident, $n:literal, $pose:ident, $jacobian:ident, $rate:ident, $t:ty, $lanes:literal) => {{
        let model = models::$module::$model::<$t>::default();
        let states = states::<$t, $n>();
        compare(
            concat!($name, $lanes),
            |k| {
                let [q, v] = black_box(&states[k]);
                black_box(model.mass_matrix(q));
                black_box(model.bias(q, v));
                black_box(model.$pose(q));
                black_box(model.$jacobian(q));
                black_box(model.$rate(q, v));
            },
            |k| {
                let [q, v] = black_box(&states[k]);
                black_box(model.control(q, v));
            },
        );
    }};
}

fn main() {
    println!("| arm | five calls, ns | bundle, ns | ratio |");
    println!("|---|---|---|---|");
    arm!(
        "UR5",
        ur5_control,
        Ur5,
        6,
        pose_flange,
        jacobian_world_flange,
        jacobian_dot_v_world_flange
    );
    arm!(
        "Panda",
        panda_control,
        Panda,
        7,
        pose_tool,
        jacobian_world_tool,
        jacobian_dot_v_world_tool
    );
}
