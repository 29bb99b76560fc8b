//! A program without std, alloc or a C library that calls every method of a generated model, and runs a
//! generated scene with every integrator.
#![no_std]
#![no_main]

mod memory;

use bgdyn::nalgebra::SVector;

use bgdyn_sim::{INTEGRATORS, Integrator, HybridState, Run, ScenePlant, Tolerance, WithIntegrator, with_integrator};

bgdyn::bgdyn!("../../golden/specs/panda7.yaml");
bgdyn::bgdyn!("../../../specs/scenes/stick_slip.scene.yaml");

type Block = stick_slip::StickSlip<f64>;
type State = SVector<f64, { stick_slip::N }>;
type Modes = SVector<f64, { stick_slip::NM }>;

/// Ten steps of the scene, with step control if the integrator estimates its error.
struct Steps<'a>(&'a Block, HybridState<State, Modes>);

impl WithIntegrator<State> for Steps<'_> {
    type Output = State;

    fn with<M: Integrator<State>>(self, method: M) -> State {
        let tolerance = Tolerance {
            absolute: 1e-9,
            relative: 1e-9,
        };
        let run = Run::by(method, ScenePlant::with_differences(self.0), self.1);
        let mut run = run.compensated().with_tolerance(tolerance);
        for _ in 0..10 {
            let _ = core::hint::black_box(run.step(1e-2));
        }
        *run.y()
    }
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

/// The entry point of a static program.
#[unsafe(no_mangle)]
pub extern "C" fn _start() -> ! {
    let arm = core::hint::black_box(panda7::Panda7::<f64>::default());
    let x = core::hint::black_box(SVector::<f64, { panda7::NV }>::repeat(0.3));
    core::hint::black_box(arm.inverse_dynamics(&x, &x, &x));
    core::hint::black_box(arm.mass_matrix(&x));
    core::hint::black_box(arm.bias(&x, &x));
    core::hint::black_box(arm.gravity(&x));
    core::hint::black_box(arm.kinetic_energy(&x, &x));
    core::hint::black_box(arm.potential_energy(&x));
    let _ = core::hint::black_box(arm.forward_dynamics(&x, &x, &x));
    let block = core::hint::black_box(Block::default());
    for name in INTEGRATORS {
        let steps = Steps(&block, Run::begin(&block));
        let _ = core::hint::black_box(with_integrator(name, steps));
    }
    loop {}
}
