//! MJCFs: values of MuJoCo, closed forms, equivalent files.

use super::{effects, made, many, mechanism, near, pose, value};
use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::random::Random;
use serde_json::Value;

const EVERYTHING: &str = include_str!("../mjcf/everything.xml");
const GOLDEN: &str = include_str!("../mjcf/golden.json");
const COMPILER: &str = r#"<compiler angle="degree" eulerseq="xYz" inertiagrouprange="0 3"/>"#;

/// An MJCF with this inside its root.
fn mjcf(inside: &str) -> String {
    format!("<mujoco model='m'>\n{inside}\n</mujoco>")
}

fn efforts(yaml: &str, state: [&[f64]; 3]) -> Vec<f64> {
    value(&mechanism(yaml), Method::InverseDynamics, state)
}

/// Replaces texts that must be there.
fn changed(changes: &[(&str, &str)]) -> String {
    changes
        .iter()
        .fold(EVERYTHING.to_owned(), |text, (old, new)| {
            assert!(text.contains(old), "{old}");
            text.replace(old, new)
        })
}

/// Returns the mass matrix, row by row.
fn mass_matrix(mechanism: &Mechanism, q: &[f64]) -> Vec<f64> {
    let packed = value(mechanism, Method::MassMatrix, [q, &[], &[]]);
    let count = (0..).find(|n| n * (n + 1) / 2 >= packed.len()).unwrap_or(0);
    let mut full = vec![0.0; count * count];
    let pairs = (0..count).flat_map(|i| (0..=i).map(move |j| (i, j)));
    for ((i, j), entry) in pairs.zip(packed) {
        full[i * count + j] = entry;
        full[j * count + i] = entry;
    }
    full
}

fn numbers(value: &Value) -> Vec<f64> {
    let list = value.as_array().expect("a list");
    list.iter().map(|x| x.as_f64().expect("a number")).collect()
}

/// Mass matrix, bias and poses of sites are those of MuJoCo, for four settings of the compiler.
#[test]
fn every_notation_has_the_values_of_mujoco() {
    let golden: Value = serde_json::from_str(GOLDEN).expect("JSON");
    let bounds = r#"<compiler boundmass="0.4" boundinertia="0.012" angle="radian" settotalmass="9" eulerseq="ZYX"/>"#;
    let balance = r#"<compiler balanceinertia="true" boundinertia="0.001" autolimits="false"/>"#;
    let models = [
        ("everything", changed(&[])),
        ("bounds", changed(&[(COMPILER, bounds)])),
        (
            "balance",
            changed(&[
                (COMPILER, balance),
                ("fullinertia=\"0.02 ", "fullinertia=\"0.05 "),
                (" range=\"-30 120\"", ""),
                (" range=\"0 0.1\"", ""),
            ]),
        ),
        (
            "geoms",
            changed(&[(COMPILER, r#"<compiler inertiafromgeom="true"/>"#)]),
        ),
    ];
    for (name, text) in models {
        // The values are those of the tree, without constraints.
        let connect = r#"<connect body1="toe" body2="trunk" anchor="0 0 0"/>"#;
        assert!(text.contains(connect), "{name}");
        let mechanism = mechanism(&made(&text.replace(connect, "")).yaml);
        for state in golden["models"][name].as_array().expect("states") {
            let (q, v) = (numbers(&state["q"]), numbers(&state["v"]));
            let at = |method| value(&mechanism, method, [&q, &v, &[]]);
            let matrix = numbers(&state["mass_matrix"]);
            near(&mass_matrix(&mechanism, &q), &matrix, 1e-14);
            near(&at(Method::Bias), &numbers(&state["bias"]), 1e-14);
            for (site, wanted) in state["sites"].as_object().expect("sites") {
                near(&pose(&mechanism, site, &q), &numbers(wanted), 1e-14);
            }
        }
    }
}

/// A pendulum whose hinge is not at the body's origin, with its coordinate shifted by `ref`.
#[test]
fn a_pendulum_has_its_closed_form() {
    let text = mjcf(
        "<compiler angle='radian'/>
        <option gravity='0 0 -10'/>
        <worldbody><body pos='1 2 3'>
          <joint name='swing' pos='0.1 0 0.4' axis='0 1 0' ref='0.25' range='-1 2'/>
          <inertial pos='0.1 0 -0.2' mass='2' diaginertia='0.03 0.05 0.04'/>
        </body></worldbody>",
    );
    let import = made(&text);
    assert!(
        import.yaml.contains("limits: { lower: -1, upper: 2 }"),
        "{}",
        import.yaml
    );
    for (q, v, a) in [(0.25, 0.3, 0.0), (1.0, -2.0, 0.7), (-0.4, 0.0, 1.0)] {
        let length = 0.6;
        let angle: f64 = q - 0.25;
        let wanted = (0.05 + 2.0 * length * length) * a + 2.0 * 10.0 * length * angle.sin();
        near(&efforts(&import.yaml, [&[q], &[v], &[a]]), &[wanted], 1e-14);
    }
}

/// Mass and moments by slices of a solid along z: half width in x and y at a height.
fn slices(half: f64, round: bool, width: impl Fn(f64) -> [f64; 2]) -> [f64; 4] {
    let count = 4000;
    let step = 2.0 * half / f64::from(count);
    let mut sums = [0.0; 4];
    for i in 0..=count {
        let z = -half + f64::from(i) * step;
        // Simpson's rule.
        let weight = match i {
            0 => 1.0,
            i if i == count => 1.0,
            i if i % 2 == 1 => 4.0,
            _ => 2.0,
        } * step
            / 3.0;
        let [a, b] = width(z);
        let (area, part) = match round {
            true => (std::f64::consts::PI * a * b, 4.0),
            false => (4.0 * a * b, 3.0),
        };
        let (x, y) = (a * a / part, b * b / part);
        let own = [1.0, y + z * z, x + z * z, x + y];
        sums.iter_mut()
            .zip(own)
            .for_each(|(sum, own)| *sum += weight * area * own);
    }
    sums
}

/// Mass and moments of geoms are integrals over the solids.
#[test]
fn geoms_have_the_inertia_of_their_solids() {
    let (r, h) = (0.3_f64, 0.5_f64);
    let cap = |z: f64| (r * r - (z.abs() - h).max(0.0).powi(2)).max(0.0).sqrt();
    let ball = |z: f64| (1.0 - (z / h).powi(2)).max(0.0).sqrt();
    let cases = [
        (
            "sphere",
            "0.5",
            slices(0.5, true, |z| [(0.25 - z * z).max(0.0).sqrt(); 2]),
        ),
        ("capsule", "0.3 0.5", slices(h + r, true, |z| [cap(z); 2])),
        ("cylinder", "0.3 0.5", slices(h, true, |_| [r; 2])),
        (
            "ellipsoid",
            "0.3 0.2 0.5",
            slices(h, true, |z| [0.3 * ball(z), 0.2 * ball(z)]),
        ),
        ("box", "0.3 0.2 0.5", slices(h, false, |_| [0.3, 0.2])),
    ];
    for (kind, size, solid) in cases {
        for (given, density) in [
            ("", 1000.0),
            ("density='20'", 20.0),
            ("mass='3'", 3.0 / solid[0]),
        ] {
            let text = mjcf(&format!(
                "<worldbody><body><freejoint name='f'/><geom type='{kind}' size='{size}' {given}/></body></worldbody>"
            ));
            let neutral = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
            let matrix = mass_matrix(&mechanism(&made(&text).yaml), &neutral);
            let diagonal: Vec<f64> = (0..6).map(|i| matrix[7 * i]).collect();
            let [mass, x, y, z] = solid.map(|part| part * density);
            // Slices of rounded ends are integrated to about 1e-6 only.
            near(&diagonal, &[mass, mass, mass, x, y, z], 1e-5);
        }
    }
}

/// `pos` and `ref` of joints, and several joints in a body, are bodies without mass between.
#[test]
fn joints_off_the_origin_are_bodies_in_between() {
    let mut random = Random(31);
    for noise in [0.0, 1e-9, 1e-4, 1.0] {
        let mut vector = |size: f64| {
            let [a, b, c] = [(); 3].map(|()| size * random.signed());
            [a, b, c]
        };
        let text = |v: [f64; 3]| format!("{:e} {:e} {:e}", v[0], v[1], v[2]);
        let negative = |v: [f64; 3]| text(v.map(|x| -x));
        let axis = |at: usize, noise: [f64; 3]| {
            let mut axis = noise;
            axis[at] += 1.0;
            axis
        };
        let (b, e, p, s, c) = (
            vector(1.0),
            vector(noise),
            vector(1.0),
            vector(1.0),
            vector(0.3),
        );
        let (first, second) = (axis(0, vector(0.5 * noise)), axis(1, vector(0.5 * noise)));
        let inertial = format!(
            "<inertial pos='{}' mass='2' fullinertia='0.4 0.5 0.6 0.01 0.02 -0.03'/>",
            text(c)
        );
        let settings = "<compiler angle='radian'/>";
        let start = format!("<body pos='{}' euler='{}'>", text(b), text(e));
        let child = format!(
            "<body pos='0.3 0.1 0'><joint name='k' type='slide' axis='1 0 1'/>{}</body>",
            "<inertial pos='0 0 0.1' mass='1' diaginertia='0.1 0.2 0.15'/>"
        );
        let joints = format!(
            "<joint name='i' pos='{}' axis='{}' ref='0.3'/><joint name='j' pos='{}' axis='{}' ref='-0.2'/>",
            text(p),
            text(first),
            text(s),
            text(second)
        );
        let compact = mjcf(&format!(
            "{settings}<worldbody>{start}{joints}{inertial}{child}</body></worldbody>"
        ));
        let turn =
            |axis: [f64; 3], angle: f64| format!("<body axisangle='{} {angle}'>", text(axis));
        let at = |v: String| format!("<body pos='{v}'>");
        let spread = [
            start,
            at(text(p)),
            turn(first, -0.3),
            format!("<joint name='i' axis='{}'/>", text(first)),
            at(negative(p)),
            at(text(s)),
            turn(second, 0.2),
            format!("<joint name='j' axis='{}'/>", text(second)),
            at(negative(s)),
            inertial,
            child,
            "</body>".repeat(7),
        ];
        let spread = mjcf(&format!(
            "{settings}<worldbody>{}</worldbody>",
            spread.concat()
        ));
        let [compact, spread] = [made(&compact).yaml, made(&spread).yaml];
        for _ in 0..3 {
            let state = [(); 3].map(|()| many(&mut random, 3));
            let state = state.each_ref().map(Vec::as_slice);
            near(&efforts(&compact, state), &efforts(&spread, state), 1e-13);
        }
    }
}

/// An element's own attribute is stronger than its class, that than `childclass`, that than the outermost
/// class; of `size` the missing numbers are those of the class.
#[test]
fn default_classes_are_applied_in_their_order() {
    let text = mjcf(
        "<compiler angle='radian'/>
        <default>
          <joint damping='1' axis='1 0 0'/>
          <default class='near'><joint damping='2'/><geom type='box' size='0.1 0.2 0.3'/>
            <default class='nearer'><joint damping='3'/></default>
          </default>
        </default>
        <worldbody><body name='a' childclass='near'>
          <joint name='i'/><joint name='j' class='nearer'/><joint name='k' class='main'/><joint name='l' damping='4'/>
          <geom size='0.4' mass='3'/>
          <body name='b'><joint name='m'/><geom class='main' size='0.1'/></body>
        </body><body name='c'><joint name='n'/><geom size='0.1'/></body></worldbody>",
    );
    let yaml = made(&text).yaml;
    for (joint, damping) in [("i", 2), ("j", 3), ("k", 1), ("l", 4), ("m", 2), ("n", 1)] {
        let line =
            format!("{joint}_damping: {{ type: viscous, joint: {joint}, damping: {damping} }}");
        assert!(yaml.contains(&line), "{line}\n{yaml}");
    }
    assert_eq!(yaml.matches("axis: x").count(), 6, "{yaml}");
    // 3/3 (0.2² + 0.3²).
    assert!(yaml.contains("xx: 0.13,"), "{yaml}");
    assert_eq!(effects(&yaml), 6);
}

/// A linear equality is a follower; what acts at it acts at the leader.
#[test]
fn followers_of_equalities_are_the_independent_joints() {
    let body = |name: &str, joint: &str| {
        format!(
            "<body name='{name}' pos='0.1 0.2 0.3'>{joint}<inertial pos='0.1 0 0.2' mass='1.5' diaginertia='0.1 0.2 0.15'/></body>"
        )
    };
    let [slide, hinge] = [
        "<joint name='grip' type='slide' axis='0 1 0' ref='0.5'/>",
        "<joint name='pinch' axis='1 0 0' ref='-0.1' damping='2' frictionloss='3' stiffness='5' springref='0.2' armature='0.1'/>",
    ];
    let world = format!(
        "<worldbody>{}{}</worldbody>",
        body("a", slide),
        body("b", hinge)
    );
    let settings = "<compiler angle='radian'/>";
    let equality = "<equality><joint joint1='pinch' joint2='grip' polycoef='0.3 -4'/></equality>";
    let free = made(&mjcf(&format!("{settings}{world}"))).yaml;
    let bound = made(&mjcf(&format!("{settings}{world}{equality}")));
    // y + 0.1 = 0.3 - 4 (x - 0.5).
    let (ratio, offset) = (-4.0, 2.2);
    let mut random = Random(5);
    for _ in 0..4 {
        let [q, v, a] = [(); 3].map(|()| random.signed());
        let state = [
            vec![q, ratio * q + offset],
            vec![v, ratio * v],
            vec![a, ratio * a],
        ];
        let apart = efforts(&free, state.each_ref().map(Vec::as_slice));
        let wanted = apart[0] + ratio * apart[1];
        near(&efforts(&bound.yaml, [&[q], &[v], &[a]]), &[wanted], 1e-13);
    }
    for line in [
        "mimic: { joint: grip, ratio: -4, offset: 2.2 }",
        "pinch_damping: { type: viscous, joint: grip, damping: 32 }",
        "pinch_friction: { type: coulomb, joint: grip, kinetic: 12 }",
        "pinch_spring: { type: spring, joint: grip, stiffness: 80, rest: 0.5 }",
        "pinch_rotor: { type: rotor, joint: grip, inertia: 1.6 }",
    ] {
        assert!(bound.yaml.contains(line), "{line}\n{}", bound.yaml);
    }
    assert_eq!(effects(&bound.yaml), 4);
    for line in [
        "exact here, while MuJoCo holds them by a soft constraint: `pinch` follows `grip`",
        "what acts at followers acts at their leaders, with the ratio in it: `pinch`",
    ] {
        assert!(
            bound.warnings.iter().any(|it| it == line),
            "{:?}",
            bound.warnings
        );
    }
}
