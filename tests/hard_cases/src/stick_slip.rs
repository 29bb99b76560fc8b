//! Friction with sticking and slipping, with located events.

use bgdyn_sim::{Dop853, Rodas4, Run, ScenePlant};

use crate::follow::{alike, of, relative};
use crate::outcome::{Deviation, Outcome};
use crate::reference::reference;
use crate::{Extent, scenes};

/// A block with bristles, pulled by a spring: its law has a kink at zero velocity.
///
/// # Panics
/// If the run fails.
pub(crate) fn lugre_stick_slip(_: Extent) -> Vec<Outcome> {
    let reference = reference!("lugre_stick_slip");
    let scene = scenes::lugre_stick_slip::LugreStickSlip::<f64>::default();
    let (plant, begin) = (ScenePlant::with_slope(&scene), Run::begin(&scene));
    let run = Run::by(Rodas4, plant, begin).unaudited();
    let mut run = run.with_tolerance(relative(1e-9));
    let to = |&t: &f64| {
        run.step(t - run.t()).expect("it slides");
        *run.y()
    };
    let states: Vec<_> = reference.times.iter().map(to).collect();
    let deviations = reference.some(&["x"], &of(&states, |y| vec![y[0]]), 1e-7);
    let quantity = "place; rodas4 at 1e-9";
    vec![Outcome::worst(
        "lugre_stick_slip",
        "10",
        quantity,
        deviations,
    )]
}

/// A block on a moving belt, held by a spring: the times at which it breaks away and sticks again.
///
/// # Panics
/// If the run fails, or has a wrong number of events.
pub(crate) fn coulomb_stick_slip_belt(_: Extent) -> Vec<Outcome> {
    let wanted = reference!("coulomb_stick_slip_belt").invariants("event_times");
    let scene = scenes::stick_slip::StickSlip::<f64>::default();
    let mut run = Run::by(Dop853, ScenePlant::new(&scene), Run::begin(&scene)).unaudited();
    run = run.with_tolerance(alike(1e-12));
    let mut found = vec![];
    let end = wanted[wanted.len() - 1] + 0.1;
    while run.t() < end {
        run.advance_densely(end - run.t()).expect("it goes on");
        if run.events > found.len() {
            found.push(run.last_event);
        }
    }
    assert_eq!(found.len(), wanted.len(), "events until {end} s");
    let deviations = found.iter().zip(&wanted).map(|(t, wanted)| Deviation {
        t: *wanted,
        measured: (t - wanted).abs(),
        allowed: 1e-9,
    });
    let quantity = "instants of events, s; dop853 at 1e-12";
    let case = "coulomb_stick_slip_belt";
    vec![Outcome::worst(case, "10", quantity, deviations)]
}
