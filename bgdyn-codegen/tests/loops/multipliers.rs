use super::references::*;
use super::robot::*;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::verify::{check_functions, explain};
#[test]
fn dbg() {
    let closed = Robot::read(&spec("stewart_platform"));
    println!("{:?}", closed.mechanism.joint_names());
    let c = closed.mechanism.closure().unwrap();
    for b in &c.blocks {
        println!("{:?} {:?}", b.rows, b.dependents);
    }
    for m in [
        Method::Gravity,
        Method::MassMatrix,
        Method::KineticEnergy,
        Method::Bias,
        Method::InverseDynamics,
        Method::ForwardDynamics,
    ] {
        let f = closed.function(None, m);
        let found = check_functions("s", closed.graph, &[(*f).clone()]);
        println!("{m:?} {} {}", found.len(), f.formulation);
    }
    panic!();
}
