//! Laws of mechanics, and the equality of the two formulations, on random mechanisms: see
//! `common::laws`. The long run:
//!
//! ```sh
//! cargo test --release -p bgdyn-codegen --test laws -- --ignored --nocapture
//! ```

mod common;

use common::laws::{self, Case};
use common::rng::Rng;

/// What a range of seeds has shown.
#[derive(Default)]
struct Seen {
    /// Mass matrices that were regular.
    regular: usize,
    /// The worst difference of the formulations, relative to natural size.
    formulations: f64,
    /// The worst error of forward dynamics, relative to its bar.
    forward: f64,
}

impl Seen {
    fn add(&mut self, more: &Seen) {
        self.regular += more.regular;
        self.formulations = self.formulations.max(more.formulations);
        self.forward = self.forward.max(more.forward);
    }
}

/// All laws on a range of seeds; `most` says how many joints a seed may have, `parameters` whether
/// some numbers are run-time parameters.
fn check(seeds: impl Iterator<Item = u64>, most: impl Fn(u64) -> usize, parameters: bool) -> Seen {
    let mut seen = Seen::default();
    for seed in seeds {
        let case = Case::of_seed(seed, most(seed), parameters);
        let (formulations, forward) = laws::all(&case, &mut Rng::new(seed ^ 0xfeed));
        seen.add(&Seen {
            regular: usize::from(forward.is_some()),
            formulations,
            forward: forward.unwrap_or_default(),
        });
    }
    println!(
        "{} regular; formulations differ by {:.1e} of natural size at most; forward dynamics at \
         most {:.1e} of its bar",
        seen.regular, seen.formulations, seen.forward
    );
    seen
}

#[test]
fn small_mechanisms() {
    assert!(check(0..150, |_| 3, false).regular > 75);
}

#[test]
fn larger_mechanisms() {
    assert!(check(1000..1060, |_| 7, false).regular > 20);
}

#[test]
fn with_run_time_parameters() {
    assert!(check(2000..2060, |_| 3, true).regular > 30);
    assert!(check(3000..3016, |_| 7, true).regular > 4);
}

/// Most are small: the time goes with the cube of the joints, and faults show in small mechanisms.
#[test]
#[ignore = "long: 10,000 mechanisms; run it optimised"]
fn ten_thousand_mechanisms() {
    let most = |seed: u64| match seed % 20 {
        0 => 7,
        1..=3 => 5,
        _ => 3,
    };
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get() as u64);
    let mut seen = Seen::default();
    std::thread::scope(|scope| {
        let seeds = |t: u64| (10_000 + t..20_000).step_by(threads as usize);
        let run = |t: u64| scope.spawn(move || check(seeds(t), most, t % 2 == 1));
        let runs: Vec<_> = (0..threads).map(run).collect();
        for run in runs {
            seen.add(&run.join().expect("a law is broken"));
        }
    });
    assert!(seen.regular > 4_000);
}
