//! A random mechanism with prescribed joints, and that in which they are free.

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::random::Random;
use bgdyn_runtime::Dd;

use super::robot::Robot;

/// Links on each other or on the world, with joints of all types of one degree and sometimes a ball; most axes are
/// along one of the frame, off by rounding or by more.
pub(super) fn links(random: &mut Random, count: usize) -> String {
    let mut text =
        "format: 1\nname: driven\nsnap: 0\ngravity: [0.3, -0.4, -9.7]\nlinks:\n".to_owned();
    for i in 0..count {
        let kind = match random.below(6) {
            0 | 1 => "revolute",
            2 | 3 => "prismatic",
            4 => "continuous",
            _ => "helical, lead: 30 mm",
        };
        let parent = match random.below(i as u64 + 1) as usize {
            0 => String::new(),
            p => format!("    parent: body_{}\n", p - 1),
        };
        let off = [0.0, 1e-15, 1e-9, 0.4][random.below(4) as usize];
        let main = random.below(3) as usize;
        let axis: Vec<String> = (0..3)
            .map(|k| {
                format!(
                    "{:e}",
                    if k == main {
                        1.0
                    } else {
                        off * random.signed()
                    }
                )
            })
            .collect();
        let mut vector = || [0; 3].map(|_| format!("{:.3}", random.signed())).join(", ");
        let (axis, xyz, rpy, com) = (axis.join(", "), vector(), vector(), vector());
        let joint = match i {
            2 => "name: j2, type: spherical".to_owned(),
            _ => format!("name: j{i}, type: {kind}, axis: [{axis}]"),
        };
        text += &format!(
            "  - name: body_{i}\n{parent}    joint: {{ {joint}, origin: {{ xyz: [{xyz}], rpy: [{rpy}] }} }}\n    \
             mass: 0.{}\n    com: [{com}]\n    inertia: {{ xx: 0.02, yy: 0.03, zz: 0.025, xz: 0.002 }}\n",
            i + 3
        );
    }
    text + "frames:\n  - { name: tool, link: body_4, origin: { xyz: [0.1, 0.2, 0.3], rpy: [0.4, 0.5, 0.6] } }\n"
}

/// A mechanism with prescribed joints, and that in which they are free.
pub(super) struct Pair {
    pub(super) free: Robot,
    pub(super) own: Robot,
    /// The velocities and positions of the free mechanism that are those of the other one.
    pub(super) kept: [Vec<usize>; 2],
    /// Those of the prescribed joints.
    pub(super) driven: [Vec<usize>; 2],
    pub(super) what: String,
}

impl Pair {
    pub(super) fn new(seed: u64) -> Self {
        let mut random = Random(seed);
        let text = links(&mut random, 6);
        let mut driven: Vec<usize> = [0, 1, 3, 4, 5].into_iter().collect();
        while driven.len() > 1 + (seed as usize) % 3 {
            driven.remove(random.below(driven.len() as u64) as usize);
        }
        // The order of the constraints is not that of the links.
        let constraints = driven.iter().rev();
        let constraints =
            constraints.map(|j| format!("  c{j}: {{ type: prescribed, joint: j{j} }}\n"));
        let constraints: String = constraints.collect();
        Pair::of(
            &text,
            &constraints,
            format!("seed {seed}, prescribed {driven:?}"),
        )
    }

    pub(super) fn of(text: &str, constraints: &str, what: String) -> Self {
        let free = Robot::read(text);
        let own = Robot::read(&format!("{text}constraints:\n{constraints}"));
        let names = own.mechanism.prescribed_names();
        let split = |all: Vec<String>| {
            let (driven, kept): (Vec<usize>, Vec<usize>) =
                (0..all.len()).partition(|&k| names.contains(&all[k]));
            [kept, driven]
        };
        let [kept_v, driven_v] = split(free.mechanism.joint_names());
        let [kept_q, driven_q] = split(free.mechanism.position_names());
        assert_eq!(driven_v.len(), names.len(), "{what}");
        Pair {
            free,
            own,
            kept: [kept_q, kept_v],
            driven: [driven_q, driven_v],
            what,
        }
    }

    /// Returns a state of both.
    pub(super) fn state(&self, seed: u64) -> [Inputs<Dd>; 2] {
        let s = self.free.state(seed);
        let free = Inputs {
            q: s.q,
            v: s.v,
            a: s.a,
            u: s.u,
            ..Inputs::default()
        };
        let own = self.own_part(&free);
        [free, own]
    }

    pub(super) fn own_part(&self, free: &Inputs<Dd>) -> Inputs<Dd> {
        let [q, v] = &self.kept;
        let joints = self.driven[0].iter().zip(&self.driven[1]);
        let motion = joints.flat_map(|(&p, &j)| [free.q[p], free.v[j], free.a[j]]);
        Inputs {
            q: pick(&free.q, q),
            v: pick(&free.v, v),
            a: pick(&free.a, v),
            u: pick(&free.u, v),
            parameters: motion.collect(),
            ..Inputs::default()
        }
    }

    /// Returns the numbers with zeros in place of those of the joints that are not prescribed.
    pub(super) fn driven_alone(&self, x: &[Dd]) -> Vec<Dd> {
        let own = |k: usize| {
            if self.driven[1].contains(&k) {
                x[k]
            } else {
                Dd::ZERO
            }
        };
        (0..x.len()).map(own).collect()
    }

    pub(super) fn np(&self) -> usize {
        self.driven[1].len()
    }
}

pub(super) fn pick(x: &[Dd], of: &[usize]) -> Vec<Dd> {
    of.iter().map(|&k| x[k]).collect()
}
