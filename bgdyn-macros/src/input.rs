//! Parses the arguments of the macro.

use bgdyn_codegen::name::is_identifier;
use bgdyn_codegen::options::{
    BundleOption, OptionName, Options, UnknownName, formulation_named, preference_named,
};
use proc_macro2::{Delimiter, Group, Span, TokenStream};
use quote::{ToTokens, quote};
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::{Ident, LitBool, LitStr, Token};

/// All options.
const KNOWN: &str = "bundle, canonical, derivatives, formulation, frames, identification, input_jacobian, jacobian, methods, module, prefer, verify, visibility";

/// `"scara.yaml"`, then options `name = value`.
pub(crate) struct Input {
    pub(crate) path: LitStr,
    /// The generator's options.
    pub(crate) options: Options,
    /// Another name for the module.
    pub(crate) module: Option<String>,
    /// The module's visibility.
    pub(crate) visibility: TokenStream,
    /// Positions of the names in `methods` and `frames`.
    methods: Vec<Span>,
    frames: Vec<Span>,
    /// Of each bundle the positions of its name and of its methods.
    bundles: Vec<Vec<Span>>,
    /// The options in the call.
    given: Vec<Ident>,
    /// Errors of the options. The module is generated in spite of them.
    pub(crate) errors: Vec<syn::Error>,
}

impl Parse for Input {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let mut parsed = Input {
            path: input.parse()?,
            options: Options::default(),
            module: None,
            visibility: quote! { pub },
            methods: Vec::new(),
            frames: Vec::new(),
            bundles: Vec::new(),
            given: Vec::new(),
            errors: Vec::new(),
        };
        if let Err(error) = parsed.all(input) {
            parsed.errors.push(error);
            // After an error the rest of the input has no meaning.
            input.parse::<TokenStream>()?;
        }
        Ok(parsed)
    }
}

impl Input {
    /// Returns the error of a name or an option that is not valid here.
    pub(crate) fn error(&self, unknown: &UnknownName) -> syn::Error {
        let span = match unknown.option {
            OptionName::Methods => self.methods.get(unknown.index).copied(),
            OptionName::Frames => self.frames.get(unknown.index).copied(),
            OptionName::Bundle(bundle) => {
                let bundle = self.bundles.get(bundle);
                bundle.and_then(|spans| spans.get(unknown.index)).copied()
            }
            OptionName::Whole(name) => {
                let option = self.given.iter().find(|option| *option == name);
                option.map(Ident::span)
            }
        };
        let span = span.unwrap_or_else(|| self.path.span());
        syn::Error::new(span, format!("bgdyn: {}", unknown.message))
    }

    fn all(&mut self, input: ParseStream<'_>) -> syn::Result<()> {
        while !input.is_empty() {
            input.parse::<Token![,]>()?;
            if input.is_empty() {
                break;
            }
            let option: Ident = input.parse()?;
            if option == "bundle" && input.peek(Ident) {
                self.bundle(input)?;
                self.given.push(option);
                continue;
            }
            if option != "bundle" && self.given.contains(&option) {
                self.refuse(option.span(), format!("`{option}` is given twice"));
            }
            input.parse::<Token![=]>()?;
            self.option(&option, input)?;
            self.given.push(option);
        }
        Ok(())
    }

    /// Parses `control = [mass_matrix, bias]`, after the word `bundle`.
    fn bundle(&mut self, input: ParseStream<'_>) -> syn::Result<()> {
        let name: Ident = input.parse()?;
        input.parse::<Token![=]>()?;
        let (methods, names) = list(input)?;
        self.bundles
            .push([name.span()].into_iter().chain(methods).collect());
        self.options.bundles.push(BundleOption {
            name: name.to_string(),
            methods: names,
        });
        Ok(())
    }

    fn refuse(&mut self, span: Span, message: String) {
        let error = syn::Error::new(span, format!("bgdyn: {message}"));
        self.errors.push(error);
    }

    fn option(&mut self, option: &Ident, input: ParseStream<'_>) -> syn::Result<()> {
        match option.to_string().as_str() {
            "derivatives" => self.options.derivatives = input.parse::<LitBool>()?.value,
            "identification" => self.options.identification = input.parse::<LitBool>()?.value,
            "jacobian" => self.options.jacobian = input.parse::<LitBool>()?.value,
            "input_jacobian" => {
                self.options.input_jacobian = input.parse::<LitBool>()?.value;
            }
            "canonical" => self.options.canonical = input.parse::<LitBool>()?.value,
            "formulation" => {
                let value: LitStr = input.parse()?;
                match formulation_named(&value.value()) {
                    Ok(formulation) => self.options.formulation = Some(formulation),
                    Err(message) => self.refuse(value.span(), message),
                }
            }
            "methods" => {
                let names;
                (self.methods, names) = list(input)?;
                self.options.methods = Some(names);
            }
            "frames" => {
                let names;
                (self.frames, names) = list(input)?;
                self.options.frames = Some(names);
            }
            "module" => {
                let name: Ident = input.parse()?;
                self.module = Some(name.to_string());
                if !is_identifier(&name.to_string()) {
                    let message = format!("`{name}` cannot name a module: write it in snake_case");
                    self.refuse(name.span(), message);
                    self.module = None;
                }
            }
            "prefer" => {
                let value: LitStr = input.parse()?;
                match preference_named(&value.value()) {
                    Ok(preference) => self.options.prefer = preference,
                    Err(message) => self.refuse(value.span(), message),
                }
            }
            "verify" => self.options.verify = input.parse::<LitBool>()?.value,
            "visibility" => self.visibility = visibility(input)?,
            "bundle" => {
                let message = "a bundle has a name: `bundle control = [mass_matrix, bias]`";
                self.refuse(option.span(), message.into());
                list(input)?;
            }
            _ => {
                let message = format!("unknown option `{option}`; known: {KNOWN}");
                self.refuse(option.span(), message);
                while !input.is_empty() && !input.peek(Token![,]) {
                    input.parse::<proc_macro2::TokenTree>()?;
                }
            }
        }
        Ok(())
    }
}

/// Parses `[name, name]`.
fn list(input: ParseStream<'_>) -> syn::Result<(Vec<Span>, Vec<String>)> {
    let content;
    syn::bracketed!(content in input);
    let names = Punctuated::<Ident, Token![,]>::parse_terminated(&content)?;
    Ok(names.iter().map(|n| (n.span(), n.to_string())).unzip())
}

/// Parses `pub`, `pub(crate)`, `pub(self)`, `pub(in path)`.
fn visibility(input: ParseStream<'_>) -> syn::Result<TokenStream> {
    let mut visibility = input.parse::<Token![pub]>()?.to_token_stream();
    if input.peek(syn::token::Paren) {
        let group: Group = input.parse()?;
        debug_assert_eq!(group.delimiter(), Delimiter::Parenthesis);
        visibility.extend([proc_macro2::TokenTree::Group(group)]);
    }
    Ok(visibility)
}
