//! A DC motor with permanent magnets: a gyrator between the current and the joint. The charge is a
//! coordinate, the current its velocity, the inductance its store and the voltage its drive; where
//! there is no inductance the current follows from the voltage at once.

use super::viscous::JOINT;
use super::{Effect, Element, Given};
use crate::expr::Ex;
use crate::scene::{Layout, algebraic_loop};
use crate::spec::{Dimension, Key, Reads};
use crate::system::{Laws, behind_gear};

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

static KEYS: [Key; 8] = [
    number(
        "resistance",
        &[Dimension::Resistance],
        true,
        "R, of the winding",
    ),
    number(
        "inductance",
        &[Dimension::Inductance],
        false,
        "L, of the winding; without it the current follows from the voltage at once",
    ),
    number(
        "torque_constant",
        &[Dimension::TorqueConstant],
        true,
        "k, torque per current, which is also voltage per speed",
    ),
    number(
        "ratio",
        &[Dimension::One],
        false,
        "N, turns of the motor per turn of the joint, or rad per m; 1 without it",
    ),
    number(
        "efficiency",
        &[Dimension::One],
        false,
        "η of the gear: ητ where the motor drives, τ/η where it is driven; 1 without it",
    ),
    number(
        "voltage_limit",
        &[Dimension::Voltage],
        false,
        "the supply's voltage: |u| is held to it",
    ),
    number(
        "current_limit",
        &[Dimension::Current],
        false,
        "the amplifier holds |i| to it",
    ),
    JOINT,
];

impl Effect for DcMotor {
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

    fn keys(&self) -> &'static [Key] {
        &KEYS
    }

    fn rules(&self, given: &mut Given<'_>) {
        given.not_negative(&["resistance"], "no winding has it");
        given.positive(
            &["inductance"],
            "leave it out for the motor without inductance, whose current follows from the voltage at once",
        );
        given.positive(
            &["voltage_limit", "current_limit", "efficiency"],
            "leave it out where nothing limits the motor",
        );
        let no_resistance = given.value_or("resistance", 1.0) == 0.0;
        if no_resistance && given.number("inductance").is_none() {
            let place = given.place("resistance");
            let message = "neither resistance nor inductance: the loop voltage → current → torque → speed → voltage has no solution";
            let fault = algebraic_loop(&place, message.into(), "give one of them");
            given.faults.push(fault);
        }
        given.at_most_one("efficiency", "an efficiency above 1 makes power of nothing");
    }

    fn algebraic(&self, element: &Element) -> Option<&'static str> {
        let at_once = element.quantity("inductance").is_none();
        at_once.then_some("without inductance: R i + k N q̇ = u solved for i")
    }

    fn declare(&self, element: &Element, layout: &mut Layout) {
        let (name, joint) = (&element.name, element.name("joint").unwrap_or_default());
        let about = format!("voltage of `{name}`");
        if element.quantity("inductance").is_some() {
            let dimensions = [Dimension::One, Dimension::Current, Dimension::Voltage];
            layout.coordinate(element, format!("{name}_current"), false, dimensions);
            layout.drive(name.clone(), name, joint, about);
        } else {
            layout.control(name.clone(), Dimension::Voltage, joint, about);
        }
    }

    fn law(&self, element: &Element, laws: &mut Laws<'_, '_>) {
        let joint = laws.port(element);
        let one = laws.b.number(1.0);
        let gyrator = laws.number(element, "torque_constant")
            * laws.optional(element, "ratio").unwrap_or(one);
        let resistance = laws.number(element, "resistance");
        let induced = gyrator * joint.rate;
        let voltage = supplied_voltage(element, laws);
        let asked = voltage;
        let (current, voltage) = match laws.optional(element, "inductance") {
            Some(inductance) => {
                let current = laws.own_velocity(element);
                let voltage = held_voltage(element, laws, voltage, current, induced);
                laws.inertia(element, inductance);
                laws.push_own(element, voltage - resistance * current - induced);
                (current, voltage)
            }
            // R i + k N q̇ = u, solved for i
            None => {
                let wanted = (voltage - induced) / resistance;
                let current = match laws.optional(element, "current_limit") {
                    Some(limit) if laws.limited() => wanted.max(-limit).min(limit),
                    _ => wanted,
                };
                // The amplifier lowers the voltage to what the limited current needs.
                (current, resistance * current + induced)
            }
        };
        let torque = gyrator * current;
        let geared = match laws.optional(element, "efficiency") {
            Some(efficiency) => behind_gear(laws.b, torque, joint.rate, efficiency),
            None => torque,
        };
        laws.push(&joint, geared);
        laws.supply(voltage * current);
        laws.dissipate(resistance * current * current + (torque - geared) * joint.rate);
        let name = &element.name;
        laws.reading(
            format!("{name}_torque"),
            geared,
            laws.port_units(element)[2],
            "effort of the motor at the joint".into(),
        );
        if element.quantity("inductance").is_none() {
            laws.reading(format!("{name}_current"), current, "A", "A".into());
        }
        laws.reading(
            format!("{name}_voltage"),
            applied_voltage(element, laws, (asked, voltage), induced),
            "V",
            "voltage at the motor, after its limits".into(),
        );
    }
}

/// The voltage within the supply's limit.
fn supplied_voltage<'g>(element: &Element, laws: &Laws<'g, '_>) -> Ex<'g> {
    let asked = laws.input(&element.name);
    match laws.optional(element, "voltage_limit") {
        Some(limit) if laws.limited() => asked.max(-limit).min(limit),
        _ => asked,
    }
}

/// The voltage at the motor, after all limits. `law` is what the law makes of it: without inductance
/// the current goes before it, and it would be a rounding off what is asked for.
fn applied_voltage<'g>(
    element: &Element,
    laws: &Laws<'g, '_>,
    (asked, law): (Ex<'g>, Ex<'g>),
    induced: Ex<'g>,
) -> Ex<'g> {
    if element.quantity("inductance").is_some() {
        return law;
    }
    match laws.optional(element, "current_limit") {
        Some(limit) if laws.limited() => {
            let drop = laws.number(element, "resistance") * limit;
            asked.max(induced - drop).min(induced + drop)
        }
        _ => asked,
    }
}

/// Where the current has reached its limit I, the amplifier lets no more voltage through than keeps
/// it there: R I + k N q̇.
fn held_voltage<'g>(
    element: &Element,
    laws: &Laws<'g, '_>,
    voltage: Ex<'g>,
    current: Ex<'g>,
    induced: Ex<'g>,
) -> Ex<'g> {
    let Some(limit) = laws
        .optional(element, "current_limit")
        .filter(|_| laws.limited())
    else {
        return voltage;
    };
    let drop = laws.number(element, "resistance") * limit;
    let below = current.if_less(limit, voltage, voltage.min(drop + induced));
    (-limit).if_less(current, below, voltage.max(induced - drop))
}
