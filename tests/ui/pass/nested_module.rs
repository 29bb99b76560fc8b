//! A mechanism inside a module, beside another of the same name.

mod robots {
    pub mod slow {
        bgdyn::bgdyn!("arm.yaml", formulation = "literal");
    }
    bgdyn::bgdyn!("arm.yaml", formulation = "recursion",);
}

fn main() {
    use bgdyn::nalgebra::Vector2;
    let (q, v) = (Vector2::new(0.3, -0.4), Vector2::new(2.0, 1.0));
    let slow = robots::slow::arm::Arm::<f64>::default().bias(&q, &v);
    let fast = robots::arm::Arm::<f64>::default().bias(&q, &v);
    assert!((slow - fast).norm() < 1e-12);
    let operations = |table: &[(&str, bgdyn::runtime::Operations)]| table[0].1.total();
    assert!(operations(&robots::slow::arm::OPERATIONS) > operations(&robots::arm::OPERATIONS));
}
