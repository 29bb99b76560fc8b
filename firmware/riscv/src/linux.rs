//! A process without a C library: where it starts, how it writes and ends.
#![allow(unsafe_code)] // calls of the system

use core::arch::asm;
use core::fmt::{Arguments, Write};
use core::panic::PanicInfo;

/// Numbers of Linux' calls on RISC-V.
const WRITE: usize = 64;
const EXIT: usize = 93;

/// Where the program starts, on the stack that the system has set up.
#[unsafe(no_mangle)]
extern "C" fn _start() -> ! {
    exit(if super::run() { 0 } else { 1 })
}

/// Writes a line to the standard output.
pub fn print(line: Arguments<'_>) {
    // Nothing can be done about an output that is closed.
    let _ = writeln!(Output, "{line}");
}

struct Output;

impl Write for Output {
    fn write_str(&mut self, text: &str) -> core::fmt::Result {
        // SAFETY: the bytes are there for as long as the call takes.
        unsafe { call(WRITE, 1, text.as_ptr() as usize, text.len()) };
        Ok(())
    }
}

fn exit(status: usize) -> ! {
    // SAFETY: ends the process.
    unsafe { call(EXIT, status, 0, 0) };
    loop {}
}

/// A call of the system.
///
/// # Safety
/// That of the call.
unsafe fn call(number: usize, a: usize, b: usize, c: usize) {
    // SAFETY: the caller's.
    unsafe { asm!("ecall", in("a7") number, inlateout("a0") a => _, in("a1") b, in("a2") c) };
}

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    print(format_args!("{info}"));
    exit(2)
}
