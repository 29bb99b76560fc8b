//! A cache of regrouped inertia.
//!
//! Without run-time parameters it is numerical, and the same for every method and for all plans with the same
//! origins.

use std::cell::{OnceCell, RefCell};
use std::rc::Rc;

use bgdyn_runtime::Dd;

use crate::math::Vec3;
use crate::mechanism::LinkId;

/// The links that each number of a body contains, in the order of [`Numbers::bodies`].
pub(super) type Contents = [Vec<LinkId>; 11];

/// The cached results.
#[derive(Default)]
pub(super) struct BaseParameterCache(RefCell<Vec<Rc<Numbers>>>);

/// The inertia of the bodies for one choice of origins.
pub(super) struct Numbers {
    /// Displacement of each body's origin along its joint's axis, m.
    pub slides: Vec<Dd>,
    /// Whether inertia is regrouped.
    pub base_parameters: bool,
    /// Mass, axial mass, first moment and pseudo-inertia of each body about its origin.
    pub bodies: Vec<[Dd; 11]>,
    /// Potential energy that does not depend on q, J.
    pub energy: Dd,
    /// For each body on the base the first moment that was moved to the base, about the body's origin in base axes, kg·m.
    pub on_base: Vec<Vec3<Dd>>,
    /// The contents of each body's numbers, once a reader has asked for them.
    pub contents: OnceCell<Rc<[Contents]>>,
}

impl BaseParameterCache {
    /// Returns the result for these origins, if it is cached.
    pub fn find(&self, slides: &[Dd], base_parameters: bool) -> Option<Rc<Numbers>> {
        let all = self.0.borrow();
        let mut all = all.iter();
        all.find(|known| known.base_parameters == base_parameters && known.slides == slides)
            .cloned()
    }

    /// Stores a result.
    pub fn keep(&self, numbers: Numbers) {
        self.0.borrow_mut().push(Rc::new(numbers));
    }
}
