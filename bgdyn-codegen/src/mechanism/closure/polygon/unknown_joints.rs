//! The form of a polygon's unknown joints.

use bgdyn_runtime::Dd;

use super::plane_chain::{Arc, ChainMotion, PlaneChain};
use super::shape::{LEAST, PolygonForm, PolygonSide, TurnedVector};
use super::vectors::{conjugate, length, negated, plus, times};

/// The unknown joints; with a slide beside the known arc, before or after it, also the rigid arc that turns with it.
pub(super) enum FoundForm {
    Whole(PolygonForm),
    Slide {
        before: bool,
        form: PolygonForm,
        last: PolygonSide,
    },
}

/// Returns the form of the unknown joints: the steps i and j and the closing pin.
pub(super) fn form(
    chain: &PlaneChain,
    [i, j]: [usize; 2],
    (arcs, known): (&[Arc; 3], usize),
) -> Option<FoundForm> {
    let rigid = |arc: &Arc| TurnedVector {
        angle: chain.angle(arc.link),
        vector: (arc.sides.iter()).fold([Dd::ZERO; 2], |sum, side| plus(sum, side.turned.vector)),
    };
    let (next, last) = (rigid(&arcs[(known + 1) % 3]), rigid(&arcs[(known + 2) % 3]));
    let joints = [i, j].map(|k| chain.steps[k].joint());
    let [Some(first_joint), Some(second_joint)] = joints else {
        return None;
    };
    let slides = [i, j].map(|k| match chain.steps[k] {
        ChainMotion::Slide(joint, direction) => Some((joint, direction)),
        _ => None,
    });
    let long = |turned: &TurnedVector| length(turned.vector).to_f64() > LEAST;
    let (slide, direction, pin, at) = match slides {
        [None, None] => {
            let (first, second) = (last.negated(), next);
            let pins = [first_joint, second_joint];
            let form = PolygonForm::Triangle {
                first,
                second,
                pins,
            };
            let PolygonForm::Triangle { first, second, .. } = &form else {
                return None;
            };
            return (long(first) && long(second)).then_some(FoundForm::Whole(form));
        }
        // The unknown joints in their order along the polygon: the closing pin, step i, step j.
        [Some((slide, direction)), None] => (slide, direction, second_joint, 1),
        [None, Some((slide, direction))] => (slide, direction, first_joint, 2),
        [Some(_), Some(_)] => return None,
    };
    let unit = direction.map(|x| x / length(direction));
    if at == (known + 2) % 3 {
        let whole = times(plus(next.vector, last.vector), conjugate(unit));
        let along = TurnedVector {
            angle: next.angle,
            vector: negated(unit),
        };
        let [start, across] = whole;
        return Some(FoundForm::Whole(PolygonForm::Cylinder {
            along,
            start,
            across,
            pin,
            slide,
        }));
    }
    // A slide after the known arc: arm = D + (next + x · unit), one before it: arm = −(D + last + x · unit).
    let before = at == known;
    let (arm, turning) = if before {
        (next, last)
    } else {
        (last.negated(), next)
    };
    let along = TurnedVector {
        angle: turning.angle.clone(),
        vector: if before { negated(unit) } else { unit },
    };
    let last = PolygonSide {
        turned: turning,
        slide: None,
    };
    let found = FoundForm::Slide {
        before,
        last,
        form: PolygonForm::Slider {
            arm: arm.clone(),
            along,
            pin,
            slide,
        },
    };
    long(&arm).then_some(found)
}
