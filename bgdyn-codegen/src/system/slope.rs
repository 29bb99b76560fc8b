//! The slope of a scene's rates at an instant, for its fastest time constants.

use super::SceneEquations;
use crate::expr::{Builder, Graph, Inputs, Leaf, Signed, Tangent};
use crate::function::Function;
use crate::method::SceneFunction;
use crate::scene::StatePosition;
use bgdyn_runtime::Dd;

impl SceneEquations {
    /// Returns the scene's start for the evaluator, with the inputs that the scene drives at t = 0 and 0
    /// for given inputs.
    pub fn start(&self) -> Inputs<f64> {
        let numbers = |x: &[Dd]| x.iter().map(|x| x.to_f64()).collect::<Vec<f64>>();
        let parameters = self.scene.parameters.iter();
        let mut start = Inputs {
            q: numbers(&self.initial.q),
            v: numbers(&self.initial.v),
            x: numbers(&self.initial.x),
            modes: numbers(&self.initial.modes),
            parameters: parameters.map(|p| p.default.to_f64()).collect(),
            u: vec![0.0; self.scene.layout.inputs.len()],
            t: Some(0.0),
            ..Inputs::default()
        };
        if self.roles().contains(&SceneFunction::Inputs) {
            start.u = self
                .function(SceneFunction::Inputs)
                .evaluate(start.clone())
                .0;
        }
        start
    }

    /// Returns ∂ẏ/∂y at an instant, row by row, for y = positions, velocities, first-order states; `None`
    /// if the mass matrix is singular. `derivative` is that of this scene.
    pub fn slope(&self, derivative: &Function, at: &Inputs<f64>) -> Option<Vec<Vec<f64>>> {
        let layout = &self.scene.layout;
        let (nq, nv, nx) = (layout.nq(), layout.nv(), layout.nx());
        let leaves: Vec<Leaf> = (0..nq)
            .map(Leaf::Position)
            .chain((0..nv).map(Leaf::Velocity))
            .chain((0..nx).map(Leaf::State))
            .collect();
        let [block] = &derivative.blocks[..] else {
            return None;
        };
        let b = Builder::from(derivative.graph.clone());
        let (own, mut coupled) = (&block.outputs[..nv + nx], block.outputs[nv + nx..].iter());
        let position_rate = |position: &StatePosition| match position.coordinate {
            Some(j) => b.leaf(Leaf::Velocity(j)).signed(),
            None => *coupled.next().expect("a rate of every coupled position"),
        };
        let mut rates: Vec<Signed> = layout.positions.iter().map(position_rate).collect();
        rates.extend(own);
        let columns: Vec<Vec<Signed>> = leaves
            .iter()
            .map(|&leaf| {
                let seed = |g: &mut Graph, l| (l == leaf).then(|| g.constant(Dd::ONE));
                let mut tangent = Tangent::new(seed);
                rates
                    .iter()
                    .map(|&e| b.with_graph(|g| tangent.of(g, e)))
                    .collect()
            })
            .collect();
        let n = leaves.len();
        let all: Vec<Signed> = columns.concat();
        let graph = b.into_graph();
        let mut refused = None;
        let values = crate::expr::evaluate(&graph, &all, at, &mut refused);
        let sound = refused.is_none() && values.iter().all(|x| x.is_finite());
        sound.then(|| {
            (0..n)
                .map(|i| (0..n).map(|j| values[j * n + i]).collect())
                .collect()
        })
    }
}
