//! The results of calls: their arrays, as Python objects.

use numpy::{PyArrayDyn, PyArrayMethods, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::arrays::{Array, target};
use crate::parts::Parts;

/// Returns the arrays of a result: new ones, or those of `out`.
pub fn targets<'py>(
    py: Python<'py>,
    parts: &Parts,
    batch: &[usize],
    out: Option<&Bound<'py, PyAny>>,
) -> PyResult<Vec<Array<'py>>> {
    let shape = |k: usize| [batch, &parts.arrays[k].shape].concat();
    let (Some(out), Some(class)) = (out, parts.class) else {
        let all = 0..parts.arrays.len();
        return all.map(|k| target(py, out, &shape(k))).collect();
    };
    let given = out.cast::<PyTuple>().ok();
    let given = given.filter(|given| given.len() == parts.arrays.len());
    let given = given.ok_or_else(|| {
        PyTypeError::new_err(format!(
            "`out` is a tuple of {} arrays, or a bgdyn.{class}",
            parts.arrays.len()
        ))
    })?;
    let each = given.iter().enumerate();
    each.map(|(k, out)| target(py, Some(&out), &shape(k)))
        .collect()
}

/// Returns what a call returns: an array (without axes, and not that of the caller: a number), or several arrays
/// with their names.
pub fn result<'py>(
    py: Python<'py>,
    parts: &Parts,
    arrays: Vec<Array<'py>>,
    of_caller: bool,
) -> PyResult<Bound<'py, PyAny>> {
    if let Some(class) = parts.class {
        let class = py.import("bgdyn._results")?.getattr(class)?;
        return class.call1(PyTuple::new(py, arrays)?);
    }
    let [array] = &arrays[..] else {
        return Err(PyTypeError::new_err("several arrays without names"));
    };
    match of_caller {
        true => Ok(array.as_any().clone()),
        false => without_axes(array.as_any()),
    }
}

/// Returns the number in an array without axes; other arrays as they are.
pub fn without_axes<'py>(array: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    match array.cast::<PyUntypedArray>()?.ndim() {
        0 => array.get_item(PyTuple::empty(array.py())),
        _ => Ok(array.clone()),
    }
}

/// Returns where a batch is singular; one bool for a single state.
pub fn mask<'py>(
    py: Python<'py>,
    refused: impl IntoIterator<Item = usize>,
    batch: &[usize],
) -> PyResult<Bound<'py, PyAny>> {
    let mask = PyArrayDyn::<bool>::zeros(py, batch, false);
    let mut write = mask.readwrite();
    let entries = write.as_slice_mut()?;
    refused.into_iter().for_each(|state| entries[state] = true);
    drop(write);
    without_axes(mask.as_any())
}
