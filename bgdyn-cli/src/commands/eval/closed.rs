//! Positions of mechanisms and scenes with loops: closed if they are open by rounding.

use bgdyn_codegen::mechanism::closure::{Closure, polygons};
use bgdyn_runtime::{Cause, Dd};

use super::states::{Failure, plain};

/// Largest opening of a loop that is closed, m or rad.
const OPEN: f64 = 1e-6;

/// Returns the failure at a singular position of a loop, or beyond one.
pub(super) fn singular_loop(closure: Option<&Closure>, closes: usize, cause: Cause) -> Failure {
    let one = closure.and_then(|closure| closure.loops.get(closes));
    let name = one.map_or("", |one| &one.name);
    plain(match cause {
        Cause::OutOfReach => {
            format!("the loop `{name}` is out of reach, or at the end of its reach")
        }
        _ => format!(
            "the loop `{name}` is at a singular position, or on another branch than that of the start"
        ),
    })
}

/// Returns the failure where the actuated joints do not determine this independent joint.
pub(super) fn not_actuated(name: &str) -> Failure {
    Failure {
        joint: Some(name.to_owned()),
        message: format!(
            "no efforts of the actuated joints: `{name}` does not follow the actuated joints here"
        ),
    }
}

/// Returns positions with the dependent ones changed so that the loops close. Loops that are open by more than
/// [`OPEN`] are refused, and other branches of loops that have a closed form.
pub(super) fn closed(closure: &Closure, q: &[f64]) -> Result<Vec<f64>, Failure> {
    let mut exact: Vec<Dd> = q.iter().map(|&x| Dd::from_f64(x)).collect();
    let (residuals, _) = closure.values(&closure.rows, &exact);
    let sizes = residuals.iter().map(|x| x.to_f64().abs());
    let worst = sizes.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
    if let Some((row, size)) = worst.filter(|(_, size)| *size > OPEN) {
        let row = &closure.rows[row];
        return Err(plain(format!(
            "the loop `{}` is open by {size} {} (row `{}`) at these positions, and at most {OPEN} is closed",
            closure.loops[row.closes].name,
            row.kind.unit(),
            row.name
        )));
    }
    closure.close(&mut exact);
    // Functions in closed form would compute the branch of the start in silence.
    let signs = closure.signs_at(&exact);
    let mut pairs = signs.iter().zip(&closure.signs);
    if let (Some(block), true) = (pairs.position(|(x, y)| x != y), polygons(closure).is_some()) {
        let row = closure.blocks[block].rows.first();
        let closes = row.map_or(0, |&r| closure.rows[r].closes);
        return Err(singular_loop(Some(closure), closes, Cause::Branch));
    }
    Ok(exact.into_iter().map(Dd::to_f64).collect())
}
