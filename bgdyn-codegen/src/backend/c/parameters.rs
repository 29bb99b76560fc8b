//! The parameters of a function in C: run-time parameters, arguments, results of blocks, the result.

use super::style::Style;
use crate::expr::Leaf;
use crate::function::Function;
use crate::method::Argument;
use crate::plan::{BlockPlan, Listing, Naming, block_name, leaves_of};

/// A parameter: its declaration, and its name for a call.
pub(super) struct CParameter {
    pub(super) declaration: String,
    pub(super) name: String,
    /// Whether the function reads it.
    pub(super) is_read: bool,
}

impl CParameter {
    fn new(declaration: String, name: &str, is_read: bool) -> Self {
        CParameter {
            declaration,
            name: name.to_string(),
            is_read,
        }
    }
}

/// Returns the parameters of a function, without its result.
pub(super) fn parameters(
    function: &Function,
    naming: &Naming<'_>,
    style: &Style,
) -> Vec<CParameter> {
    let read = leaves_of(function);
    let of_model = of_model(naming, style, read.iter().any(is_parameter));
    let arguments = function.method.arguments().iter().filter_map(|&argument| {
        let components = naming.components(argument);
        let is_read = components.iter().any(|(leaf, _)| read.contains(leaf));
        // C has no empty arrays.
        let count = components.len();
        (count > 0).then(|| self::argument(argument, count, style, is_read))
    });
    of_model.into_iter().chain(arguments).collect()
}

/// Returns the parameters of a block that is a function of its own: what it reads.
pub(super) fn block_parameters(
    listing: &Listing<'_>,
    blocks: &[BlockPlan<'_>],
    naming: &Naming<'_>,
    style: &Style,
) -> Vec<CParameter> {
    let block = listing.block;
    let is_read = block.reads.iter().any(is_parameter);
    let mut parameters: Vec<CParameter> = Vec::new();
    parameters.extend(of_model(naming, style, true).filter(|_| is_read));
    for names in &listing.arguments {
        let count = names.components.len();
        parameters.push(argument(names.argument, count, style, true));
    }
    let real = style.real();
    for earlier in block.blocks_read() {
        let (name, count) = (block_name(earlier), blocks[earlier].outputs.len());
        let declaration = format!("const {real} {name}[{count}]");
        parameters.push(CParameter::new(declaration, &name, true));
    }
    parameters
}

fn is_parameter(leaf: &Leaf) -> bool {
    matches!(leaf, Leaf::Parameter(_))
}

/// Returns the run-time parameters, if the mechanism has any.
pub(super) fn of_model(naming: &Naming<'_>, style: &Style, is_read: bool) -> Option<CParameter> {
    let declaration = format!("const struct {} *parameters", style.global("parameters"));
    let has_any = !naming.parameters.is_empty();
    has_any.then(|| CParameter::new(declaration, "parameters", is_read))
}

fn argument(argument: Argument, count: usize, style: &Style, is_read: bool) -> CParameter {
    let (real, name) = (style.real(), argument.name());
    if argument == Argument::Time {
        return CParameter::new(format!("{real} {name}"), name, is_read);
    }
    let size = match argument {
        Argument::Q => style.constant("NQ"),
        Argument::V | Argument::A | Argument::Tau => style.constant("NV"),
        Argument::TreeV | Argument::TreeTau => style.constant("NT"),
        Argument::ActuatedTau => style.constant("NA"),
        Argument::ReferenceV | Argument::ReferenceA | Argument::Direction => style.constant("NV"),
        Argument::AlongQ
        | Argument::AlongV
        | Argument::AlongA
        | Argument::AlongTau
        | Argument::Cotangent => style.constant("NV"),
        Argument::BodyParameters => style.sized("10 * NB"),
        Argument::State => style.sized("N + NM"),
        Argument::Canonical => style.constant("N"),
        Argument::Input => style.constant("NU"),
        Argument::Accelerations => style.constant("NV"),
        Argument::Modes => style.constant("NM"),
        Argument::Time => count.to_string(),
    };
    CParameter::new(format!("const {real} {name}[{size}]"), name, is_read)
}
