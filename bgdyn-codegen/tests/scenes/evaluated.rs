//! A scene in the evaluator with the trait of generated scenes, and a step of it.

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::system::SceneEquations as Equations;
use bgdyn_runtime::nalgebra::SVector;
use bgdyn_runtime::{Balance, Contact, HybridSystem};

/// A scene in the evaluator, with the traits of generated code.
pub(super) struct Evaluated<const N: usize, const NM: usize, const NU: usize, const NE: usize> {
    nq: usize,
    nv: usize,
    derivative: Function,
    events: Function,
    contacts: Function,
}

impl<const N: usize, const NM: usize, const NU: usize, const NE: usize> Evaluated<N, NM, NU, NE> {
    pub(super) fn new(system: &Equations) -> Self {
        let layout = &system.scene.layout;
        Evaluated {
            nq: layout.nq(),
            nv: layout.nv(),
            derivative: system.function(SceneFunction::Derivative),
            events: system.function(SceneFunction::Events),
            contacts: system.function(SceneFunction::Contacts),
        }
    }

    fn value(
        &self,
        f: &Function,
        y: &[f64],
        modes: &[f64],
        input: &[f64],
        t: f64,
    ) -> Result<Vec<f64>, ()> {
        let (q, rest) = y.split_at(self.nq);
        let (v, x) = rest.split_at(self.nv);
        let inputs = Inputs {
            q: q.to_vec(),
            v: v.to_vec(),
            a: vec![],
            x: x.to_vec(),
            u: input.to_vec(),
            modes: modes.to_vec(),
            parameters: vec![],
            t: Some(t),
            passed: vec![],
        };
        let (values, refused) = f.evaluate(inputs);
        if refused.is_some() {
            Err(())
        } else {
            Ok(values)
        }
    }
}

impl<const N: usize, const NM: usize, const NU: usize, const NE: usize> HybridSystem<f64>
    for Evaluated<N, NM, NU, NE>
{
    type State = SVector<f64, N>;
    type Modes = SVector<f64, NM>;
    type Inputs = SVector<f64, NU>;
    type Events = SVector<f64, NE>;
    type Outputs = SVector<f64, 0>;
    type Entries = SVector<f64, 0>;
    type Singular = ();

    fn state_names(&self) -> &'static [&'static str; N] {
        &[""; N]
    }
    fn positions(&self) -> usize {
        self.nq
    }
    fn mode_names(&self) -> &'static [&'static str; NM] {
        &[""; NM]
    }
    fn input_names(&self) -> &'static [&'static str; NU] {
        &[""; NU]
    }
    fn event_names(&self) -> &'static [&'static str; NE] {
        &[""; NE]
    }
    fn event_modes(&self) -> &'static [Option<usize>; NE] {
        &[None; NE]
    }
    fn mode_velocities(&self) -> &'static [usize; NM] {
        &[0; NM]
    }
    fn output_names(&self) -> &'static [&'static str; 0] {
        &[]
    }
    fn entry_names(&self) -> &'static [&'static str; 0] {
        &[]
    }
    fn start(&self) -> (SVector<f64, N>, SVector<f64, NM>) {
        (SVector::zeros(), SVector::zeros())
    }
    fn derivative(
        &self,
        y: &SVector<f64, N>,
        modes: &SVector<f64, NM>,
        input: &SVector<f64, NU>,
        t: f64,
    ) -> Result<SVector<f64, N>, ()> {
        let (y, modes, input) = (y.as_slice(), modes.as_slice(), input.as_slice());
        let rates = self.value(&self.derivative, y, modes, input, t)?;
        let speeds = y[self.nq..].iter().take(self.nq).copied();
        Ok(SVector::from_iterator(speeds.chain(rates)))
    }
    fn input(
        &self,
        _: &SVector<f64, N>,
        _: &SVector<f64, NM>,
        given: &SVector<f64, NU>,
        _: f64,
    ) -> SVector<f64, NU> {
        *given
    }
    fn events(
        &self,
        y: &SVector<f64, N>,
        modes: &SVector<f64, NM>,
        input: &SVector<f64, NU>,
        t: f64,
    ) -> Result<SVector<f64, NE>, ()> {
        let (y, modes, input) = (y.as_slice(), modes.as_slice(), input.as_slice());
        Ok(SVector::from_vec(self.value(
            &self.events,
            y,
            modes,
            input,
            t,
        )?))
    }
    fn contacts(
        &self,
        y: &SVector<f64, N>,
        modes: &SVector<f64, NM>,
        input: &SVector<f64, NU>,
        t: f64,
    ) -> Result<[Contact<f64>; NM], ()> {
        let (y, modes, input) = (y.as_slice(), modes.as_slice(), input.as_slice());
        let all = self.value(&self.contacts, y, modes, input, t)?;
        Ok(std::array::from_fn(|k| Contact {
            slip: all[4 * k],
            slip_rate: all[4 * k + 1],
            holding: all[4 * k + 2],
            margin: all[4 * k + 3],
        }))
    }
    fn output(
        &self,
        _: &SVector<f64, N>,
        _: &SVector<f64, NM>,
        _: &SVector<f64, NU>,
        _: f64,
    ) -> SVector<f64, 0> {
        SVector::zeros()
    }
    fn energy(
        &self,
        _: &SVector<f64, N>,
        _: &SVector<f64, NM>,
        _: &SVector<f64, NU>,
        _: f64,
    ) -> [f64; 0] {
        []
    }
    fn power(
        &self,
        _: &SVector<f64, N>,
        _: &SVector<f64, NM>,
        _: &SVector<f64, NU>,
        _: f64,
    ) -> Result<[Balance<f64>; 0], ()> {
        Ok([])
    }
}

/// Takes one step of the classical Runge-Kutta method with constant modes.
pub(super) fn step<S: HybridSystem<f64, State = SVector<f64, N>, Singular = ()>, const N: usize>(
    system: &S,
    y: &S::State,
    modes: &S::Modes,
    input: &S::Inputs,
    h: f64,
) -> S::State {
    let f = |y: &SVector<f64, N>| {
        system
            .derivative(y, modes, input, 0.0)
            .expect("not singular")
    };
    let k1 = f(y);
    let k2 = f(&(y + k1 * (h / 2.0)));
    let k3 = f(&(y + k2 * (h / 2.0)));
    let k4 = f(&(y + k3 * h));
    y + (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0)
}
