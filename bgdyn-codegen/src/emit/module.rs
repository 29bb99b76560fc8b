//! Emits the module of a mechanism: constants, the struct, its methods, the traits.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::actuated::inverse_docs;
use super::base_access::base_access;
use super::joint_access::joint_access;
use super::legend::legend;
use super::output_options::{OutputOptions, rebuild};
use super::prescribed::{joint_list, prescribed_docs};
use super::reactions::reaction_docs;
use super::tokens::{argument_type, ident, return_type, struct_ident, structure};
use super::{assembly, body, bundles, closure, code, constants, explain, traits};
use crate::bond_graph::{LinkFrame, PositionVariable, joint_segments};
use crate::function::Function;
use crate::mechanism::Motion;
use crate::method::Method;
use crate::model::Model;
use crate::plan::{Naming, matrix_destinations, reads_dependents, summary_of, unread};

/// Returns the module of a model.
pub fn module(model: &Model, output: &OutputOptions) -> TokenStream {
    let name = output.module_ident(model.mechanism.name());
    let bgdyn = &output.bgdyn;
    let visibility = &output.visibility;
    let docs = module_docs(model, output);
    let constants = constants::constants(model);
    let bundles = model.bundles.iter().map(|bundle| &bundle.function);
    let functions: Vec<&Function> = model.functions.iter().chain(bundles).collect();
    let operations = constants::operation_counts(&functions);
    let about = format!(" The mechanism `{}`.", model.mechanism.name());
    let structure = structure(&struct_name(model), &about, model.mechanism.parameters());
    let methods = model.functions.iter().map(|f| method(f, model, output));
    let naming = Naming::of_model(model);
    let parts = model.bundles.iter().flat_map(|bundle| &bundle.parts);
    let parts = parts.map(|part| part.method);
    let called = model.functions.iter().map(|f| f.method).chain(parts);
    let explainers = explain::explainers(called, &naming);
    let struct_name = struct_name(model);
    let of = struct_name.to_string();
    let structs = model.bundles.iter();
    let structs = structs.map(|bundle| bundles::bundle_struct(bundle, model, &of));
    let bundled = model.bundles.iter();
    let bundled = bundled.map(|bundle| bundles::bundle_function(bundle, model, output.plain));
    let present: Vec<Method> = model.functions.iter().map(|f| f.method).collect();
    let traits = traits::Traits {
        name: &struct_name,
        methods: &present,
        sites: &model.bond_graph.sites,
        joints: Some(joint_segments(&model.bond_graph)),
        closed: model.bond_graph.closed.as_deref(),
    };
    let traits = traits.tokens();
    let access = joint_access(&model.mechanism);
    let (ranges, poses) = (access.constants, access.functions);
    let base = base_access(model.mechanism.base().is_some());
    let loops = model.bond_graph.closed.as_deref();
    let loops = loops.map(|closed| closure::closure_access(closed, &model.bond_graph, &present));
    let (loop_constants, loop_functions) = loops.unzip();
    let assembly = model.bond_graph.closed.as_deref();
    let assembly = assembly.filter(|_| model.assembles).map(assembly::assembly);
    let (conditions, assemble) = assembly.unzip();
    let rebuild = rebuild(output);
    quote! {
        #(#[doc = #docs])*
        #[allow(
            unused,
            unreachable_pub,
            clippy::all,
            clippy::pedantic,
            clippy::nursery,
            reason = "generated: straight-line arithmetic with the mechanism's own numbers"
        )]
        #visibility mod #name {
            use #bgdyn::runtime as __rt;
            use __rt::nalgebra as __na;
            use __rt::Scalar as __Scalar;
            #rebuild
            #constants
            #ranges
            #loop_constants
            #conditions
            #structure
            #(#structs)*
            impl<T: __Scalar> #struct_name<T> {
                #(#methods)*
                #(#bundled)*
                #poses
                #base
                #loop_functions
                #assemble
                #explainers
            }
            #traits
            #operations
        }
    }
}

/// Describes the positions, if they are not those of the velocities.
fn position_docs(model: &Model) -> Vec<String> {
    let graph = &model.bond_graph;
    let own = |p: &PositionVariable| p.coordinate.is_some();
    if graph.positions.iter().all(own) {
        return Vec::new();
    }
    let several = |frame: &LinkFrame| matches!(frame.motion, Motion::Compound(_));
    let words: &[&str] = match graph.closed.is_some() && !graph.frames.iter().any(several) {
        true => {
            &[" Positions of all joints of the open tree; `position_rates` returns their rates."]
        }
        false => &[
            " Velocities of joints with several degrees are along and about the link's axes; `position_rates`",
            " returns the rates of the positions. Quaternions are x, y, z, w, from link axes to the axes of the",
            " joint's origin, of length 1 unless the spec says `quaternion: any`.",
        ],
    };
    let mut docs = vec![String::new()];
    docs.extend(words.iter().map(ToString::to_string));
    docs.extend([
        String::new(),
        " | position | name | unit |".into(),
        " |---|---|---|".into(),
    ]);
    for (p, position) in graph.positions.iter().enumerate() {
        let unit = position.unit;
        docs.push(format!(" | {p} | `{}` | {unit} |", position.name));
    }
    docs
}

fn struct_name(model: &Model) -> Ident {
    ident(&struct_ident(model.mechanism.name()))
}

fn module_docs(model: &Model, output: &OutputOptions) -> Vec<String> {
    let mechanism = &model.mechanism;
    let mut docs = vec![
        format!(" Dynamics of `{}`.", mechanism.name()),
        String::new(),
        format!(
            " Generated by bgdyn {} from {}.",
            env!("CARGO_PKG_VERSION"),
            output.source
        ),
    ];
    docs.extend(output.note().iter().map(ToString::to_string));
    if let Some(text) = mechanism.description() {
        docs.push(String::new());
        docs.extend(text.lines().map(|line| format!(" {}", line.trim_end())));
    }
    docs.push(String::new());
    docs.push(" | velocity | joint | carries | unit |".into());
    docs.push(" |---|---|---|---|".into());
    for (j, c) in model.bond_graph.coordinates.iter().enumerate() {
        let link = &mechanism.links()[c.link.0].name;
        let unit = c.velocity_unit();
        docs.push(format!(" | {j} | `{}` | `{link}` | {unit} |", c.name));
    }
    docs.extend(position_docs(model));
    let closed = model.bond_graph.closed.as_deref();
    docs.extend(closed.into_iter().flat_map(closure::loop_docs));
    docs.extend(prescribed_docs(&model.mechanism));
    docs.push(String::new());
    docs.push(" | method | operations | formulation |".into());
    docs.push(" |---|---|---|".into());
    let bundles = model.bundles.iter().map(|bundle| &bundle.function);
    let functions: Vec<&Function> = model.functions.iter().chain(bundles).collect();
    for f in &functions {
        docs.push(format!(
            " | `{}` | {} | {} |",
            f.name(),
            f.operations(),
            f.formulation
        ));
    }
    docs.extend(legend(&functions));
    docs
}

/// Returns one method of the struct.
fn method(function: &Function, model: &Model, output: &OutputOptions) -> TokenStream {
    let name = ident(function.name());
    let arguments = function.method.arguments();
    let names = arguments.iter().map(|a| ident(a.name()));
    let types = arguments.iter().map(|a| argument_type(*a));
    let result = return_type(function.shape());
    let docs = method_docs(function, model);
    let closed = model.bond_graph.closed.as_deref();
    let sizes = body::Sizes {
        nv: model.mechanism.nv(),
        of_tree: closed.map(|closed| closed.tree.coordinates.len()),
        of_task: function.method.inverts_task(),
    };
    let finish = |values: &[TokenStream]| body::result(function.method, sizes, values);
    let spelling = code::Spelling::of_model(model, output.plain);
    let destinations = matrix_destinations(function.shape(), model.mechanism.nv());
    let body::FunctionBody { body, blocks } = body::body(function, &spelling, destinations, finish);
    quote! {
        #(#[doc = #docs])*
        pub fn #name(&self, #(#names: #types),*) -> #result {
            #body
        }
        #(#blocks)*
    }
}

fn method_docs(function: &Function, model: &Model) -> Vec<String> {
    let method = function.method;
    let mut docs = vec![
        format!(" {}", summary_of(method, model)),
        String::new(),
        format!(
            " Units: {}. Joints as in [`{}`].",
            method.units(),
            joint_list(method)
        ),
        String::new(),
        format!(
            " Operations: {} ({}).",
            function.operations(),
            function.formulation
        ),
    ];
    let closed = model.bond_graph.closed.as_deref();
    docs.splice(1..1, reaction_docs(method, closed));
    let inverse = matches!(method, Method::ActuatedInverse(_));
    if inverse {
        docs.splice(1..1, inverse_docs(closed));
    }
    let unread = unread(function, model);
    if !unread.is_empty() {
        docs.extend([
            String::new(),
            format!(" Does not read: {}.", unread.join(", ")),
        ]);
    }
    if inverse {
        docs.extend([
            String::new(),
            " # Errors".into(),
            " Names the independent joint that does not follow the actuated joints, where their matrix A is singular,".into(),
            " with the cause `Actuators`; or the argument that is NaN or infinite.".into(),
        ]);
    } else if function.shape().checked() {
        docs.extend([
            String::new(),
            " # Errors".into(),
            " Names the joint whose pivot vanishes where the mass matrix is singular, or the argument".into(),
            " that is NaN or infinite.".into(),
        ]);
    }
    if function.shape().checked() {
        let slips = closed.is_some_and(|closed| closed.closure.nonholonomic());
        if slips {
            docs.push(" Names the constraint at a singular position, and beyond one.".into());
        } else if let Some(closed) = closed {
            docs.push(match reads_dependents(function, &closed.closure) {
                true => " Names the loop at a singular position, and on another branch than that of the start.".into(),
                false => " Names the loop at a singular position, and out of its reach; the branch is always that of the start.".into(),
            });
        }
    }
    docs
}
