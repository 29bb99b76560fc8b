use bgdyn::nalgebra::Vector2;
use camera_head::head::Head;

#[test]
fn mass_matrix_is_symmetric_and_positive() {
    let head = Head::<f64>::default();
    for k in 0..100 {
        let q = Vector2::new(0.1 * f64::from(k), -1.0 + 0.02 * f64::from(k));
        let m = head.mass_matrix(&q);
        assert_eq!(m, m.transpose(), "bit for bit");
        assert!(m.cholesky().is_some(), "{m} at {q}");
    }
}
