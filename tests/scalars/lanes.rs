//! Checks that models in lanes equal the scalar model lane by lane, bit for bit, including failures.

use bgdyn::nalgebra::SVector;
use bgdyn::runtime::wide::{f32x4, f32x8, f32x16, f64x2, f64x4, f64x8};
use bgdyn::runtime::{Argument, Cause, LaneSingular};
use bgdyn::{Dynamics, Scalar, Singular};
use bgdyn_codegen::random::Random;

use crate::models::massless_tip::MasslessTip;
use crate::models::puma560::Puma560;
use crate::models::scara4::Scara4;
use crate::models::spherical_pendulum::{self, SphericalPendulum};
use crate::models::{State, results};

/// The scalar of one lane.
trait Word: Scalar<Singular<2> = Singular> {
    fn word(self) -> u64;
}

impl Word for f64 {
    fn word(self) -> u64 {
        self.to_bits()
    }
}

impl Word for f32 {
    fn word(self) -> u64 {
        self.to_bits().into()
    }
}

/// Lanes, and the numbers in them.
trait Lanes<S: Word, const L: usize>: Scalar {
    fn pack(lanes: [S; L]) -> Self;
    fn unpack(self) -> [S; L];
    fn error<const N: usize>(error: Self::Singular<N>) -> LaneSingular<Self, L, N>;
}

macro_rules! packs {
    ($($lanes:ident: $float:ident, $n:literal;)*) => {$(
        impl Lanes<$float, $n> for $lanes {
            fn pack(lanes: [$float; $n]) -> Self {
                Self::new(lanes)
            }
            fn unpack(self) -> [$float; $n] {
                self.to_array()
            }
            fn error<const N: usize>(error: LaneSingular<Self, $n, N>) -> LaneSingular<Self, $n, N> {
                error
            }
        }
    )*};
}

packs! {
    f64x2: f64, 2;
    f64x4: f64, 4;
    f64x8: f64, 8;
    f32x4: f32, 4;
    f32x8: f32, 8;
    f32x16: f32, 16;
}

fn packed<S: Word, T: Lanes<S, L>, const L: usize, const N: usize>(
    states: &[State<S, N>; L],
) -> State<T, N> {
    std::array::from_fn(|part| {
        SVector::from_fn(|j, _| T::pack(std::array::from_fn(|k| states[k][part][j])))
    })
}

fn random_states<S: Word, const L: usize, const N: usize>(random: &mut Random) -> [State<S, N>; L] {
    std::array::from_fn(|_| {
        // Sometimes angles that need exact reduction.
        let size = if random.signed() > 0.9 { 1e9 } else { 3.0 };
        [size, 2.0, 5.0].map(|size| SVector::from_fn(|_, _| S::from_f64(size * random.signed())))
    })
}

/// Fails if lanes and scalars differ in one bit.
fn equal<S, T, MS, MT, const L: usize, const N: usize>(
    scalar: &MS,
    lanes: &MT,
    states: &[State<S, N>; L],
) where
    S: Word<Singular<N> = Singular>,
    T: Lanes<S, L>,
    MS: Dynamics<S, N, N>,
    MT: Dynamics<T, N, N>,
{
    let state = packed::<S, T, L, N>(states);
    let found = results(lanes, &state);
    for (k, alone) in states.iter().enumerate() {
        for ((name, found), (_, wanted)) in found.iter().zip(results(scalar, alone)) {
            assert_eq!(found.len(), wanted.len());
            for (x, y) in found.iter().zip(wanted) {
                let x = x.unpack()[k];
                assert_eq!(x.word(), y.word(), "{name}, lane {k}: {x:?} and {y:?}");
            }
        }
    }
    let [q, v, tau] = &state;
    let (accelerations, failed) = match lanes.forward_dynamics(q, v, tau) {
        Ok(accelerations) => (accelerations, [None; L]),
        Err(error) => {
            let error = T::error(error);
            let failed: [_; L] = std::array::from_fn(|k| error.lane(k));
            assert!(failed.iter().any(Option::is_some), "an error of no lane");
            (error.accelerations, failed)
        }
    };
    for (k, [q, v, tau]) in states.iter().enumerate() {
        let found = accelerations.map(|a| a.unpack()[k]);
        let wanted = match scalar.forward_dynamics(q, v, tau) {
            Ok(wanted) => {
                assert_eq!(failed[k], None, "lane {k}");
                wanted
            }
            Err(error) => {
                assert_eq!(failed[k], Some(error), "lane {k}");
                SVector::from_element(S::from_f64(0.0))
            }
        };
        let words = |x: SVector<S, N>| x.map(S::word);
        assert_eq!(words(found), words(wanted), "forward_dynamics, lane {k}");
    }
}

macro_rules! for_all_lanes {
    ($check:ident) => {
        $check!(f64x2, f64, 2);
        $check!(f64x4, f64, 4);
        $check!(f64x8, f64, 8);
        $check!(f32x4, f32, 4);
        $check!(f32x8, f32, 8);
        $check!(f32x16, f32, 16);
    };
}

#[test]
fn lanes_equal_scalars_bit_for_bit() {
    macro_rules! check {
        ($lanes:ident, $float:ident, $n:literal) => {{
            let mut random = Random(23);
            for _ in 0..100 {
                equal::<$float, $lanes, _, _, $n, 6>(
                    &Puma560::<$float>::default(),
                    &Puma560::<$lanes>::default(),
                    &random_states(&mut random),
                );
                equal::<$float, $lanes, _, _, $n, 4>(
                    &Scara4::<$float>::default(),
                    &Scara4::<$lanes>::default(),
                    &random_states(&mut random),
                );
            }
        }};
    }
    for_all_lanes!(check);
}

#[test]
fn a_singular_lane_leaves_the_others_alone() {
    macro_rules! check {
        ($lanes:ident, $float:ident, $n:literal) => {{
            let mut random = Random(29);
            let model = SphericalPendulum::<$lanes>::default();
            for singular in 0..$n {
                let mut states: [State<$float, 2>; $n] = random_states(&mut random);
                states[singular][0][1] = 0.0;
                equal::<$float, $lanes, _, _, $n, 2>(
                    &SphericalPendulum::<$float>::default(),
                    &model,
                    &states,
                );
                let [q, v, tau] = packed::<$float, $lanes, $n, 2>(&states);
                let error = model.forward_dynamics(&q, &v, &tau).unwrap_err();
                let failed: Vec<_> = error.failed().collect();
                let azimuth = Singular::new(0, &spherical_pendulum::JOINT_NAMES);
                assert_eq!(failed, [(singular, azimuth)]);
            }
        }};
    }
    for_all_lanes!(check);
}

#[test]
fn a_lane_without_a_number_leaves_the_others_alone() {
    let mut random = Random(31);
    let mut states: [State<f64, 6>; 4] = random_states(&mut random);
    states[1][0][2] = f64::NAN;
    let [q, v, tau] = packed::<f64, f64x4, 4, 6>(&states);
    let result = Puma560::<f64x4>::default().forward_dynamics(&q, &v, &tau);
    let error = result.unwrap_err();
    let lanes: Vec<usize> = error.failed().map(|(lane, _)| lane).collect();
    assert_eq!(lanes, [1]);
    let j3 = Cause::Argument {
        argument: Argument::Q,
        index: 2,
    };
    let named = error.lane(1).map(|e| (e.cause(), e.name()));
    assert_eq!(named, Some((j3, "j3")));
    for (k, [q, v, tau]) in states.iter().enumerate() {
        let found = error.accelerations.map(|a| a.to_array()[k]);
        match Puma560::<f64>::default().forward_dynamics(q, v, tau) {
            Ok(wanted) => assert_eq!(found, wanted),
            Err(alone) => {
                assert_eq!(alone.cause(), j3);
                assert_eq!(Some(alone), error.lane(k));
            }
        }
    }
}

#[test]
fn a_massless_end_is_refused_in_every_lane() {
    let mut random = Random(37);
    let states: [State<f64, 2>; 4] = random_states(&mut random);
    equal::<f64, f64x4, _, _, 4, 2>(
        &MasslessTip::<f64>::default(),
        &MasslessTip::<f64x4>::default(),
        &states,
    );
    let [q, v, tau] = packed::<f64, f64x4, 4, 2>(&states);
    let result = MasslessTip::<f64x4>::default().forward_dynamics(&q, &v, &tau);
    let error = result.unwrap_err();
    assert_eq!(error.errors.map(|e| e.map(|e| e.joint())), [Some(1); 4]);
    assert!(error.failed().all(|(_, e)| e.name() == "wrist"));
}
