use bgdyn::nalgebra::Vector2;
use camera_head::head::Head;

/// Efforts are linear in a mass: what one kilogram adds, two add twice. And the kilogram adds what a
/// point of 1 kg does, 0.14 m off the axis of the tilt.
#[test]
fn a_heavier_lens_adds_its_own_effort() {
    let (q, still) = (Vector2::new(0.3, 0.4), Vector2::zeros());
    let tilt = |lens_mass: f64| Head { lens_mass }.inverse_dynamics(&q, &still, &still)[1];
    let (one, two) = (tilt(1.0) - tilt(0.0), tilt(2.0) - tilt(0.0));
    assert!((two - 2.0 * one).abs() < 1e-14, "{one} N·m, {two} N·m");
    assert!((one + 9.81 * 0.14 * q[1].cos()).abs() < 1e-14, "{one} N·m");
    assert_eq!(Head::<f64>::default().lens_mass, 0.4);
}
