//! Newton's method for the dependent positions of kinematic loops.

use nalgebra::SVector;

use crate::{Scalar, StateVector};

/// Largest number of steps.
const STEPS: usize = 10;

/// Largest change of a position in one step, rad or m: steps do not jump to another branch.
const LARGEST: f64 = 0.5;

/// A dependent joint of a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dependent {
    /// The index of its velocity in the open tree.
    pub velocity: usize,
    /// The index of its position.
    pub position: usize,
    /// The index of its loop.
    pub closes: usize,
}

/// The result of [`close`].
#[derive(Clone, Debug)]
pub struct Closing<Y: StateVector> {
    /// The positions, or the state that begins with them.
    pub q: Y,
    /// The largest of the last steps that were checked; below [`closed`] where the loops close.
    last: Y::Scalar,
    /// The loop that does not close: the first loop's index plus its own.
    pub refused: <Y::Scalar as Scalar>::Refused,
}

/// Newton's method converges quadratically: after a step below this one more step is exact to rounding, in scalars
/// with the digits of `f64`.
const CLOSED: f64 = 1e-8;

/// The same in scalars that do not tell 1 + [`CLOSED`] from 1.
const CLOSED_COARSELY: f64 = 1e-4;

/// Returns the step after which one more is exact to rounding.
#[inline]
fn closed<T: Scalar>() -> T {
    let (one, fine) = (T::from_f64(1.0), T::from_f64(CLOSED));
    let kept = (one + fine) - one;
    let coarse = kept.less(fine * T::from_f64(0.5));
    T::select(coarse, T::from_f64(CLOSED_COARSELY), fine)
}

/// Changes the dependent positions so that all loops close. `step` returns J_d⁻¹ c(q), the Newton step of the
/// velocities of the open tree.
#[inline]
pub fn close<T: Scalar, const NQ: usize, const NT: usize>(
    q: SVector<T, NQ>,
    dependents: &[Dependent],
    step: impl Fn(&SVector<T, NQ>) -> SVector<T, NT>,
) -> Closing<SVector<T, NQ>> {
    close_from(q, dependents, NQ, step)
}

/// Changes the dependent positions in the state `y` of a scene so that all loops close. `step` returns the Newton
/// step of the `NQ` positions, the first components of the state. `names` are those of the `M` rates, and of the loops
/// after them. Where a loop does not close, the dependent positions are NaN.
///
/// # Errors
/// The first loop that does not close, with the cause [`crate::Cause::Loop`]; per lane.
#[inline]
pub fn close_state<T: Scalar, const N: usize, const NQ: usize, const M: usize>(
    y: &mut SVector<T, N>,
    dependents: &[Dependent],
    names: &'static [&'static str],
    step: impl Fn(&SVector<T, N>) -> SVector<T, NQ>,
) -> Result<(), T::Singular<M>> {
    let closing = close_from(*y, dependents, M, step);
    let refused = closing.refused;
    *y = closing.or_nan(dependents);
    let nothing = SVector::<T, M>::from_element(T::from_f64(0.0));
    T::finish(nothing, refused, names, |_| ()).map(|_| ())
}

/// Does the same as [`close`] for vectors of any kind; the loops have the indices from `first` on.
#[inline]
pub fn close_from<Y: StateVector, Z: StateVector<Scalar = Y::Scalar>>(
    mut q: Y,
    dependents: &[Dependent],
    first: usize,
    step: impl Fn(&Y) -> Z,
) -> Closing<Y> {
    let number = <Y::Scalar as Scalar>::from_f64;
    let (zero, one) = (number(0.0), number(1.0));
    let (mut refused, mut last) = (Y::Scalar::none_refused(), zero);
    for _ in 0..STEPS {
        let change = step(&q);
        last = zero;
        refused = Y::Scalar::none_refused();
        for d in dependents {
            if let Some(&x) = change.entries().get(d.velocity) {
                last = last.max(x.abs());
                (closed::<Y::Scalar>() - x.abs()).checked_pivot(
                    zero,
                    first + d.closes,
                    &mut refused,
                );
            }
        }
        let large = number(LARGEST).less(last);
        let scale = Y::Scalar::select(large, number(LARGEST) / last, one);
        move_by(&mut q, dependents, &change, scale);
        if Y::Scalar::succeeded(&SVector::<Y::Scalar, 1>::from_element(zero), refused) {
            break;
        }
    }
    let change = step(&q);
    move_by(&mut q, dependents, &change, one);
    Closing { q, last, refused }
}

/// Subtracts the steps of the dependent velocities from their positions.
fn move_by<Y: StateVector, Z: StateVector<Scalar = Y::Scalar>>(
    q: &mut Y,
    dependents: &[Dependent],
    change: &Z,
    scale: Y::Scalar,
) {
    for d in dependents {
        let (step, position) = (
            change.entries().get(d.velocity),
            q.entries_mut().get_mut(d.position),
        );
        if let (Some(&x), Some(q)) = (step, position) {
            *q = *q - x * scale;
        }
    }
}

impl<T: Scalar, const NQ: usize> Closing<SVector<T, NQ>> {
    /// Returns the positions, or the first loop that does not close; `names` are those of the `NQ` positions, and
    /// of the loops after them.
    ///
    /// # Errors
    /// The loop, with the cause [`crate::Cause::Loop`]; per lane.
    #[inline]
    pub fn finish(self, names: &'static [&'static str]) -> Result<SVector<T, NQ>, T::Singular<NQ>> {
        T::finish(self.q, self.refused, names, |_| ())
    }
}

impl<Y: StateVector> Closing<Y> {
    /// Returns the positions; where a loop does not close, the dependent ones are NaN, so that no function takes
    /// them for closed ones.
    #[inline]
    pub fn or_nan(self, dependents: &[Dependent]) -> Y {
        let mut q = self.q;
        let number = <Y::Scalar as Scalar>::from_f64;
        let closed = self.last.less(closed());
        for d in dependents {
            if let Some(q) = q.entries_mut().get_mut(d.position) {
                *q = Y::Scalar::select(closed, *q, number(f64::NAN));
            }
        }
        q
    }
}

/// Steps of [`towards`].
const PARTS: usize = 16;

/// Returns the closed position closest to `target` on the way from the closed position `start`: the positions with
/// the indices `free.0` move in equal parts as far as the loops close; positions outside of loops are those of
/// `target`. `free.1` are the dependent joints.
#[inline]
pub fn towards<T: Scalar, const NQ: usize, const NT: usize>(
    start: SVector<T, NQ>,
    target: SVector<T, NQ>,
    free: (&[usize], &[Dependent]),
    step: impl Fn(&SVector<T, NQ>) -> SVector<T, NT>,
) -> SVector<T, NQ> {
    let (independents, dependents) = free;
    let in_loop =
        |p: usize| independents.contains(&p) || dependents.iter().any(|d| d.position == p);
    let mut q = target;
    for (p, (q, from)) in q.iter_mut().zip(start.iter()).enumerate() {
        if in_loop(p) {
            *q = *from;
        }
    }
    for part in 1..=PARTS {
        let share = T::from_f64(part as f64 / PARTS as f64);
        let mut next = q;
        let ends = start.iter().zip(target.iter()).enumerate();
        for (next, (p, (&from, &to))) in next.iter_mut().zip(ends) {
            if independents.contains(&p) {
                *next = from + (to - from) * share;
            }
        }
        let closing = close(next, dependents, &step);
        let closed = closing.last.less(closed());
        for (q, &next) in q.iter_mut().zip(closing.q.iter()) {
            *q = T::select(closed, next, *q);
        }
    }
    q
}
