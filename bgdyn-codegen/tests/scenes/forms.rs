//! Compares the Jacobian and the canonical form of scenes, by every alternative, with dual numbers over
//! double-double in the plain functions; and the derivative by every formulation.

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::formulation::FORMULATIONS;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::passes::factor;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::Dd;

use super::common::{read, specs, state};
use super::dual::{Dual, dual};

/// States per scene, and for each kind of modes.
const STATES: u64 = 2;

/// The compared functions.
struct Tried<'a> {
    system: &'a SceneEquations,
    derivative: Function,
    /// The derivative by each formulation that supports it.
    formulations: Vec<Function>,
    inputs: Option<Function>,
    jacobians: Vec<Function>,
    momenta: Vec<Function>,
    velocities: Vec<Function>,
    rates: Vec<Function>,
}

/// Compares in random states, with joints slipping, held, or some of each.
pub fn hold(system: &SceneEquations) {
    let all = |role: SceneFunction| -> Vec<Function> {
        let ways = system.ways(role).into_iter();
        ways.map(factor).collect()
    };
    let driven = !system.scene.layout.inputs.is_empty();
    let tried = Tried {
        system,
        derivative: system.function(SceneFunction::Derivative),
        formulations: FORMULATIONS
            .iter()
            .filter_map(|f| system.derivative_by(*f))
            .collect(),
        inputs: driven.then(|| system.function(SceneFunction::Inputs)),
        jacobians: all(SceneFunction::Jacobian),
        momenta: all(SceneFunction::ToCanonical),
        velocities: all(SceneFunction::FromCanonical),
        rates: all(SceneFunction::CanonicalRates),
    };
    let kinds: &[usize] = match system.scene.layout.modes.len() {
        0 => &[0],
        _ => &[0, 1, 2],
    };
    for seed in 0..STATES {
        for kind in kinds {
            let mut random = Random(seed);
            let mut at = state(system, &mut random, *kind != 1);
            if *kind == 2 {
                let mut mode = || Dd::from_f64((random.signed() * 1.5).round());
                at.modes.iter_mut().for_each(|m| *m = mode());
            }
            tried.formulations(&at);
            tried.slopes(&at);
            tried.canonical(&at);
        }
    }
}

impl Tried<'_> {
    /// ẏ with the slope of each of its parts, along the inputs that the scene drives.
    fn rates(&self, mut at: Inputs<Dual>) -> Vec<Dual> {
        if let Some(inputs) = &self.inputs {
            at.u = inputs.evaluate(at.clone()).0;
        }
        let (rates, refused) = self.derivative.evaluate(at.clone());
        assert!(refused.is_none(), "{}: singular", self.system.scene.name);
        let positions = at.v[..at.q.len()].to_vec();
        positions.into_iter().chain(rates).collect()
    }

    fn formulations(&self, at: &Inputs<Dd>) {
        let (wanted, refused) = self.derivative.evaluate(at.clone());
        assert!(refused.is_none());
        assert!(!self.formulations.is_empty(), "no formulation");
        for way in &self.formulations {
            let (found, refused) = way.evaluate(at.clone());
            assert!(refused.is_none());
            self.equal(&format!("derivative, {}", way.formulation), &found, &wanted);
        }
    }

    fn slopes(&self, at: &Inputs<Dd>) {
        let nq = at.q.len();
        let parts = nq + at.v.len() + at.x.len();
        for k in 0..=parts {
            let seeded = with_slopes(at, |i| if i == k { Dd::ONE } else { Dd::ZERO });
            let wanted: Vec<Dd> = self.rates(seeded).iter().map(|x| x.slope).collect();
            let wanted = &wanted[nq..];
            for jacobian in &self.jacobians {
                let (found, refused) = jacobian.evaluate(at.clone());
                assert!(refused.is_none());
                let n = wanted.len();
                let what = format!("column {k} of the Jacobian, {}", jacobian.formulation);
                self.equal(&what, &found[k * n..(k + 1) * n], wanted);
            }
        }
    }

    fn canonical(&self, at: &Inputs<Dd>) {
        let rates = self.rates(with_slopes(at, |_| Dd::ZERO));
        let rates: Vec<Dd> = rates.iter().map(|x| x.value).collect();
        let moving = with_slopes(at, |i| rates.get(i).copied().unwrap_or(Dd::ONE));
        let along: Vec<Dual> = self.momenta[0].evaluate(moving).0;
        let momenta: Vec<Dd> = along.iter().map(|p| p.value).collect();
        for way in &self.momenta {
            let found = way.evaluate(at.clone()).0;
            self.equal(&format!("momenta, {}", way.formulation), &found, &momenta);
        }
        let mut canonical = at.clone();
        canonical.v = momenta;
        for way in &self.velocities {
            let (found, refused) = way.evaluate(canonical.clone());
            assert!(refused.is_none());
            self.equal(&format!("velocities, {}", way.formulation), &found, &at.v);
        }
        // q̇, ṗ, ẋ
        let mut wanted = rates;
        let (nq, nv) = (at.q.len(), at.v.len());
        for (j, p) in along.iter().enumerate() {
            wanted[nq + j] = p.slope;
        }
        assert_eq!(wanted.len(), nq + nv + at.x.len());
        for way in &self.rates {
            let (found, refused) = way.evaluate(canonical.clone());
            assert!(refused.is_none());
            self.equal(
                &format!("canonical rates, {}", way.formulation),
                &found,
                &wanted,
            );
        }
    }

    /// Equal to the last digits of double-double, measured by the largest number beside.
    fn equal(&self, what: &str, found: &[Dd], wanted: &[Dd]) {
        let name = &self.system.scene.name;
        assert_eq!(found.len(), wanted.len(), "{name}: {what}");
        let size = wanted.iter().map(|x| x.to_f64().abs()).fold(1.0, f64::max);
        for (i, (found, wanted)) in found.iter().zip(wanted).enumerate() {
            let off = (*found - *wanted).to_f64().abs() / size;
            assert!(
                off < 1e-20,
                "{name}: {what}, entry {i}: {found:?}, not {wanted:?}"
            );
        }
    }
}

/// The parts of y, then t, with these slopes.
fn with_slopes(at: &Inputs<Dd>, slope: impl Fn(usize) -> Dd) -> Inputs<Dual> {
    let still = |x: &[Dd]| x.iter().map(|&x| dual(x, Dd::ZERO)).collect::<Vec<Dual>>();
    let mut k = 0;
    let mut moving = |x: &[Dd]| -> Vec<Dual> {
        let from = k;
        k += x.len();
        let parts = x.iter().enumerate();
        parts.map(|(i, &x)| dual(x, slope(from + i))).collect()
    };
    let (q, v, x) = (moving(&at.q), moving(&at.v), moving(&at.x));
    let t = at.t.map(|t| moving(&[t])[0]);
    Inputs {
        q,
        v,
        a: vec![],
        x,
        u: still(&at.u),
        modes: still(&at.modes),
        parameters: still(&at.parameters),
        t,
        passed: vec![],
    }
}

#[test]
fn jacobians_and_canonical_forms_of_the_repositorys_scenes() {
    let scenes = specs();
    let scenes = scenes.iter().map(|path| read(path));
    // Where positions are not the integrals of velocities there is no canonical form.
    let natural = scenes.filter(|system| system.scene.layout.coupled().is_empty());
    natural.for_each(|system| hold(&system));
}
