//! What an identification finds.

use nalgebra::DMatrix;

use crate::base::Base;
use crate::judge::JointResidual;
use crate::log::Quality;
use crate::model::Unknown;
use crate::prepare::Samples;
use crate::sticking::Sticking;

/// A base parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct BaseParameter {
    /// Its name: the kept parameter and those that act as it does.
    pub name: String,
    /// The number of the file.
    pub file: f64,
    /// The number of least squares.
    pub value: f64,
    /// Its deviation; infinite if the motion does not show it.
    pub deviation: f64,
    /// Whether the motion shows it.
    pub seen: bool,
}

/// A number of the model, of bodies that can exist.
#[derive(Clone, Debug, PartialEq)]
pub struct Identified {
    /// Which number.
    pub unknown: Unknown,
    /// The number of the file.
    pub file: f64,
    /// The number found.
    pub value: f64,
    /// Its deviation, with what the file says.
    pub deviation: f64,
    /// The share of what is known of it that comes from the log, between 0 and 1.
    pub from_log: f64,
}

/// Efforts of a motion: measured, and predicted in three ways, in the order of the samples.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement {
    /// The rows.
    pub samples: Samples,
    /// Whether they are the last third of the log.
    pub last_third: bool,
    /// Predictions of the file, of least squares, of bodies that can exist.
    pub predicted: [Vec<f64>; 3],
    /// What is left, by joint, in the same order.
    pub left: [Vec<JointResidual>; 3],
}

/// The result.
#[derive(Clone, Debug)]
pub struct Identification {
    /// The quality of the log.
    pub quality: Quality,
    /// Replaced spikes by joint.
    pub spikes: Vec<usize>,
    /// The cut of the filter, Hz.
    pub cut: f64,
    /// Rows of least squares.
    pub rows: usize,
    /// Condition number of the scaled columns.
    pub condition: f64,
    /// Robust deviation of the residual by joint.
    pub sigma: Vec<f64>,
    /// The base parameters.
    pub base: Vec<BaseParameter>,
    /// K, with the free unknowns of its columns.
    pub map: Base,
    /// Numbers of bodies that can exist, in the order of [`crate::Model::unknowns`], the free ones.
    pub numbers: Vec<Identified>,
    /// Covariance of them.
    pub covariance: DMatrix<f64>,
    /// Joints that dry friction holds near rest.
    pub sticking: Vec<Sticking>,
    /// Joint columns that are zero in this motion, and keep the file's numbers.
    pub left_out: Vec<Unknown>,
    /// Links whose numbers in the file are no body that can exist.
    pub impossible: Vec<usize>,
    /// Newton steps of the barrier method.
    pub steps: usize,
    /// Smallest eigenvalue of the pseudo-inertia of each link.
    pub eigenvalues: Vec<f64>,
    /// The other motion.
    pub judgement: Judgement,
}
