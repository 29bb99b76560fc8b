//! Options that only mechanisms have, each with what takes its place.

bgdyn::bgdyn!("good.scene.yaml", methods = [bias], frames = [forearm], derivatives = true,
    formulation = "literal", prefer = "accuracy", jacobian = true);

fn main() {
    let _ = good::Good::<f64>::default();
}
