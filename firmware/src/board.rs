//! The board under QEMU: output by semihosting, and the panic handler.

use core::panic::PanicInfo;

use cortex_m_semihosting::{debug, hprintln};

/// Ends the run: the program's exit status is 0 if `well`.
pub fn exit(well: bool) -> ! {
    debug::exit(if well {
        debug::EXIT_SUCCESS
    } else {
        debug::EXIT_FAILURE
    });
    loop {
        cortex_m::asm::bkpt();
    }
}

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    hprintln!("{}", info);
    exit(false)
}
