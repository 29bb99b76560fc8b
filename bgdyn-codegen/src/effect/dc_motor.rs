//! A DC motor with permanent magnets: a gyrator between the current and the joint.
//!
//! The charge is a coordinate, the current its velocity, the inductance its store and the voltage its drive.
//! Without inductance the current is an algebraic function of the voltage.
//!
//! The supply limits the voltage, the amplifier the current. Without inductance both limits are kinks of
//! the law, located by events. With inductance the current is a state, and the amplifier holds it: a limit
//! is a contact at ±I, at which the current comes to rest. It is held as long as the required voltage
//! exceeds R I + k N q̇. This is the motor's voltage then, and it can be more than the supply provides if
//! the joint drives the motor. A current beyond its limit, at the start or after the limit was lowered,
//! decreases to it with L di/dt = R (I − i).

use bgdyn_runtime::Dd;

use super::gear::declare_mode;
use super::keys::JOINT;
use super::{Effect, nodes};
use crate::bond_graph::{BondNetwork, NodeKind};
use crate::declaration::{EffectKind, Element, ValueCheck};
use crate::effort_sums::{EffortSums, Hold};
use crate::expr::Expr;
use crate::fault::{Help, wording};
use crate::format::{Dimension, Key, Reads};
use crate::layout::StateLayout;

pub(super) struct DcMotor;

const fn number(
    name: &'static str,
    dimension: &'static [Dimension],
    needed: bool,
    about: &'static str,
) -> Key {
    Key {
        name,
        reads: Reads::Number(dimension),
        needed,
        about,
    }
}

const RESISTANCE: Key = number(
    "resistance",
    &[Dimension::Resistance],
    true,
    "R, of the winding",
);
const INDUCTANCE: Key = number(
    "inductance",
    &[Dimension::Inductance],
    false,
    "L, of the winding; without it the current follows from the voltage at once",
);
const TORQUE_CONSTANT: Key = number(
    "torque_constant",
    &[Dimension::TorqueConstant],
    true,
    "k, torque per current, which is also voltage per speed",
);
const RATIO: Key = number(
    "ratio",
    &[Dimension::One],
    false,
    "N, turns of the motor per turn of the joint, or rad per m; 1 without it",
);
const EFFICIENCY: Key = number(
    "efficiency",
    &[Dimension::One],
    false,
    "η of the gear: ητ where the motor drives, τ/η where it is driven; 1 without it",
);
const VOLTAGE_LIMIT: Key = number(
    "voltage_limit",
    &[Dimension::Voltage],
    false,
    "the supply's voltage: |u| is held to it",
);
const CURRENT_LIMIT: Key = number(
    "current_limit",
    &[Dimension::Current],
    false,
    "the amplifier holds |i| to it",
);

static KEYS: [Key; 8] = [
    RESISTANCE,
    INDUCTANCE,
    TORQUE_CONSTANT,
    RATIO,
    EFFICIENCY,
    VOLTAGE_LIMIT,
    CURRENT_LIMIT,
    JOINT,
];

impl EffectKind for DcMotor {
    fn keyword(&self) -> &'static str {
        "dc_motor"
    }

    fn family(&self) -> &'static str {
        "motors"
    }

    fn summary(&self) -> &'static str {
        "DC motor: L di/dt + R i + k N q̇ = u, τ = k N i"
    }

    fn symbol(&self) -> &'static str {
        "GY"
    }

    fn reads_position(&self) -> bool {
        false
    }

    fn keys(&self) -> &'static [Key] {
        &KEYS
    }

    fn check_values(&self, check: &mut ValueCheck<'_>) {
        check.not_negative(&[RESISTANCE], Help::ResistanceOfWinding);
        check.positive(&[INDUCTANCE], Help::InductanceIsOptional);
        check.positive(
            &[VOLTAGE_LIMIT, CURRENT_LIMIT, EFFICIENCY],
            Help::LimitsAreOptional,
        );
        let no_resistance = check.value_or(&RESISTANCE, 1.0) == 0.0;
        if no_resistance && check.number(&INDUCTANCE).is_none() {
            let location = check.location(&RESISTANCE);
            check.report(wording::motor_without_impedance(&location));
        }
        check.at_most_one(&EFFICIENCY, Help::EfficiencyAboveOne);
    }

    fn algebraic(&self, element: &Element) -> Option<&'static str> {
        let at_once = element.quantity(&INDUCTANCE).is_none();
        at_once.then_some("without inductance: R i + k N q̇ = u solved for i")
    }

    fn declare(&self, element: &Element, layout: &mut StateLayout) {
        let (name, joint) = (&element.name, element.needed_name(&JOINT));
        let about = format!("voltage of `{name}`");
        if element.quantity(&INDUCTANCE).is_some() {
            let dimensions = [Dimension::One, Dimension::Current, Dimension::Voltage];
            layout.coordinate(&element.name, format!("{name}_current"), false, dimensions);
            layout.drive(name.clone(), name, joint, about);
        } else {
            layout.control(name.clone(), Dimension::Voltage, joint, about);
        }
        declare_limits(element, layout);
        if element.quantity(&EFFICIENCY).is_some() {
            declare_mode(element, &part_name(element, GEAR), layout);
        }
    }
}

impl Effect for DcMotor {
    fn elements(&self, element: &Element, _: &[Element], network: &mut BondNetwork) {
        let joint = nodes::port(element, network);
        let number = |symbol, key: &Key| nodes::number(element, symbol, key);
        let mut text = format!("k N, {}", number("k", &TORQUE_CONSTANT));
        for (symbol, key) in [("N", &RATIO), ("η", &EFFICIENCY)] {
            if element.quantity(key).is_some() {
                text += &format!(", {}", number(symbol, key));
            }
        }
        let gyrator = network.add(NodeKind::Gyrator, text);
        network.set_powers(gyrator, nodes::gear_losses(element, &EFFICIENCY));
        network.bond(gyrator, joint);
        let current = network.add(NodeKind::One, "i, A");
        network.bond(current, gyrator);
        network.add_on(
            current,
            NodeKind::EffortSource,
            format!("u, {}", element.name),
        );
        network.add_on(current, NodeKind::Resistor, number("R", &RESISTANCE));
        if element.quantity(&INDUCTANCE).is_some() {
            network.add_on(current, NodeKind::Inertia, number("L", &INDUCTANCE));
        }
    }

    fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
        let joint = sums.port(element);
        let circuit = Circuit {
            element,
            induced: gyrator(element, sums) * joint.rate,
            resistance: sums.number(element, &RESISTANCE),
            asked: supplied_voltage(element, sums),
        };
        let flowing = match sums.optional(element, &INDUCTANCE) {
            Some(inductance) => circuit.with_inductance(inductance, sums),
            None => circuit.at_once(sums),
        };
        let torque = gyrator(element, sums) * flowing.current;
        let mode = part_name(element, GEAR);
        let geared = match sums.gear(element, &EFFICIENCY, (&joint, &mode)) {
            Some(gear) => {
                sums.load((element, &mode), gear, &joint, torque);
                gear.behind(sums.b, torque)
            }
            None => torque,
        };
        sums.push(&joint, geared);
        sums.supply(flowing.supplied * flowing.current);
        let heat = circuit.resistance * flowing.current * flowing.current;
        sums.dissipate(heat + (torque - geared) * joint.rate);
        let name = &element.name;
        sums.reading(
            format!("{name}_torque"),
            geared,
            sums.port_units(element)[2],
            "effort of the motor at the joint".into(),
        );
        if element.quantity(&INDUCTANCE).is_none() {
            let about = "A".into();
            sums.reading(format!("{name}_current"), flowing.current, "A", about);
        }
        sums.reading(
            format!("{name}_voltage"),
            flowing.measured,
            "V",
            "voltage at the motor, after its limits".into(),
        );
    }
}

/// Returns k N of the motor with its gear.
fn gyrator<'g>(element: &Element, sums: &EffortSums<'g, '_>) -> Expr<'g> {
    let one = sums.b.number(1.0);
    let ratio = sums.optional(element, &RATIO).unwrap_or(one);
    sums.number(element, &TORQUE_CONSTANT) * ratio
}

/// The part of the name of the gear's mode.
const GEAR: &str = "gear";

/// Returns the name of an event, or of a mode with its event.
fn part_name(element: &Element, part: &str) -> String {
    format!("{}_{part}", element.name)
}

/// The limits of the current: the name of the mode, and the sign of the current at the limit.
const SIDES: [(&str, f64); 2] = [("upper_limit", 1.0), ("lower_limit", -1.0)];

/// Declares the kinks of the limits, and the modes of a current that is held.
fn declare_limits(element: &Element, layout: &mut StateLayout) {
    let name = &element.name;
    if element.quantity(&VOLTAGE_LIMIT).is_some() {
        let about = format!("the voltage of `{name}` reaches its limit, or leaves it");
        layout.event(part_name(element, VOLTAGE_LIMIT.name), about);
    }
    if element.quantity(&CURRENT_LIMIT).is_none() {
        return;
    }
    if element.quantity(&INDUCTANCE).is_none() {
        let about = format!("the current of `{name}` reaches its limit, or leaves it");
        layout.event(part_name(element, CURRENT_LIMIT.name), about);
        return;
    }
    for ((side, _), which) in SIDES.into_iter().zip(["upper", "lower"]) {
        let mode = format!(
            "whether the current of `{name}` is held at its {which} limit (0), or the sign of what it is above it"
        );
        layout.mode(part_name(element, side), mode);
        let event = format!("the current of `{name}` reaches its {which} limit, or leaves it");
        layout.event(part_name(element, side), event);
    }
}

/// Returns the voltage within the supply's limit.
fn supplied_voltage<'g>(element: &Element, sums: &mut EffortSums<'g, '_>) -> Expr<'g> {
    let asked = sums.input(&element.name);
    match sums.optional(element, &VOLTAGE_LIMIT) {
        Some(limit) if sums.limited() => {
            sums.event(&part_name(element, VOLTAGE_LIMIT.name), limit - asked.abs());
            asked.max(-limit).min(limit)
        }
        _ => asked,
    }
}

/// The loop of voltages: u = L di/dt + R i + k N q̇.
struct Circuit<'g, 'e> {
    element: &'e Element,
    /// k N q̇
    induced: Expr<'g>,
    /// R
    resistance: Expr<'g>,
    /// u, within the supply's limit.
    asked: Expr<'g>,
}

/// Current and voltages of a motor.
struct Flowing<'g> {
    current: Expr<'g>,
    /// The voltage at the motor in the law.
    supplied: Expr<'g>,
    /// The voltage as an output: without limits it equals the input bit for bit.
    measured: Expr<'g>,
}

impl<'g> Circuit<'g, '_> {
    /// Returns the limit of the current, if it has one.
    fn current_limit(&self, sums: &EffortSums<'g, '_>) -> Option<Expr<'g>> {
        let limit = sums.optional(self.element, &CURRENT_LIMIT);
        limit.filter(|_| sums.limited())
    }

    /// Solves R i + k N q̇ = u for the current i of a motor without inductance.
    fn at_once(&self, sums: &mut EffortSums<'g, '_>) -> Flowing<'g> {
        let wanted = (self.asked - self.induced) / self.resistance;
        let Some(limit) = self.current_limit(sums) else {
            return Flowing {
                current: wanted,
                supplied: self.resistance * wanted + self.induced,
                measured: self.asked,
            };
        };
        sums.event(
            &part_name(self.element, CURRENT_LIMIT.name),
            limit - wanted.abs(),
        );
        let current = wanted.max(-limit).min(limit);
        let drop = self.resistance * limit;
        Flowing {
            current,
            // The amplifier reduces the voltage to that of the limited current.
            supplied: self.resistance * current + self.induced,
            measured: (self.asked)
                .max(self.induced - drop)
                .min(self.induced + drop),
        }
    }

    /// Returns the current of a motor with inductance; its acceleration is that of a coordinate of its
    /// own.
    fn with_inductance(&self, inductance: Expr<'g>, sums: &mut EffortSums<'g, '_>) -> Flowing<'g> {
        let current = sums.own_velocity(self.element);
        let (free, applied) = match self.current_limit(sums) {
            Some(limit) => self.hold_at_limit(current, limit, sums),
            None => (self.asked, self.asked),
        };
        sums.inertia(self.element, inductance);
        let rest = free - self.resistance * current - self.induced;
        sums.push_own(self.element, rest);
        Flowing {
            current,
            supplied: applied,
            measured: applied,
        }
    }

    /// Returns the voltage that drives the free current, and the voltage that is applied if the amplifier
    /// holds |i| at the limit I.
    fn hold_at_limit(
        &self,
        current: Expr<'g>,
        limit: Expr<'g>,
        sums: &mut EffortSums<'g, '_>,
    ) -> (Expr<'g>, Expr<'g>) {
        let half = sums.b.number(0.5);
        let port = sums.coordinate(&self.element.name);
        let still = sums.b.zero();
        // With this voltage the current is constant.
        let keeps = self.resistance * current + self.induced;
        let (mut free, mut applied) = (self.asked, self.asked);
        for (side, sign) in SIDES {
            let at = limit * Dd::from_f64(sign);
            let name = part_name(self.element, side);
            let mode = sums.mode(&name);
            // Beyond the limit, the voltage of a constant current at the limit brings the current back to
            // it.
            let back = self.resistance * at + self.induced;
            let (hold, back) = match sign > 0.0 {
                true => (Hold::Lowers, free.min(back)),
                false => (Hold::Raises, free.max(back)),
            };
            let beyond = |yes, no| half.if_less(mode * Dd::from_f64(sign), yes, no);
            (free, applied) = (beyond(back, free), beyond(back, applied));
            applied = mode.abs().if_less(half, keeps, applied);
            sums.contact(&name, &port, [at, still], hold);
        }
        (free, applied)
    }
}
