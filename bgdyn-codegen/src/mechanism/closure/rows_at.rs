//! The rows of a loop or a contact at one position: rates, values, second derivatives.

use std::borrow::Cow;
use std::ops::Mul;

use bgdyn_runtime::Dd;

use super::chain::{ChainFrames, LoopChain, RelativePlace, TwistPoint};
use super::contact::ContactFrame;
use super::contact_shape::{ContactAxes, ContactNumbers};
use super::row::RowKind;
use super::{Closure, KinematicLoop};
use crate::math::{Ring, Vec3};
use crate::mechanism::CoordinateId;
use crate::mechanism::joint::Column;

/// The way in which rows are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RowAxes {
    /// Those of a loop in the axes of place b, if they hold there too.
    pub reversed: bool,
    /// Those of a contact along the plane and its normal, not in the axes in which they take fewer operations.
    pub of_plane: bool,
    /// Whether loops are closed: then coinciding places are one point.
    pub closed: bool,
}

/// The places of a loop at one position.
pub struct RowsAt<'a, E> {
    one: &'a KinematicLoop,
    chain: Cow<'a, LoopChain>,
    frames: ChainFrames<E>,
    place: RelativePlace<E>,
    /// The twists of place b relative to place a per unit velocity; of a wheel relative to its plane.
    columns: Vec<(CoordinateId, Column<E>)>,
    contact: Option<(ContactFrame<E>, ContactAxes)>,
    /// The height of a contact's place a above its plane, m.
    height: E,
    zero: E,
    unit: E,
}

/// The load of a row with the multiplier 1, in the axes of place a: on place b about its origin, on a wheel, a ball or
/// a knife edge at the contact.
pub type RowLoad<E> = Column<E>;

impl Closure {
    /// Returns the rows of a loop at a position of the open tree.
    pub fn rows_at<E: Ring + Mul<Dd, Output = E>>(
        &self,
        closes: usize,
        axes: RowAxes,
        (q, numbers): (&[E], &impl ContactNumbers<E>),
    ) -> RowsAt<'_, E> {
        let one = &self.loops[closes];
        let chain = match axes.reversed && one.reversible {
            true => Cow::Owned(one.chain.reversed()),
            false => Cow::Borrowed(&one.chain),
        };
        let point = match (&one.contact, axes.closed && one.kind.coincident) {
            (Some(_), _) => TwistPoint::A,
            (None, true) => TwistPoint::Both,
            (None, false) => TwistPoint::B,
        };
        let frames = chain.frames(q, numbers);
        let place = chain.place(&frames, point, numbers);
        let contact = one.contact.as_ref().map(|contact| {
            let kept = |row| self.has(closes, RowKind::Contact(row));
            let solved = match axes.of_plane || self.of_plane {
                true => ContactAxes::Plane,
                false => contact.solved_in(kept),
            };
            (contact.frame(&place, numbers), solved)
        });
        let columns = match &one.contact {
            Some(contact) => contact.columns(&place, numbers),
            None => place.columns.clone(),
        };
        // In the axes of the plane: far from its origin no digit is lost.
        let height = match &one.contact {
            Some(_) => chain.reversed().frames(q, numbers).end().0[2],
            None => numbers.constant(Dd::ZERO),
        };
        RowsAt {
            one,
            chain,
            frames,
            place,
            columns,
            contact,
            height,
            zero: numbers.constant(Dd::ZERO),
            unit: numbers.constant(Dd::ONE),
        }
    }

    /// Returns whether a loop has this row, not dropped.
    fn has(&self, closes: usize, kind: RowKind) -> bool {
        let mut rows = self.rows.iter();
        rows.any(|row| row.closes == closes && row.kind == kind)
    }
}

impl<E: Ring + Mul<Dd, Output = E>> RowsAt<'_, E> {
    /// Returns the cosine of a wheel's lean, 0 where it lies flat; 1 for balls and knife edges, `None` for loops.
    pub fn cosine_of_lean(&self) -> Option<E> {
        self.contact
            .as_ref()
            .map(|(frame, _)| frame.cosine_of_lean())
    }

    /// Returns the value that vanishes at closed positions; zero for a row on velocities.
    pub fn residual(&self, row: RowKind, numbers: &impl ContactNumbers<E>) -> E {
        match (row, &self.contact) {
            (RowKind::Closing(row), _) => {
                row.residual(&self.place, self.one.length, |x| numbers.constant(x))
            }
            (RowKind::Contact(row), Some((frame, _))) => row.residual(self.height, frame),
            (RowKind::Contact(_), None) => self.zero,
        }
    }

    /// Returns the rates for a unit of each velocity of the joints between the places.
    pub fn rates(&self, row: RowKind) -> Vec<(CoordinateId, E)> {
        let rate = |column: &Column<E>| match (row, &self.contact) {
            (RowKind::Closing(row), _) => row.rate(&self.place, column, self.one.length),
            (RowKind::Contact(row), Some((frame, axes))) => row.rate(frame, column, *axes),
            (RowKind::Contact(_), None) => self.zero,
        };
        let turns = |j: CoordinateId| {
            let mut others = self.place.columns.iter();
            let (contact, axes) = self.contact.as_ref()?;
            let moves = others.any(|(k, _)| *k == j);
            (!moves && !contact.moved_by_spin(row, *axes)).then_some(self.zero)
        };
        let columns = self.columns.iter();
        let rate = |(j, column): &(CoordinateId, Column<E>)| {
            (*j, turns(*j).unwrap_or_else(|| rate(column)))
        };
        columns.map(rate).collect()
    }

    /// Returns the derivative of the rate if no joint accelerates; `v` are the velocities of the open tree, at which
    /// the rows hold.
    pub fn bias(&self, row: RowKind, v: &[E], numbers: &impl ContactNumbers<E>) -> E {
        match (row, &self.one.contact, &self.contact) {
            (RowKind::Closing(row), ..) => {
                let rates = self.chain.rates(&self.frames, v, numbers);
                row.bias(&self.place, &rates, self.one.length)
            }
            (RowKind::Contact(row), Some(contact), Some((frame, axes))) => {
                let of_plane = self.chain.spatial_rates(&self.frames, v, numbers);
                let rates = contact.rates(&of_plane, v, numbers);
                row.bias(frame, (&rates, of_plane.velocity.angular), *axes)
            }
            _ => self.zero,
        }
    }

    /// Returns the load of a row with the multiplier 1: a force is its linear part, a moment its angular part.
    pub fn load(&self, row: RowKind) -> RowLoad<E> {
        let none = Vec3([self.zero; 3]);
        match (row, &self.contact) {
            (RowKind::Closing(row), _) => {
                // The power of the row is its multiplier times its rate, which is linear in the twist.
                let along = |angular, linear| {
                    row.rate(&self.place, &Column { angular, linear }, self.one.length)
                };
                let unit = |k: usize| {
                    let at = |i| if i == k { self.unit } else { self.zero };
                    Vec3(std::array::from_fn(at))
                };
                Column {
                    angular: Vec3(std::array::from_fn(|k| along(unit(k), none))),
                    linear: Vec3(std::array::from_fn(|k| along(none, unit(k)))),
                }
            }
            (RowKind::Contact(row), Some((frame, _))) => Column {
                angular: none,
                linear: row.direction(frame),
            },
            (RowKind::Contact(_), None) => Column {
                angular: none,
                linear: none,
            },
        }
    }

    /// Returns the point of the loads, from the origin of place a, in its axes, m.
    pub fn load_point(&self) -> Vec3<E> {
        match &self.contact {
            Some((frame, _)) => frame.contact(),
            None if self.one.kind.coincident => Vec3([self.zero; 3]),
            None => self.place.position,
        }
    }
}
