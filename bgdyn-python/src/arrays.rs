//! Reads arguments as arrays of `float64`, and provides the arrays of results.

use numpy::{
    PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyReadwriteArrayDyn, PyUntypedArray,
    PyUntypedArrayMethods,
};
use pyo3::PyTypeInfo;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};

/// An array of `float64`.
pub type Array<'py> = Bound<'py, PyArrayDyn<f64>>;

/// Reads an argument: an array of `float64` whose last axis has `width` entries, row by row in memory.
///
/// # Errors
/// `TypeError` for other numbers than `float64`, which are not converted, and `ValueError` for another shape.
pub fn read<'py>(
    name: &str,
    value: &Bound<'py, PyAny>,
    width: usize,
) -> PyResult<PyReadonlyArrayDyn<'py, f64>> {
    let array = doubles(name, value)?;
    if array.shape().last() != Some(&width) {
        let shape = shown(array.shape());
        return Err(PyValueError::new_err(format!(
            "`{name}` has the shape {shape}: ({width},) is expected, or (..., {width}) for several states"
        )));
    }
    let array = match array.is_c_contiguous() && aligned(&array) {
        true => array,
        false => contiguous(&array)?,
    };
    let borrowed = array.try_readonly();
    borrowed
        .map_err(|_| PyValueError::new_err(format!("`{name}` is being written to by another call")))
}

/// Returns the leading shape of the arguments with these shapes so far, `batch`, and of one more with `shape`.
///
/// # Errors
/// `ValueError` if they differ. An argument without one is shared by all states.
pub fn leading_shape(name: &str, batch: Vec<usize>, shape: &[usize]) -> PyResult<Vec<usize>> {
    let leading = &shape[..shape.len() - 1];
    if batch.is_empty() {
        return Ok(leading.to_vec());
    }
    if leading.is_empty() || leading == batch {
        return Ok(batch);
    }
    let (own, others) = (shown(leading), shown(&batch));
    Err(PyValueError::new_err(format!(
        "`{name}` has the leading shape {own}, the arguments before it {others}: give all the same, or one state for all"
    )))
}

/// Returns the array for a result of this shape: a new one, or `out`.
///
/// # Errors
/// `TypeError` if `out` is no array of `float64`, `ValueError` for another shape or order in memory.
pub fn target<'py>(
    py: Python<'py>,
    out: Option<&Bound<'py, PyAny>>,
    shape: &[usize],
) -> PyResult<Array<'py>> {
    let Some(out) = out else {
        return Ok(PyArrayDyn::zeros(py, shape, false));
    };
    without_mask("out", out)?;
    let Ok(array) = out.cast::<PyArrayDyn<f64>>() else {
        let what = kind(out)?;
        return Err(PyTypeError::new_err(format!(
            "`out` is {what}: an array of float64 is expected"
        )));
    };
    if array.shape() != shape {
        let (found, wanted) = (shown(array.shape()), shown(shape));
        return Err(PyValueError::new_err(format!(
            "`out` has the shape {found}: {wanted} is expected"
        )));
    }
    if !array.is_c_contiguous() || !aligned(array) {
        return Err(PyValueError::new_err(
            "`out` is not row by row in memory: numpy.empty makes such arrays",
        ));
    }
    Ok(array.clone())
}

/// Returns an array for writing.
///
/// # Errors
/// `ValueError` if it is read-only, or shares memory with an argument or another result.
pub fn writable<'py>(array: &Array<'py>) -> PyResult<PyReadwriteArrayDyn<'py, f64>> {
    array.try_readwrite().map_err(|error| {
        PyValueError::new_err(match error {
            numpy::BorrowError::NotWriteable => "`out` is read-only",
            _ => "`out` shares memory with an argument, or with another result",
        })
    })
}

/// Returns a shape as Python prints it.
pub fn shown(shape: &[usize]) -> String {
    match shape {
        [one] => format!("({one},)"),
        _ => {
            let all: Vec<String> = shape.iter().map(usize::to_string).collect();
            format!("({})", all.join(", "))
        }
    }
}

/// Returns the indices of a state in a leading shape.
pub fn unravelled(state: usize, batch: &[usize]) -> Vec<usize> {
    let mut rest = state;
    let mut index: Vec<usize> = Vec::new();
    for size in batch.iter().rev() {
        index.push(rest % size);
        rest /= size;
    }
    index.reverse();
    index
}

/// Checks a number of threads.
///
/// # Errors
/// `ValueError` for 0 and less.
pub fn checked_threads(threads: i64) -> PyResult<usize> {
    match usize::try_from(threads) {
        Ok(threads) if threads > 0 => Ok(threads),
        _ => Err(PyValueError::new_err(format!(
            "`threads` is at least 1, not {threads}"
        ))),
    }
}

/// Reads numbers by name.
///
/// # Errors
/// `TypeError` for a value that is no number.
pub fn numbers_by_name(given: &Bound<'_, PyDict>) -> PyResult<Vec<(String, f64)>> {
    let mut found = Vec::new();
    for (name, value) in given {
        let name: String = name.extract()?;
        let Ok(number) = value.extract() else {
            let shown = value.repr()?;
            return Err(PyTypeError::new_err(format!(
                "`{name}` is a number in SI units, not {shown}"
            )));
        };
        found.push((name, number));
    }
    Ok(found)
}

/// Refuses an array with a mask: its masked numbers would be taken for values.
///
/// # Errors
/// `TypeError`.
fn without_mask(name: &str, value: &Bound<'_, PyAny>) -> PyResult<()> {
    // An array of NumPy itself has none, and needs no import.
    let py = value.py();
    if !value.is_instance_of::<PyUntypedArray>()
        || value.get_type().is(PyUntypedArray::type_object(py))
    {
        return Ok(());
    }
    let masked = py.import("numpy.ma")?.getattr("MaskedArray")?;
    match value.is_instance(&masked)? {
        false => Ok(()),
        true => Err(PyTypeError::new_err(format!(
            "`{name}` is a masked array, and bgdyn has no masks: `{name}.filled(numpy.nan)` makes masked numbers NaN, `{name}.data` takes the numbers without the mask"
        ))),
    }
}

fn aligned(array: &Array<'_>) -> bool {
    array.data().addr().is_multiple_of(align_of::<f64>())
}

/// Returns an array of `float64`: an array as it is, or one made from a list or what NumPy takes for an array.
fn doubles<'py>(name: &str, value: &Bound<'py, PyAny>) -> PyResult<Array<'py>> {
    without_mask(name, value)?;
    if let Ok(array) = value.cast::<PyArrayDyn<f64>>() {
        return Ok(array.clone());
    }
    let py = value.py();
    let mut found = value.clone();
    if !value.is_instance_of::<PyUntypedArray>() {
        let numpy = py.import("numpy")?;
        found = numpy.call_method1("asarray", (value,))?;
        let of_python = value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>();
        // Whole numbers in a list are as Python prints them; an array of them is a decision of its owner.
        if of_python
            && found
                .getattr("dtype")?
                .getattr("kind")?
                .extract::<String>()?
                == "i"
        {
            found = found.call_method1("astype", ("float64",))?;
        }
    }
    match found.cast::<PyArrayDyn<f64>>() {
        Ok(array) => Ok(array.clone()),
        Err(_) => {
            let what = kind(&found)?;
            Err(PyTypeError::new_err(format!(
                "`{name}` is {what}: bgdyn computes in float64 and converts no arrays; `{name}.astype(numpy.float64)` does"
            )))
        }
    }
}

/// Returns what a value is: "an array of float32".
fn kind(value: &Bound<'_, PyAny>) -> PyResult<String> {
    match value.cast::<PyUntypedArray>() {
        Ok(array) => Ok(format!("an array of {}", array.dtype())),
        Err(_) => Ok(format!("of type {}", value.get_type().name()?)),
    }
}

/// Returns a copy that is row by row in memory.
fn contiguous<'py>(array: &Array<'py>) -> PyResult<Array<'py>> {
    let py = array.py();
    let options = PyDict::new(py);
    options.set_item("requirements", "CA")?;
    let copy = py
        .import("numpy")?
        .call_method("require", (array,), Some(&options))?;
    Ok(copy.cast_into::<PyArrayDyn<f64>>()?)
}
