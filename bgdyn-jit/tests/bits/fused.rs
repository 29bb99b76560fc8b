//! Fused machine code against the evaluator over a scalar that fuses: the bits of a build for a processor with fused
//! operations, whatever this build has.

use std::ops::{Add, Div, Mul, Neg, Sub};

use bgdyn_codegen::engine::CallArguments;
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_jit::Jit;
use bgdyn_runtime::kernel::{Coefficients, SineLanes, sin_cos_in_range};
use bgdyn_runtime::nalgebra::SVector;
use bgdyn_runtime::{Look, Scalar, Singular};

use super::agreement::{same, states};
use super::files;
use super::functions::{functions, scene_functions};

/// An `f64` that rounds a product and a sum once.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Fused(f64);

macro_rules! operators {
    ($($operator:ident $function:ident,)*) => {$(
        impl $operator for Fused {
            type Output = Self;
            fn $function(self, other: Self) -> Self {
                Fused($operator::$function(self.0, other.0))
            }
        }
    )*};
}
operators! { Add add, Sub sub, Mul mul, Div div, }

impl Neg for Fused {
    type Output = Self;
    fn neg(self) -> Self {
        Fused(-self.0)
    }
}

impl SineLanes for Fused {
    const LIMIT: f64 = <f64 as SineLanes>::LIMIT;
    const TAIL_LIMIT: f64 = <f64 as SineLanes>::TAIL_LIMIT;
    const MAGIC: f64 = <f64 as SineLanes>::MAGIC;
    const COEFFICIENTS: Coefficients = <f64 as SineLanes>::COEFFICIENTS;

    fn splat(x: f64) -> Self {
        Fused(x)
    }
    fn fused(self, b: Self, c: Self) -> Self {
        Fused(f64::mul_add(self.0, b.0, c.0))
    }
    fn all_below(self, limit: f64) -> bool {
        self.0.all_below(limit)
    }
    fn turned(quarters: Self, s: Self, c: Self) -> (Self, Self) {
        let (s, c) = f64::turned(quarters.0, s.0, c.0);
        (Fused(s), Fused(c))
    }
}

impl Scalar for Fused {
    type Mask = bool;
    type Refused = Option<usize>;
    type Singular<const N: usize> = Singular;

    fn from_f64(x: f64) -> Self {
        Fused(x)
    }
    fn mul_add(self, b: Self, c: Self) -> Self {
        self.fused(b, c)
    }
    fn sqrt(self) -> Self {
        Fused(Scalar::sqrt(self.0))
    }
    fn sin_cos(self) -> (Self, Self) {
        sin_cos_in_range(self, None)
    }
    /// Knuth's two-sum, term by term.
    fn sin_cos_sum(angles: &[Self], (hi, lo): (f64, f64)) -> (Self, Self) {
        let (mut sum, mut tail, later) = match (hi, lo) {
            (0.0, 0.0) => (angles[0].0, None, &angles[1..]),
            _ => (hi, Some(lo), angles),
        };
        for angle in later {
            let next = sum + angle.0;
            let back = next - sum;
            let left = angle.0 - back;
            let left = tail.map_or(left, |tail| left + tail);
            tail = Some((sum - (next - back)) + left);
            sum = next;
        }
        sin_cos_in_range(Fused(sum), tail.map(Fused))
    }
    fn exp(self) -> Self {
        Fused(Scalar::exp(self.0))
    }
    fn ln(self) -> Self {
        Fused(Scalar::ln(self.0))
    }
    fn tanh(self) -> Self {
        Fused(Scalar::tanh(self.0))
    }
    fn abs(self) -> Self {
        Fused(self.0.abs())
    }
    fn min(self, other: Self) -> Self {
        Fused(Scalar::min(self.0, other.0))
    }
    fn max(self, other: Self) -> Self {
        Fused(Scalar::max(self.0, other.0))
    }
    fn sign(self) -> Self {
        Fused(self.0.sign())
    }
    fn less(self, other: Self) -> bool {
        self.0.less(other.0)
    }
    fn select(mask: bool, a: Self, b: Self) -> Self {
        if mask { a } else { b }
    }
    fn none_refused() -> Option<usize> {
        None
    }
    fn checked_pivot(self, magnitude: Self, joint: usize, refused: &mut Option<usize>) -> Self {
        Fused(self.0.checked_pivot(magnitude.0, joint, refused))
    }
    fn succeeded<const N: usize>(_: &SVector<Self, N>, _: Option<usize>) -> bool {
        unreachable!("the evaluator does not ask")
    }
    fn failed<const N: usize>(
        _: SVector<Self, N>,
        _: Option<usize>,
        _: &'static [&'static str],
        _: impl FnOnce(&mut Look<'_, Self>),
    ) -> Option<Singular> {
        unreachable!("the evaluator does not ask")
    }
}

fn in_fused(at: &Inputs<f64>) -> Inputs<Fused> {
    let all = |x: &[f64]| x.iter().map(|&x| Fused(x)).collect::<Vec<_>>();
    Inputs {
        q: all(&at.q),
        v: all(&at.v),
        a: all(&at.a),
        x: all(&at.x),
        u: all(&at.u),
        modes: all(&at.modes),
        parameters: all(&at.parameters),
        t: at.t.map(Fused),
        passed: vec![],
    }
}

/// Compares a function where the code computes it alone; returns the numbers of results that were compared, and of those
/// with other bits than without fusing.
fn compare(
    jit: &Jit,
    name: &str,
    function: &Function,
    scene: Option<&SceneEquations>,
) -> (usize, usize) {
    let code = jit.compile(function).expect("machine code");
    let mut out = vec![0.0; function.evaluate(first(function, scene)).0.len()];
    let (mut compared, mut other) = (0, 0);
    for at in states(function, scene) {
        if !code.call_alone(&CallArguments::from(&at), &mut out) {
            continue;
        }
        let (wanted, refused) = function.evaluate(in_fused(&at));
        assert_eq!(refused, None, "{name}: {at:?}");
        let wanted: Vec<f64> = wanted.into_iter().map(|x| x.0).collect();
        same(&out, &wanted, &|x: f64| x.to_bits(), || {
            format!("{name}: {at:?}")
        });
        let (unfused, _) = function.evaluate(at);
        compared += out.len();
        other += out.iter().zip(unfused).filter(|(x, y)| *x != y).count();
    }
    (compared, other)
}

fn first(function: &Function, scene: Option<&SceneEquations>) -> Inputs<f64> {
    states(function, scene).next().expect("a state")
}

#[test]
fn fused_code_has_the_bits_of_a_scalar_that_fuses() {
    let jit = match Jit::fused() {
        Ok(jit) => jit,
        Err(why) => return println!("no fused machine code: {why}"),
    };
    let (mut compared, mut other) = (0, 0);
    let mut note = |(more, others)| {
        compared += more;
        other += others;
    };
    let small = files::mechanisms().into_iter().filter(|(_, m)| m.nv() <= 4);
    for (name, mechanism) in small.take(12) {
        for function in functions(&mechanism, Some("subspaces")) {
            note(compare(&jit, &name, &function, None));
        }
    }
    for (name, system) in files::scenes().iter().take(6) {
        for function in scene_functions(system) {
            note(compare(&jit, name, &function, Some(system)));
        }
    }
    println!("{compared} results, {other} with other bits than unfused");
    assert!(
        compared > 10_000 && other > compared / 20,
        "{compared}, {other}"
    );
}
