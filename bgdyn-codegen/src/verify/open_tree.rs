//! Checks the methods of mechanisms with loops that take velocities of the open tree.

use bgdyn_runtime::Dd;

use super::compare::{SizedLaw, dot, largest, minus, plus, times, turned};
use crate::bond_graph::ClosedTree;
use crate::expr::Inputs;
use crate::formulation::{Prepared, create, specification};
use crate::function::Function;
use crate::method::Method;

/// The literal sum of the open tree, and the rows of its loops.
struct OpenTree {
    inverse: Function,
    rows: Vec<Vec<Dd>>,
    bias: Vec<Dd>,
}

/// Returns the laws of a method; `form` creates methods of the whole mechanism by the literal sum.
pub(super) fn laws(
    closed: &ClosedTree,
    method: Method,
    form: impl Fn(Method) -> Option<Function>,
    (at, found): (&Inputs<Dd>, Vec<Dd>),
) -> Vec<SizedLaw> {
    let value = |method| form(method).map(|f| f.evaluate(at.clone()).0);
    let tree = || OpenTree::new(closed, &form, at);
    let laws = match method {
        Method::ConstraintBias => {
            value(method).map(|expected| vec![("its literal form", found, expected, 0.0)])
        }
        Method::ConstrainedDynamics => tree().map(|tree| tree.dynamics(at, &found)),
        _ => {
            let map = value(Method::VelocityMap).unwrap_or_default();
            tree().map(|tree| tree.projection(at, &found, &map))
        }
    };
    laws.unwrap_or_default()
}

impl OpenTree {
    /// Returns it with the rows at a state; `form` creates methods of the whole mechanism.
    fn new(
        closed: &ClosedTree,
        form: impl Fn(Method) -> Option<Function>,
        at: &Inputs<Dd>,
    ) -> Option<Self> {
        let inverse = create(
            specification(),
            &Prepared::new(&closed.tree),
            Method::InverseDynamics,
        )?;
        let value = |method| Some(form(method)?.evaluate(at.clone()).0);
        let jacobian = value(Method::ConstraintJacobian)?;
        let columns = closed.tree.coordinates.len().max(1);
        Some(OpenTree {
            inverse,
            rows: jacobian.chunks(columns).map(<[Dd]>::to_vec).collect(),
            bias: value(Method::ConstraintBias)?,
        })
    }

    fn efforts(&self, at: &Inputs<Dd>, v: &[Dd], a: &[Dd]) -> Vec<Dd> {
        let inputs = Inputs {
            v: v.to_vec(),
            a: a.to_vec(),
            ..at.clone()
        };
        self.inverse.evaluate(inputs).0
    }

    /// Returns M x.
    fn inertial(&self, at: &Inputs<Dd>, x: &[Dd]) -> Vec<Dd> {
        let zero = vec![Dd::ZERO; x.len()];
        let at_rest = self.efforts(at, &zero, &zero);
        minus(&self.efforts(at, &zero, x), &at_rest)
    }

    fn size_of_product(&self, at: &Inputs<Dd>, x: &[Dd]) -> f64 {
        let products = turned(x).map(|x| largest(&self.inertial(at, &x)));
        products.into_iter().fold(0.0, f64::max)
    }

    /// Returns B x.
    fn rates(&self, x: &[Dd]) -> Vec<Dd> {
        self.rows.iter().map(|row| dot(row, x)).collect()
    }

    /// Returns Bᵀ λ.
    fn of_rows(&self, lambda: &[Dd], columns: usize) -> Vec<Dd> {
        let column = |j: usize| self.rows.iter().map(|row| row[j]).collect::<Vec<Dd>>();
        (0..columns).map(|j| dot(&column(j), lambda)).collect()
    }

    /// Returns M q̈ + h = τ + Bᵀ λ and B q̈ = −Ḃ q̇.
    fn dynamics(&self, at: &Inputs<Dd>, found: &[Dd]) -> Vec<SizedLaw> {
        let (accelerations, lambda) = found.split_at(at.v.len());
        let needed = self.efforts(at, &at.v, accelerations);
        let of_rows = self.of_rows(lambda, at.v.len());
        let size = self
            .size_of_product(at, accelerations)
            .max(largest(&of_rows));
        let opposite: Vec<Dd> = self.bias.iter().map(|&x| -x).collect();
        let fast = largest(accelerations);
        vec![
            ("M q̈ + h = τ + Bᵀ λ", needed, plus(&at.u, &of_rows), size),
            ("B q̈ = −Ḃ q̇", self.rates(accelerations), opposite, fast),
        ]
    }

    /// Returns B q̇ = 0 and Sᵀ M (q̇ − q̇₀) = 0; `map` is S.
    fn projection(&self, at: &Inputs<Dd>, found: &[Dd], map: &[Dd]) -> Vec<SizedLaw> {
        let fast = largest(found).max(largest(&at.v));
        let left = self.inertial(at, &minus(found, &at.v));
        let n = map.len() / at.v.len().max(1);
        let row = |k: usize| map.iter().skip(k).step_by(n).copied().collect::<Vec<Dd>>();
        let transposed: Vec<Dd> = (0..n).flat_map(row).collect();
        let zero = |n: usize| vec![Dd::ZERO; n];
        vec![
            ("B q̇ = 0", self.rates(found), zero(self.rows.len()), fast),
            (
                "Sᵀ M (q̇ − q̇₀) = 0",
                times(&transposed, &left),
                zero(n),
                largest(&left),
            ),
        ]
    }
}
