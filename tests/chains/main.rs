//! The long chains: their code is cut into blocks that are functions of their own.

#[path = "../numeric/golden_values.rs"]
mod golden_values;

use golden_values::equals_golden;

bgdyn::bgdyn!("../golden/specs/chain32.yaml");
bgdyn::bgdyn!("../golden/specs/chain64.yaml");

#[test]
fn chain_of_32() {
    let model = chain32::Chain32::default();
    equals_golden::<f64, _, 32>("chain32", &model, &chain32::JOINT_NAMES, 1.0, |x| x);
}

#[test]
fn chain_of_64() {
    let model = chain64::Chain64::default();
    equals_golden::<f64, _, 64>("chain64", &model, &chain64::JOINT_NAMES, 1.0, |x| x);
}
