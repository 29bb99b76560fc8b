//! A body at the flange: its ten numbers, and what it adds to the base parameters of the arm.

use bgdyn::nalgebra::SVector;
use bgdyn_identification::model::BODY_PARAMETERS;
use bgdyn_identification::pseudo_inertia::transport;

use crate::Joints;
use crate::panda::Panda;
use crate::robot::{BODIES, BaseParameters};

/// Ten numbers of a load: mass, first moments, tensor about the flange, in its axes; kg, kg·m, kg·m².
pub type Load = SVector<f64, BODY_PARAMETERS>;

/// The map K from the numbers of a load to what it adds to the base parameters. Few of its numbers are not zero.
#[derive(Clone, Debug)]
pub struct LoadMap {
    /// Row, column and number of each entry that is not zero.
    entries: Vec<(usize, usize, f64)>,
}

impl LoadMap {
    /// Returns the map, from the generated one of all bodies: the load belongs to the last body.
    pub fn new() -> Self {
        let arm = Panda::<f64>::default();
        let q = Joints::zeros();
        let flange = arm.pose_link7(&q).inverse() * arm.pose_flange(&q);
        let in_link = transport(&flange.rotation, &flange.translation);
        let column = |k: usize| -> BaseParameters {
            let mut bodies = SVector::<f64, BODIES>::zeros();
            let last = BODIES - BODY_PARAMETERS;
            bodies
                .fixed_rows_mut::<BODY_PARAMETERS>(last)
                .copy_from(&in_link.column(k));
            arm.base_parameters(&bodies)
        };
        let entries = (0..BODY_PARAMETERS).flat_map(|k| {
            let column = column(k);
            let own = column.iter().enumerate().filter(|(_, x)| x.abs() > 1e-15);
            own.map(|(i, x)| (i, k, *x)).collect::<Vec<_>>()
        });
        LoadMap {
            entries: entries.collect(),
        }
    }

    /// Returns K p.
    pub fn base(&self, load: &Load) -> BaseParameters {
        let mut base = BaseParameters::zeros();
        for &(i, k, x) in &self.entries {
            base[i] += x * load[k];
        }
        base
    }
}
