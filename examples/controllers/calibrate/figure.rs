//! The figure: a row of panels for each act.

mod panels;

use std::path::{Path, PathBuf};

use bgdyn_accuracy::plot::{self, Area, Drawn, INK, bold, px, text, write};

use crate::results::Results;

const WIDTH: u32 = 1500;
const HEADER: u32 = 54;
const HEADLINE: u32 = 40;
const ROW: u32 = 330;

/// Draws `calibrate.svg` into the folder `out` and returns its path.
pub fn draw(results: &Results, out: &Path) -> Result<PathBuf, String> {
    std::fs::create_dir_all(out)
        .map_err(|e| format!("the folder {} cannot be made: {e}", out.display()))?;
    let path = out.join("calibrate.svg");
    let height = HEADER + 3 * (HEADLINE + ROW);
    let svg = plot::draw((WIDTH, height), |area| draw_all(results, area));
    std::fs::write(&path, svg).map_err(|e| format!("{} cannot be written: {e}", path.display()))?;
    Ok(path)
}

fn draw_all(results: &Results, area: &Area<'_>) -> Drawn {
    let title = "A Panda is calibrated: its bodies, rotors and friction differ from its spec";
    write(area, (30.0, 30.0), title, text(22, INK))?;
    let (_, mut rest) = area.split_vertically(px(HEADER));
    type Panels = [fn(&Results, &Area<'_>) -> Drawn; 3];
    let rows: [(String, Panels); 3] = [
        (
            first_line(results),
            [panels::motion, panels::efforts, panels::residuals],
        ),
        (
            second_line(results),
            [
                panels::deviations,
                panels::path_errors,
                panels::joint_errors,
            ],
        ),
        (
            third_line(results),
            [panels::mass, panels::load_errors, panels::load_joint_errors],
        ),
    ];
    for (headline, panels) in rows {
        let (row, below) = rest.split_vertically(px(HEADLINE + ROW));
        write(&row, (30.0, 24.0), &headline, bold(15, INK))?;
        let (_, row) = row.split_vertically(px(HEADLINE));
        for (panel, area) in panels.iter().zip(row.split_evenly((1, 3))) {
            panel(results, &area)?;
        }
        rest = below;
    }
    Ok(())
}

fn first_line(results: &Results) -> String {
    let [before, after] = results.efforts.map(|e| 100.0 * e.share);
    format!(
        "1  From a log to numbers: efforts in the whole work space were {before:.1} % wrong, now {after:.3} %"
    )
}

fn second_line(results: &Results) -> String {
    let [before, after] = results.tracking.map(|t| t.whole() * 1e3);
    format!(
        "2  Pick and place under computed torque, the same gains: errors of the joints fall from {before:.1} mrad to {after:.3} mrad (rms)"
    )
}

fn third_line(results: &Results) -> String {
    format!(
        "3  The arm takes up 2 kg that its model does not have: the adaptive law finds the mass to 5 % in {:.1} s",
        results.found_after()
    )
}
