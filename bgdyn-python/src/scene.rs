//! A scene as a Python object, and its runs.

use std::cell::RefCell;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::PathBuf;
use std::sync::OnceLock;

use bgdyn_cli::simulate::{
    PreparedScene, Record, Way, Words, changes, columns, page, prepared, record_from, report,
    summarized, summary,
};
use bgdyn_cli::spec_file::SpecFile;
use bgdyn_codegen::engine::Engine;
use bgdyn_codegen::fault::Faults;
use bgdyn_codegen::scene::Override;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::Dd;
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::arrays::read;
use crate::errors::{scene_refused, spec_error};
use crate::interrupt::{Interruptible, interruptible};
use crate::run_settings::{EITHER, Settings, named, overrides};

/// The numbers of many runs, and number and reason of each that failed.
type Summaries<'py> = (Bound<'py, PyArray2<f64>>, Vec<(usize, String)>);

/// A scene: a mechanism with the effects of one run. It does not change.
#[pyclass(frozen, module = "bgdyn._bgdyn", name = "Scene", subclass)]
#[derive(Debug)]
pub struct PyScene {
    text: String,
    name: String,
    /// Path and text of the mechanism, as the scene names it.
    mechanism: (String, String),
    system: SceneEquations,
    warnings: String,
    functions: OnceLock<PreparedScene>,
}

#[pymethods]
impl PyScene {
    #[new]
    #[pyo3(signature = (text, name, shown=None, mechanism=None))]
    fn new(
        py: Python<'_>,
        text: String,
        name: String,
        shown: Option<PathBuf>,
        mechanism: Option<String>,
    ) -> PyResult<Self> {
        let file = SpecFile {
            path: shown.unwrap_or_else(|| "<text>".into()),
            text,
            stem: name,
            mechanism,
        };
        if !file.is_scene() {
            let shown = file.path.display();
            let message = format!(
                "{shown} is no scene: a scene is a file with `scene: 1` that names a mechanism and its effects"
            );
            return Err(spec_error(py, &message));
        }
        let read = py.detach(|| {
            let found = RefCell::new((String::new(), String::new()));
            let load = |path: &str| {
                let text = file.load(path)?;
                *found.borrow_mut() = (path.to_owned(), text.clone());
                Ok(text)
            };
            let read = bgdyn_codegen::read_scene(&file.text, &file.stem, load);
            read.map(|(system, faults)| (system, faults, found.into_inner()))
        });
        let (system, faults, mechanism) =
            read.map_err(|refusal| scene_refused(py, &file, refusal))?;
        Ok(PyScene {
            warnings: file.render(&faults),
            text: file.text,
            name: file.stem,
            mechanism,
            system,
            functions: OnceLock::new(),
        })
    }

    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    #[getter]
    fn text(&self) -> &str {
        &self.text
    }

    #[getter]
    fn mechanism_text(&self) -> &str {
        &self.mechanism.1
    }

    #[getter]
    fn _warnings(&self) -> &str {
        &self.warnings
    }

    /// The values of the run-time parameters in the files, SI units.
    #[getter]
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let found = PyDict::new(py);
        for parameter in &self.system.scene.parameters {
            found.set_item(&parameter.name, parameter.default.to_f64())?;
        }
        Ok(found)
    }

    /// The names of the recorded quantities.
    #[getter]
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, columns(&self.system).into_iter().map(|c| c.name))
    }

    /// Their SI units by name; empty for a pure number.
    #[getter]
    fn units<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let found = PyDict::new(py);
        for column in columns(&self.system) {
            found.set_item(&column.name, column.unit)?;
        }
        Ok(found)
    }

    /// The engine that computes runs: always "tape", lists of operations without a compiler. Python has no
    /// machine code.
    #[getter]
    fn engine(&self) -> &'static str {
        Interruptible.name()
    }

    /// Runs the scene; returns what `bgdyn.Run` is made of.
    fn _simulate<'py>(
        &self,
        py: Python<'py>,
        parameters: Vec<(String, f64)>,
        initial: Vec<(String, f64)>,
        settings: Settings,
    ) -> PyResult<Bound<'py, PyDict>> {
        let given = overrides(&self.system.scene, &parameters, &initial)?;
        let way = settings.way(&self.system.scene)?;
        let run = || {
            let system = self.system.with_overrides(&given)?;
            let plant = self.functions().start(&system);
            let record = record_from(plant, &way, &mut |_| ());
            Ok((system, record))
        };
        let run = py.detach(|| interruptible(run))?;
        let (system, record) = run.map_err(|faults| cannot_start(&faults))?;
        self.described(py, &system, &record, &way)
    }

    /// Returns whether each of these names is one of a run-time parameter, not of a part of the start: checks them and
    /// the settings before the first run.
    fn _check_runs(&self, names: Vec<String>, settings: Settings) -> PyResult<Vec<bool>> {
        settings.way(&self.system.scene)?;
        let scene = &self.system.scene;
        let kinds = names.iter().map(|name| {
            // A parameter comes before a part of the start with its name.
            let parameter = scene.parameters.iter().any(|p| p.name == *name);
            let what = if parameter { "parameter" } else { EITHER };
            Ok(named(scene, what, name)?.kind.is_parameter())
        });
        kinds.collect()
    }

    /// Runs the scene for each row of `values`: those of these parameters, then of these parts of the start. Returns an
    /// array (runs, 2 + 3 columns) with time of the end, relative drift, and end, least and largest value of each
    /// column, NaN where a run did not start; and index and reason of each run that failed.
    fn _summaries<'py>(
        &self,
        py: Python<'py>,
        parameters: Vec<String>,
        initial: Vec<String>,
        values: &Bound<'py, PyAny>,
        settings: Settings,
    ) -> PyResult<Summaries<'py>> {
        let varied = self.varied(&parameters, &initial)?;
        let way = settings.way(&self.system.scene)?;
        let values = read("values", values, varied.len())?;
        let rows = values.as_slice()?;
        let width = 2 + 3 * columns(&self.system).len();
        let runs: usize = values.shape()[..values.shape().len() - 1].iter().product();
        let mut table = vec![f64::NAN; runs * width];
        let mut failures = Vec::new();
        let all = || {
            let functions = self.functions();
            for (k, out) in table.chunks_exact_mut(width).enumerate() {
                let own = &rows[k * varied.len()..(k + 1) * varied.len()];
                let with = varied.iter().zip(own);
                let with: Vec<_> = with.map(|(o, &x)| (o.clone(), Dd::from_f64(x))).collect();
                let run = summarized(&self.system, functions, &way, &with);
                (out[0], out[1]) = (run.t, run.drift);
                for (entry, x) in out[2..].iter_mut().zip(run.outputs.iter().flatten()) {
                    *entry = *x;
                }
                failures.extend(run.failure.map(|why| (k, why)));
            }
        };
        py.detach(|| interruptible(all))?;
        let table = PyArray1::from_vec(py, table).reshape([runs, width])?;
        Ok((table, failures))
    }

    fn __repr__(&self) -> String {
        format!("<bgdyn.Scene {}: {}>", self.name, self.mechanism.0)
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.name == other.name && self.text == other.text && self.mechanism.1 == other.mechanism.1
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        (&self.name, &self.text).hash(&mut hasher);
        hasher.finish()
    }
}

impl PyScene {
    /// Returns the scene's functions: prepared for the first run, then kept.
    fn functions(&self) -> &PreparedScene {
        let method = self.system.scene.integration.method;
        let make = || prepared(&Interruptible, &self.system, method).functions();
        self.functions.get_or_init(make)
    }

    /// Returns the quantities with these names.
    fn varied(&self, parameters: &[String], initial: &[String]) -> PyResult<Vec<Override>> {
        let scene = &self.system.scene;
        let parameters = parameters.iter().map(|name| ("parameter", name));
        let initial = initial.iter().map(|name| ("part of the state", name));
        let all = parameters.chain(initial);
        all.map(|(what, name)| named(scene, what, name)).collect()
    }

    /// Returns a run's arrays and texts by name.
    fn described<'py>(
        &self,
        py: Python<'py>,
        system: &SceneEquations,
        record: &Record,
        way: &Way,
    ) -> PyResult<Bound<'py, PyDict>> {
        let all = columns(system);
        let rows: Vec<Vec<f64>> = record.rows.iter().map(|row| row.values.clone()).collect();
        let times = record.rows.iter().map(|row| row.t).collect();
        let events = record.events.iter();
        let events: Vec<(f64, String)> = events.map(|e| (e.t, changes(system, e))).collect();
        let audit = &record.audit;
        let entries = system.entries.iter().enumerate();
        let balance: Vec<(&str, [f64; 3])> = entries
            .map(|(i, entry)| {
                let parts = [&audit.supplied, &audit.stored, &audit.dissipated];
                (entry.name.as_str(), parts.map(|part| part[i]))
            })
            .collect();
        let text = report(system, record);
        let words = Words {
            name: self.name.clone(),
            method: summary(&self.name, &way.integration),
            report: text.clone(),
        };
        let found = PyDict::new(py);
        found.set_item("name", &self.name)?;
        found.set_item("t", PyArray1::from_vec(py, times))?;
        found.set_item("values", PyArray2::from_vec2(py, &rows)?)?;
        found.set_item(
            "columns",
            all.iter().map(|c| c.name.as_str()).collect::<Vec<_>>(),
        )?;
        found.set_item("units", all.iter().map(|c| c.unit).collect::<Vec<_>>())?;
        found.set_item("events", events)?;
        found.set_item("balance", balance)?;
        found.set_item("drift", audit.drift())?;
        found.set_item("steps", record.steps)?;
        found.set_item("failure", record.failure.as_deref())?;
        found.set_item("report", text)?;
        found.set_item("page", page(system, &all, record, &words))?;
        Ok(found)
    }
}

/// Returns the error that a scene cannot start from the given state.
fn cannot_start(faults: &Faults) -> PyErr {
    let all: Vec<String> = faults
        .0
        .iter()
        .map(|fault| match &fault.help {
            Some(help) => format!("{}: {help}", fault.message),
            None => fault.message.clone(),
        })
        .collect();
    PyValueError::new_err(format!("the scene cannot start so: {}", all.join("; ")))
}
