//! Tests what the command does with rigid contacts.

use crate::{bgdyn, scratch, table_rows};

const CART: &str = "specs/contact/cart_grips.scene.yaml";

/// A cart that stands: its tyres carry its weight, which the table of forces says at every row, and the page draws.
#[test]
fn forces_of_rigid_contacts_are_written_and_drawn() {
    let page = scratch("rigid_forces", "cart_grips.html", "");
    let out = page.trim_end_matches("/cart_grips.html");
    let run = bgdyn(&["simulate", CART, "--end", "0.15", "--out", out]);
    let printed = run.good();
    assert!(
        printed.contains("rigid contacts: deepest overlap "),
        "{printed}"
    );
    assert!(!printed.contains("not solved"), "{printed}");
    let text = std::fs::read_to_string(format!("{out}/cart_grips_contacts.csv"));
    let text = text.expect("the forces");
    let head = text.lines().next().expect("a header");
    assert_eq!(
        head,
        "t [s],tyres_rear_tyre_friction_x [N],tyres_rear_tyre_friction_y [N],tyres_rear_tyre_normal [N],tyres_front_tyre_friction_x [N],tyres_front_tyre_friction_y [N],tyres_front_tyre_normal [N]"
    );
    let rows = table_rows(&text);
    assert!(rows.len() > 100);
    for row in &rows[1..] {
        let [rear, front] = [3, 6].map(|k: usize| row[k].parse::<f64>().expect("a number"));
        assert!((rear + front - 6.2 * 9.81).abs() < 1e-9, "{row:?}");
        assert!((rear - front).abs() < 1e-9, "{row:?}");
    }
    let page = std::fs::read_to_string(&page).expect("the page");
    assert!(page.contains("\"name\":\"tyres_rear_tyre\""));
}

/// Any other method goes from event to event: the events are listed at their instants, with what the contacts do.
#[test]
fn other_methods_go_from_event_to_event() {
    let page = scratch("rigid_events", "cart_grips.html", "");
    let out = page.trim_end_matches("/cart_grips.html");
    let precisely = ["--method", "dop853", "--tolerance", "1e-9", "--out", out];
    let run = bgdyn(&[&["simulate", CART], &precisely[..]].concat());
    let printed = run.good();
    for line in [
        "events: 2",
        "  t = 0.2 s: `tyres_rear_tyre` slips",
        "  t = 1.25769 s: `tyres_rear_tyre` sticks",
    ] {
        assert!(printed.contains(line), "{line}: {printed}");
    }
    let (_, rest) = printed
        .split_once("rigid contacts: deepest overlap ")
        .expect("the overlap");
    let depth: f64 = rest
        .split(' ')
        .next()
        .expect("a number")
        .parse()
        .expect("m");
    assert!(depth < 1e-12, "{depth}");
    // The weight is on the tyres at every instant, and the wheel that spins has its limit of friction.
    let text = std::fs::read_to_string(format!("{out}/cart_grips_contacts.csv"));
    for row in table_rows(&text.expect("the forces")).iter().skip(1) {
        let [t, x, rear, front] = [0, 1, 3, 6].map(|k: usize| row[k].parse().expect("a number"));
        let weight: f64 = rear + front;
        assert!((weight - 6.2 * 9.81).abs() < 1e-9, "{row:?}");
        let spins = (0.21..1.25).contains(&t);
        assert!(!spins || (f64::abs(x) - 0.6 * rear).abs() < 1e-9, "{row:?}");
    }
    let ball = "specs/contact/ball_in_rigid_corner.scene.yaml";
    let printed = bgdyn(&[&["simulate", ball], &precisely[..]].concat()).good();
    let first = "  t = 0.385831 s: `surfaces_left` bounces, 2.39483 N s";
    assert!(printed.contains(first), "{printed}");
}

/// Painlevé's paradox ends a run from event to event, and names the contact.
#[test]
fn the_paradox_names_the_contact() {
    let page = scratch("rigid_paradox", "jams.html", "");
    let out = page.trim_end_matches("/jams.html");
    let mut words = vec!["simulate", "tests/rigid_contact/jams.scene.yaml"];
    words.extend(["--method", "dop853", "--tolerance", "1e-9", "--out", out]);
    for start in [
        "rod_turn=1",
        "rod_y=0.42073549240394825",
        "rod_x_velocity=-1.6209069176044193",
        "rod_y_velocity=2.5244129544236893",
    ] {
        words.extend(["--initial", start]);
    }
    let errors = bgdyn(&words).bad_input();
    assert!(
        errors.contains("`ends_tail` slips") && errors.contains("(Painlevé's paradox)"),
        "{errors}"
    );
}

/// Whatever does not solve for their impulses refuses them, and says what does.
#[test]
fn what_does_not_know_rigid_contacts_refuses_them() {
    let gripper = "specs/contact/gripper_lifts.scene.yaml";
    let errors = bgdyn(&["simulate", gripper, "--method", "rk4"]).bad_usage();
    assert!(
        errors.contains("24 rigid contacts") && errors.contains("use `moreau`"),
        "{errors}"
    );
    let hopper = "specs/contact/hopper_hops.scene.yaml";
    let errors = bgdyn(&["simulate", hopper, "--method", "canonical_gauss2"]).bad_usage();
    assert!(errors.contains("use `gauss2`"), "{errors}");
}
