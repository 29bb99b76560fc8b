//! Changes of a text: numbers in place, their comments at the ends of their lines, the rest untouched.

use std::collections::BTreeMap;
use std::ops::Range;

use bgdyn_runtime::Digits;

/// A number that is replaced.
pub(super) struct NewNumber {
    /// The number.
    pub(super) value: f64,
    /// Its deviation.
    pub(super) deviation: f64,
    /// The number, or its text, in the file.
    pub(super) was: String,
    /// The share that comes from the log.
    pub(super) from_log: f64,
}

/// Changes of a text.
pub(super) struct Edits<'a> {
    text: &'a str,
    replaced: Vec<(Range<usize>, String)>,
    /// Numbers by the end of their line.
    comments: BTreeMap<usize, Vec<NewNumber>>,
}

impl<'a> Edits<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Edits {
            text,
            replaced: Vec::new(),
            comments: BTreeMap::new(),
        }
    }

    /// Replaces bytes by a number, with its comment.
    pub(super) fn number(&mut self, bytes: Range<usize>, number: NewNumber) {
        let text = written(number.value);
        self.replaced.push((bytes.clone(), text));
        self.comment(bytes.end, number);
    }

    /// Adds the comment of a number at the end of a line.
    pub(super) fn comment(&mut self, at: usize, number: NewNumber) {
        let end = end_of_line(self.text, at);
        self.comments.entry(end).or_default().push(number);
    }

    /// Replaces bytes by a text.
    pub(super) fn text(&mut self, bytes: Range<usize>, text: String) {
        self.replaced.push((bytes, text));
    }

    /// Returns the text with all changes; new lines end as the first line of the text.
    pub(super) fn apply(mut self) -> String {
        for (end, numbers) in std::mem::take(&mut self.comments) {
            let line = self.text[..end].rsplit('\n').next().unwrap_or("");
            let mark = if line.contains(" #") { "; " } else { " # " };
            let insertion = (end..end, format!("{mark}{}", remark(&numbers)));
            // Before lines that are inserted at the same place.
            let at = self
                .replaced
                .iter()
                .position(|(range, _)| range.start == end && range.end == end);
            self.replaced
                .insert(at.unwrap_or(self.replaced.len()), insertion);
        }
        self.replaced
            .sort_by_key(|(range, _)| (range.start, range.end));
        let returns = self.text[..self.text.find('\n').unwrap_or(0)].ends_with('\r');
        let (mut text, mut at) = (String::new(), 0);
        for (range, new) in self.replaced {
            text += &self.text[at..range.start];
            text += &if returns {
                new.replace('\n', "\r\n")
            } else {
                new
            };
            at = range.end;
        }
        text + &self.text[at..]
    }
}

/// Returns where the line of a byte ends, before its `\r\n` or `\n`.
pub(super) fn end_of_line(text: &str, at: usize) -> usize {
    let end = text[at..].find('\n').map_or(text.len(), |n| at + n);
    end - usize::from(text[..end].ends_with('\r'))
}

/// Returns `± 0.08; was 3.2286; mostly from the file`.
fn remark(numbers: &[NewNumber]) -> String {
    let join = |each: &dyn Fn(&NewNumber) -> String| {
        numbers.iter().map(each).collect::<Vec<_>>().join(", ")
    };
    let deviations = join(&|n| digits(n.deviation, 2));
    let mut text = format!("± {deviations}; was {}", join(&|n| n.was.clone()));
    let share = numbers.iter().map(|n| n.from_log).sum::<f64>() / numbers.len() as f64;
    if share < 0.5 {
        text += "; mostly from the file";
    }
    text
}

/// Returns a number with seven digits.
pub(super) fn written(x: f64) -> String {
    digits(x, 7)
}

/// Returns a number with so many significant digits.
pub(super) fn digits(x: f64, count: usize) -> String {
    Digits::new(x, count).plain(-4..count as i32).to_string()
}
