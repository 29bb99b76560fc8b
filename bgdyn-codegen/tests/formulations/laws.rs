//! Laws of mechanics, and the equality of the formulations, on random mechanisms: see
//! `common::laws`. The long run:
//!
//! ```sh
//! cargo test --release -p bgdyn-codegen --test formulations laws -- --ignored --nocapture
//! ```

use std::ops::Range;
use std::panic::{self, RefUnwindSafe};

use crate::common::laws::{self, Case};
use crate::common::rng::Rng;

/// The results for a range of seeds.
#[derive(Default)]
struct Seen {
    /// Number of regular mass matrices.
    regular: usize,
    /// The largest difference of the formulations, relative to natural size.
    formulations: f64,
    /// The largest error of forward dynamics, relative to its bar.
    forward: f64,
}

/// Checks all laws on a range of seeds; `most` is the largest number of joints of a seed, `parameters`
/// whether some numbers are run-time parameters.
fn check(seeds: Range<u64>, most: impl Fn(u64) -> usize + RefUnwindSafe, parameters: bool) -> Seen {
    let mut seen = Seen::default();
    let mut failed = Vec::new();
    for seed in seeds {
        // A seed that fails does not hide the seeds after it.
        let result = panic::catch_unwind(|| one(seed, &most, parameters));
        let Ok((formulations, forward)) = result else {
            failed.push(seed);
            continue;
        };
        seen.regular += usize::from(forward.is_some());
        seen.formulations = seen.formulations.max(formulations);
        seen.forward = seen.forward.max(forward.unwrap_or_default());
    }
    println!(
        "{} regular; formulations differ by {:.1e} of natural size at most; forward dynamics at \
         most {:.1e} of its bar",
        seen.regular, seen.formulations, seen.forward
    );
    assert!(failed.is_empty(), "seeds that fail: {failed:?}");
    seen
}

/// All laws on one seed.
fn one(seed: u64, most: impl Fn(u64) -> usize, parameters: bool) -> (f64, Option<f64>) {
    let case = Case::of_seed(seed, most(seed), parameters);
    laws::all(&case, &mut Rng::new(seed ^ 0xfeed))
}

#[test]
fn small_mechanisms() {
    assert!(check(0..40, |_| 3, false).regular > 20);
}

#[test]
fn larger_mechanisms() {
    assert!(check(1000..1015, |_| 7, false).regular > 5);
}

/// Pivots of 1e-28, 1e-26 and 1e-30 between axes that differ by 1e-14, 1e-13 and 1e-15: articulated bodies
/// solve them correctly.
#[test]
fn almost_parallel_axes() {
    for seed in [10_230, 12_205, 12_236] {
        assert_eq!(check(seed..seed + 1, |_| 3, false).regular, 0);
    }
}

#[test]
fn with_run_time_parameters() {
    assert!(check(2000..2016, |_| 3, true).regular > 8);
    assert!(check(3000..3005, |_| 7, true).regular > 1);
}

/// More of each kind than the usual tests have.
#[test]
#[ignore = "a part of .ci/long"]
fn more_of_each_kind() {
    assert!(check(40..150, |_| 3, false).regular > 55);
    assert!(check(1015..1060, |_| 7, false).regular > 15);
    assert!(check(2016..2060, |_| 3, true).regular > 22);
    assert!(check(3005..3016, |_| 7, true).regular > 3);
}

/// A quarter of ten thousand mechanisms. Most are small: the time is proportional to the cube of the
/// number of joints, and small mechanisms are sufficient to find errors. Every other quarter has run-time
/// parameters.
fn quarter(number: u64) {
    let most = |seed: u64| match seed % 20 {
        0 => 7,
        1..=3 => 5,
        _ => 3,
    };
    let first = 10_000 + 2500 * number;
    assert!(check(first..first + 2500, most, number % 2 == 1).regular > 1000);
}

#[test]
#[ignore = "long: 2,500 mechanisms, part of .ci/long"]
fn first_quarter_of_ten_thousand() {
    quarter(0);
}

#[test]
#[ignore = "long: 2,500 mechanisms, part of .ci/long"]
fn second_quarter_of_ten_thousand() {
    quarter(1);
}

#[test]
#[ignore = "long: 2,500 mechanisms, part of .ci/long"]
fn third_quarter_of_ten_thousand() {
    quarter(2);
}

#[test]
#[ignore = "long: 2,500 mechanisms, part of .ci/long"]
fn last_quarter_of_ten_thousand() {
    quarter(3);
}
