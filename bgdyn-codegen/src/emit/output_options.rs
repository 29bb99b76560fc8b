//! Options of the written module: its source, name, visibility, and the path to the runtime.

use proc_macro2::TokenStream;
use quote::quote;

use super::tokens::ident;
use crate::name::is_identifier;

/// Options of the written module: its spec, its name, and its crate.
#[derive(Clone, Debug)]
pub struct OutputOptions {
    /// Path of the crate that re-exports the runtime: `::bgdyn`.
    pub bgdyn: TokenStream,
    /// Visibility of the module.
    pub visibility: TokenStream,
    /// Name of the module; `None` for the mechanism's name.
    pub module: Option<String>,
    /// Name of the spec, for the header.
    pub source: String,
    /// Path of a file to include, so that a change of the spec causes a rebuild; `None` if the build
    /// script does this.
    pub rebuild: Option<String>,
    /// Other files to include for the same reason, such as a scene's mechanism.
    pub also: Vec<String>,
    /// Whether the code is only for reading: infix formulas, not compiled.
    pub plain: bool,
}

impl OutputOptions {
    /// Returns options for source text that is included in a crate with a dependency named bgdyn.
    pub fn source_text(source: String) -> Self {
        OutputOptions {
            bgdyn: quote! { ::bgdyn },
            visibility: quote! { pub },
            module: None,
            source,
            rebuild: None,
            also: Vec::new(),
            plain: false,
        }
    }

    /// Sets the path of bgdyn in the including crate.
    ///
    /// # Errors
    /// If the path is not valid Rust.
    pub fn with_crate(self, path: &str) -> Result<Self, String> {
        let bgdyn = tokens("the path", path)?;
        Ok(OutputOptions { bgdyn, ..self })
    }

    /// Sets the visibility of the module.
    ///
    /// # Errors
    /// If it is not valid Rust.
    pub fn with_visibility(self, visibility: &str) -> Result<Self, String> {
        let visibility = tokens("the visibility", visibility)?;
        Ok(OutputOptions { visibility, ..self })
    }

    /// Sets the name of the module.
    ///
    /// # Errors
    /// If it is no snake_case identifier.
    pub fn with_module(self, name: &str) -> Result<Self, String> {
        if !is_identifier(name) {
            return Err(format!(
                "`{name}` cannot name a module: write words of a–z and digits joined by `_`"
            ));
        }
        let module = Some(name.to_string());
        Ok(OutputOptions { module, ..self })
    }

    /// Returns the note in the header of code that is only for reading.
    pub(super) fn note(&self) -> &'static [&'static str] {
        match self.plain {
            true => &[
                "",
                " FOR READING, NOT FOR COMPILING: `bgdyn generate --plain`. Formulas are infix; in the code that",
                " is compiled, `a * b + c` is one `mul_add` where a statement of its own computes it, and a",
                " number `x` is `k(x)`, the scalar nearest to it.",
            ],
            false => &[],
        }
    }

    /// Returns the module's name for a mechanism of this name.
    pub(super) fn module_ident(&self, mechanism: &str) -> proc_macro2::Ident {
        ident(self.module.as_deref().unwrap_or(mechanism))
    }
}

fn tokens(what: &str, text: &str) -> Result<TokenStream, String> {
    text.parse()
        .map_err(|e| format!("{what} `{text}` is not Rust: {e}"))
}

/// Returns statements that include the spec, so that the compiler tracks it.
pub(super) fn rebuild(output: &OutputOptions) -> Option<TokenStream> {
    let path = output.rebuild.as_ref()?;
    let also = &output.also;
    Some(quote! {
        const _: &[u8] = ::core::include_bytes!(#path);
        #(const _: &[u8] = ::core::include_bytes!(#also);)*
    })
}
