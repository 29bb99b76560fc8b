//! Square roots of `f32` for targets with and without `std`.
//!
//! This file has the only `unsafe` code of the crate, and only for Arm targets with the hard-float ABI:
//! they have an instruction for the root that no safe function of `core` or `libm` uses; `libm` computes
//! the root there with integers, in some 60 instructions.

/// Returns √x, correctly rounded; NaN for a negative x.
#[cfg(not(all(target_arch = "arm", target_abi = "eabihf")))]
#[inline(always)]
pub(crate) fn sqrt_f32(x: f32) -> f32 {
    libm::sqrtf(x)
}

/// Returns √x, correctly rounded; NaN for a negative x.
#[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
#[allow(unsafe_code)]
#[inline(always)]
pub(crate) fn sqrt_f32(x: f32) -> f32 {
    let mut bits = x.to_bits();
    // SAFETY: the ABI has single-precision registers, so the processor has VSQRT.F32. The compiler does
    // not allocate those registers to operands here (it requires a target feature that no target of
    // microcontrollers enables), so the code borrows one and restores its value at the end. The FPU's
    // exception flags may change; they are not declared as preserved. Any input value is valid; the code
    // touches no memory and no stack, and its result depends on x only.
    unsafe {
        core::arch::asm!(
            "vmov {own}, s0",
            "vmov s0, {bits}",
            "vsqrt.f32 s0, s0",
            "vmov {bits}, s0",
            "vmov s0, {own}",
            own = out(reg) _,
            bits = inout(reg) bits,
            options(pure, nomem, nostack),
        );
    }
    f32::from_bits(bits)
}
