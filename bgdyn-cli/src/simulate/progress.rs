//! Displays the progress of a long run on a terminal.

use std::io::{IsTerminal, stderr};
use std::time::{Duration, Instant};

use crate::output::tell;

/// Shorter runs have no display.
const PATIENCE: Duration = Duration::from_secs(1);
/// Time between two lines.
const PAUSE: Duration = Duration::from_millis(200);

/// A line on stderr, if that is a terminal, with the progress of a run.
pub(crate) struct Progress {
    what: &'static str,
    next: Option<Instant>,
    shown: bool,
}

impl Progress {
    /// Returns the display of a run that begins now.
    pub(crate) fn new(what: &'static str) -> Self {
        let next = stderr().is_terminal().then(|| Instant::now() + PATIENCE);
        let shown = false;
        Progress { what, next, shown }
    }

    /// Displays the finished fraction.
    pub(crate) fn at(&mut self, share: f64) {
        let now = Instant::now();
        if self.next.is_some_and(|next| now >= next) {
            tell(&format!("\rbgdyn: {} {:3.0} %", self.what, 100.0 * share));
            self.next = Some(now + PAUSE);
            self.shown = true;
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if self.shown {
            tell("\r\x1b[K");
        }
    }
}
