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

/// Whatever does not solve for their impulses refuses them, and says what does.
#[test]
fn what_does_not_know_rigid_contacts_refuses_them() {
    let errors = bgdyn(&["accuracy", "specs/contact/hopper_hops.scene.yaml"]).bad_input();
    assert!(
        errors.contains("the rigid contact `sole` yet") && errors.contains("moreau"),
        "{errors}"
    );
    let page = scratch("rigid_refused", "cart_grips.html", "");
    let out = page.trim_end_matches("/cart_grips.html");
    let errors = bgdyn(&["simulate", CART, "--method", "rk4", "--out", out]).bad_input();
    assert!(errors.contains("use `moreau`"), "{errors}");
}
