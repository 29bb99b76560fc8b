//! The double sum of equation (6).

use std::collections::BTreeMap;

use bgdyn_runtime::Dd;

use crate::bond_graph::{BondGraph, Effort, JunctionId, LinkFrame, Modulus, Transformer};
use crate::expr::{Builder, Expr, Tangent};
use crate::formulation::arguments::{Arguments, BaseState, reflected, spin, value};
use crate::formulation::joint_motion::{along, tangents};
use crate::formulation::placement::Placement;
use crate::math::{Mat3, Vec3};
use crate::mechanism::joint::Column;
use crate::mechanism::{CoordinateId, LinkId, Motion, Tensor};

/// Transformer moduli of one link: ∂r_i/∂q_j and ρ_j^i for the coordinates that move it.
pub(super) struct Moduli<'g> {
    /// (j, ∂r_i/∂q_j)
    pub(super) linear: Vec<(usize, Vec3<Expr<'g>>)>,
    /// (j, ρ_j^i)
    pub(super) angular: Vec<(usize, Vec3<Expr<'g>>)>,
}

/// What a link takes: m_i r̈_i − R_i, K̇_i; and ω̇_i.
pub(super) struct LinkLoad<'g> {
    pub(super) force: Vec3<Expr<'g>>,
    pub(super) moment: Vec3<Expr<'g>>,
    turning: Vec3<Expr<'g>>,
}

/// A load on a link, in fixed axes.
pub(super) struct PlacedLoad<'g> {
    pub(super) link: LinkId,
    pub(super) point: Vec3<Expr<'g>>,
    pub(super) force: Vec3<Expr<'g>>,
    /// About the point.
    pub(super) moment: Vec3<Expr<'g>>,
}

/// The quantities of the double sum, per link.
pub(super) struct LiteralSum<'a, 'g> {
    pub(super) b: &'g Builder,
    pub(super) graph: &'a BondGraph,
    /// A_i, and the poses of the joints.
    placement: Placement<'g>,
    /// r_i: centres of mass.
    pub(super) positions: Vec<Vec3<Expr<'g>>>,
    pub(super) moduli: Vec<Moduli<'g>>,
}

impl<'a, 'g> LiteralSum<'a, 'g> {
    pub(super) fn new(b: &'g Builder, graph: &'a BondGraph, q: &[Expr<'g>]) -> Self {
        let placement = Placement::new(b, graph, q);
        let position =
            |(i, frame): (usize, &LinkFrame)| placement.point(i, frame.com.map(|c| value(b, c)));
        let positions = graph.frames.iter().enumerate().map(position).collect();
        let mut sum = LiteralSum {
            b,
            graph,
            placement,
            positions,
            moduli: vec![],
        };
        for i in 0..graph.frames.len() {
            let moduli = sum.moduli_of(LinkId(i));
            sum.moduli.push(moduli);
        }
        sum
    }

    /// Returns the moduli of link i, with the structural zeros and constants of the graph.
    fn moduli_of(&self, i: LinkId) -> Moduli<'g> {
        let sums = self.columns_to(i);
        let read = |to: JunctionId, part: fn(&Column<Expr<'g>>) -> Vec3<Expr<'g>>| {
            let of = |t: &Transformer| {
                let whole = part(&sums[&t.from.0]);
                let entry = |c: usize| self.entry(t.modulus.0[c], whole.0[c]);
                (t.from.0, Vec3(std::array::from_fn(entry)))
            };
            self.graph.into(to).map(of).collect()
        };
        Moduli {
            linear: read(self.graph.translation(i), |column| column.linear),
            angular: read(self.graph.rotation(i), |column| column.angular),
        }
    }

    /// Returns ∂ṙ_i/∂v_j and ρ_j^i: the columns of every joint on the path to link i, moved to its centre of
    /// mass, and summed over the joints that a coordinate moves.
    fn columns_to(&self, i: LinkId) -> BTreeMap<usize, Column<Expr<'g>>> {
        self.columns_to_point(i, self.positions[i.0])
    }

    /// Returns the same for a point of link i.
    pub(super) fn columns_to_point(
        &self,
        i: LinkId,
        point: Vec3<Expr<'g>>,
    ) -> BTreeMap<usize, Column<Expr<'g>>> {
        let mut sums: BTreeMap<usize, Column<Expr<'g>>> = BTreeMap::new();
        let mut on_path = Some(i);
        while let Some(l) = on_path {
            let frame = &self.graph.frames[l.0];
            let lever = || point - self.placement.origins[l.0];
            for (j, column) in self.placement.columns(self.b, l.0, frame) {
                let angular = column.angular;
                let linear = match frame.motion {
                    Motion::Translation => column.linear,
                    _ => column.linear + angular.cross(lever()),
                };
                sums.entry(j.0)
                    .and_modify(|sum| {
                        sum.angular = sum.angular + angular;
                        sum.linear = sum.linear + linear;
                    })
                    .or_insert(Column { angular, linear });
            }
            on_path = frame.parent;
        }
        sums
    }

    fn entry(&self, modulus: Modulus, varying: Expr<'g>) -> Expr<'g> {
        match modulus {
            Modulus::Zero => self.b.zero(),
            Modulus::Constant(x) => self.b.constant(x),
            Modulus::Varying(_) => varying,
        }
    }

    /// Returns the origin of a link.
    pub(super) fn origin(&self, link: LinkId) -> Vec3<Expr<'g>> {
        self.placement.origins[link.0]
    }

    /// Returns the axes of a link.
    pub(super) fn axes(&self, link: LinkId) -> Mat3<Expr<'g>> {
        self.placement.rotations[link.0]
    }

    pub(super) fn zero(&self) -> Vec3<Expr<'g>> {
        Vec3([self.b.zero(); 3])
    }

    /// Returns Σ_k modulus_k · x_k.
    pub(super) fn combine(
        &self,
        moduli: &[(usize, Vec3<Expr<'g>>)],
        x: &[Expr<'g>],
    ) -> Vec3<Expr<'g>> {
        moduli
            .iter()
            .fold(self.zero(), |sum, (k, m)| sum + m.scale(x[*k]))
    }

    /// Returns J_i = A_i J_i⁰ A_iᵀ in fixed axes.
    pub(super) fn tensor(&self, i: usize) -> Mat3<Expr<'g>> {
        let Tensor { entries, axes } = self.graph.inertial(LinkId(i)).inertia;
        let [xx, yy, zz, xy, xz, yz] = entries.map(|x| value(self.b, x));
        let tensor = Mat3([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]);
        let axes = self.placement.rotations[i] * axes.map(|x| self.b.constant(x));
        axes * tensor * axes.transpose()
    }

    pub(super) fn mass(&self, i: usize) -> Expr<'g> {
        value(self.b, self.graph.inertial(LinkId(i)).mass)
    }

    /// Returns R_i: the sum of the active efforts on ṙ_i.
    fn active_force(&self, i: usize) -> Vec3<Expr<'g>> {
        let junction = self.graph.translation(LinkId(i));
        let sources = self.graph.sources.iter().filter(|s| s.junction == junction);
        sources
            .flat_map(|s| &s.efforts)
            .fold(self.zero(), |sum, effort| match effort {
                Effort::Weight { mass, gravity } => {
                    sum + self.b.vector(*gravity).scale(value(self.b, *mass))
                }
            })
    }

    /// Returns m_i r̈_i − R_i, K̇_i and ω̇_i of each link for the given velocities and accelerations.
    pub(super) fn link_loads<'s>(
        &'s self,
        x: &'s Arguments<'g>,
    ) -> impl Iterator<Item = LinkLoad<'g>> + 's {
        let mut rate = Tangent::new(along(tangents(self.b, self.graph, &x.v)));
        let mut rate_of = move |m: &Vec3<Expr<'g>>| {
            m.map(|e| {
                let e = e.signed();
                self.b.expr(self.b.with_graph(|g| rate.of(g, e)))
            })
        };
        let link = move |i: usize| {
            let moduli = &self.moduli[i];
            // r̈_i = Σ ∂r_i/∂q_k q̈_k + Σ d/dt(∂r_i/∂q_k) q̇_k, and ω̇_i similarly with ρ_k.
            let mut second = |moduli: &[(usize, Vec3<Expr<'g>>)]| {
                let rates: Vec<_> = moduli.iter().map(|(k, m)| (*k, rate_of(m))).collect();
                self.combine(moduli, &x.a) + self.combine(&rates, &x.v)
            };
            let mut acceleration = second(&moduli.linear);
            let mut omega = self.combine(&moduli.angular, &x.v);
            let mut turning = second(&moduli.angular);
            if let Some(base) = &x.base {
                let velocity = self.combine(&moduli.linear, &x.v);
                acceleration =
                    carried_acceleration(base, self.positions[i], velocity) + acceleration;
                turning = turning + base.omega_dot + base.omega.cross(omega);
                omega = omega + base.omega;
            }
            let mut force = acceleration.scale(self.mass(i));
            if x.active && x.base.is_none() {
                force = force - self.active_force(i);
            }
            // K̇_i = J_i ω̇_i + ω_i × (J_i ω_i)
            let tensor = self.tensor(i);
            let mut moment = tensor * turning + omega.cross(tensor * omega);
            // Adds K̇ of the rotors on the link, whose momentum is h_i = N J q̇_j e.
            for (j, h) in self.spinning(i) {
                moment = moment + h.scale(x.a[j]) + omega.cross(h).scale(x.v[j]);
            }
            LinkLoad {
                force,
                moment,
                turning,
            }
        };
        (0..self.graph.frames.len()).map(link)
    }

    /// Returns P_j for the given velocities and accelerations.
    pub(super) fn efforts(&self, x: &Arguments<'g>) -> Vec<Expr<'g>> {
        let mut efforts = vec![self.b.zero(); self.graph.coordinates.len()];
        for (i, load) in self.link_loads(x).enumerate() {
            let moduli = &self.moduli[i];
            for (j, h) in self.spinning(i) {
                efforts[j] = efforts[j] + h.dot(load.turning);
            }
            for (j, m) in &moduli.linear {
                efforts[*j] = efforts[*j] + m.dot(load.force);
            }
            for (j, rho) in &moduli.angular {
                efforts[*j] = efforts[*j] + rho.dot(load.moment);
            }
        }
        for rotor in &self.graph.rotors {
            let j = rotor.coordinate.0;
            efforts[j] = efforts[j] + reflected(self.b, rotor) * x.a[j];
        }
        efforts
    }

    /// Returns force and moment on each link from its parent, about the link's origin in link axes, without hidden
    /// links: the sums over the links outboard of the joint, less the loads `given` on them.
    pub(super) fn joint_loads(&self, x: &Arguments<'g>, given: &[PlacedLoad<'g>]) -> Vec<Expr<'g>> {
        let own = self.link_loads(x).enumerate().map(|(k, load)| PlacedLoad {
            link: LinkId(k),
            point: self.positions[k],
            force: load.force,
            moment: load.moment,
        });
        let own: Vec<PlacedLoad<'g>> = own.collect();
        let frames = self.graph.frames.iter().enumerate();
        let shown = frames.filter(|(_, frame)| !frame.hidden).map(|(i, _)| i);
        shown
            .flat_map(|i| {
                let about = self.placement.origins[i];
                let of = |loads: &[PlacedLoad<'g>]| {
                    let outboard = loads.iter().filter(|load| self.carries(i, load.link));
                    let none = (self.zero(), self.zero());
                    outboard.fold(none, |(force, moment), load| {
                        let arm = load.point - about;
                        let moment = moment + load.moment + arm.cross(load.force);
                        (force + load.force, moment)
                    })
                };
                let (needed, other) = (of(&own), of(given));
                let axes = self.placement.rotations[i].transpose();
                let force = axes * (needed.0 - other.0);
                let moment = axes * (needed.1 - other.1);
                force.0.into_iter().chain(moment.0)
            })
            .collect()
    }

    /// Returns whether link i carries another one, or is it.
    fn carries(&self, i: usize, mut other: LinkId) -> bool {
        while other.0 != i {
            let Some(parent) = self.graph.frames[other.0].parent else {
                return false;
            };
            other = parent;
        }
        true
    }

    /// Returns the joints that drive rotors on link i, with N J e in fixed axes.
    pub(super) fn spinning(&self, i: usize) -> Vec<(usize, Vec3<Expr<'g>>)> {
        let rotors = self.graph.rotors.iter();
        let on = rotors.filter_map(|r| Some((r, r.carrier.as_ref()?)));
        on.filter(|(_, carrier)| carrier.link == LinkId(i))
            .map(|(rotor, carrier)| {
                let momentum = self.b.vector(carrier.axis).scale(spin(self.b, rotor));
                (rotor.coordinate.0, self.placement.rotations[i] * momentum)
            })
            .collect()
    }

    /// Returns the lower triangle of M_jk = Σ_i [ ∂r_i/∂q_j · m_i ∂r_i/∂q_k + ρ_j · J_i ρ_k ].
    pub(super) fn mass_matrix(&self) -> Vec<Vec<Expr<'g>>> {
        let n = self.graph.coordinates.len();
        let mut mass: Vec<Vec<Expr<'g>>> = (0..n).map(|j| vec![self.b.zero(); j + 1]).collect();
        for i in 0..self.graph.frames.len() {
            let (m, tensor) = (self.mass(i), self.tensor(i));
            for (j, x) in &self.moduli[i].linear {
                for (k, y) in self.moduli[i].linear.iter().filter(|(k, _)| k <= j) {
                    mass[*j][*k] = mass[*j][*k] + m * x.dot(*y);
                }
            }
            for (j, x) in &self.moduli[i].angular {
                for (k, y) in self.moduli[i].angular.iter().filter(|(k, _)| k <= j) {
                    mass[*j][*k] = mass[*j][*k] + x.dot(tensor * *y);
                }
            }
            for (j, h) in self.spinning(i) {
                for (k, y) in &self.moduli[i].angular {
                    let (row, column) = (j.max(*k), j.min(*k));
                    mass[row][column] = mass[row][column] + y.dot(h);
                    if j == *k {
                        mass[j][j] = mass[j][j] + y.dot(h);
                    }
                }
            }
        }
        for rotor in &self.graph.rotors {
            let j = rotor.coordinate.0;
            mass[j][j] = mass[j][j] + reflected(self.b, rotor);
        }
        mass
    }

    /// Returns T = ½ Σ_i [ m_i ṙ_i · ṙ_i + ω_i · J_i ω_i ].
    pub(super) fn kinetic_energy(&self, v: &[Expr<'g>]) -> Expr<'g> {
        let twice = (0..self.graph.frames.len()).fold(self.b.zero(), |sum, i| {
            let velocity = self.combine(&self.moduli[i].linear, v);
            let omega = self.combine(&self.moduli[i].angular, v);
            let spun = self
                .spinning(i)
                .into_iter()
                .fold(self.b.zero(), |sum, (j, h)| {
                    let shared = omega.dot(h) * v[j];
                    sum + shared + shared
                });
            let links = self.mass(i) * velocity.dot(velocity) + omega.dot(self.tensor(i) * omega);
            sum + links + spun
        });
        let rotors = self.graph.rotors.iter().fold(self.b.zero(), |sum, rotor| {
            let rate = v[rotor.coordinate.0];
            sum + reflected(self.b, rotor) * rate * rate
        });
        let twice = twice + rotors;
        twice * Dd::from_f64(0.5)
    }

    /// Returns V = −Σ_i R_i · r_i for the weights R_i.
    pub(super) fn potential_energy(&self) -> Expr<'g> {
        (0..self.graph.frames.len()).fold(self.b.zero(), |sum, i| {
            sum - self.active_force(i).dot(self.positions[i])
        })
    }
}

/// Returns what the motion of the base adds to the acceleration of a point with this position and velocity
/// relative to it, in base axes: f + ω̇ × r + ω × (ω × r) + 2 ω × ṙ. f contains gravity.
pub(super) fn carried_acceleration<'g>(
    base: &BaseState<'g>,
    position: Vec3<Expr<'g>>,
    velocity: Vec3<Expr<'g>>,
) -> Vec3<Expr<'g>> {
    let around = base.omega.cross(position) + velocity + velocity;
    base.acceleration + base.omega_dot.cross(position) + base.omega.cross(around)
}

// A coordinate's index is that of its junction: `Transformer::from` relies on it.
const _: fn(&BondGraph, CoordinateId) -> JunctionId = BondGraph::velocity;
