//! A method of a model as a Python object that can be called: arrays in, arrays out.

use std::sync::Arc;

use bgdyn_codegen::method::{Argument, Method};
use numpy::{PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::arrays::{Array, checked_threads, leading_shape, read, unravelled, writable};
use crate::batch::{Batch, Given, Refusal};
use crate::documentation;
use crate::errors::{OnSingular, Singular};
use crate::interrupt::Interrupt;
use crate::results::{mask, result, targets};
use crate::spec::{Cause, ModelData, Prepared};

/// A method of a model, `arm.pose_tool`: arrays in, arrays out.
///
/// Every argument has the shape (n,), or (..., n) for many states; all leading shapes are the same, and an argument
/// without one is shared by all states. Arrays are float64, and are never converted.
///
/// out: receives the result; an array, or a tuple of arrays for results with several.
/// threads: number of threads that share the states.
/// on_singular: "raise" raises bgdyn.SingularError for the first singular state; with "nan" singular states are NaN, and
/// the call returns (result, mask).
#[pyclass(frozen, module = "bgdyn", name = "Method")]
#[derive(Debug)]
pub struct PyMethod {
    /// The object whose method it is.
    model: Py<PyAny>,
    data: ModelData,
    method: Method,
    #[pyo3(get)]
    name: String,
}

/// The arguments of a call, as arrays.
struct Arguments<'py> {
    arrays: Vec<(Argument, PyReadonlyArrayDyn<'py, f64>)>,
    /// The leading shape.
    batch: Vec<usize>,
}

#[pymethods]
impl PyMethod {
    #[pyo3(signature = (*args, out=None, threads=1, on_singular="raise", **named))]
    fn __call__<'py>(
        &self,
        py: Python<'py>,
        args: &Bound<'py, PyTuple>,
        out: Option<&Bound<'py, PyAny>>,
        threads: i64,
        on_singular: &str,
        named: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let on_singular = OnSingular::named(on_singular)?;
        let threads = checked_threads(threads)?;
        let arguments = self.arguments(args, named)?;
        let prepared = self.prepared(py)?;
        let arrays = targets(py, &prepared.parts, &arguments.batch, out)?;
        let refused = self.compute(py, &prepared, &arguments, &arrays, threads)?;
        if let (Some(first), OnSingular::Raise) = (refused.first(), on_singular) {
            return Err(self.singular(first, &arguments.batch).raised(py));
        }
        let result = result(py, &prepared.parts, arrays, out.is_some())?;
        match on_singular {
            OnSingular::Raise => Ok(result),
            OnSingular::Nan => {
                let mask = mask(py, refused.iter().map(|one| one.state), &arguments.batch)?;
                Ok((result, mask).into_pyobject(py)?.into_any())
            }
        }
    }

    /// The names of the arguments.
    #[getter]
    #[pyo3(name = "arguments")]
    fn argument_names<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.method.arguments().iter().map(|a| a.name()))
    }

    /// Its name, as functions have it.
    #[getter]
    fn __name__(&self) -> &str {
        &self.name
    }

    /// What the result is.
    #[getter]
    fn summary(&self) -> String {
        documentation::summary(self.method, &self.data.spec.graph.sites)
    }

    /// What `help` prints of it.
    #[getter]
    fn _documentation(&self) -> String {
        documentation::of(&self.data.spec, self.method)
    }

    /// The units of the result.
    #[getter]
    fn units(&self) -> &'static str {
        self.method.units()
    }

    /// Name of the formulation that computes it.
    #[getter]
    fn formulation(&self, py: Python<'_>) -> PyResult<String> {
        Ok(self.prepared(py)?.formulation.clone())
    }

    fn __repr__(&self) -> String {
        let arguments: Vec<String> = self
            .method
            .arguments()
            .iter()
            .map(|a| self.typed(*a))
            .collect();
        format!(
            "<{}({}) of {}: {} {}>",
            self.name,
            arguments.join(", "),
            self.data.spec.name,
            self.summary(),
            self.units()
        )
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let getattr = py.import("builtins")?.getattr("getattr")?;
        (getattr, (&self.model, &self.name)).into_pyobject(py)
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.name == other.name && self.data.same(&other.data)
    }
}

impl PyMethod {
    /// Returns a method of the object `model` with this data.
    pub fn new(model: Py<PyAny>, data: ModelData, method: Method) -> Self {
        PyMethod {
            name: data.spec.name_of(method),
            model,
            data,
            method,
        }
    }

    fn typed(&self, argument: Argument) -> String {
        format!("{}: ({},)", argument.name(), self.data.spec.width(argument))
    }

    fn prepared(&self, py: Python<'_>) -> PyResult<Arc<Prepared>> {
        let spec = &self.data.spec;
        let found = py.detach(|| spec.prepared(self.method));
        found.map_err(PyValueError::new_err)
    }

    /// Reads the arguments of a call.
    fn arguments<'py>(
        &self,
        args: &Bound<'py, PyTuple>,
        named: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Arguments<'py>> {
        let wanted = self.method.arguments();
        let (mut arrays, mut batch) = (Vec::new(), Vec::new());
        let mut found = args.len();
        for (k, &argument) in wanted.iter().enumerate() {
            let name = argument.name();
            let value = match (args.get_item(k).ok(), named) {
                (Some(value), _) => value,
                (None, Some(named)) => match named.get_item(name)? {
                    Some(value) => {
                        found += 1;
                        value
                    }
                    None => return Err(self.wrong_arguments()),
                },
                (None, None) => return Err(self.wrong_arguments()),
            };
            let array = read(name, &value, self.data.spec.width(argument))?;
            batch = leading_shape(name, batch, array.shape())?;
            arrays.push((argument, array));
        }
        // Superfluous arguments, by place or by name.
        if found != wanted.len() || found != args.len() + named.map_or(0, |n| n.len()) {
            return Err(self.wrong_arguments());
        }
        Ok(Arguments { arrays, batch })
    }

    fn wrong_arguments(&self) -> PyErr {
        let names: Vec<&str> = self.method.arguments().iter().map(|a| a.name()).collect();
        PyTypeError::new_err(format!(
            "the arguments are {}({}), and by name out, threads, on_singular",
            self.name,
            names.join(", ")
        ))
    }

    /// Computes all states, without the interpreter's lock. Returns the refused ones.
    fn compute(
        &self,
        py: Python<'_>,
        prepared: &Prepared,
        arguments: &Arguments<'_>,
        arrays: &[Array<'_>],
        threads: usize,
    ) -> PyResult<Vec<Refusal>> {
        let mut given = Vec::new();
        for (argument, array) in &arguments.arrays {
            given.push(Given {
                argument: *argument,
                values: array.as_slice()?,
                width: self.data.spec.width(*argument),
                shared: array.shape().len() == 1,
            });
        }
        let mut writes = Vec::new();
        for array in arrays {
            writes.push(writable(array)?);
        }
        let mut out = Vec::new();
        for write in &mut writes {
            out.push(write.as_slice_mut()?);
        }
        let batch = Batch {
            call: &*prepared.call,
            lanes: &prepared.lanes,
            given: &given,
            parameters: &self.data.parameters,
            parts: &prepared.parts.arrays,
        };
        let count = arguments.batch.iter().product();
        let interrupt = Interrupt::default();
        let refused = py.detach(|| batch.compute(count, threads, out, &interrupt));
        interrupt.finished()?;
        Ok(refused)
    }

    /// Returns the error of a refused state.
    fn singular(&self, refusal: &Refusal, batch: &[usize]) -> Singular {
        let index = unravelled(refusal.state, batch);
        match self.data.spec.cause(self.method, refusal.pivot) {
            Cause::Joint(name) => Singular {
                joint: Some(name.clone()),
                ..Singular::new(
                    index,
                    &format!(
                        "singular mass matrix: joint `{name}` has no inertia left to accelerate"
                    ),
                )
            },
            Cause::Loop(name) => Singular {
                closes: Some(name.clone()),
                ..Singular::new(
                    index,
                    &format!(
                        "the loop `{name}` is at a singular position, or on another branch than that of the start"
                    ),
                )
            },
            Cause::OutOfReach(name) => Singular {
                closes: Some(name.clone()),
                ..Singular::new(
                    index,
                    &format!("the loop `{name}` is out of reach, or at the end of its reach"),
                )
            },
            Cause::Posture(name) => Singular::new(
                index,
                &format!(
                    "no operational inertia: the direction `{name}` cannot be accelerated here, the posture is singular"
                ),
            ),
            Cause::NotActuated(name) => Singular {
                joint: Some(name.clone()),
                ..Singular::new(
                    index,
                    &format!(
                        "no efforts of the actuated joints: `{name}` does not follow the actuated joints here"
                    ),
                )
            },
        }
    }
}
