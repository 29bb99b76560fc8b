//! A scene as a plant, which [`bgdyn_sim::Run`] integrates without a compiler.

use std::sync::Arc;

use bgdyn_codegen::engine::{CallArguments, Engine, Status};
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::{Contact, ContactMap, Dd, ImpactLaw, QuasiJoint, RigidContact};
use bgdyn_sim::{HybridState, Jacobian, Plant, Power, Sampler, Stiction, quasi_joints};
use nalgebra::{DMatrix, DVector};

use super::scene_functions::{Form, SceneFunctions};
use super::undefined::Undefined;

/// A vector of numbers in SI units: states, modes, inputs, entries of the balance of power.
pub type Numbers = DVector<f64>;

/// A scene whose functions the engine computes. Inputs that the scene does not drive are 0; run-time parameters have the
/// values of its files.
#[derive(Clone, Debug)]
pub struct Evaluated<'a> {
    pub(super) system: &'a SceneEquations,
    pub(super) parameters: Vec<f64>,
    /// Inputs of 0.
    pub(super) no_inputs: Vec<f64>,
    pub(super) functions: Arc<SceneFunctions>,
    /// What sampled controllers give.
    pub(super) sampler: Sampler<Numbers>,
}

/// The functions of a scene, prepared once for all of its starts.
#[derive(Clone, Debug)]
pub struct PreparedScene(Arc<SceneFunctions>);

impl PreparedScene {
    /// Returns the scene with the start of `system`: that of the functions, or one with overrides
    /// ([`SceneEquations::with_overrides`]).
    pub fn start<'a>(&self, system: &'a SceneEquations) -> Evaluated<'a> {
        Evaluated {
            system,
            parameters: parameters(system),
            no_inputs: vec![0.0; system.scene.layout.inputs.len()],
            functions: Arc::clone(&self.0),
            sampler: Sampler::default(),
        }
    }
}

/// A value of a scene, or the error that it does not exist.
pub(crate) type Evaluation<T> = Result<T, Undefined>;
/// The contacts that can hold a coordinate, mode by mode.
type ContactsOf = Evaluation<Vec<Contact<f64>>>;

impl<'a> Evaluated<'a> {
    /// Returns the scene in these variables, computed by this engine; `slopes` for integrators that need the slopes of
    /// the rates.
    pub fn new(engine: &dyn Engine, system: &'a SceneEquations, form: Form, slopes: bool) -> Self {
        Evaluated {
            system,
            parameters: parameters(system),
            no_inputs: vec![0.0; system.scene.layout.inputs.len()],
            functions: Arc::new(SceneFunctions::new(engine, system, form, slopes)),
            sampler: Sampler::default(),
        }
    }

    /// Returns what computed the functions until now, in words.
    pub fn engine(&self) -> String {
        self.functions.engines()
    }

    /// Returns the functions of the scene, for other starts of it.
    pub fn functions(&self) -> PreparedScene {
        PreparedScene(Arc::clone(&self.functions))
    }

    /// Returns the scene with another start ([`SceneEquations::with_overrides`]), with the functions of
    /// this one.
    pub fn with_overrides<'b>(&self, system: &'b SceneEquations) -> Evaluated<'b> {
        self.functions().start(system)
    }

    /// Returns the start of the scene, at t = 0.
    pub fn begin(&self) -> HybridState<Numbers, Numbers> {
        let start = &self.system.initial;
        let y = numbers(start.q.iter().chain(&start.v).chain(&start.x)).into();
        let modes = numbers(&start.modes).into();
        HybridState {
            t: 0.0,
            y: self.own(0.0, &y, &modes),
            modes,
        }
    }

    /// Converts a state in the plant's form to y.
    ///
    /// # Errors
    /// If the mass matrix is singular.
    pub fn natural(&self, t: f64, state: &Numbers, modes: &Numbers) -> Evaluation<Numbers> {
        match &self.functions.canonical {
            None => Ok(state.clone()),
            Some(canonical) => {
                let at = self.arguments(t, state, modes);
                let v = self.checked(&*canonical.from, &at)?;
                Ok(self.with_velocities(state, &v))
            }
        }
    }

    /// Converts y to a state in the plant's form.
    fn own(&self, t: f64, y: &Numbers, modes: &Numbers) -> Numbers {
        match &self.functions.canonical {
            None => y.clone(),
            Some(canonical) => {
                let (p, _) = canonical.to.value(&self.arguments(t, y, modes));
                self.with_velocities(y, &p)
            }
        }
    }

    fn with_velocities(&self, y: &Numbers, velocities: &[f64]) -> Numbers {
        let mut all = y.clone();
        let nq = self.positions();
        all.as_mut_slice()[nq..nq + velocities.len()].copy_from_slice(velocities);
        all
    }

    /// Returns whether the scene has outputs.
    pub fn has_outputs(&self) -> bool {
        self.functions.outputs.is_some()
    }

    /// Returns the outputs of the scene at y; empty without outputs.
    pub fn output(&self, t: f64, y: &Numbers, modes: &Numbers) -> Vec<f64> {
        match &self.functions.outputs {
            None => vec![],
            Some(outputs) => self.driven(t, y, modes, |at| outputs.value(at).0),
        }
    }

    /// Returns the inputs at y: those that the scene drives, and 0 for the others.
    pub fn input(&self, t: f64, y: &Numbers, modes: &Numbers) -> Vec<f64> {
        self.driven(t, y, modes, |at| at.u.to_vec())
    }

    /// Returns the stored energy at a state, J: the energy of its motion (which would be missing if every
    /// velocity were 0), and the sum of the sizes of all entries.
    ///
    /// # Errors
    /// If the mass matrix is singular and the state contains momenta.
    pub fn held(&self, t: f64, state: &Numbers, modes: &Numbers) -> Evaluation<(f64, f64)> {
        let y = self.natural(t, state, modes)?;
        let energy = |y: &Numbers| -> Numbers {
            let values = self.driven(t, y, modes, |at| self.functions.energy.value(at).0);
            values.into()
        };
        let still = self.with_velocities(&y, &vec![0.0; self.system.scene.layout.nv()]);
        let now = energy(&y);
        let motion = (&now - energy(&still)).lp_norm(1);
        Ok((motion, now.lp_norm(1)))
    }

    /// Returns the contacts that can hold a coordinate, mode by mode, at y.
    fn contacts(&self, t: f64, y: &Numbers, modes: &Numbers) -> ContactsOf {
        let Some(contacts) = &self.functions.contacts else {
            return Ok(vec![]);
        };
        let values = self.driven(t, y, modes, |at| self.regular(&**contacts, at))?;
        let one = |c: &[f64]| Contact {
            slip: c[0],
            slip_rate: c[1],
            holding: c[2],
            margin: c[3],
        };
        Ok(values.chunks_exact(4).map(one).collect())
    }

    /// Returns the contacts at a time, as a function of state and modes.
    fn stiction(&self, t: f64) -> Stiction<'_, impl Fn(&Numbers, &Numbers) -> ContactsOf> {
        Stiction {
            event_modes: &self.functions.event_modes,
            mode_velocities: &self.functions.mode_velocities,
            contacts: move |y: &Numbers, modes: &Numbers| self.contacts(t, y, modes),
        }
    }
}

fn parameters(system: &SceneEquations) -> Vec<f64> {
    numbers(system.scene.parameters.iter().map(|p| &p.default))
}

fn numbers<'x>(all: impl IntoIterator<Item = &'x Dd>) -> Vec<f64> {
    all.into_iter().map(|x| x.to_f64()).collect()
}

impl Plant for Evaluated<'_> {
    type State = Numbers;
    type Modes = Numbers;
    type Values = Numbers;
    type Entries = Numbers;
    type Error = Undefined;

    fn rates(&self, t: f64, state: &Numbers, modes: &Numbers) -> Evaluation<Numbers> {
        if let Some(canonical) = &self.functions.canonical {
            let (rates, status) = canonical.rates.value(&self.arguments(t, state, modes));
            return match status {
                Status::Done => Ok(rates.into()),
                Status::Refused(j) => Err(self.refused(j)),
                // The error of a position's rate has the name of its coordinate.
                Status::NotFinite(i) => {
                    Err(self.not_finite(i.checked_sub(self.positions()).unwrap_or(i)))
                }
            };
        }
        self.natural_rates(t, state, modes)
    }

    fn jacobian(
        &self,
        t: f64,
        y: &Numbers,
        modes: &Numbers,
    ) -> Option<Evaluation<Jacobian<Numbers>>> {
        let jacobian = self.functions.jacobian.as_ref()?;
        let held = self.held_inputs(t, self.no_inputs.clone());
        let at = CallArguments {
            u: &held,
            ..self.arguments(t, y, modes)
        };
        let values = match self.checked(&**jacobian, &at) {
            Ok(values) => values,
            Err(undefined) => return Some(Err(undefined)),
        };
        let rows = self.system.scene.layout.jacobian_rows(&values);
        let n = y.len();
        Some(Ok(Jacobian {
            state: DMatrix::from_fn(n, n, |i, k| rows[i][k]),
            time: DVector::from_fn(n, |i, _| rows[i][n]),
        }))
    }

    fn positions(&self) -> usize {
        self.system.scene.layout.nq()
    }

    fn position_rates(&self, t: f64, state: &Numbers, modes: &Numbers) -> Evaluation<Numbers> {
        Ok(self.rates_of_positions(t, &self.natural(t, state, modes)?, modes))
    }

    fn position_change(
        &self,
        t: f64,
        state: &Numbers,
        modes: &Numbers,
        h: f64,
    ) -> Evaluation<Numbers> {
        Ok(self.change_of_positions(t, &self.natural(t, state, modes)?, modes, h))
    }

    fn quasi_joints(&self) -> Option<&[QuasiJoint]> {
        let own = self.functions.position_rates.is_some();
        (!own).then_some(&*self.functions.quasi_joints)
    }

    fn project(&self, _: f64, y: &mut Numbers, _: &Numbers) -> Evaluation<bool> {
        self.put_right(y)
    }

    fn project_in_two(
        &self,
        _: f64,
        (y, low): (&mut Numbers, &mut Numbers),
        _: &Numbers,
    ) -> Evaluation<bool> {
        self.put_right_in_two(y, low)
    }

    fn strays(&self, y: &Numbers) -> bool {
        self.functions.closing.is_some()
            || quasi_joints::strays(&self.functions.quasi_joints, y.as_slice())
    }

    fn rigid_contacts(&self) -> usize {
        self.system.scene.layout.rigid_contacts.len()
    }

    fn impact_law(&self) -> ImpactLaw {
        self.system.scene.integration.impacts
    }

    fn rigid_contact_entry(&self, contact: usize) -> usize {
        let rigid = self.functions.rigid.as_ref();
        rigid.map_or(0, |rigid| rigid.entries[contact])
    }

    fn rigid_contact_states(
        &self,
        t: f64,
        state: &Numbers,
        modes: &Numbers,
        contacts: &mut [RigidContact<f64>],
    ) -> Evaluation<()> {
        self.states_of_contacts(t, state, modes, contacts);
        Ok(())
    }

    fn rigid_contact_maps(
        &self,
        t: f64,
        state: &Numbers,
        modes: &Numbers,
        maps: &mut [Option<ContactMap<Numbers>>],
    ) -> Evaluation<()> {
        self.maps_of_contacts(t, state, modes, maps)
    }

    fn rigid_contact_biases(
        &self,
        t: f64,
        state: &Numbers,
        modes: &Numbers,
        biases: &mut [[f64; 3]],
    ) -> Evaluation<()> {
        self.biases_of_contacts(t, state, modes, biases);
        Ok(())
    }

    fn events(&self, t: f64, state: &Numbers, modes: &Numbers) -> Evaluation<Numbers> {
        let Some(events) = &self.functions.events else {
            return Ok(DVector::zeros(0));
        };
        let y = self.natural(t, state, modes)?;
        let values = self.driven(t, &y, modes, |at| self.regular(&**events, at))?;
        Ok(values.into())
    }

    fn changes_mode(&self, event: usize) -> bool {
        self.functions.event_modes[event].is_some()
    }

    fn change(
        &self,
        t: f64,
        state: &Numbers,
        modes: &Numbers,
        fell: impl Fn(usize) -> bool,
    ) -> Evaluation<(Numbers, Numbers)> {
        let y = self.natural(t, state, modes)?;
        let (y, held) = self.stiction(t).after_events(&y, modes, fell)?;
        Ok((self.own(t, &y, &held), held))
    }

    fn resolve_stiction(
        &self,
        t: f64,
        state: &Numbers,
        modes: &Numbers,
        rest: f64,
    ) -> Evaluation<Option<(Numbers, Numbers)>> {
        let y = self.natural(t, state, modes)?;
        let found = self.stiction(t).resolve(&y, modes, rest)?;
        Ok(found.map(|(y, modes)| (self.own(t, &y, &modes), modes)))
    }

    fn next_corner(&self, t: f64) -> Option<f64> {
        let corners = &self.functions.corners;
        let next = corners.partition_point(|&corner| corner <= t);
        let bends = corners.get(next).copied();
        let control = self.system.scene.control.as_ref();
        let sampled = control.and_then(|control| self.sampler.next(&control.sampled()));
        match (bends, sampled) {
            (Some(bends), Some(sampled)) => Some(bends.min(sampled)),
            (bends, sampled) => bends.or(sampled),
        }
    }

    fn reached(&mut self, t: f64, y: &Numbers, modes: &Numbers) {
        let Some(control) = &self.system.scene.control else {
            return;
        };
        let mut sampler = self.sampler.clone();
        let inputs = |measured: &Numbers| self.live_inputs(t, measured, modes).into();
        sampler.reached(&control.sampled(), t, y, inputs);
        self.sampler = sampler;
    }

    fn nothing(&self) -> Numbers {
        DVector::zeros(self.system.entries.len())
    }

    fn energy(&self, t: f64, state: &Numbers, modes: &Numbers) -> Evaluation<Numbers> {
        let y = self.natural(t, state, modes)?;
        let energy = &self.functions.energy;
        let (values, _) = self.driven(t, &y, modes, |at| energy.value(at));
        Ok(values.into())
    }

    fn power(&self, t: f64, state: &Numbers, modes: &Numbers) -> Evaluation<Power<Numbers>> {
        let y = self.natural(t, state, modes)?;
        let power = &*self.functions.power;
        let values = self.driven(t, &y, modes, |at| self.regular(power, at))?;
        // Of each three numbers the first is supplied, the last dissipated power.
        let part = |k: usize| DVector::from_fn(values.len() / 3, |i, _| values[3 * i + k]);
        Ok(Power {
            supplied: part(0),
            dissipated: part(2),
        })
    }
}
