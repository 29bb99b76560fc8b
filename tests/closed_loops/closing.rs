//! Planar loops that close in closed form, against Newton's method in double-double and against the residual of the
//! loops: from anywhere, on both branches, in every scalar, to the end of the reach.

use bgdyn::nalgebra::{SMatrix, SVector};
use bgdyn::runtime::closure::{self, Dependent};
use bgdyn::runtime::wide::f64x4;
use bgdyn::runtime::{Cause, Dd};
use bgdyn::{Dynamics, Scalar};
use bgdyn_codegen::random::Random;
use num_dual::Dual64;

use crate::excavator_bucket::ExcavatorBucket;
use crate::five_bar::FiveBar;
use crate::linkages::Linkages;
use crate::slider_crank::SliderCrank;
use crate::slider_crank_near_singular::SliderCrankNearSingular;
use crate::test_rod::ShortRod;

/// A mechanism with loops, in a scalar.
trait Closes<T: Scalar, const NQ: usize, const NV: usize>: Dynamics<T, NQ, NV> {
    /// Closes positions as generated code does; `None` where it refuses.
    fn closed(&self, q: &SVector<T, NQ>) -> Option<SVector<T, NQ>>;
    /// Closes positions by Newton's method alone.
    fn by_newton(&self, q: &SVector<T, NQ>) -> Option<SVector<T, NQ>>;
    /// By how much the rows are open.
    fn residual(&self, q: &SVector<T, NQ>) -> Vec<T>;
    /// Velocities of the positions of the dependent joints for one of the independent velocities.
    fn column(&self, q: &SVector<T, NQ>, k: usize) -> Vec<T>;
    /// Whether all loops close in closed form, from any guess.
    fn is_whole() -> bool;
    /// Whether each position is an angle.
    fn angles() -> [bool; NQ];
    fn dependents() -> &'static [Dependent];
}

macro_rules! closes {
    ($($module:ident, $model:ident;)*) => {$(
        impl<T: Scalar> Closes<T, { crate::$module::NQ }, { crate::$module::NV }>
            for crate::$module::$model<T>
        {
            fn closed(
                &self,
                q: &SVector<T, { crate::$module::NQ }>,
            ) -> Option<SVector<T, { crate::$module::NQ }>> {
                self.close(q).ok()
            }

            fn by_newton(
                &self,
                q: &SVector<T, { crate::$module::NQ }>,
            ) -> Option<SVector<T, { crate::$module::NQ }>> {
                let step = |q: &_| self.closing_step(q);
                let closing = closure::close(*q, &crate::$module::DEPENDENTS, step);
                closing.finish(&crate::$module::CLOSING_NAMES).ok()
            }

            fn residual(&self, q: &SVector<T, { crate::$module::NQ }>) -> Vec<T> {
                self.constraint_residual(q).iter().copied().collect()
            }

            fn column(&self, q: &SVector<T, { crate::$module::NQ }>, k: usize) -> Vec<T> {
                let map: SMatrix<T, { crate::$module::NT }, { crate::$module::NV }> =
                    self.velocity_map(q);
                let dependents = crate::$module::DEPENDENTS.iter();
                dependents.map(|d| map[(d.velocity, k)]).collect()
            }

            fn is_whole() -> bool {
                // One of their loops closes by Newton's method: the rod, and the cylinder of known stroke.
                !matches!(stringify!($module), "linkages" | "excavator_bucket")
            }

            fn angles() -> [bool; crate::$module::NQ] {
                crate::$module::POSITION_NAMES.map(|name| name.ends_with("_angle"))
            }

            fn dependents() -> &'static [Dependent] {
                &crate::$module::DEPENDENTS
            }
        }
    )*};
}

closes! {
    five_bar, FiveBar;
    slider_crank, SliderCrank;
    slider_crank_near_singular, SliderCrankNearSingular;
    excavator_bucket, ExcavatorBucket;
    linkages, Linkages;
    test_rod, ShortRod;
}

/// Runs a check for each mechanism.
macro_rules! for_each {
    ($check:ident) => {
        $check(&FiveBar::<f64>::default(), &FiveBar::<Dd>::default());
        $check(
            &SliderCrank::<f64>::default(),
            &SliderCrank::<Dd>::default(),
        );
        $check(
            &SliderCrankNearSingular::<f64>::default(),
            &SliderCrankNearSingular::<Dd>::default(),
        );
        $check(
            &ExcavatorBucket::<f64>::default(),
            &ExcavatorBucket::<Dd>::default(),
        );
        $check(&Linkages::<f64>::default(), &Linkages::<Dd>::default());
    };
}

fn exactly<const N: usize>(q: &SVector<f64, N>) -> SVector<Dd, N> {
    q.map(Dd::from_f64)
}

/// Returns by how much the loops are open, in units of eps, m.
fn open<M: Closes<Dd, NQ, NV>, const NQ: usize, const NV: usize>(
    exact: &M,
    q: &SVector<f64, NQ>,
) -> f64 {
    let rows = exact.residual(&exactly(q));
    let most = rows
        .iter()
        .fold(0.0, |most: f64, x| most.max(x.to_f64().abs()));
    most / f64::EPSILON
}

/// Returns closed positions on a walk from the start.
fn walk<M: Closes<f64, NQ, NV>, const NQ: usize, const NV: usize>(
    model: &M,
    steps: usize,
) -> Vec<SVector<f64, NQ>> {
    let (mut random, mut q, mut found) = (Random(17), model.neutral(), vec![]);
    for _ in 0..steps {
        let step = SVector::from_fn(|_, _| 0.08 * random.signed());
        let next = model.integrate(&q, &step);
        if next.iter().all(|x| x.is_finite()) {
            q = next;
        }
        found.push(q);
    }
    assert!(found.windows(2).filter(|pair| pair[0] != pair[1]).count() > steps / 2);
    found
}

/// From guesses that are off by up to 0.05 rad the positions are those of Newton's method in double-double, on the same
/// branch wherever Newton's method stays on it; all others do not change in any bit.
fn closes_as_newton<M, E, const NQ: usize, const NV: usize>(model: &M, exact: &E)
where
    M: Closes<f64, NQ, NV>,
    E: Closes<Dd, NQ, NV>,
{
    let (mut random, mut compared) = (Random(19), 0);
    for q in walk(model, 400) {
        let reference = exact.by_newton(&exactly(&q)).expect("closed");
        let mut guess = q;
        for d in M::dependents() {
            guess[d.position] += 0.05 * random.signed();
        }
        let newton = model.by_newton(&guess);
        let Some(found) = model.closed(&guess) else {
            panic!("refused at {q}");
        };
        assert!(open(exact, &found) < 4.0, "{} at {q}", open(exact, &found));
        let near = |x: &SVector<f64, NQ>| (x - q).amax() < 1e-6;
        if !newton.as_ref().is_some_and(near) {
            continue;
        }
        // Towards a singular position the rounding of the loop's terms is divided by its distance.
        let steep = (0..NV).flat_map(|k| model.column(&q, k));
        let steep = steep.fold(1.0, |most: f64, s| most.max(s.abs()));
        for (p, (&found, wanted)) in found.iter().zip(reference.iter()).enumerate() {
            let off = (Dd::from_f64(found) - *wanted).to_f64().abs();
            assert!(
                off < 64.0 * f64::EPSILON * steep,
                "{p}: {off:e}, {steep}, at {q}"
            );
            if M::dependents().iter().all(|d| d.position != p) {
                assert_eq!(found.to_bits(), q[p].to_bits());
            }
        }
        compared += 1;
    }
    assert!(compared > 300, "{compared}");
}

#[test]
fn positions_are_those_of_newtons_method() {
    for_each!(closes_as_newton);
}

/// Angles stay within half a turn of the guess, with any number of whole turns, and from any guess the loops close.
fn keeps_turns<M, E, const NQ: usize, const NV: usize>(model: &M, exact: &E)
where
    M: Closes<f64, NQ, NV>,
    E: Closes<Dd, NQ, NV>,
{
    let mut random = Random(23);
    for q in walk(model, 100) {
        // Whole turns of independent and dependent joints.
        let mut turned = q;
        for (x, angle) in turned.iter_mut().zip(M::angles()) {
            if angle {
                *x += std::f64::consts::TAU * (random.signed() * 3.4).round();
            }
        }
        let Some(found) = model.closed(&turned) else {
            panic!("refused at {turned}");
        };
        assert!((found - turned).amax() < 1e-6, "{found} from {turned}");
        assert!(open(exact, &found) < 60.0, "{}", open(exact, &found));
        let mut far = q;
        for d in M::dependents() {
            let size = if M::angles()[d.position] { 3.0 } else { 0.0 };
            far[d.position] += size * random.signed();
        }
        // Newton's method may not close from there.
        let found = model.closed(&far);
        assert!(found.is_some() || !M::is_whole(), "refused from {far}");
        if let Some(found) = found {
            assert!(open(exact, &found) < 8.0, "{}", open(exact, &found));
        }
    }
}

#[test]
fn angles_keep_their_whole_turns() {
    for_each!(keeps_turns);
}

/// Positions in double-double close to their last digits.
fn closes_exactly<M, E, const NQ: usize, const NV: usize>(model: &M, exact: &E)
where
    M: Closes<f64, NQ, NV>,
    E: Closes<Dd, NQ, NV>,
{
    for q in walk(model, 20) {
        let Some(found) = exact.closed(&exactly(&q)) else {
            panic!("refused at {q}");
        };
        let newton = exact.by_newton(&exactly(&q)).expect("closed");
        let off = found.zip_map(&newton, |x, y| (x - y).abs().to_f64()).amax();
        assert!(off < 1e-26, "{off:e} at {q}");
    }
}

#[test]
fn double_double_closes_to_the_last_digits() {
    for_each!(closes_exactly);
}

/// Guesses that are no numbers, or so large that their rounding opens the loops, are refused.
fn refuses_wild<M, E, const NQ: usize, const NV: usize>(model: &M, _: &E)
where
    M: Closes<f64, NQ, NV>,
    E: Closes<Dd, NQ, NV>,
{
    let q = model.neutral();
    for d in M::dependents() {
        if !M::angles()[d.position] {
            continue;
        }
        for wild in [f64::NAN, f64::INFINITY, 1e17, -1e17] {
            let mut guess = q;
            guess[d.position] = wild;
            assert!(model.closed(&guess).is_none(), "{} = {wild}", d.position);
        }
    }
}

#[test]
fn wild_guesses_are_refused() {
    for_each!(refuses_wild);
}

/// Lanes close as single positions do, bit for bit, from near and far guesses at once.
#[test]
fn lanes_close_bit_for_bit() {
    let (model, lanes) = (FiveBar::<f64>::default(), FiveBar::<f64x4>::default());
    let mut random = Random(29);
    let states = walk(&model, 200);
    for all in states.chunks_exact(4) {
        let guesses: Vec<SVector<f64, 4>> = (all.iter().zip([0.0, 1e-9, 1e-3, 0.3]))
            .map(|(q, off)| {
                let mut guess = *q;
                guess[1] += off * random.signed();
                guess[3] += off * random.signed();
                guess
            })
            .collect();
        let together =
            SVector::<f64x4, 4>::from_fn(|p, _| f64x4::new(std::array::from_fn(|k| guesses[k][p])));
        let together = lanes.close(&together).expect("within reach");
        for (k, guess) in guesses.iter().enumerate() {
            let alone = model.close(guess).expect("within reach");
            for p in 0..4 {
                assert_eq!(together[p].to_array()[k].to_bits(), alone[p].to_bits());
            }
        }
    }
}

/// The derivatives of closed positions are the columns of S, from near and far guesses.
#[test]
fn dual_numbers_have_the_columns_of_s() {
    let (model, dual) = (FiveBar::<f64>::default(), FiveBar::<Dual64>::default());
    for q in walk(&model, 50) {
        for (k, independent) in [0, 2].into_iter().enumerate() {
            for off in [0.0, 0.2] {
                let mut guess = q.map(Dual64::from);
                guess[independent].eps = 1.0;
                guess[1].re += off;
                // What the guess depends on does not matter.
                guess[3].eps = 0.7;
                let found = dual.close(&guess).expect("within reach");
                let map = model.velocity_map(&found.map(|x| x.re));
                for p in [1, 3] {
                    let wanted = map[(p, k)];
                    let off = (found[p].eps - wanted).abs();
                    assert!(off < 1e-10 * (1.0 + wanted * wanted), "{off:e}, {wanted}");
                }
            }
        }
    }
}

/// On either side of the end of the reach, where sin θ = 3/4, positions close within it and are refused beyond, to 4
/// units in the last place, from any distance.
#[test]
fn the_end_of_the_reach_is_exact() {
    fn ends<T: Scalar>(ulp: f64, to_f64: impl Fn(T) -> f64) {
        let (model, exact) = (ShortRod::<T>::default(), ShortRod::<Dd>::default());
        // The f64 and the f32 nearest to arcsin(3/4) are below it by less than an ulp.
        let end = to_f64(T::from_f64(0.848_062_078_981_481));
        for k in 0..160 {
            let d = 2_f64.powf(f64::from(k) / 8.0).round() * ulp;
            for guess in [[-0.7, 0.25], [-2.3, 0.15], [-1.5, 0.2]] {
                let at = |x: f64| SVector::from([x, guess[0], guess[1]].map(T::from_f64));
                if d > 4.0 * ulp {
                    assert!(model.close(&at(end + d)).is_err(), "{d:e} beyond");
                    let Ok(found) = model.close(&at(end - d)) else {
                        panic!("refused {d:e} inside");
                    };
                    let found = exact.residual(&found.map(|x| Dd::from_f64(to_f64(x))));
                    let most = found
                        .iter()
                        .fold(0.0, |most: f64, x| most.max(x.to_f64().abs()));
                    assert!(most < 4.0 * ulp, "{most:e}");
                }
            }
        }
    }
    ends::<f64>(f64::EPSILON / 2.0, |x| x);
    ends::<f32>(f64::from(f32::EPSILON) / 2.0, f64::from);
    let error = ShortRod::<f64>::default().close(&SVector::from([0.9, -1.5, 0.2]));
    let error = error.expect_err("beyond the end");
    assert_eq!(
        (error.name(), error.cause()),
        ("rod_pin", Cause::OutOfReach)
    );
}

/// Steps of any length stay on the branch of the positions that they begin at: the root does not change its sign, on
/// either branch.
#[test]
fn integration_keeps_the_branch() {
    let model = SliderCrankNearSingular::<f64>::default();
    let start = model.neutral();
    // The mirror image of the rod at the perpendicular to the slide, and a slider at the other end of it.
    let mut other = start;
    let rod = start[0] + start[1];
    other[1] = std::f64::consts::PI - rod - start[0];
    other[2] = start[2] - 2.0 * 0.2 * rod.cos();
    let other = model.close(&other).expect("closed");
    let mut random = Random(31);
    for (q, sign) in [(start, 1.0), (other, -1.0)] {
        let mut q = q;
        for _ in 0..2000 {
            let step = SVector::from([0.7 * random.signed()]);
            q = model.integrate(&q, &step);
            assert!(model.constraint_residual(&q).amax() < 1e-15);
            assert!(((q[0] + q[1]).cos() > 0.0) == (sign * (start[0] + start[1]).cos() > 0.0));
        }
    }
}
