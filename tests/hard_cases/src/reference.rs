//! Reference solutions: samples of motions, and the comparison with them.

use serde_json::Value;

use crate::outcome::Deviation;

/// Samples of a motion.
pub(crate) struct Reference {
    file: Value,
    /// Names of the columns after the time.
    columns: Vec<String>,
    /// Times, s.
    pub times: Vec<f64>,
    rows: Vec<Vec<f64>>,
}

/// The reference solution of this name, from `tests/hard_cases`.
macro_rules! reference {
    ($name:ident) => {
        $crate::reference::Reference::read(include_str!(concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../hard_cases/",
            stringify!($name),
            ".json"
        )))
    };
    ($name:literal) => {
        $crate::reference::Reference::read(include_str!(concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../hard_cases/",
            $name,
            ".json"
        )))
    };
}
pub(crate) use reference;

impl Reference {
    /// Parses the text of a file.
    ///
    /// # Panics
    /// If it is no reference solution.
    pub fn read(text: &str) -> Reference {
        let file: Value = serde_json::from_str(text).expect("a reference solution");
        let names = list(&file["columns"]).iter();
        let names = names.map(|name| name.as_str().expect("a name"));
        assert_eq!(names.clone().next(), Some("t"), "the time comes first");
        let columns = names.skip(1).map(str::to_owned).collect();
        let rows: Vec<Vec<f64>> = list(&file["samples"]).iter().map(numbers).collect();
        Reference {
            columns,
            times: rows.iter().map(|row| row[0]).collect(),
            rows: rows.into_iter().map(|row| row[1..].to_vec()).collect(),
            file,
        }
    }

    /// Returns the samples that satisfy a condition on index and time.
    pub fn only(mut self, holds: impl Fn(usize, f64) -> bool) -> Reference {
        let numbered = self.times.into_iter().zip(self.rows).enumerate();
        let held = numbered.filter(|(k, (t, _))| holds(*k, *t));
        (self.times, self.rows) = held.map(|(_, sample)| sample).unzip();
        self
    }

    /// Returns, for each sample of the file, the deviation that rounding explains.
    ///
    /// # Panics
    /// If the file has none.
    pub fn tolerances(&self) -> Vec<f64> {
        numbers(&self.file["tolerance_f64_per_sample"])
    }

    /// Returns a list of the invariants.
    ///
    /// # Panics
    /// If the file has no such list.
    pub fn invariants(&self, name: &str) -> Vec<f64> {
        numbers(&self.file["invariants"][name])
    }

    /// Returns a number of the invariants.
    ///
    /// # Panics
    /// If the file has no such number.
    pub fn invariant(&self, name: &str) -> f64 {
        self.file["invariants"][name].as_f64().expect("a number")
    }

    /// Returns a list of the parameters.
    ///
    /// # Panics
    /// If the file has no such list.
    pub fn parameters(&self, name: &str) -> Vec<f64> {
        numbers(&self.file["parameters"][name])
    }

    /// Returns the values of all columns but the time, sample by sample.
    pub fn rows(&self) -> &[Vec<f64>] {
        &self.rows
    }

    /// Gives the quaternion from a column of each found sample the sign of the expected one: q and −q are
    /// one orientation.
    pub fn with_signs(&self, mut found: Vec<Vec<f64>>, column: usize) -> Vec<Vec<f64>> {
        let quaternion = column..column + 4;
        for (found, wanted) in found.iter_mut().zip(&self.rows) {
            let pairs = quaternion.clone().map(|i| found[i] * wanted[i]);
            if pairs.sum::<f64>() < 0.0 {
                for x in &mut found[quaternion.clone()] {
                    *x = -*x;
                }
            }
        }
        found
    }

    /// Values of these columns, sample by sample.
    fn values(&self, columns: &[&str]) -> Vec<Vec<f64>> {
        let place = |name: &&str| {
            let found = self.columns.iter().position(|column| column == name);
            found.expect("a column of the file")
        };
        let places: Vec<usize> = columns.iter().map(place).collect();
        let of = |row: &Vec<f64>| places.iter().map(|&i| row[i]).collect();
        self.rows.iter().map(of).collect()
    }

    /// Compares all columns with the samples; `allowed` by index.
    pub fn all(&self, found: &[Vec<f64>], allowed: impl Fn(usize) -> f64) -> Vec<Deviation> {
        self.compare(found, &self.rows, |_| 1.0, allowed)
    }

    /// Compares some columns with the samples; `allowed` by index.
    pub fn columns(
        &self,
        columns: &[&str],
        found: &[Vec<f64>],
        allowed: impl Fn(usize) -> f64,
    ) -> Vec<Deviation> {
        self.compare(found, &self.values(columns), |_| 1.0, allowed)
    }

    /// Returns the names of the columns after the time.
    pub fn names(&self) -> Vec<&str> {
        self.columns.iter().map(String::as_str).collect()
    }

    /// Compares some columns with the samples.
    pub fn some(&self, columns: &[&str], found: &[Vec<f64>], allowed: f64) -> Vec<Deviation> {
        self.compare(found, &self.values(columns), |_| 1.0, |_| allowed)
    }

    /// [`Reference::some`] relative to the expected values.
    pub fn relative(&self, columns: &[&str], found: &[Vec<f64>], allowed: f64) -> Vec<Deviation> {
        self.compare(found, &self.values(columns), f64::abs, |_| allowed)
    }

    /// Compares quantities that are computed from some columns.
    pub fn parts(
        &self,
        columns: &[&str],
        found: &[Vec<f64>],
        quantities: impl Fn(&[f64]) -> Vec<f64>,
        allowed: f64,
    ) -> Vec<Deviation> {
        let of = |rows: &[Vec<f64>]| rows.iter().map(|row| quantities(row)).collect::<Vec<_>>();
        let wanted = of(&self.values(columns));
        self.compare(&of(found), &wanted, |_| 1.0, |_| allowed)
    }

    /// Returns the largest deviation of each sample, in units of a size.
    fn compare(
        &self,
        found: &[Vec<f64>],
        wanted: &[Vec<f64>],
        size: impl Fn(f64) -> f64,
        allowed: impl Fn(usize) -> f64,
    ) -> Vec<Deviation> {
        assert_eq!(found.len(), wanted.len(), "samples");
        let mut deviations = vec![];
        for (k, (found, wanted)) in found.iter().zip(wanted).enumerate() {
            assert_eq!(found.len(), wanted.len(), "columns");
            let parts = found.iter().zip(wanted);
            let parts = parts.map(|(x, w)| (x - w).abs() / size(*w));
            deviations.push(Deviation {
                t: self.times[k],
                measured: parts.fold(0.0, larger),
                allowed: allowed(k),
            });
        }
        deviations
    }
}

/// Returns the larger number; NaN is larger than all others.
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if a.total_cmp(&b).is_lt() { b } else { a }
}

fn list(value: &Value) -> &Vec<Value> {
    value.as_array().expect("a list")
}

fn numbers(value: &Value) -> Vec<f64> {
    let number = |x: &Value| x.as_f64().expect("a number");
    list(value).iter().map(number).collect()
}
