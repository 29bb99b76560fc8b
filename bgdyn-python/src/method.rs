//! A method of a model as a Python object that can be called: arrays in, arrays out.

use std::sync::Arc;

use bgdyn_codegen::method::{Argument, Method};
use numpy::{PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::arrays::{Array, read, shown, target, writable};
use crate::batch::{Batch, Given, Refusal};
use crate::errors::Singular;
use crate::model::Model;
use crate::spec::{Cause, Prepared};

/// A method of a model.
#[pyclass(frozen, module = "bgdyn", name = "Method")]
#[derive(Debug)]
pub struct PyMethod {
    model: Model,
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

/// What happens at singular states.
#[derive(Clone, Copy, PartialEq, Eq)]
enum OnSingular {
    Raise,
    Nan,
}

#[pymethods]
impl PyMethod {
    #[pyo3(signature = (*args, out=None, threads=1, on_singular="raise", **named))]
    fn __call__<'py>(
        &self,
        py: Python<'py>,
        args: &Bound<'py, PyTuple>,
        out: Option<&Bound<'py, PyAny>>,
        threads: usize,
        on_singular: &str,
        named: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let on_singular = OnSingular::named(on_singular)?;
        if threads == 0 {
            return Err(PyValueError::new_err("`threads` is at least 1"));
        }
        let arguments = self.arguments(args, named)?;
        let prepared = self.prepared(py)?;
        let arrays = targets(py, &prepared, &arguments.batch, out)?;
        let refused = self.compute(py, &prepared, &arguments, &arrays, threads)?;
        if let (Some(first), OnSingular::Raise) = (refused.first(), on_singular) {
            return Err(self.singular(first, &arguments.batch).raised(py));
        }
        let result = result(py, &prepared, arrays)?;
        match on_singular {
            OnSingular::Raise => Ok(result),
            OnSingular::Nan => {
                let mask = mask(py, &refused, &arguments.batch)?;
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

    /// What the result is.
    #[getter]
    fn summary(&self) -> String {
        self.method.summary(&self.model.spec.graph.sites)
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
        let arguments: Vec<String> = self.method.arguments().iter().map(|a| self.typed(*a)).collect();
        format!(
            "<{}({}) of {}: {} {}>",
            self.name,
            arguments.join(", "),
            self.model.spec.name,
            self.summary(),
            self.units()
        )
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (Model, String))> {
        let getattr = py.import("builtins")?.getattr("getattr")?;
        Ok((getattr, (self.model.clone(), self.name.clone())))
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.name == other.name && self.model.same(&other.model)
    }
}

impl PyMethod {
    /// Returns a method of a model.
    pub fn new(model: Model, method: Method) -> Self {
        PyMethod {
            name: model.spec.name_of(method),
            model,
            method,
        }
    }

    fn typed(&self, argument: Argument) -> String {
        format!("{}: ({},)", argument.name(), self.model.spec.width(argument))
    }

    fn prepared(&self, py: Python<'_>) -> PyResult<Arc<Prepared>> {
        let spec = &self.model.spec;
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
            let array = read(name, &value, self.model.spec.width(argument))?;
            let leading = &array.shape()[..array.shape().len() - 1];
            if batch.is_empty() {
                batch = leading.to_vec();
            } else if !leading.is_empty() && leading != batch {
                let (own, others) = (shown(leading), shown(&batch));
                return Err(PyValueError::new_err(format!(
                    "`{name}` has the leading shape {own}, the arguments before it {others}: give all the same, or one state for all"
                )));
            }
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
                width: self.model.spec.width(*argument),
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
            given: &given,
            parameters: &self.model.parameters,
            parts: &prepared.parts.arrays,
        };
        let count = arguments.batch.iter().product();
        Ok(py.detach(|| batch.compute(count, threads, out)))
    }

    /// Returns the error of a refused state.
    fn singular(&self, refusal: &Refusal, batch: &[usize]) -> Singular {
        let index = unravelled(refusal.state, batch);
        let place = match batch {
            [] => String::new(),
            _ => format!("state {}: ", shown(&index)),
        };
        let (what, joint, closes) = match self.model.spec.cause(self.method, refusal.pivot) {
            Cause::Joint(name) => (
                format!("singular mass matrix: joint `{name}` has no inertia left to accelerate"),
                Some(name),
                None,
            ),
            Cause::Loop(name) => (
                format!(
                    "the loop `{name}` is at a singular position, or on another branch than that of the start"
                ),
                None,
                Some(name),
            ),
            Cause::NotActuated(name) => (
                format!(
                    "no efforts of the actuated joints: `{name}` does not follow the actuated joints here"
                ),
                Some(name),
                None,
            ),
        };
        Singular {
            message: place + &what,
            index,
            joint,
            closes,
        }
    }
}

impl OnSingular {
    fn named(name: &str) -> PyResult<Self> {
        match name {
            "raise" => Ok(OnSingular::Raise),
            "nan" => Ok(OnSingular::Nan),
            _ => Err(PyValueError::new_err(format!(
                "on_singular=\"{name}\": it is \"raise\" or \"nan\""
            ))),
        }
    }
}

/// Returns the arrays of a result: new ones, or those of `out`.
fn targets<'py>(
    py: Python<'py>,
    prepared: &Prepared,
    batch: &[usize],
    out: Option<&Bound<'py, PyAny>>,
) -> PyResult<Vec<Array<'py>>> {
    let parts = &prepared.parts;
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
    each.map(|(k, out)| target(py, Some(&out), &shape(k))).collect()
}

/// Returns what a call returns: a number, an array, or several arrays with their names.
fn result<'py>(
    py: Python<'py>,
    prepared: &Prepared,
    arrays: Vec<Array<'py>>,
) -> PyResult<Bound<'py, PyAny>> {
    if let Some(class) = prepared.parts.class {
        let class = py.import("bgdyn._results")?.getattr(class)?;
        return class.call1(PyTuple::new(py, arrays)?);
    }
    let [array] = &arrays[..] else {
        return Err(PyTypeError::new_err("several arrays without names"));
    };
    Ok(array.as_any().clone())
}

/// Returns where a batch is singular; one bool for a single state.
fn mask<'py>(py: Python<'py>, refused: &[Refusal], batch: &[usize]) -> PyResult<Bound<'py, PyAny>> {
    let mask = PyArrayDyn::<bool>::zeros(py, batch, false);
    let mut write = mask.readwrite();
    let entries = write.as_slice_mut()?;
    refused.iter().for_each(|one| entries[one.state] = true);
    drop(write);
    Ok(mask.into_any())
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
