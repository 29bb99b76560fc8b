//! The Coriolis matrix: bias = C v + gravity, and Ṁ − 2C skew.
//!
//! Composite bodies as for the mass matrix, with B = ½ ([v]×* I + [I v] − I [v]×) for each body, where
//! [I v] s = s ×* (I v) (Echeandia and Wensing 2021). The columns s_k are constant in link axes, so their
//! rates are ṡ_k = v × s_k. For joints with q̇ = v this is the matrix of Christoffel's symbols; for
//! quasi-velocities Ṁ − 2C is skew as well, with Ṁ the rate of M along the motion.

use bgdyn_runtime::Dd;

use super::bodies::Bodies;
use super::spatial::{Spatial, SpatialMatrix, diagonal};
use crate::expr::Expr;
use crate::formulation::arguments::{Arguments, BaseState};
use crate::math::{Mat3, Vec3, skew};

impl<'g> Bodies<'_, 'g> {
    /// Returns C(q, v), row by row.
    pub(super) fn coriolis_matrix(&self, x: &Arguments<'g>) -> Vec<Expr<'g>> {
        let v = &x.v;
        let carried = x.base.map(|base| self.carried_twists(&base));
        let n = self.graph.coordinates.len();
        let mut matrix = vec![self.b.zero(); n * n];
        let twists = self.twists(v);
        let (mut inertias, mut couplings) = (Vec::new(), Vec::new());
        for (i, twist) in twists.iter().enumerate() {
            let inertia = self.inertia_block(i);
            let mut coupling = self.coupling(&inertia, *twist);
            let [[angular, _], _] = &mut coupling.0;
            for &(j, h) in &self.bodies[i].rotors {
                let half = v[j] * Dd::from_f64(-0.5);
                *angular = *angular + skew(h, self.b.zero()).map(|x| x * half);
            }
            if let Some(carried) = &carried {
                coupling = coupling.plus(&self.gyroscopic(&inertia, carried[i]));
            }
            couplings.push(coupling);
            inertias.push(inertia);
        }
        for i in (0..self.bodies.len()).rev() {
            self.rows_of(i, &twists, (&inertias[i], &couplings[i]), &mut matrix);
            let body = &self.bodies[i];
            if let Some(p) = body.parent {
                let fixed = body.fixed.map(|x| self.b.constant(x));
                let moved = |block: &SpatialMatrix<'g>| {
                    block
                        .turned(body.turned)
                        .turned(fixed)
                        .shifted(self.b, body.position)
                };
                inertias[p] = inertias[p].plus(&moved(&inertias[i]));
                couplings[p] = couplings[p].plus(&moved(&couplings[i]));
            }
        }
        self.add_rotors(&twists, &mut matrix);
        matrix
    }

    /// Returns the twist of each body for the angular velocity of the base alone, in the body's axes.
    fn carried_twists(&self, base: &BaseState<'g>) -> Vec<Spatial<'g>> {
        let zero = Vec3([self.b.zero(); 3]);
        let mut twists: Vec<Spatial<'g>> = Vec::new();
        for body in &self.bodies {
            let (angular, linear) = match body.parent {
                None if body.given => (base.omega, zero),
                None => (zero, zero),
                Some(p) => (twists[p].0, twists[p].1 + twists[p].0.cross(body.position)),
            };
            twists.push((body.outward(self.b, angular), body.outward(self.b, linear)));
        }
        twists
    }

    /// Returns [v]×* I + [I v] + I [v]× for the twist of a body with the base: a skew matrix, that of the
    /// gyroscopic wrenches. A scene, which is where rotors are, has no such base.
    fn gyroscopic(&self, inertia: &SpatialMatrix<'g>, twist: Spatial<'g>) -> SpatialMatrix<'g> {
        let [left, middle, right] = self.products(inertia, twist);
        left.plus(&middle).plus(&right)
    }

    /// Returns the entries of body i's columns with themselves and with those of the bodies that carry it.
    fn rows_of(
        &self,
        i: usize,
        twists: &[Spatial<'g>],
        (inertia, coupling): (&SpatialMatrix<'g>, &SpatialMatrix<'g>),
        matrix: &mut [Expr<'g>],
    ) {
        let n = self.graph.coordinates.len();
        for (j, column) in &self.bodies[i].columns {
            let s = (column.angular, column.linear);
            let rate = cross_motion(twists[i], s);
            // I ṡ + B s, I s and Bᵀ s, moved along the path to the base
            let (inertial, coupled) = (inertia.times(rate), coupling.times(s));
            let mut forward = (inertial.0 + coupled.0, inertial.1 + coupled.1);
            let mut momentum = inertia.times(s);
            let mut back = coupling.transposed_times(s);
            let mut at = i;
            loop {
                for (k, other) in &self.bodies[at].columns {
                    let s = (other.angular, other.linear);
                    let rate = cross_motion(twists[at], s);
                    add(matrix, k * n + j, dot(s, forward));
                    if at != i {
                        add(matrix, j * n + k, dot(rate, momentum) + dot(s, back));
                    }
                }
                let body = &self.bodies[at];
                let Some(p) = body.parent else { break };
                let inward = |(moment, force): Spatial<'g>| {
                    let force = body.inward(self.b, force);
                    let moment = body.inward(self.b, moment) + body.position.cross(force);
                    (moment, force)
                };
                (forward, momentum, back) = (inward(forward), inward(momentum), inward(back));
                at = p;
            }
        }
    }

    /// Adds the full rotors: with h = N J e on its carrier, column j gets ½ ω × h along the columns that
    /// move the carrier, row j gets h · ṡ and ½ ω × h along them. The coupling of the carrier has −½ v_j [h]×.
    fn add_rotors(&self, twists: &[Spatial<'g>], matrix: &mut [Expr<'g>]) {
        let n = self.graph.coordinates.len();
        let zero = Vec3([self.b.zero(); 3]);
        for (i, carrier) in self.bodies.iter().enumerate() {
            for &(j, h) in &carrier.rotors {
                let half = Dd::from_f64(0.5);
                let mut moment = (twists[i].0.cross(h).map(|x| x * half), zero);
                let mut momentum = (h, zero);
                let mut at = i;
                loop {
                    let body = &self.bodies[at];
                    for (k, column) in &body.columns {
                        let s = (column.angular, column.linear);
                        add(matrix, k * n + j, dot(s, moment));
                        let rate = cross_motion(twists[at], s);
                        add(matrix, j * n + k, dot(rate, momentum) + dot(s, moment));
                    }
                    let Some(p) = body.parent else { break };
                    moment.0 = body.inward(self.b, moment.0);
                    momentum.0 = body.inward(self.b, momentum.0);
                    at = p;
                }
            }
        }
    }

    /// Returns [J, [h]×; −[h]×, m 1] of a body.
    fn inertia_block(&self, i: usize) -> SpatialMatrix<'g> {
        let inertia = &self.bodies[i].inertia;
        let d = inertia.pseudo;
        let trace = d.0[0][0] + d.0[1][1] + d.0[2][2];
        let tensor = diagonal(self.b, trace) - d;
        let first = skew(inertia.first, self.b.zero());
        let minus = first.map(|x| -x);
        SpatialMatrix([[tensor, first], [minus, diagonal(self.b, inertia.mass)]])
    }

    /// Returns B = ½ ([v]×* I + [I v] − I [v]×).
    fn coupling(&self, inertia: &SpatialMatrix<'g>, twist: Spatial<'g>) -> SpatialMatrix<'g> {
        let [left, middle, right] = self.products(inertia, twist).map(|product| product.0);
        let half = Dd::from_f64(0.5);
        let entry =
            |i: usize, j: usize| (left[i][j] + middle[i][j] - right[i][j]).map(|x| x * half);
        SpatialMatrix([[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]])
    }

    /// Returns [v]×* I, [I v] and I [v]×, with [v]×* = [ω, v; 0, ω], [v]× = [ω, 0; v, ω] and
    /// s ×* (n, f) = (ω × n + v × f, ω × f).
    fn products(&self, inertia: &SpatialMatrix<'g>, twist: Spatial<'g>) -> [SpatialMatrix<'g>; 3] {
        let zero = Mat3([[self.b.zero(); 3]; 3]);
        let cross = |v: Vec3<Expr<'g>>| skew(v, self.b.zero());
        let (w, v) = (cross(twist.0), cross(twist.1));
        let (moment, force) = inertia.times(twist);
        let (n, f) = (cross(-moment), cross(-force));
        let [[a, c], [d, e]] = inertia.0;
        [
            SpatialMatrix([[w * a + v * d, w * c + v * e], [w * d, w * e]]),
            SpatialMatrix([[n, f], [f, zero]]),
            SpatialMatrix([[a * w + c * v, c * w], [d * w + e * v, e * w]]),
        ]
    }
}

/// Returns v × s of two motions.
fn cross_motion<'g>(v: Spatial<'g>, s: Spatial<'g>) -> Spatial<'g> {
    (v.0.cross(s.0), v.0.cross(s.1) + v.1.cross(s.0))
}

fn dot<'g>(a: Spatial<'g>, b: Spatial<'g>) -> Expr<'g> {
    a.0.dot(b.0) + a.1.dot(b.1)
}

fn add<'g>(matrix: &mut [Expr<'g>], index: usize, more: Expr<'g>) {
    matrix[index] = matrix[index] + more;
}
