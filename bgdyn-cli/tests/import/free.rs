//! Floating and planar joints, followers and `--base` of URDFs.

use super::{made, many, mechanism, near, value};
use bgdyn_cli::import::{Base, Lock, Options, import_with};
use bgdyn_codegen::method::Method;
use bgdyn_codegen::random::Random;

/// A carriage with a swing and a lever; the joints are in the order of the coordinates.
fn robot(joints: &str) -> String {
    let body = |name: &str, mass: f64, com: &str| {
        format!(
            "<link name='{name}'><inertial><mass value='{mass}'/><origin xyz='{com}' rpy='0.1 0.2 -0.3'/>\
             <inertia ixx='0.3' iyy='0.2' izz='0.4' ixy='0.01' ixz='0.02' iyz='-0.03'/></inertial></link>"
        )
    };
    let [a, b, c] = [
        body("a", 3.0, "0.1 0.2 -0.1"),
        body("b", 2.0, "0.2 0 0.1"),
        body("c", 1.5, "0 0.3 0.1"),
    ];
    format!("<robot name='r'>\n<link name='ground'/>{a}{b}{c}\n{joints}</robot>")
}

fn joint(name: &str, kind: &str, [parent, child]: [&str; 2], more: &str) -> String {
    format!(
        "<joint name='{name}' type='{kind}'><parent link='{parent}'/><child link='{child}'/>{more}</joint>\n"
    )
}

const LIMIT: &str = "<limit lower='-9' upper='9' effort='9' velocity='9'/>";

/// Three joints in a chain; the second and the third have these texts inside.
fn chain([second, third]: [&str; 2]) -> String {
    let first = format!("<origin xyz='0 0 0.3' rpy='0.1 0 0.4'/><axis xyz='1 0 2'/>{LIMIT}");
    let second = format!("<origin xyz='0.3 0 0' rpy='0.4 0 0'/><axis xyz='0 1 0'/>{LIMIT}{second}");
    let third = format!("<origin xyz='0.1 0.4 0'/><axis xyz='1 1 0'/>{LIMIT}{third}");
    robot(
        &(joint("first", "revolute", ["ground", "a"], &first)
            + &joint("second", "prismatic", ["a", "b"], &second)
            + &joint("third", "revolute", ["b", "c"], &third)),
    )
}

fn error(urdf: &str, options: &Options) -> String {
    import_with(urdf, options).expect_err("refused").to_string()
}

fn efforts(yaml: &str, state: [&[f64]; 3]) -> Vec<f64> {
    value(&mechanism(yaml), Method::InverseDynamics, state)
}

/// A follower's effort counts at the leader, times the ratio; a chain of followers has one leader.
#[test]
fn followers_move_as_the_independent_joints_would() {
    let free = made(&chain(["", ""])).yaml;
    let mimic = [
        "<mimic joint='third' multiplier='-0.5' offset='0.2'/>",
        "<mimic joint='first' multiplier='2' offset='-0.1'/>",
    ];
    let follows = made(&chain(mimic));
    let written = "(3 moving, of them 2 followers)";
    assert!(follows.written.contains(written), "{}", follows.written);
    let ratios = [1.0, -1.0, 2.0];
    let offsets = [0.0, 0.25, -0.1];
    let mut numbers = Random(11);
    for _ in 0..5 {
        let [q, v, a] = [(); 3].map(|()| numbers.signed());
        let all = |x: f64| ratios.map(|ratio| ratio * x);
        let mut places = all(q);
        places.iter_mut().zip(offsets).for_each(|(x, by)| *x += by);
        let apart = efforts(&free, [&places, &all(v), &all(a)]);
        let sum: f64 = apart.iter().zip(ratios).map(|(x, ratio)| x * ratio).sum();
        near(&efforts(&follows.yaml, [&[q], &[v], &[a]]), &[sum], 1e-13);
    }
}

/// A locked leader fixes its followers where they would be.
#[test]
fn a_locked_leader_fixes_its_followers() {
    let urdf = chain(["", "<mimic joint='first' multiplier='2' offset='-0.1'/>"]);
    let options = Options {
        lock: vec![Lock::parse("first=0.4").expect("a lock")],
        ..Options::default()
    };
    let locked = import_with(&urdf, &options).expect("an import");
    let told = "--lock: `first` fixes its followers too: `third` at 0.7";
    assert!(locked.warnings.iter().any(|it| it == told), "{locked:?}");
    let free = made(&chain(["", ""])).yaml;
    let wanted = efforts(
        &free,
        [&[0.4, 0.3, 0.7], &[0.0, -0.8, 0.0], &[0.0, 0.6, 0.0]],
    );
    near(
        &efforts(&locked.yaml, [&[0.3], &[-0.8], &[0.6]]),
        &wanted[1..2],
        1e-13,
    );
}

#[test]
fn followers_that_cannot_follow_are_named_together() {
    let fixed = chain(["<mimic joint='third'/>", ""])
        .replace("'third' type='revolute'", "'third' type='fixed'");
    let told = error(&fixed, &Options::default());
    assert!(
        told.starts_with(
            "4:1: joint `second` follows `third`, which is fixed: `--lock second=0` fixes"
        ),
        "{told}"
    );
    let both = chain([
        "<mimic joint='none'/>",
        "<mimic joint='first' multiplier='0' offset='0.5'/>",
    ]);
    let told = error(&both, &Options::default());
    for part in [
        "4:1: joint `second` follows `none`, and there is no such joint here: correct the name, or fix the follower with \
         `--lock second`; ",
        "joint `third` follows `first` with the multiplier 0: `--lock third=0.5` fixes it where it rests",
    ] {
        assert!(told.contains(part), "{told}");
    }
    let circle = chain(["<mimic joint='third'/>", "<mimic joint='second'/>"]);
    let told = error(&circle, &Options::default());
    assert!(
        told.starts_with("4:1: `second` follows `third` follows `second`: the joints follow each other in a circle"),
        "{told}"
    );
    let several = chain(["<mimic joint='third'/>", ""])
        .replace("'third' type='revolute'", "'third' type='planar'");
    let told = error(&several, &Options::default());
    assert!(
        told.contains("which is planar and has several coordinates"),
        "{told}"
    );
    let follower = chain(["", "<mimic joint='second'/>"])
        .replace("'third' type='revolute'", "'third' type='floating'");
    let told = error(&follower, &Options::default());
    assert!(
        told.contains("joint `third` has `<mimic>` and is floating and has several coordinates"),
        "{told}"
    );
    let unnamed = chain(["<mimic/>", ""]);
    let told = error(&unnamed, &Options::default());
    assert!(told.contains("this `<mimic>` names no joint"), "{told}");
}

/// An effort of v̇ in link axes, from the rates of x, y and the angle; T maps the rates to v.
fn planar_state([x, y, angle]: [f64; 3], rate: [f64; 3], second: [f64; 3]) -> [Vec<f64>; 3] {
    let (s, c) = angle.sin_cos();
    let turned = |[x, y]: [f64; 2]| [c * x + s * y, c * y - s * x];
    let [u, w] = turned([rate[0], rate[1]]);
    let [du, dw] = turned([second[0], second[1]]);
    let acceleration = vec![du + rate[2] * w, dw - rate[2] * u, second[2]];
    [vec![x, y, angle], vec![u, w, rate[2]], acceleration]
}

/// A planar joint about any axis is two slides along the plane and a turn about its normal.
#[test]
fn a_planar_joint_is_two_slides_and_a_turn() {
    let mut numbers = Random(17);
    for normal in [
        [1.0, 0.0, 0.0],
        [0.0, 0.0, -2.0],
        [0.3, -0.4, 1.2],
        [1.0, 1e-3, 0.0],
        [0.0, 0.0, 1.0],
    ] {
        let [n0, n1, n2]: [f64; 3] = normal;
        let length = (n0 * n0 + n1 * n1 + n2 * n2).sqrt();
        let z = normal.map(|x| x / length);
        let seed = match n1 == 0.0 && n2 == 0.0 {
            true => [0.0, 1.0, 0.0],
            false => [1.0, 0.0, 0.0],
        };
        let along: f64 = seed.iter().zip(z).map(|(a, b)| a * b).sum();
        let x: [f64; 3] = std::array::from_fn(|i| seed[i] - along * z[i]);
        let y: [f64; 3] = std::array::from_fn(|i| {
            z[(i + 1) % 3] * x[(i + 2) % 3] - z[(i + 2) % 3] * x[(i + 1) % 3]
        });
        let axis = |v: [f64; 3]| format!("<axis xyz='{} {} {}'/>", v[0], v[1], v[2]);
        let place = "<origin xyz='0.1 0.2 0.3' rpy='0.2 -0.3 0.5'/>";
        let tail = joint(
            "elbow",
            "continuous",
            ["a", "b"],
            "<origin xyz='0.1 0.2 0.3' rpy='0.1 0.5 0'/><axis xyz='1 2 0'/>",
        ) + &joint(
            "end",
            "fixed",
            ["b", "c"],
            "<origin xyz='0.1 0 0' rpy='0.3 0 0'/>",
        );
        let planar = made(&robot(
            &(joint(
                "drive",
                "planar",
                ["ground", "a"],
                &(place.to_owned() + &axis(normal)),
            ) + &tail),
        ));
        let turned = planar
            .warnings
            .iter()
            .any(|it| it.starts_with("links turned so that z is the normal"));
        assert_eq!(turned, normal != [0.0, 0.0, 1.0], "{planar:?}");
        let joints = joint(
            "x",
            "prismatic",
            ["ground", "p"],
            &format!("{place}{}{LIMIT}", axis(x)),
        ) + &joint("y", "prismatic", ["p", "r"], &format!("{}{LIMIT}", axis(y)))
            + &joint("turn", "continuous", ["r", "a"], &axis(z));
        let slides = robot(&(joints + &tail)).replace(
            "<link name='ground'/>",
            "<link name='ground'/><link name='p'/><link name='r'/>",
        );
        let slides = made(&slides).yaml;
        for _ in 0..3 {
            let parts = [(); 3].map(|()| many(&mut numbers, 4));
            let [q, v, a] = parts.each_ref().map(|part| [part[0], part[1], part[2]]);
            let mut own = planar_state(q, v, a);
            own.iter_mut()
                .zip(&parts)
                .for_each(|(own, part)| own.push(part[3]));
            let found = efforts(&planar.yaml, own.each_ref().map(Vec::as_slice));
            let wanted = efforts(&slides, parts.each_ref().map(Vec::as_slice));
            let (s, c) = q[2].sin_cos();
            let back = [
                c * found[0] - s * found[1],
                s * found[0] + c * found[1],
                found[2],
                found[3],
            ];
            near(&back, &wanted, 1e-12);
        }
    }
}

/// `--base` gives the link without a joint one on the world; at rest in the neutral position the other
/// joints have the efforts of the fixed base, and the first rows carry the weight.
#[test]
fn a_base_moves_when_asked() {
    let fixed = made(&chain(["", ""])).yaml;
    let mut numbers = Random(23);
    for (base, count, neutral) in [
        (Base::Floating, 6, vec![0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]),
        (Base::Planar, 3, vec![0.0; 3]),
    ] {
        let options = Options {
            base: Some(base),
            ..Options::default()
        };
        let free = import_with(&chain(["", ""]), &options).expect("an import");
        assert!(
            free.written
                .contains("fixed to the world: none; moving in the world: `ground` by `root`"),
            "{}",
            free.written
        );
        let [q, v, a] = [(); 3].map(|()| many(&mut numbers, 3));
        let wanted = efforts(&fixed, [&q, &v, &a]);
        let zero = vec![0.0; count];
        let with = |front: &[f64], back: &[f64]| [front, back].concat();
        let found = efforts(
            &free.yaml,
            [&with(&neutral, &q), &with(&zero, &v), &with(&zero, &a)],
        );
        near(&found[count..], &wanted, 1e-13);
        if base == Base::Floating {
            let still = efforts(&free.yaml, [&with(&neutral, &q), &[0.0; 9], &[0.0; 9]]);
            near(&still[..3], &[0.0, 0.0, 6.5 * 9.81], 1e-13);
        }
    }
}

#[test]
fn a_base_that_cannot_move_is_refused() {
    let with = |base| Options {
        base: Some(base),
        ..Options::default()
    };
    let two = chain(["", ""]).replace(
        "<link name='ground'/>",
        "<link name='ground'/><link name='stone'/>",
    );
    let told = error(&two, &with(Base::Floating));
    assert!(
        told.starts_with("--base: several links have no joint: `ground`, `stone`"),
        "{told}"
    );
    assert_eq!(
        made(&chain(["", ""])).yaml,
        import_with(&chain(["", ""]), &with(Base::Fixed))
            .expect("an import")
            .yaml
    );
}

#[test]
fn joints_with_several_coordinates_are_locked_in_neutral_only() {
    let urdf = robot(
        &(joint("root", "floating", ["ground", "a"], "")
            + &joint("k", "fixed", ["a", "b"], "")
            + &joint("l", "fixed", ["b", "c"], "")),
    );
    let lock = |text: &str| Options {
        lock: vec![Lock::parse(text).expect("a lock")],
        ..Options::default()
    };
    let told = error(&urdf, &lock("root=0.5"));
    assert!(
        told.contains("`root` is floating and has several coordinates"),
        "{told}"
    );
    let locked = import_with(&urdf, &lock("root")).expect("an import");
    assert!(locked.written.contains("(0 moving)"), "{}", locked.written);
}

/// A reduced robot has `<mimic>` in joints that were fixed: there it means nothing.
#[test]
fn a_fixed_follower_is_reported() {
    let urdf = chain(["", "<mimic joint='first'/>"])
        .replace("'third' type='revolute'", "'third' type='fixed'");
    let import = made(&urdf);
    let line = "without meaning on fixed joints, left out: <axis> of `third`; <limit> of `third`; <mimic> of `third`";
    assert!(import.warnings.iter().any(|it| it == line), "{import:?}");
}

/// The velocities of a joint with several are called after it; another joint with such a name is no clash.
#[test]
fn names_of_velocities_do_not_clash() {
    let urdf = robot(
        &(joint("root", "floating", ["ground", "a"], "")
            + &joint("root_qx", "prismatic", ["a", "b"], LIMIT)
            + &joint("root_2_x", "prismatic", ["b", "c"], LIMIT)),
    );
    let import = made(&urdf);
    assert_eq!(import.notes, ["joints `root` → `root_3`"]);
    mechanism(&import.yaml);
}
