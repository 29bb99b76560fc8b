//! Checks that every topic of the quick run is within its bars, except for the rows that are known to miss
//! theirs. `--nocapture` prints the measured numbers and their limits.

use hard_cases::{Extent, MISSED, TOPICS};

#[test]
fn every_bar_is_met_but_those_known_to_be_missed() {
    let (mut missed, mut known) = (vec![], 0);
    for topic in TOPICS {
        let start = std::time::Instant::now();
        for outcome in (topic.run)(Extent::Quick).outcomes {
            println!("{outcome}");
            if MISSED.contains(&(&*outcome.case, &*outcome.quantity)) {
                assert!(!outcome.met(), "no longer missed: {outcome}");
                known += 1;
            } else if !outcome.met() {
                missed.push(outcome.to_string());
            }
        }
        println!("{}: {:.1} s", topic.name, start.elapsed().as_secs_f64());
    }
    assert!(missed.is_empty(), "{missed:#?}");
    assert_eq!(known, MISSED.len(), "rows of MISSED that exist");
}
