//! Impulses in closed form: one contact, an incline, two balls.

use crate::problems::{Owned, Random, add_point};

/// Returns a problem of one contact.
fn one(block: [[f64; 3]; 3], velocity: [f64; 3], friction: f64) -> Owned<f64, 1> {
    Owned {
        delassus: Box::new([[block]]),
        velocities: [velocity],
        friction: [friction],
        active: [true],
    }
}

fn diagonal(x: f64, y: f64, z: f64) -> [[f64; 3]; 3] {
    [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]]
}

/// Asserts that numbers are equal but for rounding errors.
fn assert_close(found: [f64; 3], expected: [f64; 3], what: &str) {
    let size = expected.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    for (x, y) in found.into_iter().zip(expected) {
        assert!(
            (x - y).abs() <= 1e-13 * size,
            "{what}: {found:?}, not {expected:?}"
        );
    }
}

#[test]
fn a_contact_that_separates_has_no_impulse() {
    for velocity in [[1.0, -2.0, 0.5], [1.0, -2.0, 0.0], [0.0, 0.0, 0.0]] {
        let contact = one(diagonal(2.0, 3.0, 1.0), velocity, 0.4);
        assert_eq!(contact.solved(), [[0.0; 3]]);
    }
}

/// Without friction, straight along the normal: no start makes a contact pull, and none is left unsolved.
#[test]
fn a_contact_without_friction_never_pulls() {
    for (velocity, normal) in [(1.0, 0.0), (0.0, 0.0), (-1.0, 2.0)] {
        for start in [
            [0.0; 3],
            [0.0, 0.0, -2.0],
            [0.0, 0.0, 5.0],
            [1.0, 0.0, -1.0],
        ] {
            let contact = one(diagonal(2.0, 3.0, 0.5), [0.0, 0.0, velocity], 0.0);
            let mut impulses = [start];
            let outcome = contact.solve(&mut impulses);
            assert!(outcome.solved, "{velocity} m/s from {start:?}: {outcome:?}");
            assert_close(impulses[0], [0.0, 0.0, normal], "the impulse");
        }
    }
}

/// A positive definite block with the given coupling of normal and tangents.
fn block(random: &mut Random, coupling: f64) -> [[f64; 3]; 3] {
    let rows: [[f64; 4]; 3] = std::array::from_fn(|_| std::array::from_fn(|_| random.number()));
    let mut g: [[f64; 3]; 3] = std::array::from_fn(|i| {
        std::array::from_fn(|j| rows[i].iter().zip(rows[j]).map(|(a, b)| a * b).sum())
    });
    for i in 0..2 {
        g[i][2] *= coupling;
        g[2][i] *= coupling;
        g[i][i] += 0.05;
    }
    g[2][2] += 0.05;
    g
}

fn product(g: &[[f64; 3]; 3], p: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| (0..3).map(|j| g[i][j] * p[j]).sum())
}

#[test]
fn a_contact_sticks_by_the_impulse_that_stops_it() {
    let mut random = Random::new(1);
    for _ in 0..1000 {
        let g = block(&mut random, 0.3);
        let friction = 0.05 + 0.5 * (1.0 + random.number());
        let angle = 3.2 * random.number();
        let share = 0.98 * friction * (1.0 + random.number()) / 2.0;
        let p = [share * angle.cos(), share * angle.sin(), 1.0];
        let velocity = product(&g, p).map(|x| -x);
        let found = one(g, velocity, friction).solved()[0];
        for (x, y) in found.into_iter().zip(p) {
            assert!((x - y).abs() < 1e-11, "{found:?}, not {p:?}");
        }
    }
}

/// Sliding with unequal effective masses: from an impulse on the cone and γ_t = −λ p_t follows the velocity before. With
/// weak coupling the solution is unique.
#[test]
fn a_contact_slides_against_its_velocity_with_unequal_effective_masses() {
    let mut random = Random::new(2);
    for k in 0..1000 {
        let coupling = if k % 2 == 0 { 0.0 } else { 0.2 };
        let g = block(&mut random, coupling);
        let friction = 0.05 + 0.2 * (1.0 + random.number());
        let angle = 3.2 * random.number();
        let p = [friction * angle.cos(), friction * angle.sin(), 1.0];
        let multiplier = (6.0 * random.number()).exp();
        let change = product(&g, p);
        let after = [-multiplier * p[0], -multiplier * p[1], 0.0];
        let velocity = std::array::from_fn(|i| after[i] - change[i]);
        let found = one(g, velocity, friction).solved()[0];
        for (x, y) in found.into_iter().zip(p) {
            assert!((x - y).abs() < 1e-9, "λ {multiplier}: {found:?}, not {p:?}");
        }
    }
}

/// A block on an incline for one step of time: it sticks below the angle atan μ, and slides above it.
#[test]
fn a_block_on_an_incline_sticks_below_the_angle_of_friction() {
    let (mass, weight_of_a_step, friction) = (3.0, 9.81e-3, 0.5_f64);
    for degrees in 1..80 {
        let angle = f64::from(degrees).to_radians();
        for azimuth in [0.0, 0.7, 2.0, -2.9_f64] {
            let down = [azimuth.cos(), azimuth.sin()].map(|x| weight_of_a_step * angle.sin() * x);
            let velocity = [down[0], down[1], -weight_of_a_step * angle.cos()];
            let found = one(
                diagonal(1.0 / mass, 1.0 / mass, 1.0 / mass),
                velocity,
                friction,
            )
            .solved()[0];
            let normal = mass * weight_of_a_step * angle.cos();
            let hold = mass * weight_of_a_step * angle.sin();
            let tangential = hold.min(friction * normal);
            assert_eq!(tangential == hold, angle < friction.atan());
            let expected = [
                -tangential * azimuth.cos(),
                -tangential * azimuth.sin(),
                normal,
            ];
            assert_close(found, expected, &format!("{degrees}°"));
        }
    }
}

/// Two equal balls that collide obliquely: the tangential impulse is min(μ p_n, m v_t/7), where p_n = (1 + e) m v_n/2.
#[test]
fn two_balls_collide_with_the_smaller_of_two_tangential_impulses() {
    let (mass, radius, restitution, friction) = (0.2, 0.03, 0.9, 0.06);
    let moment = 0.4 * mass * radius * radius;
    let inverse = [[1.0 / mass; 3], [1.0 / moment; 3]].concat().repeat(2);
    // The normal, along z, points from the second ball to the first.
    let mut rows = vec![vec![0.0; 12]; 3];
    add_point(&mut rows, 0, [0.0, 0.0, -radius], 1.0);
    add_point(&mut rows, 1, [0.0, 0.0, radius], -1.0);
    for tenths in 0..50 {
        let (normal_speed, speed) = (1.0, 0.1 * f64::from(tenths));
        let mut v = vec![0.0; 12];
        (v[0], v[1], v[2]) = (0.6 * speed, 0.8 * speed, -normal_speed);
        let mut owned = Owned::<f64, 1>::new(&rows, &inverse, &v, [friction]);
        owned.velocities[0][2] *= 1.0 + restitution;
        let normal = (1.0 + restitution) * mass * normal_speed / 2.0;
        let tangential = (friction * normal).min(mass * speed / 7.0);
        let expected = [-0.6 * tangential, -0.8 * tangential, normal];
        assert_close(owned.solved()[0], expected, &format!("{speed} m/s"));
    }
}

#[test]
fn without_friction_the_impulse_is_normal() {
    let mut g = diagonal(2.0, 3.0, 4.0);
    (g[0][2], g[2][0]) = (0.5, 0.5);
    assert_eq!(one(g, [1.0, 2.0, -2.0], 0.0).solved(), [[0.0, 0.0, 0.5]]);
}

/// A contact that can move only along x and the normal, as at the end of a pendulum: what cannot move has no impulse.
#[test]
fn a_direction_that_cannot_move_does_not_disturb() {
    let contact = one(diagonal(2.0, 0.0, 1.0), [0.2, 0.0, -1.0], 0.3);
    assert_close(contact.solved()[0], [-0.1, 0.0, 1.0], "sticking");
    let contact = one(diagonal(2.0, 0.0, 1.0), [2.0, 0.0, -1.0], 0.3);
    assert_close(contact.solved()[0], [-0.3, 0.0, 1.0], "sliding");
}
