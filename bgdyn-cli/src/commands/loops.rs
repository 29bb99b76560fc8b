//! What `bgdyn check` reports of a mechanism's loops, wheels and knife edges.

use bgdyn_codegen::mechanism::closure::{Closure, LoopRow};
use bgdyn_codegen::mechanism::{Mechanism, ParallelLoop};
use serde_json::{Value, json};

/// Returns lines: for each loop its type, rows and branch; then the mobility with the independent joints.
pub(super) fn lines(mechanism: &Mechanism) -> Vec<String> {
    let parallel = mechanism.parallel_loops();
    let mut lines: Vec<String> = (parallel.iter())
        .map(|one| parallel_line(mechanism, one))
        .collect();
    let closure = mechanism.closure();
    lines.extend(closure.into_iter().flat_map(closure_lines));
    if !lines.is_empty() {
        lines.push(mobility(mechanism));
    }
    let actuated = mechanism.actuated_names().join(", ");
    let line = format!("actuated: {actuated}");
    lines.extend((!actuated.is_empty()).then_some(line));
    lines
}

/// Returns "loop pin, hinge: closed by joints that follow: rocker_angle; rows 2; branch parallel".
fn parallel_line(mechanism: &Mechanism, one: &ParallelLoop) -> String {
    format!(
        "loop {}, {}: closed by joints that follow: {}; rows {}; branch parallel",
        one.name,
        one.kind.keyword,
        mechanism.followers_of(one).join(", "),
        one.rows
    )
}

fn closure_lines(closure: &Closure) -> Vec<String> {
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
    (0..closure.loops.len()).map(of_loop).collect()
}

/// Returns "mobility 1: 3 velocities less 2 rows; independent: crank; dependent: coupler, rocker".
fn mobility(mechanism: &Mechanism) -> String {
    let rows: usize = mechanism.parallel_loops().iter().map(|l| l.rows).sum();
    let [independent, dependent] = joints(mechanism);
    let own = mechanism.closure().map_or(0, |closure| closure.rows.len());
    format!(
        "mobility {}: {} velocities less {} rows; independent: {}; dependent: {}",
        independent.len(),
        independent.len() + own + rows,
        own + rows,
        independent.join(", "),
        dependent.join(", ")
    )
}

/// Returns the same as JSON; null without loops.
pub(super) fn model(mechanism: &Mechanism) -> Value {
    let closure = mechanism.closure();
    let parallel = mechanism.parallel_loops();
    if closure.is_none() && parallel.is_empty() {
        return Value::Null;
    }
    let of_loop = |closure: &Closure, closes: usize| {
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
    let own = closure.into_iter();
    let own = own.flat_map(|c| (0..c.loops.len()).map(move |k| of_loop(c, k)));
    let followed = parallel.iter().map(|one| {
        json!({
            "name": one.name,
            "type": one.kind.keyword,
            "branch": "parallel",
            "following_joints": mechanism.followers_of(one),
            "number_of_rows": one.rows,
        })
    });
    let [independent, dependent] = joints(mechanism);
    json!({
        "loops": own.chain(followed).collect::<Vec<_>>(),
        "independent": independent,
        "dependent": dependent,
        "actuated": mechanism.actuated_names(),
    })
}

/// Returns the names of the independent and of the dependent joints.
fn joints(mechanism: &Mechanism) -> [Vec<String>; 2] {
    let parallel = mechanism.parallel_loops().iter();
    let mut dependent: Vec<String> = Vec::new();
    for name in parallel.flat_map(|one| mechanism.followers_of(one)) {
        if !dependent.iter().any(|known| known == name) {
            dependent.push(name.to_owned());
        }
    }
    let of_tree = mechanism.open().joint_names();
    let Some(closure) = mechanism.closure() else {
        return [of_tree, dependent];
    };
    let independent = closure.independents.iter().map(|j| of_tree[j.0].clone());
    dependent.extend(closure.dependents().map(|j| of_tree[j.0].clone()));
    [independent.collect(), dependent]
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

/// Returns the side on which the places lie at the start, for planar loops between two moving links; "crossed" for an
/// antiparallelogram, which changes sides.
fn side(closure: &Closure, closes: usize) -> Option<&'static str> {
    let one = &closure.loops[closes];
    if one.crossed {
        return Some("crossed");
    }
    if !one.kind.coincident || one.links.contains(&None) {
        return None;
    }
    let side = closure.side(closes, &closure.start)?;
    Some(if side > 0.0 { "left" } else { "right" })
}
