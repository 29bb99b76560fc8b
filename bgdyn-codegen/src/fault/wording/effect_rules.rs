//! Messages about the rules of individual kinds of effects, and of hydraulic nodes.

use super::six_digits;
use crate::fault::{Fault, Location};

// Friction

pub(crate) fn no_stribeck_speed(location: &Location) -> Fault {
    let message = "`static` needs `stribeck_speed`, the speed at which friction falls from it";
    Fault::new(location, "effect-missing", message).with_help("add `stribeck_speed: …`")
}

pub(crate) fn friction_feeds_energy(location: &Location, least: f64) -> Fault {
    let message = format!(
        "`viscous` is less than damping·(static − kinetic)/kinetic = {least:.6}: this friction can feed energy into the motion"
    );
    Fault::new(location, "effect-passivity", message)
        .with_help("raise `viscous` or lower `damping`")
        .into_warning()
}

pub(crate) fn width_above_stribeck_speed(location: &Location, width: &str, speed: &str) -> Fault {
    let message = format!(
        "`width` is {width}, more than `stribeck_speed`, {speed}: the curve falls before friction has risen, and `static` has hardly an effect"
    );
    Fault::new(location, "effect-width", message)
        .with_help("a tenth of it is usual")
        .into_warning()
}

// Stops, rotors, wrenches, drag

pub(crate) fn no_stops(location: &Location, joint: &str) -> Fault {
    let message =
        format!("the effect has neither `lower` nor `upper`, and `{joint}` has no limits");
    Fault::new(location, "effect-missing", message).with_help("write `lower`, `upper` or both")
}

pub(crate) fn rotor_axis_without_link(location: &Location) -> Fault {
    let message = "`axis` gives the direction of the rotor, but no `on` gives its link";
    Fault::new(location, "effect-missing", message)
        .with_help("add `on: …`, or leave `axis` out: the reflected inertia has no direction")
}

pub(crate) fn repeated_component(location: &Location, component: &str) -> Fault {
    wrench_components(location, format!("`components` names `{component}` twice"))
}

pub(crate) fn no_components(location: &Location) -> Fault {
    wrench_components(location, "`components` is empty".to_owned())
}

fn wrench_components(location: &Location, message: String) -> Fault {
    Fault::new(location, "effect-components", message)
        .with_help("write the components that are inputs: `[fx, fz]`")
}

pub(crate) fn no_drag(location: &Location, name: &str) -> Fault {
    let message = format!("`{name}` has no drag");
    Fault::new(location, "effect-missing", message)
        .with_help("add `linear`, `quadratic` or `angular`")
}

pub(crate) fn acts_on_the_world(location: &Location, name: &str, at: &str) -> Fault {
    let message = format!("`{at}` is fixed to the world: `{name}` would do nothing");
    Fault::new(location, "effect-place", message).with_help("name a link, or a frame on one")
}

// Hydraulics

pub(crate) fn side_without_area(location: &Location, key: &str) -> Fault {
    let message = format!("`{key}` is of side b, which has no `area_b`");
    Fault::new(location, "effect-missing", message)
        .with_help("add `area_b: …`, or leave it out: the cylinder is single-acting")
}

pub(crate) fn below_vacuum(location: &Location, key: &str, text: &str, vacuum: f64) -> Fault {
    let message = format!("`{key}` is {text}, less than a vacuum: {vacuum} Pa");
    Fault::new(location, "effect-pressure", message)
        .with_help("pressures are measured against the surroundings")
}

pub(crate) fn joins_a_node_to_itself(location: &Location, keys: [&str; 2], node: &str) -> Fault {
    let [one, other] = keys;
    let message = format!("`{one}` and `{other}` are the same node, `{node}`: there is no flow");
    Fault::new(location, "joined-to-nothing", message).with_help("join two nodes")
}

/// `asked` is the name of the fluid in the node, `known` are the fluids of the scene.
pub(crate) fn no_fluid(
    location: &Location,
    name: &str,
    asked: Option<&str>,
    known: &[&str],
) -> Fault {
    let quoted: Vec<String> = known.iter().map(|fluid| format!("`{fluid}`")).collect();
    let quoted = quoted.join(", ");
    let message = match (asked, known) {
        (_, []) => format!("`{name}` has no fluid: the scene calls for none"),
        (Some(fluid), _) => format!("no fluid of this scene is called `{fluid}`"),
        (None, _) => format!("which of the fluids {quoted} is in `{name}`?"),
    };
    let help = match known {
        [] => "add `oil: { type: fluid, bulk_modulus: … }` and call for it: `- hydraulics` calls for all of it".to_owned(),
        _ => format!("write `fluid: …`: one of {quoted}"),
    };
    Fault::new(location, "no-fluid", message).with_help(help)
}

pub(crate) fn two_fluids(location: &Location, name: &str, [one, other]: [&str; 2]) -> Fault {
    let message = format!("`{name}` joins `{one}` and `{other}`: two fluids");
    Fault::new(location, "two-fluids", message).with_help("join nodes of one fluid")
}

/// `joined` are the elements at the junction: none, or one.
pub(crate) fn dead_end(location: &Location, name: &str, joined: Option<&str>) -> Fault {
    let message = match joined {
        None => format!("nothing is joined to `{name}`"),
        Some(one) => format!("`{name}` is a dead end: `{one}` alone is joined to it"),
    };
    Fault::new(location, "joined-to-nothing", message)
        .with_help("a junction is between two elements")
}

// Algebraic loops

fn algebraic_loop(location: &Location, message: String, way_out: &str) -> Fault {
    Fault::new(location, "algebraic-loop", message).with_help(way_out)
}

pub(crate) fn motor_without_impedance(location: &Location) -> Fault {
    let message = "neither resistance nor inductance: the loop voltage → current → torque → speed → voltage has no solution";
    algebraic_loop(location, message.to_owned(), "give one of them")
}

pub(crate) fn circle_without_volume(location: &Location, name: &str) -> Fault {
    let message = format!(
        "`{name}` lies in a circle of elements and junctions, none of which has a volume or a pressure of its own"
    );
    let way_out = "make one of the junctions a volume: `{ type: line, volume: … }`";
    algebraic_loop(location, message, way_out)
}

/// `joined` are the elements at the junction; `varies` is one of two with a varying opening.
pub(crate) fn junction_without_volume(
    location: &Location,
    name: &str,
    joined: &[&str],
    varies: Option<&str>,
) -> Fault {
    let quoted: Vec<String> = joined.iter().map(|one| format!("`{one}`")).collect();
    let message = match varies {
        Some(varies) => format!(
            "{} meet in `{name}`, which has no volume, and `{varies}` has an opening that varies: where it closes, nothing determines the pressure between them",
            quoted.join(" and ")
        ),
        None => format!(
            "{} meet in `{name}`, which has no volume: each flow depends on a pressure that depends on all of them",
            quoted.join(", ")
        ),
    };
    let way_out = format!("give it a volume: `{name}: {{ type: line, volume: … }}`");
    algebraic_loop(location, message, &way_out)
}

// Values of a scene's equations

/// `what` is the quantity, `when` the part of the motion in which it has the value.
pub(crate) fn not_positive(
    location: &Location,
    (what, value, when): (&str, f64, &str),
    way_out: &str,
) -> Fault {
    let message = format!("{what} is {value:.3e} {when}");
    Fault::new(location, "effect-range", message).with_help(way_out)
}

/// A given mode that contradicts the rest of the state, SI units.
pub(crate) struct WrongMode<'a> {
    /// Its name.
    pub name: &'a str,
    /// The given mode, and the one that is consistent with the state.
    pub modes: [f64; 2],
    /// Name of the rate that the mode may hold.
    pub rate: &'a str,
    /// Units of the rate and of the effort.
    pub units: [&'static str; 2],
    /// The reason of the contradiction.
    pub why: WhyWrong,
}

/// The reason why a given mode contradicts the state.
pub(crate) enum WhyWrong {
    /// The rate relative to the counterpart is not zero.
    Slips(f64),
    /// At rest, this effort is within the limit.
    IsHeld(f64),
    /// The effort for holding is too large: the effort, and the excess.
    CannotHold(f64, f64),
    /// The rate, and the limit that it is not at.
    OffLimit(f64, f64),
    /// The rate is at its limit, and the effort keeps it there.
    StaysAtLimit,
    /// The rate is at its limit, and the effort takes it away from there.
    LeavesLimit,
}

pub(crate) fn wrong_mode(location: &Location, mode: &WrongMode<'_>) -> Fault {
    let WrongMode {
        name,
        modes: [stated, right],
        rate,
        units: [unit, effort],
        why,
    } = mode;
    let why = match *why {
        WhyWrong::Slips(slip) => {
            let slip = six_digits(slip);
            format!("`{rate}` begins with {slip} {unit} against its counterpart")
        }
        WhyWrong::IsHeld(holding) => {
            let holding = six_digits(holding);
            format!("at rest it is held: that takes {holding} {effort}")
        }
        WhyWrong::CannotHold(holding, beyond) => {
            let [holding, beyond] = [holding, beyond].map(six_digits);
            format!("holding takes {holding} {effort}, {beyond} {effort} more than it can hold")
        }
        WhyWrong::OffLimit(value, limit) => {
            let [value, limit] = [value, limit].map(six_digits);
            format!("`{rate}` begins with {value} {unit} and its limit is {limit} {unit}")
        }
        WhyWrong::StaysAtLimit => format!("`{rate}` begins at its limit and is held there"),
        WhyWrong::LeavesLimit => format!("`{rate}` begins at its limit and leaves it"),
    };
    let message = format!("`{name}` begins with {stated}, but {why}: its mode is {right}");
    Fault::new(location, "initial-mode", message).with_help(format!(
        "leave `{name}` out: modes are settled when a run begins; or correct the rate or the effort"
    ))
}
