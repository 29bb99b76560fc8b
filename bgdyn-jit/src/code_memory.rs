//! Memory with machine code. This file has the only `unsafe` code of the crate: the call of that code.
#![allow(unsafe_code)]

use std::io;

use bgdyn_codegen::tape::ArgumentArray;
use memmap2::{Mmap, MmapMut};

/// Code for one function, before it can be called.
///
/// Its author promises that the code
/// - is for the processor that runs, complete (nothing in it is to be filled in), independent of its address, and begins
///   with its entry, a function of the C convention: [`Entry`];
/// - reads, of the array with the number k in [`ArgumentArray`], components below `arguments[k]` only;
/// - writes the results with numbers below `results` only, and its own stack, of which it touches each page in order;
/// - calls nothing but functions of one number that do not unwind, and returns.
pub(crate) struct Code<'a> {
    pub bytes: &'a [u8],
    pub arguments: [usize; ArgumentArray::COUNT],
    pub results: usize,
}

/// Reads the arrays of arguments and writes the results; returns 0 if they are not to be used.
type Entry = unsafe extern "C" fn(arrays: *const *const f64, results: *mut f64) -> u32;

/// Memory with the code of a function, given back when it is dropped.
#[derive(Debug)]
pub(crate) struct CodeMemory {
    code: Mmap,
    arguments: [usize; ArgumentArray::COUNT],
    results: usize,
}

impl CodeMemory {
    /// Copies code to memory that can be executed, and no longer be written.
    pub(crate) fn new(of: &Code<'_>) -> io::Result<Self> {
        let mut memory = MmapMut::map_anon(of.bytes.len())?;
        memory.copy_from_slice(of.bytes);
        Ok(CodeMemory {
            code: executable(memory)?,
            arguments: of.arguments,
            results: of.results,
        })
    }

    /// Returns the size of the code, in bytes.
    pub(crate) fn len(&self) -> usize {
        self.code.len()
    }

    /// Returns the number of results.
    pub(crate) fn results(&self) -> usize {
        self.results
    }

    /// Calls the code; returns whether the results can be used.
    ///
    /// # Panics
    /// If an array lacks a component that the code reads, or the number of results is another one.
    pub(crate) fn call(&self, arrays: [&[f64]; ArgumentArray::COUNT], results: &mut [f64]) -> bool {
        assert_eq!(results.len(), self.results, "the number of results");
        for (array, count) in arrays.iter().zip(self.arguments) {
            assert!(array.len() >= count, "{} of {count} arguments", array.len());
        }
        let pointers = arrays.map(<[f64]>::as_ptr);
        // SAFETY: `Code` promises that an `Entry` begins here, and that it reads and writes only what was just checked to
        // be there: `pointers` has a pointer for each array, `arrays` and `results` are borrowed during the call, and
        // `results` by nobody else. The memory was not written since it became executable, and is freed by `Mmap` only
        // when `self` is dropped, which the borrow of `self` excludes during the call. The code has no state of its own,
        // so that threads can call it together.
        let usable = unsafe {
            let entry = std::mem::transmute::<*const u8, Entry>(self.code.as_ptr());
            entry(pointers.as_ptr(), results.as_mut_ptr())
        };
        usable != 0
    }
}

/// Makes memory executable.
#[cfg(not(target_arch = "aarch64"))]
fn executable(memory: MmapMut) -> io::Result<Mmap> {
    memory.make_exec()
}

/// Makes memory executable. Instructions have a cache of their own here, and were perhaps fetched already.
#[cfg(target_arch = "aarch64")]
fn executable(memory: MmapMut) -> io::Result<Mmap> {
    use wasmtime_internal_jit_icache_coherence::{clear_cache, pipeline_flush_mt};
    // SAFETY: pointer and length are those of mapped memory that can be written.
    unsafe { clear_cache(memory.as_ptr().cast(), memory.len()) }.map_err(io::Error::other)?;
    let code = memory.make_exec()?;
    pipeline_flush_mt().map_err(io::Error::other)?;
    Ok(code)
}
