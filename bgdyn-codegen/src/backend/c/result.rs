//! Where the outputs of a function are in its flat result, and which of them must be finite.

use std::ops::Range;

use super::context::FunctionContext;
use super::scene_result::SceneResult;
use super::style::Style;
use super::words::field;
use crate::expr::Signed;
use crate::function::Function;
use crate::layout::StateLayout;
use crate::method::{Entries, Method, ParameterSet, SceneFunction, Shape};
use crate::model::{Bundle, BundlePart};
use crate::plan::{Destination, matrix_destinations};

/// The flat result of a function.
pub(super) struct FlatResult {
    /// Destinations of each output; none for one that is only checked.
    pub(super) destinations: Vec<Vec<usize>>,
    /// Number of elements.
    elements: usize,
    /// The same in C.
    pub(super) size: String,
    /// The values that must be finite.
    pub(super) checked: CheckedValues,
    /// Statements that store the elements that are no outputs.
    pub(super) others: Vec<String>,
    /// The fields with the elements, if the result is a struct.
    pub(super) fields: Vec<ResultField>,
}

/// An array in a struct of results.
pub(super) struct ResultField {
    /// Its name.
    pub(super) name: String,
    /// Its elements.
    pub(super) elements: Range<usize>,
    /// Their number in C.
    pub(super) size: String,
}

/// Returns an element of a result in C: of the array, or of one of the fields of a struct.
pub(super) fn element(fields: &[ResultField], k: usize) -> String {
    let field = fields.iter().find(|field| field.elements.contains(&k));
    match field {
        Some(field) => format!("result->{}[{}]", field.name, k - field.elements.start),
        None => format!("result[{k}]"),
    }
}

/// The values that must be finite.
pub(super) enum CheckedValues {
    /// Elements of the result.
    Elements(Range<usize>),
    /// Outputs, which need not be a part of the result.
    Outputs(Vec<usize>),
}

/// The values that parts of a bundle check.
#[derive(Default)]
struct CheckedParts {
    /// The elements of the struct, if a single part checks values and these are elements.
    elements: Option<Range<usize>>,
    /// The outputs of all parts, each value once.
    outputs: Vec<usize>,
    values: Vec<Signed>,
}

impl CheckedParts {
    /// Adds the values of a part whose elements begin there. Most parts check the same accelerations.
    fn add(&mut self, values: &CheckedValues, (part, begin): (&BundlePart, usize), of: &Function) {
        let (elements, outputs) = match values {
            CheckedValues::Elements(range) => (
                Some(range.start + begin..range.end + begin),
                range.clone().collect(),
            ),
            CheckedValues::Outputs(outputs) => (None, outputs.clone()),
        };
        let all = of.blocks.last().map_or(&[][..], |block| &block.outputs);
        let is_first = self.outputs.is_empty();
        for output in outputs {
            let output = part.outputs.start + output;
            if !self.values.contains(&all[output]) {
                self.values.push(all[output]);
                self.outputs.push(output);
                if !is_first {
                    self.elements = None;
                }
            }
        }
        if is_first {
            self.elements = elements;
        }
    }

    fn values(self) -> CheckedValues {
        match self.elements {
            Some(elements) => CheckedValues::Elements(elements),
            None => CheckedValues::Outputs(self.outputs),
        }
    }
}

impl FlatResult {
    pub(super) fn new(function: &Function, context: &FunctionContext<'_>) -> Self {
        if let (Some(scene), Method::Scene(role)) = (context.scene, function.method) {
            return FlatResult::of_scene(function, role, &scene.layout, context.style);
        }
        let (shape, nv) = (function.shape(), context.nv);
        let count = function.output_count();
        let destinations = matrix_destinations(shape, nv);
        let flat = |destination: &Destination| match *destination {
            Destination::Element(k) => k,
            Destination::Entry {
                list,
                matrix,
                row,
                column,
            } => ((list * nv + matrix) * nv + row) * nv + column,
        };
        let only_checked = match shape {
            Shape::CheckedSquares | Shape::CheckedSlopesByTree | Shape::CheckedWrenches => nv,
            Shape::Checked(_) => nv,
            _ => 0,
        };
        let in_order = |k: usize| k.checked_sub(only_checked).into_iter().collect();
        let destinations: Vec<Vec<usize>> = match destinations {
            Some(destinations) => destinations
                .iter()
                .map(|p| p.iter().map(flat).collect())
                .collect(),
            None => match shape {
                Shape::Checked(entries) => checked_destinations((entries, count - nv), nv),
                _ => (0..count).map(in_order).collect(),
            },
        };
        let elements = destinations.iter().map(Vec::len).sum::<usize>();
        let checked = match shape {
            Shape::CheckedVector | Shape::CheckedActuated(_) | Shape::CheckedTree => {
                CheckedValues::Elements(0..count)
            }
            Shape::CheckedTreeAndRows => CheckedValues::Elements(0..context.nt),
            _ => CheckedValues::Outputs((0..only_checked).collect()),
        };
        FlatResult {
            destinations,
            size: size(shape)
                .map_or_else(|| elements.to_string(), |size| context.style.sized(size)),
            elements,
            checked,
            others: Vec::new(),
            fields: Vec::new(),
        }
    }

    fn of_scene(
        function: &Function,
        role: SceneFunction,
        layout: &StateLayout,
        style: &Style,
    ) -> Self {
        let result = SceneResult::new(role, layout, function.output_count());
        let store = |(k, value): &(usize, String)| {
            let value = value
                .parse()
                .map_or_else(|_| value.clone(), |x| style.number(x));
            format!("result[{k}] = {value};")
        };
        FlatResult {
            elements: result.destinations.len() + result.others.len(),
            destinations: result.destinations.iter().map(|&k| vec![k]).collect(),
            size: style.sized(result.size),
            checked: CheckedValues::Elements(result.checked),
            others: result.others.iter().map(store).collect(),
            fields: Vec::new(),
        }
    }

    /// Returns the result of a bundle: that of each part as a field of a struct.
    pub(super) fn of_bundle(bundle: &Bundle, context: &FunctionContext<'_>) -> Self {
        let mut whole = FlatResult {
            destinations: Vec::new(),
            elements: 0,
            size: String::new(),
            checked: CheckedValues::Outputs(Vec::new()),
            others: Vec::new(),
            fields: Vec::new(),
        };
        let mut checked = CheckedParts::default();
        for part in &bundle.parts {
            let one = FlatResult::new(&bundle.function_of(part), context);
            let begin = whole.elements;
            if part.method.shape().checked() {
                checked.add(&one.checked, (part, begin), &bundle.function);
            }
            let shift =
                |destinations: &Vec<usize>| destinations.iter().map(|k| k + begin).collect();
            whole
                .destinations
                .extend(one.destinations.iter().map(shift));
            whole.elements += one.elements;
            if !one.is_empty() {
                whole.fields.push(ResultField {
                    name: field(&part.name),
                    elements: begin..whole.elements,
                    size: one.size,
                });
            }
        }
        whole.checked = checked.values();
        whole
    }

    /// Returns whether the function has no result, so that C does not have it.
    pub(super) fn is_empty(&self) -> bool {
        self.elements == 0
    }

    /// Returns the destinations for a plan.
    pub(super) fn elements(&self) -> Vec<Vec<Destination>> {
        let destinations = self.destinations.iter();
        destinations
            .map(|destinations| {
                destinations
                    .iter()
                    .map(|&k| Destination::Element(k))
                    .collect()
            })
            .collect()
    }
}

/// Returns the destinations of outputs: none for those that are only checked, two for entries beside the diagonal of a
/// symmetric matrix.
fn checked_destinations((entries, count): (Entries, usize), nv: usize) -> Vec<Vec<usize>> {
    let mut all = vec![Vec::new(); nv + count];
    let numbers: Vec<usize> = (0..count).collect();
    for (at, output) in entries.spread(&numbers, nv).into_iter().enumerate() {
        all[nv + output].push(at);
    }
    all
}

/// Returns the number of a result's elements, by names of sizes; `None` if they do not tell it.
fn size(shape: Shape) -> Option<&'static str> {
    Some(match shape {
        Shape::Vector | Shape::CheckedVector => "NV",
        Shape::Symmetric | Shape::Square => "NV * NV",
        Shape::Checked(entries) => match entries {
            Entries::Joints => "NV * NV",
            Entries::TaskColumns => "NV * 6",
            Entries::VectorTriple => "3 * NV",
            Entries::ParameterColumns(ParameterSet::Bodies) => "NV * 10 * NB",
            Entries::ParameterColumns(ParameterSet::Base) => "NV * NBP",
            Entries::ParameterColumns(ParameterSet::Payload) => "NV * 10",
            Entries::ParameterColumns(ParameterSet::RunTime(_)) => return None,
            Entries::Task | Entries::TaskVector => return None,
            Entries::Symmetric(_) | Entries::Columns(_) => return None,
        },
        Shape::VectorTriple => "3 * NV",
        Shape::SquarePair => "2 * NV * NV",
        Shape::FourSquares => "4 * NV * NV",
        Shape::FourCubes => "4 * NV * NV * NV",
        Shape::CheckedSquares => "3 * NV * NV",
        Shape::SlopesByTree => "NV * NT + NV * NV",
        Shape::CheckedSlopesByTree => "NV * NT + 2 * NV * NV",
        Shape::Jacobian => "6 * NV",
        Shape::PointJacobian => "3 * NV",
        Shape::TreeVector | Shape::CheckedTree => "NT",
        Shape::TreeMatrix => "NT * NV",
        Shape::RowVector => "NC",
        Shape::RowMatrix => "NC * NT",
        Shape::CheckedTreeAndRows => "NT + NC",
        Shape::CheckedWrenches => "6 * NR",
        Shape::LinkWrenches => "6 * NL",
        Shape::CheckedActuated(_) => "NA",
        Shape::Drives(_) => "NP",
        Shape::Scalar | Shape::Pose | Shape::Spatial => return None,
        Shape::Numbers(_) | Shape::Rows(_) | Shape::Poses(_) => return None,
        Shape::Point => return None,
        Shape::ParameterColumns(ParameterSet::Bodies) => "NV * 10 * NB",
        Shape::ParameterColumns(ParameterSet::Base) => "NV * NBP",
        Shape::ParameterColumns(ParameterSet::Payload) => "NV * 10",
        Shape::ParameterColumns(ParameterSet::RunTime(_)) => return None,
        Shape::ParameterVector(ParameterSet::Bodies) => "10 * NB",
        Shape::ParameterVector(ParameterSet::Base) => "NBP",
        Shape::ParameterVector(ParameterSet::Payload | ParameterSet::RunTime(_)) => return None,
        Shape::Parts | Shape::CheckedParts => return None,
        Shape::Bundle | Shape::CheckedBundle => return None,
    })
}
