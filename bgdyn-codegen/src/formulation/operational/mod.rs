//! Formulations of operational space: M⁻¹, and the inertia that a frame shows.
//!
//! | file | from |
//! |---|---|
//! | `driven.rs` | forward dynamics, which is linear in the efforts: M⁻¹ Jᵀ, column by column |
//! | `factored.rs` | the factors M = Lᵀ D L: Y = J L⁻¹, Λ⁻¹ = Y D⁻¹ Yᵀ |
//! | `task.rs` | the results from Λ⁻¹, M⁻¹ Jᵀ and J q̈ + J̇ v |

mod driven;
mod factored;
mod task;

pub(super) use driven::ByDrives;
pub(super) use factored::Factored;
