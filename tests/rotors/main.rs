//! Full rotors on turned frames, on the link that their own joint moves and beyond it, in compiled code: every
//! integrator keeps its order, and the energy of the motion is constant.

use bgdyn::nalgebra::SVector;
use bgdyn_sim::{Integrator, Run, ScenePlant, WithIntegrator, with_integrator};

bgdyn::bgdyn!("spin.scene.yaml", jacobian = true);

type State = SVector<f64, 6>;

/// End of the runs, s.
const END: f64 = 0.5;

/// The end of a run in so many equal steps, and by how much the energy has drifted, J.
struct Spin(usize);

impl WithIntegrator<State> for Spin {
    type Output = (State, f64);

    fn with<M: Integrator<State>>(self, integrator: M) -> (State, f64) {
        let scene = spin::Spin::<f64>::default();
        let plant = ScenePlant::with_slope(&scene);
        let mut run = Run::by(integrator, plant, Run::begin(&scene));
        let energy = |run: &Run<_, M>| -> f64 {
            use bgdyn_sim::Plant;
            let plant: &ScenePlant<'_, spin::Spin<f64>, f64> = run.plant();
            let energy = plant.energy(run.t(), run.y(), run.modes());
            energy.expect("an energy").sum()
        };
        let before = energy(&run);
        for _ in 0..self.0 {
            run.step(END / self.0 as f64).expect("a step");
        }
        (*run.y(), energy(&run) - before)
    }
}

fn run(name: &str, steps: usize) -> (State, f64) {
    with_integrator(name, Spin(steps)).expect("in the list")
}

#[test]
fn every_integrator_keeps_its_order() {
    let right = run("gauss3", 4000).0;
    for (name, order) in [
        ("semi_implicit_euler", 1.0),
        ("midpoint", 2.0),
        ("rk4", 4.0),
        ("gauss2", 4.0),
        ("rodas4", 4.0),
        ("dopri5", 5.0),
    ] {
        let steps = if order < 3.0 { [500, 1000] } else { [50, 100] };
        let [coarse, fine] = steps.map(|n| (run(name, n).0 - right).norm());
        let found = (coarse / fine).log2();
        assert!(
            found > order - 0.3,
            "{name}: {coarse:.2e}, {fine:.2e}: order {found:.2}"
        );
    }
}

#[test]
fn the_energy_is_constant() {
    for (name, steps) in [("dop853", 200), ("gauss3", 400), ("dopri5", 800)] {
        let drift = run(name, steps).1;
        assert!(drift.abs() < 1e-10, "{name}: {drift:.2e} J");
    }
}
