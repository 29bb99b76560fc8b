//! Rigid contacts of a scene: their states, how they and the velocities act on each other, and their biases.

use bgdyn_runtime::{ContactMap, RigidContact};
use nalgebra::DVector;

use super::plant::{Evaluated, Evaluation, Numbers};

impl Evaluated<'_> {
    /// Writes the state of each rigid contact at y.
    pub(super) fn states_of_contacts(
        &self,
        t: f64,
        y: &Numbers,
        modes: &Numbers,
        contacts: &mut [RigidContact<f64>],
    ) {
        let Some(rigid) = &self.functions.rigid else {
            return;
        };
        let (values, _) = self.driven(t, y, modes, |at| rigid.states.value(at));
        for (to, v) in contacts.iter_mut().zip(values.chunks_exact(6)) {
            *to = RigidContact {
                gap: v[0],
                velocity: [v[1], v[2], v[3]],
                friction: v[4],
                restitution: v[5],
            };
        }
    }

    /// Returns the deepest overlap of rigid contacts at y, m.
    pub(super) fn deepest_overlap(&self, t: f64, y: &Numbers, modes: &Numbers) -> f64 {
        let Some(rigid) = &self.functions.rigid else {
            return 0.0;
        };
        let (values, _) = self.driven(t, y, modes, |at| rigid.states.value(at));
        let gaps = values.chunks_exact(6).map(|v| v[0]);
        gaps.fold(0.0, |most, gap| f64::max(most, -gap))
    }

    /// Writes the map of each rigid contact at y.
    pub(super) fn maps_of_contacts(
        &self,
        t: f64,
        y: &Numbers,
        modes: &Numbers,
        maps: &mut [Option<ContactMap<Numbers>>],
    ) -> Evaluation<()> {
        let Some(rigid) = &self.functions.rigid else {
            return Ok(());
        };
        let values = self.driven(t, y, modes, |at| self.regular(&*rigid.maps, at))?;
        let layout = &self.system.scene.layout;
        let (nq, nv) = (layout.nq(), layout.nv());
        let in_state = |from: &[f64]| {
            let mut vector = DVector::zeros(y.len());
            vector.as_mut_slice()[nq..nq + nv].copy_from_slice(from);
            vector
        };
        for (to, values) in maps.iter_mut().zip(values.chunks_exact(6 * nv)) {
            let [rows, columns] = [0, 3].map(|first| {
                [0, 1, 2].map(|k| in_state(&values[(first + k) * nv..(first + k + 1) * nv]))
            });
            *to = Some(ContactMap { rows, columns });
        }
        Ok(())
    }

    /// Writes γ̇ at v̇ = 0 of each rigid contact at y.
    pub(super) fn biases_of_contacts(
        &self,
        t: f64,
        y: &Numbers,
        modes: &Numbers,
        biases: &mut [[f64; 3]],
    ) {
        let Some(rigid) = &self.functions.rigid else {
            return;
        };
        let (values, _) = self.driven(t, y, modes, |at| rigid.biases.value(at));
        for (to, v) in biases.iter_mut().zip(values.chunks_exact(3)) {
            *to = [v[0], v[1], v[2]];
        }
    }
}
