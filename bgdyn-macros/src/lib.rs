//! The procedural macro [`bgdyn!`]: finds the spec, asks bgdyn-codegen for the code, reports.
#![forbid(unsafe_code)]

mod find;
mod input;

use std::path::Path;

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
/// `bgdyn!("scara.yaml", derivatives = true)` adds the first derivatives of inverse and forward
/// dynamics. `bgdyn!("scara.yaml", formulation = "literal")` uses one formulation for every method instead
/// of the cheapest.
///
/// A spec with faults gives one error that lists them all. The module is there all the same, with
/// everything that can be named, so that no call adds an error of its own.
#[proc_macro]
pub fn bgdyn(input: TokenStream) -> TokenStream {
    let input = syn::parse_macro_input!(input as Input);
    let mut code = proc_macro2::TokenStream::new();
    let module = crate_path().and_then(|bgdyn| module(&input, bgdyn));
    match module {
        Ok(tokens) => code.extend(tokens),
        Err(Refused { message, stand_in }) => {
            code.extend(syn::Error::new(input.path.span(), message).to_compile_error());
            code.extend(stand_in);
        }
    }
    code.extend(input.errors.iter().map(syn::Error::to_compile_error));
    code.into()
}

/// Why there is no module, and what stands in for it.
struct Refused {
    message: String,
    stand_in: Option<proc_macro2::TokenStream>,
}

fn module(
    input: &Input,
    bgdyn: proc_macro2::TokenStream,
) -> Result<proc_macro2::TokenStream, Refused> {
    let written = input.path.value();
    let mut place = Place {
        bgdyn,
        visibility: quote! { pub },
        source: find::file_name(Path::new(&written)),
        rebuild: None,
    };
    let refused = |message: String, text: &str, place: &Place| Refused {
        message,
        stand_in: model::fallback(text, &find::stem(Path::new(&place.source)), place),
    };
    let path = find::find(&written, input.path.span()).map_err(|m| refused(m, "", &place))?;
    let text = std::fs::read_to_string(&path).map_err(|e| {
        let message = format!("bgdyn: `{written}` cannot be read: {e}");
        refused(message, "", &place)
    })?;
    place.rebuild = Some(path.display().to_string());
    let options = Options {
        formulation: input.formulation,
        derivatives: input.derivatives,
    };
    model::generate(&text, &find::stem(&path), &place, &options).map_err(|faults| {
        let mut message = faults.render(&written, &text).trim_end().to_string();
        if faults.count() > 1 {
            message += &format!("\n\n{} faults", faults.count());
        }
        refused(message, &text, &place)
    })
}

/// The path by which the calling crate reaches bgdyn, renamed or not.
fn crate_path() -> Result<proc_macro2::TokenStream, Refused> {
    use proc_macro_crate::{FoundCrate, crate_name};
    match crate_name("bgdyn") {
        Ok(FoundCrate::Itself) => Ok(quote! { ::bgdyn }),
        Ok(FoundCrate::Name(name)) => {
            let name = proc_macro2::Ident::new(&name, proc_macro2::Span::call_site());
            Ok(quote! { ::#name })
        }
        Err(e) => Err(Refused {
            message: format!("bgdyn: the calling crate does not depend on bgdyn: {e}"),
            stand_in: None,
        }),
    }
}
