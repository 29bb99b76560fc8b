//! How long impacts at compliant contacts last.

use super::SceneEquations;
use super::rigid_contacts::directions;
use crate::expr::Builder;
use crate::method::ContactMethod;

/// The speed of the impacts, m/s.
const SPEED: f64 = 1.0;

/// The duration of an impact at a compliant contact, which steps must resolve.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactTime {
    /// The effect at the contact.
    pub name: String,
    /// The mass that takes part at the start of the scene, 1/(n·J M⁻¹ Jᵀ n), kg.
    pub mass: f64,
    /// The duration of a free impact of it at 1 m/s without damping, s: π √(m/k), or with Hertz's law 3.218 (m²/(k² v))^{1/5}
    /// (Johnson 1985, section 11.4).
    pub seconds: f64,
}

impl SceneEquations {
    /// Returns the durations of impacts at compliant contacts, in the order of the effects. A contact that no velocity of
    /// the scene moves is left out.
    pub fn contact_times(&self) -> Vec<ContactTime> {
        let b = Builder::silent();
        let sums = self.effort_sums(&b);
        let springs = sums.contact_springs();
        if springs.is_empty() {
            return vec![];
        }
        let n = self.graph.coordinates.len();
        let jacobian = sums.of_contacts(ContactMethod::Jacobian);
        // As many numbers as there are coordinates come before the matrix.
        let response = sums.of_contacts(ContactMethod::Response).split_off(n);
        let width = jacobian.len() / n;
        let times = springs.iter().filter_map(|spring| {
            let normal = directions(spring.contact).end - 1;
            let along = (0..n).map(|j| jacobian[normal * n + j] * response[j * width + normal]);
            let inverse = along.fold(b.zero(), |sum, x| sum + x);
            let [inverse, stiffness] =
                [inverse, spring.stiffness].map(|x| sums.at_start(x, &self.initial).to_f64());
            let mass = 1.0 / inverse;
            let seconds = match spring.hertz {
                true => 3.218 * (mass * mass / (stiffness * stiffness * SPEED)).powf(0.2),
                false => std::f64::consts::PI * (mass / stiffness).sqrt(),
            };
            let name = self.scene.elements[spring.element].name.clone();
            let time = ContactTime {
                name,
                mass,
                seconds,
            };
            (inverse > 0.0).then_some(time)
        });
        times.collect()
    }
}
