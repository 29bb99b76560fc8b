//! Newton's method for the dependent positions of kinematic loops, and ways along velocities that constraints allow.

use nalgebra::SVector;

use crate::Scalar;

/// Largest number of steps.
const STEPS: usize = 10;

/// Largest change of a position in one step, rad or m: steps do not jump to another branch.
const LARGEST: f64 = 0.5;

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
#[derive(Clone, Copy, Debug)]
pub struct Closing<T: Scalar, const NQ: usize> {
    /// The positions.
    pub q: SVector<T, NQ>,
    /// The largest of the last steps that were checked; below [`CLOSED`] where the loops close.
    last: T,
    /// The loop that does not close: at `NQ` + its index.
    refused: T::Refused,
}

/// Newton's method converges quadratically: after a step below this one more step is exact to rounding.
const CLOSED: f64 = 1e-8;

/// Changes the dependent positions so that all loops close. `step` returns J_d⁻¹ c(q), the Newton step of the
/// velocities of the open tree.
#[inline]
pub fn close<T: Scalar, const NQ: usize, const NT: usize>(
    mut q: SVector<T, NQ>,
    dependents: &[Dependent],
    step: impl Fn(&SVector<T, NQ>) -> SVector<T, NT>,
) -> Closing<T, NQ> {
    let (zero, one) = (T::from_f64(0.0), T::from_f64(1.0));
    let (mut refused, mut last) = (T::none_refused(), zero);
    for _ in 0..STEPS {
        let change = step(&q);
        (last, refused) = largest(&change, dependents, NQ);
        let large = T::from_f64(LARGEST).less(last);
        let scale = T::select(large, T::from_f64(LARGEST) / last, one);
        move_by(&mut q, dependents, &change, scale);
        if T::succeeded(&SVector::<T, 1>::from_element(zero), refused) {
            break;
        }
    }
    let change = step(&q);
    move_by(&mut q, dependents, &change, one);
    Closing { q, last, refused }
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
) -> Closing<T, NQ> {
    let (zero, one) = (T::from_f64(0.0), T::from_f64(1.0));
    let (mut refused, mut last) = (T::none_refused(), zero);
    for _ in 0..STEPS {
        let change = step(&q);
        (last, refused) = largest(&change, dependents, NQ);
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
/// its index.
fn largest<T: Scalar, const NT: usize>(
    change: &SVector<T, NT>,
    dependents: &[Dependent],
    first: usize,
) -> (T, T::Refused) {
    let zero = T::from_f64(0.0);
    let (mut last, mut refused) = (zero, T::none_refused());
    for d in dependents {
        if let Some(&x) = change.get(d.velocity) {
            last = last.max(x.abs());
            (T::from_f64(CLOSED) - x.abs()).checked_pivot(zero, first + d.closes, &mut refused);
        }
    }
    (last, refused)
}

/// Subtracts the steps of the dependent velocities from their positions.
fn move_by<T: Scalar, const NQ: usize, const NT: usize>(
    q: &mut SVector<T, NQ>,
    dependents: &[Dependent],
    change: &SVector<T, NT>,
    scale: T,
) {
    for d in dependents {
        if let (Some(&x), Some(q)) = (change.get(d.velocity), q.get_mut(d.position)) {
            *q = *q - x * scale;
        }
    }
}

impl<T: Scalar, const NQ: usize> Closing<T, NQ> {
    /// Returns the positions, or the first loop that does not close; `names` are those of the `NQ` positions, and
    /// of the loops after them.
    ///
    /// # Errors
    /// The loop, with the cause [`crate::Cause::Loop`]; per lane.
    #[inline]
    pub fn finish(self, names: &'static [&'static str]) -> Result<SVector<T, NQ>, T::Singular<NQ>> {
        T::finish(self.q, self.refused, names, |_| ())
    }

    /// Returns the positions; where a loop does not close, the dependent ones are NaN, so that no function takes
    /// them for closed ones.
    #[inline]
    pub fn or_nan(self, dependents: &[Dependent]) -> SVector<T, NQ> {
        let mut q = self.q;
        let closed = self.last.less(T::from_f64(CLOSED));
        for d in dependents {
            if let Some(q) = q.get_mut(d.position) {
                *q = T::select(closed, *q, T::from_f64(f64::NAN));
            }
        }
        q
    }
}

/// Returns the position after one second along velocities of the open tree that depend on the position: `rates` returns
/// them, `moved` the position after constant ones. Order 4, without commutators (Celledoni, Marthinsen and Owren 2003);
/// exact for constant velocities.
#[inline]
pub fn follow<T: Scalar, const NQ: usize, const NT: usize>(
    q: &SVector<T, NQ>,
    rates: impl Fn(&SVector<T, NQ>) -> SVector<T, NT>,
    moved: impl Fn(&SVector<T, NQ>, &SVector<T, NT>) -> SVector<T, NQ>,
) -> SVector<T, NQ> {
    let half = T::from_f64(0.5);
    let k1 = rates(q);
    let middle = moved(q, &k1.map(|x| x * half));
    let k2 = rates(&middle);
    let k3 = rates(&moved(q, &k2.map(|x| x * half)));
    let k4 = rates(&moved(&middle, &k3.zip_map(&k1, |x, y| x - y * half)));
    let both = k2.zip_map(&k3, |x, y| x + x + y + y);
    // (3 k₁ + 2 k₂ + 2 k₃ − k₄) / 12, then (−k₁ + 2 k₂ + 2 k₃ + 3 k₄) / 12
    let (three, twelfth) = (T::from_f64(3.0), T::from_f64(1.0) / T::from_f64(12.0));
    let part = |first: &SVector<T, NT>, last: &SVector<T, NT>| {
        let ends = first.zip_map(last, |x, y| three * x - y);
        both.zip_map(&ends, |x, y| (x + y) * twelfth)
    };
    moved(&moved(q, &part(&k1, &k4)), &part(&k4, &k1))
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
        let closed = closing.last.less(T::from_f64(CLOSED));
        for (q, &next) in q.iter_mut().zip(closing.q.iter()) {
            *q = T::select(closed, next, *q);
        }
    }
    q
}
