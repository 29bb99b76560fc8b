//! Options of the written module: its source, name, visibility, and the path to the runtime.

use proc_macro2::TokenStream;
use quote::quote;

use super::tokens::ident;
use crate::name::is_identifier;

/// Options of the written module: from which spec, under which name, for which crate.
#[derive(Clone, Debug)]
pub struct OutputOptions {
    /// Path of the crate that re-exports the runtime: `::bgdyn`.
    pub bgdyn: TokenStream,
    /// Visibility of the module.
    pub visibility: TokenStream,
    /// Name of the module; the mechanism's where `None`.
    pub module: Option<String>,
    /// Name of the spec, for the header.
    pub source: String,
    /// Path to include, so that a change of the spec rebuilds; `None` where the build script sees
    /// to that.
    pub rebuild: Option<String>,
    /// Other files to include for the same reason: a scene's mechanism.
    pub also: Vec<String>,
    /// Whether the code is for reading: infix formulas, which nobody compiles.
    pub plain: bool,
}

impl OutputOptions {
    /// For source text that a crate includes which calls bgdyn by its own name.
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

    /// The same for a crate that reaches bgdyn by this path.
    ///
    /// # Errors
    /// Where the path is not Rust.
    pub fn with_crate(self, path: &str) -> Result<Self, String> {
        let bgdyn = tokens("the path", path)?;
        Ok(OutputOptions { bgdyn, ..self })
    }

    /// The same with this visibility of the module.
    ///
    /// # Errors
    /// Where it is not Rust.
    pub fn with_visibility(self, visibility: &str) -> Result<Self, String> {
        let visibility = tokens("the visibility", visibility)?;
        Ok(OutputOptions { visibility, ..self })
    }

    /// The same with this name of the module.
    ///
    /// # Errors
    /// Where it is no snake_case identifier.
    pub fn with_module(self, name: &str) -> Result<Self, String> {
        if !is_identifier(name) {
            return Err(format!(
                "`{name}` cannot name a module: write words of a–z and digits joined by `_`"
            ));
        }
        let module = Some(name.to_string());
        Ok(OutputOptions { module, ..self })
    }

    /// What stands in the header of code that is for reading.
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

    /// The module's name for a mechanism of this name.
    pub(super) fn module_ident(&self, mechanism: &str) -> proc_macro2::Ident {
        ident(self.module.as_deref().unwrap_or(mechanism))
    }
}

fn tokens(what: &str, text: &str) -> Result<TokenStream, String> {
    text.parse()
        .map_err(|e| format!("{what} `{text}` is not Rust: {e}"))
}

/// Statements that include the spec, so that the compiler watches it.
pub(super) fn rebuild(output: &OutputOptions) -> Option<TokenStream> {
    let path = output.rebuild.as_ref()?;
    let also = &output.also;
    Some(quote! {
        const _: &[u8] = ::core::include_bytes!(#path);
        #(const _: &[u8] = ::core::include_bytes!(#also);)*
    })
}
