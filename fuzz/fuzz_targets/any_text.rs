//! Checks that no text makes parser, check or importer panic, or violates their invariants.
#![no_main]

libfuzzer_sys::fuzz_target!(|text: &str| bgdyn_cli::fuzz_invariants::any_text(text));
