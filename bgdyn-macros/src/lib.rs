//! The procedural macro [`bgdyn!`]: finds the spec, asks bgdyn-codegen for the code, reports.
#![forbid(unsafe_code)]

mod find;
mod input;

use bgdyn_codegen::emit::Place;
use bgdyn_codegen::model::{self, Options};
use proc_macro::TokenStream;
use quote::quote;

use input::Input;

/// Generates the module of a mechanism from its YAML spec.
///
/// ```ignore
/// bgdyn::bgdyn!("scara.yaml"); // pub mod scara { pub struct Scara … }
/// ```
///
/// The path is looked up beside the calling source file, then in the package's directory, then in
/// its `specs/`. The module is called after the file, up to its first dot. A change of the file
/// rebuilds the crate.
///
/// `bgdyn!("scara.yaml", formulation = "literal")` uses one formulation for every method instead
/// of the cheapest.
#[proc_macro]
pub fn bgdyn(input: TokenStream) -> TokenStream {
    let input = syn::parse_macro_input!(input as Input);
    let expanded = expand(&input);
    expanded
        .unwrap_or_else(|message| syn::Error::new(input.path.span(), message).to_compile_error())
        .into()
}

fn expand(input: &Input) -> Result<proc_macro2::TokenStream, String> {
    let written = input.path.value();
    let path = find::find(&written, input.path.span())?;
    let text = std::fs::read_to_string(&path)
        .map_err(|e| format!("bgdyn: {} cannot be read: {e}", path.display()))?;
    let stem = find::stem(&path)?;
    let options = Options {
        formulation: input.formulation()?,
        derivatives: input.derivatives,
    };
    let place = Place {
        bgdyn: crate_path()?,
        visibility: quote! { pub },
        source: find::file_name(&path),
        rebuild: Some(path.display().to_string()),
    };
    model::generate(&text, &stem, &place, &options).map_err(|faults| faults.render(&written, &text))
}

/// The path by which the calling crate reaches bgdyn, renamed or not.
fn crate_path() -> Result<proc_macro2::TokenStream, String> {
    use proc_macro_crate::{FoundCrate, crate_name};
    match crate_name("bgdyn") {
        Ok(FoundCrate::Itself) => Ok(quote! { ::bgdyn }),
        Ok(FoundCrate::Name(name)) => {
            let name = proc_macro2::Ident::new(&name, proc_macro2::Span::call_site());
            Ok(quote! { ::#name })
        }
        Err(e) => Err(format!(
            "bgdyn: the calling crate does not depend on bgdyn: {e}"
        )),
    }
}
