//! A process without a C library: entry point, output and exit.
#![allow(unsafe_code)] // calls of the system

use core::arch::asm;
use core::fmt::{Arguments, Write};
use core::panic::PanicInfo;

/// Numbers of Linux system calls on RISC-V.
const WRITE: usize = 64;
const EXIT: usize = 93;

/// The entry point, with the stack that the system has set up.
#[unsafe(no_mangle)]
extern "C" fn _start() -> ! {
    exit(if super::run() { 0 } else { 1 })
}

/// Writes a line to the standard output.
pub fn print(line: Arguments<'_>) {
    // An error of a closed output is ignored.
    let _ = writeln!(Output, "{line}");
}

struct Output;

impl Write for Output {
    fn write_str(&mut self, text: &str) -> core::fmt::Result {
        // SAFETY: the bytes exist for the duration of the call.
        unsafe { call(WRITE, 1, text.as_ptr() as usize, text.len()) };
        Ok(())
    }
}

fn exit(status: usize) -> ! {
    // SAFETY: the call ends the process.
    unsafe { call(EXIT, status, 0, 0) };
    loop {}
}

/// Makes a system call.
///
/// # Safety
/// The requirements of the system call.
unsafe fn call(number: usize, a: usize, b: usize, c: usize) {
    // SAFETY: guaranteed by the caller.
    unsafe { asm!("ecall", in("a7") number, inlateout("a0") a => _, in("a1") b, in("a2") c) };
}

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    print(format_args!("{info}"));
    exit(2)
}
