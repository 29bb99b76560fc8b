//! The report.

use crate::JOINTS;
use crate::panda::JOINT_NAMES;
use crate::plant::PART_MASS;
use crate::results::Results;
use crate::timing::PASSES;
use crate::truth_numbers::share_within;

/// Prints the report.
pub fn print(results: &Results) {
    println!("A Panda whose bodies, rotors and friction differ from its spec\n");
    print_log(results);
    print_joints(results);
    print_cycle(results);
    print_load(results);
    if cfg!(debug_assertions) {
        println!("  a debug build: pass --release for times worth reading");
    }
}

/// The first act.
fn print_log(results: &Results) {
    let c = &results.calibration;
    let found = &c.found;
    let [first, _, planned] = c.motion.condition.map(|condition| condition[0]);
    let seen = found.base.iter().filter(|b| b.seen).count();
    println!("1  From a log to numbers");
    println!(
        "   planned motion      condition number {planned:.1}; first random motion {first:.1}; {:.1} s",
        c.planned_in
    );
    println!(
        "   log                 {} rows, and {} of another motion; positions off by up to {:.0} mrad",
        c.logs[0].time.len(),
        c.logs[1].time.len(),
        c.worst_error * 1e3
    );
    println!(
        "   identified          {seen} of {} base parameters in {:.2} s",
        found.base.len(),
        c.identified_in
    );
    let within = |n: f64| 100.0 * share_within(&results.deviations, n);
    println!(
        "   truth within        1 deviation {:.1} %, 2 {:.1} %, 3 {:.1} %",
        within(1.0),
        within(2.0),
        within(3.0)
    );
    let [before, after] = results.efforts.map(|e| 100.0 * e.share);
    println!(
        "   error of efforts    {before:.1} % became {after:.3} % (whole work space, against the truth)\n"
    );
}

/// Errors by joint, of the first act and the second.
fn print_joints(results: &Results) {
    let left = &results.calibration.found.judgement.left;
    println!(
        "           efforts: other motion, rms, N·m   whole work space, %   positions: rms, mrad"
    );
    println!(
        "   joint         size      spec     found      spec     found      spec     found  ratio"
    );
    let factors = results.factors();
    for j in 0..JOINTS {
        let [before, after] = [&left[0][j], &left[2][j]];
        let [spec, found] = results.efforts.map(|e| 100.0 * e.by_joint[j]);
        let [slow, fast] = results.tracking.map(|t| 1e3 * t.rms[j]);
        println!(
            "   {:<9} {:8.3} {:9.3} {:9.4} {spec:9.2} {found:9.4} {slow:9.3} {fast:9.4} {:6.0}",
            JOINT_NAMES[j], before.effort, before.rms, after.rms, factors[j]
        );
    }
}

/// The second act.
fn print_cycle(results: &Results) {
    let legs = results.cycle.legs.iter();
    let legs: Vec<String> = legs
        .map(|leg| format!("{} {:.1}", leg.name, leg.seconds))
        .collect();
    println!("\n2  Pick and place under computed torque, 1 kHz, the same gains with both models");
    println!("   {:.1} s: {}", results.cycle.seconds(), legs.join(", "));
    let [before, after] = &results.tracking;
    println!(
        "   joints, rms         {:.2} mrad became {:.4} mrad: smaller by a factor of {:.0}",
        before.whole() * 1e3,
        after.whole() * 1e3,
        before.whole() / after.whole()
    );
    println!(
        "   joints, largest     {:.1} mrad became {:.3} mrad",
        before.most.amax() * 1e3,
        after.most.amax() * 1e3
    );
    println!(
        "   tool, rms           {:.2} mm became {:.4} mm",
        before.tool * 1e3,
        after.tool * 1e3
    );
}

/// The third act.
fn print_load(results: &Results) {
    let (taken, released) = results.cycle.carried();
    println!(
        "\n3  The same cycle with {PART_MASS} kg from {taken:.1} s to {released:.1} s, which the calibrated model does not have"
    );
    println!(
        "   mass                {:.3} kg in the last second; within 5 % from {:.2} s after it was taken",
        results.mass(),
        results.found_after()
    );
    let [without, with] = results.settled.map(|t| t.tool * 1e3);
    println!(
        "   tool, rms           {without:.2} mm without adaptation, {with:.3} mm with it, from 1 s after it was taken"
    );
    println!(
        "   a step              {:.0} ns, by `payload_adaptive_step_flange`; the shortest of {PASSES} passes",
        results.step_time
    );
}
