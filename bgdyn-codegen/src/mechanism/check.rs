//! Checks a spec: the only code that constructs a [`Mechanism`], and the faults that prevent it.

mod base;
mod constraint;
mod contact_gaps;
mod contact_pairs;
mod direction;
mod inertia;
mod joint;
mod limits;
mod loops;
mod mimic;
mod names;
mod order;
mod parameters;
mod prescribed;
mod solid;

use bgdyn_runtime::Dd;

use super::{BaseMotion, Frame, Inertial, Link, LinkId, LockedTree, Mechanism, Tensor, Value};
use crate::fault::{Faults, wording};
use crate::format::{self, Dimension, Field, Spec};
use crate::math::Vec3;
use base::{at_rest, base_is_given, base_link};
use constraint::Row;
pub use constraint::constraint_types;
pub use contact_pairs::CONTACT_KEYS;
use direction::Directions;
pub(crate) use inertia::check_tensor;
use joint::CheckedJoints;
pub use loops::PLANE_KEYS;
use loops::Tree;
use order::LinkTree;
use parameters::Parameters;

/// The only version of the format.
const FORMAT: u32 = 1;

/// Checks the links, joints and frames of a spec against every rule. `stem` is the file's name without its
/// extension, if there is a file; only the part before its first dot is used. `methods` are names that no
/// run-time parameter may have.
///
/// The mechanism is returned if it can be built. It is valid if there is no fault.
pub(crate) fn check(
    spec: &Spec,
    stem: Option<&str>,
    methods: &[String],
    faults: &mut Faults,
) -> Option<Mechanism> {
    checked(spec, stem, (methods, None), faults)
}

/// Returns the mechanism of a valid spec with loops, with joints locked and the loops closed anew.
///
/// # Errors
/// The faults of the locked mechanism, at their places in the file of the mechanism.
pub(crate) fn check_locked(spec: &Spec, locked: &LockedTree<'_>) -> Result<Mechanism, Faults> {
    let mut faults = Faults::default();
    let mechanism = checked(
        &locked.spec(spec),
        Some(locked.name()),
        (&[], Some(locked)),
        &mut faults,
    );
    mechanism.ok_or(faults)
}

fn checked(
    spec: &Spec,
    stem: Option<&str>,
    (methods, locked): (&[String], Option<&LockedTree<'_>>),
    faults: &mut Faults,
) -> Option<Mechanism> {
    format(spec, faults);
    let name = names::mechanism_name(spec, stem, faults);
    let directions = Directions::new(spec, faults);
    let links = spec.links.value().map_or(&[][..], Vec::as_slice);
    let frames = spec.frames.value().map_or(&[][..], Vec::as_slice);
    if let Some(none) = spec.links.given().filter(|links| links.value.is_empty()) {
        faults.push(wording::no_links(&none.location));
    }
    names::check(links, frames, faults);
    let tree = LinkTree::new(links, frames, faults);
    let mut parameters = Parameters::new(methods);
    let bodies = links
        .iter()
        .map(|link| body(link, &directions, &mut parameters, faults))
        .collect();
    let frames = frames
        .iter()
        .map(|f| frame(f, &tree, &directions, faults))
        .collect();
    let gravity = direction::vector_or(&spec.gravity, standard_gravity());
    let given = base_is_given(spec, &parameters, faults);
    let whole = || {
        let (mut links, places) = assemble(bodies, &tree, given, faults)?;
        let mut frames = all(frames);
        for frame in frames.iter_mut().flatten() {
            frame.link = frame.link.and_then(|LinkId(i)| places.get(i).copied());
        }
        let tree = Tree::new(&links, frames.as_deref().unwrap_or_default());
        let parallel = loops::parallel_loops((spec, tree, &directions), faults);
        let (rows, parallel) = parallel.unzip();
        let rows: Vec<Row> = rows.unwrap_or_default();
        let constraints = constraint::apply(spec, (&mut links, rows), &parameters, faults)?;
        let (frames, parallel) = (frames?, parallel?);
        let gravity = gravity?;
        let mut parameters = parameters.into_all();
        let base = given.then(|| {
            let motion = BaseMotion::from_parameter(parameters.len());
            parameters.extend(at_rest(gravity));
            motion
        });
        let prescribed = prescribed::numbered(&constraints.prescribed, &links, &mut parameters);
        let mut mechanism = Mechanism {
            name: name?,
            label: text(&spec.label),
            description: text(&spec.description),
            gravity,
            links,
            frames,
            parameters,
            base,
            prescribed,
            coordinates: Vec::new(),
            positions: Vec::new(),
            snapped: None,
            parallel,
            closure: None,
            contact_pairs: Vec::new(),
        };
        mechanism.number();
        if let Some(locked) = locked {
            mechanism = locked.lock(&mechanism);
        }
        let start = locked.map(|locked| locked.start(&mechanism));
        let tree = Tree::new(mechanism.links(), mechanism.frames());
        let context = (spec, tree, &directions);
        let planes = loops::planes(spec, (tree, &directions), faults);
        let pairs = contact_pairs::contact_pairs(context, &planes, faults);
        let entries = loops::ClosedEntries {
            spec,
            contacts: &constraints.contacts,
            planes: &planes,
            start,
        };
        loops::close(entries, &mut mechanism, &directions, faults)?;
        mechanism.contact_pairs = pairs?;
        // In a scene locked joints may leave a contact without motion.
        if locked.is_none() {
            contact_gaps::refuse_constant(spec, &mechanism, faults);
        }
        mechanism.snapped = directions.into_snapped();
        Some(mechanism)
    };
    whole()
}

fn format(spec: &Spec, faults: &mut Faults) {
    if let Some(format) = spec.format.given()
        && format.value.value != Dd::from_f64(f64::from(FORMAT))
    {
        faults.push(wording::unknown_format(
            &format.location,
            &format.value.text,
            FORMAT,
        ));
    }
}

fn standard_gravity() -> Vec3<Dd> {
    let down = "-9.81".parse().unwrap_or(Dd::from_f64(-9.81));
    Vec3([Dd::ZERO, Dd::ZERO, down])
}

/// A link before its insertion in the tree.
struct CheckedLink {
    name: String,
    label: Option<String>,
    joints: CheckedJoints,
    inertial: Inertial,
}

fn body(
    link: &format::LinkSpec,
    directions: &Directions,
    parameters: &mut Parameters<'_>,
    faults: &mut Faults,
) -> Option<CheckedLink> {
    let joints = joint::joints(link, directions, faults);
    let inertial = inertial(link, directions, parameters, faults);
    Some(CheckedLink {
        name: link.name.value()?.clone(),
        label: text(&link.label),
        joints: joints?,
        inertial: inertial?,
    })
}

/// Checks inertial parameters, which may be run-time parameters. Their defaults obey the rules for
/// numbers.
fn inertial(
    link: &format::LinkSpec,
    directions: &Directions,
    parameters: &mut Parameters<'_>,
    faults: &mut Faults,
) -> Option<Inertial> {
    if let Some(mass) = link.mass.given().filter(|mass| mass.value.value < Dd::ZERO) {
        faults.push(wording::negative_mass(&mass.location, &mass.value.text));
    }
    let name = link.name.value().map_or("", String::as_str);
    let zero = Value::Fixed(Dd::ZERO);
    let mass = match &link.mass {
        Field::Absent => Some(zero),
        Field::Broken => None,
        Field::Given(mass) => {
            let meaning = || format!("mass of link `{name}`");
            Some(parameters.value(mass, Dimension::Mass, meaning, faults))
        }
    };
    let com = match &link.com {
        Field::Absent => Some(Vec3([zero; 3])),
        Field::Broken => None,
        Field::Given(com) => Some(Vec3(std::array::from_fn(|k| {
            let axis = ["x", "y", "z"][k];
            let meaning = || format!("{axis} of the centre of mass of link `{name}`");
            parameters.value(&com.value[k], Dimension::Length, meaning, faults)
        }))),
    };
    let inertia = inertia::tensor(link, directions, parameters, faults);
    Some(Inertial {
        mass: mass?,
        com: com?,
        inertia: inertia?,
    })
}

fn frame(
    frame: &format::FrameSpec,
    tree: &LinkTree<'_>,
    directions: &Directions,
    faults: &mut Faults,
) -> Option<Frame> {
    let origin = directions.pose(&frame.origin, faults);
    let link = tree.frame_id(frame, faults);
    Some(Frame {
        name: frame.name.value()?.clone(),
        label: text(&frame.label),
        link: link?,
        origin: origin?,
    })
}

/// Returns the links in their order, each after the massless links of its chain of joints, and the place
/// of each link of the tree among them. If the motion of the base is given, the first is the base.
fn assemble(
    mut bodies: Vec<Option<CheckedLink>>,
    tree: &LinkTree<'_>,
    given: bool,
    faults: &mut Faults,
) -> Option<(Vec<Link>, Vec<LinkId>)> {
    let mut links: Vec<Link> = Vec::with_capacity(bodies.len() + 1);
    let mut mimics: Vec<mimic::Given> = Vec::new();
    let base = given.then_some(LinkId(0));
    if given {
        links.push(base_link(massless()));
        mimics.push(None);
    }
    // The place of each link of the tree among all links.
    let mut places: Vec<LinkId> = Vec::with_capacity(bodies.len());
    for &index in &tree.sequence {
        let CheckedLink {
            name,
            label,
            mut joints,
            inertial,
        } = bodies.get_mut(index)?.take()?;
        let mut parent = match tree.parent_id(index)? {
            None => base,
            // In a circle a parent has no place yet.
            Some(LinkId(p)) => Some(*places.get(p)?),
        };
        let own = joints.chain.pop()?;
        for joint in joints.chain {
            links.push(Link {
                name: format!("{name}_{}", joint.name),
                label: None,
                parent,
                joint,
                inertial: massless(),
                hidden: true,
            });
            mimics.push(None);
            parent = Some(LinkId(links.len() - 1));
        }
        places.push(LinkId(links.len()));
        mimics.push(joints.mimic);
        links.push(Link {
            name,
            label,
            parent,
            joint: own,
            inertial,
            hidden: false,
        });
    }
    mimic::resolve(&mut links, &mimics, faults)?;
    Some((links, places))
}

/// Returns the inertial parameters of a massless link.
fn massless() -> Inertial {
    let zero = Value::Fixed(Dd::ZERO);
    Inertial {
        mass: zero,
        com: Vec3([zero; 3]),
        inertia: Tensor {
            entries: [zero; 6],
            axes: Directions::identity().rotation,
        },
    }
}

fn text(field: &Field<String>) -> Option<String> {
    field.value().cloned()
}

fn all<T>(items: Vec<Option<T>>) -> Option<Vec<T>> {
    items.into_iter().collect()
}
