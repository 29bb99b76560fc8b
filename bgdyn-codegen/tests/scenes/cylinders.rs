//! Tests cylinders: the reference solution of a stiff one, the geometry of those between lugs.

use bgdyn_codegen::random::Random;
use std::path::Path;

use bgdyn_codegen::method::SceneFunction;
use bgdyn_runtime::Dd;
use serde_json::Value;

use super::bench::{Bench, agree, dd};
use super::common::{read, scene, specs};

const EXACT: f64 = 1e-24;

/// The repository's scene of this name.
fn spec(name: &str) -> Bench {
    let path = specs()
        .into_iter()
        .find(|p| p.ends_with(format!("{name}.scene.yaml")));
    Bench::new(read(&path.expect("the scene")))
}

/// Rows t, x, v, p1, p2, pl of the reference solution (`tests/hard_cases`: equations in pressures,
/// solved in quadruple precision by two methods).
fn samples() -> Vec<[f64; 6]> {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/hard_cases/hydraulic_cylinder.json");
    let text = std::fs::read_to_string(path).expect("the reference");
    let file: Value = serde_json::from_str(&text).expect("JSON");
    serde_json::from_value(file["samples"].clone()).expect("rows of six numbers")
}

/// The right-hand side at every sample of the reference solution.
#[test]
fn a_stiff_cylinder_has_the_rates_of_its_reference() {
    let mut bench = spec("hydraulic_cylinder");
    bench.give("slide", -1000.0);
    let (bulk, area, rest, line) = (dd("1e9"), dd("1e-3"), dd("5e-4"), dd("1e-6"));
    let [k, k_throat] = [dd("1e-7"), dd("3e-7")];
    let samples = samples();
    for row in &samples {
        let [_, x, v, p1, p2, pl] = row.map(Dd::from_f64);
        let volumes = [rest + area * x, rest - area * x, line];
        bench.at.q[0] = x;
        bench.at.v[0] = v;
        for ((name, volume), p) in ["ram_a", "ram_b", "hose"]
            .iter()
            .zip(volumes)
            .zip([p1, p2, pl])
        {
            let i = bench.state(name);
            bench.at.x[i] = volume * (p / bulk).exp();
        }
        // The reference's own equations.
        let q0 = k * (dd("2e7") - pl).sqrt();
        let q1 = k_throat * (pl - p1).sqrt();
        let q2 = k * p2.sqrt();
        let expected = [
            bulk / volumes[0] * (q1 - area * v),
            bulk / volumes[1] * (area * v - q2),
            bulk / line * (q0 - q1),
        ];
        let acceleration = ((p1 - p2) * area - dd("200") * v - dd("1000")) / dd("100");
        agree("v̇", bench.acceleration("slide"), acceleration, 10.0, EXACT);
        // ṗ = β (Ẇ/W − V̇/V)
        let stretch = [area * v, -(area * v), Dd::ZERO];
        for (i, name) in ["ram_a", "ram_b", "hose"].into_iter().enumerate() {
            let reference = bench.at.x[bench.state(name)];
            let rate = bench.rate(name) / reference - stretch[i] / volumes[i];
            agree(name, bulk * rate, expected[i], 1e8, EXACT);
        }
    }
    assert!(samples.len() > 20);
}

/// Classical Runge–Kutta steps of 5 µs end where the reference solution ends.
#[test]
fn a_stiff_cylinder_follows_its_reference() {
    let system = spec("hydraulic_cylinder").system;
    let function = system.function(SceneFunction::Derivative);
    let start = bgdyn_codegen::expr::Inputs {
        u: vec![-1000.0],
        t: Some(0.0),
        parameters: vec![],
        ..Default::default()
    };
    let rates = |y: &[f64]| {
        let mut at = start.clone();
        (at.q, at.v, at.x) = (y[..1].to_vec(), y[1..2].to_vec(), y[2..].to_vec());
        let (rates, refused): (Vec<f64>, _) = function.evaluate(at);
        assert!(refused.is_none());
        [&[y[1]], &rates[..]].concat()
    };
    let initial = &system.initial;
    let all = initial.q.iter().chain(&initial.v).chain(&initial.x);
    let mut y: Vec<f64> = all.map(|x| x.to_f64()).collect();
    let h = 5e-6;
    for _ in 0..4000 {
        let step =
            |k: &[f64], h: f64| -> Vec<f64> { y.iter().zip(k).map(|(y, k)| y + h * k).collect() };
        let k1 = rates(&y);
        let k2 = rates(&step(&k1, h / 2.0));
        let k3 = rates(&step(&k2, h / 2.0));
        let k4 = rates(&step(&k3, h));
        for i in 0..y.len() {
            y[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
        }
    }
    // t = 0.02 s
    let names: Vec<&str> = system
        .scene
        .layout
        .states
        .iter()
        .map(|s| s.name.as_str())
        .collect();
    assert_eq!(names, ["hose", "ram_a", "ram_b"]);
    let p = |w: f64, v: f64| 1e9 * (w / v).ln();
    let got = [
        y[0],
        y[1],
        p(y[3], 5e-4 + 1e-3 * y[0]),
        p(y[4], 5e-4 - 1e-3 * y[0]),
        p(y[2], 1e-6),
    ];
    let found = samples().into_iter().find(|row| row[0] == 0.02);
    let [_, wanted @ ..] = found.expect("a sample at 0.02 s");
    for (got, wanted) in got.iter().zip(wanted) {
        assert!((got / wanted - 1.0).abs() < 1e-6, "{got}, not {wanted}");
    }
}

/// Lengths of the crane's cylinders by the law of cosines, and their rates.
#[test]
fn cylinders_between_lugs_have_their_length_and_rate() {
    let mut bench = spec("crane");
    // From a joint's pivot: distances of the two lugs, and the angle between them at zero.
    let pivot = |foot: [&str; 2], head: [&str; 2]| {
        let ([fx, fz], [hx, hz]) = (foot.map(dd), head.map(dd));
        (
            fx * fx + fz * fz,
            hx * hx + hz * hz,
            hx * fx + hz * fz,
            hz * fx - hx * fz,
        )
    };
    let luff = pivot(["0.25", "-1"], ["1", "-0.15"]);
    let fold = pivot(["-1.1", "0.35"], ["0.15", "0.33"]);
    let mut random = Random(3);
    let start = bench.at.clone();
    let mut free = Bench::new(without_cylinders());
    for _ in 0..10 {
        for j in 0..4 {
            bench.at.q[j] = start.q[j] + Dd::from_f64(0.3 * random.signed());
            bench.at.v[j] = Dd::from_f64(random.signed());
            bench.at.a[j] = Dd::from_f64(random.signed());
        }
        (free.at.q, free.at.v, free.at.a) =
            (bench.at.q.clone(), bench.at.v.clone(), bench.at.a.clone());
        let [with, without] = [
            bench.value(SceneFunction::Inverse),
            free.value(SceneFunction::Inverse),
        ];
        let mut powers = Dd::ZERO;
        let arms = [("luff", luff), ("fold", fold)].map(|(joint, geometry)| {
            let j = bench.coordinate(joint);
            let (sin, cos) = bench.at.q[j].sin_cos();
            // l² = a² + b² − 2 (a·b cos q − …): the head turns by q about the pivot, −y.
            let (a, b, dot, cross) = geometry;
            let along = dot * cos - cross * sin;
            let length = (a + b - dd("2") * along).sqrt();
            let slope = (dot * sin + cross * cos) / length;
            (j, joint, length, slope)
        });
        for (j, joint, length, slope) in arms {
            agree(
                joint,
                bench.output(&format!("{joint}_ram_length")),
                length,
                1.0,
                EXACT,
            );
            let force = bench.output(&format!("{joint}_ram_force"));
            // The effort of the cylinder reduces that of the joint: f ∂l/∂q.
            agree(joint, without[j] - with[j], force * slope, 1e4, 1e-22);
            powers += force * slope * bench.at.v[j];
        }
        let j = bench.coordinate("reach");
        let length = bench.at.q[j] + dd("1.7");
        agree(
            "reach",
            bench.output("reach_ram_length"),
            length,
            1.0,
            EXACT,
        );
        let force = bench.output("reach_ram_force");
        agree("reach", without[j] - with[j], force, 1e4, 1e-22);
        agree("slew", without[0] - with[0], Dd::ZERO, 1e4, 1e-22);
        powers += force * bench.at.v[j];
        // The cylinders deliver energy that they had stored; none is created. The valves are closed.
        let rams = ["luff", "fold", "reach"].map(|n| format!("{n}_ram"));
        let stored = rams.map(|n| bench.power(&n)[1]);
        let fed = ["luff", "fold", "reach"].map(|n| bench.power(&format!("{n}_leak"))[2]);
        let sum = |x: [Dd; 3]| x[0] + x[1] + x[2];
        agree("power", -sum(stored), powers + sum(fed), 1e4, 1e-22);
    }
}

/// The crane without its cylinders.
fn without_cylinders() -> bgdyn_codegen::system::SceneEquations {
    let mechanism =
        std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs/crane.yaml"));
    let text = "scene: 1\nmechanism: crane.yaml\neffects: [gravity, inertia, velocity_products, slew_friction, load]\n";
    scene(text, &mechanism.expect("the crane"))
}

/// A cylinder between the world and a link that turns about two axes: the line's length and slopes
/// against rotation matrices and difference quotients in double-double.
#[test]
fn a_cylinder_may_hang_in_space() {
    let mechanism = "
format: 1
gravity: [0, 0, 0]
links:
  - { name: base, joint: { name: pan, type: revolute, axis: z, origin: { xyz: [0.1, 0.2, 0.5] } } }
  - { name: arm, parent: base, mass: 3, com: [0.2, 0.1, 0], inertia: { xx: 1, yy: 1.5, zz: 2 }, joint: { name: tilt, type: revolute, axis: y, origin: { xyz: [0.3, 0, 0.1] } } }
frames:
  - { name: anchor, link: world, origin: { xyz: [1.1, -0.4, 0.2] } }
  - { name: lug, link: arm, origin: { xyz: [0.6, 0.15, -0.05] } }
";
    let text = "
scene: 1
mechanism: m.yaml
effects:
  - inertia
  - velocity_products
  - oil: { type: fluid, bulk_modulus: 1 GPa }
  - ram: { type: cylinder, between: [anchor, lug], area_a: 5 cm^2, area_b: 3 cm^2, dead_a: 10 cm^3, dead_b: 10 cm^3, offset: 0.05 m, stroke: 3 m }
initial: { ram_a: 2 MPa }
outputs: [ram_length, ram_force]
";
    let mut bench = Bench::new(scene(text, mechanism));
    let rest = text.lines().filter(|l| !l.contains("ram"));
    let bare = rest.collect::<Vec<_>>().join("\n");
    let mut free = Bench::new(scene(&bare, mechanism));
    let length = |q: &[Dd]| {
        let ((s1, c1), (s2, c2)) = (q[0].sin_cos(), q[1].sin_cos());
        let [x, y, z] = ["0.6", "0.15", "-0.05"].map(dd);
        // Ry(q₂), then the offset, then Rz(q₁), then the base.
        let (x, z) = (c2 * x + s2 * z + dd("0.3"), c2 * z - s2 * x + dd("0.1"));
        let (x, y) = (c1 * x - s1 * y, s1 * x + c1 * y);
        let apart = [
            x + dd("0.1") - dd("1.1"),
            y + dd("0.2") + dd("0.4"),
            z + dd("0.5") - dd("0.2"),
        ];
        apart.iter().fold(Dd::ZERO, |sum, &d| sum + d * d).sqrt()
    };
    let mut random = Random(11);
    for _ in 0..10 {
        for j in 0..2 {
            bench.at.q[j] = Dd::from_f64(random.signed());
            bench.at.v[j] = Dd::from_f64(random.signed());
        }
        (free.at.q, free.at.v) = (bench.at.q.clone(), bench.at.v.clone());
        agree(
            "l",
            bench.output("ram_length"),
            length(&bench.at.q),
            0.1,
            EXACT,
        );
        let force = bench.output("ram_force");
        let [with, without] = [
            bench.value(SceneFunction::Inverse),
            free.value(SceneFunction::Inverse),
        ];
        let mut rate = Dd::ZERO;
        for j in 0..2 {
            let h = dd("1e-9");
            let (mut up, mut down) = (bench.at.q.clone(), bench.at.q.clone());
            (up[j], down[j]) = (up[j] + h, down[j] - h);
            let slope = (length(&up) - length(&down)) / (h + h);
            agree("∂l/∂q", without[j] - with[j], force * slope, 1e4, 1e-16);
            rate += slope * bench.at.v[j];
        }
        // A closed cylinder gives what it stores.
        agree("f l̇", -bench.power("ram")[1], force * rate, 1e4, 1e-16);
    }
}
