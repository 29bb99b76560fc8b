//! Mechanisms with loops: what the commands print of them.

use serde_json::{Value, json};

use crate::{bgdyn, scratch};

const FIVE_BAR: &str = "specs/loops/five_bar.yaml";

#[test]
fn check_prints_rows_branch_and_mobility() {
    let checked = bgdyn(&["check", FIVE_BAR]).good();
    let lines: Vec<&str> = checked.lines().collect();
    assert_eq!(
        lines,
        [
            "ok: five_bar, NQ 4, NV 2: proximal1_angle, proximal2_angle",
            "loop tip_pin, hinge: rows x, y; always closed: z, tilt x, tilt y; branch left",
            "mobility 2: 4 velocities less 2 rows; independent: proximal1_angle, proximal2_angle; \
             dependent: distal2_angle, distal1_angle",
        ]
    );
    let report: Value =
        serde_json::from_str(&bgdyn(&["check", FIVE_BAR, "--json"]).good()).expect("JSON");
    let closure = &report["model"]["closure"];
    assert_eq!(
        closure["loops"][0]["dropped_rows"],
        json!(["z", "tilt x", "tilt y"])
    );
    assert_eq!(
        closure["independent"],
        json!(["proximal1_angle", "proximal2_angle"])
    );
}

#[test]
fn the_graph_has_a_flow_source_for_each_loop() {
    let drawn = bgdyn(&["graph", FIVE_BAR, "--format", "dot"]).good();
    assert!(drawn.contains("loop tip_pin"), "{drawn}");
    assert!(drawn.contains("Sf: 0, effort λ"), "{drawn}");
    // The drives are those of the independent joints.
    assert!(
        drawn.contains("Se: P₁") && drawn.contains("Se: P₃"),
        "{drawn}"
    );
    assert!(!drawn.contains("Se: P₂"), "{drawn}");
    let refused = bgdyn(&["equations", FIVE_BAR]).bad_input();
    assert!(
        refused.contains("no closed form: it has the loop `tip_pin`"),
        "{refused}"
    );
}

/// Positions that are open by a rounding are closed; others are refused with the loop and the gap.
#[test]
fn eval_closes_positions_that_are_almost_closed() {
    let closed = [2.0, -1.269858316944471, 1.1, 1.293970919622041];
    let states = |by: f64| {
        let q = [closed[0], closed[1] + by, closed[2], closed[3]];
        json!({ "states": [{ "q": q, "v": [0.5, 0], "a": [1, 0], "tau": [1, 0] }] }).to_string()
    };
    let value = |by: f64| -> Value {
        let file = scratch("loops_eval", &format!("states{by}.json"), states(by));
        let run = ["eval", FIVE_BAR, "forward_dynamics", "--states", &file];
        serde_json::from_str(&bgdyn(&run).good()).expect("JSON")
    };
    let (exact, rounded) = (value(0.0), value(1e-7));
    for k in 0..2 {
        let [x, y] = [&exact, &rounded].map(|v| v["results"][0][k].as_f64().expect("a number"));
        assert!((x - y).abs() < 1e-10 * x.abs(), "{x} {y}");
    }
    let file = scratch("loops_eval", "open.json", states(0.01));
    let run = bgdyn(&["eval", FIVE_BAR, "forward_dynamics", "--states", &file]);
    let said = format!("{}{}", run.stdout, run.stderr);
    assert_ne!(run.code, Some(0));
    assert!(
        said.contains("the loop `tip_pin` is open by 0.00"),
        "{said}"
    );
}

/// The mirror image of the tip at the line between the elbows closes, and is no position of this mechanism.
#[test]
fn eval_names_the_loop_on_another_branch() {
    let q = [2.0, -2.747621733967752, 1.1, -3.5114509705342645];
    let states = json!({ "states": [{ "q": q, "v": [0, 0], "tau": [0, 0] }] }).to_string();
    let file = scratch("loops_branch", "states.json", states);
    let run = bgdyn(&["eval", FIVE_BAR, "forward_dynamics", "--states", &file]);
    let said = format!("{}{}", run.stdout, run.stderr);
    assert_ne!(run.code, Some(0));
    assert!(
        said.contains("the loop `tip_pin` is at a singular position"),
        "{said}"
    );
}

/// `--loops` adds ranks, and the range of each independent joint in a loop: of the slider-crank a whole turn, of the
/// five-bar's cranks as far as two rods of 0.35 m reach.
#[test]
fn check_prints_ranks_and_ranges() {
    let closure = |spec: &str| -> Value {
        let run = bgdyn(&["check", spec, "--json", "--loops"]).good();
        let report: Value = serde_json::from_str(&run).expect("JSON");
        report["model"]["closure"].clone()
    };
    let turning = closure("specs/loops/slider_crank.yaml");
    assert_eq!(turning["rank"], json!({ "closed": 2, "open": 2 }));
    assert_eq!(turning["ranges"][0]["joint"], "crank_angle");
    assert_eq!(turning["ranges"][0]["whole_turn"], true);

    let five_bar = closure(FIVE_BAR);
    let start = 1.1_f64;
    let elbow = [0.3 + 0.25 * start.cos(), 0.25 * start.sin()];
    for (range, end) in [("lower", -1.0), ("upper", 1.0)] {
        let found = &five_bar["ranges"][0][range];
        assert_eq!(found["why"], "reach", "{range}");
        let angle = found["position"].as_f64().expect("a number");
        // The elbows are 0.7 m apart there, the rods stretched.
        let [x, y] = [0.25 * angle.cos(), 0.25 * angle.sin()];
        let apart = (x - elbow[0]).hypot(y - elbow[1]);
        assert!(
            (apart - 0.7).abs() < 1e-6 && angle * end > 0.0,
            "{range}: {apart}"
        );
    }
    let value = |k: &str| five_bar["ranges"][0]["condition"][k]["value"].as_f64();
    assert!(value("least") >= Some(1.0) && value("largest") > value("least"));

    // Of the excavator's rocker the limits, of Bricard's rows the rank.
    let rocker = &closure("specs/loops/excavator.yaml")["ranges"][0];
    assert_eq!(
        rocker["upper"],
        json!({ "joint": "rocker_angle", "position": 0.6981317007977318, "why": "limit" })
    );
    let bricard = closure("specs/loops/bricard.yaml");
    assert_eq!(
        bricard["loops"][0]["rank"],
        json!({ "closed": 4, "open": 5 })
    );
    assert_eq!(bricard["loops"][0]["paradoxical_rows"], json!(["tilt y"]));
    // At the flat position both parallelograms may turn over.
    let flat = &closure("specs/loops/parallelograms.yaml")["ranges"][0];
    for (end, angle) in [("lower", 0.0), ("upper", std::f64::consts::PI)] {
        let found = flat[end]["position"].as_f64().expect("a number");
        assert!((found - angle).abs() < 1e-6, "{end}: {found}");
        assert_eq!(flat[end]["why"], "branches-meet");
    }
}

/// Methods with velocities and efforts of the open tree, and those whose results are forces and moments.
#[test]
fn eval_takes_velocities_of_the_tree_and_returns_loads() {
    let q = [2.0, -1.269858316944471, 1.1, 1.293970919622041];
    let states = json!({ "states": [{
        "q": q, "v": [0, 0], "a": [0, 0], "qd": [0.3, 0.1, -0.2, 0.4], "tau": [1, 0],
    }] });
    let value = |method: &str, states: &Value| -> Value {
        let file = scratch(
            "loops_eval_tree",
            &format!("{method}.json"),
            states.to_string(),
        );
        let run = ["eval", FIVE_BAR, method, "--states", &file];
        let report: Value = serde_json::from_str(&bgdyn(&run).good()).expect("JSON");
        report["results"][0].clone()
    };
    let kept = value("project_velocity", &states);
    assert_eq!(kept.as_array().map(Vec::len), Some(4), "{kept}");
    let mut of_tree = states.clone();
    of_tree["states"][0]["qd"] = kept.clone();
    of_tree["states"][0]["tau"] = json!([1, 0, 0, 0]);
    // What holds stays.
    let again = value("project_velocity", &of_tree);
    for j in 0..4 {
        let [x, y] = [&kept, &again].map(|v| v[j].as_f64().expect("a number"));
        assert!((x - y).abs() < 1e-14, "{x} {y}");
    }
    let found = value("constrained_dynamics", &of_tree);
    assert_eq!(found["accelerations"].as_array().map(Vec::len), Some(4));
    assert_eq!(found["multipliers"].as_array().map(Vec::len), Some(2));
    let pin = value("reactions", &states);
    assert_eq!(pin.as_array().map(Vec::len), Some(1), "{pin}");
    assert_eq!(pin[0]["force"][2], json!(0.0));
    let joints = value("joint_reactions", &states);
    assert_eq!(joints.as_array().map(Vec::len), Some(4), "{joints}");
    // Three efforts are missing: the file has those of the independent joints.
    let file = scratch("loops_eval_tree", "short.json", states.to_string());
    let refused = bgdyn(&["eval", FIVE_BAR, "constrained_dynamics", "--states", &file]);
    let said = refused.stdout;
    assert!(
        said.contains("`tau` has 2 components instead of 4"),
        "{said}"
    );
}

/// A five-bar with drives at its cranks, in the positions of a crank and its rod.
#[test]
fn actuated_joints_are_printed_drawn_and_evaluated() {
    let spec = "tests/actuated/crank_and_rod.yaml";
    let checked = bgdyn(&["check", spec]).good();
    let line = "actuated: proximal1_angle, proximal2_angle";
    assert!(checked.lines().any(|own| own == line), "{checked}");
    let report: Value =
        serde_json::from_str(&bgdyn(&["check", spec, "--json"]).good()).expect("JSON");
    assert_eq!(
        report["model"]["closure"]["actuated"],
        json!(["proximal1_angle", "proximal2_angle"])
    );
    let drawn = bgdyn(&["graph", spec, "--format", "dot"]).good();
    assert!(drawn.contains("Se: P₁") && drawn.contains("Se: P₃"));
    assert!(!drawn.contains("Se: P₂"), "{drawn}");
    // The rods in line with each other: the ends of the cranks are 0.7 m apart.
    let angle = 0.8_f64.acos();
    let pi = std::f64::consts::PI;
    let q = [pi - angle, angle - pi, angle, pi - angle];
    let states = |q: [f64; 4]| {
        let state = json!({ "q": q, "v": [0.5, 0], "a": [1, 0], "tau_in": [2, -1] });
        json!({ "states": [state] }).to_string()
    };
    let file = scratch("loops_actuated", "aligned.json", states(q));
    let run = bgdyn(&["eval", spec, "inverse_dynamics", "--states", &file]);
    let said = format!("{}{}", run.stdout, run.stderr);
    assert!(
        said.contains("`distal1_angle` does not follow the actuated joints"),
        "{said}"
    );
    let value = |method: &str, file: &str| -> Value {
        let run = bgdyn(&["eval", spec, method, "--states", file]).good();
        serde_json::from_str(&run).expect("JSON")
    };
    let moved = value("forward_dynamics", &file);
    assert_eq!(moved["results"][0].as_array().map(Vec::len), Some(2));
    let closed = [2.0, -1.269858316944471, 1.1, 1.293970919622041];
    let file = scratch("loops_actuated", "regular.json", states(closed));
    for method in ["inverse_dynamics", "reduced_inverse_dynamics"] {
        let efforts = value(method, &file);
        assert_eq!(efforts["results"][0].as_array().map(Vec::len), Some(2));
    }
}
