//! Compiled scenes as configurations of a study.

use std::hint::black_box;
use std::rc::Rc;

use bgdyn_runtime::{Canonical, Dd, Slope, System};
use bgdyn_sim::{
    CanonicalScene, Dop853, Dopri5, Extrapolation12, Gauss2, Gauss3, Gauss4, Method, Midpoint,
    Moment, Real, Rk4, Rodas4, Run, Scene, SemiImplicitEuler, WithMethod,
};
use nalgebra::SVector;

use crate::configuration::{Configuration, Grid, Pace, RunError, Runner, Samples};
use crate::dyn_plant::{DynPlant, PlantObject};
use crate::integrate::{Integrate, Measured, SampledOutput, numbers};
use crate::test_case::{TestCase, order};

/// What equations are called that are written as they are by default.
const CHEAPEST: &str = "cheapest";

/// A configuration of this method's order and way to go.
fn configuration(
    method: &str,
    scalar: (&'static str, f64),
    formulation: &str,
    run: Runner,
) -> Configuration {
    let (order, controlled) = order(method).expect("a method of bgdyn-sim");
    Configuration {
        effects: "all".into(),
        method: method.into(),
        order,
        controlled,
        scalar: scalar.0,
        epsilon: scalar.1,
        formulation: formulation.into(),
        run,
    }
}

const F64: (&str, f64) = ("f64", f64::EPSILON);
const F32: (&str, f64) = ("f32", f32::EPSILON as f64);

/// The sizes of a scene, as parameters.
macro_rules! scenes {
    ($(
        $(#[$doc:meta])*
        $vis:vis fn $name:ident[S: $bound:ident<$t:ident> $(, $M:ident: $m:path)?]($($arg:tt)*) $body:block
    )*) => { $(
        $(#[$doc])*
        $vis fn $name<
            S,
            $($M: $m,)?
            const N: usize,
            const NM: usize,
            const NU: usize,
            const NE: usize,
            const NY: usize,
            const NP: usize,
        >($($arg)*)
        where
            S: $bound<$t, N, NM, NU, NE, NY, NP> + 'static,
        $body
    )* };
}

macro_rules! measured {
    ($plant:ident: $bound:ident, $body:expr) => {
        impl<
            S,
            T: Real,
            const N: usize,
            const NM: usize,
            const NU: usize,
            const NE: usize,
            const NY: usize,
            const NP: usize,
        > Measured for $plant<'_, S, T, N, NM, NU, NE, NY, NP>
        where
            S: $bound<T, N, NM, NU, NE, NY, NP>,
        {
            fn measured(&self, t: T, y: &SVector<T, N>, modes: &SVector<T, NM>) -> Vec<T> {
                let output: fn(&Self, T, &SVector<T, N>, &SVector<T, NM>) -> SVector<T, NY> = $body;
                output(self, t, y, modes).as_slice().to_vec()
            }
        }
    };
}

measured!(Scene: System, |plant, t, y, modes| plant.output(t, y, modes));
measured!(CanonicalScene: Canonical, |plant, t, z, modes| {
    match plant.to_natural(t, z, modes) {
        Ok(y) => plant.natural.output(t, &y, modes),
        Err(_) => SVector::repeat(T::from_f64(f64::NAN)),
    }
});

/// A plant as it is run: where it begins, and how.
struct Started<T: Real, const N: usize, const NM: usize, const NE: usize> {
    plant: DynPlant<T, N, NM, NE>,
    begin: Moment<SVector<T, N>, SVector<T, NM>>,
}

impl<T: Real, const N: usize, const NM: usize, const NE: usize> Started<T, N, NM, NE> {
    fn new(
        plant: impl PlantObject<T, N, NM, NE> + 'static,
        begin: Moment<SVector<T, N>, SVector<T, NM>>,
    ) -> Rc<Self> {
        let plant = DynPlant(Rc::new(plant));
        Rc::new(Started { plant, begin })
    }

    /// A run by a method.
    fn run<M: Method<SVector<T, N>>>(
        &self,
        method: M,
        grid: &Grid,
        pace: Pace,
    ) -> SampledOutput<T> {
        let run = Integrate {
            plant: self.plant.clone(),
            begin: black_box(self.begin),
            grid,
            pace: black_box(pace),
        };
        run.with(method)
    }

    /// The same, for a configuration.
    fn runner<M: Method<SVector<T, N>>>(self: &Rc<Self>, method: impl Fn() -> M + 'static) -> Runner
    where
        T: 'static,
    {
        let started = self.clone();
        Box::new(move |grid, pace| {
            Samples::finite(numbers(started.run(method(), grid, pace)?), None)
        })
    }
}

/// A scene that stays: studies are few and their scenes small.
fn kept<S: 'static>(scene: S) -> &'static S {
    Box::leak(Box::new(scene))
}

impl TestCase {
    scenes! {
        /// The reference: order 12 in double-double by controlled steps.
        pub fn reference[S: System<Dd>](&mut self, scene: S) {
            let scene = kept(scene);
            let started = Started::new(Scene::new(scene), Run::begin(scene));
            self.reference = Some(Box::new(move |grid, tolerance| {
                started.run(Extrapolation12::default(), grid, Pace::Tolerance(tolerance))
            }));
        }

        /// Every method of bgdyn-sim but the reference's.
        pub fn methods[S: Slope<f64>](&mut self, scene: S) {
            let scene = kept(scene);
            let started = Started::new(Scene::with_slope(scene), Run::begin(scene));
            let runs: [(&str, Runner); 9] = [
                ("semi_implicit_euler", started.runner(|| SemiImplicitEuler)),
                ("rk4", started.runner(|| Rk4)),
                ("midpoint", started.runner(Midpoint::<f64>::new)),
                ("gauss2", started.runner(Gauss2::<f64>::new)),
                ("gauss3", started.runner(Gauss3::<f64>::new)),
                ("gauss4", started.runner(Gauss4::<f64>::new)),
                ("rodas4", started.runner(|| Rodas4)),
                ("dopri5", started.runner(|| Dopri5)),
                ("dop853", started.runner(|| Dop853)),
            ];
            for (method, run) in runs {
                self.configurations.push(configuration(method, F64, CHEAPEST, run));
            }
        }

        /// Gauss–Legendre methods on the canonical form.
        pub fn momenta[S: Canonical<f64>](&mut self, scene: S) {
            let scene = kept(scene);
            let plant = CanonicalScene::new(scene);
            let mut begin = Run::begin(scene);
            begin.y = plant.to_canonical(begin.t, &begin.y, &begin.modes);
            let started = Started::new(plant, begin);
            let runs: [(&str, Runner); 3] = [
                ("canonical_midpoint", started.runner(Midpoint::<f64>::new)),
                ("canonical_gauss2", started.runner(Gauss2::<f64>::new)),
                ("canonical_gauss3", started.runner(Gauss3::<f64>::new)),
            ];
            for (method, run) in runs {
                self.configurations.push(configuration(method, F64, "canonical", run));
            }
        }

        /// An explicit and a controlled method in `f32`.
        pub fn single[S: System<f32>](&mut self, scene: S) {
            let scene = kept(scene);
            let started = Started::new(Scene::new(scene), Run::begin(scene));
            let runs: [(&str, Runner); 2] = [
                ("rk4", started.runner(|| Rk4)),
                ("dopri5", started.runner(|| Dopri5)),
            ];
            for (method, run) in runs {
                self.configurations.push(configuration(method, F32, CHEAPEST, run));
            }
        }

        /// The scene's rates by another formulation, by the classical Runge–Kutta method.
        pub fn formulation[S: System<f64>](&mut self, name: &str, scene: S) {
            let scene = kept(scene);
            let started = Started::new(Scene::new(scene), Run::begin(scene));
            let run = started.runner(|| Rk4);
            self.configurations.push(configuration("rk4", F64, name, run));
        }

        /// The scene with these effects, by an explicit method: the scene's own.
        pub fn ablation[S: System<f64>, M: Method<SVector<f64, N>>](
            &mut self,
            effects: &str,
            scene: S,
            method: impl Fn() -> M + 'static,
        ) {
            let scene = kept(scene);
            let started = Started::new(Scene::new(scene), Run::begin(scene));
            self.add_ablation(effects, started.runner(method));
        }

        /// The same by a method that takes slopes.
        pub fn ablation_with_slope[S: Slope<f64>, M: Method<SVector<f64, N>>](
            &mut self,
            effects: &str,
            scene: S,
            method: impl Fn() -> M + 'static,
        ) {
            let scene = kept(scene);
            let started = Started::new(Scene::with_slope(scene), Run::begin(scene));
            self.add_ablation(effects, started.runner(method));
        }
    }

    /// A set of effects without which the measured output is not there.
    pub fn missing_ablation(&mut self, effects: &str) {
        let run: Runner = Box::new(|_, _| {
            let why = "the measured output is not there".into();
            Err(RunError { t: 0.0, why })
        });
        self.add_ablation(effects, run);
    }

    /// A set of effects, run by the scene's own method.
    pub fn add_ablation(&mut self, effects: &str, run: Runner) {
        let ablation = configuration(&self.own.0, F64, CHEAPEST, run);
        self.ablations.push(Configuration {
            effects: effects.into(),
            ..ablation
        });
    }
}
