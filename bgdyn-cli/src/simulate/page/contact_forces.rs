//! The forces at the contacts of a scene, at the rows of a page.

use bgdyn_codegen::engine::{CallArguments, Engine};
use bgdyn_codegen::function::Function;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_codegen::tape::Tape;

use crate::simulate::run_table::Row;

/// A contact point, m, and the force on the sphere there, N, world axes.
type PlacedForce = ([f64; 3], [f64; 3]);

/// The forces at all contacts.
pub(super) struct ContactForces {
    /// The elements at the contacts.
    pub(super) names: Vec<String>,
    /// For each row, the force of each element.
    pub(super) rows: Vec<Vec<PlacedForce>>,
}

/// Returns the forces at these rows; `None` without contacts.
pub(super) fn forces(system: &SceneEquations, rows: &[&Row]) -> Option<ContactForces> {
    let compliant = system.contact_forces();
    let rigid = system.rigid_contact_frames();
    if compliant.is_none() && rigid.is_none() {
        return None;
    }
    let mut all = ContactForces {
        names: Vec::new(),
        rows: vec![Vec::new(); rows.len()],
    };
    if let Some((names, function)) = compliant {
        all.names.extend(names);
        let values = values(system, &function, rows);
        for (forces, values) in all.rows.iter_mut().zip(values) {
            let (six, _) = values.as_chunks::<6>();
            let one = |&[x, y, z, fx, fy, fz]: &[f64; 6]| ([x, y, z], [fx, fy, fz]);
            forces.extend(six.iter().map(one));
        }
    }
    if let Some(function) = rigid {
        all.names.extend(system.scene.layout.rigid_contacts.clone());
        let values = values(system, &function, rows);
        for ((forces, values), row) in all.rows.iter_mut().zip(values).zip(rows) {
            let frames = values.as_chunks::<12>().0.iter();
            forces.extend(frames.zip(&row.contacts).map(in_world));
        }
    }
    Some(all)
}

/// Returns a force in world axes, from the frame of its contact and its components there.
fn in_world((frame, force): (&[f64; 12], &[f64; 3])) -> PlacedForce {
    let (rows, _) = frame.as_chunks::<3>();
    let component = |i: usize| (0..3).map(|k| rows[i][k] * force[k]).sum();
    (rows[3], [0, 1, 2].map(component))
}

/// Returns the results of a function at the rows.
fn values(system: &SceneEquations, function: &Function, rows: &[&Row]) -> Vec<Vec<f64>> {
    let scene = &system.scene;
    let (nq, nv) = (scene.layout.nq(), scene.layout.nv());
    let parameters = scene.parameters.iter().map(|p| p.default.to_f64());
    let parameters: Vec<f64> = parameters.collect();
    let function = Tape.prepare(function);
    let at = |row: &&Row| {
        let y = row.y.as_slice();
        let (values, _) = function.value(&CallArguments {
            q: &y[..nq],
            v: &y[nq..nq + nv],
            x: &y[nq + nv..],
            u: &row.inputs,
            modes: row.modes.as_slice(),
            parameters: &parameters,
            t: Some(row.t),
            ..CallArguments::default()
        });
        values
    };
    rows.iter().map(at).collect()
}
