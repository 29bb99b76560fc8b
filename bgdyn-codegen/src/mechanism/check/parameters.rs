//! Checks run-time parameters: their names are valid fields, and each has one value.

use bgdyn_runtime::Dd;

use crate::fault::{Faults, Location, wording};
use crate::format::{Dimension, Located, Number};
use crate::mechanism::{Parameter, ParameterId, Value};
use crate::name::is_identifier;

/// The parameters found so far, in the file's order.
pub(super) struct Parameters<'a> {
    found: Vec<Found>,
    /// The methods of every generated struct.
    methods: &'a [String],
}

struct Found {
    parameter: Parameter,
    dimension: Dimension,
    /// The first text of the value, and its location.
    text: String,
    first: Location,
}

impl<'a> Parameters<'a> {
    /// Starts with no parameters; none may have the name of one of these `methods`.
    pub(super) fn new(methods: &'a [String]) -> Self {
        Parameters {
            found: Vec::new(),
            methods,
        }
    }

    /// Returns a number of the spec, or the parameter with this default. `meaning` describes the number.
    pub(super) fn value(
        &mut self,
        number: &Located<Number>,
        dimension: Dimension,
        meaning: impl FnOnce() -> String,
        faults: &mut Faults,
    ) -> Value {
        let Some(name) = &number.value.parameter else {
            return Value::Fixed(number.value.value);
        };
        let known = |found: &Found| found.parameter.name == name.value;
        if let Some(p) = self.found.iter().position(known) {
            self.found[p].meet_again(number, dimension, meaning(), faults);
            return Value::Parameter(ParameterId(p));
        }
        if !is_identifier(&name.value) {
            faults.push(wording::parameter_not_identifier(
                &name.location,
                &name.value,
            ));
        }
        // In Rust a field may have a method's name, but `arm.gravity` and `arm.gravity(q)` would be
        // different things.
        if self.methods.contains(&name.value) {
            faults.push(wording::parameter_is_method(&name.location, &name.value));
        }
        self.found.push(Found {
            parameter: Parameter {
                name: name.value.clone(),
                meaning: meaning(),
                default: number.value.value,
                unit: dimension.si(),
            },
            dimension,
            text: number.value.text.clone(),
            first: number.location.clone(),
        });
        Value::Parameter(ParameterId(self.found.len() - 1))
    }

    /// Returns the default of a value.
    pub(super) fn default_of(&self, value: Value) -> Dd {
        match value {
            Value::Fixed(x) => x,
            Value::Parameter(ParameterId(p)) => self.found[p].parameter.default,
        }
    }

    /// Returns the names, each with its first location.
    pub(super) fn names(&self) -> impl Iterator<Item = (&str, &Location)> {
        let all = self.found.iter();
        all.map(|found| (found.parameter.name.as_str(), &found.first))
    }

    /// Returns all parameters.
    pub(super) fn into_all(self) -> Vec<Parameter> {
        self.found.into_iter().map(|f| f.parameter).collect()
    }
}

impl Found {
    /// Checks a repeated name: it must have the same default.
    fn meet_again(
        &mut self,
        number: &Located<Number>,
        dimension: Dimension,
        meaning: String,
        faults: &mut Faults,
    ) {
        let (location, name) = (&number.location, &self.parameter.name);
        if dimension != self.dimension {
            let dimensions = (dimension, self.dimension);
            faults.push(wording::parameter_measures_two(
                location,
                name,
                dimensions,
                &self.first,
            ));
        } else if number.value.value != self.parameter.default {
            let texts = (number.value.text.as_str(), self.text.as_str());
            faults.push(wording::parameter_has_two_values(
                location,
                name,
                texts,
                &self.first,
            ));
        }
        self.parameter.meaning += " and ";
        self.parameter.meaning += &meaning;
    }
}
