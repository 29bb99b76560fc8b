//! Prescribed joints, against the same mechanism in which they are free.

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::selection;
use bgdyn_codegen::verify::{check_model, explain};
use bgdyn_runtime::Dd;

use super::prescribed_pair::{Pair, links, pick};
use super::robot::{Robot, Way, close, full, largest, times};

pub(super) const WAYS: [Way; 4] = [None, Some("recursion"), Some("subspaces"), Some("literal")];
const EXACT: f64 = 1e-25;

pub(super) fn value(robot: &Robot, way: Way, method: Method, at: &Inputs<Dd>) -> Vec<Dd> {
    let (value, refused) = robot.function(way, method).evaluate(at.clone());
    assert_eq!(refused, None, "{method:?}: a pivot is refused");
    value
}

fn literal(robot: &Robot, method: Method, at: &Inputs<Dd>) -> Vec<Dd> {
    value(robot, Some("literal"), method, at)
}

const SEEDS: std::ops::Range<u64> = 0..9;

#[test]
fn efforts_are_rows_of_those_with_free_joints() {
    for seed in SEEDS {
        let pair = Pair::new(seed);
        let [free, own] = pair.state(seed + 50);
        let efforts = literal(&pair.free, Method::InverseDynamics, &free);
        let kept = &pair.kept[1];
        let biased = Inputs {
            a: pair.driven_alone(&free.a),
            ..free.clone()
        };
        let resting = Inputs {
            v: pair.driven_alone(&free.v),
            ..biased.clone()
        };
        let bias = literal(&pair.free, Method::InverseDynamics, &biased);
        let gravity = literal(&pair.free, Method::InverseDynamics, &resting);
        let drives = Method::DriveEfforts(pair.np());
        for way in WAYS {
            let what = format!("{}, {way:?}", pair.what);
            let size = largest(&efforts);
            let near = |method, expected: &[Dd]| {
                let found = value(&pair.own, way, method, &own);
                close(
                    &found,
                    expected,
                    EXACT,
                    size,
                    &format!("{what}, {method:?}"),
                );
            };
            near(Method::InverseDynamics, &pick(&efforts, kept));
            near(drives, &pick(&efforts, &pair.driven[1]));
            near(Method::Bias, &pick(&bias, kept));
            near(Method::Gravity, &pick(&gravity, kept));
            // The accelerations need the efforts that were given.
            let a = value(&pair.own, way, Method::ForwardDynamics, &own);
            let mut moved = free.clone();
            kept.iter().zip(&a).for_each(|(&j, &a)| moved.a[j] = a);
            let needed = literal(&pair.free, Method::InverseDynamics, &moved);
            close(&pick(&needed, kept), &own.u, 1e-20, size, &what);
        }
    }
}

#[test]
fn mass_matrix_energies_and_places_are_those_with_free_joints() {
    for seed in SEEDS {
        let pair = Pair::new(seed);
        let [free, own] = pair.state(seed + 70);
        let (n, kept) = (pair.free.nv(), &pair.kept[1]);
        let whole = full(&literal(&pair.free, Method::MassMatrix, &free), n);
        let part: Vec<Dd> = kept.iter().flat_map(|&i| pick(&whole[i], kept)).collect();
        let tool = |robot: &Robot| robot.site("tool");
        let (site, other) = (tool(&pair.own), tool(&pair.free));
        let jacobian = literal(&pair.free, Method::Jacobian(other), &free);
        let rows: Vec<Vec<Dd>> = jacobian.chunks(n).map(<[Dd]>::to_vec).collect();
        let columns: Vec<Dd> = rows.iter().flat_map(|row| pick(row, kept)).collect();
        // The acceleration of the tool where those of the joints in v are zero.
        let driven = times(&rows, &pair.driven_alone(&free.a));
        let turning = literal(&pair.free, Method::JacobianDotV(other), &free);
        let turning: Vec<Dd> = turning.iter().zip(driven).map(|(&x, y)| x + y).collect();
        let same = |method| literal(&pair.free, method, &free);
        let expected = [
            (Method::KineticEnergy, same(Method::KineticEnergy)),
            (Method::PotentialEnergy, same(Method::PotentialEnergy)),
            (Method::Pose(site), same(Method::Pose(other))),
            (Method::Velocity(site), same(Method::Velocity(other))),
            (Method::Jacobian(site), columns),
            (Method::JacobianDotV(site), turning),
        ];
        for way in WAYS {
            let what = format!("{}, {way:?}", pair.what);
            let found = value(&pair.own, way, Method::MassMatrix, &own);
            close(
                &full(&found, own.v.len()).concat(),
                &part,
                EXACT,
                0.0,
                &what,
            );
            for (method, expected) in &expected {
                let found = value(&pair.own, way, *method, &own);
                close(&found, expected, EXACT, 1.0, &format!("{what}, {method:?}"));
            }
        }
    }
}

/// Derivatives along q and v at fixed course: blocks of those with free joints, and for forward dynamics
/// M ∂a/∂x = −∂P/∂x at the accelerations.
#[test]
fn derivatives_are_blocks_of_those_with_free_joints() {
    for seed in [1, 2, 5] {
        let pair = Pair::new(seed);
        let [free, own] = pair.state(seed + 90);
        let (n, m, kept) = (pair.free.nv(), own.v.len(), &pair.kept[1]);
        let block = |whole: &[Dd]| -> Vec<Dd> {
            let rows: Vec<&[Dd]> = whole.chunks(n).collect();
            kept.iter().flat_map(|&i| pick(rows[i], kept)).collect()
        };
        let slopes = |at: &Inputs<Dd>| {
            let whole = literal(&pair.free, Method::InverseDynamicsDerivatives, at);
            let (by_q, by_v) = whole.split_at(n * n);
            [block(by_q), block(by_v)]
        };
        let expected = slopes(&free).concat();
        for way in [None, Some("literal"), Some("subspaces")] {
            let what = format!("{}, {way:?}", pair.what);
            let found = value(&pair.own, way, Method::InverseDynamicsDerivatives, &own);
            close(&found, &expected, EXACT, largest(&expected), &what);
            let result = value(&pair.own, way, Method::ForwardDynamicsDerivatives, &own);
            let (a, matrices) = result.split_at(m);
            let mut moved = free.clone();
            kept.iter().zip(a).for_each(|(&j, &a)| moved.a[j] = a);
            let mass = full(&value(&pair.own, way, Method::MassMatrix, &own), m);
            let identity =
                (0..m * m).map(|k| Dd::from_f64(if k % m == k / m { -1.0 } else { 0.0 }));
            let [by_q, by_v] = slopes(&moved);
            for (part, wanted) in matrices.chunks(m * m).zip([by_q, by_v, identity.collect()]) {
                let columns: Vec<Vec<Dd>> = (0..m)
                    .map(|k| part.iter().skip(k).step_by(m).copied().collect())
                    .collect();
                for (k, column) in columns.iter().enumerate() {
                    let product = times(&mass, column);
                    let other: Vec<Dd> = wanted.iter().skip(k).step_by(m).map(|&x| -x).collect();
                    close(&product, &other, 1e-18, largest(&wanted), &what);
                }
            }
        }
    }
}

/// bias = C v + gravity. C + Cᵀ is the rate of M along the whole motion, and once more that along the prescribed
/// joints, which is compared with differences of M here.
#[test]
fn the_coriolis_matrix_has_its_laws() {
    for seed in SEEDS {
        let pair = Pair::new(seed);
        let [_, own] = pair.state(seed + 110);
        let n = own.v.len();
        let h = Dd::from_f64(1e-8);
        let mass = |q: Vec<Dd>, course: Dd| {
            let mut parameters = own.parameters.clone();
            for motion in parameters.chunks_mut(3) {
                motion[0] += course * motion[1];
            }
            let at = Inputs {
                q,
                parameters,
                ..own.clone()
            };
            full(&literal(&pair.own, Method::MassMatrix, &at), n).concat()
        };
        let apart = |a: Vec<Dd>, b: Vec<Dd>| -> Vec<Dd> {
            a.iter().zip(b).map(|(&a, b)| (a - b) / (h + h)).collect()
        };
        let moved = |h: Dd| pair.own.moved(&own.q, &own.v, h);
        let along_v = apart(mass(moved(h), Dd::ZERO), mass(moved(-h), Dd::ZERO));
        let along_time = apart(mass(own.q.clone(), h), mass(own.q.clone(), -h));
        for way in [None, Some("subspaces"), Some("literal")] {
            let what = format!("{}, {way:?}", pair.what);
            let matrix = value(&pair.own, way, Method::CoriolisMatrix, &own);
            let rows: Vec<Vec<Dd>> = matrix.chunks(n).map(<[Dd]>::to_vec).collect();
            let bias = value(&pair.own, way, Method::Bias, &own);
            let gravity = value(&pair.own, way, Method::Gravity, &own);
            let product = times(&rows, &own.v);
            let sum: Vec<Dd> = product.iter().zip(&gravity).map(|(&x, &y)| x + y).collect();
            close(&sum, &bias, EXACT, largest(&product), &what);
            let both = (0..n * n).map(|k| matrix[k] + matrix[k % n * n + k / n]);
            let both: Vec<Dd> = both.collect();
            let rates = along_v.iter().zip(&along_time);
            let rates: Vec<Dd> = rates.map(|(&x, &y)| x + y + y).collect();
            close(&both, &rates, 1e-13, largest(&rates).max(1.0), &what);
        }
    }
}

/// The joints at rest in zero are fixed joints.
#[test]
fn a_joint_prescribed_at_rest_is_a_fixed_one() {
    let text = links(&mut Random(3), 6);
    let joint = text
        .lines()
        .find(|line| line.contains("name: j4,"))
        .expect("the joint");
    let origin = joint.split_once("origin:").expect("an origin").1;
    let fixed = text.replace(
        joint,
        &format!("    joint: {{ name: j4, type: fixed, origin:{origin}"),
    );
    let fixed = Robot::read(&fixed);
    let own = Robot::read(&format!(
        "{text}constraints:\n  c: {{ type: prescribed, joint: j4 }}\n"
    ));
    let s = own.state(8);
    let defaults = own.mechanism.parameters().iter().map(|p| p.default);
    let at = |parameters: Vec<Dd>| Inputs {
        q: s.q.clone(),
        v: s.v.clone(),
        a: s.a.clone(),
        u: s.u.clone(),
        parameters,
        ..Inputs::default()
    };
    let still = at(defaults.collect());
    assert_eq!(still.parameters, vec![Dd::ZERO; 3]);
    for method in [
        Method::InverseDynamics,
        Method::Bias,
        Method::Gravity,
        Method::KineticEnergy,
    ] {
        let found = value(&own, None, method, &still);
        let expected = value(&fixed, None, method, &at(vec![]));
        close(&found, &expected, EXACT, 1.0, &format!("{method:?}"));
    }
}

/// On a base whose motion is given too.
#[test]
fn prescribed_joints_on_a_moving_base() {
    let text = links(&mut Random(12), 6).replacen("format: 1\n", "format: 1\nbase: given\n", 1);
    let constraints =
        "  a: { type: prescribed, joint: j3 }\n  b: { type: prescribed, joint: j0 }\n";
    let pair = Pair::of(&text, constraints, "moving base".into());
    let [mut free, mut own] = pair.state(4);
    let mut random = Random(9);
    let base: Vec<Dd> = (0..9)
        .map(|_| Dd::from_f64(3.0 * random.signed()))
        .collect();
    let names = pair.own.mechanism.parameters();
    assert!(names[0].name.starts_with("base_") && names[9].name == "j0_position");
    free.parameters = base.clone();
    own.parameters = [base, own.parameters].concat();
    let efforts = literal(&pair.free, Method::InverseDynamics, &free);
    for way in WAYS {
        let found = value(&pair.own, way, Method::InverseDynamics, &own);
        close(
            &found,
            &pick(&efforts, &pair.kept[1]),
            EXACT,
            largest(&efforts),
            "rows",
        );
        let drives = value(&pair.own, way, Method::DriveEfforts(2), &own);
        close(
            &drives,
            &pick(&efforts, &pair.driven[1]),
            EXACT,
            largest(&efforts),
            "drives",
        );
        let gravity = value(&pair.own, way, Method::Gravity, &own);
        let bias = value(&pair.own, way, Method::Bias, &own);
        if way != Some("recursion") {
            let matrix = value(&pair.own, way, Method::CoriolisMatrix, &own);
            let rows: Vec<Vec<Dd>> = matrix.chunks(own.v.len()).map(<[Dd]>::to_vec).collect();
            let product = times(&rows, &own.v);
            let sum: Vec<Dd> = product.iter().zip(&gravity).map(|(&x, &y)| x + y).collect();
            close(&sum, &bias, EXACT, largest(&product), "Coriolis matrix");
        }
    }
}

/// The generator's own check accepts all of them, with derivatives.
#[test]
fn every_mechanism_with_prescribed_joints_is_accepted() {
    for seed in SEEDS {
        let pair = Pair::new(seed);
        let options = Options {
            derivatives: seed % 3 == 0,
            ..Options::default()
        };
        let model = selection::model(pair.own.mechanism.clone(), &options).expect("options");
        let drives = Method::DriveEfforts(pair.np());
        assert!(
            model.functions.iter().any(|f| f.method == drives),
            "{}",
            pair.what
        );
        let found = check_model(&model);
        assert!(found.is_empty(), "{}: {}", pair.what, explain(&found));
    }
}
