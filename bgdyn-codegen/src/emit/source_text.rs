//! Prints a module's tokens as source text with comments.

use proc_macro2::TokenStream;

use super::tokens::COMMENT;

/// Returns the formatted source text of a module's tokens.
pub fn source_text(module: TokenStream) -> String {
    let file = syn::parse2(module).expect("the emitter writes valid Rust");
    let text = prettyplease::unparse(&file);
    let lines = text.lines().map(|line| match comment(line) {
        Some(comment) => comment + "\n",
        None => line.to_string() + "\n",
    });
    lines.collect()
}

/// Returns the comment that replaces this line, if the line is the attribute of a statement's title.
fn comment(line: &str) -> Option<String> {
    let (margin, attribute) = line.split_at(line.len() - line.trim_start().len());
    let literal = attribute.strip_prefix("#[doc = ")?.strip_suffix(']')?;
    let text = syn::parse_str::<syn::LitStr>(literal).ok()?.value();
    let comment = text.starts_with(COMMENT);
    comment.then(|| format!("{margin}{text}"))
}
