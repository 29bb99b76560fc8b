//! Logs of known truth: an arm whose numbers differ from its spec, with friction, rotors, offsets, noise and encoders,
//! moved by `eval`, which knows nothing of regressors.

use std::f64::consts::TAU;
use std::fs;
use std::path::PathBuf;

use serde_json::{Value, json};

use crate::bgdyn;

/// The arm as its file has it; the truth replaces the numbers.
const ARM: &str = "# An arm with a payload.
format: 1
name: arm

links:
  - name: column
    joint: { name: turn, type: revolute, limits: { lower: -170 deg, upper: 170 deg, velocity: 3 } }
    mass: 6   # by its drawing
    com: [0.01, 0.02, 0.15]
    inertia: { xx: 0.06, yy: 0.06, zz: 0.03 }

  - name: upper
    parent: column
    joint: { name: lift, type: revolute, axis: y, origin: { xyz: [0.05, 0, 0.3] } }
    mass: 4
    com: [0.2, 0.01, 0.02]
    inertia:
      xx: 0.012
      yy: 0.07   # measured
      zz: 0.07

  - { name: fore, parent: upper, joint: { name: bend, type: revolute, axis: y, origin: { xyz: [0.4, 0, 0], rpy: [20 deg, 0, 0] } }, mass: 2.5, com: [0.15, 0, 0.01], inertia: { xx: 0.005, yy: 0.02, zz: 0.02, xy: 0, xz: 0, yz: 0 } }

  - name: payload
    parent: fore
    joint: { type: fixed, origin: { xyz: [0.3, 0, 0] } }
    mass: MASS
    com: [0, 0, 0.05]
    inertia: { solid: box, size: [0.1, 0.1, 0.12] }
";
const JOINTS: [&str; 3] = ["turn", "lift", "bend"];
/// Rotors, viscous and Coulomb friction, offsets.
const FRICTION: [[f64; 3]; 4] = [
    [0.1, 0.3, 0.08],
    [1.2, 2.0, 0.6],
    [0.9, 1.5, 0.4],
    [0.1, -0.2, 0.05],
];
const RATE: f64 = 250.0;

/// Uniform numbers, the same in every run.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    }

    /// About normal, with deviation 1: a sum of twelve.
    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.next()).sum()
    }
}

/// Returns q, v, a of a joint: a Fourier series of four harmonics of 0.1 Hz, another one for each seed.
fn motion(joint: usize, seed: u64, t: f64) -> [f64; 3] {
    let mut noise = Noise(seed * 977 + joint as u64 * 31 + 5);
    (1..=5).fold([0.0; 3], |[q, v, a], k| {
        let w = TAU * 0.1 * f64::from(k);
        let (size, phase) = (1.6 * noise.next() / f64::from(k).sqrt(), TAU * noise.next());
        let (sine, cosine) = (w * t + phase).sin_cos();
        [
            q + size * sine,
            v + size * w * cosine,
            a - size * w * w * sine,
        ]
    })
}

/// Returns the header and rows of a log: time, positions, efforts.
pub(crate) fn simulated(truth: &str, seed: u64, seconds: f64) -> Vec<Vec<f64>> {
    let name = format!("identify_{seed}_{}", truth.len());
    let mut noise = Noise(seed + 99);
    logged(
        truth,
        &name,
        seconds,
        &|j, t| motion(j, seed, t),
        &mut noise,
    )
}

/// Returns the rows of a log of another motion: position, velocity, acceleration of a joint at a time.
pub(crate) fn log_of_states(
    truth: &str,
    name: &str,
    seconds: f64,
    motion: &dyn Fn(usize, f64) -> [f64; 3],
) -> Vec<Vec<f64>> {
    logged(truth, name, seconds, motion, &mut Noise(7))
}

fn logged(
    truth: &str,
    name: &str,
    seconds: f64,
    motion: &dyn Fn(usize, f64) -> [f64; 3],
    noise: &mut Noise,
) -> Vec<Vec<f64>> {
    let folder = temporary(&format!("{name}_truth"));
    let spec = folder.join("arm.yaml");
    fs::write(&spec, truth).expect("a spec");
    let times: Vec<f64> = (0..(seconds * RATE) as usize)
        .map(|i| i as f64 / RATE)
        .collect();
    let states = times.iter().map(|&t| {
        let of = |part: usize| (0..3).map(|j| motion(j, t)[part]).collect::<Vec<f64>>();
        json!({ "q": of(0), "v": of(1), "a": of(2) })
    });
    let states = json!({ "states": states.collect::<Vec<_>>() });
    let path = folder.join("states.json");
    fs::write(&path, states.to_string()).expect("states");
    let run = bgdyn(&[
        "eval",
        &text(&spec),
        "inverse_dynamics",
        "--states",
        &text(&path),
    ]);
    let efforts: Value = serde_json::from_str(&run.good()).expect("JSON");
    let step = TAU / 131_072.0;
    let row = |(i, t): (usize, &f64)| {
        let mut row = vec![*t];
        row.extend((0..3).map(|j| (motion(j, *t)[0] / step).round() * step));
        row.extend((0..3).map(|j| {
            let [_, v, a] = motion(j, *t);
            let [rotor, viscous, coulomb, offset] = FRICTION.map(|f| f[j]);
            let clean = efforts["results"][i][j].as_f64().expect("a number");
            clean + rotor * a + viscous * v + coulomb * v.signum() + offset + 0.1 * noise.normal()
        }));
        row
    };
    times.iter().enumerate().map(row).collect()
}

/// Returns an empty folder with the name of a test.
fn temporary(name: &str) -> PathBuf {
    let folder: PathBuf = [env!("CARGO_TARGET_TMPDIR"), name].iter().collect();
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// Returns a path as a text.
pub(crate) fn text(path: &std::path::Path) -> String {
    path.to_str().expect("a path").to_owned()
}

/// Returns the header of a log.
pub(crate) fn header() -> String {
    let names = |of: &str| JOINTS.map(|j| format!("{of}_{j}")).join(",");
    format!("time,{},{}", names("q"), names("tau"))
}

/// Returns a log as a table.
pub(crate) fn csv(rows: &[Vec<f64>]) -> String {
    let line = |row: &Vec<f64>| {
        row.iter()
            .map(|x| format!("{x:.6}"))
            .collect::<Vec<_>>()
            .join(",")
    };
    header() + "\n" + &rows.iter().map(line).collect::<Vec<_>>().join("\n") + "\n"
}

/// Returns the arm with a payload of this mass, kg.
pub(crate) fn arm(mass: f64) -> String {
    ARM.replace("MASS", &mass.to_string())
}

/// The truth: masses, centres and tensors of all links differ.
pub(crate) fn truth() -> String {
    let changes = [
        ("mass: 6 ", "mass: 5.2 "),
        ("[0.2, 0.01, 0.02]", "[0.22, -0.01, 0.03]"),
        ("mass: 4\n", "mass: 4.4\n"),
        ("yy: 0.07 ", "yy: 0.08 "),
        ("mass: 2.5", "mass: 2.8"),
        ("[0.15, 0, 0.01]", "[0.14, 0.01, 0.02]"),
        ("zz: 0.03 ", "zz: 0.036 "),
    ];
    changes.iter().fold(arm(1.0), |spec, (from, to)| {
        assert!(spec.contains(from), "{from}");
        spec.replace(from, to)
    })
}

/// Writes spec and logs into a folder.
pub(crate) fn files(name: &str, spec: &str, logs: &[(&str, String)]) -> PathBuf {
    let folder = temporary(name);
    fs::write(folder.join("arm.yaml"), spec).expect("a spec");
    for (name, log) in logs {
        fs::write(folder.join(name), log).expect("a log");
    }
    folder
}

/// The numbers of the truth in the order of the JSON's columns.
pub(crate) fn true_numbers(names: &Value) -> Vec<f64> {
    let box_tensor = |mass: f64, a: f64, b: f64| mass * (a * a + b * b) / 12.0;
    // m, c, xx, yy, zz about the centre.
    let links: [(&str, f64, [f64; 3], [f64; 3]); 4] = [
        ("column", 5.2, [0.01, 0.02, 0.15], [0.06, 0.06, 0.036]),
        ("upper", 4.4, [0.22, -0.01, 0.03], [0.012, 0.08, 0.07]),
        ("fore", 2.8, [0.14, 0.01, 0.02], [0.005, 0.02, 0.02]),
        (
            "payload",
            1.0,
            [0.0, 0.0, 0.05],
            [
                box_tensor(1.0, 0.1, 0.12),
                box_tensor(1.0, 0.1, 0.12),
                box_tensor(1.0, 0.1, 0.1),
            ],
        ),
    ];
    let number = |name: &str| -> f64 {
        let (owner, part) = name.split_once('.').expect("OWNER.PART");
        if let Some(j) = JOINTS.iter().position(|j| *j == owner) {
            let kinds = ["rotor", "viscous", "coulomb", "offset"];
            return FRICTION[kinds.iter().position(|k| *k == part).expect("a kind")][j];
        }
        let (_, m, c, i) = links.iter().find(|l| l.0 == owner).expect("a link");
        let square: f64 = c.iter().map(|x| x * x).sum();
        let entry = |k: usize, l: usize| {
            let own = if k == l { i[k] + m * square } else { 0.0 };
            own - m * c[k] * c[l]
        };
        match part {
            "m" => *m,
            "mx" => m * c[0],
            "my" => m * c[1],
            "mz" => m * c[2],
            "Ixx" => entry(0, 0),
            "Ixy" => entry(0, 1),
            "Iyy" => entry(1, 1),
            "Ixz" => entry(0, 2),
            "Iyz" => entry(1, 2),
            _ => entry(2, 2),
        }
    };
    names
        .as_array()
        .expect("names")
        .iter()
        .map(|n| number(n.as_str().expect("a name")))
        .collect()
}
