//! Compiled models whose methods can be called by number, in any scalar: the specs of the
//! repository, those in `specs/`, and random trees, as the build script generates them.
#![forbid(unsafe_code)]

mod flat;

use bgdyn::Scalar;
use bgdyn::nalgebra::SVector;
use bgdyn::runtime::Operations;

/// Positions, velocities, accelerations, efforts.
#[derive(Clone, Debug)]
pub struct State<T> {
    /// Positions.
    pub q: Vec<T>,
    /// Velocities.
    pub v: Vec<T>,
    /// Accelerations.
    pub a: Vec<T>,
    /// Efforts.
    pub tau: Vec<T>,
}

/// A result: matrices row by row, or the error of a singular mass matrix as text.
pub type Outcome<T> = Result<Vec<T>, String>;

/// Where a compiled model comes from.
#[derive(Debug)]
pub struct Origin {
    /// The module's name.
    pub name: &'static str,
    /// The spec's path.
    pub spec: &'static str,
    /// The module's text.
    pub source: &'static str,
    /// Whether it has first derivatives.
    pub derivatives: bool,
    /// What the module says that its methods execute, in their order.
    pub operations: &'static [(&'static str, Operations)],
}

/// A compiled model.
pub trait Compiled<T: Scalar> {
    /// Where it comes from.
    fn origin(&self) -> &'static Origin;

    /// Runs the method with this number in [`Origin::operations`].
    fn run(&self, method: usize, state: &State<T>) -> Outcome<T>;

    /// The same outcome of values that were found elsewhere; the accelerations come first.
    fn outcome(&self, values: Vec<T>, refused: T::Refused) -> Outcome<T>;
}

/// Implements [`Compiled`] for the model of a module, from its list of methods.
macro_rules! compiled {
    ($module:ident, $model:ident, $derivatives:literal;
     $($number:literal => $flat:ident $method:ident($($argument:ident),*),)*) => {
        impl<T: Scalar> Compiled<T> for $module::$model<T> {
            fn origin(&self) -> &'static Origin {
                &Origin {
                    name: stringify!($module),
                    spec: concat!(env!("OUT_DIR"), "/", stringify!($module), ".yaml"),
                    source: include_str!(concat!(env!("OUT_DIR"), "/", stringify!($module), ".rs")),
                    derivatives: $derivatives,
                    operations: &$module::OPERATIONS,
                }
            }

            fn run(&self, method: usize, state: &State<T>) -> Outcome<T> {
                match method {
                    $($number => flat::$flat(self.$method($(&vector(&state.$argument)),*)),)*
                    _ => panic!("no method has the number {method}"),
                }
            }

            fn outcome(&self, values: Vec<T>, refused: T::Refused) -> Outcome<T> {
                let accelerations = vector(&values[..$module::NV]);
                let names = &$module::JOINT_NAMES;
                let finished = T::finish(accelerations, refused, names, |_| ());
                finished.map(|_| values).map_err(|error| format!("{error:?}"))
            }
        }
    };
}

fn vector<T: Scalar, const N: usize>(x: &[T]) -> SVector<T, N> {
    SVector::from_column_slice(x)
}

include!(concat!(env!("OUT_DIR"), "/modules.rs"));

/// Every model.
pub fn all<T: Scalar>() -> Vec<Box<dyn Compiled<T>>> {
    include!(concat!(env!("OUT_DIR"), "/all.rs"))
}
