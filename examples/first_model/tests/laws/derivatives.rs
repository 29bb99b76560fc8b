use bgdyn::nalgebra::Vector2;
use bgdyn::runtime::num_dual::Dual64;

bgdyn::bgdyn!(
    "head.yaml",
    methods = [inverse_dynamics, inverse_dynamics_derivatives]
);
use head::Head;

/// Generated derivatives against dual numbers, column by column, and against differences.
#[test]
fn derivatives_agree() {
    let (head, dual) = (Head::<f64>::default(), Head::<Dual64>::default());
    let (q, v, a) = (
        Vector2::new(0.4, -0.6),
        Vector2::new(1.5, -2.0),
        Vector2::new(3.0, 4.0),
    );
    let [by_q, by_v] = head.inverse_dynamics_derivatives(&q, &v, &a);
    let still = |x: Vector2<f64>| x.map(Dual64::from);
    for k in 0..2 {
        let along = |x: Vector2<f64>| {
            let mut x = still(x);
            x[k].eps = 1.0;
            x
        };
        let dual_q = dual.inverse_dynamics(&along(q), &still(v), &still(a));
        let dual_v = dual.inverse_dynamics(&still(q), &along(v), &still(a));
        assert!((dual_q.map(|x| x.eps) - by_q.column(k)).amax() < 1e-14);
        assert!((dual_v.map(|x| x.eps) - by_v.column(k)).amax() < 1e-14);

        let mut step = Vector2::zeros();
        step[k] = 1e-5;
        let (up, down) = (
            head.inverse_dynamics(&(q + step), &v, &a),
            head.inverse_dynamics(&(q - step), &v, &a),
        );
        assert!(((up - down) / 2e-5 - by_q.column(k)).amax() < 1e-8);
    }
}
