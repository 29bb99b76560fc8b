use bgdyn::nalgebra::Vector2;
use bgdyn_sim::{State, rk4_step};
use camera_head::head::Head;

/// Without efforts the energy stays; what is left is the integrator's error, of order h⁴.
#[test]
fn energy_is_conserved() {
    let head = Head::<f64>::default();
    let energy =
        |s: &State<f64, 2, 2>| head.kinetic_energy(&s.q, &s.v) + head.potential_energy(&s.q);
    let drift = |h: f64, steps: u32| {
        let (q, v) = (Vector2::new(0.0, 0.3), Vector2::new(2.0, 0.0));
        let mut state = State { q, v };
        let start = energy(&state);
        for _ in 0..steps {
            state = rk4_step(&head, 0.0, &state, h, |_, _| Vector2::zeros()).expect("regular");
        }
        (energy(&state) - start).abs()
    };
    let (coarse, fine) = (drift(1e-3, 2000), drift(5e-4, 4000));
    assert!(coarse < 1e-8, "{coarse} J");
    assert!(
        fine < coarse / 10.0,
        "{coarse} J, with half the step {fine} J"
    );
}
