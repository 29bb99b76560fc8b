//! `bgdyn identify` on logs of known truth: an arm whose numbers differ from its spec, with friction, rotors, offsets,
//! noise and encoders, moved by `eval`, which knows nothing of regressors.

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
fn simulated(truth: &str, seed: u64, seconds: f64) -> Vec<Vec<f64>> {
    let folder = temporary(&format!("identify_truth_{seed}_{}", truth.len()));
    let spec = folder.join("arm.yaml");
    fs::write(&spec, truth).expect("a spec");
    let times: Vec<f64> = (0..(seconds * RATE) as usize)
        .map(|i| i as f64 / RATE)
        .collect();
    let states = times.iter().map(|&t| {
        let of = |part: usize| {
            (0..3)
                .map(|j| motion(j, seed, t)[part])
                .collect::<Vec<f64>>()
        };
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
    let mut noise = Noise(seed + 99);
    let step = TAU / 131_072.0;
    let row = |(i, t): (usize, &f64)| {
        let mut row = vec![*t];
        row.extend((0..3).map(|j| (motion(j, seed, *t)[0] / step).round() * step));
        row.extend((0..3).map(|j| {
            let [_, v, a] = motion(j, seed, *t);
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

fn text(path: &std::path::Path) -> String {
    path.to_str().expect("a path").to_owned()
}

fn header() -> String {
    let names = |of: &str| JOINTS.map(|j| format!("{of}_{j}")).join(",");
    format!("time,{},{}", names("q"), names("tau"))
}

fn csv(rows: &[Vec<f64>]) -> String {
    let line = |row: &Vec<f64>| {
        row.iter()
            .map(|x| format!("{x:.6}"))
            .collect::<Vec<_>>()
            .join(",")
    };
    header() + "\n" + &rows.iter().map(line).collect::<Vec<_>>().join("\n") + "\n"
}

fn arm(mass: f64) -> String {
    ARM.replace("MASS", &mass.to_string())
}

/// The truth: masses, centres and tensors of all links differ.
fn truth() -> String {
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
fn files(name: &str, spec: &str, logs: &[(&str, String)]) -> PathBuf {
    let folder = temporary(name);
    fs::write(folder.join("arm.yaml"), spec).expect("a spec");
    for (name, log) in logs {
        fs::write(folder.join(name), log).expect("a log");
    }
    folder
}

/// The numbers of the truth in the order of the JSON's columns.
fn true_numbers(names: &Value) -> Vec<f64> {
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

#[test]
fn a_log_gives_back_its_truth() {
    let (train, test) = (
        csv(&simulated(&truth(), 1, 20.0)),
        csv(&simulated(&truth(), 2, 10.0)),
    );
    let folder = files(
        "identify",
        &arm(1.0),
        &[("train.csv", train), ("test.csv", test)],
    );
    let path = |name: &str| text(&folder.join(name));
    let run = bgdyn(&[
        "identify",
        &path("arm.yaml"),
        &path("train.csv"),
        "--test",
        &path("test.csv"),
        "--rotors",
        "--json",
        "-o",
        &path("found.yaml"),
        "--report",
        &path("report"),
    ]);
    let found: Value = serde_json::from_str(&run.good()).expect("JSON");
    // Efforts of the other motion: the file is wrong, what is found leaves the noise.
    for joint in found["joints"].as_array().expect("joints") {
        let rms = |of: &str| joint["rms"][of].as_f64().expect("a number");
        assert!(rms("file") > 0.5 && rms("bodies") < 0.1, "{joint}");
        assert!(
            joint["by_velocity"].as_f64().expect("a share") < 0.1,
            "{joint}"
        );
    }
    // Base parameters: K of the truth within the deviations.
    let numbers = true_numbers(&found["base_map"]["columns"]);
    let off = found["base"]
        .as_array()
        .expect("base")
        .iter()
        .zip(found["base_map"]["rows"].as_array().expect("rows"));
    let off: Vec<f64> = off
        .map(|(base, row)| {
            let row = row
                .as_array()
                .expect("a row")
                .iter()
                .map(|x| x.as_f64().expect("a number"));
            let truth: f64 = row.zip(&numbers).map(|(k, x)| k * x).sum();
            let get = |key: &str| base[key].as_f64().expect("a number");
            (get("value") - truth).abs() / get("deviation")
        })
        .collect();
    let within = |bound: f64| off.iter().filter(|x| **x < bound).count() as f64 / off.len() as f64;
    assert!(within(2.0) >= 0.85 && within(3.0) >= 0.94, "{off:?}");
    for link in found["links"].as_array().expect("links") {
        assert!(link["smallest_eigenvalue"].as_f64().expect("a number") > 0.0);
    }
    // The spec: valid, all else untouched, friction and rotors as effects.
    bgdyn(&["check", &path("found.yaml")]).good();
    let written = fs::read_to_string(folder.join("found.yaml")).expect("the spec");
    for line in [
        "# An arm with a payload.",
        "name: found",
        "# by its drawing; ± ",
        "was 4",
        "lift_rotor: { type: rotor, joint: lift, inertia: 0.",
        "bend_coulomb: { type: coulomb, joint: bend, kinetic: 0.",
    ] {
        assert!(written.contains(line), "{line}:\n{written}");
    }
    let page = fs::read_to_string(folder.join("report/arm.html")).expect("the page");
    assert!(page.contains("\"unseen\"") && !page.contains("http://") | page.contains("www.w3.org"));
}

#[test]
fn a_payload_is_found_alone() {
    let log = csv(&simulated(&arm(1.2), 3, 15.0));
    let folder = files("identify_payload", &arm(1.0), &[("log.csv", log)]);
    let path = |name: &str| text(&folder.join(name));
    let run = bgdyn(&[
        "identify",
        &path("arm.yaml"),
        &path("log.csv"),
        "--only",
        "payload",
        "--rotors",
        "--prior",
        "0.01",
        "--json",
        "-o",
        &path("found.yaml"),
    ]);
    let found: Value = serde_json::from_str(&run.good()).expect("JSON");
    let payload = &found["links"][3];
    let mass = payload["parameters"][0]["value"].as_f64().expect("a mass");
    assert!((mass / 1.2 - 1.0).abs() < 0.02, "{mass}");
    let written = fs::read_to_string(folder.join("found.yaml")).expect("the spec");
    assert!(
        written.contains("mass: 6   # by its drawing\n"),
        "other links are untouched:\n{written}"
    );
    assert_eq!(found["judged_on"], "last third");
}

/// Runs with a changed log; returns stderr after checking that nothing was written.
fn refused(name: &str, log: &str, more: &[&str]) -> String {
    let folder = files(name, &arm(1.0), &[("log.csv", log.to_owned())]);
    let path = |name: &str| text(&folder.join(name));
    let (spec, log, found) = (path("arm.yaml"), path("log.csv"), path("found.yaml"));
    let run = bgdyn(&[&["identify", &spec, &log, "-o", &found], more].concat());
    assert_eq!(run.code, Some(1), "{}{}", run.stdout, run.stderr);
    assert!(!folder.join("found.yaml").exists() && run.stdout.is_empty());
    run.stderr
}

#[test]
fn each_fault_is_refused_at_its_place() {
    let rows = simulated(&truth(), 4, 6.0);
    let change = |of: &dyn Fn(&mut Vec<Vec<f64>>)| {
        let mut rows = rows.clone();
        of(&mut rows);
        csv(&rows)
    };
    let lines = |of: &dyn Fn(&mut Vec<String>)| {
        let mut lines: Vec<String> = csv(&rows).lines().map(String::from).collect();
        of(&mut lines);
        lines.join("\n") + "\n"
    };
    let cases: Vec<(&str, String, &[&str])> = vec![
        (
            "identify_gap",
            change(&|r| drop(r.drain(300..400))),
            &["302:1:", "[gap]", "cut the log there"],
        ),
        (
            "identify_back",
            change(&|r| r[50][0] = 0.1),
            &["52:1:", "[time-order]"],
        ),
        (
            "identify_nan",
            lines(&|l| {
                l[7] = l[7].replacen(',', ",nan,", 1);
                l[8] = l[8].split(',').map(|_| "x").collect::<Vec<_>>().join(",")
            }),
            &[
                "8:8:",
                "8 values instead of 7",
                "[wrong-count]",
                "9:1:",
                "[not-finite]",
            ],
        ),
        (
            "identify_missing",
            lines(&|l| {
                l[0] = l[0]
                    .replace("tau_bend", "tau_hand")
                    .replace("q_turn", "turn")
            }),
            &[
                "[missing-column]",
                "position of joint `turn`",
                "effort of joint `bend`",
                "tau_hand",
            ],
        ),
        (
            "identify_unit",
            lines(&|l| l.insert(1, "s,deg,mm,rad,N*m,N,N*m".into())),
            &["2:3:", "2:6:", "[wrong-unit]"],
        ),
        (
            "identify_degrees",
            change(&|r| r.iter_mut().for_each(|r| r[1] *= 57.3)),
            &["[wrong-unit]", "joint `turn` goes from", "deg"],
        ),
        (
            "identify_ms",
            change(&|r| r.iter_mut().for_each(|r| r[0] *= 1e3)),
            &["[wrong-unit]", "rows per second", "ms"],
        ),
        (
            "identify_constant",
            change(&|r| {
                r.iter_mut().for_each(|r| {
                    r[2] = 0.5;
                    r[6] = 1.0
                })
            }),
            &[
                "[constant-channel]",
                "joint `lift` stands at 0.5",
                "effort of joint `bend` is 1",
            ],
        ),
        (
            "identify_sign",
            change(&|r| r.iter_mut().for_each(|r| (4..7).for_each(|j| r[j] = -r[j]))),
            &["[wrong-sign]", "efforts are those of the negative model"],
        ),
        (
            "identify_rest",
            change(&|r| {
                r.iter_mut()
                    .enumerate()
                    .for_each(|(i, r)| (1..4).for_each(|j| r[j] = 0.3 + 1e-6 * (i % 2) as f64))
            }),
            &["[nothing-excited]", "no joint moves"],
        ),
        (
            "identify_short",
            change(&|r| r.truncate(60)),
            &["[too-short]"],
        ),
        ("identify_empty", String::new(), &["[empty-log]"]),
    ];
    for (name, log, wanted) in cases {
        let told = refused(name, &log, &[]);
        for text in wanted {
            assert!(
                told.contains(text),
                "{name}: `{text}` is missing in\n{told}"
            );
        }
        assert!(
            told.contains("help: ") && told.contains("nothing was written"),
            "{told}"
        );
    }
    let told = refused("identify_only", &csv(&rows), &["--only", "hand"]);
    assert!(told.contains("column, upper, fore, payload"), "{told}");
}

#[test]
fn names_and_units_of_other_loggers_are_read() {
    let rows = simulated(&truth(), 5, 8.0);
    let plain = files("identify_names", &arm(1.0), &[("log.csv", csv(&rows))]);
    let degrees: Vec<Vec<f64>> = rows
        .iter()
        .map(|r| {
            r.iter()
                .enumerate()
                .map(|(c, x)| match c {
                    0 => x * 1e3,
                    1..=3 => x.to_degrees(),
                    _ => *x,
                })
                .collect()
        })
        .collect();
    let mut other = csv(&degrees).replace(
        &header(),
        "stamp,joint_turn_pos,joint_lift_pos,joint_bend_pos,i_1,i_2,i_3\nms,deg,deg,deg,A,A,A",
    );
    other.insert_str(0, "# recorded by another tool\n");
    fs::write(plain.join("other.csv"), other).expect("a log");
    fs::write(
        plain.join("gains.csv"),
        "joint,gain\nturn,1\nlift,1\nbend,1\n",
    )
    .expect("gains");
    let path = |name: &str| text(&plain.join(name));
    let first = bgdyn(&[
        "identify",
        &path("arm.yaml"),
        &path("log.csv"),
        "--cut",
        "8 Hz",
        "--json",
    ])
    .good();
    let second = bgdyn(&[
        "identify",
        &path("arm.yaml"),
        &path("other.csv"),
        "--cut",
        "8 Hz",
        "--json",
        "--gains",
        &path("gains.csv"),
        "--columns",
        "time=stamp,q=joint_{}_pos,tau=i_{}",
    ])
    .good();
    let mass = |text: &str| {
        serde_json::from_str::<Value>(text).expect("JSON")["links"][1]["parameters"][1]["value"]
            .as_f64()
            .expect("a number")
    };
    assert!((mass(&first) - mass(&second)).abs() < 1e-3 * mass(&first).abs());
}
