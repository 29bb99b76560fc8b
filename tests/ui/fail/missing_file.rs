//! The places looked at are listed; the calls bring no error of their own.

bgdyn::bgdyn!("robots/nowhere.yaml");

fn main() {
    let q = bgdyn::nalgebra::Vector3::new(0.1, 0.2, 0.3);
    println!("{}", nowhere::Nowhere::<f64>::default().gravity(&q)[0]);
}
