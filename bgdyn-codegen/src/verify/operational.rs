//! Checks operational space against the literal forward dynamics and Jacobian.

use bgdyn_runtime::Dd;

use super::compare::{SizedLaw, largest, minus, plus, times};
use crate::expr::Inputs;
use crate::function::Function;
use crate::method::{Method, Operational, Shape};
use crate::random::Random;

/// The functions by equation (6), at a state.
struct LiteralTask<'a> {
    forward: Function,
    jacobian: Vec<Dd>,
    jacobian_dot_v: Vec<Dd>,
    at: &'a Inputs<Dd>,
}

impl LiteralTask<'_> {
    fn is_regular(&self) -> bool {
        self.forward.evaluate(self.at.clone()).1.is_none()
    }

    fn accelerations(&self, efforts: &[Dd]) -> Vec<Dd> {
        let inputs = Inputs {
            u: efforts.to_vec(),
            ..self.at.clone()
        };
        self.forward.evaluate(inputs).0
    }

    /// Returns M⁻¹ f.
    fn solved(&self, efforts: &[Dd]) -> Vec<Dd> {
        let none = vec![Dd::ZERO; efforts.len()];
        minus(&self.accelerations(efforts), &self.accelerations(&none))
    }

    /// Returns Jᵀ w.
    fn efforts_of(&self, wrench: &[Dd]) -> Vec<Dd> {
        let n = self.at.v.len();
        let rows = self.jacobian.chunks(n.max(1)).zip(wrench);
        rows.fold(vec![Dd::ZERO; n], |sum, (row, &w)| {
            let own: Vec<Dd> = row.iter().map(|&x| x * w).collect();
            plus(&sum, &own)
        })
    }

    /// Returns Λ⁻¹ w.
    fn inverse_inertia(&self, wrench: &[Dd]) -> Vec<Dd> {
        times(&self.jacobian, &self.solved(&self.efforts_of(wrench)))
    }
}

/// Returns the law of a method of operational space; none where the literal mass matrix is singular, as that of a branch may
/// be that does not move the frame.
pub(super) fn law(
    form: &dyn Fn(Method) -> Option<Function>,
    of: Operational,
    (at, found): (&Inputs<Dd>, &[Dd]),
) -> Option<SizedLaw> {
    let n = at.v.len();
    let (_, entries) = found.split_at(n);
    let value = |method| Some(form(method)?.evaluate(at.clone()).0);
    let (jacobian, jacobian_dot_v) = match of.site() {
        None => Default::default(),
        Some(site) => (
            value(Method::Jacobian(site))?,
            value(Method::JacobianDotV(site))?,
        ),
    };
    let literal = LiteralTask {
        forward: form(Method::ForwardDynamics)?,
        jacobian,
        jacobian_dot_v,
        at,
    };
    literal.is_regular().then_some(())?;
    let mut random = Random(31);
    let mut any = |n: usize| -> Vec<Dd> {
        let number = |_| Dd::from_f64(random.signed());
        (0..n).map(number).collect()
    };
    let Shape::Checked(shape) = Method::Operational(of).shape() else {
        return None;
    };
    let entries = shape.spread(entries, n);
    Some(match of {
        Operational::InverseMassMatrix => {
            let f = any(n);
            let text = "M⁻¹ f = q̈(f) − q̈(0)";
            (text, times(&entries, &f), literal.solved(&f), 0.0)
        }
        Operational::InverseInertia(_) => {
            let w = any(6);
            let expected = literal.inverse_inertia(&w);
            (
                "Λ⁻¹ w = J (q̈(Jᵀ w) − q̈(0))",
                times(&entries, &w),
                expected,
                0.0,
            )
        }
        Operational::Inertia(_) => {
            let w = any(6);
            let moved = literal.inverse_inertia(&w);
            (
                "Λ J (q̈(Jᵀ w) − q̈(0)) = w",
                times(&entries, &moved),
                w,
                largest(&entries) * largest(&moved),
            )
        }
        Operational::ConsistentInverse(_) => {
            let w = any(6);
            let moved = times(&entries, &literal.inverse_inertia(&w));
            let expected = literal.solved(&literal.efforts_of(&w));
            ("J̄ Λ⁻¹ w = M⁻¹ Jᵀ w", moved, expected, 0.0)
        }
        Operational::Bias(_) => {
            let free = literal.accelerations(&vec![Dd::ZERO; n]);
            let expected = plus(&times(&literal.jacobian, &free), &literal.jacobian_dot_v);
            let moved = literal.inverse_inertia(&entries);
            let sum = plus(&moved, &expected);
            let size = largest(&moved).max(largest(&literal.jacobian_dot_v));
            ("Λ⁻¹ μ + J q̈(0) + J̇ v = 0", sum, vec![Dd::ZERO; 6], size)
        }
    })
}
