use bgdyn::nalgebra::Vector2;
use bgdyn::runtime::num_dual::Dual64;
use camera_head::head::Head;

/// Ṁ − 2C is skew, and bias = C v + gravity. Ṁ comes from dual numbers: q + ε v.
#[test]
fn mass_rate_less_twice_coriolis_is_skew() {
    let head = Head::<f64>::default();
    let dual = Head::<Dual64>::default();
    for k in 0..100 {
        let q = Vector2::new(0.1 * f64::from(k), -1.0 + 0.02 * f64::from(k));
        let v = Vector2::new(2.0 - 0.1 * f64::from(k), 0.03 * f64::from(k));
        let moving = q.zip_map(&v, Dual64::new);
        let m_rate = dual.mass_matrix(&moving).map(|x| x.eps);
        let c = head.coriolis_matrix(&q, &v);

        let rest = m_rate - 2.0 * c;
        assert!((rest + rest.transpose()).amax() < 1e-15, "{rest} at {q}");
        let error = c * v + head.gravity(&q) - head.bias(&q, &v);
        assert!(error.amax() < 1e-14, "{error} at {q}");
    }
}
