//! No text makes reader, check or importer panic, or break what they promise.
#![no_main]

libfuzzer_sys::fuzz_target!(|text: &str| bgdyn_cli::fuzz_invariants::any_text(text));
