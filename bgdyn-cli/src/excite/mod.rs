//! `bgdyn excite`: a motion that shows a mechanism's parameters, as a table, coefficients, a scene and a page.

mod json;
mod limits;
pub(crate) mod page;
mod points;
mod scene;
mod table;
mod text;

pub(crate) use json::json;
pub(crate) use limits::{Asked, joint_limits};
pub(crate) use points::{FramePoints, keep};
pub(crate) use scene::scene;
pub(crate) use table::table;
pub(crate) use text::summary;
