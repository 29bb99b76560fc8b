//! Hard cases in compiled code: measured errors compared with their limits. Single states that are hard to
//! compute, motions against reference solutions, energy over long runs, numbers of any size, closed loops. `README.md`
//! describes the references, `docs/hard_cases.md` lists the bars.
#![forbid(unsafe_code)]

mod bars;
mod body;
mod cycle;
mod energy;
mod follow;
mod free_orders;
mod free_states;
mod gimbal;
mod growth;
mod limits;
mod literal;
mod long_runs;
mod loop_bars;
mod loop_exact;
mod loop_tree;
mod loops_closing;
mod loops_limits;
mod loops_motions;
mod loops_states;
mod motor;
#[path = "../../../bgdyn-sim/tests/integrators/order.rs"]
mod order;
mod orders;
mod outcome;
mod places;
#[allow(dead_code)]
#[path = "../../../bgdyn-sim/tests/integrators/problems.rs"]
mod problems;
mod reference;
#[allow(dead_code)]
#[path = "../../../bgdyn-codegen/tests/common/rng.rs"]
mod rng;
mod satellite;
mod single;
mod singular;
mod smooth;
mod state;
mod stick_slip;
mod stiff;
mod subject;
mod tenths;
mod turning;
mod uneven;
mod vectors;
#[allow(dead_code)]
#[path = "../written.rs"]
mod written;
mod zero;

use hard_cases_compiled::scenes;

pub use outcome::Outcome;
pub use single::{Single, single_precision_of_long_chains};
pub use state::State;

/// The extent of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// Everything.
    Full,
    /// Every case and every bar, with shorter horizons and fewer samples.
    Quick,
}

impl Extent {
    /// Selects a number for the full run, or one for the quick run.
    fn of<T>(self, full: T, quick: T) -> T {
        match self {
            Extent::Full => full,
            Extent::Quick => quick,
        }
    }

    /// Returns the steps of a run of the energy: 1e7, of which the first 1e6 have bars.
    fn steps(self, quick: u32) -> u32 {
        self.of(10_000_000, quick)
    }
}

/// The panel of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Panel {
    /// A regular motion.
    Regular,
    /// A chaotic one.
    Chaotic,
}

/// The error of the energy along a run.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Its panel.
    pub panel: Panel,
    /// The integrator.
    pub name: &'static str,
    /// Number of steps, and the largest error since the previous point, in units of 29.43 J.
    pub points: Vec<(f64, f64)>,
    /// The largest error of the run.
    pub most: f64,
}

/// The results of a topic.
#[derive(Clone, Debug, Default)]
pub struct Measured {
    /// Rows of the table.
    pub outcomes: Vec<Outcome>,
    /// Curves of the figure.
    pub curves: Vec<Curve>,
}

impl From<Vec<Outcome>> for Measured {
    fn from(outcomes: Vec<Outcome>) -> Self {
        let curves = vec![];
        Measured { outcomes, curves }
    }
}

/// A group of cases that are run together.
#[derive(Clone, Copy, Debug)]
pub struct Topic {
    /// Its name.
    pub name: &'static str,
    /// The part that the quick run shortens, if any.
    pub shortened: Option<&'static str>,
    /// Runs them.
    pub run: fn(Extent) -> Measured,
}

/// Case and quantity of the rows that miss their bar in the quick run too: `docs/hard_cases.md` says by how
/// much, and why.
pub const MISSED: &[(&str, &str)] = &[
    ("body_tumbling", "velocities, orientation; dop853 at 1e-13"),
    ("slider_crank_near_singular", "forward dynamics"),
    // The root of the closed form loses digits; as many are missing at the positions that close exactly.
    ("slider_crank_near_singular", "M q̈ + h = P + Bᵀλ"),
    ("slider_crank_near_singular", "M q̈ + h = P + Bᵀλ, f32"),
    (
        "slider_crank_near_singular",
        "M q̈ + h = P + Bᵀλ, where the loops close exactly",
    ),
    (
        "slider_crank_near_singular",
        "M q̈ + h = P + Bᵀλ, where the loops close exactly, f32",
    ),
    // At positions that are open forward dynamics in closed form succeeds, because it reads the independent ones alone.
    (
        "8 mechanisms with loops",
        "no error to return, not finite beside accelerations; loops open",
    ),
    (
        "8 mechanisms with loops",
        "no error to return, not finite beside accelerations; loops open, f32",
    ),
    (
        "excavator",
        "not closed, or on another branch; 0.5 rad away",
    ),
    ("five_bar", "not closed, or on another branch; 0.5 rad away"),
    (
        "slider_crank_near_singular",
        "not closed, or on another branch; 0.5 rad away",
    ),
];

macro_rules! topics {
    ($($name:ident: $run:path $(, $shortened:literal)?;)*) => {
        /// All topics, in the order of the table.
        pub const TOPICS: &[Topic] = &[$(Topic {
            name: stringify!($name),
            shortened: [$(Some($shortened),)? None][0],
            run: |extent| $run(extent).into(),
        }),*];
    };
}

topics! {
    chains: single::chains;
    mass_ratios: single::ratios;
    uneven_masses: single::uneven, "20 states a mechanism instead of 30,000";
    robots: single::robots, "6 states a mechanism instead of 30,000";
    large_angles: places::large_angles;
    moved_base: places::moved_base, "200 states instead of 10,000, a motion of 1,000 steps instead of 10,000";
    singular: singular::exact_answers, "1,000 states a mechanism instead of 100,000";
    near_lock: gimbal::near_lock, "20 states an angle instead of 3,000";
    a01_simple_pendulum: smooth::a01_simple_pendulum;
    double_pendulum_chaotic: smooth::double_pendulum_chaotic;
    chain8_rods: smooth::chain8_rods;
    arm6_3d: smooth::arm6_3d;
    mass_ratio_1e6_1: smooth::mass_ratio_1e6_1;
    mass_ratio_1e9_1: smooth::mass_ratio_1e9_1;
    mass_ratio_1e12_1: uneven::heavy_first;
    mass_ratio_1_1e12: uneven::heavy_last;
    free_states: free_states::free_states, "the states of the motions and 20 a mechanism instead of 30,000";
    free_body_generic: turning::free_body_generic;
    heavy_top_slow_cusp: turning::heavy_top_slow_cusp;
    heavy_top_sleeping_stable: turning::heavy_top_sleeping_stable;
    spherical_pendulum: turning::spherical_pendulum;
    body_tumbling: turning::body_tumbling;
    satellite_torques: satellite::satellite_torques;
    satellite_cycle: cycle::satellite_cycle;
    stiff_spring_pendulum: stiff::stiff_spring_pendulum;
    stiff_spring_two_mass: stiff::stiff_spring_two_mass;
    motor_linear_stiff: stiff::motor_linear_stiff;
    motor_pendulum: motor::motor_pendulum;
    hydraulic_cylinder: stiff::hydraulic_cylinder;
    lugre_stick_slip: stick_slip::lugre_stick_slip;
    coulomb_stick_slip_belt: stick_slip::coulomb_stick_slip_belt;
    orders: orders::orders;
    free_orders: free_orders::free_orders, "without the satellite";
    free_body_generic_kept: long_runs::free_body, "20,000 steps instead of 1e6";
    heavy_top_slow_cusp_kept: long_runs::cusp, "40,000 steps instead of 1e6";
    heavy_top_sleeping_stable_kept: long_runs::sleeping, "40,000 steps instead of 1e6";
    spherical_pendulum_kept: long_runs::pendulum, "20,000 steps instead of 1e6";
    body_tumbling_kept: long_runs::flips, "40,000 steps instead of 1e6";
    satellite_cycle_kept: cycle::satellite_cycles, "16,000 steps instead of 1e6";
    energy_rk4: energy::rk4, "20,000 steps instead of 1e7";
    energy_gauss2: energy::gauss2, "20,000 steps instead of 1e7";
    energy_gauss3: energy::gauss3, "10,000 steps instead of 1e7";
    energy_compensated: energy::compensated, "10,000 steps instead of 1e7";
    energy_chaotic_gauss2: energy::chaotic_gauss2, "100,000 steps instead of 1e7";
    energy_chaotic_midpoint: energy::chaotic_midpoint, "100,000 steps instead of 1e7";
    limits_f64: limits::double, "1e5 states instead of 1e7, 4 ordinary ones to spoil instead of 100";
    limits_f32: limits::single, "1e5 states instead of 1e7, 4 ordinary ones to spoil instead of 100";
    loops_references: loops_states::references;
    loops_seeded: loops_states::seeded, "20 states a mechanism instead of 3,000";
    loops_closing: loops_closing::distances, "100 states a mechanism instead of 3,000";
    loops_reach: loops_closing::ends_of_reach;
    loops_motions: loops_motions::motions;
    loops_drift: loops_motions::drift, "20,000 steps instead of 1e6";
    loops_sweep: loops_limits::sweep, "1e4 angles instead of 1e6";
    loops_limits: loops_limits::any_numbers, "500 states a mechanism instead of 300,000";
    no_strength: zero::no_strength, "10,000 states instead of 1e6";
}
