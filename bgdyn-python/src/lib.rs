//! bgdyn for Python: the compiled part of the package `bgdyn`.
//!
//! A method's function is prepared as a tape (`spec.rs`), computed at many states (`batch.rs`, four at once by
//! `lanes.rs`) and its numbers put into arrays (`parts.rs`); these know nothing of Python. `arrays.rs` reads and provides
//! NumPy arrays, `results.rs` returns them; `positions.rs` moves positions joint by joint (`joint_positions.rs`) and closes
//! loops, `position_calls.rs` does so at many states; `method.rs`, `model.rs` and `scene.rs` are the classes,
//! `opening.rs` reads the text of a model, `source.rs` writes its code, `documentation.rs` is what `help` prints of
//! methods. `threads.rs` shares a computation among threads, and `interrupt.rs` ends it at Ctrl-C.
#![forbid(unsafe_code)]

mod arrays;
mod batch;
mod documentation;
mod errors;
mod imported;
mod interrupt;
mod joint_positions;
mod lanes;
mod method;
mod model;
mod opening;
mod parts;
mod position_calls;
mod positions;
mod results;
mod run_settings;
mod scene;
mod source;
mod spec;
mod threads;

use pyo3::prelude::*;

#[pymodule]
mod _bgdyn {
    use numpy::{PyArray1, PyArrayMethods};
    use pyo3::prelude::*;

    #[pymodule_export]
    use crate::imported::import_file;
    #[pymodule_export]
    use crate::method::PyMethod;
    #[pymodule_export]
    use crate::model::Model;
    #[pymodule_export]
    use crate::scene::PyScene;

    /// Returns name, arguments and text of the methods that the class `Model` shows.
    #[pyfunction]
    fn class_methods() -> Vec<(String, Vec<&'static str>, String)> {
        crate::documentation::of_class()
    }

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        let py = module.py();
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        // Loads what NumPy has for other modules: without it a signal in the first call would be an error there.
        py.import("numpy")?;
        drop(PyArray1::<f64>::zeros(py, 0, false).try_readwrite());
        Ok(())
    }
}
