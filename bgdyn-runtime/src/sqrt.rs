//! Square roots.
//!
//! The only `unsafe` of the crate, and only where the target is an Arm whose calls pass numbers in the
//! registers of an FPU: that one has an instruction for the root, which no safe function of `core` or
//! `libm` reaches; `libm` computes the root by whole numbers there, in some 60 instructions.

/// √x, correctly rounded; NaN of a negative x.
#[cfg(not(all(target_arch = "arm", target_abi = "eabihf")))]
#[inline(always)]
pub(crate) fn sqrt_f32(x: f32) -> f32 {
    libm::sqrtf(x)
}

/// √x, correctly rounded; NaN of a negative x.
#[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
#[allow(unsafe_code)]
#[inline(always)]
pub(crate) fn sqrt_f32(x: f32) -> f32 {
    let mut bits = x.to_bits();
    // SAFETY: the ABI has single-precision registers, so the processor has VSQRT.F32. The compiler does
    // not give out those registers here (it asks for a target feature that no target of microcontrollers
    // names), so one is borrowed, and has its own number again at the end. The FPU's exception flags may
    // change, and are not said to be preserved. Any value is taken; no memory and no stack is touched, and
    // of one x always the same is made.
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
