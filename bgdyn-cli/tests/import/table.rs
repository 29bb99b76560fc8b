//! Tables of Denavit–Hartenberg parameters, against products of their matrices and published arms.

use super::{many, mechanism, near, pose, value};
use bgdyn_cli::import::{Convention, Options, import_table};
use bgdyn_codegen::method::Method;
use bgdyn_codegen::random::Random;
use nalgebra::Matrix4;
use serde_json::Value;

fn made(text: &str, convention: Option<Convention>) -> String {
    import_table(text, "arm", convention, &Options::default())
        .expect("an import")
        .yaml
}

fn about(axis: usize, angle: f64) -> Matrix4<f64> {
    let (s, c) = angle.sin_cos();
    let mut m = Matrix4::identity();
    let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
    (m[(i, i)], m[(i, j)], m[(j, i)], m[(j, j)]) = (c, -s, s, c);
    m
}

fn along(axis: usize, by: f64) -> Matrix4<f64> {
    let mut m = Matrix4::identity();
    m[(axis, 3)] = by;
    m
}

/// The product of the rows' matrices as textbooks write them.
fn product(rows: &[(bool, bool, [f64; 4])], q: &[f64]) -> Matrix4<f64> {
    let mut all = Matrix4::identity();
    for ((standard, prismatic, [a, alpha, d, theta]), q) in rows.iter().zip(q) {
        let (d, theta) = if *prismatic {
            (d + q, *theta)
        } else {
            (*d, theta + q)
        };
        all *= match standard {
            true => about(2, theta) * along(2, d) * along(0, *a) * about(0, *alpha),
            false => about(0, *alpha) * along(0, *a) * about(2, theta) * along(2, d),
        };
    }
    all
}

/// Random tables of both conventions, also mixed, with quarter turns among the angles.
#[test]
fn the_tip_is_where_the_matrices_say() {
    let mut numbers = Random(11);
    for case in 0..60 {
        let mut text = String::from("theta, d, a, alpha, type, convention\n");
        let mut rows = Vec::new();
        for _ in 0..(1 + case % 7) {
            let quarter = |x: f64| {
                if x < 0.0 {
                    (4.0 * x).round() * std::f64::consts::FRAC_PI_2
                } else {
                    3.0 * x
                }
            };
            let [a, d] = [numbers.signed(), numbers.signed()];
            let [alpha, theta] = [quarter(numbers.signed()), quarter(numbers.signed())];
            let prismatic = numbers.signed() > 0.5;
            let standard = match case % 3 {
                0 => true,
                1 => false,
                _ => numbers.signed() > 0.0,
            };
            let (kind, way) = (
                ["revolute", "prismatic"][usize::from(prismatic)],
                ["modified", "standard"][usize::from(standard)],
            );
            text += &format!("{theta:?}, {d:?}, {a:?}, {alpha:?}, {kind}, {way}\n");
            rows.push((standard, prismatic, [a, alpha, d, theta]));
        }
        let arm = mechanism(&made(&text, None));
        let q = many(&mut numbers, rows.len());
        let wanted = product(&rows, &q);
        let place = match rows.last().is_some_and(|(standard, ..)| *standard) {
            true => "flange".to_owned(),
            false => format!("link_{}", rows.len()),
        };
        let found = pose(&arm, &place, &q);
        let rotation: Vec<f64> = (0..9).map(|k| wanted[(k / 3, k % 3)]).collect();
        let transposed: Vec<f64> = (0..9).map(|k| wanted[(k % 3, k / 3)]).collect();
        let origin: Vec<f64> = (0..3).map(|k| wanted[(k, 3)]).collect();
        let by_rows = found[..9]
            .iter()
            .zip(&rotation)
            .all(|(x, y)| (x - y).abs() < 1e-13);
        near(
            &found[..9],
            if by_rows { &rotation } else { &transposed },
            1e-13,
        );
        near(&found[9..], &origin, 1e-13);
    }
}

/// Corke's table of the PUMA 560: kinematics, masses, centres, tensors in the axes of the table's frames.
const PUMA: &str = "\
# standard convention
joint, link,     a, alpha,       d, theta,    mass,      cx,      cy,     cz,    ixx,    iyy,    izz
j1,    l_j1,     0,  90 deg,     0,     0,       0,       0,       0,      0,      0,   0.35,      0
j2,    l_j2, 431.8 mm,    0,     0,     0,    17.4, -0.3638,   0.006, 0.2275,   0.13,  0.524,  0.539
j3,    l_j3, 0.0203, -90 deg, 0.15005,  0,     4.8, -0.0203, -0.0141,  0.070,  0.066,  0.086, 0.0125
j4,    l_j4,     0,  90 deg, 0.4318,    0,    0.82,       0,   0.019,      0, 0.0018, 0.0013, 0.0018
j5,    l_j5,     0, -90 deg,     0,     0,    0.34,       0,       0,      0, 0.0003, 0.0004, 0.0003
j6,    l_j6,     0,       0,     0,     0,    0.09,       0,       0,  0.032, 0.00015, 0.00015, 0.00004
";

#[test]
fn the_puma_of_its_table_has_the_golden_efforts() {
    let arm = mechanism(&made(PUMA, Some(Convention::Standard)));
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../tests/golden/values/puma560.json"
    );
    let golden: Value =
        serde_json::from_str(&std::fs::read_to_string(path).expect("the file")).expect("JSON");
    let states = golden["states"].as_array().expect("states");
    assert!(!states.is_empty());
    for state in states {
        let part = |key: &str| -> Vec<f64> {
            let all = state[key].as_array().expect("numbers");
            all.iter().map(|x| x.as_f64().expect("a number")).collect()
        };
        let (q, v, a) = (part("q"), part("v"), part("a"));
        near(
            &value(&arm, Method::InverseDynamics, [&q, &v, &a]),
            &part("tau"),
            1e-12,
        );
    }
}

/// The UR5 as its maker gives it, at 0 and with all joints turned: the arm lies stretched along −x.
#[test]
fn the_ur5_of_its_table_is_where_its_maker_says() {
    let text = "a,alpha,d,theta\n0,90 deg,0.089159,0\n-0.425,0,0,0\n-0.39225,0,0,0\n0,90 deg,0.10915,0\n0,-90 deg,0.09465,0\n0,0,0.0823,0\n";
    let arm = mechanism(&made(text, Some(Convention::Standard)));
    let found = pose(&arm, "flange", &[0.0; 6]);
    near(&found[9..], &[-0.81725, -0.19145, -0.005491], 1e-14);
}

#[test]
fn columns_of_all_kinds_are_taken_over() {
    let text = "\u{feff}\"a\",alpha,d,theta,joint,link,type,lower,upper,velocity,effort,damping,friction,mass,cx\n\
        0.3,0,0,0,Base-Joint,Upper,revolute,-90 deg,90 deg,2,30,0.1,0.2,1,0.1\n\
        0.2,180 deg,0,0,,,prismatic,-10 mm,0.2,,,,,0.5,\n\
        0.1,0,,,,,fixed,,,,,,,,\n";
    let made = import_table(
        text,
        "my arm",
        Some(Convention::Modified),
        &Options::default(),
    )
    .expect("an import");
    insta::assert_snapshot!(format!(
        "{}\n{:?}\n{:?}\n{}",
        made.yaml, made.notes, made.warnings, made.written
    ));
}

/// Names in quotes may hold commas, and a row with such a cell keeps the columns of the others.
#[test]
fn cells_in_quotes_hold_commas() {
    let text = "joint,link,a,alpha,d,theta\n\
        \"turn, first\",\"arm, upper \"\"left\"\"\",0.3,\"90 deg\",0,0\n\
        reach, fore , \"0.2\",0,0,0\n";
    let standard = Some(Convention::Standard);
    let made = import_table(text, "arm", standard, &Options::default()).expect("an import");
    for note in [
        "links `arm, upper \"left\"` → `arm_upper_left`",
        "joints `turn, first` → `turn_first`",
    ] {
        assert!(made.notes.contains(&note.to_owned()), "{:?}", made.notes);
    }
    let plain = "joint,link,a,alpha,d,theta\n\
        turn_first,arm_upper_left,0.3,90 deg,0,0\nreach,fore,0.2,0,0,0\n";
    let plain = import_table(plain, "arm", standard, &Options::default()).expect("an import");
    let labels = [
        "    label: \"arm, upper \\\"left\\\"\"\n",
        ", label: \"turn, first\"",
    ];
    let yaml = labels.iter().fold(made.yaml, |yaml, label| {
        assert!(yaml.contains(label), "{yaml}");
        yaml.replace(label, "")
    });
    assert_eq!(yaml, plain.yaml);
    let wrong = text.replace("0.2", "far");
    let error = import_table(&wrong, "arm", standard, &Options::default());
    let told = error.expect_err("no number").to_string();
    assert!(told.starts_with("3:15: `a` must be a number"), "{told}");
    let wrong = text.replace("\"90 deg\"", "\"9,0 deg\"");
    let error = import_table(&wrong, "arm", standard, &Options::default());
    let told = error.expect_err("no number").to_string();
    assert!(told.starts_with("2:41: `alpha` must be a number"), "{told}");
}

#[test]
fn mistakes_have_their_place() {
    let cases = [
        "",
        "# nothing\n\n",
        "a,alpha,d,theta\n",
        "a,alpha,d\n1,2,3\n",
        "a,alpha,d,theta,a\n",
        "a,alpha,d,theta,colour\n",
        "a,alpha,d,theta\n1,2,3,4,5\n",
        "a,alpha,d,theta\n1,x,3,4\n",
        "a,alpha,d,theta\n1, 2, 30 deg,4\n",
        "a,alpha,d,theta\n1,2,3,inf\n",
        "a,alpha,d,theta,type\n0,0,0,0,ball\n",
        "a,alpha,d,theta,convention\n0,0,0,0,craig\n",
        "a,alpha,d,theta,link\n0,0,0,0,x\n0,0,0,0,x\n",
        "a,alpha,d,theta,damping\n0,0,0,0,-1\n",
    ];
    let told = cases.map(|text| {
        let error = import_table(text, "arm", Some(Convention::Standard), &Options::default());
        error.expect_err(text).to_string()
    });
    let silent = import_table(
        "a,alpha,d,theta\n0,0,0,0\n",
        "arm",
        None,
        &Options::default(),
    );
    let silent = silent.expect_err("no convention").to_string();
    insta::assert_snapshot!(format!("{}\n{silent}", told.join("\n")));
}
