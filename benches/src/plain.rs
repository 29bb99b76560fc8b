//! A robot by the textbook recursions, with the same calls as a generated model and memory for the
//! results.

use bgdyn_codegen::mechanism::Mechanism;
use nalgebra::{DMatrix, Matrix6xX, RealField, Vector3, convert};

use crate::body::{bodies, place, vector};
use crate::inputs::{Input, Lanes};
use textbook::Textbook;

/// An upper bound of the number of bodies in `specs/`.
const CAPACITY: usize = 16;

/// The recursions of [`Textbook`] for one robot.
#[derive(Clone, Debug)]
pub struct Plain<T: RealField + Copy> {
    tree: Textbook<T, CAPACITY>,
    tip: (Option<usize>, Vector3<T>),
    /// The result of the last call: efforts or accelerations.
    pub vector: Vec<T>,
    /// The last mass matrix.
    pub mass: DMatrix<T>,
    /// The last Jacobian.
    pub jacobian: Matrix6xX<T>,
}

impl<T: Lanes + RealField> Plain<T> {
    /// Creates it for the mechanism, and the link or frame of the Jacobian.
    ///
    /// # Panics
    /// If the link or frame does not exist, or there are more than 16 bodies.
    pub fn new(mechanism: &Mechanism, tip: &str) -> Self {
        let bodies = bodies(mechanism);
        let site = place(mechanism, tip).expect("a link or a frame of the mechanism");
        let point = site.placement.translation.map(convert::<f64, T>);
        Plain {
            tree: Textbook::new(&bodies, vector(mechanism.gravity())),
            tip: (site.body, point),
            vector: vec![T::zero(); bodies.len()],
            mass: DMatrix::zeros(bodies.len(), bodies.len()),
            jacobian: Matrix6xX::zeros(bodies.len()),
        }
    }

    /// Computes the joint efforts.
    pub fn inverse_dynamics<const N: usize>(&mut self, s: &Input<T, N>) {
        let (q, v, a) = (s.q.as_slice(), s.v.as_slice(), s.a.as_slice());
        self.tree.inverse_dynamics(q, v, a, &mut self.vector);
    }

    /// Computes M.
    pub fn mass_matrix<const N: usize>(&mut self, s: &Input<T, N>) {
        self.tree.mass_matrix(s.q.as_slice(), &mut self.mass);
    }

    /// Computes the joint accelerations.
    pub fn forward_dynamics<const N: usize>(&mut self, s: &Input<T, N>) {
        let (q, v, tau) = (s.q.as_slice(), s.v.as_slice(), s.tau.as_slice());
        self.tree.forward_dynamics(q, v, tau, &mut self.vector);
    }

    /// Computes the bias force.
    pub fn bias<const N: usize>(&mut self, s: &Input<T, N>) {
        let (q, v) = (s.q.as_slice(), s.v.as_slice());
        self.tree.bias(q, v, &mut self.vector);
    }

    /// Computes the efforts at rest.
    pub fn gravity<const N: usize>(&mut self, s: &Input<T, N>) {
        self.tree.gravity(s.q.as_slice(), &mut self.vector);
    }

    /// Computes the tip's Jacobian in world axes, angular part first.
    pub fn jacobian<const N: usize>(&mut self, s: &Input<T, N>) {
        let (body, point) = self.tip;
        let jacobian = &mut self.jacobian;
        self.tree
            .jacobian_world(s.q.as_slice(), body, &point, jacobian);
    }
}
