use bgdyn::nalgebra::Vector2;
use camera_head::head::Head;

#[test]
fn forward_dynamics_undoes_inverse_dynamics() {
    let head = Head::<f64>::default();
    for k in 0..100 {
        let q = Vector2::new(0.1 * f64::from(k), -1.0 + 0.02 * f64::from(k));
        let v = Vector2::new(2.0 - 0.1 * f64::from(k), 0.03 * f64::from(k));
        let a = Vector2::new(5.0, -7.0 + 0.1 * f64::from(k));
        let tau = head.inverse_dynamics(&q, &v, &a);
        let back = head.forward_dynamics(&q, &v, &tau).expect("regular");
        assert!((back - a).amax() < 1e-12, "{back} for {a} at {q}");
    }
}
