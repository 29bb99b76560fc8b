//! The dependent positions of kinematic loops by Newton's method or in closed form, and ways along velocities that
//! constraints allow.

pub mod assembly;
pub mod polygon;

use nalgebra::SVector;

pub use assembly::{BranchBlock, Conditions, Mechanism, assemble};

use crate::singular::OUT_OF_REACH;
use crate::{Scalar, StateVector};

/// Largest number of steps of Newton's method before the last one.
pub const STEPS: usize = 10;

/// Largest change of a position in one step, rad or m: steps do not jump to another branch.
pub const LARGEST: f64 = 0.5;

/// A dependent joint of a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dependent {
    /// The index of its velocity in the open tree.
    pub velocity: usize,
    /// The index of its position, or the first one of its joint.
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
pub const CLOSED: f64 = 1e-8;

/// The same in scalars that do not tell 1 + [`CLOSED`] from 1.
pub const CLOSED_COARSELY: f64 = 1e-4;

/// A number that scalars with the digits of `f64` do not add to 1.
const MORE_DIGITS: f64 = 1e-20;

/// Returns the step after which one more is exact to rounding.
#[inline]
fn closed<T: Scalar>() -> T {
    let (one, fine) = (T::from_f64(1.0), T::from_f64(CLOSED));
    let kept = (one + fine) - one;
    let coarse = kept.less(fine * T::from_f64(0.5));
    T::select(coarse, T::from_f64(CLOSED_COARSELY), fine)
}

/// Returns whether a number is positive in every lane.
fn all_positive<T: Scalar>(x: T) -> bool {
    let (zero, mut refused) = (T::from_f64(0.0), T::none_refused());
    x.checked_pivot(zero, 0, &mut refused);
    T::succeeded(&SVector::<T, 1>::from_element(zero), refused)
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
/// The first loop that does not close, with the cause [`crate::Cause::OutOfReach`]; per lane.
#[inline]
pub fn close_state<T: Scalar, const N: usize, const NQ: usize, const M: usize>(
    y: &mut SVector<T, N>,
    dependents: &[Dependent],
    names: &'static [&'static str],
    step: impl Fn(&SVector<T, N>) -> SVector<T, NQ>,
) -> Result<(), T::Singular<M>> {
    let closing = close_from(*y, dependents, M, step);
    let refused = closing.refused;
    *y = closing.or_nan(dependents, &[]);
    let nothing = SVector::<T, M>::from_element(T::from_f64(0.0));
    T::finish(nothing, refused, names, |_| ()).map(|_| ())
}

/// Does the same as [`close`] for vectors of any kind; the loops have the indices from `first` on.
#[inline]
pub fn close_from<Y: StateVector, Z: StateVector<Scalar = Y::Scalar>>(
    q: Y,
    dependents: &[Dependent],
    first: usize,
    step: impl Fn(&Y) -> Z,
) -> Closing<Y> {
    let before = Closing {
        q,
        last: Y::Scalar::from_f64(0.0),
        refused: Y::Scalar::none_refused(),
    };
    before.then(dependents, first, step)
}

/// Changes positions so that wheels touch and loops close, where joints of several degrees of freedom are among those
/// that move: `moved` returns the position after constant velocities of the open tree. `step` returns the Newton step
/// of these velocities, which is zero for others than those of `dependents`.
#[inline]
pub fn close_along<T: Scalar, const NQ: usize, const NT: usize>(
    mut q: SVector<T, NQ>,
    dependents: &[Dependent],
    step: impl Fn(&SVector<T, NQ>) -> SVector<T, NT>,
    moved: impl Fn(&SVector<T, NQ>, &SVector<T, NT>) -> SVector<T, NQ>,
) -> Closing<SVector<T, NQ>> {
    let (zero, one) = (T::from_f64(0.0), T::from_f64(1.0));
    let (mut refused, mut last) = (T::none_refused(), zero);
    for _ in 0..STEPS {
        let change = step(&q);
        (last, refused) = largest(&change, dependents, NQ, T::none_refused());
        let large = T::from_f64(LARGEST).less(last);
        let scale = T::select(large, T::from_f64(LARGEST) / last, one);
        q = moved(&q, &change.map(|x| -(x * scale)));
        if T::succeeded(&SVector::<T, 1>::from_element(zero), refused) {
            break;
        }
    }
    let change = step(&q);
    q = moved(&q, &change.map(|x| -x));
    Closing { q, last, refused }
}

/// Returns the largest step of the dependent velocities, and the first loop with one that is not small, at `first` +
/// its index, unless one is `refused` before.
fn largest<Z: StateVector>(
    change: &Z,
    dependents: &[Dependent],
    first: usize,
    mut refused: <Z::Scalar as Scalar>::Refused,
) -> (Z::Scalar, <Z::Scalar as Scalar>::Refused) {
    let zero = Z::Scalar::from_f64(0.0);
    let mut last = zero;
    for d in dependents {
        if let Some(&x) = change.entries().get(d.velocity) {
            last = last.max(x.abs());
            let place = OUT_OF_REACH + first + d.closes;
            (closed::<Z::Scalar>() - x.abs()).checked_pivot(zero, place, &mut refused);
        }
    }
    (last, refused)
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
    /// The loop, with the cause [`crate::Cause::OutOfReach`]; per lane.
    #[inline]
    pub fn finish(self, names: &'static [&'static str]) -> Result<SVector<T, NQ>, T::Singular<NQ>> {
        T::finish(self.q, self.refused, names, |_| ())
    }
}

impl<Y: StateVector> Closing<Y> {
    /// Closes the loops that are left as [`close_from`] does; `dependents` are theirs.
    #[inline]
    pub fn then<Z: StateVector<Scalar = Y::Scalar>>(
        self,
        dependents: &[Dependent],
        first: usize,
        step: impl Fn(&Y) -> Z,
    ) -> Closing<Y> {
        let number = <Y::Scalar as Scalar>::from_f64;
        let (zero, one) = (number(0.0), number(1.0));
        let (mut q, mut refused, mut last) = (self.q, self.refused, self.last);
        for _ in 0..STEPS {
            let change = step(&q);
            (last, refused) = largest(&change, dependents, first, self.refused);
            let large = number(LARGEST).less(last);
            let scale = Y::Scalar::select(large, number(LARGEST) / last, one);
            move_by(&mut q, dependents, &change, scale);
            if Y::Scalar::succeeded(&SVector::<Y::Scalar, 1>::from_element(zero), refused) {
                break;
            }
        }
        let change = step(&q);
        move_by(&mut q, dependents, &change, one);
        let last = last.max(self.last);
        Closing { q, last, refused }
    }

    /// Brings positions in closed form to the constants of `step`, which are `f64` numbers, in scalars that have more
    /// digits: two steps of Newton's method. There they are 1e-17 apart.
    #[inline]
    pub fn refined<Z: StateVector<Scalar = Y::Scalar>>(
        mut self,
        dependents: &[Dependent],
        step: impl Fn(&Y) -> Z,
    ) -> Closing<Y> {
        let [zero, one] = [0.0, 1.0].map(Y::Scalar::from_f64);
        if !all_positive(Y::Scalar::from_parts(1.0, MORE_DIGITS) - one) {
            return self;
        }
        for _ in 0..2 {
            let mut change = step(&self.q);
            // At a singular position there is no step.
            for x in change.entries_mut() {
                *x = Y::Scalar::select(x.abs().less(closed()), *x, zero);
            }
            move_by(&mut self.q, dependents, &change, one);
        }
        self
    }

    /// Returns the positions; where a loop does not close, the dependent ones are NaN, and those with the indices
    /// `others`: functions that read no dependent position shall not take them for closed ones either.
    #[inline]
    pub fn or_nan(self, dependents: &[Dependent], others: &[usize]) -> Y {
        let mut q = self.q;
        let number = <Y::Scalar as Scalar>::from_f64;
        let closed = self.last.less(closed());
        let positions = dependents.iter().map(|d| d.position);
        for position in positions.chain(others.iter().copied()) {
            if let Some(q) = q.entries_mut().get_mut(position) {
                *q = Y::Scalar::select(closed, *q, number(f64::NAN));
            }
        }
        q
    }

    /// Returns the positions; where a loop does not close, these others.
    #[inline]
    pub fn or(self, others: Y) -> Y {
        let mut q = self.q;
        let closed = self.last.less(closed());
        for (q, &other) in q.entries_mut().iter_mut().zip(others.entries()) {
            *q = Y::Scalar::select(closed, *q, other);
        }
        q
    }

    /// Returns the positions; all are NaN where a loop does not close: a function may read any of them, and shall not take
    /// them for closed ones.
    #[inline]
    pub fn or_all_nan(self) -> Y {
        let mut q = self.q;
        let number = <Y::Scalar as Scalar>::from_f64;
        let closed = self.last.less(closed());
        for q in q.entries_mut() {
            *q = Y::Scalar::select(closed, *q, number(f64::NAN));
        }
        q
    }
}

/// Returns the position after one second along velocities of the open tree that depend on the position: `rates` returns
/// them, `moved` the position after constant ones. Order 4, without commutators (Celledoni, Marthinsen and Owren 2003);
/// exact for constant velocities. `Y` are positions, `Z` velocities of the open tree.
#[inline]
pub fn follow<Y: StateVector, Z: StateVector<Scalar = Y::Scalar>>(
    q: &Y,
    rates: impl Fn(&Y) -> Z,
    moved: impl Fn(&Y, &Z) -> Y,
) -> Y {
    let number = <Y::Scalar as Scalar>::from_f64;
    let (half, three, twelfth) = (number(0.5), number(3.0), number(1.0) / number(12.0));
    let k1 = rates(q);
    let middle = moved(q, &k1.times(half));
    let k2 = rates(&middle);
    let k3 = rates(&moved(q, &k2.times(half)));
    let k4 = rates(&moved(&middle, &zipped(&k3, &k1, |x, y| x - y * half)));
    let both = zipped(&k2, &k3, |x, y| x + x + y + y);
    // (3 k₁ + 2 k₂ + 2 k₃ − k₄) / 12, then (−k₁ + 2 k₂ + 2 k₃ + 3 k₄) / 12
    let part = |first: &Z, last: &Z| {
        let ends = zipped(first, last, |x, y| three * x - y);
        zipped(&both, &ends, |x, y| (x + y) * twelfth)
    };
    moved(&moved(q, &part(&k1, &k4)), &part(&k4, &k1))
}

/// Combines two vectors component by component.
fn zipped<Z: StateVector>(a: &Z, b: &Z, with: impl Fn(Z::Scalar, Z::Scalar) -> Z::Scalar) -> Z {
    let mut all = a.clone();
    for (x, &y) in all.entries_mut().iter_mut().zip(b.entries()) {
        *x = with(*x, y);
    }
    all
}

/// Steps of [`towards`] and of [`walk`].
pub const PARTS: usize = 16;

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

/// Returns the last closed position on a way of [`PARTS`] parts from the closed position `start`; `step` is one of them.
#[inline]
pub fn walk<T: Scalar, const NQ: usize>(
    start: SVector<T, NQ>,
    step: impl Fn(&SVector<T, NQ>) -> Closing<SVector<T, NQ>>,
) -> SVector<T, NQ> {
    let mut q = start;
    for _ in 0..PARTS {
        let closing = step(&q);
        let closed = closing.last.less(closed());
        for (q, &next) in q.iter_mut().zip(closing.q.iter()) {
            *q = T::select(closed, next, *q);
        }
    }
    q
}
