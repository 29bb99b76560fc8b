//! Jacobians against differences of the rates in double-double, at states off the unit sphere too.

use bgdyn::nalgebra::SVector;
use bgdyn::runtime::{Dd, FixedVector, HybridSystem, MatrixOf, Slope, StateVector};

use crate::buoy_run::BuoyRun;
use crate::cart_run::CartRun;
use crate::heavy_top_run::HeavyTopRun;
use crate::loose_ball_hold::LooseBallHold;
use crate::platform_hold::PlatformHold;
use crate::probe_guided::ProbeGuided;
use crate::probe_hold::ProbeHold;

/// The step of the differences: its error is below 1e-15.
const H: f64 = 1e-10;

/// Compares the Jacobian with central differences of the rates at states around the start.
fn check<S: Slope<Dd>>(scene: &S, name: &str)
where
    S::Inputs: FixedVector,
{
    let given = S::Inputs::zero_vector();
    let (start, modes) = scene.start();
    for k in 0..3 {
        let entry = |i: usize| {
            let part = Dd::from_f64((0.37 + 0.61 * i as f64 + 0.23 * f64::from(k)).fract() - 0.5);
            start.entries()[i] + part * Dd::from_f64(0.3)
        };
        let y = S::State::from_entries(entry);
        let t = Dd::from_f64(0.1 + f64::from(k));
        let rates = |y: &S::State, t: Dd| {
            let input = scene.input(y, &modes, &given, t);
            let rates = scene.derivative(y, &modes, &input, t);
            rates.unwrap_or_else(|e| panic!("{name}: {e:?}"))
        };
        let slopes = scene.slope(&y, &modes, &given, t);
        let (along_state, along_time) = slopes.unwrap_or_else(|e| panic!("{name}: {e:?}"));
        let columns = <S::State as StateVector>::columns(&along_state);
        let n = y.entries().len();
        let h = Dd::from_f64(H);
        let difference = |ahead: S::State, behind: S::State, column: &[Dd], of: &str| {
            let pairs = ahead.entries().iter().zip(behind.entries()).zip(column);
            for (i, ((&a, &b), &found)) in pairs.enumerate() {
                let wanted = ((a - b) / (h + h)).to_f64();
                let off = (found.to_f64() - wanted).abs();
                let row = scene.state_names().as_ref()[i];
                assert!(
                    off < 1e-12 * wanted.abs().max(1.0),
                    "{name}, state {k}: the rate of {row} by {of}: {} instead of {wanted}",
                    found.to_f64()
                );
            }
        };
        for (c, column) in columns.chunks(n).enumerate() {
            let moved = |by: Dd| {
                S::State::from_entries(|i| match i == c {
                    true => y.entries()[i] + by,
                    false => y.entries()[i],
                })
            };
            let of = scene.state_names().as_ref()[c];
            difference(rates(&moved(h), t), rates(&moved(-h), t), column, of);
        }
        let along_time = along_time.entries();
        difference(rates(&y, t + h), rates(&y, t - h), along_time, "time");
    }
}

#[test]
fn jacobians_are_the_slopes_of_the_rates() {
    check(&HeavyTopRun::<Dd>::default(), "heavy_top_run");
    check(&BuoyRun::<Dd>::default(), "buoy_run");
    check(&CartRun::<Dd>::default(), "cart_run");
    check(&LooseBallHold::<Dd>::default(), "loose_ball_hold");
    check(&PlatformHold::<Dd>::default(), "platform_hold");
    check(&ProbeGuided::<Dd>::default(), "probe_guided");
    check(&ProbeHold::<Dd>::default(), "probe_hold");
}

/// The rows of the positions are those of ½ q∘ω, with ∂q̇/∂q.
#[test]
fn rows_of_a_quaternion_are_linear_in_it_and_in_the_velocity() {
    let scene = HeavyTopRun::<f64>::default();
    let (q, w) = ([0.1, -0.4, 0.5, 0.76], [3.0, -2.0, 0.7]);
    let y = SVector::from([q[0], q[1], q[2], q[3], w[0], w[1], w[2]]);
    let none = SVector::from([]);
    let slopes = Slope::slope(&scene, &y, &none, &none, 0.0).expect("it has inertia");
    let rows: MatrixOf<<HeavyTopRun as HybridSystem<f64>>::State> = slopes.0;
    let [x, y, z] = w.map(|w| w / 2.0);
    let by_position = [
        [0.0, z, -y, x],
        [-z, 0.0, x, y],
        [y, -x, 0.0, z],
        [-x, -y, -z, 0.0],
    ];
    let [x, y, z, w] = q.map(|q| q / 2.0);
    let by_velocity = [[w, -z, y], [z, w, -x], [-y, x, w], [-x, -y, -z]];
    for i in 0..4 {
        for (j, wanted) in by_position[i].into_iter().chain(by_velocity[i]).enumerate() {
            let found = rows[(i, j)];
            assert!(
                (found - wanted).abs() < 1e-15,
                "({i}, {j}): {found}, {wanted}"
            );
        }
    }
}
