//! Contact problems from Jacobians of bodies.

use bgdyn_sim::Real;
use bgdyn_sim::cone::{ContactOptions, ContactOutcome, ContactProblem, solve};

/// A problem that owns its numbers.
#[derive(Clone)]
pub struct Owned<T, const K: usize> {
    pub delassus: Box<[[[[T; 3]; 3]; K]; K]>,
    pub velocities: [[T; 3]; K],
    pub friction: [T; K],
    pub active: [bool; K],
}

impl<T: Real, const K: usize> Owned<T, K> {
    pub fn problem(&self) -> ContactProblem<'_, T, K> {
        ContactProblem {
            delassus: &self.delassus,
            velocities: &self.velocities,
            friction: &self.friction,
            active: &self.active,
        }
    }

    /// Solves with the default options, from the given impulses.
    pub fn solve(&self, impulses: &mut [[T; 3]; K]) -> ContactOutcome<T> {
        solve(&self.problem(), &ContactOptions::default(), impulses)
    }

    /// Returns the solution from 0, which is found.
    pub fn solved(&self) -> [[T; 3]; K] {
        let mut impulses = [[T::from_f64(0.0); 3]; K];
        let outcome = self.solve(&mut impulses);
        assert!(outcome.solved, "{outcome:?}");
        impulses
    }

    /// Returns the velocities after the impulses, in `f64`.
    pub fn after(&self, p: &[[T; 3]; K]) -> [[f64; 3]; K] {
        std::array::from_fn(|c| {
            std::array::from_fn(|i| {
                let parts = (0..K).filter(|&d| self.active[d]).flat_map(|d| {
                    (0..3).map(move |j| self.delassus[c][d][i][j].to_f64() * p[d][j].to_f64())
                });
                self.velocities[c][i].to_f64() + parts.sum::<f64>()
            })
        })
    }
}

impl<const K: usize> Owned<f64, K> {
    /// Returns G = J M⁻¹ Jᵀ and b = J v, for the rows (x, y, z) of each contact and the inverse of a diagonal mass matrix.
    pub fn new(rows: &[Vec<f64>], inverse: &[f64], v: &[f64], friction: [f64; K]) -> Self {
        let mut delassus = Box::new([[[[0.0; 3]; 3]; K]; K]);
        let mut velocities = [[0.0; 3]; K];
        for (c, i) in (0..K).flat_map(|c| (0..3).map(move |i| (c, i))) {
            let row = &rows[3 * c + i];
            velocities[c][i] = row.iter().zip(v).map(|(j, v)| j * v).sum();
            for (d, j) in (0..K).flat_map(|d| (0..3).map(move |j| (d, j))) {
                let terms = row.iter().zip(&rows[3 * d + j]).zip(inverse);
                delassus[c][d][i][j] = terms.map(|((a, b), w)| a * b * w).sum();
            }
        }
        Owned {
            delassus,
            velocities,
            friction,
            active: [true; K],
        }
    }

    /// Returns the same problem in `f32`.
    pub fn rounded(&self) -> Owned<f32, K> {
        Owned {
            delassus: Box::new(
                self.delassus
                    .map(|row| row.map(|b| b.map(|r| r.map(|x| x as f32)))),
            ),
            velocities: self.velocities.map(|v| v.map(|x| x as f32)),
            friction: self.friction.map(|x| x as f32),
            active: self.active,
        }
    }
}

/// Adds the velocity of the point r of a body, of the components (v, ω) at its centre, to rows of a contact along x, y, z.
pub fn add_point(rows: &mut [Vec<f64>], body: usize, r: [f64; 3], sign: f64) {
    for (i, row) in rows.iter_mut().enumerate() {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        row[6 * body + i] += sign;
        row[6 * body + 3 + j] += sign * r[k];
        row[6 * body + 3 + k] -= sign * r[j];
    }
}

/// Random numbers: a linear congruential generator with mixed bits.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Random(seed)
    }

    /// Returns a number in −1 … 1.
    pub fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
        let mixed = (self.0 ^ (self.0 >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
        let mixed = mixed ^ (mixed >> 33);
        (mixed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub fn numbers(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.number()).collect()
    }

    /// Returns coefficients of friction in 0 … `most`.
    pub fn friction<const K: usize>(&mut self, most: f64) -> [f64; K] {
        std::array::from_fn(|_| 0.5 * most * (1.0 + self.number()))
    }

    /// Returns a problem with dense random rows for `n` velocities: G has full rank if n ≥ 3 K.
    pub fn dense<const K: usize>(&mut self, n: usize, most_friction: f64) -> Owned<f64, K> {
        let rows: Vec<Vec<f64>> = (0..3 * K).map(|_| self.numbers(n)).collect();
        let inverse: Vec<f64> = (0..n).map(|_| (1.5 * self.number()).exp()).collect();
        let (v, friction) = (self.numbers(n), self.friction(most_friction));
        Owned::new(&rows, &inverse, &v, friction)
    }

    /// Returns K/4 boxes on each other, with contacts at their four corners, that fall at 0.01 m/s and move at random up to
    /// `speed`.
    pub fn stack<const K: usize>(&mut self, speed: f64) -> Owned<f64, K> {
        let bodies = K.div_ceil(4);
        let half = [0.5, 0.4, 0.2 + 0.1 * self.number()];
        let mut rows = vec![vec![0.0; 6 * bodies]; 3 * K];
        for c in 0..K {
            let body = c / 4;
            let x = if c & 1 == 0 { half[0] } else { -half[0] };
            let y = if c & 2 == 0 { half[1] } else { -half[1] };
            add_point(&mut rows[3 * c..3 * c + 3], body, [x, y, -half[2]], 1.0);
            if body > 0 {
                add_point(&mut rows[3 * c..3 * c + 3], body - 1, [x, y, half[2]], -1.0);
            }
        }
        let inverse: Vec<f64> = (0..bodies)
            .flat_map(|_| inverse_of_box((0.8 * self.number()).exp(), half))
            .collect();
        let mut v: Vec<f64> = self
            .numbers(6 * bodies)
            .into_iter()
            .map(|x| speed * x)
            .collect();
        v.iter_mut().skip(2).step_by(6).for_each(|v| *v -= 0.01);
        let friction = self.friction(0.8);
        Owned::new(&rows, &inverse, &v, friction)
    }
}

/// Returns the reciprocals of mass and moments of inertia of a box, from its mass and half its edges.
pub fn inverse_of_box(mass: f64, [a, b, c]: [f64; 3]) -> [f64; 6] {
    let moment = |x: f64, y: f64| mass / 3.0 * (x * x + y * y);
    let moments = [moment(b, c), moment(a, c), moment(a, b)];
    [mass, mass, mass, moments[0], moments[1], moments[2]].map(|x| 1.0 / x)
}

/// Returns the largest magnitude of a component.
pub fn largest<const K: usize>(p: &[[f64; 3]; K]) -> f64 {
    p.as_flattened()
        .iter()
        .fold(0.0, |most, x| most.max(x.abs()))
}
