//! Decides which contacts hold and which slip, for all joints at rest together.

use crate::state_vector::StateVector;
use crate::{Contact, HybridSystem, Scalar};

/// The modes of a scene's dry friction at an instant: which of the joints at rest hold, and in which
/// direction the others begin to slip.
///
/// At rest are the joints that `modes` holds (0) and those that slip by no more than `rest`, the rest
/// keep their modes. A joint that holds keeps the slip it has: set it to 0 before.
///
/// The answer is consistent: whatever holds does so within its limit, whatever slips does not turn
/// back at once. Where friction has one size at rest and in motion it is the only one, the solution
/// of a linear complementarity problem whose matrix is a part of M⁻¹, and it is found by pivoting on
/// the least index (Murty 1974; with bounds on both sides Júdice and Pires 1992): all are held at
/// first, and as long as any is inconsistent, the first of these changes sides. Where rest holds more
/// than slipping resists there may be several answers; a joint that broke away at this instant then
/// holds no more than it resists slipping.
///
/// # Termination
/// Take the problem with its last joint fixed as solved. That joint's slip acceleration, with the
/// others so solved, rises with its friction, for the matrix is positive definite; so the joint
/// changes sides twice at most, and by induction the whole ends. A joint breaks away from rest once.
/// Rounding errors cannot go round in circles for ever either: the number of changes is bounded by
/// that of all combinations.
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

/// The mode that a coordinate's slip calls for: 0 where it is at rest against its counterpart, which
/// is a slip of no more than `rest` in size (rad/s, m/s, A), else the sign of the slip. One that slips
/// the way its `mode` says keeps it, however slow it is.
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

/// [`resolve_stiction`] for contacts that come from elsewhere, of a number known when compiling or when
/// running: `contacts` gives one per mode, at the modes it is asked for.
///
/// # Errors
/// Those of `contacts`.
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
    // Which broke away at this instant.
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
                // Does it slip on against the effort of slipping?
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

/// The direction in which a joint gives way: against the effort that held it.
fn against<T: Scalar>(contact: &Contact<T>) -> T {
    -contact.holding.sign()
}

/// Whether a joint that slips from rest in this direction would be pushed back.
fn turns_back<T: Scalar<Mask = bool>>(mode: T, contact: &Contact<T>) -> bool {
    (mode * contact.slip_rate).less(T::from_f64(0.0))
}

/// More changes than there can be: every combination of `n` joints, anew each time one breaks away.
fn combinations(n: usize) -> usize {
    let all = u32::try_from(n).ok().and_then(|n| 3_usize.checked_pow(n));
    all.map_or(usize::MAX, |all| all.saturating_mul(n + 1))
}
