//! All results, the numbers that are taken from them, and the least that they have to show.

use crate::Joints;
use crate::acts::{self, Calibration, Carried, Tracking};
use crate::cycle::Cycle;
use crate::plant::{PART_MASS, Sample};
use crate::robot::{ArmModel, Numbers};
use crate::timing::step_time;
use crate::truth_numbers::{self, EffortErrors};

/// Share of the mass within which the load counts as found.
const FOUND: f64 = 0.05;
/// Time after which the errors with the load are compared, s.
pub const SETTLED: f64 = 1.0;
/// Least factor by which the errors fall.
const FACTOR: f64 = 10.0;

/// All results; pairs are of the model of the spec and the calibrated one, or without and with adaptation.
pub struct Results {
    /// Motion, log, numbers.
    pub calibration: Calibration,
    /// The path of pick and place.
    pub cycle: Cycle<{ crate::JOINTS }>,
    /// The cycle without a part, and its errors.
    pub cycles: [Vec<Sample>; 2],
    /// Errors of the positions in these.
    pub tracking: [Tracking; 2],
    /// Errors of efforts in the whole work space.
    pub efforts: [EffortErrors; 2],
    /// Errors of the base parameters, in deviations.
    pub deviations: Vec<f64>,
    /// The cycle with the part.
    pub carried: [Carried; 2],
    /// Errors of the positions while the part is held, from 1 s after it was taken.
    pub settled: [Tracking; 2],
    /// Time of a step of the adaptation, ns.
    pub step_time: f64,
}

impl Results {
    /// Runs all acts.
    pub fn new() -> Result<Self, String> {
        let spec = ArmModel::new(&Numbers::of_spec());
        let calibration = acts::calibrate(&spec)?;
        let found = acts::calibrated(&calibration.found);
        let cycle = acts::cycle();
        let cycles = [acts::pick_and_place(&spec)?, acts::pick_and_place(&found)?];
        let carried = [acts::carry(&found, false)?, acts::carry(&found, true)?];
        let (taken, released) = cycle.carried();
        let late = |s: &&Sample| taken + SETTLED <= s.t && s.t < released;
        Ok(Results {
            tracking: cycles.each_ref().map(Tracking::of),
            efforts: [&spec, &found].map(truth_numbers::effort_errors),
            deviations: truth_numbers::base_errors(
                &calibration.found,
                &truth_numbers::true_numbers(),
            ),
            settled: carried
                .each_ref()
                .map(|run| Tracking::of(run.samples.iter().filter(late))),
            step_time: step_time(&found, &carried[1]),
            calibration,
            cycle,
            cycles,
            carried,
        })
    }

    /// Returns the masses that were known, kg, while the part was held, with the times since it was taken, s.
    fn masses(&self) -> impl DoubleEndedIterator<Item = (f64, f64)> {
        let (taken, released) = self.cycle.carried();
        let run = &self.carried[1];
        let all = run.samples.iter().zip(&run.loads);
        all.map(move |(s, load)| (s.t - taken, load[0]))
            .filter(move |(t, _)| *t >= 0.0 && *t < released - taken)
    }

    /// Returns the mean of the mass that was found, kg, in the last second before the part is released.
    pub fn mass(&self) -> f64 {
        let (taken, released) = self.cycle.carried();
        let late = self.masses().filter(|(t, _)| *t >= released - taken - 1.0);
        let (sum, count) = late.fold((0.0, 0.0), |(sum, n), (_, mass)| (sum + mass, n + 1.0));
        sum / count
    }

    /// Returns the time from which on the mass is within 5 % until the part is released, s after it was taken.
    pub fn found_after(&self) -> f64 {
        let off = |mass: f64| (mass - PART_MASS).abs() > FOUND * PART_MASS;
        let last = self.masses().rev().find(|(_, mass)| off(*mass));
        last.map_or(0.0, |(t, _)| t)
    }

    /// Returns the factor by which the root mean square of each joint's error falls in the cycle.
    pub fn factors(&self) -> Joints {
        self.tracking[0].rms.component_div(&self.tracking[1].rms)
    }

    /// Checks the least that the results have to show.
    ///
    /// # Errors
    /// What they do not show.
    pub fn check(&self) -> Result<(), String> {
        let mut missed = Vec::new();
        let mut smaller = |what: &str, [before, after]: [f64; 2]| {
            let falls = after * FACTOR <= before;
            if !falls {
                missed.push(format!("{what}: {before:.3e} became {after:.3e}"));
            }
        };
        smaller("errors of efforts", self.efforts.map(|e| e.share));
        smaller("errors of positions, rad", self.tracking.map(|t| t.whole()));
        smaller("errors of the tool, m", self.tracking.map(|t| t.tool));
        smaller("errors with the load, m", self.settled.map(|t| t.tool));
        let mass = self.mass();
        // Written so that NaN is missed too.
        let near = (mass - PART_MASS).abs() <= FOUND * PART_MASS;
        if !near {
            missed.push(format!("mass of the load: {mass:.3} kg for {PART_MASS} kg"));
        }
        match missed.is_empty() {
            true => Ok(()),
            false => Err(missed.join("\n")),
        }
    }
}
