//! Each method of a mechanism with loops, from functions of its open tree.

use std::rc::Rc;

use super::actuators::{actuator_efforts, on_tree};
use crate::bond_graph::ClosedTree;
use crate::expr::{Builder, Expr, Leaf, Signed, Tangent, copy_into};
use crate::formulation::arguments::Arguments;
use crate::formulation::joint_motion::{along, tangents};
use crate::formulation::solve;
use crate::formulation::velocity_map::VelocityMap;
use crate::function::{Function, in_triangle};
use crate::method::{Centroidal, ContactMethod, Method};
use crate::passes::cheapest_after_factoring;

/// The motion of the open tree for the independent velocities and accelerations.
pub(super) struct LoopMotion<'a, 'g> {
    map: VelocityMap<'a, 'g>,
    /// S u
    velocities: Vec<Expr<'g>>,
    /// −γ, row by row.
    bias: Vec<Expr<'g>>,
}

/// Returns the function of a method of the open tree.
type ReadTree<'r> = dyn Fn(Method) -> Option<Rc<Function>> + 'r;

/// Returns the methods of the open tree that a method is composed of; none if it cannot be.
pub(super) fn reads(method: Method) -> Vec<Method> {
    match method {
        Method::InverseDynamics | Method::Bias => vec![Method::InverseDynamics],
        Method::MassMatrix | Method::Gravity => vec![method],
        Method::ActuatedInverse(_) => vec![Method::InverseDynamics],
        Method::ForwardDynamics | Method::ActuatedForward(_) => {
            vec![Method::InverseDynamics, Method::MassMatrix]
        }
        Method::KineticEnergy | Method::PotentialEnergy => vec![method],
        Method::CoriolisMatrix => vec![method, Method::MassMatrix],
        Method::Multipliers => vec![Method::InverseDynamics],
        Method::ConstrainedDynamics | Method::Reactions | Method::ActuatedReactions(_) => {
            vec![Method::InverseDynamics, Method::MassMatrix]
        }
        Method::ProjectVelocity => vec![Method::MassMatrix],
        Method::JointReactions | Method::ActuatedJointReactions(_) => {
            vec![Method::JointReactions, Method::InverseDynamics]
        }
        Method::Pose(_) | Method::Velocity(_) | Method::Jacobian(_) => vec![method],
        Method::JacobianDotV(site) => vec![method, Method::Jacobian(site)],
        Method::Centroidal(Centroidal::Bias) => vec![method, Method::Centroidal(Centroidal::Map)],
        Method::Centroidal(_) => vec![method],
        Method::Contact(ContactMethod::Bias(contacts)) => {
            let jacobian = ContactMethod::Jacobian(contacts);
            vec![method, Method::Contact(jacobian)]
        }
        Method::Contact(of) if !of.is_dynamic() => vec![method],
        _ => vec![],
    }
}

/// Returns the cheapest of the forms of a function with the fewest early pivots, each with their number. A pivot that
/// others follow may vanish at regular positions, and digits with it.
pub(super) fn cheapest_with_fewest(
    forms: impl Iterator<Item = (Function, usize)>,
) -> Option<Function> {
    let forms: Vec<(Function, usize)> = forms.collect();
    let fewest = forms.iter().map(|(_, early)| *early).min()?;
    let forms = forms.into_iter().filter(|(_, early)| *early == fewest);
    cheapest_after_factoring(forms.map(|(form, _)| form))
}

impl<'a, 'g> LoopMotion<'a, 'g> {
    /// Returns the number of pivots, not constant, that others follow in their block.
    pub(super) fn early_pivots(&self) -> usize {
        self.map.early_pivots()
    }

    /// Returns the motion for the arguments of a method; `bias` returns −γ for velocities of the tree.
    pub(super) fn new(
        map: VelocityMap<'a, 'g>,
        (x, method): (&Arguments<'g>, Method),
        bias: impl FnOnce(&[Expr<'g>]) -> Vec<Expr<'g>>,
    ) -> Self {
        let velocities = match method.of_tree() {
            true => x.v.clone(),
            false => map.velocities(&x.v),
        };
        let bias = bias(&velocities);
        LoopMotion {
            map,
            velocities,
            bias,
        }
    }

    /// Returns the velocities of the open tree.
    pub(super) fn velocities(&self) -> &[Expr<'g>] {
        &self.velocities
    }

    /// Returns S u̇ + z.
    pub(super) fn accelerations(&self, a: &[Expr<'g>]) -> Vec<Expr<'g>> {
        self.map.accelerations(a, &self.bias)
    }

    /// Returns z.
    fn bias_accelerations(&self, b: &'g Builder) -> Vec<Expr<'g>> {
        let still = vec![b.zero(); self.map.independents()];
        self.accelerations(&still)
    }
}

/// Returns the expressions of a method; `None` for one that is not composed of those of the tree. `residuals` are
/// c(q). Reactions end with the multipliers λ, in place of wrenches: those at the joints are of the tree alone.
pub(super) fn compose<'g>(
    b: &'g Builder,
    closed: &ClosedTree,
    method: Method,
    (x, motion): (&Arguments<'g>, &LoopMotion<'_, 'g>),
    (read, residuals): (&ReadTree<'_>, &[Expr<'g>]),
) -> Option<Vec<Expr<'g>>> {
    let map = &motion.map;
    let tree = TreeFunctions { b, motion, read };
    let n = closed.closure.independents.len();
    Some(match method {
        Method::InverseDynamics | Method::Bias | Method::Gravity => {
            map.efforts(&tree.efforts(method, x)?)
        }
        Method::MassMatrix => entries(&tree.mass_matrix(b)?.reduced),
        Method::ForwardDynamics => tree.accelerated(x, Efforts::Independent)?.independent,
        Method::ActuatedForward(_) => tree.accelerated(x, Efforts::Actuated(closed))?.independent,
        Method::ActuatedInverse(_) => {
            let efforts = map.efforts(&tree.efforts(Method::InverseDynamics, x)?);
            actuator_efforts(b, closed, &map.map, efforts)?
        }
        Method::KineticEnergy | Method::PotentialEnergy => tree.read(method, None)?,
        Method::CoriolisMatrix => tree.coriolis_matrix(closed)?,
        Method::Pose(_) | Method::Velocity(_) => tree.read(method, None)?,
        Method::Jacobian(_) => product(&tree.read(method, None)?, &map.map, n, b),
        Method::JacobianDotV(site) => tree.rate(method, Method::Jacobian(site))?,
        Method::Centroidal(of) => match of {
            Centroidal::Centre | Centroidal::Momentum => tree.read(method, None)?,
            Centroidal::Jacobian | Centroidal::Map => {
                product(&tree.read(method, None)?, &map.map, n, b)
            }
            Centroidal::Bias => tree.rate(method, Method::Centroidal(Centroidal::Map))?,
        },
        Method::Contact(of) => match of {
            ContactMethod::Gaps(_) | ContactMethod::Frames(_) | ContactMethod::Velocity(_) => {
                tree.read(method, None)?
            }
            ContactMethod::Jacobian(_) => product(&tree.read(method, None)?, &map.map, n, b),
            ContactMethod::Bias(contacts) => {
                let jacobian = ContactMethod::Jacobian(contacts);
                tree.rate(method, Method::Contact(jacobian))?
            }
            ContactMethod::Delassus(_) | ContactMethod::Response(_) => return None,
        },
        Method::VelocityMap => entries(&map.map),
        Method::TreeVelocity => motion.velocities.clone(),
        Method::TreeAcceleration => motion.accelerations(&x.a),
        Method::ConstraintResidual => residuals.to_vec(),
        Method::ConstraintJacobian => entries(map.rates()),
        Method::Multipliers => map.multipliers(&tree.efforts(Method::InverseDynamics, x)?),
        Method::ClosingStep => map.steps(residuals),
        Method::ConstraintBias => motion.bias.clone(),
        Method::ConstrainedDynamics => {
            let joints: Vec<usize> = closed.closure.independents.iter().map(|j| j.0).collect();
            let moved = tree.accelerated(x, Efforts::OfTree(&joints))?;
            let lacking = minus(&moved.lacking, &x.tau);
            let mut all = motion.accelerations(&moved.independent);
            all.extend(map.multipliers(&lacking));
            all
        }
        Method::ProjectVelocity => map.velocities(&tree.nearest(closed)?),
        Method::Reactions => {
            let moved = tree.accelerated(x, Efforts::Independent)?;
            let mut all = moved.independent;
            all.extend(map.multipliers(&moved.lacking));
            all
        }
        Method::ActuatedReactions(_) => {
            let moved = tree.accelerated(x, Efforts::Actuated(closed))?;
            let driven = on_tree(b, closed, &x.tau)?;
            let mut all = moved.independent;
            all.extend(map.multipliers(&minus(&moved.lacking, &driven)));
            all
        }
        Method::JointReactions | Method::ActuatedJointReactions(_) => {
            let accelerations = motion.accelerations(&x.a);
            let mut all = tree.read(Method::JointReactions, Some(&accelerations))?;
            let needed = tree.efforts(Method::InverseDynamics, x)?;
            let lacking = match method {
                Method::JointReactions => needed,
                _ => minus(&needed, &on_tree(b, closed, &x.tau)?),
            };
            all.extend(map.multipliers(&lacking));
            all
        }
        _ => return None,
    })
}

/// The mass matrix of the independent velocities.
pub(super) struct ReducedMass<'g> {
    /// M S, row by row.
    moved: Vec<Vec<Expr<'g>>>,
    /// The lower triangle of Sᵀ M S.
    pub(super) reduced: Vec<Vec<Expr<'g>>>,
}

/// The joints on which the efforts `tau` act.
enum Efforts<'x> {
    /// The independent ones.
    Independent,
    /// All joints of the open tree, of which the independent ones have these numbers.
    OfTree(&'x [usize]),
    /// The actuated ones.
    Actuated(&'x ClosedTree),
}

/// The motion under efforts.
struct Accelerated<'g> {
    /// u̇
    independent: Vec<Expr<'g>>,
    /// M q̈ + h
    lacking: Vec<Expr<'g>>,
}

/// The functions of the open tree at the motion of the loops.
struct TreeFunctions<'r, 'a, 'g> {
    b: &'g Builder,
    motion: &'r LoopMotion<'a, 'g>,
    read: &'r ReadTree<'r>,
}

impl<'g> TreeFunctions<'_, '_, 'g> {
    /// Returns the results of a method of the tree at these accelerations, zero if there are none.
    fn read(&self, method: Method, accelerations: Option<&[Expr<'g>]>) -> Option<Vec<Expr<'g>>> {
        let function = (self.read)(method)?;
        let signed = |all: &[Expr<'g>]| -> Vec<Signed> { all.iter().map(|x| x.signed()).collect() };
        let zero = self.b.zero().signed();
        let velocities = signed(&self.motion.velocities);
        let accelerations = accelerations.map(signed);
        let leaf = |leaf: Leaf| match leaf {
            Leaf::Velocity(j) => Some(velocities[j]),
            Leaf::Acceleration(j) => Some(accelerations.as_ref().map_or(zero, |all| all[j])),
            _ => None,
        };
        let outputs = &function.blocks[0].outputs;
        let copied = self
            .b
            .with_graph(|g| copy_into(g, &function.graph, outputs, |_, l| leaf(l)));
        Some(copied.into_iter().map(|e| self.b.expr(e)).collect())
    }

    /// Returns the rate where u̇ is zero: that of the tree where its accelerations are zero, and the columns of the
    /// `map` times z.
    fn rate(&self, method: Method, map: Method) -> Option<Vec<Expr<'g>>> {
        let map = self.read(map, None)?;
        let z = self.motion.bias_accelerations(self.b).into_iter();
        let z: Vec<Vec<Expr<'g>>> = z.map(|z| vec![z]).collect();
        let moved = product(&map, &z, 1, self.b);
        let own = self.read(method, None)?;
        Some(own.into_iter().zip(moved).map(|(x, y)| x + y).collect())
    }

    /// Returns the efforts on the joints of the tree.
    fn efforts(&self, method: Method, x: &Arguments<'g>) -> Option<Vec<Expr<'g>>> {
        match method {
            Method::Gravity => self.read(method, None),
            Method::Bias => {
                let z = self.motion.bias_accelerations(self.b);
                self.read(Method::InverseDynamics, Some(&z))
            }
            _ => {
                let accelerations = self.motion.accelerations(&x.a);
                self.read(Method::InverseDynamics, Some(&accelerations))
            }
        }
    }

    /// Returns M S and Sᵀ M S.
    fn mass_matrix(&self, b: &'g Builder) -> Option<ReducedMass<'g>> {
        let mass = self.read(Method::MassMatrix, None)?;
        Some(reduced(b, &mass, &self.motion.map.map))
    }

    /// Returns the motion under the efforts `x.tau` on these joints.
    fn accelerated(&self, x: &Arguments<'g>, of: Efforts<'_>) -> Option<Accelerated<'g>> {
        let (b, map) = (self.b, &self.motion.map);
        let bias = self.efforts(Method::Bias, x)?;
        let drive = match &of {
            Efforts::Independent => minus(&x.tau, &map.efforts(&bias)),
            Efforts::OfTree(_) => map.efforts(&minus(&x.tau, &bias)),
            Efforts::Actuated(closed) => map.efforts(&minus(&on_tree(b, closed, &x.tau)?, &bias)),
        };
        let mass = self.mass_matrix(b)?;
        let independent = match of {
            Efforts::OfTree(joints) => solve::ltdl_of(b, mass.reduced, drive, joints),
            _ => solve::ltdl(b, mass.reduced, drive),
        };
        let lacking = bias.iter().zip(&mass.moved).map(|(&h, row)| {
            let terms = row.iter().zip(&independent);
            terms.fold(h, |sum, (m, a)| sum + *m * *a)
        });
        Some(Accelerated {
            lacking: lacking.collect(),
            independent,
        })
    }

    /// Returns the u with the least (S u − q̇)ᵀ M (S u − q̇): Sᵀ M S u = (M S)ᵀ q̇.
    fn nearest(&self, closed: &ClosedTree) -> Option<Vec<Expr<'g>>> {
        let b = self.b;
        let mass = self.mass_matrix(b)?;
        let rows = || mass.moved.iter().zip(&self.motion.velocities);
        let momentum = |k: usize| rows().fold(b.zero(), |sum, (row, v)| sum + row[k] * *v);
        let independents = &closed.closure.independents;
        let side = (0..independents.len()).map(momentum).collect();
        let joints: Vec<usize> = independents.iter().map(|j| j.0).collect();
        Some(solve::ltdl_of(b, mass.reduced, side, &joints))
    }

    /// Returns Sᵀ (C S + M Ṡ), row by row: bias = C u + gravity, Ṁ − 2 C skew.
    fn coriolis_matrix(&self, closed: &ClosedTree) -> Option<Vec<Expr<'g>>> {
        let (b, map) = (self.b, &self.motion.map.map);
        let (all, n) = (map.len(), map.first().map_or(0, Vec::len));
        let coriolis = self.read(Method::CoriolisMatrix, None)?;
        let mass = self.read(Method::MassMatrix, None)?;
        let rates = tangents(b, &closed.tree, &self.motion.velocities);
        let mut rate = Tangent::new(along(rates));
        let mut rate_of = |e: Expr<'g>| {
            let e = e.signed();
            b.expr(b.with_graph(|g| rate.of(g, e)))
        };
        let rates: Vec<Vec<Expr<'g>>> = map
            .iter()
            .map(|row| row.iter().map(|&e| rate_of(e)).collect())
            .collect();
        let mut moved = product(&coriolis, map, n, b);
        let symmetric: Vec<Expr<'g>> = (0..all * all)
            .map(|k| mass[in_triangle((k / all).max(k % all), (k / all).min(k % all))])
            .collect();
        let turned = product(&symmetric, &rates, n, b);
        moved.iter_mut().zip(turned).for_each(|(x, y)| *x = *x + y);
        let entry = |k: usize, l: usize| {
            (0..all).fold(b.zero(), |sum, i| sum + map[i][k] * moved[i * n + l])
        };
        Some((0..n * n).map(|at| entry(at / n, at % n)).collect())
    }
}

/// Returns M S and Sᵀ M S, from the lower triangle of M, row by row, and S.
pub(super) fn reduced<'g>(
    b: &'g Builder,
    mass: &[Expr<'g>],
    map: &[Vec<Expr<'g>>],
) -> ReducedMass<'g> {
    let (all, n) = (map.len(), map.first().map_or(0, Vec::len));
    let entry = |i: usize, j: usize| mass[in_triangle(i.max(j), i.min(j))];
    let moved =
        |i: usize, k: usize| (0..all).fold(b.zero(), |sum, j| sum + entry(i, j) * map[j][k]);
    let moved: Vec<Vec<Expr<'g>>> = (0..all)
        .map(|i| (0..n).map(|k| moved(i, k)).collect())
        .collect();
    let entry =
        |k: usize, l: usize| (0..all).fold(b.zero(), |sum, i| sum + map[i][k] * moved[i][l]);
    let reduced = (0..n).map(|k| (0..=k).map(|l| entry(k, l)).collect());
    ReducedMass {
        reduced: reduced.collect(),
        moved,
    }
}

/// Returns x − y.
pub(super) fn minus<'g>(x: &[Expr<'g>], y: &[Expr<'g>]) -> Vec<Expr<'g>> {
    x.iter().zip(y).map(|(&x, &y)| x - y).collect()
}

/// Returns the product of a matrix, row by row, with one that has `n` columns, row by row.
fn product<'g>(a: &[Expr<'g>], map: &[Vec<Expr<'g>>], n: usize, b: &'g Builder) -> Vec<Expr<'g>> {
    let inner = map.len();
    let entry = |row: &[Expr<'g>], k: usize| {
        let terms = row.iter().zip(map);
        terms.fold(b.zero(), |sum, (x, column)| sum + *x * column[k])
    };
    let rows = a.chunks(inner.max(1));
    rows.flat_map(|row| (0..n).map(move |k| entry(row, k)))
        .collect()
}

/// Returns the entries row by row.
pub(super) fn entries<'g>(matrix: &[Vec<Expr<'g>>]) -> Vec<Expr<'g>> {
    matrix.iter().flatten().copied().collect()
}
