//! The planned motion as a table.

use bgdyn_identification::Model;
use bgdyn_identification::excite::Excitation;

/// Returns the table: a period at `rate`, Hz. Efforts are `predicted_tau_JOINT`, so that `identify` does not take the
/// plan for a log.
pub(crate) fn table(
    name: &str,
    model: &Model<'_>,
    found: &Excitation,
    efforts: &dyn Fn(f64) -> Vec<f64>,
    rate: f64,
) -> String {
    let head = |of: &str| -> Vec<String> {
        let names = model.joints.iter().map(|j| format!("{of}_{}", j.name));
        names.collect()
    };
    let mut header = vec!["time".to_owned()];
    header.extend(
        ["q", "v", "a", "predicted_tau"]
            .iter()
            .flat_map(|of| head(of)),
    );
    let mut lines = vec![
        format!(
            "# A planned motion of {name}, no log: efforts are those of the file's numbers. One period; SI units."
        ),
        header.join(","),
    ];
    for i in 0..rows(found, rate) {
        let t = i as f64 / rate;
        let state = found.motion.at(t);
        let numbers = [state.q, state.v, state.a, efforts(t)].concat();
        let numbers = numbers.iter().map(|x| decimal(*x));
        let line: Vec<String> = std::iter::once(format!("{t:.6}")).chain(numbers).collect();
        lines.push(line.join(","));
    }
    lines.join("\n") + "\n"
}

/// Returns a number with nine decimals; zero has no sign.
fn decimal(x: f64) -> String {
    let text = format!("{x:.9}");
    match text.strip_prefix('-') {
        Some(size) if size.bytes().all(|b| matches!(b, b'0' | b'.')) => size.to_owned(),
        _ => text,
    }
}

/// Returns the count of rows of a period: its end is the start of the next one.
fn rows(found: &Excitation, rate: f64) -> usize {
    (found.motion.period() * rate - 1e-6).ceil() as usize
}
