//! Messages about loops and contacts that take no motion, or leave none.

use super::{quote, quoted_list};
use crate::fault::{Fault, Location};

/// A loop whose rows hold at every position.
pub(crate) fn loop_rows_always_hold(location: &Location, name: &str, rows: &[&str]) -> Fault {
    let message = format!(
        "the loop {} constrains nothing: {}",
        quote(name),
        hold(rows, "at every position of the joints")
    );
    Fault::new(location, "closes-nothing", message).with_help(
        "leave it out, or correct its places `a` and `b`: the joints between them hold them together already",
    )
}

/// A wheel, a ball or a knife edge whose rows hold with every velocity.
pub(crate) fn contact_rows_always_hold(location: &Location, name: &str, rows: &[&str]) -> Fault {
    let message = format!(
        "the constraint {} constrains nothing: {}",
        quote(name),
        hold(rows, "with every velocity of the joints")
    );
    Fault::new(location, "contact-moves-nothing", message).with_help(
        "leave it out, or correct its place and its directions: the joints allow no motion across it already",
    )
}

fn hold(rows: &[&str], when: &str) -> String {
    match rows {
        [one] => format!("its row {} holds {when}", quote(one)),
        _ => format!("its rows {} hold {when}", quoted_list(rows.iter().copied())),
    }
}

pub(crate) fn contact_touches_at_single_positions(location: &Location, name: &str) -> Fault {
    let message = format!(
        "the constraint {} touches its plane at single positions only: there no joint moves it towards the plane or away \
         from it, and it leaves the plane where they move",
        quote(name)
    );
    Fault::new(location, "loop-at-single-position", message).with_help(
        "correct the radius, `axis`, `offset` of the plane, or the origins of the joints",
    )
}
