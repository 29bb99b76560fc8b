//! Memory of prepared functions: a program of its own, because it counts the mappings of the whole process.
#![cfg(target_os = "linux")]

use std::path::Path;

use bgdyn_codegen::engine::{CallArguments, Engine};
use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::selection;
use bgdyn_jit::Jit;

/// Returns the numbers of this process in a file of the kernel.
fn of_process(file: &str) -> String {
    std::fs::read_to_string(format!("/proc/self/{file}")).expect("a file of the kernel")
}

/// Returns the number of mappings with code that are of no file.
fn mappings() -> usize {
    let maps = of_process("maps");
    let own = |line: &&str| line.contains(" r-xp ") && line.split_whitespace().count() == 5;
    maps.lines().filter(own).count()
}

/// Returns the memory that the process uses, in pages.
fn pages() -> i64 {
    let numbers = of_process("statm");
    let mut numbers = numbers.split_whitespace().map(str::parse);
    numbers.nth(1).expect("the resident set").expect("a number")
}

/// The memory for code is there while a function is, and other memory does not grow.
#[test]
fn dropped_functions_leave_nothing() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs/scara.yaml");
    let text = std::fs::read_to_string(path).expect("a spec");
    let mechanism = bgdyn_codegen::read(&text, Some("scara")).0.expect("sound");
    let function = selection::function(&mechanism, Method::ForwardDynamics, &Options::default());
    let function = function.expect("every formulation knows it");
    let jit = Jit::new().expect("machine code on this machine");
    let at = CallArguments {
        q: &[0.1, 0.2, 0.3, 0.4],
        v: &[1.0; 4],
        u: &[2.0; 4],
        ..CallArguments::default()
    };
    let mut wanted = None;
    let mut prepare = |count: usize| {
        for _ in 0..count {
            let prepared = jit.prepare(&function);
            assert_eq!(prepared.engine(), jit.name());
            let found = prepared.value(&at);
            assert_eq!(&found, wanted.get_or_insert(found.clone()));
        }
    };
    prepare(50);
    let (before, pages_before) = (mappings(), pages());
    prepare(400);
    let grown = pages() - pages_before;
    // A leak of the code alone would be 400 pages, and one of the lists far more.
    assert!(grown < 200, "{grown} pages more");
    let alive: Vec<_> = (0..20).map(|_| jit.prepare(&function)).collect();
    assert!(mappings() > before, "code is in mappings of its own");
    assert!(alive.iter().all(|f| f.value(&at) == alive[0].value(&at)));
    drop(alive);
    assert_eq!(mappings(), before);
}
