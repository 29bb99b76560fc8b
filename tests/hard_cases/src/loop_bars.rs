//! Bars C1 to C3, C6 and the rates of C9 in one state of a mechanism with loops: errors of compiled code, in a
//! scalar, against `loop_exact.rs` at the same arguments.

use bgdyn_runtime::Dd;
use hard_cases_compiled::loops::Closed;

use crate::bars::{Digits, Found, norm, off, part, rounded};
use crate::loop_exact::{Arguments, Exact, rounding, solve, times, transposed};
use crate::loop_tree::{At, Tree};
use crate::subject::{narrow, wide};

/// Returns Σ_j |a_j||x_j|.
fn weighed(a: &[Dd], x: &[Dd]) -> f64 {
    let terms = a.iter().zip(x).map(|(a, x)| (*a * *x).to_f64().abs());
    terms.sum()
}

/// Converts numbers of a scalar exactly.
pub(crate) fn exactly(x: &[f64]) -> Vec<Dd> {
    x.iter().map(|&x| Dd::from_f64(x)).collect()
}

/// Returns the entry that uses the most of what is allowed.
fn worst(
    bar: &'static str,
    what: &'static str,
    entries: impl Iterator<Item = (f64, f64)>,
) -> Found {
    let worst = entries.max_by(|a, b| part(a.0, a.1).total_cmp(&part(b.0, b.1)));
    let (measured, allowed) = worst.expect("an entry");
    Found::new(bar, what, measured, allowed)
}

/// The same with the limits as asked and as read.
fn read(
    bar: &'static str,
    what: &'static str,
    entries: impl Iterator<Item = (f64, f64, f64)>,
) -> Found {
    let entries: Vec<(f64, f64, f64)> = entries.collect();
    let asked = entries.iter().map(|(x, asked, _)| part(*x, *asked));
    Found {
        asked: asked.fold(0.0, f64::max),
        ..worst(bar, what, entries.iter().map(|(x, _, read)| (*x, *read)))
    }
}

/// Allows what rounding each position and velocity by half an eps changes in a value, where that is more.
fn or_rounded<T: Digits>(
    found: Found,
    s: &Arguments,
    value: impl Fn(&Arguments) -> Vec<Dd>,
) -> Found {
    if found.measured <= found.allowed {
        return found;
    }
    Found {
        allowed: found.allowed.max(rounding(s, T::EPS, value)),
        ..found
    }
}

/// Returns the magnitudes of the terms of S x + z, added up: those of q̇ or q̈ of the tree.
fn sizes(exact: &Exact, x: &[Dd], second: Option<&[Dd]>) -> Vec<Dd> {
    let own = |j: usize| second.map_or(0.0, |z| z[j].to_f64().abs());
    let row = |(j, row): (usize, &Vec<Dd>)| Dd::from_f64(weighed(row, x) + own(j));
    exact.map.iter().enumerate().map(row).collect()
}

/// Returns for each joint of the tree by how much M q̈ + h = P + Bᵀλ does not hold, and its limits as asked and as read:
/// a `share` of the magnitudes of its terms, with q̈ and with the terms of q̈.
fn balances(
    at: &At,
    across: &[Vec<Dd>],
    (accelerations, terms): (&[Dd], &[Dd]),
    (drives, multipliers): (&[Dd], &[Dd]),
    share: f64,
) -> Vec<(f64, f64, f64)> {
    let (inertia, loops) = (times(&at.mass, accelerations), times(across, multipliers));
    let row = |i: usize| {
        let left = inertia[i] + at.bias[i] - drives[i] - loops[i];
        let others = at.bias_size[i] + drives[i].to_f64().abs() + weighed(&across[i], multipliers);
        let size = |q: &[Dd]| share * (weighed(&at.mass[i], q) + others);
        (left.to_f64().abs(), size(accelerations), size(terms))
    };
    (0..drives.len()).map(row).collect()
}

impl Arguments {
    /// Returns the arguments rounded to the scalar.
    pub fn rounded<T: Digits>(&self) -> Arguments {
        let round = |x: &Vec<Dd>| {
            x.iter()
                .map(|x| Dd::from_f64(T::from_f64(x.to_f64()).to_f64()))
                .collect()
        };
        Arguments {
            q: round(&self.q),
            u: round(&self.u),
            a: round(&self.a),
            tau: round(&self.tau),
        }
    }
}

/// What the code computes in a state.
struct Computed {
    /// The accelerations of the independent velocities.
    a: Vec<f64>,
    rates: Vec<Dd>,
    accelerations: Vec<Dd>,
    multipliers: Vec<Dd>,
}

/// A mechanism in the scalar T, with its reference.
pub(crate) struct Subject<'a, T> {
    /// The code.
    pub model: &'a dyn Closed<T>,
    /// The open tree and the rows.
    pub tree: &'a Tree,
}

impl<T: Digits> Subject<'_, T> {
    fn compute(&self, s: &Arguments) -> Option<Computed> {
        let given = |x: &[Dd]| narrow::<T>(&rounded(x));
        let [q, u, tau] = [&s.q, &s.u, &s.tau].map(|x| given(x));
        let a = self.model.forward_dynamics(&q, &u, &tau).ok()?;
        let exact = |x: Vec<T>| exactly(&wide(x));
        Some(Computed {
            rates: exact(self.model.tree_velocity(&q, &u)),
            accelerations: exact(self.model.tree_acceleration(&q, &u, &a)),
            multipliers: exact(self.model.multipliers(&q, &u, &a)),
            a: wide(a),
        })
    }

    /// Checks all of these bars; `loads` are efforts on all joints of the tree, for their power.
    pub fn all(&self, s: &Arguments, loads: &[Dd]) -> Vec<Found> {
        let s = s.rounded::<T>();
        let exact = Exact::new(self.tree, &s.q, &s.u);
        let mut all = vec![self.inverse(&s, &exact)];
        let Some(computed) = self.compute(&s) else {
            all.push(Found::new("C2", "refused", 1.0, 0.0));
            return all;
        };
        all.push(self.forward(&s, &exact, &computed));
        all.extend(self.backward(&s, &exact, &computed));
        if self.model.closes_at_once() {
            all.push(self.backward_where_closed(&s, &computed));
        }
        all.push(self.power(&s, loads, &computed));
        all
    }

    /// C3: efforts to 64 eps of the terms that they are added up from.
    fn inverse(&self, s: &Arguments, exact: &Exact) -> Found {
        let given = |x: &[Dd]| narrow::<T>(&rounded(x));
        let found = self
            .model
            .inverse_dynamics(&given(&s.q), &given(&s.u), &given(&s.a));
        let errors = off(&wide(found), &exact.inverse(&s.a));
        let of_tree = |q: &[Dd]| -> Vec<Dd> {
            let rows = exact.tree.mass.iter().zip(&exact.tree.bias_size);
            rows.map(|(row, bias)| Dd::from_f64(weighed(row, q) + bias))
                .collect()
        };
        let asked = of_tree(&exact.accelerations(&s.a));
        let terms = of_tree(&sizes(exact, &s.a, Some(&exact.second)));
        let columns = transposed(&exact.map, s.u.len());
        let entries = errors.iter().zip(&columns).map(|(error, column)| {
            let limit = |of_tree: &[Dd]| 64.0 * T::EPS * weighed(column, of_tree);
            (error.abs(), limit(&asked), limit(&terms))
        });
        let found = read("C3", "inverse dynamics", entries);
        or_rounded::<T>(found, s, |s| {
            Exact::new(self.tree, &s.q, &s.u).inverse(&s.a)
        })
    }

    /// C2: accelerations.
    fn forward(&self, s: &Arguments, exact: &Exact, computed: &Computed) -> Found {
        let wanted = exact.forward(&s.tau);
        let measured = norm(&off(&computed.a, &wanted));
        let bar = exact.share(T::EPS) * norm(&rounded(&wanted));
        let allowed = match measured > bar {
            true => {
                let forward = |s: &Arguments| Exact::new(self.tree, &s.q, &s.u).forward(&s.tau);
                (4.0 * rounding(s, T::EPS, forward)).max(bar)
            }
            false => bar,
        };
        Found::new("C2", "forward dynamics", measured, allowed)
    }

    /// C1: M q̈ + h = P + Bᵀλ and B q̈ = γ, row by row, and B q̇ = 0 of bar C9.
    fn backward(&self, s: &Arguments, exact: &Exact, computed: &Computed) -> Vec<Found> {
        let Computed {
            rates,
            accelerations,
            multipliers,
            ..
        } = computed;
        let at = self.tree.at(&s.q, rates);
        let n = self.tree.len();
        let share = 16.0 * n as f64 * T::EPS;
        let (rate_terms, terms) = (
            sizes(exact, &s.u, None),
            sizes(exact, &exactly(&computed.a), Some(&exact.second)),
        );
        let drives = self.drives(s);
        let given = narrow::<T>(&rounded(&s.q));
        let jacobian = exactly(&wide(self.model.constraint_jacobian(&given)));
        let rows: Vec<Vec<Dd>> = jacobian.chunks(n).map(<[Dd]>::to_vec).collect();
        let across = transposed(&rows, n);
        let moved = (accelerations.as_slice(), terms.as_slice());
        let efforts = balances(&at, &across, moved, (&drives, multipliers), share);
        let a = exactly(&computed.a);
        let efforts = read("C1", "M q̈ + h = P + Bᵀλ", efforts.into_iter());
        let efforts = or_rounded::<T>(efforts, s, |s| {
            let exact = Exact::new(self.tree, &s.q, &s.u);
            exact.efforts(&exact.accelerations(&a))
        });
        let bent = times(&rows, accelerations);
        let size = |q: &[Dd]| -> Vec<f64> {
            let rows = rows.iter().zip(&at.gamma_size);
            rows.map(|(row, gamma)| share * (weighed(row, q) + gamma))
                .collect()
        };
        let left = bent
            .iter()
            .zip(&at.gamma)
            .map(|(&x, &y)| (x - y).to_f64().abs());
        let limits = size(accelerations)
            .into_iter()
            .zip(self.of_loops(&size(&terms)));
        let entries = left.zip(limits).map(|(x, (asked, read))| (x, asked, read));
        let held = read("C1", "B q̈ = γ", entries);
        let moved = times(&rows, rates);
        let size = |q: &[Dd]| -> Vec<f64> { rows.iter().map(|row| weighed(row, q)).collect() };
        let (own, of_loops) = (size(rates), self.of_loops(&size(&rate_terms)));
        let entries = moved
            .iter()
            .zip(own.iter().zip(&of_loops))
            .map(|(x, (own, all))| {
                let eps = 16.0 * T::EPS;
                (x.to_f64().abs(), eps * own, eps * all)
            });
        let closed = read("C9", "B q̇ = 0", entries);
        // A column has a unit vector or a lever.
        let longest = at.rows.iter().flatten();
        let longest = longest.fold(1.0, |most: f64, x| most.max(x.to_f64().abs()));
        let entries = at.rows.iter().flatten().zip(&jacobian);
        let entries =
            entries.map(|(&exact, &found)| ((exact - found).to_f64().abs(), share * longest));
        let jacobian = worst("C1", "B", entries);
        let power = multipliers.iter().zip(&moved);
        let power = power.fold(Dd::ZERO, |sum, (&l, &r)| sum + l * r);
        let limit = |sizes: &[f64]| -> f64 {
            let terms = sizes.iter().zip(multipliers);
            terms.map(|(size, l)| share * size * l.to_f64().abs()).sum()
        };
        let entry = (power.to_f64().abs(), limit(&own), limit(&of_loops));
        let none = read("C6", "λᵀ B q̇ = 0", std::iter::once(entry));
        vec![efforts, held, jacobian, closed, none]
    }

    /// Returns the efforts on all joints of the tree.
    fn drives(&self, s: &Arguments) -> Vec<Dd> {
        let mut drives = vec![Dd::ZERO; self.tree.len()];
        for (&i, &tau) in self.tree.independents.iter().zip(&s.tau) {
            drives[i] = tau;
        }
        drives
    }

    /// C1 for accelerations in closed form, which follow from the independent positions alone: at the positions that
    /// close for these to the last digit, with q̈ and λ that follow from the accelerations there.
    fn backward_where_closed(&self, s: &Arguments, computed: &Computed) -> Found {
        let s = self.tree.closed(s);
        let exact = Exact::new(self.tree, &s.q, &s.u);
        let a = exactly(&computed.a);
        let accelerations = exact.accelerations(&a);
        let terms = sizes(&exact, &a, Some(&exact.second));
        let n = self.tree.len();
        let across = transposed(&exact.tree.rows, n);
        let efforts = exact.efforts(&accelerations);
        let dependents = self.tree.dependents.iter();
        let (rows, sides) = dependents.map(|&j| (across[j].clone(), efforts[j])).unzip();
        let multipliers = solve(rows, vec![sides]).remove(0);
        let share = 16.0 * n as f64 * T::EPS;
        let moved = (accelerations.as_slice(), terms.as_slice());
        let loads = (self.drives(&s), multipliers);
        let entries = balances(&exact.tree, &across, moved, (&loads.0, &loads.1), share);
        let what = "M q̈ + h = P + Bᵀλ, where the loops close exactly";
        read("C1", what, entries.into_iter())
    }

    /// Returns for each row the length of the sizes of all rows of its loop.
    fn of_loops(&self, sizes: &[f64]) -> Vec<f64> {
        let names: Vec<&str> = (self.model.rows().iter())
            .map(|name| name.split(' ').next().unwrap_or_default())
            .collect();
        let of = |name: &&str| {
            let own = names.iter().zip(sizes).filter(|(other, _)| *other == name);
            norm(&own.map(|(_, size)| *size).collect::<Vec<f64>>())
        };
        names.iter().map(of).collect()
    }

    /// C6: the power of efforts on all joints, P·q̇ = (SᵀP)·u.
    fn power(&self, s: &Arguments, loads: &[Dd], computed: &Computed) -> Found {
        let m = s.u.len();
        let map = exactly(&wide(self.model.velocity_map(&narrow::<T>(&rounded(&s.q)))));
        let dot = |x: &[Dd], y: &[Dd]| x.iter().zip(y).fold(Dd::ZERO, |sum, (&x, &y)| sum + x * y);
        let of_tree = dot(loads, &computed.rates);
        let rows: Vec<&[Dd]> = map.chunks(m).collect();
        let reduced = (0..m).map(|k| {
            let terms = rows.iter().zip(loads);
            terms.fold(Dd::ZERO, |sum, (row, &p)| sum + row[k] * p)
        });
        let reduced: Vec<Dd> = reduced.collect();
        let measured = (of_tree - dot(&reduced, &s.u)).to_f64().abs();
        let size: f64 = (rows.iter().zip(loads))
            .map(|(row, p)| p.to_f64().abs() * weighed(row, &s.u))
            .sum();
        let share = 16.0 * loads.len() as f64 * T::EPS;
        Found::new("C6", "P·q̇ = (SᵀP)·u", measured, share * size)
    }
}
