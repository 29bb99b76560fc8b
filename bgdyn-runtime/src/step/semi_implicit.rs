//! The semi-implicit Euler method: v⁺ = v + h q̈(q, v, u), then q⁺ = integrate(q, h v⁺).

use nalgebra::{SMatrix, SVector};

use super::products::{multiple_of_one, plus, product, transposed_product};
use super::tangent::integration_maps;
use super::{Linearizable, State, Step, StepBlocks, Tangent};
use crate::{Dynamics, Scalar};

/// Steps of the semi-implicit Euler method, of order 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SemiImplicit<T> {
    /// Length of a step h, s.
    pub step: T,
}

/// Derivatives of a semi-implicit step: δv⁺ = F δ(q, v) + G δu, and δq⁺ = E δq + h J δv⁺.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SemiImplicitBlocks<T: Scalar, const NV: usize> {
    /// F: ∂v⁺/∂q and ∂v⁺/∂v.
    pub f: [SMatrix<T, NV, NV>; 2],
    /// G: ∂v⁺/∂u.
    pub g: SMatrix<T, NV, NV>,
    /// Length of a step h, s.
    pub step: T,
    /// E and J; `None` where q̇ = v for all joints: both are 1.
    pub maps: Option<[SMatrix<T, NV, NV>; 2]>,
}

/// Returns v⁺.
fn next_velocity<M: Dynamics<T, NQ, NV>, T: Scalar, const NQ: usize, const NV: usize>(
    h: T,
    model: &M,
    from: &State<T, NQ, NV>,
    tau: &SVector<T, NV>,
) -> Result<SVector<T, NV>, T::Singular<NV>> {
    let a = model.forward_dynamics(&from.q, &from.v, tau)?;
    Ok(plus(&from.v, h, &a))
}

impl<M, T, const NQ: usize, const NV: usize> Step<M, T, NQ, NV> for SemiImplicit<T>
where
    M: Linearizable<T, NQ, NV>,
    T: Scalar,
{
    type Blocks = SemiImplicitBlocks<T, NV>;

    fn next(
        &self,
        model: &M,
        from: &State<T, NQ, NV>,
        tau: &SVector<T, NV>,
    ) -> Result<State<T, NQ, NV>, T::Singular<NV>> {
        let v = next_velocity(self.step, model, from, tau)?;
        let q = model.integrate(&from.q, &v.map(|v| self.step * v));
        Ok(State { q, v })
    }

    fn linear(
        &self,
        model: &M,
        from: &State<T, NQ, NV>,
        tau: &SVector<T, NV>,
    ) -> Result<SemiImplicitBlocks<T, NV>, T::Singular<NV>> {
        let h = self.step;
        let [by_q, by_v, by_tau] = model.forward_dynamics_derivatives(&from.q, &from.v, tau)?;
        let maps = if M::QUASI_JOINTS.is_empty() {
            None
        } else {
            let v = next_velocity(h, model, from, tau)?;
            Some(integration_maps(M::QUASI_JOINTS, &v.map(|v| h * v)))
        };
        Ok(SemiImplicitBlocks {
            f: [
                by_q.map(|x| h * x),
                plus(&multiple_of_one(T::from_f64(1.0)), h, &by_v),
            ],
            g: by_tau.map(|x| h * x),
            step: h,
            maps,
        })
    }
}

impl<T: Scalar, const NV: usize> StepBlocks<T, NV> for SemiImplicitBlocks<T, NV> {
    fn forward(&self, from: &Tangent<T, NV>, tau: &SVector<T, NV>) -> Tangent<T, NV> {
        let one = T::from_f64(1.0);
        let [by_q, by_v] = &self.f;
        let free = plus(&product(by_q, &from.q), one, &product(by_v, &from.v));
        let v = plus(&free, one, &product(&self.g, tau));
        let q = match &self.maps {
            None => plus(&from.q, self.step, &v),
            Some([e, j]) => plus(&product(e, &from.q), self.step, &product(j, &v)),
        };
        Tangent { q, v }
    }

    fn adjoint(&self, next: &Tangent<T, NV>) -> (Tangent<T, NV>, SVector<T, NV>) {
        let one = T::from_f64(1.0);
        let (carried, through) = match &self.maps {
            None => (next.q, next.q),
            Some([e, j]) => (
                transposed_product(e, &next.q),
                transposed_product(j, &next.q),
            ),
        };
        // The derivative by v⁺, which q⁺ contains.
        let v = plus(&next.v, self.step, &through);
        let [by_q, by_v] = &self.f;
        let from = Tangent {
            q: plus(&carried, one, &transposed_product(by_q, &v)),
            v: transposed_product(by_v, &v),
        };
        (from, transposed_product(&self.g, &v))
    }

    fn dense(&self) -> [[SMatrix<T, NV, NV>; 3]; 2] {
        let [by_q, by_v] = self.f;
        let rates = [by_q, by_v, self.g];
        let zero = SMatrix::repeat(T::from_f64(0.0));
        let (e, moved) = match &self.maps {
            None => (multiple_of_one(T::from_f64(1.0)), rates),
            Some([e, j]) => (*e, rates.map(|rate| product(j, &rate))),
        };
        let mut carried = [e, zero, zero].into_iter();
        let positions = moved.map(|moved| plus(&carried.next().unwrap_or(zero), self.step, &moved));
        [positions, rates]
    }
}
