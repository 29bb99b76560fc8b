//! The bars of one state of a mechanism: errors of a subject, in a scalar, against a reference in
//! double-double at the same arguments, compared with their limits.

use bgdyn_runtime::{Dd, Scalar};
use nalgebra::DMatrix;

use super::State;

/// Scalars under test.
pub trait Digits: Scalar<Refused = Option<usize>> {
    /// The distance from 1 to the next number.
    const EPS: f64;
    /// Suffix of a case's name.
    const MARK: &'static str;
    /// Converts the number exactly.
    fn to_f64(self) -> f64;
}

impl Digits for f64 {
    const EPS: f64 = f64::EPSILON;
    const MARK: &'static str = "";
    fn to_f64(self) -> f64 {
        self
    }
}

impl Digits for f32 {
    const EPS: f64 = f32::EPSILON as f64;
    const MARK: &'static str = ", f32";
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
}

/// The methods under test of a mechanism, in the scalar T. Results are `f64`, matrices row by row.
pub trait Subject<T> {
    /// Joint efforts.
    fn inverse(&self, s: &State) -> Vec<f64>;
    /// The mass matrix.
    fn mass(&self, s: &State) -> Vec<f64>;
    /// Returns the accelerations; `None` if they are refused.
    fn forward(&self, s: &State) -> Option<Vec<f64>>;
}

/// The same methods in double-double: the reference.
pub trait Reference {
    /// Joint efforts.
    fn inverse(&self, s: &State) -> Vec<Dd>;
    /// The mass matrix.
    fn mass(&self, s: &State) -> Vec<Dd>;
    /// Efforts at zero accelerations.
    fn bias(&self, s: &State) -> Vec<Dd>;
    /// Efforts at rest.
    fn gravity(&self, s: &State) -> Vec<Dd>;
    /// Returns the accelerations if one position, velocity or effort (argument 0, 1, 2) is multiplied by a
    /// factor.
    fn forward_off(&self, s: &State, argument: usize, component: usize, factor: Dd) -> Vec<Dd>;
    /// Accelerations.
    fn forward(&self, s: &State) -> Vec<Dd> {
        self.forward_off(s, 0, 0, Dd::ONE)
    }
}

/// ‖x‖
pub fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// ‖x − y‖
pub fn apart(x: &[f64], y: &[f64]) -> f64 {
    let off: Vec<f64> = x.iter().zip(y).map(|(x, y)| x - y).collect();
    norm(&off)
}

/// Returns x − y, rounded.
pub fn off(x: &[f64], y: &[Dd]) -> Vec<f64> {
    x.iter()
        .zip(y)
        .map(|(&x, &y)| (Dd::from_f64(x) - y).to_f64())
        .collect()
}

/// Returns the nearest `f64`s.
pub fn rounded(x: &[Dd]) -> Vec<f64> {
    x.iter().map(|x| x.to_f64()).collect()
}

/// An error, with its limit.
#[derive(Clone, Debug)]
pub struct Found {
    /// The bar.
    pub bar: &'static str,
    /// The measured quantity.
    pub what: &'static str,
    /// The error.
    pub measured: f64,
    /// Its limit, by the applied reading of the bar.
    pub allowed: f64,
    /// The ratio of the error to the bar by its original reading; the ratio to `allowed` if both readings
    /// are equal.
    pub asked: f64,
}

impl Found {
    /// Returns an error and its bar, with equal readings.
    pub fn new(bar: &'static str, what: &'static str, measured: f64, allowed: f64) -> Self {
        Found {
            bar,
            what,
            measured,
            allowed,
            asked: part(measured, allowed),
        }
    }
}

/// Forward dynamics may refuse if 1/(cond M · eps) is at most this: M is singular within its rounding.
pub const SINGULAR: f64 = 1.0;

/// Returns the ratio of an error to its limit; 0 without an error.
pub fn part(measured: f64, allowed: f64) -> f64 {
    match measured {
        // If nothing acts on a joint, there is no error to compare.
        0.0 => 0.0,
        _ => (measured / allowed).abs(),
    }
}

/// One state of a mechanism with its norms.
#[derive(Debug)]
pub struct Hard {
    /// Number of velocities.
    pub n: usize,
    /// Arguments rounded to the scalar.
    pub state: State,
    /// M, row by row.
    pub mass: Vec<f64>,
    /// Bias force.
    pub bias: Vec<f64>,
    /// ‖M‖
    pub most: f64,
    /// ‖M⁻¹‖
    pub inverse: f64,
}

impl Hard {
    /// Returns the state with its arguments rounded to T. `cond` is the condition number of M, if it
    /// cannot be computed from M in `f64`.
    pub fn new<T: Digits>(reference: &impl Reference, state: &State, cond: Option<f64>) -> Self {
        let round = |x: &[f64]| x.iter().map(|&x| T::from_f64(x).to_f64()).collect();
        let state = State {
            q: round(&state.q),
            v: round(&state.v),
            a: round(&state.a),
            tau: round(&state.tau),
            parameters: state.parameters.clone(),
        };
        let n = state.v.len();
        let mass = rounded(&reference.mass(&state));
        let moments = DMatrix::from_row_slice(n, n, &mass).symmetric_eigenvalues();
        let most = moments.max();
        Hard {
            n,
            bias: rounded(&reference.bias(&state)),
            state,
            mass,
            most,
            inverse: cond.map_or(1.0 / moments.min(), |cond| cond / most),
        }
    }

    /// Returns Σ_j |M_ij||x_j| for each i.
    fn weighed(&self, x: &[f64]) -> Vec<f64> {
        let row = |row: &[f64]| row.iter().zip(x).map(|(m, x)| (m * x).abs()).sum();
        self.mass.chunks(self.n).map(row).collect()
    }

    /// Checks inverse dynamics: ‖τ − τ_ref‖ ≤ 32 eps (‖M q̈‖ + ‖c‖ + ‖g‖).
    pub fn inverse_dynamics<T: Digits>(
        &self,
        subject: &impl Subject<T>,
        reference: &impl Reference,
    ) -> Found {
        let s = &self.state;
        let exact = reference.inverse(s);
        let g = rounded(&reference.gravity(s));
        let moved = apart(&rounded(&exact), &self.bias);
        let size = moved + apart(&self.bias, &g) + norm(&g);
        let measured = norm(&off(&subject.inverse(s), &exact));
        Found::new("1", "inverse dynamics", measured, 32.0 * T::EPS * size)
    }

    /// Returns the change of inverse dynamics if each acceleration is rounded, by half an eps of itself:
    /// the sum of the columns of M times that.
    pub fn rounded_accelerations<T: Digits>(&self) -> f64 {
        let columns = self.state.a.iter().enumerate().map(|(j, a)| {
            let column: Vec<f64> = self.mass.iter().skip(j).step_by(self.n).copied().collect();
            T::EPS / 2.0 * a.abs() * norm(&column)
        });
        columns.sum()
    }

    /// Checks ‖M − M_ref‖ ≤ 8 n eps ‖M‖, and M = Mᵀ.
    pub fn mass_matrix<T: Digits>(
        &self,
        subject: &impl Subject<T>,
        reference: &impl Reference,
    ) -> Found {
        let (found, n) = (subject.mass(&self.state), self.n);
        let even = (0..n).all(|i| (0..i).all(|j| found[i * n + j] == found[j * n + i]));
        let error = norm(&off(&found, &reference.mass(&self.state)));
        let measured = if even { error } else { f64::INFINITY };
        let allowed = 8.0 * n as f64 * T::EPS * self.most;
        Found::new("4", "mass matrix", measured, allowed)
    }

    /// Checks the backward error of accelerations, joint by joint; returns that with the largest ratio to
    /// its limit.
    ///
    /// By the original reading, a joint's effort agrees to 8 n eps of its terms. By the applied reading,
    /// it agrees to its change due to rounding of each position and velocity, if that is larger: the
    /// accelerations are the exact ones of arguments that round to the same numbers.
    pub fn backward<T: Digits>(&self, found: &[f64], reference: &impl Reference) -> Found {
        let unmet = self.unmet::<T>(found, reference);
        let asked = unmet.iter().map(|&(error, bar)| part(error, bar));
        let asked = asked.fold(0.0, f64::max);
        // The applied reading only increases the limit: it is computed only if that decides.
        let changed = match asked > 1.0 {
            true => self.rounded_arguments::<T>(found, reference),
            false => vec![0.0; self.n],
        };
        let joints = unmet.iter().zip(changed);
        let joints = joints.map(|(&(error, bar), changed)| (error, changed.max(bar)));
        let worst = joints.max_by(|a, b| part(a.0, a.1).total_cmp(&part(b.0, b.1)));
        let (measured, allowed) = worst.expect("a joint");
        Found {
            asked,
            ..Found::new("2", "forward dynamics, efforts met", measured, allowed)
        }
    }

    /// Returns what rounding in double-double leaves of efforts that cancel: where no term of a joint's effort
    /// is left, the reference has no digit.
    fn noise(&self, found: &[f64]) -> f64 {
        let (s, n) = (&self.state, self.n as f64);
        let size = self.most * (norm(&s.v) * norm(&s.v) + norm(found)) + norm(&self.bias);
        8.0 * n * 4.93e-32 * (size + norm(&s.tau))
    }

    /// Returns the residual of each joint's effort, and 8 n eps of its terms.
    fn unmet<T: Digits>(&self, found: &[f64], reference: &impl Reference) -> Vec<(f64, f64)> {
        let s = &self.state;
        let moved = State {
            a: found.to_vec(),
            ..s.clone()
        };
        let met = off(&s.tau, &reference.inverse(&moved));
        let (terms, noise) = (self.weighed(found), self.noise(found));
        let joint = |i: usize| {
            let size = terms[i] + s.tau[i].abs() + self.bias[i].abs();
            let unmet = met[i].abs();
            // A NaN, and anything beside an infinite size, stays.
            let unmet = if unmet <= noise && noise.is_finite() {
                0.0
            } else {
                unmet
            };
            (unmet, 8.0 * self.n as f64 * T::EPS * size)
        };
        (0..self.n).map(joint).collect()
    }

    /// Returns the change of each effort of these accelerations if each position and velocity is rounded,
    /// by half an eps of itself: the sum over all of them.
    pub fn rounded_arguments<T: Digits>(
        &self,
        found: &[f64],
        reference: &impl Reference,
    ) -> Vec<f64> {
        // Much larger than the reference's rounding, much smaller than the curvature.
        const PART: f64 = 1.0 / (1u64 << 30) as f64;
        let at = State {
            a: found.to_vec(),
            ..self.state.clone()
        };
        let efforts = reference.inverse(&at);
        let mut changed = vec![0.0; self.n];
        let places = (0..at.q.len()).map(|i| (i, false));
        for (i, velocity) in places.chain((0..self.n).map(|i| (i, true))) {
            let mut moved = at.clone();
            let of = if velocity { &mut moved.v } else { &mut moved.q };
            let from = of[i];
            of[i] += from * PART;
            // The actual step, which is rounded too.
            let by = of[i] - from;
            if by == 0.0 {
                continue;
            }
            let part = T::EPS / 2.0 * (from / by).abs();
            let efforts = reference.inverse(&moved).into_iter().zip(&efforts);
            for (changed, (new, &old)) in changed.iter_mut().zip(efforts) {
                *changed += (new - old).to_f64().abs() * part;
            }
        }
        changed
    }

    /// Checks the error of accelerations: by the original reading at most (16 + cond M) eps ‖q̈‖. By the
    /// applied reading, at most four times the change due to rounding the arguments, if that is larger: if
    /// efforts and bias almost balance.
    pub fn forward<T: Digits>(&self, found: &[f64], reference: &impl Reference) -> Found {
        let exact = reference.forward(&self.state);
        let (measured, bar) = (norm(&off(found, &exact)), self.forward_bar::<T>(&exact));
        let allowed = match measured > bar {
            true => (4.0 * self.rounding::<T>(reference)).max(bar),
            false => bar,
        };
        Found {
            asked: part(measured, bar),
            ..Found::new("3", "forward dynamics", measured, allowed)
        }
    }

    /// Returns (16 + cond M) eps ‖q̈‖.
    pub fn forward_bar<T: Digits>(&self, exact: &[Dd]) -> f64 {
        (16.0 + self.most * self.inverse) * T::EPS * norm(&rounded(exact))
    }

    /// Returns the change of forward dynamics if each argument is rounded, by half an eps of itself: the
    /// sum over all of them.
    pub fn rounding<T: Digits>(&self, reference: &impl Reference) -> f64 {
        let exact = reference.forward(&self.state);
        let slightly = Dd::ONE + Dd::from_f64(T::EPS / 2.0);
        let mut sum = 0.0;
        let sizes = [self.state.q.len(), self.n, self.n];
        let arguments = sizes.into_iter().enumerate();
        for (argument, i) in arguments.flat_map(|(a, size)| (0..size).map(move |i| (a, i))) {
            let moved = reference.forward_off(&self.state, argument, i, slightly);
            let by = moved.iter().zip(&exact).map(|(&x, &y)| (x - y).to_f64());
            sum += norm(&by.collect::<Vec<f64>>());
        }
        sum
    }

    /// Checks ‖FD(ID(q̈)) − q̈‖ ≤ 8 n eps ‖M⁻¹‖ (‖M‖‖q̈‖ + ‖h‖).
    pub fn back_and_forth<T: Digits>(&self, subject: &impl Subject<T>) -> Option<Found> {
        let state = State {
            tau: subject.inverse(&self.state),
            ..self.state.clone()
        };
        let found = subject.forward(&state)?;
        let size = self.most * norm(&state.a) + norm(&self.bias);
        let measured = apart(&found, &state.a);
        let allowed = 8.0 * self.n as f64 * T::EPS * self.inverse * size;
        let what = "forward of inverse dynamics";
        Some(Found::new("5", what, measured, allowed))
    }

    /// Checks bars 1 to 5; forward dynamics may be refused if 1/(cond M · eps) is at most `singular`.
    pub fn all<T: Digits>(
        &self,
        subject: &impl Subject<T>,
        reference: &impl Reference,
        singular: f64,
    ) -> Vec<Found> {
        let refused = |bar| {
            let measured = 1.0 / (self.most * self.inverse * T::EPS);
            Found {
                asked: part(measured, SINGULAR),
                ..Found::new(bar, "refused, 1/(cond eps)", measured, singular)
            }
        };
        let mut all = vec![
            self.inverse_dynamics(subject, reference),
            self.mass_matrix(subject, reference),
        ];
        match subject.forward(&self.state) {
            Some(found) => {
                all.extend([
                    self.backward::<T>(&found, reference),
                    self.forward::<T>(&found, reference),
                ]);
            }
            None => all.push(refused("2")),
        }
        all.push(self.back_and_forth(subject).unwrap_or(refused("5")));
        all
    }
}
