//! Tests which of several blocks at rest hold: `resolve_stiction` against every combination of modes.

use bgdyn_runtime::nalgebra::{SMatrix, SVector};
use bgdyn_runtime::{Balance, Contact, HybridSystem, resolve_stiction};

use crate::random::Random;

/// Blocks coupled by a mass matrix under given forces, each with dry friction: M a = f − m ⊙ F_k where
/// it slips, a = 0 where it is held.
struct Blocks<const K: usize> {
    mass: SMatrix<f64, K, K>,
    force: SVector<f64, K>,
    kinetic: SVector<f64, K>,
    limit: SVector<f64, K>,
    slip: SVector<f64, K>,
}

impl<const K: usize> Blocks<K> {
    fn accelerations(&self, modes: &SVector<f64, K>) -> SVector<f64, K> {
        let mut mass = self.mass;
        let mut force = self.force - modes.component_mul(&self.kinetic);
        for j in (0..K).filter(|&j| modes[j] == 0.0) {
            mass.row_mut(j).fill(0.0);
            mass.column_mut(j).fill(0.0);
            mass[(j, j)] = 1.0;
            force[j] = 0.0;
        }
        // Gaussian elimination without pivoting: the matrix is positive definite.
        for i in 0..K {
            for k in i + 1..K {
                let factor = mass[(k, i)] / mass[(i, i)];
                for j in i..K {
                    mass[(k, j)] -= factor * mass[(i, j)];
                }
                force[k] -= factor * force[i];
            }
        }
        for i in (0..K).rev() {
            for j in i + 1..K {
                force[i] -= mass[(i, j)] * force[j];
            }
            force[i] /= mass[(i, i)];
        }
        force
    }
}

impl<const K: usize> HybridSystem<f64> for Blocks<K> {
    type State = SVector<f64, 0>;
    type Modes = SVector<f64, K>;
    type Inputs = SVector<f64, 0>;
    type Events = SVector<f64, 0>;
    type Outputs = SVector<f64, 0>;
    type Entries = SVector<f64, 0>;
    type Singular = ();

    fn state_names(&self) -> &'static [&'static str; 0] {
        &[]
    }
    fn positions(&self) -> usize {
        0
    }
    fn mode_names(&self) -> &'static [&'static str; K] {
        &["block"; K]
    }
    fn input_names(&self) -> &'static [&'static str; 0] {
        &[]
    }
    fn event_names(&self) -> &'static [&'static str; 0] {
        &[]
    }
    fn event_modes(&self) -> &'static [Option<usize>; 0] {
        &[]
    }
    fn mode_velocities(&self) -> &'static [usize; K] {
        &[0; K]
    }
    fn output_names(&self) -> &'static [&'static str; 0] {
        &[]
    }
    fn entry_names(&self) -> &'static [&'static str; 0] {
        &[]
    }
    fn start(&self) -> (SVector<f64, 0>, SVector<f64, K>) {
        (SVector::zeros(), SVector::zeros())
    }
    fn derivative(
        &self,
        y: &SVector<f64, 0>,
        _: &SVector<f64, K>,
        _: &SVector<f64, 0>,
        _: f64,
    ) -> Result<SVector<f64, 0>, ()> {
        Ok(*y)
    }
    fn input(
        &self,
        _: &SVector<f64, 0>,
        _: &SVector<f64, K>,
        given: &SVector<f64, 0>,
        _: f64,
    ) -> SVector<f64, 0> {
        *given
    }
    fn events(
        &self,
        y: &SVector<f64, 0>,
        _: &SVector<f64, K>,
        _: &SVector<f64, 0>,
        _: f64,
    ) -> Result<SVector<f64, 0>, ()> {
        Ok(*y)
    }
    fn contacts(
        &self,
        _: &SVector<f64, 0>,
        modes: &SVector<f64, K>,
        _: &SVector<f64, 0>,
        _: f64,
    ) -> Result<[Contact<f64>; K], ()> {
        let rates = self.accelerations(modes);
        let left = self.mass * rates - self.force + modes.component_mul(&self.kinetic);
        Ok(std::array::from_fn(|k| Contact {
            slip: self.slip[k],
            slip_rate: rates[k],
            holding: left[k],
            margin: self.limit[k] - left[k].abs(),
        }))
    }
    fn output(
        &self,
        y: &SVector<f64, 0>,
        _: &SVector<f64, K>,
        _: &SVector<f64, 0>,
        _: f64,
    ) -> SVector<f64, 0> {
        *y
    }
    fn energy(
        &self,
        _: &SVector<f64, 0>,
        _: &SVector<f64, K>,
        _: &SVector<f64, 0>,
        _: f64,
    ) -> [f64; 0] {
        []
    }
    fn power(
        &self,
        _: &SVector<f64, 0>,
        _: &SVector<f64, K>,
        _: &SVector<f64, 0>,
        _: f64,
    ) -> Result<[Balance<f64>; 0], ()> {
        Ok([])
    }
}

impl<const K: usize> Blocks<K> {
    fn resolved(&self, modes: &SVector<f64, K>, rest: f64) -> SVector<f64, K> {
        let none = SVector::zeros();
        resolve_stiction(self, &none, modes, &none, 0.0, rest).expect("not singular")
    }

    /// Returns every combination in which held blocks are within their limits and slipping ones do not
    /// reverse.
    fn consistent(&self) -> Vec<SVector<f64, K>> {
        let none = SVector::zeros();
        let all = (0..3_usize.pow(K as u32))
            .map(|i| SVector::from_fn(|k, _| (i / 3_usize.pow(k as u32) % 3) as f64 - 1.0));
        all.filter(|modes| {
            let contacts = self
                .contacts(&none, modes, &none, 0.0)
                .expect("not singular");
            contacts
                .iter()
                .zip(modes.iter())
                .all(|(c, mode)| match *mode {
                    0.0 => c.margin >= 0.0,
                    mode => c.slip_rate * mode >= 0.0,
                })
        })
        .collect()
    }
}

/// Returns blocks with a random positive definite mass matrix; `more` is the excess of static
/// friction.
fn random_blocks<const K: usize>(random: &mut Random, more: f64) -> Blocks<K> {
    let root = SMatrix::<f64, K, K>::from_fn(|_, _| random.signed());
    let kinetic = SVector::from_fn(|_, _| random.signed().abs());
    Blocks {
        mass: root * root.transpose() + SMatrix::identity() * 0.02,
        force: SVector::from_fn(|_, _| 2.0 * random.signed()),
        limit: kinetic * (1.0 + more),
        kinetic,
        slip: SVector::zeros(),
    }
}

/// If static and sliding friction are equal, the solution is unique, and it is found.
fn the_only_one<const K: usize>(tries: usize) {
    let mut random = Random(K as u64);
    let mut slipping = 0;
    for _ in 0..tries {
        let blocks = random_blocks::<K>(&mut random, 0.0);
        let found = blocks.resolved(&SVector::zeros(), 0.0);
        assert_eq!(blocks.consistent(), [found]);
        slipping += found.iter().filter(|m| **m != 0.0).count();
    }
    assert!(slipping > tries / 4 && slipping < K * tries);
}

#[test]
fn friction_of_one_size_settles_in_the_only_way() {
    the_only_one::<1>(2000);
    the_only_one::<2>(4000);
    the_only_one::<3>(4000);
    the_only_one::<5>(400);
}

/// With larger static friction the result is a consistent one; all hold if all can.
#[test]
fn more_friction_at_rest_settles_consistently() {
    let mut random = Random(9);
    let (mut several, mut held) = (0, 0);
    for _ in 0..4000 {
        let blocks = random_blocks::<3>(&mut random, 0.5);
        let found = blocks.resolved(&SVector::zeros(), 0.0);
        let all = blocks.consistent();
        assert!(all.contains(&found), "{found:?} is none of {all:?}");
        if all.contains(&SVector::<f64, 3>::zeros()) {
            assert_eq!(found, SVector::<f64, 3>::zeros());
            held += 1;
        }
        several += usize::from(all.len() > 1);
    }
    assert!(several > 100 && held > 100, "{several} {held}");
}

/// Two stacked blocks: a pull on the upper one moves the lower one along, or not.
#[test]
fn two_blocks_are_decided_together() {
    // Coordinates: the lower block on the floor, the upper one against the lower.
    let blocks = |pull: f64, floor: f64, between: f64| Blocks {
        mass: SMatrix::from([[3.0, 1.0], [1.0, 1.0]]),
        force: SVector::from([pull, pull]),
        kinetic: SVector::from([floor, between]),
        limit: SVector::from([floor, between]),
        slip: SVector::zeros(),
    };
    let resolved =
        |pull, floor, between| blocks(pull, floor, between).resolved(&SVector::zeros(), 0.0);
    assert_eq!(resolved(1.9, 4.0, 2.0), SVector::from([0.0, 0.0]));
    assert_eq!(
        resolved(2.1, 4.0, 2.0),
        SVector::from([0.0, 1.0]),
        "only the upper one slips"
    );
    assert_eq!(
        resolved(4.0, 3.0, 5.0),
        SVector::from([1.0, 0.0]),
        "both go together"
    );
    assert_eq!(resolved(20.0, 3.0, 5.0), SVector::from([1.0, 1.0]));
    assert_eq!(resolved(-20.0, 3.0, 5.0), SVector::from([-1.0, -1.0]));
}

/// A moving block retains its mode; one slower than `rest` is at rest; a load equal to the limit holds.
#[test]
fn only_blocks_at_rest_are_decided() {
    let mut blocks = Blocks {
        mass: SMatrix::<f64, 2, 2>::identity(),
        force: SVector::from([0.5, -3.0]),
        kinetic: SVector::from([1.0, 3.0]),
        limit: SVector::from([1.0, 3.0]),
        slip: SVector::from([1e-3, 0.0]),
    };
    let modes = SVector::from([1.0, 1.0]);
    assert_eq!(blocks.resolved(&modes, 1e-6), SVector::from([1.0, 0.0]));
    assert_eq!(blocks.resolved(&modes, 1e-2), SVector::from([0.0, 0.0]));
    blocks.force[1] = -3.0000001;
    assert_eq!(blocks.resolved(&modes, 1e-6), SVector::from([1.0, -1.0]));
}

/// NaN does not prevent termination.
#[test]
fn nonsense_terminates() {
    let mut blocks = random_blocks::<3>(&mut Random(3), 0.0);
    blocks.force[1] = f64::NAN;
    blocks.resolved(&SVector::zeros(), 0.0);
}
