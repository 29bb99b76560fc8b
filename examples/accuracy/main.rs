//! What accuracy costs in time, on scenes of the repository.
use bgdyn_accuracy::{Plan, study, targets, verdicts};
fn main() {
    let names: Vec<String> = std::env::args().skip(1).collect();
    for (name, subject) in accuracy_scenes::SUBJECTS {
        if !names.is_empty() && !names.iter().any(|n| n == name) {
            continue;
        }
        let t = std::time::Instant::now();
        match study(&subject(), &Plan::FULL) {
            Ok(found) => {
                println!("{}", found.write());
                for v in verdicts(&found) {
                    println!(
                        "V {} {} {} {} best {:?}",
                        v.method,
                        v.scalar,
                        v.formulation,
                        v.words(),
                        v.best
                    );
                }
                for c in targets(&found) {
                    println!(
                        "T {:e} {} {} {} {:?}",
                        c.target, c.row.method, c.row.pace, c.row.formulation, c.row.ns
                    );
                }
            }
            Err(e) => println!("{name}: {e}"),
        }
        eprintln!("{name} {:?}", t.elapsed());
    }
}
