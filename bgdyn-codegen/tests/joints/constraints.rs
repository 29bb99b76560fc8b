//! Constraints with constant coefficients against the same mechanism without them: M = GᵀM_full G and
//! everything else, where G is solved from the rows here.

use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::random::Random;
use bgdyn_runtime::Dd;

use super::robot::{Robot, State};
use super::same_motion::{Mapped, same};

/// A row: coefficients of the joints by their place, and the offset of a row on positions.
struct Row {
    terms: Vec<(usize, Dd)>,
    offset: Option<Dd>,
}

impl Row {
    /// Returns the coefficient of the joint with this name.
    fn coefficient(&self, name: &str) -> Dd {
        let own = self.terms.iter().filter(|(j, _)| format!("j{j}") == name);
        own.fold(Dd::ZERO, |sum, (_, k)| sum + *k)
    }
}

/// Joints of one degree in two branches on a ball, with axes that are not those of any frame.
fn links(random: &mut Random, count: usize) -> String {
    let mut text = "format: 1\nname: coupled\ngravity: [0.3, -0.4, -9.7]\nlinks:\n  - name: root\n    \
                    joint: { name: ball, type: spherical }\n    mass: 1.5\n    com: [0.02, 0.01, -0.03]\n    \
                    inertia: { xx: 0.03, yy: 0.04, zz: 0.05, xy: 0.001 }\n"
        .to_owned();
    for i in 0..count {
        let kind = [
            "revolute",
            "prismatic",
            "continuous",
            "helical, lead: 30 mm",
        ][i % 4];
        let parent = match i {
            0 | 3 => "root".to_owned(),
            _ => format!("body_{}", i - 1),
        };
        let mut vector = || [0; 3].map(|_| format!("{:.3}", random.signed())).join(", ");
        let (axis, xyz, rpy, com) = (vector(), vector(), vector(), vector());
        text += &format!(
            "  - name: body_{i}\n    parent: {parent}\n    joint: {{ name: j{i}, type: {kind}, axis: [{axis}], \
             origin: {{ xyz: [{xyz}], rpy: [{rpy}] }} }}\n    mass: 0.{}\n    com: [{com}]\n    \
             inertia: {{ xx: 0.02, yy: 0.03, zz: 0.025, xz: 0.002 }}\n",
            i + 3
        );
    }
    text
}

/// Rows with coefficients as text: decimals and fractions, with units where a joint slides.
fn rows(random: &mut Random, count: usize, joints: usize) -> (String, Vec<Row>) {
    let (mut text, mut rows) = (String::from("constraints:\n"), Vec::new());
    for k in 0..count {
        let gear = random.below(3) > 0;
        let first = random.below(joints as u64) as usize;
        let others = 1 + random.below(2) as usize;
        let mut own: Vec<usize> = (0..=others)
            .map(|i| (first + i * (1 + k)) % joints)
            .collect();
        own.sort_unstable();
        own.dedup();
        let (mut words, mut terms) = (Vec::new(), Vec::new());
        for &j in &own {
            let (p, q) = (1 + random.below(9) as i64, 1 + random.below(7) as i64);
            let sign = if random.below(2) == 0 { -1 } else { 1 };
            let unit = if j % 4 == 1 { " rad/m" } else { "" };
            words.push(format!("j{j}: {}/{q}{unit}", sign * p));
            terms.push((j, Dd::from_f64((sign * p) as f64) / Dd::from_f64(q as f64)));
        }
        let joints = words.join(", ");
        let offset: Dd = "0.125".parse().expect("a number");
        text += &match gear {
            true => format!("  row_{k}: {{ type: gear, joints: {{ {joints} }}, offset: 0.125 }}\n"),
            false => format!("  row_{k}: {{ type: linear, row: {{ {joints} }} }}\n"),
        };
        rows.push(Row {
            terms,
            offset: gear.then_some(offset),
        });
    }
    (text, rows)
}

/// Solves A x = b; `None` if A is singular.
fn solve(mut a: Vec<Vec<Dd>>, mut b: Vec<Vec<Dd>>) -> Option<Vec<Vec<Dd>>> {
    let n = a.len();
    for k in 0..n {
        let size = |r: &usize| a[*r][k].to_f64().abs();
        let best = (k..n).max_by(|r, s| size(r).total_cmp(&size(s)))?;
        if size(&best) < 1e-9 {
            return None;
        }
        a.swap(k, best);
        b.swap(k, best);
        for r in (0..n).filter(|&r| r != k) {
            let factor = a[r][k] / a[k][k];
            for c in 0..n {
                let product = factor * a[k][c];
                a[r][c] -= product;
            }
            for c in 0..b[r].len() {
                let product = factor * b[k][c];
                b[r][c] -= product;
            }
        }
    }
    let scaled = |r: usize| b[r].iter().map(|&x| x / a[r][r]).collect();
    Some((0..n).map(scaled).collect())
}

/// Returns the names of the joints of a full tree, and the places of those that the reduced one keeps.
fn kept(one: &Mechanism, other: &Mechanism) -> (Vec<String>, Vec<usize>) {
    let (own, all) = (one.joint_names(), other.joint_names());
    let place = |name: &String| all.iter().position(|n| n == name).expect("a joint");
    let kept = own.iter().map(place).collect();
    (all, kept)
}

/// Returns for every velocity of the tree its row of G: the rows say B G = 0, and the kept velocities are
/// those of the reduced mechanism.
fn reduction(rows: &[Row], kept: &[usize], all: &[String]) -> Option<Vec<Vec<Dd>>> {
    let n = all.len();
    let dependent: Vec<usize> = (0..n).filter(|i| !kept.contains(i)).collect();
    let entry = |row: &Row, i: usize| row.coefficient(&all[i]);
    let a = rows
        .iter()
        .map(|row| dependent.iter().map(|&i| entry(row, i)).collect());
    let b = rows
        .iter()
        .map(|row| kept.iter().map(|&i| -entry(row, i)).collect());
    let solved = solve(a.collect(), b.collect())?;
    let unit = |i: usize| {
        let place = kept.iter().position(|&k| k == i);
        (0..kept.len())
            .map(|k| if Some(k) == place { Dd::ONE } else { Dd::ZERO })
            .collect()
    };
    let mut g: Vec<Vec<Dd>> = (0..n).map(unit).collect();
    for (&i, row) in dependent.iter().zip(solved) {
        g[i] = row;
    }
    Some(g)
}

/// Returns the positions of the tree: those of the reduced mechanism, and for joints without one those that
/// satisfy the rows on positions.
fn positions(one: &Mechanism, other: &Mechanism, rows: &[Row], q: &[Dd]) -> Vec<Dd> {
    let (own, all) = (one.position_names(), other.position_names());
    let mut full: Vec<Option<Dd>> = (all.iter())
        .map(|name| own.iter().position(|n| n == name).map(|p| q[p]))
        .collect();
    let missing: Vec<usize> = (0..all.len()).filter(|&i| full[i].is_none()).collect();
    let holonomic: Vec<&Row> = rows.iter().filter(|row| row.offset.is_some()).collect();
    assert_eq!(
        missing.len(),
        holonomic.len(),
        "as many dependent positions as rows"
    );
    let entry = |row: &Row, i: usize| row.coefficient(&all[i]);
    let a = holonomic
        .iter()
        .map(|row| missing.iter().map(|&i| entry(row, i)).collect());
    let b = holonomic.iter().map(|row| {
        let known = (0..all.len()).filter_map(|i| Some(entry(row, i) * full[i]?));
        vec![row.offset.expect("an offset") - known.fold(Dd::ZERO, |sum, x| sum + x)]
    });
    let solved = solve(a.collect(), b.collect()).expect("regular rows");
    for (&i, x) in missing.iter().zip(&solved) {
        full[i] = Some(x[0]);
    }
    full.into_iter().map(|x| x.expect("a position")).collect()
}

/// Compares a random tree with constraints with the tree without. Returns whether the rows are regular.
fn coupled_tree(seed: u64) -> bool {
    let mut random = Random(seed);
    let joints = 5 + random.below(3) as usize;
    let count = 1 + random.below(3) as usize;
    let tree = links(&mut random, joints);
    let (constraints, rows) = rows(&mut random, count, joints);
    let text = tree.clone() + &constraints;
    let (mechanism, faults) = bgdyn_codegen::read(&text, None);
    if mechanism.is_none() {
        let of = |rule: &str| faults.0.iter().any(|fault| fault.rule == rule);
        assert!(
            of("dependent-row") || of("contradicting-rows") || of("no-motion-left"),
            "{text}"
        );
        return false;
    }
    let (one, other) = (Robot::read(&text), Robot::read(&tree));
    let (all, kept) = kept(&one.mechanism, &other.mechanism);
    assert_eq!(kept.len() + rows.len(), all.len(), "{text}");
    let g = reduction(&rows, &kept, &all).expect("regular rows");
    let map = |s: &State<Dd>| Mapped {
        q: positions(&one.mechanism, &other.mechanism, &rows, &s.q),
        g: g.clone(),
        gamma: vec![Dd::ZERO; all.len()],
    };
    let places = ["body_2", "body_4", "root"];
    same(
        (&one, &other),
        map,
        true,
        &places,
        &format!("seed {seed}\n{constraints}"),
    );
    true
}

#[test]
fn random_trees_with_constraints_are_the_reduced_trees() {
    let regular = (0..12).filter(|&seed| coupled_tree(400 + seed)).count();
    assert!(regular >= 8, "{regular} of 12 mechanisms are regular");
}

/// The relations that chains of gears and `mimic` give, with the joint that `independent` keeps.
#[test]
fn gears_and_mimics_combine() {
    let text = "format: 1\nname: train\nlinks:\n  - name: a\n    joint: { name: ja, type: continuous }\n    \
                inertia: { xx: 1, yy: 1, zz: 1 }\n  - name: b\n    joint: { name: jb, type: continuous, \
                mimic: { joint: jc, ratio: -2, offset: 0.5 } }\n    inertia: { xx: 1, yy: 1, zz: 1 }\n  \
                - name: c\n    joint: { name: jc, type: continuous }\n    inertia: { xx: 1, yy: 1, zz: 1 }\n  \
                - name: d\n    joint: { name: jd, type: continuous }\n    inertia: { xx: 1, yy: 1, zz: 1 }\n\
                constraints:\n  first: { type: gear, joints: { ja: 1, jb: 1/3 }, offset: 0.2 }\n  \
                belt: { type: linear, row: { jc: 1, jd: -1/5 } }\nindependent: [jd]\n";
    let robot = Robot::read(text);
    assert_eq!(robot.mechanism.joint_names(), ["jd"]);
    assert_eq!(robot.mechanism.position_names(), ["ja", "jd"]);
    let ratios: Vec<(String, f64, f64)> = (robot.mechanism.followers())
        .map(|(joint, c, _)| {
            (
                joint.name.clone(),
                c.velocities[0].ratio.to_f64(),
                c.offset.to_f64(),
            )
        })
        .collect();
    // jc = 1.5 ja − 0.05 and jb = 0.6 − 3 ja follow ja, whose velocity is 2/15 of that of jd.
    let expected = [
        ("ja", 2.0 / 15.0, 0.0),
        ("jb", -0.4, 0.6),
        ("jc", 0.2, -0.05),
    ];
    for ((name, ratio, offset), (own, r, o)) in expected.iter().zip(&ratios) {
        assert_eq!(name, own);
        assert!((ratio - r).abs() < 1e-15, "{ratios:?}");
        assert!((offset - o).abs() < 1e-15, "{ratios:?}");
    }
}
