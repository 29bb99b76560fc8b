//! What no motion can do, and what is said of it.

use bgdyn_identification::Model;
use bgdyn_identification::excite::{Effort, Excitation, JointLimits, Keep, Noise, Request, excite};

use crate::pendulums::{Pendulums, SEARCH, above, limits, model, planned};

#[test]
fn what_cannot_be_kept_is_a_fault_with_its_numbers() {
    let faults = |limits: &[JointLimits], keeps: &[Keep]| {
        let faults = planned(limits, keeps, &SEARCH, None).expect_err("no motion");
        let texts: Vec<String> = faults.iter().map(ToString::to_string).collect();
        texts.join("\n")
    };
    let high = Keep {
        name: "tip.y>2".into(),
        level: 2.0,
        ..above()
    };
    let told = faults(&limits(None), &[high]);
    assert!(
        told.contains("[keep-not-met]") && told.contains("`--keep tip.y>2`"),
        "{told}"
    );
    assert!(
        told.contains("at least 1.") && told.contains("help: "),
        "{told}"
    );
    let bare = Model {
        links: vec![],
        columns: [false; 4],
        ..model()
    };
    let request = Request {
        limits: &limits(None),
        keeps: &[],
        points: &Pendulums,
        harmonics: 2,
        period: 1.0,
        effort: SEARCH,
        noise: Noise::Equal,
        prior: None,
    };
    let told = excite(&bare, &request, &mut |_| {}).expect_err("nothing to show");
    assert_eq!(told[0].rule, "nothing-excited");
    let narrow = limits(Some(0.5)).map(|l| JointLimits {
        position: [-0.1, 0.1],
        ..l
    });
    let told = faults(&narrow, &[]);
    assert!(
        told.contains("[effort-limit]") && told.contains("joint `shoulder`"),
        "{told}"
    );
}

#[test]
fn coulomb_friction_above_a_limit_is_a_fault_not_a_tiny_motion() {
    // The limit holds the bodies at rest near the vertical, but not friction of 0.3 N·m too.
    let tight = limits(Some(0.29)).map(|l| JointLimits {
        position: [-1.7, -1.4],
        ..l
    });
    let told = planned(&tight, &[], &SEARCH, None).expect_err("friction alone is too much");
    let strongest = told.iter().all(|fault| fault.rule == "effort-limit");
    assert!(strongest && told.len() == 2, "{told:?}");
    assert!(told[0].to_string().contains("Coulomb friction"), "{told:?}");
}

#[test]
fn motions_that_show_too_little_are_called_weak() {
    // Hardly any motion: base parameters cannot be told apart.
    let narrow = limits(None).map(|l| JointLimits {
        position: [-1e-3, 1e-3],
        ..l
    });
    let request = |limits| planned(limits, &[], &SEARCH, None);
    match request(&narrow) {
        Ok(found) => assert!(found.is_weak(), "{:?}", found.condition),
        Err(faults) => assert_eq!(faults[0].rule, "nothing-excited"),
    }
    let wide = request(&limits(None)).expect("a motion");
    assert!(!wide.is_weak(), "{:?}", wide.condition);
    assert!(wide.condition[2][0] < Excitation::WEAK);
}

#[test]
fn an_ascent_takes_no_more_steps_than_asked() {
    for steps in [0, 1, 2, 5] {
        let effort = Effort {
            steps,
            ascents: 1,
            ..SEARCH
        };
        let found = planned(&limits(None), &[], &effort, None).expect("a motion");
        assert!(found.steps() <= steps, "{} of {steps}", found.steps());
        assert_eq!(found.steps() == 0, steps == 0);
    }
}
