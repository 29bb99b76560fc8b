//! A mechanism with the values of its run-time parameters, as a Python object.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::Arc;

use bgdyn_cli::graph::mechanism_svg;
use bgdyn_cli::spec_file::SpecFile;
use bgdyn_codegen::mechanism::Motion;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::{Options, formulation_named, preference_named};
use bgdyn_runtime::Dd;
use numpy::{PyArray1, PyArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::{PyAttributeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::arrays::{Array, read, unravelled, writable};
use crate::errors::{Singular, refused, spec_error};
use crate::method::PyMethod;
use crate::spec::{ModelData, Spec};

/// A model: a mechanism with the values of its run-time parameters. It does not change.
#[pyclass(frozen, module = "bgdyn", name = "Model")]
#[derive(Debug)]
pub struct Model {
    data: ModelData,
    /// Warnings of the check.
    warnings: Arc<str>,
}

#[pymethods]
impl Model {
    #[new]
    #[pyo3(signature = (text, name, shown=None, formulation=None, prefer="operations", parameters=None))]
    fn new(
        py: Python<'_>,
        text: String,
        name: String,
        shown: Option<String>,
        formulation: Option<String>,
        prefer: &str,
        parameters: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let named = formulation.as_deref().map(formulation_named).transpose();
        let options = Options {
            formulation: named.map_err(PyValueError::new_err)?,
            prefer: preference_named(prefer).map_err(PyValueError::new_err)?,
            verify: false,
            ..Options::default()
        };
        let file = SpecFile {
            path: shown.unwrap_or_else(|| "<text>".into()).into(),
            text,
            stem: name,
        };
        if let Some(fault) = file.urdf() {
            let shown = file.path.display().to_string();
            return Err(spec_error(
                py,
                &format!("{}; or load(urdf=\"{shown}\")", fault.headline(&shown)),
            ));
        }
        if file.is_scene() {
            let shown = file.path.display();
            return Err(spec_error(
                py,
                &format!("{shown} is a scene: see bgdyn.Scene"),
            ));
        }
        let (mechanism, faults) = py.detach(|| file.read());
        let Some(mechanism) = mechanism else {
            return Err(refused(py, &file, &faults));
        };
        let warnings = file.render(&faults);
        let choice = (formulation, prefer.to_owned());
        let defaults = mechanism.parameters().iter().map(|p| p.default.to_f64());
        let parameters_of_file = defaults.collect();
        let spec = Spec::new((file.text, file.stem), mechanism, choice, options);
        spec.checked().map_err(PyValueError::new_err)?;
        let model = Model {
            data: ModelData {
                spec: Arc::new(spec),
                parameters: parameters_of_file,
            },
            warnings: warnings.into(),
        };
        model.with_parameters(parameters)
    }

    /// The model with these values of run-time parameters, SI units.
    #[pyo3(signature = (**parameters))]
    fn with_parameters(&self, parameters: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let all = self.data.spec.mechanism.parameters();
        let mut values = self.data.parameters.to_vec();
        for (name, value) in parameters.into_iter().flatten() {
            let (name, value): (String, f64) = (name.extract()?, value.extract()?);
            let found = all.iter().position(|p| p.name == name);
            let found = found.ok_or_else(|| {
                let known: Vec<&str> = all.iter().map(|p| p.name.as_str()).collect();
                PyValueError::new_err(match known.as_slice() {
                    [] => format!("no parameter `{name}`: the spec has none"),
                    known => format!("no parameter `{name}`; there are {}", known.join(", ")),
                })
            })?;
            if !value.is_finite() {
                return Err(PyValueError::new_err(format!("`{name}` is {value}")));
            }
            values[found] = value;
        }
        Ok(Model {
            data: ModelData {
                spec: Arc::clone(&self.data.spec),
                parameters: values.into(),
            },
            warnings: Arc::clone(&self.warnings),
        })
    }

    #[getter]
    fn name(&self) -> &str {
        &self.data.spec.name
    }

    #[getter]
    fn text(&self) -> &str {
        &self.data.spec.text
    }

    #[getter]
    fn nq(&self) -> usize {
        self.data.spec.mechanism.nq()
    }

    #[getter]
    fn nv(&self) -> usize {
        self.data.spec.sizes().nv
    }

    #[getter]
    fn joint_names<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.data.spec.graph.coordinates.iter().map(|c| &c.name))
    }

    #[getter]
    fn position_names<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.data.spec.mechanism.position_names())
    }

    /// The joints of the open tree of a mechanism with loops; otherwise those of `joint_names`.
    #[getter]
    fn tree_joint_names<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let closed = self.data.spec.graph.closed.as_deref();
        let all = closed.map_or(&self.data.spec.graph.coordinates, |c| &c.tree.coordinates);
        PyTuple::new(py, all.iter().map(|c| &c.name))
    }

    #[getter]
    fn constraint_names<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let closed = self.data.spec.graph.closed.iter();
        let rows = closed.flat_map(|c| c.closure.rows.iter().map(|row| c.closure.row_name(row)));
        PyTuple::new(py, rows.collect::<Vec<_>>())
    }

    /// The links and frames X of `pose_X`, `velocity_X`, `jacobian_world_X`, `jacobian_dot_v_world_X`.
    #[getter]
    fn frame_names<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.data.spec.graph.sites.iter().map(|s| &s.name))
    }

    /// The values of the run-time parameters, SI units.
    #[getter]
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let found = PyDict::new(py);
        let all = self.data.spec.mechanism.parameters().iter();
        for (parameter, value) in all.zip(self.data.parameters.iter()) {
            found.set_item(&parameter.name, value)?;
        }
        Ok(found)
    }

    /// The names of all methods.
    #[getter]
    fn methods<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.method_names())
    }

    #[getter]
    fn _warnings(&self) -> &str {
        &self.warnings
    }

    /// Counts of the operations of a method's function.
    fn operations<'py>(&self, py: Python<'py>, method: &str) -> PyResult<Bound<'py, PyDict>> {
        let method = self.method(method)?;
        let prepared = py.detach(|| self.data.spec.prepared(method));
        let count = prepared.map_err(PyValueError::new_err)?.operations;
        let found = PyDict::new(py);
        let all = [
            ("mul", count.mul),
            ("add", count.add),
            ("div", count.div),
            ("sqrt", count.sqrt),
            ("sincos", count.sincos),
            ("other", count.other),
        ];
        for (name, number) in all {
            found.set_item(name, number)?;
        }
        Ok(found)
    }

    /// The Rust source text of a module with this method.
    fn source(&self, py: Python<'_>, method: &str) -> PyResult<String> {
        let method = self.method(method)?;
        let text = py.detach(|| self.data.spec.source(method));
        text.map_err(PyValueError::new_err)
    }

    /// q with every coordinate zero and every quaternion (0, 0, 0, 1); with loops their closed start.
    fn neutral<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        if let Some(closure) = self.data.spec.mechanism.closure() {
            let start = closure.start.iter().map(|x| x.to_f64());
            return PyArray1::from_vec(py, start.collect());
        }
        let mut q = vec![0.0; self.data.spec.mechanism.nq()];
        for joint in self.data.spec.mechanism.compound_joints() {
            let Motion::Compound(motion) = joint.kind.motion else {
                continue;
            };
            for (part, at) in motion.positions.iter().zip(&joint.degrees.positions) {
                q[at.0] = f64::from(part.neutral);
            }
        }
        PyArray1::from_vec(py, q)
    }

    /// q with the dependent positions changed so that all loops close.
    fn close<'py>(&self, py: Python<'py>, q: &Bound<'py, PyAny>) -> PyResult<Array<'py>> {
        let Some(closure) = self.data.spec.mechanism.closure() else {
            return Err(PyValueError::new_err("the mechanism has no loops"));
        };
        let nq = self.nq();
        let from = read("q", q, nq)?;
        let closed = PyArrayDyn::zeros(py, from.shape(), false);
        let mut write = writable(&closed)?;
        let (from_all, to_all) = (from.as_slice()?, write.as_slice_mut()?);
        let open = py.detach(|| {
            let states = from_all.chunks_exact(nq).zip(to_all.chunks_exact_mut(nq));
            let mut open = states.enumerate().filter_map(|(k, (from, to))| {
                let mut exact: Vec<Dd> = from.iter().map(|&x| Dd::from_f64(x)).collect();
                let closes = closure.close(&mut exact);
                to.iter_mut().zip(exact).for_each(|(x, y)| *x = y.to_f64());
                (!closes).then_some(k)
            });
            // All states are computed before the first open one is reported.
            let first = open.next();
            open.for_each(drop);
            first
        });
        drop(write);
        match open {
            None => Ok(closed),
            Some(k) => {
                let batch = &from.shape()[..from.shape().len() - 1];
                let index = unravelled(k, batch);
                let error = Singular::new(index, "the loops do not close from these positions");
                Err(error.raised(py))
            }
        }
    }

    fn __getattr__(slf: &Bound<'_, Self>, name: &str) -> PyResult<PyMethod> {
        let data = &slf.get().data;
        let method = data.spec.method(name).map_err(PyAttributeError::new_err)?;
        Ok(PyMethod::new(
            slf.as_any().clone().unbind(),
            data.clone(),
            method,
        ))
    }

    fn __dir__(slf: &Bound<'_, Self>) -> PyResult<Vec<String>> {
        let object = slf.py().import("builtins")?.getattr("object")?;
        let own: Vec<String> = object.call_method1("__dir__", (slf,))?.extract()?;
        Ok(own.into_iter().chain(slf.get().method_names()).collect())
    }

    fn __repr__(&self) -> String {
        let joints: Vec<&str> = self
            .data
            .spec
            .graph
            .coordinates
            .iter()
            .map(|c| c.name.as_str())
            .collect();
        format!(
            "<bgdyn.Model {}: NQ {}, NV {}: {}>",
            self.data.spec.name,
            self.nq(),
            self.nv(),
            joints.join(", ")
        )
    }

    fn _repr_html_(&self) -> String {
        mechanism_svg(&self.data.spec.mechanism)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let class = py.get_type::<Model>();
        let spec = &self.data.spec;
        let arguments = (
            &spec.text,
            &spec.name,
            None::<&str>,
            spec.choice.0.as_deref(),
            &spec.choice.1,
            self.parameters(py)?,
        );
        (class, arguments).into_pyobject(py)
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.data.same(&other.data)
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        (
            &self.data.spec.text,
            &self.data.spec.name,
            &self.data.spec.choice,
        )
            .hash(&mut hasher);
        hasher.finish()
    }
}

impl Model {
    fn method(&self, name: &str) -> PyResult<Method> {
        self.data.spec.method(name).map_err(PyValueError::new_err)
    }

    fn method_names(&self) -> Vec<String> {
        let all = Method::possible_of(&self.data.spec.graph);
        all.into_iter().map(|m| self.data.spec.name_of(m)).collect()
    }
}
