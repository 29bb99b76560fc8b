//! What the user writes between the parentheses.

use bgdyn_codegen::formulation::{self, FORMULATIONS, Formulation};
use syn::parse::{Parse, ParseStream};
use syn::{Ident, LitBool, LitStr, Token};

/// `"scara.yaml"`, then options `name = "value"`.
pub(crate) struct Input {
    pub(crate) path: LitStr,
    /// The formulation asked for.
    pub(crate) formulation: Option<&'static dyn Formulation>,
    /// Whether first derivatives are wanted.
    pub(crate) derivatives: bool,
    /// What is wrong with the options. The module is made all the same.
    pub(crate) errors: Vec<syn::Error>,
}

impl Parse for Input {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let mut parsed = Input {
            path: input.parse()?,
            formulation: None,
            derivatives: false,
            errors: Vec::new(),
        };
        if let Err(error) = parsed.options(input) {
            parsed.errors.push(error);
            // What is left means nothing without what went before.
            input.parse::<proc_macro2::TokenStream>()?;
        }
        Ok(parsed)
    }
}

impl Input {
    fn options(&mut self, input: ParseStream<'_>) -> syn::Result<()> {
        while !input.is_empty() {
            input.parse::<Token![,]>()?;
            if input.is_empty() {
                break;
            }
            let option: Ident = input.parse()?;
            input.parse::<Token![=]>()?;
            if option == "derivatives" {
                self.derivatives = input.parse::<LitBool>()?.value;
                continue;
            }
            if option != "formulation" {
                let message =
                    format!("bgdyn: unknown option `{option}`; known: derivatives, formulation");
                self.errors.push(syn::Error::new(option.span(), message));
                input.parse::<syn::Lit>()?;
                continue;
            }
            let value: LitStr = input.parse()?;
            self.formulation = formulation::by_name(&value.value());
            if self.formulation.is_none() {
                let known: Vec<_> = FORMULATIONS.iter().map(|f| f.name()).collect();
                let message = format!(
                    "bgdyn: unknown formulation `{}`; known: {}",
                    value.value(),
                    known.join(", ")
                );
                self.errors.push(syn::Error::new(value.span(), message));
            }
        }
        Ok(())
    }
}
