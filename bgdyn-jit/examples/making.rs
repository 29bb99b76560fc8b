//! Prints, for each function of scenes, the number of instructions, the time to machine code, and its size:
//! `cargo run --release -p bgdyn-jit --example making -- examples/closed_machines/delta_pick.scene.yaml …`

use std::path::Path;
use std::time::Instant;

use bgdyn_codegen::files::{beside, stem};
use bgdyn_codegen::tape::Unrolled;
use bgdyn_jit::Jit;

fn main() {
    let jit = Jit::new().expect("machine code on this machine");
    for path in std::env::args().skip(1) {
        let path = Path::new(&path);
        let read = |path: &Path| std::fs::read_to_string(path).map_err(|e| e.to_string());
        let text = read(path).expect("a scene");
        let load = |file: &str| read(&beside(path, file));
        let found = bgdyn_codegen::read_scene(&text, &stem(path), load);
        let (system, _) = found.expect("a sound scene");
        for role in system.roles() {
            let function = system.function(role);
            let instructions = Unrolled::new(&function).instructions.len();
            let begin = Instant::now();
            let code = jit.compile(&function);
            let ms = 1e3 * begin.elapsed().as_secs_f64();
            let (name, scene) = (function.name(), stem(path));
            match code {
                Ok(code) => {
                    let kb = code.bytes() as f64 / 1e3;
                    println!("{scene} {name}: {instructions} instructions, {ms:.1} ms, {kb:.1} kB");
                }
                Err(why) => println!("{scene} {name}: {why}"),
            }
        }
    }
}
