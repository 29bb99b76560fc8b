//! What is identified: links and joints with the numbers of the file, and what gives the rows of their regressor.

pub use bgdyn_runtime::JOINT_COLUMNS;
use nalgebra::{DMatrix, SMatrix, SVector};

/// Parameters of a body.
pub const BODY_PARAMETERS: usize = 10;
/// Their names, in order: mass, first moments, tensor about the origin of the link's frame, in link axes.
pub const PARAMETER_NAMES: [&str; BODY_PARAMETERS] = [
    "m", "mx", "my", "mz", "Ixx", "Ixy", "Iyy", "Ixz", "Iyz", "Izz",
];
/// Coulomb friction in [`JOINT_COLUMNS`].
pub const COULOMB: usize = 2;

/// m, m c, and the tensor about the origin: the effort is linear in them.
pub type Parameters = SVector<f64, BODY_PARAMETERS>;
/// The linear map of parameters from one frame to another.
pub type Transport = SMatrix<f64, BODY_PARAMETERS, BODY_PARAMETERS>;

/// Gives the rows of the regressor: τ = Y(q, v, a) π.
pub trait Rows {
    /// Returns the number of velocities NV.
    fn joints(&self) -> usize;

    /// Returns the number of moving bodies NB, in the order of their joints.
    fn bodies(&self) -> usize;

    /// Writes Y into `rows`, NV × 10·NB: ten columns a body, in the order of [`PARAMETER_NAMES`]. `q` in rad or m, `v`
    /// and `a` are its rates.
    fn effort_rows(&self, q: &[f64], v: &[f64], a: &[f64], rows: &mut DMatrix<f64>);
}

/// Fills rows from numbers row by row, as generated functions give them.
pub fn fill_by_rows(rows: &mut DMatrix<f64>, values: &[f64]) {
    let width = rows.ncols();
    for (i, own) in values.chunks(width).enumerate() {
        for (k, x) in own.iter().enumerate() {
            rows[(i, k)] = *x;
        }
    }
}

/// A link with an inertia of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkPart {
    /// Its name.
    pub name: String,
    /// The moving body that it belongs to.
    pub body: usize,
    /// The map from its parameters to those of the body, at the body's frame.
    pub in_body: Transport,
    /// The parameters of the file, at the link's own frame.
    pub file: Parameters,
    /// Whether it is to be identified.
    pub free: bool,
}

/// A joint.
#[derive(Clone, Debug, PartialEq)]
pub struct JointPart {
    /// Its name.
    pub name: String,
    /// Whether it slides.
    pub linear: bool,
    /// Limits of its position, rad or m.
    pub range: [Option<f64>; 2],
    /// Limit of its speed.
    pub speed: Option<f64>,
    /// Limit of its effort, N·m or N.
    pub effort: Option<f64>,
    /// Rotor inertia, viscous and Coulomb friction, offset, as the file has them.
    pub file: [f64; 4],
}

/// The model.
pub struct Model<'a> {
    /// Rows of the bodies.
    pub rows: &'a dyn Rows,
    /// The links with inertia that move, parents first.
    pub links: Vec<LinkPart>,
    /// The joints, in the order of v.
    pub joints: Vec<JointPart>,
    /// Which of [`JOINT_COLUMNS`] are identified.
    pub columns: [bool; 4],
}

/// One number of the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// A parameter of a link.
    Link(usize, usize),
    /// A column of a joint: its index in [`JOINT_COLUMNS`], the joint.
    Joint(usize, usize),
}

impl Model<'_> {
    /// Returns all numbers: ten for each link, then each column for all joints.
    pub fn unknowns(&self) -> Vec<Unknown> {
        let links = (0..self.links.len())
            .flat_map(|l| (0..BODY_PARAMETERS).map(move |k| Unknown::Link(l, k)));
        let joints = (0..JOINT_COLUMNS.len())
            .flat_map(|c| (0..self.joints.len()).map(move |j| Unknown::Joint(c, j)));
        links.chain(joints).collect()
    }

    /// Returns whether a number is identified.
    pub fn is_free(&self, unknown: Unknown) -> bool {
        match unknown {
            Unknown::Link(link, _) => self.links[link].free,
            Unknown::Joint(column, _) => self.columns[column],
        }
    }

    /// Returns the number of the file.
    pub fn file(&self, unknown: Unknown) -> f64 {
        match unknown {
            Unknown::Link(link, k) => self.links[link].file[k],
            Unknown::Joint(column, joint) => self.joints[joint].file[column],
        }
    }

    /// Returns the name: `forearm.Ixx`, `elbow.viscous`.
    pub fn name(&self, unknown: Unknown) -> String {
        match unknown {
            Unknown::Link(link, k) => format!("{}.{}", self.links[link].name, PARAMETER_NAMES[k]),
            Unknown::Joint(column, joint) => {
                format!("{}.{}", self.joints[joint].name, JOINT_COLUMNS[column])
            }
        }
    }

    /// Returns the rows of links from those of bodies: the columns of a link are those of its body, transported.
    pub fn rows_of_links(&self, of_bodies: &DMatrix<f64>) -> DMatrix<f64> {
        let mut rows = DMatrix::zeros(of_bodies.nrows(), BODY_PARAMETERS * self.links.len());
        for (l, link) in self.links.iter().enumerate() {
            let own =
                of_bodies.columns(BODY_PARAMETERS * link.body, BODY_PARAMETERS) * link.in_body;
            rows.columns_mut(BODY_PARAMETERS * l, BODY_PARAMETERS)
                .copy_from(&own);
        }
        rows
    }
}

/// The speed at which the smoothed sign is 76 % of 1, rad/s or m/s.
pub const SIGN_WIDTH: f64 = 1e-3;

/// Returns the columns of a joint, in the order of [`JOINT_COLUMNS`]: a, v, sign v (smoothed), 1.
pub fn joint_columns(v: f64, a: f64) -> [f64; 4] {
    joint_columns_within(v, a, SIGN_WIDTH)
}

/// Returns the same with another width of the sign: [`bgdyn_runtime::joint_columns`] with the `tanh` of the standard
/// library, on whose last bit it depends in which maximum the search for a motion ends.
pub fn joint_columns_within(v: f64, a: f64, width: f64) -> [f64; 4] {
    [a, v, (v / width).tanh(), 1.0]
}
