//! Logs as tables, as `bgdyn identify` reads them.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use bgdyn_identification::log::Log;

use crate::JOINTS;
use crate::panda::JOINT_NAMES;

/// Writes a log into a folder and returns its path: time, s; positions, rad; efforts, N·m.
pub fn write(log: &Log, folder: &Path, name: &str) -> Result<PathBuf, String> {
    std::fs::create_dir_all(folder)
        .map_err(|e| format!("the folder {} cannot be made: {e}", folder.display()))?;
    let path = folder.join(name);
    let mut text = String::from("time");
    for quantity in ["q", "tau"] {
        text.extend(JOINT_NAMES.map(|joint| format!(",{quantity}_{joint}")));
    }
    text.push('\n');
    for (row, time) in log.time.iter().enumerate() {
        let rest = (0..JOINTS).map(|j| format!(",{:.7}", log.q[j][row]));
        let rest: String = rest
            .chain((0..JOINTS).map(|j| format!(",{:.5}", log.tau[j][row])))
            .collect();
        // Text in memory has no errors.
        let _ = writeln!(text, "{time:.3}{rest}");
    }
    std::fs::write(&path, text)
        .map_err(|e| format!("{} cannot be written: {e}", path.display()))?;
    Ok(path)
}
