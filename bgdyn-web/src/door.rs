//! What WebAssembly exports, in terms of numbers: text goes through the memory of the module.
//!
//! A page calls `bgdyn_request(length)`, writes so many bytes of UTF-8 to the address that it returns, calls
//! `bgdyn_answer()`, and reads `bgdyn_answer_length()` bytes at `bgdyn_answer_address()`. The module calls `progress` of the page,
//! if there is one, with the finished fraction of a run.
//!
//! This file has the only `unsafe` of the crate, and nothing in it is a pointer that Rust follows:
//! - Attributes `unsafe(no_mangle)` promise that no other symbol has the name. Names begin with `bgdyn_`.
//! - `progress` is declared as imported, and is `safe`: a function of JavaScript receives a number, and can do nothing to
//!   the module's memory that it could not do at any time.
//! - The addresses are those of vectors that stay as they are until the next call. JavaScript writes only between
//!   `request` and `answer`, while no reference to the bytes exists.
#![allow(unsafe_code)]

use std::cell::RefCell;

use crate::request::call;

thread_local! {
    /// The bytes of the request and of the answer.
    static TEXTS: RefCell<[Vec<u8>; 2]> = const { RefCell::new([Vec::new(), Vec::new()]) };
}

#[cfg(target_arch = "wasm32")]
#[link(wasm_import_module = "page")]
unsafe extern "C" {
    /// Tells the page the finished fraction of a run.
    safe fn progress(share: f64);
}

/// Outside of a page nobody watches.
#[cfg(not(target_arch = "wasm32"))]
fn progress(_: f64) {}

/// Returns the address for a request of so many bytes.
#[unsafe(no_mangle)]
pub extern "C" fn bgdyn_request(length: usize) -> *mut u8 {
    TEXTS.with_borrow_mut(|[request, _]| {
        *request = vec![0; length];
        request.as_mut_ptr()
    })
}

/// Answers the request.
#[unsafe(no_mangle)]
pub extern "C" fn bgdyn_answer() {
    let request = TEXTS.with_borrow_mut(|[request, _]| std::mem::take(request));
    note_panics();
    let answer = call(&String::from_utf8_lossy(&request), &mut |share| {
        progress(share)
    });
    TEXTS.with_borrow_mut(|[_, kept]| *kept = answer.into_bytes());
}

/// Returns the number of bytes of the answer.
#[unsafe(no_mangle)]
pub extern "C" fn bgdyn_answer_length() -> usize {
    TEXTS.with_borrow(|[_, answer]| answer.len())
}

/// Returns the address of the answer: after a panic that of its message.
#[unsafe(no_mangle)]
pub extern "C" fn bgdyn_answer_address() -> *const u8 {
    TEXTS.with_borrow(|[_, answer]| answer.as_ptr())
}

/// Lets a panic leave its message as the answer, for a page to read after the trap.
fn note_panics() {
    std::panic::set_hook(Box::new(|info| {
        let message = info.to_string().into_bytes();
        TEXTS.with_borrow_mut(|[_, answer]| *answer = message);
    }));
}
