//! Draws the plots of docs/peers.md and docs/peers_loops.md: `plots ratios|errors FILE.svg`, with the numbers as JSON on
//! stdin, from `plot.py` beside the measurements.

mod errors;
mod ratios;

use std::error::Error;

use bgdyn_accuracy::plot::{BLUE, GREEN, ORANGE, PINK, RGBColor, SKY};

/// Colours of the systems, in their order.
const COLOURS: [RGBColor; 5] = [ORANGE, BLUE, GREEN, PINK, SKY];

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let input = std::io::stdin();
    let (svg, path) = match &arguments[..] {
        [what, path] if what == "ratios" => (ratios::draw(&serde_json::from_reader(input)?), path),
        [what, path] if what == "errors" => (errors::draw(&serde_json::from_reader(input)?), path),
        _ => return Err("usage: plots ratios|errors FILE.svg <NUMBERS.json".into()),
    };
    std::fs::write(path, svg).map_err(|e| format!("{path} cannot be written: {e}"))?;
    Ok(())
}
