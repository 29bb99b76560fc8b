//! A scene as a Python object, and its runs.

use std::cell::RefCell;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::PathBuf;

use bgdyn_cli::simulate::{
    Record, Way, Words, changes, columns, page, prepared, record_from, report, summary,
};
use bgdyn_cli::spec_file::SpecFile;
use bgdyn_codegen::fault::Faults;
use bgdyn_codegen::scene::{Integration, Override, Scene, StepControl};
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::Dd;
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::errors::{scene_refused, spec_error};

/// Upper limit of the number of steps of a run.
const STEPS: f64 = 1e10;

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
}

/// The settings of a run, as given.
struct Settings {
    duration: Option<f64>,
    step: Option<f64>,
    tolerance: Option<f64>,
    points: usize,
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
                let text = match mechanism {
                    Some(text) => text,
                    None => file.load(path)?,
                };
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

    /// Runs the scene; returns what `bgdyn.Run` is made of.
    #[pyo3(signature = (duration, parameters, initial, step, tolerance, points))]
    #[expect(clippy::too_many_arguments, reason = "named arguments of Python")]
    fn _simulate<'py>(
        &self,
        py: Python<'py>,
        duration: Option<f64>,
        parameters: Vec<(String, f64)>,
        initial: Vec<(String, f64)>,
        step: Option<f64>,
        tolerance: Option<f64>,
        points: usize,
    ) -> PyResult<Bound<'py, PyDict>> {
        let settings = Settings {
            duration,
            step,
            tolerance,
            points,
        };
        let given = overrides(&self.system.scene, &parameters, &initial)?;
        let way = settings.way(&self.system.scene)?;
        let run = py.detach(|| {
            let system = self.system.with_overrides(&given)?;
            let plant = prepared(&system, way.integration.method);
            let record = record_from(plant, &way, &mut |_| ());
            Ok((system, record))
        });
        let (system, record) = run.map_err(|faults| cannot_start(&faults))?;
        self.described(py, &system, &record, &way)
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

impl Settings {
    /// Returns the scene's settings of integration with these changes.
    fn way(&self, scene: &Scene) -> PyResult<Way> {
        let wrong = |message: String| Err(PyValueError::new_err(message));
        let numbers = [
            ("duration", self.duration),
            ("step", self.step),
            ("tolerance", self.tolerance),
        ];
        for (name, value) in numbers {
            if value.is_some_and(|x| !(x.is_finite() && x > 0.0)) {
                return wrong(format!("`{name}` is a positive number"));
            }
        }
        if self.points < 2 {
            return wrong(format!(
                "points={}: the start and the end are 2",
                self.points
            ));
        }
        let own = scene.integration;
        let step_control = match (self.step, self.tolerance) {
            (Some(_), Some(_)) => return wrong("give `step` or `tolerance`, not both".into()),
            (Some(step), None) => StepControl::Step(step),
            (None, Some(tolerance)) => StepControl::Tolerance(tolerance),
            (None, None) => own.step_control,
        };
        let method = own.method;
        if matches!(step_control, StepControl::Tolerance(_)) && !method.controls_its_error() {
            let name = method.name();
            return wrong(format!(
                "the scene's method `{name}` does not go by a tolerance: give `step`"
            ));
        }
        let end = self.duration.unwrap_or(own.end);
        if let StepControl::Step(h) = step_control
            && end / h > STEPS
        {
            return wrong(format!(
                "steps of {h} s to t = {end} s are more than {STEPS:e}: take a longer step"
            ));
        }
        Ok(Way {
            integration: Integration {
                method,
                step_control,
                end,
            },
            points: self.points,
            audited: true,
        })
    }
}

/// Returns the values that replace those of the scene's file.
fn overrides(
    scene: &Scene,
    parameters: &[(String, f64)],
    initial: &[(String, f64)],
) -> PyResult<Vec<(Override, Dd)>> {
    let parameters = parameters.iter().map(|given| ("parameter", given));
    let initial = initial.iter().map(|given| ("part of the state", given));
    let each = parameters.chain(initial).map(|(what, (name, value))| {
        let wanted =
            |kind: bgdyn_codegen::scene::OverrideKind| kind.is_parameter() == (what == "parameter");
        let found = scene.override_named(what, name, wanted);
        let found = found.map_err(PyValueError::new_err)?;
        match value.is_finite() {
            true => Ok((found, Dd::from_f64(*value))),
            false => Err(PyValueError::new_err(format!("`{name}` is {value}"))),
        }
    });
    each.collect()
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
