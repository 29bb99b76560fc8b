//! Two numbers in a register of 128 bits: the number type over which the runtime's kernel of sines writes its own code.
//!
//! The kernel is generic over [`SineLanes`]. Here a number of that type is not a number but a value of the function that is
//! made, and an operation adds an instruction: the kernel is not written a second time.

use std::cell::RefCell;
use std::ops::{Add, Mul, Neg, Sub};

use bgdyn_runtime::kernel::{Coefficients, SineLanes};
use cranelift_codegen::ir::condcodes::FloatCC;
use cranelift_codegen::ir::types::{F64X2, I64X2};
use cranelift_codegen::ir::{ConstantData, Endianness, InstBuilder, MemFlags, Value};
use cranelift_frontend::FunctionBuilder;

/// A function while it is made.
pub(crate) struct Body<'f> {
    builder: RefCell<FunctionBuilder<'f>>,
    /// Whether a product and a sum are rounded once.
    pub fused: bool,
    /// Masks of pairs, all ones where a number is within its limit.
    limits: RefCell<Vec<Value>>,
}

impl<'f> Body<'f> {
    pub(crate) fn new(builder: FunctionBuilder<'f>, fused: bool) -> Self {
        Body {
            builder: RefCell::new(builder),
            fused,
            limits: RefCell::default(),
        }
    }

    /// Adds instructions by the builder.
    pub(crate) fn add<R>(&self, instruction: impl FnOnce(&mut FunctionBuilder<'f>) -> R) -> R {
        instruction(&mut self.builder.borrow_mut())
    }

    /// Returns the builder, and the masks of what must be within limits.
    pub(crate) fn finish(self) -> (FunctionBuilder<'f>, Vec<Value>) {
        (self.builder.into_inner(), self.limits.into_inner())
    }

    /// Returns a · b + c of numbers or pairs, rounded as in this engine.
    pub(crate) fn multiply_add(&self, a: Value, b: Value, c: Value) -> Value {
        self.add(|f| match self.fused {
            true => f.ins().fma(a, b, c),
            false => {
                let product = f.ins().fmul(a, b);
                f.ins().fadd(product, c)
            }
        })
    }

    /// Returns c − a · b, rounded as in this engine. Unfused, the bits are those of −a · b + c.
    pub(crate) fn multiply_subtract_from(&self, a: Value, b: Value, c: Value) -> Value {
        self.add(|f| match self.fused {
            true => {
                let negative = f.ins().fneg(a);
                f.ins().fma(negative, b, c)
            }
            false => {
                let product = f.ins().fmul(a, b);
                f.ins().fsub(c, product)
            }
        })
    }

    /// Returns a pair of two numbers.
    pub(crate) fn pair(&self, [first, second]: [Value; 2]) -> Pair<'_, 'f> {
        let value = self.add(|f| {
            let pair = f.ins().scalar_to_vector(F64X2, first);
            f.ins().insertlane(pair, second, 1)
        });
        Pair::Value(self, value)
    }

    /// Returns the numbers of a pair.
    pub(crate) fn numbers(&self, pair: Pair<'_, 'f>) -> [Value; 2] {
        let pair = pair.value(self);
        [0, 1].map(|k| self.add(|f| f.ins().extractlane(pair, k)))
    }

    /// Returns a constant of 128 bits with these bits twice.
    fn twice(&self, bits: u64) -> Value {
        let bytes = [bits.to_le_bytes(); 2].concat();
        self.add(|f| {
            let constant = f.func.dfg.constants.insert(ConstantData::from(bytes));
            f.ins().vconst(F64X2, constant)
        })
    }
}

/// A pair of numbers: constants, or a value.
#[derive(Clone, Copy)]
pub(crate) enum Pair<'b, 'f> {
    /// This number twice.
    Constant(f64),
    /// A value of the function that is made.
    Value(&'b Body<'f>, Value),
}

impl<'b, 'f> Pair<'b, 'f> {
    /// Returns it as a value.
    fn value(self, body: &Body<'f>) -> Value {
        match self {
            Pair::Constant(x) => body.twice(x.to_bits()),
            Pair::Value(_, value) => value,
        }
    }

    /// Returns the function that is made; the kernel has no operation on constants alone.
    fn body(all: &[Self]) -> &'b Body<'f> {
        let found = all.iter().find_map(|pair| match *pair {
            Pair::Value(body, _) => Some(body),
            Pair::Constant(_) => None,
        });
        found.expect("one operand is no constant")
    }

    /// Adds an instruction of N operands.
    fn instruction<const N: usize>(
        operands: [Self; N],
        add: impl FnOnce(&'b Body<'f>, [Value; N]) -> Value,
    ) -> Self {
        let body = Pair::body(&operands);
        let values = operands.map(|pair| pair.value(body));
        Pair::Value(body, add(body, values))
    }
}

impl Add for Pair<'_, '_> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Pair::instruction([self, other], |body, [a, b]| {
            body.add(|f| f.ins().fadd(a, b))
        })
    }
}

impl Sub for Pair<'_, '_> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Pair::instruction([self, other], |body, [a, b]| {
            body.add(|f| f.ins().fsub(a, b))
        })
    }
}

impl Mul for Pair<'_, '_> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Pair::instruction([self, other], |body, [a, b]| {
            body.add(|f| f.ins().fmul(a, b))
        })
    }
}

impl Neg for Pair<'_, '_> {
    type Output = Self;
    fn neg(self) -> Self {
        match self {
            Pair::Constant(x) => Pair::Constant(-x),
            Pair::Value(..) => Pair::instruction([self], |body, [a]| body.add(|f| f.ins().fneg(a))),
        }
    }
}

impl SineLanes for Pair<'_, '_> {
    const LIMIT: f64 = <f64 as SineLanes>::LIMIT;
    const TAIL_LIMIT: f64 = <f64 as SineLanes>::TAIL_LIMIT;
    const MAGIC: f64 = <f64 as SineLanes>::MAGIC;
    const COEFFICIENTS: Coefficients = <f64 as SineLanes>::COEFFICIENTS;

    fn splat(x: f64) -> Self {
        Pair::Constant(x)
    }

    fn fused(self, b: Self, c: Self) -> Self {
        Pair::instruction([self, b, c], |body, [a, b, c]| body.multiply_add(a, b, c))
    }

    fn minus_product(self, b: Self, c: Self) -> Self {
        Pair::instruction([self, b, c], |body, [a, b, c]| {
            body.multiply_subtract_from(a, b, c)
        })
    }

    /// Demands it: a call for which it is false gives no results.
    fn all_below(self, limit: f64) -> bool {
        let body = Pair::body(&[self]);
        let (pair, limit) = (self.value(body), body.twice(limit.to_bits()));
        let mask = body.add(|f| {
            let size = f.ins().fabs(pair);
            f.ins().fcmp(FloatCC::LessThanOrEqual, size, limit)
        });
        body.limits.borrow_mut().push(mask);
        true
    }

    /// As the runtime's lanes: the last digit of n swaps sine and cosine; the second last one is the sign of the sine,
    /// that of n + 1 the sign of the cosine.
    fn turned(quarters: Self, s: Self, c: Self) -> (Self, Self) {
        let body = Pair::body(&[quarters, s, c]);
        let [n, s, c] = [quarters, s, c].map(|pair| body.bits(pair.value(body)));
        let [zero, one, two] = [0, 1, 2].map(|k| body.bits(body.twice(k)));
        let (s, c) = body.add(|f| {
            let odd = f.ins().band(n, one);
            let odd = f.ins().isub(zero, odd);
            let (sine, cosine) = (f.ins().bitselect(odd, c, s), f.ins().bitselect(odd, s, c));
            let next = f.ins().iadd(n, one);
            let [s, c] = [(n, sine), (next, cosine)].map(|(n, size)| {
                let sign = f.ins().band(n, two);
                let sign = f.ins().ishl_imm(sign, 62);
                let turned = f.ins().bxor(size, sign);
                f.ins().bitcast(F64X2, LANES, turned)
            });
            (s, c)
        });
        (Pair::Value(body, s), Pair::Value(body, c))
    }
}

/// The order of the lanes of a register whose type changes.
const LANES: MemFlags = MemFlags::new().with_endianness(Endianness::Little);

impl Body<'_> {
    /// Returns the bits of a pair of numbers.
    fn bits(&self, pair: Value) -> Value {
        self.add(|f| f.ins().bitcast(I64X2, LANES, pair))
    }
}
