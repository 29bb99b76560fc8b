//! The rate of the velocities at contacts: γ̇ = J v̇ + b.

use bgdyn::nalgebra::SVector;
use bgdyn::runtime::{ContactMap, HybridSystem, RigidContact};
use bgdyn_sim::{Plant as _, Run, ScenePlant};

use crate::collides::Collides;
use crate::jams::Jams;
use crate::tumbles::Tumbles;

/// Compares γ̇ = J v̇ + b with differences of γ along the rates of the scene.
fn check<S, const N: usize>(scene: &S, name: &str)
where
    S: HybridSystem<f64, State = SVector<f64, N>>,
{
    let start = Run::<ScenePlant<'_, S, f64>>::begin(scene);
    let plant = ScenePlant::new(scene);
    let modes = &start.modes;
    let n = plant.rigid_contacts();
    // In flight and turning.
    let mut y = start.y;
    for (k, y) in y.iter_mut().enumerate().skip(N - 6) {
        *y += 1.0 - 0.6 * (k % 5) as f64;
    }
    let rates = plant.rates(0.0, &y, modes).expect("regular");
    let velocities = |y: &SVector<f64, N>| {
        let none = RigidContact {
            gap: 0.0,
            velocity: [0.0; 3],
            friction: 0.0,
            restitution: 0.0,
        };
        let mut contacts = vec![none; n];
        let written = plant.rigid_contact_states(0.0, y, modes, &mut contacts);
        written.expect("regular");
        contacts.into_iter().map(|contact| contact.velocity)
    };
    let h = 1e-5;
    let [after, before] = [h, -h].map(|h| velocities(&(y + rates * h)));
    let mut maps: Vec<Option<ContactMap<SVector<f64, N>>>> = vec![None; n];
    let written = plant.rigid_contact_maps(0.0, &y, modes, &mut maps);
    written.expect("regular");
    let mut biases = vec![[0.0; 3]; n];
    let written = plant.rigid_contact_biases(0.0, &y, modes, &mut biases);
    written.expect("regular");
    for (c, (after, before)) in after.zip(before).enumerate() {
        let rows = &maps[c].as_ref().expect("a map").rows;
        for k in 0..3 {
            let found = rows[k].dot(&rates) + biases[c][k];
            let wanted = (after[k] - before[k]) / (2.0 * h);
            assert!(
                (found - wanted).abs() < 1e-7,
                "{name}, contact {c}, {k}: {found}, {wanted}"
            );
        }
    }
    assert!(biases.iter().flatten().any(|b| b.abs() > 0.1), "{name}");
}

#[test]
fn velocities_at_contacts_have_the_rate_of_jacobian_and_bias() {
    check(&Jams::<f64>::default(), "a rod");
    check(&Tumbles::<f64>::default(), "a crate");
    check(&Collides::<f64>::default(), "two balls");
}

/// An end of a rod turns about its middle: r ω² towards the middle, and ω × v, for velocities along the rod that are
/// constant.
#[test]
fn an_end_of_a_rod_has_its_centripetal_acceleration() {
    let scene = Jams::<f64>::default();
    let (angle, along, across, speed) = (0.4_f64, 0.3, -0.7, 2.0);
    let (sin, cos) = angle.sin_cos();
    let y = SVector::from([0.1, 0.7, angle, along, across, speed]);
    let mut biases = [[0.0; 3]; 2];
    let input = SVector::default();
    HybridSystem::rigid_contact_biases(&scene, &y, &input, 0.0, &mut biases);
    for (found, side) in biases.into_iter().zip([-0.5, 0.5]) {
        let (u, w) = (-speed * (across + side * speed), speed * along);
        let wanted = [cos * u - sin * w, 0.0, sin * u + cos * w];
        for (found, wanted) in found.into_iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-14, "{found}, {wanted}");
        }
    }
}
