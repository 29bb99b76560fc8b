//! bgdyn for Python: the compiled part of the package `bgdyn`.
//!
//! A method's function is prepared as a tape (`spec.rs`), computed at many states (`batch.rs`, four at once by
//! `lanes.rs`) and its numbers put into arrays (`parts.rs`); these know nothing of Python. `arrays.rs` reads and provides
//! NumPy arrays, `results.rs` returns them; `positions.rs` moves positions joint by joint (`joint_positions.rs`) and closes
//! loops, `position_calls.rs` does so at many states; `method.rs`, `model.rs` and `scene.rs` are the classes.
#![forbid(unsafe_code)]

mod arrays;
mod batch;
mod errors;
mod imported;
mod joint_positions;
mod lanes;
mod method;
mod model;
mod parts;
mod position_calls;
mod positions;
mod results;
mod run_settings;
mod scene;
mod spec;

use pyo3::prelude::*;

#[pymodule]
mod _bgdyn {
    #[pymodule_export]
    use crate::imported::import_file;
    #[pymodule_export]
    use crate::method::PyMethod;
    #[pymodule_export]
    use crate::model::Model;
    #[pymodule_export]
    use crate::scene::PyScene;
}
