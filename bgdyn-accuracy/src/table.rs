//! Converts records to CSV text and back.

/// Returns the CSV text of records, which may have different numbers of fields.
pub(crate) fn write_csv(records: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut writer = csv::WriterBuilder::new()
        .flexible(true)
        .from_writer(Vec::new());
    for record in records {
        writer.write_record(record).expect("memory");
    }
    String::from_utf8(writer.into_inner().expect("memory")).expect("fields are text")
}

/// Returns the records of a CSV text.
pub(crate) fn records(text: &str) -> impl Iterator<Item = Vec<String>> {
    let reader = csv::ReaderBuilder::new()
        .flexible(true)
        .has_headers(false)
        .from_reader(text.as_bytes());
    let records = reader.into_records();
    records.map(|record| {
        let record = record.expect("text in memory");
        record.iter().map(str::to_owned).collect()
    })
}
