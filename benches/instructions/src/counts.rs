//! Instruction counts by probe: parses the profile, reads and writes a file, compares.

use std::collections::BTreeMap;
use std::fmt::Write;

/// Number of calls of each probe.
pub const CALLS: usize = 32;

/// Permitted relative increase of a probe over the recorded count.
pub const WORSE: f64 = 0.02;

/// Instructions of a call, by probe: `panda::double::mass_matrix`.
pub type Counts = BTreeMap<String, f64>;

/// Parses the counts of a profile, as printed by `callgrind_annotate --inclusive=yes`: a line `12,345
/// (1.00%)  file:probes::panda::double::mass_matrix::h… [program]` for each function.
pub fn of_profile(text: &str, calls: usize) -> Counts {
    let probe = |line: &str| {
        let (count, rest) = line.trim_start().split_once(' ')?;
        let count: f64 = count.replace(',', "").parse().ok()?;
        let name = rest.split_once(":probes::")?.1;
        let name = name.split([' ', '\'']).next()?;
        let name = name.rsplit_once("::h").map_or(name, |(name, _)| name);
        let counted = name.matches("::").count() == 2 && !name.ends_with("::run");
        counted.then(|| (name.to_owned(), count / calls as f64))
    };
    text.lines().filter_map(probe).collect()
}

/// Parses the counts of a file.
pub fn of_file(text: &str) -> Result<Counts, String> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let pairs = reader.deserialize::<(String, f64)>();
    pairs.map(|pair| pair.map_err(|e| e.to_string())).collect()
}

/// Returns the text of a file of counts.
pub fn file(counts: &Counts) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut write = |record: [&str; 2]| writer.write_record(record).expect("memory");
    write(["probe", "instructions"]);
    for (name, count) in counts {
        write([name, &format!("{count:.3}")]);
    }
    String::from_utf8(writer.into_inner().expect("memory")).expect("names are text")
}

/// Returns the changes by more than a thousandth, a line each, and whether no count is too much worse. A
/// probe that exists on one side only is just reported: the compiler merges functions of the same code.
pub fn compared(known: &Counts, found: &Counts) -> (String, bool) {
    let (mut text, mut worse) = (String::new(), false);
    for (name, &before) in known {
        let Some(&now) = found.get(name) else {
            writeln!(text, "{name}: not counted any more").unwrap();
            continue;
        };
        let by = now / before - 1.0;
        let fails = by > WORSE;
        worse |= fails;
        if by.abs() > 1e-3 {
            let mark = if fails { "  TOO MUCH" } else { "" };
            let percent = 100.0 * by;
            writeln!(
                text,
                "{name}: {before:.1} -> {now:.1} ({percent:+.1} %){mark}"
            )
            .unwrap();
        }
    }
    for (name, now) in found.iter().filter(|(name, _)| !known.contains_key(*name)) {
        writeln!(text, "{name}: {now:.1}, not on file").unwrap();
    }
    (text, worse)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn probes_are_found_in_a_profile() {
        let text = "\
 14,246,489 ( 4.08%)  ???:probes::panda::double::run [program]
     21,657 ( 0.01%)  ???:probes::panda::double::mass_matrix [program]
     10,400 ( 0.01%)  a.rs:probes::panda::lanes::bias::h0123456789abcdef [program]
     20,000 ( 0.01%)  ???:bgdyn_runtime::sine::large::sin_cos [program]
";
        let found = of_profile(text, 100);
        let wanted = [
            ("panda::double::mass_matrix", 216.57),
            ("panda::lanes::bias", 104.0),
        ];
        assert_eq!(found, wanted.map(|(name, n)| (name.to_owned(), n)).into());
        assert_eq!(of_file(&file(&found)).unwrap()["panda::lanes::bias"], 104.0);
        assert!(of_file("probe,instructions\na::b::c,many\n").is_err());
    }

    #[test]
    fn more_than_two_percent_is_too_much() {
        let counts = |n: f64| Counts::from([("a::b::c".to_owned(), n)]);
        assert_eq!(
            compared(&counts(100.0), &counts(100.0)),
            (String::new(), false)
        );
        let (text, worse) = compared(&counts(100.0), &counts(101.9));
        assert!(text.contains("+1.9 %") && !worse, "{text}");
        let (text, worse) = compared(&counts(100.0), &counts(102.1));
        assert!(text.contains("TOO MUCH") && worse, "{text}");
        let (text, worse) = compared(&counts(100.0), &Counts::new());
        assert!(text.contains("not counted any more") && !worse, "{text}");
    }
}
