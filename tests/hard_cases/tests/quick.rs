//! Checks that every topic of the quick run is within its bars. `--nocapture` prints the measured numbers
//! and their limits.

use hard_cases::{Extent, TOPICS};

#[test]
fn every_bar_is_met() {
    let mut missed = vec![];
    for topic in TOPICS {
        let start = std::time::Instant::now();
        for outcome in (topic.run)(Extent::Quick).outcomes {
            println!("{outcome}");
            if !outcome.met() {
                missed.push(outcome.to_string());
            }
        }
        println!("{}: {:.1} s", topic.name, start.elapsed().as_secs_f64());
    }
    assert!(missed.is_empty(), "{missed:#?}");
}
