//! The measured arms in C, in `f32`, with the controller in Rust.
#![allow(unsafe_code)] // Calls of C: the generated headers have these arguments and results, arrays of these sizes.

use control::{ComputedTorque, Record};

use crate::subject::{Out, Subject};

macro_rules! arm {
    ($about:literal, $arm:ident, $n:literal, $inverse:ident, $mass:ident, $forward:ident) => {
        unsafe extern "C" {
            safe fn $inverse(q: &[f32; $n], v: &[f32; $n], a: &[f32; $n], result: &mut [f32; $n]);
            safe fn $mass(q: &[f32; $n], result: &mut [f32; $n * $n]);
            safe fn $forward(q: &[f32; $n], v: &[f32; $n], tau: &[f32; $n], result: &mut [f32; $n]) -> i32;
        }

        #[doc = $about]
        #[derive(Clone, Debug)]
        pub struct $arm {
            /// Its controller.
            pub law: ComputedTorque<f32, $n>,
        }

        impl Subject<f32, $n> for $arm {
            fn inverse_dynamics(&mut self, at: &Record<f32, $n>, out: &mut Out<f32, $n>) {
                $inverse(&at.q, &at.v, &at.wanted_a, &mut out.vector.data.0[0]);
            }

            fn mass_matrix(&mut self, at: &Record<f32, $n>, out: &mut Out<f32, $n>) {
                // Row by row; it is symmetric.
                let rows = out.matrix.data.0.as_flattened_mut();
                if let Ok(result) = rows.try_into() {
                    $mass(&at.q, result);
                }
            }

            fn forward_dynamics(&mut self, at: &Record<f32, $n>, out: &mut Out<f32, $n>) {
                let status = $forward(&at.q, &at.v, &at.tau, &mut out.vector.data.0[0]);
                out.refused |= status != 0;
            }

            fn control_step(&mut self, at: &Record<f32, $n>, out: &mut Out<f32, $n>) {
                out.vector = self.law.effort_by(at, |q, v, a| {
                    let mut tau = *a;
                    let [q, v, a] = [q, v, a].map(|x| &x.data.0[0]);
                    $inverse(q, v, a, &mut tau.data.0[0]);
                    tau
                });
            }
        }
    };
}
arm!("The SCARA.", Scara, 4, c_scara_inverse_dynamics, c_scara_mass_matrix, c_scara_forward_dynamics);
arm!("The PUMA 560.", Puma560, 6, c_puma560_inverse_dynamics, c_puma560_mass_matrix, c_puma560_forward_dynamics);
arm!("The Panda.", Panda, 7, c_panda_inverse_dynamics, c_panda_mass_matrix, c_panda_forward_dynamics);
