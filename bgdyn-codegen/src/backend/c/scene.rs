//! The files of a scene: its functions of state, inputs and time as arrays, for a caller's integrator.

use bgdyn_runtime::closure::Dependent;

use super::context::FunctionContext;
use super::files::{CFiles, comment, lines_of};
use super::function::{CFunction, definition, signature, written_functions};
use super::newton::Newton;
use super::parameters::of_model;
use super::position_function::PositionFunction;
use super::scene_tables::{sizes, tables};
use super::style::Style;
use crate::function::Function;
use crate::interface::SceneInterface;
use crate::method::{Method, SceneFunction};
use crate::plan::Naming;
use crate::system::SceneEquations;

/// Returns what the files of a scene have.
pub(super) fn scene_files<'a>(
    system: &'a SceneEquations,
    functions: &[Function],
    style: &Style,
) -> CFiles<'a> {
    let interface = SceneInterface::of(system);
    let naming = Naming::of_arrays(&interface);
    let context = FunctionContext::of_scene(&interface, style, &naming);
    let (mut prototypes, mut texts) = (Vec::new(), String::new());
    for function in written_functions(functions, &context) {
        let about = documentation(function, style);
        prototypes.extend(about.iter().cloned());
        prototypes.extend([format!("{};", signature(function, &context)), String::new()]);
        let CFunction { blocks, whole } = definition(function, &context);
        texts += &(blocks + &lines_of(about) + &whole);
    }
    let closes = |f: &Function| f.method == Method::Scene(SceneFunction::ClosingStep);
    if functions.iter().any(closes) && !interface.layout.closing.is_empty() {
        for function in closing_functions(&context, &interface) {
            prototypes.extend(function.prototype());
            texts += &function.definition();
        }
    }
    let scene = &system.scene;
    CFiles {
        title: format!("The scene `{}`", scene.name),
        description: scene.description.as_deref().unwrap_or_default(),
        sizes: sizes(&interface),
        types: Vec::new(),
        tables: tables(&interface, style),
        parameters: &scene.parameters,
        prototypes,
        functions: texts,
    }
}

/// Returns the documentation of a function.
fn documentation(function: &Function, style: &Style) -> Vec<String> {
    let Method::Scene(role) = function.method else {
        unreachable!("a scene has functions of its own only")
    };
    let mut lines = vec![
        role.summary().to_string(),
        format!(
            "Operations: {} ({}).",
            function.operations(),
            function.formulation
        ),
    ];
    lines.extend(result_order(role).map(String::from));
    if function.shape().checked() {
        lines.extend([
            format!(
                "Returns 0; the number, from 1, of the cause among {}: a coordinate whose pivot vanishes where the",
                style.global("pivot_names")
            ),
            "mass matrix is singular, or a loop or contact; or -1 where the result is not finite.".into(),
        ]);
    }
    comment(&lines)
}

/// Describes the order of a result whose numbers have no table of names.
fn result_order(role: SceneFunction) -> Option<&'static str> {
    Some(match role {
        SceneFunction::Contacts => "Result: for each mode slip, its rate, holding effort, margin.",
        SceneFunction::RigidContactStates => {
            "Result: for each rigid contact its gap, velocity along x, y, normal, friction, restitution."
        }
        SceneFunction::RigidContactMaps => {
            "Result: for each rigid contact the three rows of its Jacobian, then the three columns of M^-1 J^T."
        }
        SceneFunction::RigidContactBiases => {
            "Result: for each rigid contact its acceleration along x, y, normal where the velocities are constant."
        }
        SceneFunction::Power => {
            "Result: for each entry power supplied, rate of the energy stored, power dissipated."
        }
        SceneFunction::Jacobian => {
            "Result: the N x N matrix row by row, then the N slopes by time."
        }
        SceneFunction::InputJacobian => "Result: the N x NU matrix row by row.",
        _ => return None,
    })
}

/// Returns the function that closes the positions of a state, after the one that it calls.
fn closing_functions(
    context: &FunctionContext<'_>,
    interface: &SceneInterface,
) -> [PositionFunction; 2] {
    let (layout, style) = (&interface.layout, context.style);
    let joint = |&(position, closes): &(usize, usize)| Dependent {
        velocity: position,
        position,
        closes,
    };
    let size = style.sized("N + NM");
    let parameters = of_model(context.naming, style, true);
    let (given, declared) = match &parameters {
        None => ("", String::new()),
        Some(p) => ("parameters, ", format!("{}, ", p.declaration)),
    };
    let newton = Newton {
        style,
        name: "newton",
        is_last: false,
        joints: layout.closing.iter().map(joint).collect(),
        first: layout.nv() + layout.nx(),
        argument: "state",
        size: size.clone(),
        step: format!("{}({given}state, change);", style.global("closing_step")),
        steps: style.constant("NQ"),
        moved: None,
        parameters: declared.clone(),
    };
    let (real, status) = (style.real(), style.global("status"));
    let body = vec![
        format!("{real} found[{size}];"),
        "memcpy(found, state, sizeof found);".into(),
        format!(
            "const int refused = {}({given}found);",
            style.global("newton")
        ),
        "memcpy(result, found, sizeof found);".into(),
        format!("return {status}(refused, found, {});", style.constant("NQ")),
    ];
    let close = PositionFunction {
        about: vec![
            "The state with the positions changed so that all loops close and all wheels touch: Newton's method, at most",
            "11 steps of at most 0.5 rad or m. Returns 0; the number, from 1, in the table of pivot names, of the first loop",
            "or contact that does not close; or -1 where a position is not finite.",
        ],
        signature: format!(
            "int {}({declared}const {real} state[{size}], {real} result[{size}])",
            style.global("close")
        ),
        body,
    };
    [newton.function(), close]
}
