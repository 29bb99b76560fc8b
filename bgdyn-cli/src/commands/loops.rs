//! What `bgdyn check` reports of a mechanism's loops, wheels and knife edges.

use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::mechanism::closure::{Closure, LoopRow};
use serde_json::{Value, json};

/// Returns lines: for each loop its type, rows and branch; then the mobility with the independent joints.
pub(super) fn lines(mechanism: &Mechanism) -> Vec<String> {
    let Some(closure) = mechanism.closure() else {
        return Vec::new();
    };
    let of_loop = |closes: usize| {
        let one = &closure.loops[closes];
        let word = match one.contact {
            Some(_) => "constraint",
            None => "loop",
        };
        let mut line = format!(
            "{word} {}, {}: rows {}",
            one.name,
            one.kind.keyword,
            rows(&closure.rows, closes)
        );
        let dropped = rows(&closure.dropped, closes);
        if !dropped.is_empty() {
            line += &format!("; always closed: {dropped}");
        }
        for (always, word) in [
            (true, "follows everywhere"),
            (false, "follows where closed"),
        ] {
            let following = following(closure, closes, always).join(", ");
            if !following.is_empty() {
                line += &format!("; {word}: {following}");
            }
        }
        if let Some(side) = side(closure, closes) {
            line += &format!("; branch {side}");
        }
        line
    };
    let mut lines: Vec<String> = (0..closure.loops.len()).map(of_loop).collect();
    let [independent, dependent] = joints(mechanism, closure);
    lines.push(format!(
        "mobility {}: {} velocities less {} rows; independent: {}; dependent: {}",
        closure.independents.len(),
        closure.positions.len(),
        closure.rows.len(),
        independent.join(", "),
        dependent.join(", ")
    ));
    let actuated = mechanism.actuated_names().join(", ");
    let line = format!("actuated: {actuated}");
    lines.extend((!actuated.is_empty()).then_some(line));
    lines
}

/// Returns the same as JSON; null without loops.
pub(super) fn model(mechanism: &Mechanism) -> Value {
    let Some(closure) = mechanism.closure() else {
        return Value::Null;
    };
    let of_loop = |closes: usize| {
        let one = &closure.loops[closes];
        json!({
            "name": one.name,
            "type": one.kind.keyword,
            "rows": names(&closure.rows, closes),
            "dropped_rows": names(&closure.dropped, closes),
            "redundant_rows": following(closure, closes, true),
            "paradoxical_rows": following(closure, closes, false),
            "branch": side(closure, closes),
        })
    };
    let [independent, dependent] = joints(mechanism, closure);
    json!({
        "loops": (0..closure.loops.len()).map(of_loop).collect::<Vec<_>>(),
        "independent": independent,
        "dependent": dependent,
        "actuated": mechanism.actuated_names(),
    })
}

/// Returns the names of the independent and of the dependent joints.
fn joints(mechanism: &Mechanism, closure: &Closure) -> [Vec<String>; 2] {
    let of_tree = mechanism.open().joint_names();
    let independent = closure.independents.iter().map(|j| of_tree[j.0].clone());
    let dependent = closure.dependents().map(|j| of_tree[j.0].clone());
    [independent.collect(), dependent.collect()]
}

fn names(of: &[LoopRow], closes: usize) -> Vec<&'static str> {
    of.iter()
        .filter(|row| row.closes == closes)
        .map(|row| row.name)
        .collect()
}

/// Returns the rows of a loop that follow from others, at every position or at closed ones only.
fn following(closure: &Closure, closes: usize, always: bool) -> Vec<&'static str> {
    let all = closure.following.iter();
    let own = all.filter(|one| one.row.closes == closes && one.always == always);
    own.map(|one| one.row.name).collect()
}

fn rows(of: &[LoopRow], closes: usize) -> String {
    names(of, closes).join(", ")
}

/// Returns the side on which the places lie at the start, for planar loops between two moving links.
fn side(closure: &Closure, closes: usize) -> Option<&'static str> {
    let one = &closure.loops[closes];
    if !one.kind.coincident || one.links.contains(&None) {
        return None;
    }
    let side = closure.side(closes, &closure.start)?;
    Some(if side > 0.0 { "left" } else { "right" })
}
