//! Fills the templates of self-contained pages.

/// The style of pages with plots over time.
pub(crate) const STYLE: &str = include_str!("template/style.css");
/// Their scripts: elements, tables, plots.
pub(crate) const PLOTS: &str = include_str!("template/plot.js");

/// Returns the beginning of a page, up to its body: with a policy by which it loads nothing.
pub(crate) fn head(name: &str, style: &str) -> String {
    let parts = [("@NAME@", name), ("@STYLE@", style)];
    filled(include_str!("template/head.html"), &parts)
}

/// Returns JSON as it can be written into a page: `<` could end its element.
pub(crate) fn embedded(json: &str) -> String {
    json.replace('<', "\\u003c")
}

/// Returns the template with a text in place of each mark, in the order of the template. Marks in these texts stay.
pub(crate) fn filled(template: &str, parts: &[(&str, &str)]) -> String {
    let (mut page, mut rest) = (String::new(), template);
    for (mark, text) in parts {
        let (before, after) = rest.split_once(mark).unwrap_or((rest, ""));
        page += before;
        page += text;
        rest = after;
    }
    page + rest
}

/// Returns a number with five digits, as many as a plot shows.
pub(crate) fn rounded(x: f64) -> f64 {
    format!("{x:.4e}").parse().unwrap_or(x)
}
