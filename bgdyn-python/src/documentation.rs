//! What `help` prints of methods: arguments and results with shapes, units and frames.

use bgdyn_codegen::bond_graph::Site;
use bgdyn_codegen::choice::Choice;
use bgdyn_codegen::method::{
    Argument, CONTACT_DIRECTIONS, Entries, Method, ParameterSet, Regressor, Shape,
};

use crate::spec::Spec;

/// The class of a result with several arrays, and the axes of each array by its name; one array has none.
type Arrays = (Option<&'static str>, Vec<(&'static str, Vec<&'static str>)>);

/// What all methods take.
const OPTIONS: &str = "out, threads, on_singular: as in bgdyn.Method";

/// Returns what a method of a mechanism returns, in a sentence.
pub fn summary(method: Method, sites: &[Site]) -> String {
    // Names of Rust's constants; a model has them in lower case.
    const NAMES: [(&str, &str); 7] = [
        ("[`CONSTRAINT_NAMES`]", "`constraint_names`"),
        ("[`REACTION_NAMES`]", "`reaction_names`"),
        ("[`LINK_NAMES`]", "`link_names`"),
        ("[`CONTACT_NAMES`]", "`contact_names`"),
        (" as in [`BODY_NAMES`]", ""),
        (", as in [`BASE_PARAMETERS`]", ""),
        ("[`ACTUATED`]", "`actuated_names`"),
    ];
    let replaced = |text: String, (rust, python): &(&str, &str)| text.replace(rust, python);
    NAMES.iter().fold(method.summary(sites), replaced)
}

/// Returns the text for a method of a mechanism, with the sizes that it has there.
pub fn of(spec: &Spec, method: Method) -> String {
    let sizes = spec.sizes();
    let count = |axis: &str| match (axis, method) {
        ("nq", _) => spec.mechanism.nq(),
        ("nv", _) => sizes.nv,
        ("nt", _) => sizes.nt,
        ("nc", _) => sizes.nc,
        ("na", _) => spec.mechanism.actuated_names().len(),
        ("np", Method::DriveEfforts(number)) => number,
        ("numbers", _) => method.shape().len(sizes.nv),
        ("contacts", _) => spec.graph.contacts.len(),
        ("3 contacts", _) => CONTACT_DIRECTIONS * spec.graph.contacts.len(),
        ("nbp", _) => Choice::new(&spec.graph, None)
            .base_parameter_formulas()
            .len(),
        ("parameters", _) => spec.graph.parameters.len(),
        ("10 nb", _) => 10 * spec.graph.moving_links().len(),
        ("n", Method::JointReactions | Method::ActuatedJointReactions(_)) => {
            spec.link_names().len()
        }
        ("n", _) => spec.reaction_names().len(),
        _ => 0,
    };
    let size = |axis: &str| axis.parse().unwrap_or_else(|_| count(axis)).to_string();
    text(&spec.name_of(method), method, &spec.graph.sites, &size)
}

/// Returns name, arguments and text of each method that the class `Model` shows: all but those of sites.
pub fn of_class() -> Vec<(String, Vec<&'static str>, String)> {
    let of_every = Method::possible(&[]).into_iter();
    let of_loops = Method::OF_LOOPS.into_iter().chain(Method::ON_REQUEST);
    let all = of_every
        .chain(of_loops)
        .chain([Method::DriveEfforts(0)])
        .chain(Method::on_request())
        // The class has a property of this name.
        .filter(|method| *method != Method::Regressor(Regressor::Parameters));
    let one = |method: Method| {
        let name = method.name(&[]);
        let arguments = method.arguments().iter().map(|a| a.name()).collect();
        let mut text = text(&name, method, &[], &str::to_owned);
        if let Some(condition) = condition(method) {
            text += &format!("\n\n{condition}");
        }
        (name, arguments, text)
    };
    all.map(one).collect()
}

/// Returns which mechanisms have a method, if not all do.
fn condition(method: Method) -> Option<&'static str> {
    if Method::OF_LOOPS.contains(&method) || Method::ON_REQUEST.contains(&method) {
        return Some("A method of mechanisms with loops, wheels or knife edges.");
    }
    match method {
        Method::DriveEfforts(_) => Some("A method of mechanisms with prescribed joints."),
        Method::Contact(_) => Some("A method of mechanisms with `contacts`."),
        Method::JointReactions => Some(
            "With `actuated` in the file it takes `tau` after `a`: the efforts of these joints, N·m, N.",
        ),
        _ => None,
    }
}

/// Returns the text for a method; `size` prints an axis.
fn text(name: &str, method: Method, sites: &[Site], size: &dyn Fn(&str) -> String) -> String {
    let shape = |axes: &[&str]| {
        let all = ["...".to_owned()].into_iter();
        let all: Vec<String> = all.chain(axes.iter().map(|axis| size(axis))).collect();
        format!("({})", all.join(", "))
    };
    let names: Vec<&str> = method.arguments().iter().map(|a| a.name()).collect();
    let mut lines = vec![
        format!(
            "{name}({}, *, out=None, threads=1, on_singular=\"raise\")",
            names.join(", ")
        ),
        String::new(),
        summary(method, sites),
        String::new(),
        "Arguments, float64; (n,) for one state:".to_owned(),
    ];
    for argument in method.arguments() {
        let (axis, what) = meaning(*argument);
        lines.push(format!(
            "    {}: {}, {what}",
            argument.name(),
            shape(&[axis])
        ));
    }
    lines.push(format!("    {OPTIONS}"));
    lines.push(String::new());
    lines.push(match arrays(method.shape()) {
        (None, all) => {
            let axes = all.first().map_or(&[][..], |(_, axes)| axes);
            format!("Returns {}: {}", shape(axes), method.units())
        }
        (Some(class), all) => {
            let all: Vec<String> = all
                .iter()
                .map(|(field, axes)| format!("{field} {}", shape(axes)))
                .collect();
            let fields = all.join(", ");
            format!("Returns bgdyn.{class}, {fields}: {}", method.units())
        }
    });
    lines.join("\n")
}

/// Returns axis and meaning of an argument.
fn meaning(argument: Argument) -> (&'static str, &'static str) {
    match argument {
        Argument::Q => ("nq", "positions: rad, m, parts of quaternions x, y, z, w"),
        Argument::V => (
            "nv",
            "velocities: rad/s, m/s; of planar, spherical and floating joints in link axes",
        ),
        Argument::A => ("nv", "accelerations dv/dt: rad/s², m/s²"),
        Argument::TreeV => ("nt", "velocities of the open tree: rad/s, m/s"),
        Argument::TreeTau => ("nt", "efforts on the joints of the open tree: N·m, N"),
        Argument::ActuatedTau => ("na", "efforts of the actuated joints: N·m, N"),
        Argument::ReferenceV => ("nv", "velocities of a reference: rad/s, m/s"),
        Argument::ReferenceA => ("nv", "accelerations of a reference: rad/s², m/s²"),
        Argument::Direction => ("nv", "a number for each velocity"),
        Argument::AlongQ => ("nv", "direction of the positions, along v: rad, m"),
        Argument::AlongV => ("nv", "direction of the velocities: rad/s, m/s"),
        Argument::AlongA => ("nv", "direction of the accelerations: rad/s², m/s²"),
        Argument::AlongTau => ("nv", "direction of the efforts: N·m, N"),
        Argument::Cotangent => ("nv", "factors of the results that are differentiated"),
        Argument::BodyParameters => (
            "10 nb",
            "parameters of the bodies: kg, kg·m, kg·m² about the origin of each link",
        ),
        // Those of scenes are no methods here.
        _ => ("nv", "efforts along v: N·m, N"),
    }
}

/// Returns the arrays of a result.
fn arrays(shape: Shape) -> Arrays {
    let one = |axes: &[&'static str]| (None, vec![("", axes.to_vec())]);
    let (square, by_tree) = (vec!["nv", "nv"], vec!["nv", "nt"]);
    match shape {
        Shape::Scalar => one(&[]),
        Shape::CheckedActuated(_) => one(&["na"]),
        Shape::Drives(_) => one(&["np"]),
        Shape::Symmetric | Shape::Square => one(&["nv", "nv"]),
        Shape::Spatial => one(&["6"]),
        Shape::Jacobian => one(&["6", "nv"]),
        Shape::Point => one(&["3"]),
        Shape::PointJacobian => one(&["3", "nv"]),
        // Those of contacts: a number for each, or one for each of three directions.
        Shape::Numbers(_) => one(&["numbers"]),
        Shape::Rows(_) => one(&["3 contacts", "nv"]),
        Shape::Poses(_) => (
            Some("Pose"),
            vec![
                ("rotation", vec!["contacts", "3", "3"]),
                ("translation", vec!["contacts", "3"]),
            ],
        ),
        Shape::TreeMatrix => one(&["nt", "nv"]),
        Shape::TreeVector | Shape::CheckedTree => one(&["nt"]),
        Shape::RowMatrix => one(&["nc", "nt"]),
        Shape::RowVector => one(&["nc"]),
        Shape::ParameterColumns(ParameterSet::Bodies) => one(&["nv", "10 nb"]),
        Shape::ParameterColumns(ParameterSet::Base) => one(&["nv", "nbp"]),
        Shape::ParameterColumns(ParameterSet::Payload) => one(&["nv", "10"]),
        Shape::ParameterVector(ParameterSet::Payload) => one(&["10"]),
        Shape::ParameterColumns(ParameterSet::RunTime(_)) => one(&["nv", "parameters"]),
        Shape::ParameterVector(ParameterSet::RunTime(_)) => one(&["parameters"]),
        Shape::ParameterVector(ParameterSet::Bodies) => one(&["10 nb"]),
        Shape::ParameterVector(ParameterSet::Base) => one(&["nbp"]),
        Shape::VectorTriple => one(&["3", "nv"]),
        Shape::Checked(entries) => match entries {
            Entries::Joints => one(&["nv", "nv"]),
            Entries::Task => one(&["6", "6"]),
            Entries::TaskColumns => one(&["nv", "6"]),
            Entries::TaskVector => one(&["6"]),
            Entries::VectorTriple => one(&["3", "nv"]),
            Entries::Symmetric(_) => one(&["3 contacts", "3 contacts"]),
            Entries::Columns(_) => one(&["nv", "3 contacts"]),
            Entries::ParameterColumns(ParameterSet::Bodies) => one(&["nv", "10 nb"]),
            Entries::ParameterColumns(ParameterSet::Base) => one(&["nv", "nbp"]),
            Entries::ParameterColumns(ParameterSet::Payload) => one(&["nv", "10"]),
            Entries::ParameterColumns(ParameterSet::RunTime(_)) => one(&["nv", "parameters"]),
        },
        Shape::SquarePair => (
            Some("InverseDerivatives"),
            vec![("q", square.clone()), ("v", square)],
        ),
        Shape::SlopesByTree => (
            Some("InverseDerivatives"),
            vec![("q", by_tree), ("v", square)],
        ),
        Shape::FourSquares => (
            Some("Curvature"),
            vec![
                ("qq", square.clone()),
                ("qv", square.clone()),
                ("vv", square.clone()),
                ("aq", square),
            ],
        ),
        Shape::FourCubes => (
            Some("SecondDerivatives"),
            ["qq", "qv", "vv", "aq"]
                .map(|name| (name, vec!["nv"; 3]))
                .to_vec(),
        ),
        Shape::CheckedSquares => (
            Some("ForwardDerivatives"),
            vec![
                ("q", square.clone()),
                ("v", square.clone()),
                ("tau", square),
            ],
        ),
        Shape::CheckedSlopesByTree => (
            Some("ForwardDerivatives"),
            vec![("q", by_tree), ("v", square.clone()), ("tau", square)],
        ),
        Shape::Pose => (
            Some("Pose"),
            vec![("rotation", vec!["3", "3"]), ("translation", vec!["3"])],
        ),
        Shape::CheckedTreeAndRows => (
            Some("ConstrainedDynamics"),
            vec![("accelerations", vec!["nt"]), ("multipliers", vec!["nc"])],
        ),
        Shape::CheckedWrenches | Shape::LinkWrenches => (
            Some("Wrenches"),
            vec![("force", vec!["n", "3"]), ("moment", vec!["n", "3"])],
        ),
        // Vectors along v; those of scenes are no methods here.
        _ => one(&["nv"]),
    }
}
