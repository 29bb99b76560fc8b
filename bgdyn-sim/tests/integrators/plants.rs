//! Hand-written plants with events at known times.

use bgdyn_runtime::vector;
use bgdyn_sim::{HybridState, Plant, Power};
use nalgebra::SVector;

type Y = SVector<f64, 2>;

/// A mass of 1 kg on a spring of 1 N/m, q̈ = −q, between obstacles.
pub struct Oscillator {
    pub law: Law,
}

/// The obstacle.
pub enum Law {
    /// Walls: at each of these positions, reached from above, the velocity is multiplied by minus
    /// `returns`; −1 has no effect.
    Walls { at: [f64; 2], returns: f64 },
    /// A second spring below a position, of this stiffness: the law has a kink there.
    Spring { below: f64, stiffness: f64 },
    /// A relay that drives it back, q̈ = −sign(q), with the sign as the mode: a sliding mode occurs.
    Relay,
}

impl Oscillator {
    /// Returns the start, q = 1 at rest at t = 0.
    pub fn start(&self) -> HybridState<Y, f64> {
        let modes = 1.0;
        let y = match self.law {
            // Soon on the sliding surface, because q̇ = −mode.
            Law::Relay => vector([0.25, 0.0]),
            _ => vector([1.0, 0.0]),
        };
        HybridState { t: 0.0, y, modes }
    }
}

impl Plant for Oscillator {
    type State = Y;
    type Modes = f64;
    type Values = SVector<f64, 2>;
    type Entries = SVector<f64, 1>;
    type Error = ();

    fn rates(&self, _: f64, y: &Y, modes: &f64) -> Result<Y, ()> {
        Ok(match self.law {
            Law::Walls { .. } => vector([y[1], -y[0]]),
            Law::Spring { below, stiffness } => {
                let pressed = (below - y[0]).max(0.0);
                vector([y[1], -y[0] + stiffness * pressed])
            }
            Law::Relay => vector([-modes, 0.0]),
        })
    }

    fn jacobian(&self, _: f64, y: &Y, _: &f64) -> Option<Result<bgdyn_sim::Jacobian<Y>, ()>> {
        let stiffness = match self.law {
            Law::Spring { below, stiffness } if y[0] < below => 1.0 + stiffness,
            Law::Relay => return None,
            _ => 1.0,
        };
        Some(Ok(bgdyn_sim::Jacobian {
            state: bgdyn_runtime::matrix([[0.0, -stiffness], [1.0, 0.0]]),
            time: Y::zeros(),
        }))
    }

    fn positions(&self) -> usize {
        1
    }

    fn events(&self, _: f64, y: &Y, modes: &f64) -> Result<SVector<f64, 2>, ()> {
        Ok(match self.law {
            // Only a mass that moves towards a wall can cross it.
            Law::Walls { at, .. } => vector(at.map(|at| y[0] - at)),
            Law::Spring { below, .. } => vector([y[0] - below, 1.0]),
            Law::Relay => vector([modes * y[0], 1.0]),
        })
    }

    fn changes_mode(&self, _: usize) -> bool {
        !matches!(self.law, Law::Spring { .. })
    }

    fn change(
        &self,
        _: f64,
        y: &Y,
        modes: &f64,
        fell: impl Fn(usize) -> bool,
    ) -> Result<(Y, f64), ()> {
        Ok(match self.law {
            Law::Walls { at, returns } => {
                let wall = (0..2).find(|&e| fell(e)).ok_or(())?;
                // After a reflection it is placed on the wall, so that the event does not occur again at
                // once.
                let place = if returns < 0.0 { y[0] } else { at[wall] };
                (vector([place, -returns * y[1]]), *modes)
            }
            _ => (*y, -modes),
        })
    }

    fn nothing(&self) -> SVector<f64, 1> {
        SVector::zeros()
    }

    fn energy(&self, _: f64, y: &Y, _: &f64) -> Result<SVector<f64, 1>, ()> {
        let pressed = match self.law {
            Law::Spring { below, stiffness } => stiffness * (below - y[0]).max(0.0).powi(2),
            _ => 0.0,
        };
        Ok(vector([0.5 * (y[0] * y[0] + y[1] * y[1] + pressed)]))
    }

    fn power(&self, _: f64, _: &Y, _: &f64) -> Result<Power<SVector<f64, 1>>, ()> {
        let none = SVector::zeros();
        Ok(Power {
            supplied: none,
            dissipated: none,
        })
    }
}
