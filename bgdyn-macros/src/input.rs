//! What the user writes between the parentheses.

use bgdyn_codegen::formulation::{self, FORMULATIONS, Formulation};
use syn::parse::{Parse, ParseStream};
use syn::{Ident, LitBool, LitStr, Token};

/// `"scara.yaml"`, then options `name = "value"`.
pub(crate) struct Input {
    pub(crate) path: LitStr,
    formulation: Option<LitStr>,
    /// Whether first derivatives are wanted.
    pub(crate) derivatives: bool,
}

impl Parse for Input {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let mut parsed = Input {
            path: input.parse()?,
            formulation: None,
            derivatives: false,
        };
        while !input.is_empty() {
            input.parse::<Token![,]>()?;
            if input.is_empty() {
                break;
            }
            let option: Ident = input.parse()?;
            input.parse::<Token![=]>()?;
            if option == "formulation" {
                parsed.formulation = Some(input.parse()?);
            } else if option == "derivatives" {
                parsed.derivatives = input.parse::<LitBool>()?.value;
            } else {
                let message =
                    format!("bgdyn: unknown option `{option}`; known: formulation, derivatives");
                return Err(syn::Error::new(option.span(), message));
            }
        }
        Ok(parsed)
    }
}

impl Input {
    /// The formulation asked for.
    pub(crate) fn formulation(&self) -> Result<Option<&'static dyn Formulation>, String> {
        let Some(name) = &self.formulation else {
            return Ok(None);
        };
        let known = || {
            FORMULATIONS
                .iter()
                .map(|f| f.name())
                .collect::<Vec<_>>()
                .join(", ")
        };
        formulation::by_name(&name.value())
            .map(Some)
            .ok_or_else(|| {
                format!(
                    "bgdyn: unknown formulation `{}`; known: {}",
                    name.value(),
                    known()
                )
            })
    }
}
