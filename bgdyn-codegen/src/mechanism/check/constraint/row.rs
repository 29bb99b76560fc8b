//! A row of a constraint from the coefficients in the file.

use bgdyn_runtime::Dd;

use crate::fault::{Fault, Faults, Location, wording};
use crate::format::{Dimension, Fields, Key, Located, Number, ParsedValue, Vector, check_unit};
use crate::mechanism::{Leader, Link, LinkId, Motion};

/// The dimensions of coefficients.
pub(super) const COEFFICIENTS: [Dimension; 3] =
    [Dimension::One, Dimension::Lead, Dimension::AnglePerLength];

/// A row: Σ coefficient · q = offset, or Σ coefficient · v = 0 without an offset.
#[derive(Clone, Debug)]
pub struct Row {
    /// The name of its constraint or loop.
    pub name: String,
    /// Which of them it is: `constraint`, `loop`.
    pub of: &'static str,
    /// The location of the constraint or loop.
    pub location: Location,
    /// The links of the joints, with their coefficients, which add up for a link with several.
    pub terms: Vec<Leader>,
    /// The value of the sum, rad or m; `None` for a row on velocities only.
    pub offset: Option<Dd>,
}

/// A joint as a constraint prescribes it.
#[derive(Clone, Debug)]
pub(super) struct PrescribedEntry {
    /// The name of its constraint.
    pub(super) name: String,
    /// The location of the joint's name.
    pub(super) location: Location,
    /// The link of the joint.
    pub(super) link: LinkId,
}

/// Reads the row of one constraint.
pub(super) struct RowReader<'a> {
    pub(super) links: &'a [Link],
    pub(super) name: &'a Located<String>,
    pub(super) location: &'a Location,
    pub(super) faults: &'a mut Faults,
}

impl RowReader<'_> {
    /// Returns the row with these terms.
    pub(super) fn row(&self, terms: Vec<Leader>, offset: Option<Dd>) -> Row {
        Row {
            name: self.name.value.clone(),
            of: "constraint",
            location: self.location.clone(),
            terms,
            offset,
        }
    }

    /// Returns the joints of a key with their coefficients, and the dimension of the sum: an angle or a length.
    pub(super) fn terms(&mut self, fields: &Fields, key: &Key) -> Option<(Vec<Leader>, Dimension)> {
        let entry = fields.get(key)?;
        let ParsedValue::Coefficients(entries) = &entry.value else {
            return None;
        };
        let before = self.faults.count();
        let read: Vec<_> = entries
            .iter()
            .filter_map(|(name, number)| self.term(name, number))
            .collect();
        if self.faults.count() > before {
            return None;
        }
        let Some(&(_, _, dimension)) = read.first() else {
            let fault = wording::empty_row(&entry.location, &self.name.value);
            self.faults.push(fault);
            return None;
        };
        for ((name, number), (.., own)) in entries.iter().zip(&read) {
            if *own != dimension {
                let others = (dimension, *own);
                let fault = wording::mixed_row(&number.location, &name.value, others);
                self.faults.push(fault);
                return None;
            }
        }
        let term = |(link, ratio, _)| Leader { link, ratio };
        Some((read.into_iter().map(term).collect(), dimension))
    }

    /// Returns the link of the joint that a key names, and the location of the name.
    pub(super) fn joint(&mut self, fields: &Fields, key: &Key) -> Option<(LinkId, Location)> {
        let entry = fields.get(key)?;
        let ParsedValue::Text(name) = &entry.value else {
            return None;
        };
        let found = one_degree(self.links).find(|(_, link)| link.joint.name == *name);
        let Some((link, _)) = found else {
            let name = Located {
                value: name.clone(),
                location: entry.location.clone(),
            };
            let fault = unknown(&name, self.links);
            self.faults.push(fault);
            return None;
        };
        Some((link, entry.location.clone()))
    }

    /// Returns the direction of a key.
    pub(super) fn axis(&self, fields: &Fields, key: &Key) -> Option<Located<Vector>> {
        let entry = fields.get(key)?;
        let ParsedValue::Vector(vector) = &entry.value else {
            return None;
        };
        Some(Located {
            value: (**vector).clone(),
            location: entry.location.clone(),
        })
    }

    /// Returns the name of a key.
    pub(super) fn text(&self, fields: &Fields, key: &Key) -> Option<Located<String>> {
        let entry = fields.get(key)?;
        let ParsedValue::Text(name) = &entry.value else {
            return None;
        };
        Some(Located {
            value: name.clone(),
            location: entry.location.clone(),
        })
    }

    /// Returns the link of a joint, its coefficient, and the dimension of their product.
    fn term(
        &mut self,
        name: &Located<String>,
        number: &Located<Number>,
    ) -> Option<(LinkId, Dd, Dimension)> {
        let found = one_degree(self.links).find(|(_, link)| link.joint.name == name.value);
        let Some((link, own)) = found else {
            let fault = unknown(name, self.links);
            self.faults.push(fault);
            return None;
        };
        let slides = own.joint.kind.motion == Motion::Translation;
        let (plain, other, converting) = match slides {
            true => (
                Dimension::Length,
                Dimension::Angle,
                Dimension::AnglePerLength,
            ),
            false => (Dimension::Angle, Dimension::Length, Dimension::Lead),
        };
        if let Some(fault) = check_unit(number, &[Dimension::One, converting]) {
            self.faults.push(fault);
            return None;
        }
        if number.value.value == Dd::ZERO {
            let fault = wording::zero_coefficient(&number.location, &name.value);
            self.faults.push(fault);
            return None;
        }
        let dimension = match number.value.unit.map(|unit| unit.dimension) {
            Some(unit) if unit == converting => other,
            _ => plain,
        };
        Some((link, number.value.value, dimension))
    }

    /// Returns a number of this dimension.
    pub(super) fn number(
        &mut self,
        entry: &Located<ParsedValue>,
        dimension: Dimension,
    ) -> Option<Dd> {
        let ParsedValue::Number(number) = &entry.value else {
            return None;
        };
        let number = Located {
            value: number.clone(),
            location: entry.location.clone(),
        };
        match check_unit(&number, &[dimension]) {
            Some(fault) => {
                self.faults.push(fault);
                None
            }
            None => Some(number.value.value),
        }
    }
}

/// Returns the links whose joints have one degree of freedom.
pub(super) fn one_degree(links: &[Link]) -> impl Iterator<Item = (LinkId, &Link)> {
    let all = links.iter().enumerate().map(|(i, link)| (LinkId(i), link));
    all.filter(|(_, link)| link.joint.kind.one_degree())
}

/// Returns the fault of a name that is not that of a joint of one degree.
pub(super) fn unknown(name: &Located<String>, links: &[Link]) -> Fault {
    let other = links.iter().find(|link| link.joint.name == name.value);
    if let Some(link) = other {
        let keyword = link.joint.kind.keyword;
        return wording::constraint_on_joint(&name.location, &name.value, keyword);
    }
    let known: Vec<&str> = one_degree(links)
        .map(|(_, link)| link.joint.name.as_str())
        .collect();
    wording::unknown_constrained_joint(&name.location, &name.value, &known)
}
