//! Reads a table of Denavit–Hartenberg parameters into links and joints.
//!
//! A mechanism's link has its origin on its own joint's axis. A row of the modified convention gives this
//! frame; a row of the standard convention gives the *next* axis. So the part after the rotation about z
//! moves to the next row, and the part of the last row becomes a frame.

use super::joint_type::JointType;
use super::model::{Frame, Inertial, Joint, JointEffects, Limits, Link, Model};
use super::naming::shown;
use super::number::Num;
use super::placement::{Pose, about, displaced};
use super::xml::{At, fault};
use crate::table::{self, TableRow};
use anyhow::{Result, bail};
use bgdyn_codegen::math::Vec3;
use bgdyn_runtime::Dd;

/// What the four numbers of a row mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Convention {
    /// Rz(θ) Tz(d) Tx(a) Rx(α): a and α lead from this axis to the next.
    Standard,
    /// Rx(α) Tx(a) Rz(θ) Tz(d): a and α lead from the axis before to this one.
    Modified,
}

/// The possible columns of a table.
const COLUMNS: [&str; 24] = [
    "a",
    "alpha",
    "d",
    "theta",
    "type",
    "joint",
    "link",
    "convention",
    "lower",
    "upper",
    "velocity",
    "effort",
    "damping",
    "friction",
    "mass",
    "cx",
    "cy",
    "cz",
    "ixx",
    "iyy",
    "izz",
    "ixy",
    "ixz",
    "iyz",
];

/// A joint with its link: the cells of a row by the names of their columns.
struct JointRow<'a> {
    row: TableRow<'a>,
    columns: Vec<String>,
}

/// Parses a table. `name` is the robot's, `convention` the default for rows without one.
pub(super) fn read(text: &str, name: &str, convention: Option<Convention>) -> Result<Model> {
    let rows = joint_rows(text)?;
    let mut model = Model {
        name: name.to_owned(),
        source: "a table of Denavit–Hartenberg parameters".into(),
        gravity: None,
        moving_base: false,
        free_roots: false,
        links: vec![base()],
        joints: Vec::new(),
        frames: Vec::new(),
        loops: Vec::new(),
        incomplete: Vec::new(),
        warnings: Vec::new(),
    };
    // From the axes of the last link to those in which the next row begins.
    let mut carried = about(2, Dd::ZERO);
    for (i, row) in rows.iter().enumerate() {
        let [placed, after] = row.poses(convention)?;
        let parent = model
            .links
            .last()
            .map_or_else(String::new, |link| link.name.clone());
        let (link, joint) = row.link(i + 1, &parent, &carried.then(&placed), &after)?;
        model.links.push(link);
        model.joints.push(joint);
        carried = after;
    }
    let last = model
        .links
        .last()
        .map_or_else(String::new, |link| link.name.clone());
    let place = carried.placement();
    if rows.last().is_some_and(|row| {
        row.convention(convention)
            .is_ok_and(|c| c == Convention::Standard)
    }) {
        model.frames.push(Frame {
            name: "flange".into(),
            link: Some(last),
            place,
        });
    }
    Ok(model)
}

/// Returns the link before the first row.
fn base() -> Link {
    Link {
        name: "base".into(),
        at: (1, 1),
        inertial: None,
        place: None,
    }
}

/// Returns the rows below the names of the columns.
fn joint_rows(text: &str) -> Result<Vec<JointRow<'_>>> {
    let mut rows = table::rows(text).into_iter();
    let Some(head) = rows.next() else {
        bail!("1:1: the table is empty: its first line names the columns, `a, alpha, d, theta`");
    };
    let columns = columns(&head)?;
    let mut joints = Vec::new();
    for row in rows {
        let (given, wanted) = (row.cells.len(), columns.len());
        if given > wanted {
            let message = format!("{given} cells below {wanted} columns");
            return Err(fault(row.position(wanted), message));
        }
        let columns = columns.clone();
        joints.push(JointRow { row, columns });
    }
    if joints.is_empty() {
        let line = head.line;
        bail!("{line}:1: the table has no row below the names of its columns");
    }
    Ok(joints)
}

/// Returns the names of the columns: those of [`COLUMNS`], each once, including the four numbers.
fn columns(head: &TableRow<'_>) -> Result<Vec<String>> {
    let columns = &head.cells;
    for (i, column) in columns.iter().enumerate() {
        if !COLUMNS.contains(&column.as_str()) {
            let (column, known) = (shown(column), COLUMNS.join(", "));
            let message = format!("there is no column `{column}`; the columns are {known}");
            return Err(fault(head.position(i), message));
        }
        if columns[..i].contains(column) {
            let message = format_args!("a second column `{column}`");
            return Err(fault(head.position(i), message));
        }
    }
    let missing = ["a", "alpha", "d", "theta"].into_iter();
    let missing = missing.filter(|name| columns.iter().all(|column| column != name));
    let missing: Vec<&str> = missing.collect();
    if !missing.is_empty() {
        let message = format!("columns are missing: {}", missing.join(", "));
        return Err(fault((head.line, 1), message));
    }
    Ok(columns.clone())
}

impl JointRow<'_> {
    /// Returns a nonempty cell with its position.
    fn cell(&self, name: &str) -> Option<(At, &str)> {
        let column = self.columns.iter().position(|column| column == name)?;
        let text = self.row.cells.get(column).filter(|text| !text.is_empty())?;
        Some((self.row.position(column), text))
    }

    /// Returns a number; `None` if the cell is empty.
    fn number(&self, name: &str, unit: Unit) -> Result<Option<Num>> {
        let Some((at, text)) = self.cell(name) else {
            return Ok(None);
        };
        let number = unit.read(text).filter(|number| number.value.is_finite());
        let message = || {
            let (text, units) = (shown(text), unit.words());
            fault(
                at,
                format_args!("`{name}` must be a number{units}, not `{text}`"),
            )
        };
        number.ok_or_else(message).map(Some)
    }

    fn or_zero(&self, name: &str, unit: Unit) -> Result<Num> {
        Ok(self.number(name, unit)?.unwrap_or(Num::zero()))
    }

    fn convention(&self, usual: Option<Convention>) -> Result<Convention> {
        match self.cell("convention") {
            Some((_, "standard")) => Ok(Convention::Standard),
            Some((_, "modified")) => Ok(Convention::Modified),
            Some((at, word)) => {
                let word = shown(word);
                Err(fault(at, format_args!("the convention is `standard` or `modified`, not `{word}`")))
            }
            None => usual.ok_or_else(|| {
                let message = "which convention the row follows is not said: give `--convention standard` or \
                               `--convention modified`, or a column `convention`";
                fault((self.row.line, 1), message)
            }),
        }
    }

    fn kind(&self) -> Result<JointType> {
        let Some((at, word)) = self.cell("type") else {
            return Ok(JointType::Revolute);
        };
        JointType::of_table(word).ok_or_else(|| {
            let word = shown(word);
            let message =
                format!("the type is revolute, continuous, prismatic or fixed, not `{word}`");
            fault(at, message)
        })
    }

    /// Returns the link's pose in the axes in which the row begins, and the row's frame in the link's
    /// axes.
    fn poses(&self, usual: Option<Convention>) -> Result<[Pose; 2]> {
        let [a, d] = [
            self.or_zero("a", Unit::Metre)?,
            self.or_zero("d", Unit::Metre)?,
        ];
        let [alpha, theta] = ["alpha", "theta"].map(|name| self.or_zero(name, Unit::Radian));
        let (a, d) = (
            displaced([a.exact(), Dd::ZERO, Dd::ZERO]),
            displaced([Dd::ZERO, Dd::ZERO, d.exact()]),
        );
        let (alpha, theta) = (about(0, alpha?.exact()), about(2, theta?.exact()));
        Ok(match self.convention(usual)? {
            Convention::Standard => [theta, d.then(&a).then(&alpha)],
            Convention::Modified => [alpha.then(&a).then(&theta).then(&d), about(2, Dd::ZERO)],
        })
    }

    /// Returns the link and its joint; `placed` is in the axes of the previous link, `after` the row's
    /// frame in those of this link.
    fn link(
        &self,
        number: usize,
        parent: &str,
        placed: &Pose,
        after: &Pose,
    ) -> Result<(Link, Joint)> {
        let named = |column: &str| self.cell(column).map(|(_, text)| text.to_owned());
        let name = named("link").unwrap_or_else(|| format!("link_{number}"));
        let kind = self.kind()?;
        let unit = match kind {
            JointType::Prismatic => Unit::Metre,
            _ => Unit::Radian,
        };
        let fixed = kind == JointType::Fixed;
        let limits = Limits {
            lower: self.number("lower", unit)?,
            upper: self.number("upper", unit)?,
            velocity: self.number("velocity", Unit::Si)?,
            effort: self.number("effort", Unit::Si)?,
        };
        let loss = |column: &str| -> Result<Option<Num>> {
            let value = self
                .number(column, Unit::Si)?
                .filter(|value| !value.is_zero());
            if let (Some((at, _)), Some(value)) = (self.cell(column), &value)
                && value.value < 0.0
            {
                return Err(fault(at, format_args!("`{column}` is negative")));
            }
            Ok(value.filter(|_| !fixed))
        };
        let joint = Joint {
            name: named("joint").unwrap_or_else(|| format!("joint_{number}")),
            at: (self.row.line, 1),
            parent: Some(parent.to_owned()),
            child: name.clone(),
            origin: placed.placement(),
            axis: [Num::zero(), Num::zero(), Num::computed(1.0)],
            lead: None,
            limits: if fixed { Limits::default() } else { limits },
            mimic: None,
            effects: JointEffects {
                damping: loss("damping")?,
                friction: loss("friction")?,
                ..JointEffects::default()
            },
            kind,
        };
        let link = Link {
            name,
            at: (self.row.line, 1),
            inertial: self.inertial(after)?,
            place: None,
        };
        Ok((link, joint))
    }

    /// Returns mass, centre of mass and tensor about it, which the row gives in the axes of its own frame.
    fn inertial(&self, frame: &Pose) -> Result<Option<Inertial>> {
        let own = ["cx", "cy", "cz"].map(|name| self.or_zero(name, Unit::Metre));
        let [x, y, z] = own;
        let own = [x?, y?, z?];
        let com = Pose {
            translation: Vec3(own.each_ref().map(Num::exact)),
            ..about(2, Dd::ZERO)
        };
        let plain = frame.placement();
        let place = plain.then(&com.placement());
        let mut tensor = Num::zeros();
        for (entry, name) in tensor
            .iter_mut()
            .zip(["ixx", "iyy", "izz", "ixy", "ixz", "iyz"])
        {
            *entry = self.or_zero(name, Unit::Si)?;
        }
        let mass = self.or_zero("mass", Unit::Si)?;
        let body = !mass.is_zero() || tensor.iter().any(|entry| !entry.is_zero());
        Ok(body.then_some(Inertial {
            mass,
            com: place.xyz,
            rpy: plain.rpy,
            tensor,
        }))
    }
}

/// The unit of a column's numbers.
#[derive(Clone, Copy)]
enum Unit {
    /// m; or mm and cm if the cell contains the unit.
    Metre,
    /// rad; or deg if the cell contains the unit.
    Radian,
    /// The SI unit.
    Si,
}

impl Unit {
    fn read(self, text: &str) -> Option<Num> {
        let strip = |unit: &str| text.strip_suffix(unit).map(str::trim_end);
        match self {
            Unit::Si => Num::parse(text),
            Unit::Radian => match (strip("deg"), strip("rad")) {
                (Some(degrees), _) => Num::degrees(degrees),
                (None, Some(radians)) => Num::parse(radians),
                (None, None) => Num::parse(text),
            },
            Unit::Metre => {
                let parts = [("mm", 1000.0), ("cm", 100.0), ("m", 1.0), ("", 1.0)];
                let found = parts
                    .into_iter()
                    .find_map(|(unit, parts)| Some((strip(unit)?, parts)));
                let (digits, parts) = found?;
                let number = Num::parse(digits)?;
                Some(match parts == 1.0 {
                    true => number,
                    false => Num::computed((number.exact() / Dd::from_f64(parts)).to_f64()),
                })
            }
        }
    }

    fn words(self) -> &'static str {
        match self {
            Unit::Metre => " of m, or with `mm` or `cm` behind it",
            Unit::Radian => " of rad, or with `deg` behind it",
            Unit::Si => "",
        }
    }
}
