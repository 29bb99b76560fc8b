//! Random drops: no run fails, none gains energy, all come to rest with a small overlap; in double and single precision.

use bgdyn::runtime::random::Random;
use bgdyn::runtime::{HybridSystem, Slope};
use bgdyn_sim::{Moreau, Real, Run, ScenePlant, StateVector};

use crate::falls::Falls;
use crate::quadruped_rigid::QuadrupedRigid;
use crate::tumbles::Tumbles;

/// One degree, rad.
const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// What a drop ended with.
#[derive(Clone, Copy, Debug, Default)]
struct Drop {
    /// The largest velocity at the end, rad/s or m/s.
    speed: f64,
    /// The deepest overlap of resting contacts, m, and of all of them.
    depth: f64,
    deepest: f64,
    /// Energy that was in no account, by its size, of that which was there, and the largest rise of the whole energy.
    drift: f64,
    gain: f64,
    /// Steps whose impulses do not meet the tolerance, and their largest residual, N·s.
    unsolved: usize,
    residual: f64,
}

/// How a scene is dropped: the base is floating, its pose comes first in the state.
struct Fall {
    /// Positions of joints after the base are those of the scene and a random part: its largest size, rad.
    bend: f64,
    /// Stiffness and target of the control of these positions, one after the other, N·m/rad and rad: it stores energy.
    springs: &'static [(f64, f64)],
    /// Height of the base, m.
    height: f64,
    /// Time of a run, s, and the step.
    time: f64,
    step: f64,
}

/// Drops a scene with random pose and velocities. `None` if the run fails.
fn dropped<T: Real, S: HybridSystem<T> + Slope<T>>(
    scene: &S,
    fall: &Fall,
    seed: u64,
) -> Option<Drop> {
    let mut random = Random(seed);
    let mut start = Run::<ScenePlant<'_, S, T>>::begin(scene);
    let nq = scene.positions();
    let y = start.y.entries_mut();
    let mut unit: [f64; 4] = core::array::from_fn(|_| random.signed());
    let length = unit.iter().map(|x| x * x).sum::<f64>().sqrt();
    unit = unit.map(|x| x / length);
    y[2] = T::from_f64(fall.height);
    for (q, x) in y[3..7].iter_mut().zip(unit) {
        *q = T::from_f64(x);
    }
    for q in &mut y[7..nq] {
        *q = *q + T::from_f64(fall.bend * random.signed());
    }
    for v in &mut y[nq..nq + 6] {
        *v = T::from_f64(3.0 * random.signed());
    }
    let plant = ScenePlant::with_slope(scene);
    let mut run = Run::by(Moreau::new(), plant, start);
    let mut drop = Drop::default();
    let energy = |run: &Run<ScenePlant<'_, S, T>, Moreau<T>>| {
        let none = bgdyn::runtime::FixedVector::zero_vector();
        let all = scene.energy(run.y(), run.modes(), &none, run.t());
        let springs = run.y().entries()[7.min(nq)..nq]
            .iter()
            .zip(fall.springs.iter().cycle());
        let stored =
            springs.map(|(q, (stiffness, target))| 0.5 * stiffness * (q.to_f64() - target).powi(2));
        all.as_ref().iter().map(|x| x.to_f64()).sum::<f64>() + stored.sum::<f64>()
    };
    let begun = energy(&run);
    let mut least = begun;
    let steps = (fall.time / fall.step).round() as usize;
    for k in 0..steps {
        if run.step(T::from_f64(fall.step)).is_err() {
            return None;
        }
        let now = energy(&run);
        drop.gain = drop.gain.max(now - least);
        least = least.min(now);
        let contacts = run.contact_step()?;
        drop.deepest = drop.deepest.max(contacts.depth.to_f64());
        if k + 500 > steps {
            drop.depth = drop.depth.max(contacts.depth.to_f64());
        }
        if !contacts.solved {
            drop.unsolved += 1;
            drop.residual = drop.residual.max(contacts.residual.to_f64());
        }
    }
    let y = run.y().entries();
    drop.speed = y[nq..].iter().map(|v| v.abs().to_f64()).fold(0.0, f64::max);
    drop.drift = run.audit().drift().to_f64().abs();
    Some(drop)
}

/// Drops a scene many times on two threads, and prints the largest of each number.
fn drops<T: Real + Send, S: HybridSystem<T> + Slope<T> + Sync>(
    name: &str,
    (scene, fall): (&S, &Fall),
    number: u64,
) -> Drop {
    let some = |odd: u64| {
        let seeds = (0..number).filter(move |seed| seed % 2 == odd);
        seeds
            .map(|seed| (seed, dropped(scene, fall, seed)))
            .collect::<Vec<_>>()
    };
    let all = std::thread::scope(|scope| {
        let [a, b] = [0, 1].map(|odd| scope.spawn(move || some(odd)));
        [a, b]
            .map(|thread| thread.join().expect("no drop panics"))
            .concat()
    });
    let mut worst = Drop::default();
    for (seed, drop) in all {
        let Some(drop) = drop else {
            panic!("{name}: seed {seed} fails")
        };
        let max = |a: &mut f64, b: f64| *a = a.max(b);
        max(&mut worst.speed, drop.speed);
        max(&mut worst.depth, drop.depth);
        max(&mut worst.deepest, drop.deepest);
        max(&mut worst.drift, drop.drift);
        max(&mut worst.gain, drop.gain);
        max(&mut worst.residual, drop.residual);
        worst.unsolved += drop.unsolved;
    }
    println!("{name}, {number} drops: {worst:?}");
    worst
}

const CRATE: Fall = Fall {
    bend: 0.0,
    springs: &[],
    height: 0.6,
    time: 6.0,
    step: 1e-3,
};
const CHAIN: Fall = Fall {
    bend: 1.0,
    springs: &[],
    height: 1.6,
    time: 6.0,
    step: 1e-3,
};
/// Standing legs under PD control: it falls on its feet, on its back or on a side.
const QUADRUPED: Fall = Fall {
    bend: 0.3,
    springs: &[(60.0, 0.0), (60.0, 45.84 * DEGREE), (80.0, -94.71 * DEGREE)],
    height: 0.8,
    time: 6.0,
    step: 1e-3,
};

/// Drops of crates, and of what has more joints; fewer in code that is not optimised.
const SOME: u64 = if cfg!(debug_assertions) { 4 } else { 12 };
const FEW: u64 = if cfg!(debug_assertions) { 1 } else { 4 };

/// Returns the number of drops in the long tests, which `DROPS` may lower.
fn many() -> u64 {
    let fewer = std::env::var("DROPS").ok();
    fewer.map_or(10_000, |n| n.parse().expect("a number of drops"))
}

/// Asserts bars for all drops: rest, overlap, gains.
fn assert_rests(drop: Drop, speed: f64, depth: f64, gain: f64) {
    assert!(
        drop.speed < speed && drop.depth < depth && drop.gain < gain,
        "{drop:?}"
    );
}

#[test]
fn crates_chains_and_quadrupeds_fall_and_rest() {
    let crates = Tumbles::<f64>::default();
    assert_rests(drops("crate", (&crates, &CRATE), SOME), 1e-9, 1e-9, 0.05);
    let chain = Falls::<f64>::default();
    assert_rests(drops("chain", (&chain, &CHAIN), FEW), 1e-9, 1e-9, 0.05);
    let quadruped = QuadrupedRigid::<f64>::default();
    let worst = drops("quadruped", (&quadruped, &QUADRUPED), FEW);
    assert_rests(worst, 1e-9, 1e-9, 1e-3);
}

#[test]
#[ignore = "five minutes: .ci/long contact"]
fn ten_thousand_crates() {
    let crates = Tumbles::<f64>::default();
    assert_rests(drops("crate", (&crates, &CRATE), many()), 1e-9, 1e-9, 0.05);
    let crates = Tumbles::<f32>::default();
    let worst = drops("crate, f32", (&crates, &CRATE), many());
    assert_rests(worst, 1e-3, 1e-4, 0.05);
}

#[test]
#[ignore = "half an hour: .ci/long contact"]
fn ten_thousand_chains() {
    let chain = Falls::<f64>::default();
    assert_rests(drops("chain", (&chain, &CHAIN), many()), 1e-2, 1e-6, 0.05);
    let chain = Falls::<f32>::default();
    let worst = drops("chain, f32", (&chain, &CHAIN), many());
    assert_rests(worst, 1e-2, 1e-4, 0.05);
}

#[test]
#[ignore = "half an hour: .ci/long contact"]
fn ten_thousand_quadrupeds() {
    let quadruped = QuadrupedRigid::<f64>::default();
    let worst = drops("quadruped", (&quadruped, &QUADRUPED), many());
    assert_rests(worst, 1e-2, 1e-6, 0.05);
    let quadruped = QuadrupedRigid::<f32>::default();
    let worst = drops("quadruped, f32", (&quadruped, &QUADRUPED), many());
    assert_rests(worst, 1e-2, 1e-4, 0.05);
}
