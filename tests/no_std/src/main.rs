//! A program without std, alloc or a C library that calls every method of a generated model.
#![no_std]
#![no_main]

use bgdyn::nalgebra::SVector;

bgdyn::bgdyn!("../../golden/specs/panda7.yaml");

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

/// Where a static program starts.
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
    loop {}
}
