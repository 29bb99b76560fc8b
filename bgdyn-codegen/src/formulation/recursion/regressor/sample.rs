//! Random states, at which columns are compared.

use std::f64::consts::PI;

use bgdyn_runtime::Dd;

use crate::bond_graph::Multibody;
use crate::expr::Inputs;
use crate::mechanism::BaseMotion;
use crate::random::Random;

/// Returns states: positions within a turn or a metre, velocities, accelerations, and a given base that moves.
pub(super) fn random_states(graph: &Multibody, count: usize) -> Vec<Inputs<Dd>> {
    let state = |seed: u64| {
        let mut random = Random(0x5eed + seed);
        let mut q: Vec<Dd> = (graph.positions.iter())
            .map(|p| {
                let size = if p.unit == "rad" { PI } else { 1.0 };
                Dd::from_f64(size * random.signed())
            })
            .collect();
        graph.normalize(&mut q);
        let n = graph.coordinates.len();
        let mut all = |size: f64| -> Vec<Dd> {
            (0..n)
                .map(|_| Dd::from_f64(size * random.signed()))
                .collect()
        };
        let (v, a, x, u) = (all(2.0), all(5.0), all(2.0), all(1.0));
        let mut parameters: Vec<Dd> = graph.parameters.iter().map(|p| p.default).collect();
        for p in graph.base.iter().flat_map(BaseMotion::parameters) {
            parameters[p.0] = Dd::from_f64(5.0 * random.signed());
        }
        Inputs {
            q,
            v,
            a,
            x,
            u,
            parameters,
            ..Inputs::default()
        }
    };
    (0..count as u64).map(state).collect()
}
