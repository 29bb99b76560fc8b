//! Centroidal methods by their definitions, with the bodies of equation (6) in fixed axes.
//!
//! With the masses m_i, the centres of mass r_i, and the tensors J_i = A_i J_i⁰ A_iᵀ of all links that can move:
//!
//! c = Σ m_i r_i / Σ m_i, ċ = Σ m_i ∂r_i/∂q v / Σ m_i,
//! A_g v = [ Σ J_i ω_i + (r_i − c) × m_i ṙ_i; Σ m_i ṙ_i ], and its rate at q̈ = 0
//! Ȧ_g v = [ Σ K̇_i + (r_i − c) × m_i r̈_i; Σ m_i r̈_i ].

use super::sum::LiteralSum;
use crate::expr::{Builder, Expr, Tangent};
use crate::formulation::arguments::Arguments;
use crate::formulation::joint_motion::{along, tangents};
use crate::math::Vec3;
use crate::method::Centroidal;

impl<'g> LiteralSum<'_, 'g> {
    /// Returns the results of a centroidal method.
    pub(super) fn centroidal(&self, of: Centroidal, x: &Arguments<'g>) -> Vec<Expr<'g>> {
        match of {
            Centroidal::Centre => self.centre_of_mass().0.to_vec(),
            Centroidal::Jacobian => self.com_jacobian(),
            Centroidal::Map => rows(&self.momentum_columns()),
            Centroidal::Momentum => {
                let columns = self.momentum_columns().into_iter().zip(&x.v);
                let zero = [self.b.zero(); 6];
                let sum = columns.fold(zero, |sum, (column, &rate)| {
                    std::array::from_fn(|i| sum[i] + column[i] * rate)
                });
                sum.to_vec()
            }
            Centroidal::Bias => self.momentum_rate(x),
        }
    }

    /// Returns Σ m_i over the links that can move.
    fn total_mass(&self) -> Expr<'g> {
        let links = self.graph.links_that_move().into_iter();
        links.fold(self.b.zero(), |sum, link| sum + self.mass(link.0))
    }

    /// Returns c.
    fn centre_of_mass(&self) -> Vec3<Expr<'g>> {
        let links = self.graph.links_that_move().into_iter();
        let first = links.fold(self.zero(), |sum, link| {
            sum + self.positions[link.0].scale(self.mass(link.0))
        });
        let total = self.total_mass();
        first.map(|x| x / total)
    }

    /// Returns ∂c/∂q, row by row.
    fn com_jacobian(&self) -> Vec<Expr<'g>> {
        let mut columns = vec![self.zero(); self.graph.coordinates.len()];
        for (i, moduli) in self.moduli.iter().enumerate() {
            for (j, m) in &moduli.linear {
                columns[*j] = columns[*j] + m.scale(self.mass(i));
            }
        }
        let total = self.total_mass();
        let columns = columns
            .into_iter()
            .map(|column| column.map(|x| x / total).0);
        rows(&columns.collect::<Vec<_>>())
    }

    /// Returns the momentum about c per unit of each velocity: its angular part, then its linear one.
    fn momentum_columns(&self) -> Vec<[Expr<'g>; 6]> {
        let none = (self.zero(), self.zero());
        let mut columns = vec![none; self.graph.coordinates.len()];
        let centre = self.centre_of_mass();
        for (i, moduli) in self.moduli.iter().enumerate() {
            let (mass, tensor) = (self.mass(i), self.tensor(i));
            for (j, m) in &moduli.linear {
                let (angular, linear) = &mut columns[*j];
                let momentum = m.scale(mass);
                *angular = *angular + (self.positions[i] - centre).cross(momentum);
                *linear = *linear + momentum;
            }
            for (j, rho) in &moduli.angular {
                columns[*j].0 = columns[*j].0 + tensor * *rho;
            }
            for (j, h) in self.spinning(i) {
                columns[j].0 = columns[j].0 + h;
            }
        }
        columns.into_iter().map(spatial).collect()
    }

    /// Returns the rate of the momentum about c: the loads on the links without gravity.
    fn momentum_rate(&self, x: &Arguments<'g>) -> Vec<Expr<'g>> {
        let centre = self.centre_of_mass();
        let none = (self.zero(), self.zero());
        let loads = self.link_loads(x).zip(&self.positions);
        let whole = loads.fold(none, |(angular, linear), (load, &r)| {
            let moment = load.moment + (r - centre).cross(load.force);
            (angular + moment, linear + load.force)
        });
        spatial(whole).to_vec()
    }

    /// Returns the rate of the lower triangle of M along the velocities.
    pub(super) fn mass_matrix_rate(&self, v: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let b: &'g Builder = self.b;
        let mut rate = Tangent::new(along(tangents(b, self.graph, v)));
        let entries = self.mass_matrix().into_iter().flatten();
        entries
            .map(|e| {
                let e = e.signed();
                b.expr(b.with_graph(|g| rate.of(g, e)))
            })
            .collect()
    }
}

fn spatial<'g>((angular, linear): (Vec3<Expr<'g>>, Vec3<Expr<'g>>)) -> [Expr<'g>; 6] {
    let ([ax, ay, az], [lx, ly, lz]) = (angular.0, linear.0);
    [ax, ay, az, lx, ly, lz]
}

/// Returns the matrix with these columns, row by row.
fn rows<'g, const N: usize>(columns: &[[Expr<'g>; N]]) -> Vec<Expr<'g>> {
    let rows = 0..N;
    rows.flat_map(|i| columns.iter().map(move |column| column[i]))
        .collect()
}
