//! Checks the laws of every scene: the balance of power, and that the inverse is the inverse of the
//! derivative.

use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::Dd;

use super::common::state;

/// States per scene.
const STATES: u64 = 20;

/// The functions in the laws.
pub struct Tried<'a> {
    system: &'a SceneEquations,
    power: Function,
    inverse: Function,
    driven: Function,
    contacts: Option<Function>,
}

/// Checks the laws in random states.
pub fn hold(system: &SceneEquations) {
    let modes = !system.scene.layout.modes.is_empty();
    let tried = Tried {
        system,
        power: system.function(SceneFunction::Power),
        inverse: system.function(SceneFunction::Inverse),
        driven: system.driven(),
        contacts: modes.then(|| system.function(SceneFunction::Contacts)),
    };
    for seed in 0..STATES {
        tried.balance(seed, true);
        tried.undone(seed);
        if let Some(contacts) = &tried.contacts {
            tried.balance(seed, false);
            tried.held_joints_stay(contacts, seed);
        }
    }
}

fn size(x: Dd) -> f64 {
    x.to_f64().abs()
}

impl Tried<'_> {
    /// Σ supplied = Σ d(stored)/dt + Σ dissipated, to the last digits of double-double.
    fn balance(&self, seed: u64, slipping: bool) {
        let system = self.system;
        let inputs = state(system, &mut Random(seed), slipping);
        let (values, refused) = self.power.evaluate(inputs);
        assert!(refused.is_none(), "{}: singular", system.scene.name);
        let (mut sum, mut largest) = (Dd::ZERO, 1e-30_f64);
        for entry in values.chunks(3) {
            sum = sum + entry[0] - entry[1] - entry[2];
            largest = entry.iter().map(|x| size(*x)).fold(largest, f64::max);
        }
        let left = size(sum) / largest;
        assert!(
            left < 1e-20,
            "{} (seed {seed}): {left:e} of the power is left over: {values:?}",
            system.scene.name
        );
    }

    /// The derivative under the efforts of the inverse has the given accelerations.
    fn undone(&self, seed: u64) {
        let system = self.system;
        let inputs = state(system, &mut Random(seed), true);
        let (efforts, _) = self.inverse.evaluate(inputs.clone());
        let wanted = inputs.a.clone();
        let mut driven = inputs;
        driven.a = efforts;
        let (rates, refused) = self.driven.evaluate(driven);
        assert!(refused.is_none(), "{}: singular", system.scene.name);
        for (j, (wanted, got)) in wanted.iter().zip(&rates).enumerate() {
            let off = size(*wanted - *got) / size(*wanted).max(1.0);
            assert!(
                off < 1e-18,
                "{} (seed {seed}): coordinate {j} accelerates by {got:?}, not {wanted:?}",
                system.scene.name
            );
        }
    }

    /// A held joint has the acceleration of its counterpart.
    fn held_joints_stay(&self, contacts: &Function, seed: u64) {
        let system = self.system;
        let inputs = state(system, &mut Random(seed), false);
        let modes = inputs.modes.clone();
        let (contacts, refused) = contacts.evaluate(inputs);
        assert!(refused.is_none(), "{}: singular", system.scene.name);
        let held = contacts.chunks(4).zip(modes);
        for (contact, _) in held.filter(|(_, mode)| *mode == Dd::ZERO) {
            assert!(size(contact[0]) < 1e-25, "slip {:?}", contact[0]);
            assert!(size(contact[1]) < 1e-25, "slip rate {:?}", contact[1]);
        }
    }
}
