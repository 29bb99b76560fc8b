//! The procedural macro [`bgdyn!`]: finds the spec, calls bgdyn-codegen, reports errors.
//!
//! The documentation of the crate `bgdyn-runtime`, which is `bgdyn::runtime`, defines units, frames, the
//! order of spatial vectors and the sign of gravity of generated code.
#![forbid(unsafe_code)]

mod find;
mod input;

use std::path::Path;

use bgdyn_codegen::SpecText;
use bgdyn_codegen::emit::OutputOptions;
use bgdyn_codegen::refusal::Refusal;
use bgdyn_codegen::verify::explain;
use bgdyn_codegen::{pipeline, stub};
use proc_macro::TokenStream;
use quote::quote;

use input::Input;

/// Generates the module of a mechanism from its YAML spec.
///
/// ```ignore
/// bgdyn::bgdyn!("scara.yaml"); // pub mod scara { pub struct Scara … }
/// ```
///
/// The file is searched for next to the calling source file, then in the package's directory, then in its
/// `specs/` and `specs/scenes/`. A file whose first key is `scene` is a scene: a mechanism with the
/// effects of a run. The module has the file's name, up to its first dot. A change of the file rebuilds
/// the crate.
///
/// Options, in any order:
///
/// | option | |
/// |---|---|
/// | `methods = [inverse_dynamics, pose_tool]` | these methods instead of the usual ones; `dynamics` means those of the trait `Dynamics`, which is implemented only if all of them are generated |
/// | `frames = [tool, forearm]` | pose, velocity, Jacobian and J̇ v of these links and frames instead of the named frames and tips |
/// | `derivatives = true` | first derivatives of inverse and forward dynamics |
/// | `identification = true` | regressors, the parameters of the bodies, base parameters |
/// | `jacobian = true` | for a scene: ∂ẏ/∂y, ∂ẏ/∂t and the trait `Slope`; its integration method may generate them already |
/// | `input_jacobian = true` | for a scene: ∂ẏ/∂u and the trait `InputSlope` |
/// | `canonical = true` | for a scene: momenta in place of velocities and the trait `Canonical`; its integration method may generate them already |
/// | `formulation = "literal"` | one formulation for every method instead of the cheapest of each |
/// | `prefer = "accuracy"` | for each method the formulation that loses the fewest digits in `f64`, instead of the cheapest; `"operations"` is the default |
/// | `verify = false` | leaves out the comparison of the generated functions with equation (6) |
/// | `module = left_arm` | another name for the module; the struct keeps the file's |
/// | `visibility = pub(crate)` | of the module, instead of `pub` |
///
/// A spec with faults gives one error that lists all of them. A replacement module is still generated,
/// with every name that a caller can use, so that calls do not add errors.
#[proc_macro]
pub fn bgdyn(input: TokenStream) -> TokenStream {
    let input = syn::parse_macro_input!(input as Input);
    let module = crate_path().and_then(|bgdyn| module(&input, bgdyn));
    let mut code = match module {
        Ok(tokens) => tokens,
        Err(Refused { errors, stand_in }) => {
            let errors = errors.iter().map(syn::Error::to_compile_error);
            errors.chain(stand_in).collect()
        }
    };
    code.extend(input.errors.iter().map(syn::Error::to_compile_error));
    code.into()
}

/// The reason why there is no module, and the replacement module.
struct Refused {
    errors: Vec<syn::Error>,
    stand_in: Option<proc_macro2::TokenStream>,
}

fn module(
    input: &Input,
    bgdyn: proc_macro2::TokenStream,
) -> Result<proc_macro2::TokenStream, Refused> {
    let written = input.path.value();
    let mut place = OutputOptions {
        bgdyn,
        visibility: input.visibility.clone(),
        module: input.module.clone(),
        source: find::file_name(Path::new(&written)),
        rebuild: None,
        also: Vec::new(),
        plain: false,
    };
    let found = find::find(&written, input.path.span());
    let load = |mechanism: &str| {
        let path = found.clone()?;
        std::fs::read_to_string(bgdyn_codegen::files::beside(&path, mechanism))
            .map_err(|e| e.to_string())
    };
    let stand_in = |text: &str, place: &OutputOptions| {
        stub::stub_module(
            text,
            &bgdyn_codegen::files::stem(Path::new(&place.source)),
            place,
            load,
        )
    };
    let refused = |message: String, text: &str, place: &OutputOptions| Refused {
        errors: vec![syn::Error::new(input.path.span(), message)],
        stand_in: stand_in(text, place),
    };
    let path = found.clone().map_err(|m| refused(m, "", &place))?;
    let text = std::fs::read_to_string(&path).map_err(|e| {
        let message = format!("bgdyn: `{written}` cannot be read: {e}");
        refused(message, "", &place)
    })?;
    place.rebuild = Some(path.display().to_string());
    for named in bgdyn_codegen::files::files_of(&text) {
        let file = bgdyn_codegen::files::beside(&path, &named);
        place.also.push(file.display().to_string());
    }
    let spec = SpecText {
        text: &text,
        stem: &bgdyn_codegen::files::stem(&path),
        load: &load,
    };
    match pipeline::generate_module(&spec, &input.options, &place) {
        Ok((tokens, _warnings)) => Ok(tokens),
        Err(Refusal::Spec(faults)) => {
            let mut message = faults.render(&written, &text).trim_end().to_string();
            if faults.count() > 1 {
                message += &format!("\n\n{}", faults.tally());
            }
            Err(refused(message, &text, &place))
        }
        Err(Refusal::Mechanism {
            path: mechanism,
            text: its_text,
            faults,
            scene,
        }) => {
            let mut message = faults.render(&mechanism, &its_text);
            if scene.any_fault() {
                message = format!("{}\n{message}", scene.render(&written, &text));
            }
            Err(refused(message.trim_end().to_string(), &text, &place))
        }
        Err(Refusal::Unequal(differences)) => {
            let message = format!("bgdyn: {written}: {}", explain(&differences));
            Err(refused(message, &text, &place))
        }
        Err(Refusal::Options(unknown)) => Err(Refused {
            errors: unknown.iter().map(|u| input.error(u)).collect(),
            stand_in: stand_in(&text, &place),
        }),
    }
}

/// Returns the path of bgdyn in the calling crate, also if it is renamed.
fn crate_path() -> Result<proc_macro2::TokenStream, Refused> {
    use proc_macro_crate::{FoundCrate, crate_name};
    match crate_name("bgdyn") {
        Ok(FoundCrate::Itself) => Ok(quote! { ::bgdyn }),
        Ok(FoundCrate::Name(name)) => {
            let name = proc_macro2::Ident::new(&name, proc_macro2::Span::call_site());
            Ok(quote! { ::#name })
        }
        Err(e) => Err(Refused {
            errors: vec![syn::Error::new(
                proc_macro2::Span::call_site(),
                format!("bgdyn: the calling crate does not depend on bgdyn: {e}"),
            )],
            stand_in: None,
        }),
    }
}
