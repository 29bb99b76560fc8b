//! Coordinates of joints with several degrees of freedom whose velocities are not the rates of their
//! coordinates.
//!
//! | joint | coordinates q | velocities v |
//! |---|---|---|
//! | [`spherical`] | quaternion x, y, z, w | ω: x, y, z |
//! | [`floating`] | position x, y, z; quaternion x, y, z, w | linear x, y, z; ω: x, y, z |
//! | [`planar`] | x, y, angle about z | linear x, y; ω about z |
//!
//! q is the place of the link in its joint's origin: position in origin axes (m), unit quaternion or angle
//! (rad) from link axes to origin axes. v is the velocity of the link relative to its parent in *link*
//! axes: of the link's origin (m/s), and ω (rad/s).
//!
//! Each of the three modules has the same functions on arrays:
//! - `position_rates(q, v)`: q̇;
//! - `integrate(q, d)`: q after the constant velocity d for one unit of time, the exponential of the group
//!   (SO(3), SE(3), SE(2));
//! - `difference(q1, q0)`: the d with `integrate(q0, d)` = q1, the logarithm of the group;
//! - `normalize(q)`: q with a quaternion of length 1;
//! - `neutral()`: the q with the link at its origin;
//! - `sample(u)`: an evenly distributed q from numbers in [0, 1);
//! - `bracket(x)`: the matrix of y ↦ \[x, y\], the bracket of two velocities, column by column;
//! - `integration_maps(d)`: the derivatives of `integrate(q, d)` by q and by d along the tangent. They depend on d only.
//!
//! No function branches on a value: lanes, dual numbers and scalars run the same code. A NaN in a
//! quaternion becomes a NaN in all results that depend on the orientation.

pub mod floating;
pub mod functions;
pub mod planar;
mod quaternion;
pub mod spherical;
mod tangent;

pub(crate) use tangent::Columns;

pub use quaternion::{quaternion_of, rotation};
