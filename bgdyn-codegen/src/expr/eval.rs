//! Evaluates a function in any scalar type, without a compiler.

use bgdyn_runtime::Scalar;

use super::{Graph, Leaf, Node, Signed, reachable};

/// The values of the leaves.
#[derive(Clone, Debug, Default)]
pub struct Inputs<T> {
    /// Positions.
    pub q: Vec<T>,
    /// Velocities.
    pub v: Vec<T>,
    /// Accelerations.
    pub a: Vec<T>,
    /// First-order states.
    pub x: Vec<T>,
    /// Inputs: joint efforts first.
    pub u: Vec<T>,
    /// Modes.
    pub modes: Vec<T>,
    /// Run-time parameters.
    pub parameters: Vec<T>,
    /// Time.
    pub t: Option<T>,
    /// Results of the blocks evaluated so far.
    pub passed: Vec<Vec<T>>,
}

impl<T> Inputs<T> {
    /// Returns inputs with results of blocks only.
    pub(crate) fn of_blocks(passed: Vec<Vec<T>>) -> Self {
        Inputs {
            q: Vec::new(),
            v: Vec::new(),
            a: Vec::new(),
            x: Vec::new(),
            u: Vec::new(),
            modes: Vec::new(),
            parameters: Vec::new(),
            t: None,
            passed,
        }
    }
}

impl<T: Scalar> Inputs<T> {
    fn leaf(&self, leaf: Leaf) -> T {
        match leaf {
            Leaf::Position(i) => self.q[i],
            Leaf::Velocity(i) => self.v[i],
            Leaf::Acceleration(i) => self.a[i],
            Leaf::State(i) => self.x[i],
            Leaf::Input(i) => self.u[i],
            Leaf::Mode(i) => self.modes[i],
            Leaf::Parameter(i) => self.parameters[i],
            Leaf::Time => self.t.expect("the time"),
            Leaf::BlockResult { block, index } => self.passed[block][index],
        }
    }
}

/// Returns the values of `outputs`; `refused` records the pivots that were refused.
///
/// # Panics
/// If `inputs` lacks a leaf that the outputs read.
pub fn evaluate<T: Scalar>(
    graph: &Graph,
    outputs: &[Signed],
    inputs: &Inputs<T>,
    refused: &mut T::Refused,
) -> Vec<T> {
    let needed = reachable(graph, outputs);
    let mut state = Evaluation {
        values: vec![T::from_f64(0.0); graph.len()],
        masks: vec![None; graph.len()],
        sines: vec![None; graph.len()],
    };
    for (i, node) in graph.nodes.iter().enumerate() {
        if needed[i] {
            state.step(i, node, inputs, refused);
        }
    }
    outputs.iter().map(|&e| state.get(e)).collect()
}

struct Evaluation<T: Scalar> {
    values: Vec<T>,
    masks: Vec<Option<T::Mask>>,
    /// Sine and cosine of a node, if they are used.
    sines: Vec<Option<(T, T)>>,
}

impl<T: Scalar> Evaluation<T> {
    fn get(&self, e: Signed) -> T {
        let x = self.values[e.node.0 as usize];
        if e.negative { -x } else { x }
    }

    fn step(&mut self, i: usize, node: &Node, inputs: &Inputs<T>, refused: &mut T::Refused) {
        let at = |id: &super::NodeId| self.values[id.0 as usize];
        let value = match node {
            Node::Constant(c) => T::from_parts(c.value().hi(), c.value().lo()),
            Node::Leaf(leaf) => inputs.leaf(*leaf),
            Node::Add(a, b) if b.negative => at(a) - at(&b.node),
            Node::Add(a, b) => at(a) + at(&b.node),
            Node::Mul(a, b) => at(a) * at(b),
            Node::Div(a, b) => at(a) / at(b),
            Node::MulAdd(a, b, negative, c) => {
                let a = if *negative { -at(a) } else { at(a) };
                a.mul_add(at(b), self.get(*c))
            }
            Node::Sqrt(a) => self.get(*a).sqrt(),
            Node::Angle(terms, offset, negative) => {
                let terms: Vec<T> = terms.iter().map(|t| self.get(*t)).collect();
                let offset = if *negative {
                    -offset.value()
                } else {
                    offset.value()
                };
                self.sines[i] = Some(T::sin_cos_sum(&terms, (offset.hi(), offset.lo())));
                return;
            }
            Node::Sin(a) => self.sine_cosine(*a).0,
            Node::Cos(a) => self.sine_cosine(*a).1,
            Node::Exp(a) => self.get(*a).exp(),
            Node::Ln(a) => self.get(*a).ln(),
            Node::Tanh(a) => at(a).tanh(),
            Node::Abs(a) => at(a).abs(),
            Node::Min(a, b) => self.get(*a).min(self.get(*b)),
            Node::Max(a, b) => self.get(*a).max(self.get(*b)),
            Node::Sign(a) => at(a).sign(),
            Node::Less(a, b) => {
                self.masks[i] = Some(self.get(*a).less(self.get(*b)));
                return;
            }
            Node::Select(condition, a, b) => {
                let mask = self.masks[condition.0 as usize].expect("a condition is a comparison");
                T::select(mask, self.get(*a), self.get(*b))
            }
            Node::Pivot(value, magnitude, joint) => {
                self.get(*value)
                    .checked_pivot(self.get(*magnitude), *joint, refused)
            }
        };
        self.values[i] = value;
    }

    fn sine_cosine(&mut self, angle: super::NodeId) -> (T, T) {
        let i = angle.0 as usize;
        *self.sines[i].get_or_insert_with(|| self.values[i].sin_cos())
    }
}
