//! Functions that the compiler provides for a bare-metal target and takes from the C library for a hosted
//! one: compiled code copies, fills and compares memory by these four functions.
//!
//! Volatile accesses, otherwise the compiler would recognise the loops and call the functions recursively.

/// Copies `n` bytes forwards.
#[unsafe(no_mangle)]
unsafe extern "C" fn memcpy(to: *mut u8, from: *const u8, n: usize) -> *mut u8 {
    for i in 0..n {
        unsafe { to.add(i).write_volatile(from.add(i).read()) };
    }
    to
}

/// Copies `n` bytes between places that may overlap.
#[unsafe(no_mangle)]
unsafe extern "C" fn memmove(to: *mut u8, from: *const u8, n: usize) -> *mut u8 {
    if to.cast_const() <= from {
        return unsafe { memcpy(to, from, n) };
    }
    for i in (0..n).rev() {
        unsafe { to.add(i).write_volatile(from.add(i).read()) };
    }
    to
}

/// Fills `n` bytes.
#[unsafe(no_mangle)]
unsafe extern "C" fn memset(to: *mut u8, byte: i32, n: usize) -> *mut u8 {
    for i in 0..n {
        unsafe { to.add(i).write_volatile(byte as u8) };
    }
    to
}

/// The difference of the first two bytes that differ.
#[unsafe(no_mangle)]
unsafe extern "C" fn memcmp(a: *const u8, b: *const u8, n: usize) -> i32 {
    for i in 0..n {
        let (a, b) = unsafe { (a.add(i).read_volatile(), b.add(i).read_volatile()) };
        if a != b {
            return i32::from(a) - i32::from(b);
        }
    }
    0
}
