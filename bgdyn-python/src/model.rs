//! A mechanism with the values of its run-time parameters, as a Python object.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::Arc;

use bgdyn_cli::graph::mechanism_svg;
use bgdyn_cli::spec_file::SpecFile;
use bgdyn_codegen::method::{Method, Regressor};
use numpy::PyArray1;
use pyo3::exceptions::{PyAttributeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict, PyTuple};

use crate::arrays::numbers_by_name;
use crate::documentation;
use crate::method::PyMethod;
use crate::opening::opened;
use crate::position_calls::{Way, each_state, random_numbers};
use crate::positions::Positions;
use crate::source::SourceRequest;
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
        let file = SpecFile {
            path: shown.unwrap_or_else(|| "<text>".into()).into(),
            text,
            stem: name,
            mechanism: None,
        };
        let (spec, warnings) = opened(py, file, (formulation, prefer.to_owned()))?;
        let defaults = spec.mechanism.parameters().iter();
        let parameters_of_file = defaults.map(|p| p.default.to_f64()).collect();
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
        let given = parameters.map_or(Ok(vec![]), numbers_by_name)?;
        let data = self.data.with_parameters(&given);
        Ok(Model {
            data: data.map_err(PyValueError::new_err)?,
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

    /// The pairs that may touch, in the order of the methods of contacts.
    #[getter]
    fn contact_names<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.data.spec.contact_names())
    }

    /// The links, parents before children: the order of `joint_reactions`.
    #[getter]
    fn link_names<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.data.spec.link_names())
    }

    /// The loops and contacts, in the order of `reactions`.
    #[getter]
    fn reaction_names<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.data.spec.reaction_names())
    }

    /// The joints of `actuated` in the file.
    #[getter]
    fn actuated_names<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.data.spec.mechanism.actuated_names())
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

    /// The engine that computes the methods: always "tape", lists of operations without a compiler. Python has no
    /// machine code.
    #[getter]
    fn engine(&self) -> &'static str {
        Spec::engine()
    }

    /// The generated code, as `bgdyn generate` writes it: of one method, of a list of methods, or of those that the
    /// command chooses.
    ///
    /// bundles: {name: [method, ...]}, several methods as one function.
    /// backend: "rust" returns the text of a module, "c" a dictionary of file names and texts.
    /// options: {name: text}, those of `bgdyn generate --option`, such as {"float": "float"} for C.
    ///
    /// The functions are compared with equation (6) first. Run-time parameters remain parameters, with the file's values
    /// as defaults.
    #[pyo3(signature = (method=None, *, bundles=None, backend="rust", options=None))]
    fn source<'py>(
        &self,
        py: Python<'py>,
        method: Option<&Bound<'py, PyAny>>,
        bundles: Option<&Bound<'py, PyAny>>,
        backend: &str,
        options: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let asked = SourceRequest::new(method, bundles, backend, options)?;
        let files = py.detach(|| asked.files(&self.data.spec));
        let files = files.map_err(PyValueError::new_err)?;
        if let [file] = files.as_slice() {
            return Ok(file.text.as_str().into_pyobject(py)?.into_any());
        }
        let texts = files.iter().map(|file| (&file.name, &file.text));
        Ok(texts.into_py_dict(py)?.into_any())
    }

    /// q with every coordinate zero and every quaternion (0, 0, 0, 1); with loops or wheels their start.
    fn neutral<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let positions = Positions::new(&self.data).map_err(PyValueError::new_err)?;
        Ok(PyArray1::from_vec(py, positions.neutral()))
    }

    /// q with the dependent positions changed so that all loops close.
    #[pyo3(signature = (q, *, out=None, threads=1, on_singular="raise"))]
    fn close<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
        threads: i64,
        on_singular: &str,
    ) -> PyResult<Bound<'py, PyAny>> {
        if self.data.spec.mechanism.closure().is_none() {
            return Err(PyValueError::new_err("the mechanism has no loops"));
        }
        let way = Way::new(out, threads, on_singular);
        let given = [("q", q, self.nq())];
        let one = |of: &Positions<'_>, x: &[&[f64]]| of.close(x[0]);
        each_state(q.py(), &self.data, &given, self.nq(), &way, one)
    }

    /// q after the constant velocities `dv` for one unit of time.
    #[pyo3(signature = (q, dv, *, out=None, threads=1, on_singular="raise"))]
    fn integrate<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        dv: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
        threads: i64,
        on_singular: &str,
    ) -> PyResult<Bound<'py, PyAny>> {
        let way = Way::new(out, threads, on_singular);
        let given = [("q", q, self.nq()), ("dv", dv, self.nv())];
        let one = |of: &Positions<'_>, x: &[&[f64]]| of.integrate(x[0], x[1]);
        each_state(q.py(), &self.data, &given, self.nq(), &way, one)
    }

    /// The displacement from q0 to q1.
    #[pyo3(signature = (q1, q0, *, out=None, threads=1))]
    fn difference<'py>(
        &self,
        q1: &Bound<'py, PyAny>,
        q0: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
        threads: i64,
    ) -> PyResult<Bound<'py, PyAny>> {
        let given = [("q1", q1, self.nq()), ("q0", q0, self.nq())];
        let one = |of: &Positions<'_>, x: &[&[f64]]| Ok(of.difference(x[0], x[1]));
        let way = Way::plain(out, threads);
        each_state(q1.py(), &self.data, &given, self.nv(), &way, one)
    }

    /// q̇ = N(q) v.
    #[pyo3(signature = (q, v, *, out=None, threads=1))]
    fn position_rates<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        v: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
        threads: i64,
    ) -> PyResult<Bound<'py, PyAny>> {
        let given = [("q", q, self.nq()), ("v", v, self.nv())];
        let one = |of: &Positions<'_>, x: &[&[f64]]| Ok(of.position_rates(x[0], x[1]));
        let way = Way::plain(out, threads);
        each_state(q.py(), &self.data, &given, self.nq(), &way, one)
    }

    /// q with quaternions of length 1.
    #[pyo3(signature = (q, *, out=None, threads=1))]
    fn normalize<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
        threads: i64,
    ) -> PyResult<Bound<'py, PyAny>> {
        let given = [("q", q, self.nq())];
        let one = |of: &Positions<'_>, x: &[&[f64]]| Ok(of.normalize(x[0]));
        let way = Way::plain(out, threads);
        each_state(q.py(), &self.data, &given, self.nq(), &way, one)
    }

    /// Random positions; with loops closed ones.
    #[pyo3(signature = (n=None, seed=None, *, threads=1, on_singular="raise"))]
    fn sample<'py>(
        &self,
        py: Python<'py>,
        n: Option<&Bound<'py, PyAny>>,
        seed: Option<&Bound<'py, PyAny>>,
        threads: i64,
        on_singular: &str,
    ) -> PyResult<Bound<'py, PyAny>> {
        let u = random_numbers(py, n, self.nv(), seed)?;
        let given = [("u", &u, self.nv())];
        let way = Way::new(None, threads, on_singular);
        let one = |of: &Positions<'_>, x: &[&[f64]]| of.sample(x[0]);
        each_state(py, &self.data, &given, self.nq(), &way, one)
    }

    fn __getattr__(slf: &Bound<'_, Self>, name: &str) -> PyResult<PyMethod> {
        let (model, data) = (slf.as_any().clone().unbind(), &slf.get().data);
        let method = data.spec.method(name).map_err(PyAttributeError::new_err)?;
        Ok(PyMethod::new(model, data.clone(), method))
    }

    /// The same for names that the class has.
    fn _method(slf: &Bound<'_, Self>, name: &str) -> PyResult<PyMethod> {
        Self::__getattr__(slf, name)
    }

    fn __dir__(slf: &Bound<'_, Self>) -> PyResult<Vec<String>> {
        let object = slf.py().import("builtins")?.getattr("object")?;
        let own: Vec<String> = object.call_method1("__dir__", (slf,))?.extract()?;
        // The class shows methods that this mechanism may not have.
        let of_class = documentation::of_class();
        let is_method = |name: &String| of_class.iter().any(|(method, ..)| method == name);
        let own = own.into_iter().filter(|name| !is_method(name));
        Ok(own.chain(slf.get().method_names()).collect())
    }

    fn __repr__(&self) -> String {
        let spec = &self.data.spec;
        let joints = spec.graph.coordinates.iter().map(|c| c.name.as_str());
        let joints: Vec<&str> = joints.collect();
        let (nq, nv, joints) = (self.nq(), self.nv(), joints.join(", "));
        format!("<bgdyn.Model {}: NQ {nq}, NV {nv}: {joints}>", spec.name)
    }

    fn _repr_html_(&self) -> String {
        mechanism_svg(&self.data.spec.mechanism)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let restored = py.import("bgdyn._load")?.getattr("restored")?;
        let spec = &self.data.spec;
        let arguments = (
            &spec.text,
            &spec.name,
            spec.choice.0.as_deref(),
            &spec.choice.1,
            self.parameters(py)?,
        );
        (restored, arguments).into_pyobject(py)
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
        let spec = &self.data.spec;
        (&spec.text, &spec.name, &spec.choice).hash(&mut hasher);
        hasher.finish()
    }
}

impl Model {
    fn method(&self, name: &str) -> PyResult<Method> {
        self.data.spec.method(name).map_err(PyValueError::new_err)
    }

    fn method_names(&self) -> Vec<String> {
        let all = Method::possible_of(&self.data.spec.graph);
        // The property `parameters` has the name of a method.
        let shown = |method: &Method| *method != Method::Regressor(Regressor::Parameters);
        let all = all.into_iter().filter(shown);
        all.map(|m| self.data.spec.name_of(m)).collect()
    }
}
