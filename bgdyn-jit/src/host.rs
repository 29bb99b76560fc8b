//! The processor for which code is made: the one that runs.

use std::sync::Arc;

use cranelift_codegen::isa::TargetIsa;
use cranelift_codegen::settings::{self, Configurable};

use crate::refusal::Refusal;

/// Why machine code is not made for this system, though Cranelift could.
const NOT_HERE: Option<&str> = if cfg!(all(target_os = "macos", target_arch = "aarch64")) {
    // Memory for code has to be mapped there with MAP_JIT, and written between calls of pthread_jit_write_protect_np.
    Some("macOS on ARM demands memory for code of a kind that is not supported")
} else if cfg!(any(target_arch = "x86_64", target_arch = "aarch64")) {
    None
} else {
    Some("machine code is made for x86-64 and AArch64 only")
};

/// Settings of Cranelift. No code may depend on where it is, since it is copied; a stack that is too small must end at
/// its guard page.
const SETTINGS: [(&str, &str); 6] = [
    ("opt_level", "speed"),
    ("is_pic", "false"),
    ("unwind_info", "false"),
    ("enable_probestack", "true"),
    ("probestack_strategy", "inline"),
    (
        "enable_verifier",
        if cfg!(debug_assertions) {
            "true"
        } else {
            "false"
        },
    ),
];

/// How Cranelift gives registers to values.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Registers {
    /// With much search: the fastest code. The time grows with the square of a long function.
    Searched,
    /// In one pass over the function: the time grows as the function, and the code is some 40 % longer.
    InOnePass,
}

/// Returns the description of the processor that runs, with the instructions that it has.
pub(crate) fn isa(registers: Registers) -> Result<Arc<dyn TargetIsa>, Refusal> {
    if let Some(why) = NOT_HERE {
        return Err(Refusal::Host(why));
    }
    let mut flags = settings::builder();
    let algorithm = match registers {
        Registers::Searched => "backtracking",
        Registers::InOnePass => "single_pass",
    };
    for (name, value) in SETTINGS
        .into_iter()
        .chain([("regalloc_algorithm", algorithm)])
    {
        flags
            .set(name, value)
            .map_err(|e| Refusal::Compiler(e.to_string()))?;
    }
    let builder = cranelift_native::builder().map_err(Refusal::Host)?;
    builder
        .finish(settings::Flags::new(flags))
        .map_err(|e| Refusal::Compiler(e.to_string()))
}

/// Returns whether the processor has fused operations.
pub(crate) fn can_fuse() -> bool {
    #[cfg(target_arch = "x86_64")]
    {
        std::is_x86_feature_detected!("fma") && std::is_x86_feature_detected!("avx")
    }
    #[cfg(not(target_arch = "x86_64"))]
    {
        cfg!(target_arch = "aarch64")
    }
}
