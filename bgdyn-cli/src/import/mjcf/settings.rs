//! The settings of an MJCF that change what its numbers mean: `<compiler>`, `<option>`.

use super::report::Report;
use crate::import::attributes::{finite, numbers};
use crate::import::naming::shown;
use crate::import::number::Num;
use crate::import::xml::{Element, fault};
use anyhow::Result;

/// When geoms give a body its inertia.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum FromGeoms {
    Never,
    Always,
    /// Without `<inertial>`.
    Missing,
}

/// One turn of an Euler sequence: the axis, and whether it turns with the body.
#[derive(Clone, Copy)]
pub(super) struct EulerTurn {
    pub(super) axis: usize,
    pub(super) moving: bool,
}

/// What `<compiler>` says; MuJoCo's defaults without it.
pub(super) struct Settings {
    /// Whether angles are in degrees.
    pub(super) degrees: bool,
    pub(super) euler: [EulerTurn; 3],
    pub(super) inertia_from_geoms: FromGeoms,
    /// The groups of geoms that give inertia.
    pub(super) groups: [f64; 2],
    /// Whether a range is enough for a joint to be limited.
    pub(super) autolimits: bool,
    pub(super) least_mass: f64,
    pub(super) least_inertia: f64,
    /// Whether a tensor that breaks the triangle inequality is replaced by that of a ball.
    pub(super) balance: bool,
    pub(super) total_mass: Option<Num>,
    /// Whether free joints are aligned with the inertia of their body unless they say otherwise.
    pub(super) align_free: bool,
}

/// Attributes of `<compiler>` that change numbers or frames of the mechanism.
const READ: &[&str] = &[
    "angle",
    "eulerseq",
    "coordinate",
    "inertiafromgeom",
    "inertiagrouprange",
    "autolimits",
    "boundmass",
    "boundinertia",
    "balanceinertia",
    "settotalmass",
    "alignfree",
];

impl Settings {
    /// Reads all `<compiler>` elements; of a repeated attribute the last one holds.
    pub(super) fn read(root: &Element, report: &mut Report) -> Result<Self> {
        let mut settings = Settings {
            degrees: true,
            euler: [0, 1, 2].map(|axis| EulerTurn { axis, moving: true }),
            inertia_from_geoms: FromGeoms::Missing,
            groups: [0.0, 5.0],
            autolimits: true,
            least_mass: 0.0,
            least_inertia: 0.0,
            balance: false,
            total_mass: None,
            align_free: false,
        };
        for element in root.all("compiler") {
            report.attributes(element, READ);
            report.children(element, &[]);
            settings.take(element)?;
        }
        Ok(settings)
    }

    fn take(&mut self, element: &Element) -> Result<()> {
        if element
            .get("coordinate")
            .is_some_and(|word| word != "local")
        {
            let message = "`coordinate` must be `local`: poses are relative to the parent";
            return Err(fault(element.at, message));
        }
        if element.get("angle").is_some() {
            let words = [("degree", true), ("radian", false)];
            self.degrees = one_of(element, "angle", &words)?;
        }
        if let Some(sequence) = element.get("eulerseq") {
            self.euler = euler_sequence(sequence).ok_or_else(|| {
                let sequence = shown(sequence);
                let message = format!(
                    "`eulerseq` is three letters out of x, y, z, X, Y, Z, not `{sequence}`"
                );
                fault(element.at, message)
            })?;
        }
        if element.get("inertiafromgeom").is_some() {
            let words = [
                ("false", FromGeoms::Never),
                ("true", FromGeoms::Always),
                ("auto", FromGeoms::Missing),
            ];
            self.inertia_from_geoms = one_of(element, "inertiafromgeom", &words)?;
        }
        if element.get("inertiagrouprange").is_some() {
            let range = numbers::<2>(element, "inertiagrouprange")?;
            self.groups = range.map(|group| group.value);
        }
        let truth = [("false", false), ("true", true)];
        if element.get("autolimits").is_some() {
            self.autolimits = one_of(element, "autolimits", &truth)?;
        }
        if element.get("alignfree").is_some() {
            self.align_free = one_of(element, "alignfree", &truth)?;
        }
        if element.get("balanceinertia").is_some() {
            self.balance = one_of(element, "balanceinertia", &truth)?;
        }
        if element.get("boundmass").is_some() {
            self.least_mass = finite(element, "boundmass")?.value;
        }
        if element.get("boundinertia").is_some() {
            self.least_inertia = finite(element, "boundinertia")?.value;
        }
        if element.get("settotalmass").is_some() {
            let mass = finite(element, "settotalmass")?;
            self.total_mass = (mass.value > 0.0).then_some(mass);
        }
        Ok(())
    }

    /// Returns an angle of the file with its unit.
    pub(super) fn angle(&self, text: &Num) -> Num {
        let degrees = self.degrees.then(|| Num::degrees(&text.text)).flatten();
        degrees.unwrap_or_else(|| text.clone())
    }
}

/// Returns the value of a keyword.
pub(super) fn one_of<T: Copy>(
    element: &Element,
    attribute: &str,
    words: &[(&str, T)],
) -> Result<T> {
    let given = element.get(attribute).unwrap_or_default();
    let found = words.iter().find(|(word, _)| *word == given);
    found.map(|(_, value)| *value).ok_or_else(|| {
        let all: Vec<String> = words.iter().map(|(word, _)| format!("`{word}`")).collect();
        let (name, given) = (&element.name, shown(given));
        let all = all.join(" or ");
        let message = format!("`{attribute}` of `<{name}>` is {all}, not `{given}`");
        fault(element.at, message)
    })
}

fn euler_sequence(text: &str) -> Option<[EulerTurn; 3]> {
    let turn = |c: char| {
        let axis = "xyz".find(c.to_ascii_lowercase())?;
        let moving = c.is_ascii_lowercase();
        Some(EulerTurn { axis, moving })
    };
    let turns: Option<Vec<EulerTurn>> = text.chars().map(turn).collect();
    turns?.try_into().ok()
}

/// Returns the acceleration of free fall that `<option>` gives, or zero where its flag disables gravity.
pub(super) fn gravity(root: &Element, report: &mut Report) -> Result<Option<[Num; 3]>> {
    let mut gravity = None;
    let mut disabled = false;
    for option in root.all("option") {
        report.attributes(option, &["gravity"]);
        report.children(option, &["flag"]);
        if option.get("gravity").is_some() {
            gravity = Some(numbers(option, "gravity")?);
        }
        for flag in option.all("flag") {
            report.attributes(flag, &["gravity"]);
            if flag.get("gravity").is_some() {
                let words = [("disable", true), ("enable", false)];
                disabled = one_of(flag, "gravity", &words)?;
            }
        }
    }
    Ok(match disabled {
        true => Some(Num::zeros()),
        false => gravity,
    })
}
