//! Impulses of rigid contacts with Coulomb friction, all at once: `no_std`, no heap, in any [`Real`] scalar.
//!
//! A [`ContactProblem`] has the relative velocities γ = G p + b of up to `K` contacts. [`solve`] finds the impulses p with
//! which each contact separates, sticks or slides. The cones are exact, not pyramids; where a contact sticks, its velocity
//! is zero to the tolerance. Friction is that of Coulomb, not the associated law: sliding does not lift.
//!
//! - **Sweeps** solve one contact at a time for the impulses of the others (nonlinear Gauss–Seidel; Jean 1999). The
//!   problem of one contact is solved exactly, sliding by a scalar equation in a bracket.
//! - **Newton steps** solve all contacts that press at once, linearised as sticking or sliding (semismooth Newton method;
//!   Alart and Curnier 1991). Two sweeps after each step find which contacts stick, slide and separate. A small shift of
//!   the diagonal, of the proximal point method, makes redundant contacts harmless. The residual may rise for some steps;
//!   then the search goes on from where it was smallest, with sweeps.
//!
//! The impulses of redundant contacts, such as the four corners of a box, are not unique: they depend on the start.
//!
//! There is a solution if some motion of the bodies makes every contact separate more steeply than its cone K*, as a lift
//! from a plane does (Acary, Cadoux, Lemaréchal and Malick 2011). Otherwise, with large friction and strongly coupled
//! contacts, there may be none, or several. No method is sure to find one; [`ContactOutcome`] says whether this one did.
//!
//! ```
//! use bgdyn_sim::cone::{ContactProblem, ContactOptions, solve};
//!
//! // A ball of 2 kg and moment of inertia 0.4 m r² comes down on a table at 1 m/s, and along it at 3 m/s.
//! let (mass, friction) = (2.0, 0.2);
//! let [tangential, normal] = [3.5 / mass, 1.0 / mass];
//! let block = [[tangential, 0.0, 0.0], [0.0, tangential, 0.0], [0.0, 0.0, normal]];
//! let problem = ContactProblem {
//!     delassus: &[[block]],
//!     velocities: &[[3.0, 0.0, -1.0]],
//!     friction: &[friction],
//!     active: &[true],
//! };
//! let mut impulses = [[0.0; 3]];
//! let outcome = solve(&problem, &ContactOptions::default(), &mut impulses);
//! assert!(outcome.solved);
//! // It slides: 3 m/s · m/3.5 is more than μ p_n.
//! assert_eq!(impulses, [[-friction * mass, 0.0, mass]]);
//! ```

mod newton;
mod one_contact;
mod problem;
mod projection;
mod search;
mod sweeps;

pub use problem::{ContactOptions, ContactOutcome, ContactProblem};
use projection::project;
use search::Search;

use crate::real::Real;

/// Solves a contact problem: replaces `impulses`, in N·s along (x, y, normal) of each contact, by its solution.
///
/// The search begins at the given impulses, which those of the step before make short, and if it fails once more at 0; numbers
/// that are not finite, and impulses of contacts that are not active, begin at 0. If neither search meets the tolerance,
/// `impulses` are those with the smallest residual. They are in their cones in any case. If no residual is finite, they are
/// 0 and the residual is NaN.
///
/// It takes about 10 K² + 60 K numbers of memory on the stack: 90 kB for K = 32 and `f64`.
pub fn solve<T: Real, const K: usize>(
    problem: &ContactProblem<'_, T, K>,
    options: &ContactOptions<T>,
    impulses: &mut [[T; 3]; K],
) -> ContactOutcome<T> {
    search(problem, options, impulses, true)
}

/// Searches as [`solve`] from the given impulses alone, not once more from 0.
pub(crate) fn improve<T: Real, const K: usize>(
    problem: &ContactProblem<'_, T, K>,
    options: &ContactOptions<T>,
    impulses: &mut [[T; 3]; K],
) -> ContactOutcome<T> {
    search(problem, options, impulses, false)
}

fn search<T: Real, const K: usize>(
    problem: &ContactProblem<'_, T, K>,
    options: &ContactOptions<T>,
    impulses: &mut [[T; 3]; K],
    once_more: bool,
) -> ContactOutcome<T> {
    let none = [[T::from_f64(0.0); 3]; K];
    let start: [[T; 3]; K] = core::array::from_fn(|c| {
        let p = project(problem.friction[c], &impulses[c]);
        let usable = problem.active[c] && p.iter().all(|x| x.is_finite());
        if usable { p } else { none[c] }
    });
    let mut search = Search::new(problem, options);
    if !search.run(&start) && once_more && start != none {
        search.run(&none);
    }
    let (best, outcome) = search.end();
    *impulses = best;
    outcome
}
