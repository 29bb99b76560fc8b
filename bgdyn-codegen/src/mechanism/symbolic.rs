//! Replaces the numbers of a mechanism by symbols, for printed equations.

use bgdyn_runtime::Dd;

use super::{
    CoordinateId, Degrees, Inertial, Joint, Limits, Link, LinkId, Mechanism, Pose, PositionId,
    Tensor, Value, joint,
};
use crate::math::Vec3;

/// A letter for a number of the spec: m₂, l₁, Jzz₃.
#[derive(Clone, Debug, PartialEq)]
pub struct NumberSymbol {
    /// `m` mass, `c` centre of mass, `J` entry of the tensor about it, `l` displacement of a joint in its
    /// parent's axes; the name of a run-time parameter.
    pub symbol: String,
    /// The component: `x`, `zz`; empty if there is only one.
    pub component: &'static str,
    /// Its link, counted from 1 in the order of [`Mechanism::links`]. For a displacement: the parent link,
    /// followed by the child link if the parent has several children.
    pub of: Vec<usize>,
    /// Description: the owner, and the axis.
    pub meaning: String,
    /// The spec's value in SI units. Positions are measured along the axis direction that makes them
    /// positive.
    pub value: Dd,
    /// Its powers of kilogram, metre and second.
    pub dimension: [i32; 3],
    /// Whether it is a run-time parameter, with a name of its own.
    pub run_time: bool,
}

/// A mechanism whose inertial numbers are run-time parameters, and in which the joints' displacements are
/// coordinates of massless carriers. All remaining numbers in its equations are directions.
#[derive(Clone, Debug)]
pub struct SymbolicMechanism {
    /// The mechanism. Its original coordinates come first, then the displacements.
    pub mechanism: Mechanism,
    /// The letters. The original run-time parameters come first.
    pub letters: Vec<NumberSymbol>,
    /// For each of its parameters the letter, and whether it is the negative of the letter.
    pub parameters: Vec<(usize, bool)>,
    /// For each additional coordinate the letter of the displacement.
    pub lengths: Vec<usize>,
}

const AXES: [&str; 3] = ["x", "y", "z"];
const ENTRIES: [&str; 6] = ["xx", "yy", "zz", "xy", "xz", "yz"];
const MASS: [i32; 3] = [1, 0, 0];
const LENGTH: [i32; 3] = [0, 1, 0];
const INERTIA: [i32; 3] = [1, 2, 0];

impl Mechanism {
    /// Returns the mechanism with letters for masses, centres of mass, tensors and the displacements
    /// between joints. The base's position does not change: no effort depends on it. All joints must be
    /// plain ([`Mechanism::compound_joints`]).
    pub fn symbolic(&self) -> SymbolicMechanism {
        let mut all = SymbolicMechanism {
            mechanism: self.clone(),
            letters: Vec::new(),
            parameters: Vec::new(),
            lengths: Vec::new(),
        };
        all.mechanism.links.clear();
        for (p, parameter) in self.parameters.iter().enumerate() {
            all.letters.push(NumberSymbol {
                symbol: parameter.name.clone(),
                component: "",
                of: Vec::new(),
                meaning: format!("{}, a run-time parameter", parameter.meaning),
                value: parameter.default,
                dimension: match parameter.unit {
                    "kg" => MASS,
                    "m" => LENGTH,
                    _ => INERTIA,
                },
                run_time: true,
            });
            all.parameters.push((p, false));
        }
        let mut links = Vec::new();
        for (i, link) in self.links.iter().enumerate() {
            let parent = link.parent.map(|p| (p, links[p.0]));
            let carrier = parent.map(|(p, link)| all.displace(self, i, p, link));
            let mut copy = link.clone();
            copy.parent = carrier;
            if carrier.is_some() {
                copy.joint.origin.translation = Vec3([Dd::ZERO; 3]);
            }
            all.letter_body((i, link.name.as_str()), &mut copy.inertial);
            let link = LinkId(all.mechanism.links.len());
            if let Some(j) = copy.joint.coordinate {
                all.mechanism.coordinates[j.0] = link;
                all.mechanism.positions[j.0] = link;
            }
            all.mechanism.links.push(copy);
            links.push(link);
        }
        for frame in &mut all.mechanism.frames {
            frame.link = frame.link.map(|l| links[l.0]);
        }
        all
    }
}

impl SymbolicMechanism {
    /// Adds massless carriers from the parent's axes to the joint of link i: one prismatic joint for each
    /// nonzero component of the displacement. Returns the last one.
    fn displace(&mut self, from: &Mechanism, i: usize, parent: LinkId, link: LinkId) -> LinkId {
        let offsets = |l: &Link| l.joint.origin.translation.0.map(|x| x != Dd::ZERO);
        let beside = from.links.iter().filter(|l| l.parent == Some(parent));
        let several = beside.filter(|l| offsets(l).contains(&true)).count() > 1;
        let of = if several {
            vec![parent.0 + 1, i + 1]
        } else {
            vec![parent.0 + 1]
        };
        let step = from.links[i].joint.origin.translation;
        let mut last = link;
        for axis in 0..3 {
            if step.0[axis] == Dd::ZERO {
                continue;
            }
            let opposite = step.0[axis] < Dd::ZERO;
            let (joint, parent) = (&from.links[i].joint.name, &from.links[parent.0].name);
            let along = along_axis(axis, opposite);
            self.letters.push(NumberSymbol {
                symbol: "l".into(),
                component: component(step, axis),
                of: of.clone(),
                meaning: format!("from the axes of {parent} to {joint}, along {along}"),
                value: step.0[axis].abs(),
                dimension: LENGTH,
                run_time: false,
            });
            self.lengths.push(self.letters.len() - 1);
            let mut direction = Vec3([Dd::ZERO; 3]);
            direction.0[axis] = if opposite { -Dd::ONE } else { Dd::ONE };
            last = self.slide(last, direction);
        }
        last
    }

    /// Adds a massless link that slides along `axis` of `parent`.
    fn slide(&mut self, parent: LinkId, axis: Vec3<Dd>) -> LinkId {
        let zero = Value::Fixed(Dd::ZERO);
        let link = LinkId(self.mechanism.links.len());
        let coordinate = CoordinateId(self.mechanism.coordinates.len());
        let name = format!("displacement {}", coordinate.0);
        self.mechanism.coordinates.push(link);
        self.mechanism.positions.push(link);
        self.mechanism.links.push(Link {
            name: name.clone(),
            label: None,
            parent: Some(parent),
            joint: Joint {
                name,
                label: None,
                kind: joint::prismatic(),
                axis,
                origin: Pose::IDENTITY,
                limits: Limits::default(),
                coordinate: Some(coordinate),
                degrees: Degrees {
                    positions: vec![PositionId(coordinate.0)],
                    velocities: vec![coordinate],
                    ..Degrees::default()
                },
            },
            inertial: Inertial {
                mass: zero,
                com: Vec3([zero; 3]),
                inertia: Tensor {
                    entries: [zero; 6],
                    axes: Pose::IDENTITY.rotation,
                },
            },
            hidden: true,
        });
        link
    }

    /// Replaces the numbers of a link's body by letters.
    fn letter_body(&mut self, link: (usize, &str), inertial: &mut Inertial) {
        let (i, name) = link;
        let plain = |symbol: &str, component, meaning, dimension| NumberSymbol {
            symbol: symbol.into(),
            component,
            of: vec![i + 1],
            meaning,
            value: Dd::ZERO,
            dimension,
            run_time: false,
        };
        let mass = plain("m", "", format!("mass of {name}"), MASS);
        inertial.mass = self.letter(inertial.mass, mass);
        let numbers = inertial.com.map(|c| match c {
            Value::Fixed(x) => x,
            // A parameter can have any value: the other components need their index.
            Value::Parameter(_) => Dd::ONE,
        });
        for axis in 0..3 {
            let along = along_axis(axis, numbers.0[axis] < Dd::ZERO);
            let meaning = format!("centre of mass of {name}, along {along}");
            let letter = plain("c", component(numbers, axis), meaning, LENGTH);
            inertial.com.0[axis] = self.letter(inertial.com.0[axis], letter);
        }
        for (entry, component) in inertial.inertia.entries.iter_mut().zip(ENTRIES) {
            let meaning = format!("inertia of {name} about its centre of mass, {component}");
            *entry = self.letter(*entry, plain("J", component, meaning, INERTIA));
        }
    }

    /// Returns a letter for a number that is neither zero nor a run-time parameter.
    fn letter(&mut self, value: Value, mut letter: NumberSymbol) -> Value {
        let Value::Fixed(x) = value else {
            return value;
        };
        if x == Dd::ZERO {
            return value;
        }
        // Products of inertia retain their sign: they are not measured along an axis.
        let opposite = x < Dd::ZERO && letter.dimension == LENGTH;
        letter.value = if opposite { -x } else { x };
        self.letters.push(letter);
        self.parameters.push((self.letters.len() - 1, opposite));
        let name = format!("parameter {}", self.parameters.len());
        self.mechanism.parameter(&name, String::new(), x, "")
    }
}

/// Returns an axis with its direction: `x`, `−x`.
fn along_axis(axis: usize, opposite: bool) -> String {
    let sign = if opposite { "−" } else { "" };
    format!("{sign}{}", AXES[axis])
}

/// Returns the name of a vector's component; empty if it is the only one.
fn component(v: Vec3<Dd>, axis: usize) -> &'static str {
    let several = v.0.iter().filter(|&&x| x != Dd::ZERO).count() > 1;
    if several { AXES[axis] } else { "" }
}
