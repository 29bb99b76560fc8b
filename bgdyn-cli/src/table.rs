//! Writes and parses comma-separated values, with the position of each cell.

/// A row of a table, with its text.
pub(crate) struct TableRow<'a> {
    /// The line in which it begins, from 1 on.
    pub(crate) line: u32,
    /// Its cells, without quotes and surrounding spaces.
    pub(crate) cells: Vec<String>,
    text: &'a str,
}

impl TableRow<'_> {
    /// Returns line and column of the start of a cell, from 1 on.
    pub(crate) fn position(&self, cell: usize) -> (u32, u32) {
        // The cell begins after the first comma that completes this number of cells: a comma in quotes
        // completes none.
        let commas = self.text.match_indices(',').map(|(at, _)| at + 1);
        let ends = |at: &usize| row_of(&self.text[..*at]).is_some_and(|cells| cells.len() > cell);
        let begin = std::iter::once(0)
            .chain(commas)
            .find(|at| cell == 0 || ends(at));
        let before = &self.text[..begin.unwrap_or(self.text.len())];
        let rest = &self.text[before.len()..];
        let spaces = rest.chars().take_while(|c| *c == ' ' || *c == '\t').count();
        let lines = before.matches('\n').count();
        let last = before.rsplit('\n').next().unwrap_or("");
        let column = 1 + last.chars().count() + spaces;
        (self.line + lines as u32, column as u32)
    }
}

/// Returns the rows of a table, without empty lines and lines that begin with `#`.
pub(crate) fn rows(text: &str) -> Vec<TableRow<'_>> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut reader = reader(text);
    let (mut record, mut rows) = (csv::StringRecord::new(), Vec::new());
    loop {
        let before = reader.position().clone();
        if !reader.read_record(&mut record).expect("text in memory") {
            return rows;
        }
        let (from, to) = (before.byte() as usize, reader.position().byte() as usize);
        let (mut text, mut line) = (&text[from..to], before.line() as u32);
        // Skipped lines belong to no row.
        while let Some((first, rest)) = text.split_once('\n')
            && (first.starts_with('#') || first.trim().is_empty())
        {
            (text, line) = (rest, line + 1);
        }
        let cells: Vec<String> = record.iter().map(cell).collect();
        let is_empty = cells.iter().all(String::is_empty) && cells.len() == 1;
        if !is_empty && !cells[0].starts_with('#') {
            rows.push(TableRow { line, cells, text });
        }
    }
}

/// Returns the cells of the first row.
fn row_of(text: &str) -> Option<csv::StringRecord> {
    reader(text).into_records().next()?.ok()
}

fn reader(text: &str) -> csv::Reader<&[u8]> {
    csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .from_reader(text.as_bytes())
}

/// Removes surrounding spaces, and quotes that such spaces made part of the text.
fn cell(text: &str) -> String {
    let text = text.trim();
    let inner = text.strip_prefix('"').and_then(|t| t.strip_suffix('"'));
    inner.unwrap_or(text).trim().to_owned()
}

/// Returns records as the text of a table.
pub(crate) fn write_csv(records: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for record in records {
        writer.write_record(record).expect("memory");
    }
    String::from_utf8(writer.into_inner().expect("memory")).expect("fields are text")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_have_their_positions() {
        let text = "\u{feff}name, mass\n# 1,2\n\n \"left, upper\",1\r\n\"left, upper\" ,  2\n  # none\n \n\"two\nlines\",\"say \"\"so\"\"\", 3";
        let rows = rows(text);
        let cells: Vec<Vec<&str>> = rows
            .iter()
            .map(|row| row.cells.iter().map(String::as_str).collect())
            .collect();
        let wanted: [&[&str]; 4] = [
            &["name", "mass"],
            // A quote after a space is a letter.
            &["\"left", "upper\"", "1"],
            &["left, upper", "2"],
            &["two\nlines", "say \"so\"", "3"],
        ];
        assert_eq!(cells, wanted);
        let lines: Vec<u32> = rows.iter().map(|row| row.line).collect();
        assert_eq!(lines, [1, 4, 5, 8]);
        assert_eq!(rows[0].position(1), (1, 7));
        assert_eq!(rows[2].position(0), (5, 1));
        assert_eq!(rows[2].position(1), (5, 18));
        assert_eq!(rows[3].position(1), (9, 8));
        assert_eq!(rows[3].position(2), (9, 22));
    }
}
