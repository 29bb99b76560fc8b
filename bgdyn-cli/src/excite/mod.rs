//! `bgdyn excite`: a motion that shows a mechanism's parameters, as a table, coefficients, a scene and a page.

mod files;
mod json;
mod limits;
mod missing;
pub(crate) mod page;
mod planned;
mod points;
mod scene;
mod table;
mod text;

pub(crate) use files::{check, write};
pub(crate) use json::json;
pub(crate) use limits::{Asked, joint_limits};
pub(crate) use missing::missing_effects;
pub(crate) use planned::Planned;
pub(crate) use points::{FramePoints, Plane};
pub(crate) use scene::scene;
pub(crate) use table::table;
pub(crate) use text::summary;
