//! Functions of positions at many states: arrays in, arrays out.

use numpy::{PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::arrays::{checked_threads, leading_shape, read, target, unravelled, writable};
use crate::errors::{OnSingular, Singular};
use crate::interrupt::Interrupt;
use crate::positions::{Found, Open, Positions};
use crate::results::mask;
use crate::spec::ModelData;
use crate::threads::in_threads;

/// Number of states between two questions whether to leave off: closing loops takes 0.1 ms a state.
const ASKING: usize = 8;

/// An argument: its name, its value, and the number of its components.
pub type Argument<'a, 'py> = (&'static str, &'a Bound<'py, PyAny>, usize);

/// How a call is made.
pub struct Way<'a, 'py> {
    /// The array for the result, if it is the caller's.
    pub out: Option<&'a Bound<'py, PyAny>>,
    /// Number of threads.
    pub threads: i64,
    /// What happens where loops do not close.
    pub on_singular: &'a str,
}

impl<'a, 'py> Way<'a, 'py> {
    /// Returns that of a call.
    pub fn new(out: Option<&'a Bound<'py, PyAny>>, threads: i64, on_singular: &'a str) -> Self {
        Way {
            out,
            threads,
            on_singular,
        }
    }

    /// Returns that of a call that refuses no state.
    pub fn plain(out: Option<&'a Bound<'py, PyAny>>, threads: i64) -> Self {
        Way::new(out, threads, "raise")
    }
}

/// A state where loops do not close.
type Refused = (usize, Open);

/// Computes `compute` at each state; the result has `width` components.
///
/// # Errors
/// `TypeError` and `ValueError` for arguments, `bgdyn.SingularError` for the first state whose loops do not close. A
/// state with an argument that is NaN or infinite is not refused: its result is NaN.
pub fn each_state<'py>(
    py: Python<'py>,
    data: &ModelData,
    arguments: &[Argument<'_, 'py>],
    width: usize,
    way: &Way<'_, 'py>,
    compute: impl Fn(&Positions<'_>, &[&[f64]]) -> Found + Sync,
) -> PyResult<Bound<'py, PyAny>> {
    let on_singular = OnSingular::named(way.on_singular)?;
    let threads = checked_threads(way.threads)?;
    let (mut arrays, mut batch): (Vec<PyReadonlyArrayDyn<'py, f64>>, _) = (vec![], vec![]);
    for (name, value, width) in arguments {
        let array = read(name, value, *width)?;
        batch = leading_shape(name, batch, array.shape())?;
        arrays.push(array);
    }
    let result = target(py, way.out, &[&batch[..], &[width]].concat())?;
    let mut write = writable(&result)?;
    let out = write.as_slice_mut()?;
    let mut given = Vec::new();
    for array in &arrays {
        given.push((array.as_slice()?, array.shape().len() == 1));
    }
    let positions = py.detach(|| Positions::new(data));
    let positions = positions.map_err(PyValueError::new_err)?;
    let widths: Vec<usize> = arguments.iter().map(|(.., width)| *width).collect();
    let one = |state: usize, out: &mut [f64]| -> Option<Refused> {
        let own = given
            .iter()
            .zip(&widths)
            .map(|(&(values, shared), &width)| {
                let first = if shared { 0 } else { state * width };
                &values[first..first + width]
            });
        let own: Vec<&[f64]> = own.collect();
        match compute(&positions, &own) {
            Ok(found) => {
                out.copy_from_slice(&found);
                None
            }
            Err(open) => {
                out.fill(f64::NAN);
                let finite = own.iter().flat_map(|x| x.iter()).all(|x| x.is_finite());
                finite.then_some((state, open))
            }
        }
    };
    let interrupt = Interrupt::default();
    let refused = py.detach(|| shared(out, width, threads, &interrupt, one));
    interrupt.finished()?;
    drop(write);
    match (on_singular, refused.first()) {
        (OnSingular::Nan, _) => {
            let mask = mask(py, refused.iter().map(|(state, _)| *state), &batch)?;
            Ok((result, mask).into_pyobject(py)?.into_any())
        }
        (OnSingular::Raise, None) => Ok(result.into_any()),
        (OnSingular::Raise, Some(&(state, open))) => {
            Err(singular(data, unravelled(state, &batch), open).raised(py))
        }
    }
}

/// Returns numbers in [0, 1) of the shape (n, width), (n…, width) or (width,), by `numpy.random.default_rng(seed)`.
///
/// # Errors
/// What NumPy raises for such a seed, `TypeError` if `n` is neither a number nor a shape, `ValueError` if it is negative.
pub fn random_numbers<'py>(
    py: Python<'py>,
    n: Option<&Bound<'py, PyAny>>,
    width: usize,
    seed: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let mut shape = n.map_or(Ok(vec![]), leading)?;
    shape.push(width);
    let generator = py.import("numpy.random")?;
    let generator = generator.call_method1("default_rng", (seed,))?;
    generator.call_method1("random", (PyTuple::new(py, shape)?,))
}

/// Reads the number of positions to sample, or their leading shape.
fn leading(n: &Bound<'_, PyAny>) -> PyResult<Vec<usize>> {
    let read: PyResult<Vec<i64>> = n.extract().map(|n| vec![n]).or_else(|_| n.extract());
    let shown = n.repr()?;
    let axes = read.map_err(|_| {
        PyTypeError::new_err(format!(
            "`n` is {shown}: a number of positions is expected, or a shape"
        ))
    })?;
    let sizes: Result<Vec<usize>, _> = axes.into_iter().map(usize::try_from).collect();
    sizes.map_err(|_| {
        PyValueError::new_err(format!(
            "`n` is {shown}: a number of positions is 0 or more"
        ))
    })
}

/// Computes the states of `out`, which have `width` numbers each, and returns the refused ones in their order.
fn shared(
    out: &mut [f64],
    width: usize,
    threads: usize,
    interrupt: &Interrupt,
    one: impl Fn(usize, &mut [f64]) -> Option<Refused> + Sync,
) -> Vec<Refused> {
    let count = out.len().checked_div(width).unwrap_or(0);
    if count == 0 {
        return vec![];
    }
    let share = count.div_ceil(threads.min(count));
    let part = |(part, out): (usize, &mut [f64]), ends: &dyn Fn() -> bool| -> Vec<Refused> {
        let mut refused = vec![];
        for (k, out) in out.chunks_exact_mut(width).enumerate() {
            if k % ASKING == ASKING - 1 && ends() {
                break;
            }
            refused.extend(one(part * share + k, out));
        }
        refused
    };
    let parts = out.chunks_mut(share * width).enumerate().collect();
    in_threads(parts, interrupt, part).concat()
}

fn singular(data: &ModelData, index: Vec<usize>, open: Open) -> Singular {
    let loops = data.spec.mechanism.closure().map(|closure| &closure.loops);
    let name = open.0.zip(loops).map(|(k, loops)| loops[k].name.clone());
    let message = match &name {
        Some(name) => format!(
            "the loops do not close from here: `{name}` is out of reach, or at a singular position"
        ),
        None => "the loops do not close on the branch of the given position".to_owned(),
    };
    Singular {
        closes: name,
        ..Singular::new(index, &message)
    }
}
