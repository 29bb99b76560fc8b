//! A list of instructions as a function of Cranelift: one block of SSA values, without a branch.

use bgdyn_codegen::tape::{ArgumentArray, Instruction, Operation, Unrolled, ValueSource};
use bgdyn_runtime::kernel::F64_PIVOT_FLOOR;
use cranelift_codegen::ir::condcodes::FloatCC;
use cranelift_codegen::ir::types::{F64, I32};
use cranelift_codegen::ir::{
    AbiParam, Function, InstBuilder, MemFlags, SigRef, Signature, Type, Value,
};
use cranelift_codegen::isa::TargetIsa;
use cranelift_frontend::{FunctionBuilder, FunctionBuilderContext};

use crate::elementary::called;
use crate::pairs::Body;
use crate::sines::{AngleSum, partners, sines};

/// Size of a number, in bytes.
const NUMBER: usize = size_of::<f64>();

/// Returns the function that computes the results of a list. Its parameters: a pointer to one pointer for each array of
/// arguments, a pointer to the results. It returns 0 if the results are not to be used.
pub(crate) fn translate(list: &Unrolled, isa: &dyn TargetIsa, fused: bool) -> Function {
    let pointer = isa.pointer_type();
    let mut signature = Signature::new(isa.default_call_conv());
    signature.params.extend([AbiParam::new(pointer); 2]);
    signature.returns.push(AbiParam::new(I32));
    let mut function = Function::new();
    function.signature = signature;
    let mut context = FunctionBuilderContext::new();
    let mut builder = FunctionBuilder::new(&mut function, &mut context);
    let block = builder.create_block();
    builder.append_block_params_for_function_params(block);
    builder.switch_to_block(block);
    builder.seal_block(block);
    let (arrays, results) = (
        builder.block_params(block)[0],
        builder.block_params(block)[1],
    );
    let mut of_one_number = Signature::new(isa.default_call_conv());
    of_one_number.params.push(AbiParam::new(F64));
    of_one_number.returns.push(AbiParam::new(F64));
    let of_one_number = builder.import_signature(of_one_number);
    let mut translation = Translation {
        list,
        body: Body::new(builder, fused),
        pointer,
        of_one_number,
        arrays: [None; ArgumentArray::COUNT],
        arguments: list.arguments.map(|count| vec![None; count]),
        values: vec![None; list.instructions.len()],
        conditions: Vec::new(),
    };
    translation.load_arrays(arrays);
    translation.instructions();
    translation.store(results);
    translation.finish();
    function
}

struct Translation<'a, 'f> {
    list: &'a Unrolled,
    body: Body<'f>,
    /// The type of pointers.
    pointer: Type,
    /// The signature of functions of one number.
    of_one_number: SigRef,
    /// Pointers to the arrays that are read.
    arrays: [Option<Value>; ArgumentArray::COUNT],
    /// The components that were read so far.
    arguments: [Vec<Option<Value>>; ArgumentArray::COUNT],
    /// The values of the instructions: one, or sine and cosine.
    values: Vec<Option<[Value; 2]>>,
    /// What must be true for the results to be used.
    conditions: Vec<Value>,
}

/// Memory that is there, aligned, and not written during a call.
fn unchanged() -> MemFlags {
    MemFlags::trusted().with_readonly()
}

/// Returns the distance of a component from the begin of its array, in bytes.
fn offset(component: usize) -> i32 {
    i32::try_from(NUMBER * component).expect("arrays are shorter than 2 GB")
}

impl Translation<'_, '_> {
    /// Loads the pointers to the arrays that are read.
    fn load_arrays(&mut self, from: Value) {
        let size = self.pointer.bytes() as i32;
        for (k, count) in self.list.arguments.into_iter().enumerate() {
            let load = |f: &mut FunctionBuilder<'_>| {
                f.ins()
                    .load(self.pointer, unchanged(), from, size * k as i32)
            };
            self.arrays[k] = (count > 0).then(|| self.body.add(load));
        }
    }

    /// Adds all instructions.
    fn instructions(&mut self) {
        let partners = partners(self.list);
        for (i, instruction) in self.list.instructions.iter().enumerate() {
            if self.values[i].is_some() {
                continue;
            }
            if instruction.operation == Operation::Sines {
                let j = partners[i].unwrap_or(i);
                let sums = [i, j].map(|k| self.angle_sum(&self.list.instructions[k].clone()));
                let [first, second] = sines(&self.body, [&sums[0], &sums[1]]);
                self.values[j] = Some(second);
                self.values[i] = Some(first);
            } else {
                let value = self.instruction(instruction);
                self.values[i] = Some([value; 2]);
            }
        }
    }

    fn angle_sum(&mut self, instruction: &Instruction) -> AngleSum {
        let operands = self.list.operands[instruction.operands.clone()].iter();
        let angles: Vec<Value> = operands.map(|&operand| self.operand(operand)).collect();
        AngleSum::new(&self.body, &angles, self.list.offsets[instruction.detail])
    }

    /// Returns the value of an operand.
    fn operand(&mut self, source: ValueSource) -> Value {
        match source {
            ValueSource::Constant(i) => {
                let constant = self.list.constants[i as usize].hi();
                self.body.add(|f| f.ins().f64const(constant))
            }
            ValueSource::Argument(array, i) => self.argument(array, i as usize),
            ValueSource::Result(i) => self.known(i)[0],
            ValueSource::Cosine(i) => self.known(i)[1],
        }
    }

    fn known(&self, i: u32) -> [Value; 2] {
        self.values[i as usize].expect("operands precede their users")
    }

    fn argument(&mut self, array: ArgumentArray, i: usize) -> Value {
        let from = self.arrays[array as usize].expect("an array that is read");
        let load = || {
            self.body
                .add(|f| f.ins().load(F64, unchanged(), from, offset(i)))
        };
        *self.arguments[array as usize][i].get_or_insert_with(load)
    }

    /// Returns the N operands of an instruction.
    fn operands<const N: usize>(&mut self, instruction: &Instruction) -> [Value; N] {
        let from = instruction.operands.start;
        std::array::from_fn(|k| self.operand(self.list.operands[from + k]))
    }

    /// Adds an instruction with one value.
    fn instruction(&mut self, instruction: &Instruction) -> Value {
        use Operation as Op;
        match instruction.operation {
            Op::Negate | Op::SquareRoot | Op::Absolute | Op::Sign => self.unary(instruction),
            Op::Exponential | Op::Logarithm | Op::HyperbolicTangent => self.call(instruction),
            Op::Add | Op::Subtract | Op::Multiply | Op::Divide => self.binary(instruction),
            Op::MultiplyAdd
            | Op::MultiplySubtract
            | Op::NegativeMultiplyAdd
            | Op::NegativeMultiplySubtract => self.multiply_add(instruction),
            Op::Minimum => self.extreme(instruction, FloatCC::LessThan),
            Op::Maximum => self.extreme(instruction, FloatCC::GreaterThan),
            Op::Select => {
                let [a, b, c, d] = self.operands(instruction);
                self.body.add(|f| {
                    let less = f.ins().fcmp(FloatCC::LessThan, a, b);
                    f.ins().select(less, c, d)
                })
            }
            Op::Pivot => self.pivot(instruction),
            Op::Sines => unreachable!("sines are added in pairs"),
        }
    }

    fn unary(&mut self, instruction: &Instruction) -> Value {
        let [a] = self.operands(instruction);
        self.body.add(|f| match instruction.operation {
            Operation::Negate => f.ins().fneg(a),
            Operation::SquareRoot => f.ins().sqrt(a),
            Operation::Absolute => f.ins().fabs(a),
            // 1 above zero, −1 below it, else a · 0: ±0, or NaN for NaN.
            _ => {
                let [zero, one, minus_one] = [0.0, 1.0, -1.0].map(|x| f.ins().f64const(x));
                let is_above = f.ins().fcmp(FloatCC::GreaterThan, a, zero);
                let is_below = f.ins().fcmp(FloatCC::LessThan, a, zero);
                let neither = f.ins().fmul(a, zero);
                let other = f.ins().select(is_below, minus_one, neither);
                f.ins().select(is_above, one, other)
            }
        })
    }

    fn binary(&mut self, instruction: &Instruction) -> Value {
        let [a, b] = self.operands(instruction);
        self.body.add(|f| match instruction.operation {
            Operation::Add => f.ins().fadd(a, b),
            Operation::Subtract => f.ins().fsub(a, b),
            Operation::Multiply => f.ins().fmul(a, b),
            _ => f.ins().fdiv(a, b),
        })
    }

    /// ±a · b ± c. A sign may be taken out of a product, and x + (−y) is x − y: neither changes a bit.
    fn multiply_add(&mut self, instruction: &Instruction) -> Value {
        let [a, b, c] = self.operands(instruction);
        let body = &self.body;
        let negative = |x| body.add(|f| f.ins().fneg(x));
        match (instruction.operation, body.fused) {
            (Operation::MultiplyAdd, _) => body.multiply_add(a, b, c),
            (Operation::NegativeMultiplyAdd, _) => body.multiply_subtract_from(a, b, c),
            (Operation::MultiplySubtract, true) => body.multiply_add(a, b, negative(c)),
            (Operation::MultiplySubtract, false) => body.add(|f| {
                let product = f.ins().fmul(a, b);
                f.ins().fsub(product, c)
            }),
            _ => body.multiply_subtract_from(a, b, negative(c)),
        }
    }

    /// a where the comparison with b is true or a is NaN, else b.
    fn extreme(&mut self, instruction: &Instruction, comparison: FloatCC) -> Value {
        let [a, b] = self.operands(instruction);
        self.body.add(|f| {
            let compared = f.ins().fcmp(comparison, a, b);
            let is_nan = f.ins().fcmp(FloatCC::Unordered, a, a);
            let first = f.ins().bor(compared, is_nan);
            f.ins().select(first, a, b)
        })
    }

    fn call(&mut self, instruction: &Instruction) -> Value {
        let [a] = self.operands(instruction);
        let function = called(instruction.operation).expect("an operation that is called");
        let address = function as usize as i64;
        self.body.add(|f| {
            let address = f.ins().iconst(self.pointer, address);
            let call = f.ins().call_indirect(self.of_one_number, address, &[a]);
            f.inst_results(call)[0]
        })
    }

    /// Demands what the runtime's `checked_pivot` does: a positive finite pivot above the rounding errors of its terms.
    /// NaN fails each comparison.
    fn pivot(&mut self, instruction: &Instruction) -> Value {
        let [value, magnitude] = self.operands(instruction);
        let conditions = self.body.add(|f| {
            let [zero, largest, ulps] =
                [0.0, f64::MAX, F64_PIVOT_FLOOR].map(|x| f.ins().f64const(x));
            let floor = f.ins().fmul(magnitude, ulps);
            [
                f.ins().fcmp(FloatCC::GreaterThan, value, floor),
                f.ins().fcmp(FloatCC::GreaterThan, value, zero),
                f.ins().fcmp(FloatCC::LessThanOrEqual, value, largest),
            ]
        });
        self.conditions.extend(conditions);
        value
    }

    /// Stores the results, and demands that their sum is finite: then all are. If only the sum is not, the tape finds
    /// that out.
    fn store(&mut self, to: Value) {
        let sources = self.list.results.iter();
        let values: Vec<Value> = sources.map(|&source| self.operand(source)).collect();
        for (k, &value) in values.iter().enumerate() {
            self.body
                .add(|f| f.ins().store(MemFlags::trusted(), value, to, offset(k)));
        }
        let Some(sum) = self.sum(values) else {
            return;
        };
        let finite = self.body.add(|f| {
            let (size, largest) = (f.ins().fabs(sum), f.ins().f64const(f64::MAX));
            f.ins().fcmp(FloatCC::LessThanOrEqual, size, largest)
        });
        self.conditions.push(finite);
    }

    /// Returns the sum of values, added in pairs.
    fn sum(&self, mut values: Vec<Value>) -> Option<Value> {
        while values.len() > 1 {
            let add = |pair: &[Value]| match *pair {
                [a, b] => self.body.add(|f| f.ins().fadd(a, b)),
                _ => pair[0],
            };
            values = values.chunks(2).map(add).collect();
        }
        values.pop()
    }

    /// Returns from the function: 1 if everything that was demanded is true.
    fn finish(self) {
        let (mut f, limits) = self.body.finish();
        let mut conditions = self.conditions;
        if let Some(within) = limits.into_iter().reduce(|a, b| f.ins().band(a, b)) {
            conditions.push(f.ins().vall_true(within));
        }
        let all = conditions.into_iter().reduce(|a, b| f.ins().band(a, b));
        let usable = match all {
            Some(all) => f.ins().uextend(I32, all),
            None => f.ins().iconst(I32, 1),
        };
        f.ins().return_(&[usable]);
        f.finalize();
    }
}
