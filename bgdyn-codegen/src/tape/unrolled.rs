//! A function as one list of instructions: its blocks joined, its columns and inner products unrolled.

use std::ops::Range;

use bgdyn_runtime::Dd;

use super::operation::Operation;
use crate::column_loop::{ColumnLoop, OWN, ResultSource};
use crate::engine::CallArguments;
use crate::expr::{Constant, Graph, Leaf, Node, NodeId, QuickMap, Signed, reachable};
use crate::function::Function;

/// The arrays of arguments; the time is an array of one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ArgumentArray {
    /// Positions.
    Q,
    /// Velocities.
    V,
    /// Accelerations.
    A,
    /// First-order states.
    X,
    /// Inputs.
    U,
    /// Modes.
    Modes,
    /// Run-time parameters.
    Parameters,
    /// The time.
    Time,
}

impl ArgumentArray {
    /// The number of arrays.
    pub const COUNT: usize = ArgumentArray::Time as usize + 1;

    /// Returns the arrays of a call, in the order of the variants.
    pub fn all<'a, T>(from: &'a CallArguments<'_, T>) -> [&'a [T]; ArgumentArray::COUNT] {
        [
            from.q,
            from.v,
            from.a,
            from.x,
            from.u,
            from.modes,
            from.parameters,
            from.t.as_slice(),
        ]
    }
}

/// What an operand is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ValueSource {
    /// A constant, by its index.
    Constant(u32),
    /// A component of an array of arguments.
    Argument(ArgumentArray, u32),
    /// The value of an instruction; the sine, of a pair.
    Result(u32),
    /// The cosine of an instruction for a pair.
    Cosine(u32),
}

/// One operation on earlier values.
#[derive(Clone, Debug)]
pub struct Instruction {
    /// What it computes.
    pub operation: Operation,
    /// Its operands in [`Unrolled::operands`].
    pub operands: Range<usize>,
    /// The joint of a pivot; the index of the constant in a sum of angles; else 0.
    pub detail: usize,
}

/// A function as a list of instructions, operands before their users.
#[derive(Debug, Default)]
pub struct Unrolled {
    /// The instructions, in an order in which they can be executed.
    pub instructions: Vec<Instruction>,
    /// The operands of all instructions.
    pub operands: Vec<ValueSource>,
    /// The constants.
    pub constants: Vec<Dd>,
    /// The constants in sums of angles, rad.
    pub offsets: Vec<(f64, f64)>,
    /// The number of components that are read of each array of arguments: up to the last one.
    pub arguments: [usize; ArgumentArray::COUNT],
    /// The results, in the order of [`Function::evaluate`].
    pub results: Vec<ValueSource>,
}

impl Unrolled {
    /// Returns the instructions that the results of a function need.
    pub fn new(function: &Function) -> Self {
        let mut unroller = Unroller::default();
        let mut made = NodeSources::new(&function.graph);
        let mut passed: Vec<Vec<ValueSource>> = Vec::new();
        for block in &function.blocks {
            let before = |block: usize, index: usize| passed[block][index];
            let results = unroller.append(&function.graph, &block.outputs, &before, &mut made);
            passed.push(results);
        }
        let stage = passed.pop().unwrap_or_default();
        unroller.list.results = match &function.loops {
            None => stage,
            Some(loops) => {
                let groups = loops.groups.iter();
                let found: Vec<_> = groups.map(|g| unroller.columns(g, &stage)).collect();
                let source = |part: &ResultSource| match *part {
                    ResultSource::Stage(k) => stage[k],
                    ResultSource::Column { group, column, row } => found[group][column][row],
                };
                loops.parts.iter().map(source).collect()
            }
        };
        unroller.list
    }
}

/// What the nodes of a graph are in the list so far.
struct NodeSources {
    values: Vec<Option<ValueSource>>,
    /// The instructions for sines and cosines of nodes.
    sines: Vec<Option<u32>>,
    /// The operands of comparisons.
    comparisons: Vec<Option<[ValueSource; 2]>>,
}

impl NodeSources {
    fn new(graph: &Graph) -> Self {
        NodeSources {
            values: vec![None; graph.len()],
            sines: vec![None; graph.len()],
            comparisons: vec![None; graph.len()],
        }
    }

    /// Returns the value of a node, whose instruction precedes its readers.
    fn value(&self, node: NodeId) -> ValueSource {
        self.values[node.index()].expect("operands precede their users")
    }
}

#[derive(Default)]
struct Unroller {
    list: Unrolled,
    constants: QuickMap<Constant, u32>,
    /// The values with the opposite sign.
    negated: QuickMap<ValueSource, ValueSource>,
}

impl Unroller {
    /// Adds every column of a loop; returns the results of each.
    fn columns(&mut self, columns: &ColumnLoop, stage: &[ValueSource]) -> Vec<Vec<ValueSource>> {
        let one = |own: &Vec<usize>| {
            let before = |block: usize, index: usize| match block {
                OWN => stage[own[index]],
                _ => stage[columns.shared[index]],
            };
            let mut made = NodeSources::new(&columns.graph);
            self.append(&columns.graph, &columns.outputs, &before, &mut made)
        };
        columns.own.iter().map(one).collect()
    }

    /// Adds what the outputs need and `made` has not; `before` returns results of earlier blocks.
    fn append(
        &mut self,
        graph: &Graph,
        outputs: &[Signed],
        before: &dyn Fn(usize, usize) -> ValueSource,
        made: &mut NodeSources,
    ) -> Vec<ValueSource> {
        let needed = reachable(graph, outputs);
        for i in (0..graph.len()).filter(|&i| needed[i]) {
            let new = made.values[i].is_none()
                && made.sines[i].is_none()
                && made.comparisons[i].is_none();
            if new {
                self.node(i, graph.node(NodeId::at(i)), before, made);
            }
        }
        outputs.iter().map(|&e| self.signed(e, made)).collect()
    }

    fn node(
        &mut self,
        i: usize,
        node: &Node,
        before: &dyn Fn(usize, usize) -> ValueSource,
        made: &mut NodeSources,
    ) {
        use Operation as Op;
        let plus = |id: &NodeId| made.value(*id);
        let value = match node {
            Node::Constant(c) => self.constant(*c),
            Node::Leaf(leaf) => self.leaf(*leaf, before),
            Node::Add(a, b) => {
                let operation = if b.negative { Op::Subtract } else { Op::Add };
                self.push(operation, &[plus(a), plus(&b.node)])
            }
            Node::Mul(a, b) => self.push(Op::Multiply, &[plus(a), plus(b)]),
            Node::Div(a, b) => self.push(Op::Divide, &[plus(a), plus(b)]),
            Node::MulAdd(a, b, negative, c) => {
                let operation = match (negative, c.negative) {
                    (false, false) => Op::MultiplyAdd,
                    (false, true) => Op::MultiplySubtract,
                    (true, false) => Op::NegativeMultiplyAdd,
                    (true, true) => Op::NegativeMultiplySubtract,
                };
                self.push(operation, &[plus(a), plus(b), plus(&c.node)])
            }
            Node::Angle(terms, size, negative) => {
                let size = size.value();
                let offset = if *negative { -size } else { size };
                let terms: Vec<_> = terms.iter().map(|&t| self.signed(t, made)).collect();
                made.sines[i] = Some(self.sines(&terms, offset));
                return;
            }
            Node::Sin(a) => ValueSource::Result(self.pair(*a, made)),
            Node::Cos(a) => ValueSource::Cosine(self.pair(*a, made)),
            Node::Sqrt(a) => self.unary(Op::SquareRoot, *a, made),
            Node::Exp(a) => self.unary(Op::Exponential, *a, made),
            Node::Ln(a) => self.unary(Op::Logarithm, *a, made),
            Node::Tanh(a) => self.push(Op::HyperbolicTangent, &[plus(a)]),
            Node::Abs(a) => self.push(Op::Absolute, &[plus(a)]),
            Node::Sign(a) => self.push(Op::Sign, &[plus(a)]),
            Node::Min(a, b) => self.binary(Op::Minimum, [*a, *b], made),
            Node::Max(a, b) => self.binary(Op::Maximum, [*a, *b], made),
            Node::Less(a, b) => {
                made.comparisons[i] = Some([*a, *b].map(|e| self.signed(e, made)));
                return;
            }
            Node::Select(condition, a, b) => {
                let [left, right] =
                    made.comparisons[condition.index()].expect("a condition is a comparison");
                let [a, b] = [*a, *b].map(|e| self.signed(e, made));
                self.push(Op::Select, &[left, right, a, b])
            }
            Node::Pivot(value, magnitude, joint) => {
                let pivot = self.binary(Op::Pivot, [*value, *magnitude], made);
                if let Some(last) = self.list.instructions.last_mut() {
                    last.detail = *joint;
                }
                pivot
            }
        };
        made.values[i] = Some(value);
    }

    fn unary(&mut self, operation: Operation, a: Signed, made: &NodeSources) -> ValueSource {
        let a = self.signed(a, made);
        self.push(operation, &[a])
    }

    fn binary(&mut self, operation: Operation, ab: [Signed; 2], made: &NodeSources) -> ValueSource {
        let operands = ab.map(|e| self.signed(e, made));
        self.push(operation, &operands)
    }

    fn push(&mut self, operation: Operation, operands: &[ValueSource]) -> ValueSource {
        let list = &mut self.list;
        let from = list.operands.len();
        list.operands.extend_from_slice(operands);
        list.instructions.push(Instruction {
            operation,
            operands: from..list.operands.len(),
            detail: 0,
        });
        ValueSource::Result(list.instructions.len() as u32 - 1)
    }

    /// Adds the sine and the cosine of a sum of angles.
    fn sines(&mut self, terms: &[ValueSource], offset: Dd) -> u32 {
        let detail = self.list.offsets.len();
        self.list.offsets.push((offset.hi(), offset.lo()));
        self.push(Operation::Sines, terms);
        let last = self.list.instructions.len() - 1;
        self.list.instructions[last].detail = detail;
        last as u32
    }

    /// Returns the instruction for sine and cosine of a node: a sum of angles, or any value.
    fn pair(&mut self, angle: NodeId, made: &mut NodeSources) -> u32 {
        let i = angle.index();
        match made.sines[i] {
            Some(pair) => pair,
            None => {
                let pair = self.sines(&[made.value(angle)], Dd::ZERO);
                made.sines[i] = Some(pair);
                pair
            }
        }
    }

    fn constant(&mut self, constant: Constant) -> ValueSource {
        let constants = &mut self.list.constants;
        let index = *self.constants.entry(constant).or_insert_with(|| {
            constants.push(constant.value());
            constants.len() as u32 - 1
        });
        ValueSource::Constant(index)
    }

    fn leaf(&mut self, leaf: Leaf, before: &dyn Fn(usize, usize) -> ValueSource) -> ValueSource {
        let (array, i) = match leaf {
            Leaf::Position(i) => (ArgumentArray::Q, i),
            Leaf::Velocity(i) => (ArgumentArray::V, i),
            Leaf::Acceleration(i) => (ArgumentArray::A, i),
            Leaf::State(i) => (ArgumentArray::X, i),
            Leaf::Input(i) => (ArgumentArray::U, i),
            Leaf::Mode(i) => (ArgumentArray::Modes, i),
            Leaf::Parameter(i) => (ArgumentArray::Parameters, i),
            Leaf::Time => (ArgumentArray::Time, 0),
            Leaf::BlockResult { block, index } => return before(block, index),
        };
        let read = &mut self.list.arguments[array as usize];
        *read = (*read).max(i + 1);
        ValueSource::Argument(array, i as u32)
    }

    /// Returns the value of a signed node.
    fn signed(&mut self, e: Signed, made: &NodeSources) -> ValueSource {
        let value = made.value(e.node);
        if !e.negative {
            return value;
        }
        if let Some(&negated) = self.negated.get(&value) {
            return negated;
        }
        let negated = self.push(Operation::Negate, &[value]);
        self.negated.insert(value, negated);
        negated
    }
}
