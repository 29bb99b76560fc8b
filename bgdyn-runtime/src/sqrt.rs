//! Square roots for targets with and without `std`.
//!
//! This file has the only `unsafe` code of the crate: one instruction for which `core` and `libm` have no safe function.
//!
//! - On Arm targets with the hard-float ABI `libm` computes roots of `f32` with integers, in some 60 instructions.
//! - On x86-64 `libm` has the instruction in the encoding of SSE. Between instructions of AVX-512 this one root cost some
//!   hundred cycles on an Intel Xeon; the function of `core` is compiled to the encoding of the code around it.

/// Returns √x, correctly rounded; NaN for a negative x.
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
#[allow(unsafe_code)]
#[inline(always)]
pub(crate) fn sqrt_f64(x: f64) -> f64 {
    use core::arch::x86_64::{_mm_cvtsd_f64, _mm_set_sd, _mm_sqrt_sd};
    // SAFETY: the target has SSE2, the only condition of these functions: they read and write no memory.
    unsafe {
        let wide = _mm_set_sd(x);
        _mm_cvtsd_f64(_mm_sqrt_sd(wide, wide))
    }
}

/// Returns √x, correctly rounded; NaN for a negative x.
#[cfg(not(all(target_arch = "x86_64", target_feature = "sse2")))]
#[inline(always)]
pub(crate) fn sqrt_f64(x: f64) -> f64 {
    libm::sqrt(x)
}

/// Returns √x, correctly rounded; NaN for a negative x.
#[cfg(all(target_arch = "x86_64", target_feature = "sse"))]
#[allow(unsafe_code)]
#[inline(always)]
pub(crate) fn sqrt_f32(x: f32) -> f32 {
    use core::arch::x86_64::{_mm_cvtss_f32, _mm_set_ss, _mm_sqrt_ss};
    // SAFETY: the target has SSE, the only condition of these functions: they read and write no memory.
    unsafe { _mm_cvtss_f32(_mm_sqrt_ss(_mm_set_ss(x))) }
}

/// Returns √x, correctly rounded; NaN for a negative x.
#[cfg(not(any(
    all(target_arch = "x86_64", target_feature = "sse"),
    all(target_arch = "arm", target_abi = "eabihf")
)))]
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
