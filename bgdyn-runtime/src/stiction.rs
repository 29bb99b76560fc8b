//! Determines which contacts hold and which slip, for all joints at rest together.

use crate::state_vector::StateVector;
use crate::{Contact, HybridSystem, Scalar};

/// Returns the modes of a scene's dry friction at an instant: which of the joints at rest hold, and in
/// which direction the others begin to slip.
///
/// Joints at rest are those with mode 0 in `modes` and those that slip by no more than `rest`. The other
/// joints retain their modes. The slip of a joint that holds is not changed: set it to 0 before the call.
///
/// The result is consistent: every contact that holds is within its limit, and no contact that slips
/// reverses at once. If static and sliding friction are equal, the result is unique: the solution of a
/// linear complementarity problem whose matrix is a submatrix of M⁻¹. It is found by pivoting on the least
/// index (Murty 1974; with bounds on both sides Júdice and Pires 1992): at first all contacts hold, and as
/// long as any is inconsistent, the first of these changes its mode. If static friction is larger than
/// sliding friction, there can be several solutions; then a joint that broke away at this instant holds at
/// most the effort of sliding friction.
///
/// # Termination
/// Suppose that the problem is solved with the mode of its last joint fixed. The slip acceleration of that
/// joint, with the others solved, increases with its friction, because the matrix is positive definite. So
/// the joint changes its mode at most twice, and by induction the algorithm ends. A joint breaks away from
/// rest once. Rounding errors cannot cause an infinite loop either: the number of changes is at most that
/// of all combinations.
///
/// # Errors
/// As [`HybridSystem::derivative`].
pub fn resolve_stiction<T, S>(
    system: &S,
    y: &S::State,
    modes: &S::Modes,
    input: &S::Inputs,
    t: T,
    rest: T,
) -> Result<S::Modes, S::Singular>
where
    T: Scalar<Mask = bool>,
    S: HybridSystem<T>,
{
    resolve_stiction_by(modes, rest, |modes| system.contacts(y, modes, input, t))
}

/// Returns the mode for a coordinate's slip: 0 if it is at rest against its counterpart, that is if the
/// slip is at most `rest` in size (rad/s, m/s, A), else the sign of the slip. A coordinate that slips in
/// the direction of its `mode` retains the mode at any speed.
pub fn mode_by_slip<T: Scalar<Mask = bool>>(mode: T, slip: T, rest: T) -> T {
    let zero = T::from_f64(0.0);
    if zero.less(mode * slip) {
        mode
    } else if rest.less(slip.abs()) {
        slip.sign()
    } else {
        zero
    }
}

/// [`resolve_stiction`] for contacts of any source, with a number of modes known at compile time or at run
/// time: `contacts` returns one contact per mode, for given modes.
///
/// # Errors
/// The errors of `contacts`.
pub fn resolve_stiction_by<T, M, C, E>(
    modes: &M,
    rest: T,
    contacts: impl Fn(&M) -> Result<C, E>,
) -> Result<M, E>
where
    T: Scalar<Mask = bool>,
    M: StateVector<Scalar = T>,
    C: AsRef<[Contact<T>]>,
{
    let zero = T::from_f64(0.0);
    let count = modes.entries().len();
    let mut resting = modes.array(false);
    let resting = resting.as_mut();
    let mut now = modes.clone();
    for (k, contact) in contacts(modes)?.as_ref().iter().enumerate() {
        resting[k] = modes.entries()[k] == zero || !rest.less(contact.slip.abs());
        if resting[k] {
            now.entries_mut()[k] = zero;
        }
    }
    // Joints that broke away at this instant.
    let mut broken = modes.array(false);
    let broken = broken.as_mut();
    for _ in 0..combinations(count) {
        let found = contacts(&now)?;
        let found = found.as_ref();
        let mut changed = None;
        for k in (0..count).filter(|&k| resting[k]) {
            let mode = now.entries()[k];
            changed = if mode != zero {
                turns_back(mode, &found[k]).then_some(zero)
            } else if broken[k] {
                // Check whether the joint continues to slip against sliding friction.
                let mut tried = now.clone();
                let slip = against(&found[k]);
                tried.entries_mut()[k] = slip;
                let slips = slip * contacts(&tried)?.as_ref()[k].slip_rate;
                zero.less(slips).then_some(slip)
            } else {
                broken[k] = found[k].margin.less(zero);
                broken[k].then(|| against(&found[k]))
            };
            if let Some(mode) = changed {
                now.entries_mut()[k] = mode;
                break;
            }
        }
        if changed.is_none() {
            break;
        }
    }
    Ok(now)
}

/// Returns the direction in which a joint breaks away: opposite to the effort that held it.
fn against<T: Scalar>(contact: &Contact<T>) -> T {
    -contact.holding.sign()
}

/// Returns whether a joint that slips from rest in this direction would be accelerated backwards.
fn turns_back<T: Scalar<Mask = bool>>(mode: T, contact: &Contact<T>) -> bool {
    (mode * contact.slip_rate).less(T::from_f64(0.0))
}

/// Returns an upper bound on the number of changes: every combination of `n` joints, again each time one
/// breaks away.
fn combinations(n: usize) -> usize {
    let all = u32::try_from(n).ok().and_then(|n| 3_usize.checked_pow(n));
    all.map_or(usize::MAX, |all| all.saturating_mul(n + 1))
}
