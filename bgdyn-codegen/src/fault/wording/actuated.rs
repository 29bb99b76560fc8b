//! Messages about the joints with drives of mechanisms with loops.

use super::{quote, quoted_list, suggestion};
use crate::fault::{Fault, Location};

pub(crate) fn actuated_without_loops(location: &Location) -> Fault {
    let message = "`actuated` lists the joints with drives, and here no velocity follows from others through loops, wheels or knife edges: joints of parallelograms with `branch: parallel` follow as those of gears do";
    Fault::new(location, "actuated-without-loops", message)
        .with_help("leave it out: every joint that follows no other has a drive")
}

pub(crate) fn no_actuated_joint(location: &Location) -> Fault {
    let message = "`actuated` lists no joint";
    Fault::new(location, "actuated-empty", message)
        .with_help("list the joints with drives, or leave the key out: then the independent joints have drives")
}

pub(crate) fn unknown_actuated_joint(location: &Location, name: &str, known: &[&str]) -> Fault {
    let message = format!("no joint has the name {}", quote(name));
    let list = format!(
        "the joints that follow no other by `mimic` or `gear` are {}",
        quoted_list(known.iter().copied())
    );
    Fault::new(location, "unknown-name", message).with_help(suggestion(name, known, list))
}

pub(crate) fn actuated_twice(location: &Location, name: &str) -> Fault {
    let message = format!("{} is listed twice in `actuated`", quote(name));
    Fault::new(location, "actuated-twice", message).with_help(
        "list it once: the drives of one joint add up to one effort, which the joint's entry is",
    )
}

pub(crate) fn actuated_follower(location: &Location, name: &str, leaders: &[&str]) -> Fault {
    let leaders = quoted_list(leaders.iter().copied());
    let message = format!(
        "{} is listed in `actuated`, and it follows {leaders} by `mimic` or a constraint",
        quote(name)
    );
    Fault::new(location, "actuated-follower", message).with_help(format!(
        "list {leaders}: the effort of a drive at the follower is there its effort times the ratio"
    ))
}

pub(crate) fn actuated_without_motion(location: &Location, name: &str, why: &str) -> Fault {
    let message = format!("{} is listed in `actuated`, and it {why}", quote(name));
    Fault::new(location, "actuated-without-motion", message)
        .with_help("take it out of `actuated`: its effort moves nothing")
}

/// `listed`: the joints of the file; `following`: those among them whose velocities follow from the velocities of the
/// others; `counts`: the number of velocities that the listed joints have together, and that of the mechanism.
pub(crate) fn actuated_do_not_determine(
    location: &Location,
    (listed, following): (&[&str], &[&str]),
    (rank, mobility): (usize, usize),
) -> Fault {
    let message = format!(
        "the actuated joints {} determine {rank} of {mobility} velocities at closed positions: {} from the others",
        quoted_list(listed.iter().copied()),
        match following {
            [one] => format!("that of {} follows", quote(one)),
            _ => format!("those of {} follow", quoted_list(following.iter().copied())),
        }
    );
    Fault::new(location, "actuated-do-not-determine", message).with_help(
        "actuate another joint in place of one that follows; or list fewer joints than velocities: then no `inverse_dynamics` is generated, but `reduced_inverse_dynamics`",
    )
}
