//! The Coriolis matrix, body by body.

use bgdyn_runtime::Dd;

use super::sum::LiteralSum;
use crate::expr::{Expr, Tangent};
use crate::formulation::arguments::{Arguments, BaseState};
use crate::formulation::joint_motion::{along, tangents};
use crate::math::{Mat3, Vec3, skew};

impl<'g> LiteralSum<'_, 'g> {
    /// Returns C, row by row, with bias = C v + gravity and Ṁ − 2C skew:
    ///
    /// C_jk = Σ_i [ ∂r_i/∂q_j · m_i d/dt(∂r_i/∂q_k) + ρ_j · (J_i ρ̇_k + B_i ρ_k) ],
    /// B = ½ ([ω]× J − J [ω]× − [J ω]×).
    ///
    /// For joints with q̇ = v it is the matrix of Christoffel's symbols.
    pub(super) fn coriolis_matrix(&self, x: &Arguments<'g>) -> Vec<Expr<'g>> {
        let v = &x.v;
        let n = self.graph.coordinates.len();
        let mut matrix = vec![self.b.zero(); n * n];
        let mut rate = Tangent::new(along(tangents(self.b, self.graph, v)));
        let mut rate_of = |m: &Vec3<Expr<'g>>| {
            m.map(|e| {
                let e = e.signed();
                self.b.expr(self.b.with_graph(|g| rate.of(g, e)))
            })
        };
        let mut add = |j: usize, k: usize, more: Expr<'g>| {
            matrix[j * n + k] = matrix[j * n + k] + more;
        };
        for i in 0..self.graph.frames.len() {
            let moduli = &self.moduli[i];
            let (mass, tensor) = (self.mass(i), self.tensor(i));
            for (k, y) in &moduli.linear {
                let force = rate_of(y).scale(mass);
                moduli
                    .linear
                    .iter()
                    .for_each(|(j, x)| add(*j, *k, x.dot(force)));
            }
            let omega = self.combine(&moduli.angular, v);
            let coupling = self.coupling(tensor, omega);
            for (k, y) in &moduli.angular {
                let moment = tensor * rate_of(y) + coupling * *y;
                moduli
                    .angular
                    .iter()
                    .for_each(|(j, x)| add(*j, *k, x.dot(moment)));
            }
            // A full rotor is a body that turns by N v_l e relative to the link, so that its momentum is
            // h v_l with h = N J e. The terms linear in N:
            for (l, h) in self.spinning(i) {
                let half = Dd::from_f64(0.5);
                let spun = skew(h, self.b.zero()).map(|x| x * v[l] * half);
                for (k, y) in &moduli.angular {
                    let moment = spun * *y;
                    moduli
                        .angular
                        .iter()
                        .for_each(|(j, x)| add(*j, *k, -x.dot(moment)));
                }
                let turning = omega.cross(h).map(|x| x * half);
                for (j, x) in &moduli.angular {
                    add(*j, l, x.dot(turning));
                    let rate = rate_of(x);
                    add(l, *j, h.dot(rate) + x.dot(turning));
                }
            }
        }
        if let Some(base) = &x.base {
            self.add_base(base, &mut matrix);
        }
        matrix
    }

    /// Adds the gyroscopic efforts of a turning base, a skew matrix. A scene, which is where rotors are, has no
    /// such base:
    ///
    /// G_jk = Σ_i [ ∂r_i/∂q_j · 2 m_i ω × ∂r_i/∂q_k + ρ_j · (J_i (ω × ρ_k) + ω × J_i ρ_k + ρ_k × J_i ω) ].
    fn add_base(&self, base: &BaseState<'g>, matrix: &mut [Expr<'g>]) {
        let n = self.graph.coordinates.len();
        let mut add = |j: usize, k: usize, more: Expr<'g>| {
            matrix[j * n + k] = matrix[j * n + k] + more;
        };
        let omega = base.omega;
        for (i, moduli) in self.moduli.iter().enumerate() {
            let (mass, tensor) = (self.mass(i), self.tensor(i));
            for (k, y) in &moduli.linear {
                let force = omega.cross(*y).scale(mass + mass);
                let linear = moduli.linear.iter();
                linear.for_each(|(j, x)| add(*j, *k, x.dot(force)));
            }
            for (k, y) in &moduli.angular {
                let moment =
                    tensor * omega.cross(*y) + omega.cross(tensor * *y) + y.cross(tensor * omega);
                let angular = moduli.angular.iter();
                angular.for_each(|(j, x)| add(*j, *k, x.dot(moment)));
            }
        }
    }

    /// Returns B = ½ ([ω]× J − J [ω]× − [J ω]×).
    fn coupling(&self, tensor: Mat3<Expr<'g>>, omega: Vec3<Expr<'g>>) -> Mat3<Expr<'g>> {
        let (half, zero) = (Dd::from_f64(0.5), self.b.zero());
        let turning = skew(omega, zero);
        let whole = turning * tensor - tensor * turning - skew(tensor * omega, zero);
        whole.map(|x| x * half)
    }
}
