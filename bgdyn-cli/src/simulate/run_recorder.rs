//! Records a run from its start to its end.

use bgdyn_codegen::engine::Engine;
use bgdyn_codegen::scene::{Integration, IntegratorName, StepControl};
use bgdyn_codegen::system::SceneEquations;
use bgdyn_sim::{
    Dense, EventDriven, Failure, Integrator, Plant as _, Run, Tolerance, WithIntegrator,
    with_integrator,
};

use super::plant::{Evaluated, Numbers};
use super::recorded::Recorded;
use super::run_table::{ContactQuality, EnergyAt, Event, Record, Row, Way};
use super::scene_functions::Form;

/// Returns a scene as a plant for its integrator, computed by an engine.
pub fn prepared<'a>(
    engine: &dyn Engine,
    system: &'a SceneEquations,
    method: IntegratorName,
) -> Evaluated<'a> {
    let form = match method.needs_canonical() {
        true => Form::Canonical,
        false => Form::Natural,
    };
    Evaluated::new(engine, system, form, method.needs_jacobian())
}

/// Runs a scene, computed by an engine; `watch` receives the finished fraction from time to time.
///
/// A failed run ends early, with the reason in [`Record::failure`].
///
/// # Panics
/// Never: every integrator of scenes is in `bgdyn_sim`.
pub fn record(
    engine: &dyn Engine,
    system: &SceneEquations,
    way: &Way,
    watch: &mut dyn FnMut(f64),
) -> Record {
    record_from(prepared(engine, system, way.integration.method), way, watch)
}

/// [`record`] for an existing plant: [`prepared`] for the integrator, or with another start.
///
/// # Panics
/// Never.
pub fn record_from(plant: Evaluated<'_>, way: &Way, watch: &mut dyn FnMut(f64)) -> Record {
    let start = Start { plant, way, watch };
    // The plant handles the canonical form.
    let integrator = way.integration.method.on_velocities();
    with_integrator(integrator.name(), start).expect("an integrator of the list")
}

/// A run before its start.
struct Start<'a> {
    plant: Evaluated<'a>,
    way: &'a Way,
    watch: &'a mut dyn FnMut(f64),
}

impl WithIntegrator<Numbers> for Start<'_> {
    type Output = Record;

    fn with<M: Integrator<Numbers>>(self, method: M) -> Record {
        match self.plant.rigid_contacts() > 0 && !method.solves_contacts() {
            true => self.recorded::<EventDriven<Evaluated<'_>>, M>(method),
            false => self.recorded::<Evaluated<'_>, M>(method),
        }
    }
}

impl<'a> Start<'a> {
    fn recorded<P: Recorded<'a>, M: Integrator<Numbers>>(self, method: M) -> Record {
        let outputs = self.plant.has_outputs();
        let (plant, begin) = P::from_scene(self.plant);
        let mut run = Run::by(method, plant, begin);
        if let StepControl::Tolerance(tolerance) = self.way.integration.step_control {
            run = run.with_tolerance(Tolerance {
                absolute: tolerance,
                relative: tolerance,
            });
        }
        if !self.way.audited {
            run = run.unaudited();
        }
        RunRecorder::new(run, outputs, self.way, self.watch).all()
    }
}

type Failed<P> = Failure<Numbers, <P as bgdyn_sim::Plant>::Error>;

/// The energy that could move is at least this fraction of the stored energy: then a drift of a hundredth
/// of it is the rounding of sums of that size.
const ROUNDING: f64 = 1e-12;

/// Largest number of consecutive steps that end at an event or a kink; after them the run stops at events
/// only.
const ZENO_LIMIT: usize = 16;

/// Returns a straight line from a state to the current state of a run.
fn straight<'a, P: Recorded<'a>, M: Integrator<Numbers>>(
    t: f64,
    y: &Numbers,
    run: &Run<P, M>,
) -> Dense<Numbers> {
    let mut terms = [const { None }; 7];
    terms[0] = Some(run.y() - y);
    Dense::new(t, run.t() - t, y, terms)
}

/// A run, and its record so far.
struct RunRecorder<'a, P: Recorded<'a>, M: Integrator<Numbers>> {
    run: Run<P, M>,
    outputs: bool,
    way: &'a Way,
    watch: &'a mut dyn FnMut(f64),
    rows: Vec<Row>,
    /// Number of recorded output points.
    points: usize,
    steps: usize,
    events: Vec<Event>,
    energy: Vec<EnergyAt>,
    moved: f64,
    /// The mean forces of the rigid contacts in the last step, or those now.
    forces: Vec<[f64; 3]>,
    quality: Option<ContactQuality>,
}

impl<'a, P: Recorded<'a>, M: Integrator<Numbers>> RunRecorder<'a, P, M> {
    fn new(run: Run<P, M>, outputs: bool, way: &'a Way, watch: &'a mut dyn FnMut(f64)) -> Self {
        let forces = vec![[0.0; 3]; run.plant().scene().rigid_contacts()];
        RunRecorder {
            run,
            outputs,
            way,
            watch,
            rows: vec![],
            points: 0,
            steps: 0,
            events: vec![],
            energy: vec![],
            moved: 0.0,
            forces,
            quality: None,
        }
    }

    fn all(mut self) -> Record {
        let failed = self.complete().err();
        let (t, modes) = (self.run.t(), self.run.modes().clone());
        if self.rows.last().is_none_or(|row| row.t < t) {
            let y = self.run.y().clone();
            self.keep(t, &y, true);
        }
        let of_scene = P::scene_modes(&modes).clone();
        let scene = self.run.plant().scene();
        let y = scene.natural(t, self.run.y(), &of_scene);
        let failure = failed.map(|failed| self.run.plant().failure(&failed.reason));
        Record {
            rows: self.rows,
            energy: self.energy,
            steps: self.steps,
            events: self.events,
            kinks: self.run.kinks,
            t,
            y: y.unwrap_or_else(|_| self.run.y().clone()),
            modes: of_scene,
            audit: self.run.audit(),
            moved: self.moved,
            contacts: self.quality,
            failure,
        }
    }

    fn complete(&mut self) -> Result<(), Failed<P>> {
        let resolved = self.resolve_stiction();
        let begin = self.run.y().clone();
        self.keep(0.0, &begin, false);
        resolved?;
        self.points = 1;
        let Integration {
            step_control, end, ..
        } = self.way.integration;
        match step_control {
            StepControl::Tolerance(_) => self.reach(end),
            StepControl::Step(h) => {
                let mut steps = 1.0;
                // A last step of negligible length is omitted.
                while steps * h < end - 1e-9 * h {
                    self.reach(steps * h)?;
                    steps += 1.0;
                }
                self.reach(end)
            }
        }
    }

    /// Returns the time between two points, s.
    fn interval(&self) -> f64 {
        self.way.integration.end / (self.way.points - 1) as f64
    }

    /// Advances to a time, one step of the integrator after the other.
    fn reach(&mut self, target: f64) -> Result<(), Failed<P>> {
        let span = target - self.run.t();
        let rest = (1e-9 * span.min(self.interval())).max(4.0 * f64::EPSILON * target);
        let mut zeno_count = 0;
        while target - self.run.t() > rest {
            let left = target - self.run.t();
            self.resolve_stiction()?;
            let before = self.run.modes().clone();
            let passed = (self.run.events, self.run.kinks);
            if zeno_count < ZENO_LIMIT {
                let dense = self.run.advance_densely(left)?;
                self.take_contacts(dense.length());
                self.sample(&dense, &before, rest);
            } else {
                // Continues without a stop at every kink.
                let (t, y) = (self.run.t(), self.run.y().clone());
                self.run.step(match self.way.integration.step_control {
                    StepControl::Step(_) => left,
                    StepControl::Tolerance(_) => left.min(self.interval()),
                })?;
                self.sample(&straight(t, &y, &self.run), &before, rest);
            }
            self.steps += 1;
            let halted = passed != (self.run.events, self.run.kinks);
            zeno_count = if halted {
                (zeno_count + 1) % (ZENO_LIMIT + 1)
            } else {
                0
            };
            if self.run.events > passed.0 {
                self.happened(&before);
            }
            (self.watch)(self.run.t() / self.way.integration.end);
        }
        Ok(())
    }

    /// Makes the modes agree with inputs that have jumped, so that they are those of the whole next step.
    fn resolve_stiction(&mut self) -> Result<(), Failed<P>> {
        let (before, events) = (self.run.modes().clone(), self.run.events);
        self.run.resolve_stiction()?;
        if self.run.events > events {
            self.happened(&before);
        }
        Ok(())
    }

    /// Records the rigid contacts in a step of this length.
    fn take_contacts(&mut self, h: f64) {
        if self.forces.is_empty() {
            return;
        }
        let Some(contacts) = self.run.contact_step() else {
            let (scene, modes) = (self.run.plant().scene(), P::scene_modes(self.run.modes()));
            let depth = scene.deepest_overlap(self.run.t(), self.run.y(), modes);
            let quality = self.quality.get_or_insert_default();
            quality.depth = quality.depth.max(depth);
            return;
        };
        for (force, impulse) in self.forces.iter_mut().zip(&contacts.impulses) {
            *force = impulse.map(|p| p / h);
        }
        let quality = self.quality.get_or_insert_default();
        quality.depth = quality.depth.max(contacts.depth);
        quality.residual = quality.residual.max(contacts.residual);
        quality.unsolved += usize::from(!contacts.solved);
    }

    /// Records the output points inside a step.
    fn sample(&mut self, step: &Dense<Numbers>, modes: &P::Modes, rest: f64) {
        let now = self.run.t();
        while self.points < self.way.points {
            let last = self.points + 1 == self.way.points;
            let t = match last {
                true => self.way.integration.end,
                false => self.points as f64 * self.interval(),
            };
            if t > now + rest {
                return;
            }
            let mut y = step.at_time(t.min(now));
            // Positions of a loop that does not close are recorded as NaN.
            self.run.plant().project(t, &mut y, modes).ok();
            self.keep_with(t, &y, modes, false);
            self.points += 1;
        }
    }

    /// Records an event, with the state after it.
    fn happened(&mut self, before: &P::Modes) {
        let (t, y) = (self.run.t(), self.run.y().clone());
        let after = self.run.modes();
        let contacts = P::contact_events(before, after);
        if let Some((residual, by_poisson)) = P::impact(after) {
            let quality = self.quality.get_or_insert_default();
            quality.residual = quality.residual.max(residual);
            quality.by_poisson += usize::from(by_poisson);
            // A slip that has begun is no news.
            if contacts.is_empty() && P::scene_modes(before) == P::scene_modes(after) {
                return;
            }
        }
        let [before, after] = [before, after].map(|modes| P::scene_modes(modes).clone());
        self.events.push(Event {
            t,
            before,
            after,
            contacts,
        });
        self.keep(t, &y, true);
    }

    fn keep(&mut self, t: f64, state: &Numbers, extra: bool) {
        let modes = self.run.modes().clone();
        self.keep_with(t, state, &modes, extra);
    }

    fn keep_with(&mut self, t: f64, state: &Numbers, modes: &P::Modes, extra: bool) {
        if let Some(forces) = self.run.plant().contact_forces(t, state, modes) {
            self.forces = forces;
        }
        let (plant, modes) = (self.run.plant().scene(), P::scene_modes(modes));
        let y = plant.natural(t, state, modes);
        // Undefined velocities are recorded as NaN.
        let y = y.unwrap_or_else(|_| state.map(|_| f64::NAN));
        let values = match self.outputs {
            true => plant.output(t, &y, modes),
            false => y.as_slice().to_vec(),
        };
        let inputs = plant.input(t, &y, modes);
        self.rows.push(Row {
            t,
            values,
            y,
            modes: modes.clone(),
            inputs,
            contacts: self.forces.clone(),
            extra,
        });
        self.book();
    }

    /// Records the energy account at the current time.
    fn book(&mut self) {
        if !self.way.audited {
            return;
        }
        let (t, audit) = (self.run.t(), self.run.audit());
        for part in [&audit.supplied, &audit.stored, &audit.dissipated] {
            self.moved = self.moved.max(part.lp_norm(1));
        }
        let modes = P::scene_modes(self.run.modes());
        let held = self.run.plant().scene().held(t, self.run.y(), modes);
        if let Ok((motion, all)) = held {
            self.moved = self.moved.max(motion).max(ROUNDING * all);
        }
        if self.energy.last().is_none_or(|last| last.t < t) {
            self.energy.push(EnergyAt {
                t,
                supplied: audit.supplied.sum(),
                stored: audit.stored.sum(),
                dissipated: audit.dissipated.sum(),
                drift: audit.drift(),
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use bgdyn_sim::{INTEGRATORS, IntegratorInfo};

    use super::*;

    /// Returns the properties of an integrator, for vectors of run-time size.
    struct Info;

    impl WithIntegrator<Numbers> for Info {
        type Output = IntegratorInfo;

        fn with<M: Integrator<Numbers>>(self, integrator: M) -> IntegratorInfo {
            integrator.info()
        }
    }

    /// The table of names in scenes has the properties of the integrators themselves.
    #[test]
    fn integrators_of_scenes_are_those_of_the_list() {
        for named in IntegratorName::ALL {
            let (name, on_velocities) = (named.name(), named.on_velocities());
            let found = with_integrator(on_velocities.name(), Info);
            let info = found.unwrap_or_else(|| panic!("`{name}` is not in bgdyn-sim"));
            assert_eq!(
                named.controls_its_error(),
                info.estimate.is_some(),
                "{name}"
            );
            assert_eq!(
                on_velocities.needs_jacobian(),
                info.reads_jacobian,
                "{name}"
            );
            let canonical = format!("canonical_{}", on_velocities.name());
            assert_eq!(named.needs_canonical(), name == canonical, "{name}");
            assert!(!on_velocities.needs_canonical(), "{name}");
        }
        // The others have special purposes: `gauss4` and the reference of accuracy studies.
        let is_named = |name: &&str| IntegratorName::named(name).is_some();
        let others = INTEGRATORS.iter().copied().filter(|name| !is_named(name));
        assert_eq!(others.collect::<Vec<_>>(), ["gauss4", "extrapolation12"]);
    }
}
