//! Options of an identification.

/// Options.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Cut of the filter, Hz; from the spectrum without it.
    pub cut: Option<f64>,
    /// λ: 1 means that to change a body by itself costs one deviation.
    pub prior: f64,
    /// Rows of joints slower than this have no weight, rad/s or m/s.
    pub skip_below: f64,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            cut: None,
            prior: 1.0,
            skip_below: 0.0,
        }
    }
}
