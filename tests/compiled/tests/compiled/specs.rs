//! Checks the compiled models: their text is reproducible, and trees of every kind occur.

use std::path::Path;

use bgdyn_codegen::mechanism::{Link, Motion, Value};
use bgdyn_runtime::Dd;

use crate::agreement::{generated, motions};
use crate::generate;

/// Longer texts take too long to be formatted.
const LENGTH: usize = 100_000;

/// The build script's process and this process write the same bytes.
#[test]
fn equal_specs_give_equal_text() {
    for compiled in compiled::all::<f64>() {
        let origin = compiled.origin();
        if origin.source.len() > LENGTH {
            continue;
        }
        let again = generate::source(Path::new(origin.spec), origin.derivatives);
        assert!(again == origin.source, "{}", origin.name);
    }
}

#[test]
fn the_trees_are_of_every_kind() {
    let (mut trees, mut branching, mut sliding, mut fixed, mut massless, mut skew) =
        (0, 0, 0, 0, 0, 0);
    let mut longest = 0;
    for compiled in compiled::all::<f64>() {
        if !compiled.origin().name.starts_with("tree_") {
            continue;
        }
        let model = generated(&*compiled);
        let links = model.mechanism.links();
        trees += 1;
        longest = longest.max(model.mechanism.nv());
        let children = |p: usize| {
            links
                .iter()
                .filter(move |l| l.parent.is_some_and(|q| q.0 == p))
        };
        let some = |yes: bool| usize::from(yes);
        branching += some((0..links.len()).any(|p| children(p).count() > 1));
        let slides = |m: &Motion| *m == Motion::Translation;
        sliding += some(motions(&model).iter().any(slides));
        fixed += some(links.iter().any(|l| l.joint.coordinate.is_none()));
        massless += some(
            links
                .iter()
                .any(|l| l.inertial.mass == Value::Fixed(Dd::ZERO)),
        );
        let leans = |l: &&Link| l.joint.axis.0.iter().all(|&x| x != Dd::ZERO);
        skew += some(links.iter().any(|l| leans(&l)));
    }
    assert!(trees >= 20 && longest == 12, "{trees}, {longest}");
    let kinds = [branching, sliding, fixed, massless, skew];
    assert!(kinds.iter().all(|&n| n >= 5), "{kinds:?}");
}
