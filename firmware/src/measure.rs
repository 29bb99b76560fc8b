//! Measures instructions and stack of a call.
#![allow(unsafe_code)] // registers of the timer, and the stack below the stack pointer

use core::hint::black_box;
use core::ptr;

/// The board's timer 0 (CMSDK APB timer): counts down at 25 MHz.
const TIMER: usize = 0x4000_0000;
const CONTROL: *mut u32 = TIMER as *mut u32;
const VALUE: *mut u32 = (TIMER + 4) as *mut u32;
const RELOAD: *mut u32 = (TIMER + 8) as *mut u32;

/// Number of bytes below the stack pointer that are painted, and their value.
const PAINTED: usize = 32 * 1024;
const PAINT: u32 = 0xdead_beef;

/// Counts instructions, under `-icount shift=8`: 256 ns of the board's clock each, 6.4 ticks of its timer,
/// so that an error of one tick has no effect.
#[derive(Debug)]
pub struct Counter {
    /// The count of two readings with nothing between them.
    own: u32,
}

impl Counter {
    /// Starts the timer.
    pub fn start() -> Self {
        // SAFETY: registers of the board's timer, which nothing else uses.
        unsafe {
            RELOAD.write_volatile(u32::MAX);
            VALUE.write_volatile(u32::MAX);
            CONTROL.write_volatile(1);
        }
        let mut counter = Counter { own: 0 };
        counter.own = counter.of(|| ());
        counter
    }

    /// Returns the instructions of `call`: a call and its return with its arguments set up.
    #[inline(always)]
    pub fn of(&self, call: impl FnOnce()) -> u32 {
        let before = ticks();
        call();
        let after = ticks();
        // In tenths of a tick, rounded.
        ((before.wrapping_sub(after)) * 10 + 32) / 64 - self.own
    }
}

#[inline(always)]
fn ticks() -> u32 {
    // SAFETY: as in `start`.
    unsafe { VALUE.read_volatile() }
}

/// Returns the bytes of stack that `call` uses, including its return address and saved registers.
#[inline(never)]
pub fn stack(call: &mut dyn FnMut()) -> usize {
    let call = black_box(call);
    let top = cortex_m::register::msp::read() as usize;
    let bottom = top - PAINTED;
    // SAFETY: free memory of the board between the stack pointer and the statics: nothing interrupts,
    // and no function is called between reading the stack pointer and the call, or after it.
    unsafe {
        let mut at = bottom;
        while at < top {
            ptr::with_exposed_provenance_mut::<u32>(at).write_volatile(PAINT);
            at += 4;
        }
    }
    call();
    let mut at = bottom;
    // SAFETY: as above.
    while at < top && unsafe { ptr::with_exposed_provenance::<u32>(at).read_volatile() } == PAINT {
        at += 4;
    }
    top - at
}

/// Returns whether the processor computes with `f64`: the Cortex-M7 of the board does, the M4 does not.
pub fn double_precision() -> bool {
    // SAFETY: the identification register of the processor is read-only.
    let part = unsafe { (*cortex_m::peripheral::CPUID::PTR).base.read() } >> 4 & 0xfff;
    part == 0xc27
}
