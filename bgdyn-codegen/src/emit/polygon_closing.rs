//! Emits the dependent positions of planar loops in closed form, one loop after the other.

use bgdyn_runtime::Dd;
use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::{format_ident, quote};

use super::constants::size;
use super::tokens::number;
use crate::bond_graph::ClosedTree;
use crate::mechanism::CoordinateId;
use crate::mechanism::closure::{
    PlaneJoint, PlaneVector, Polygon, PolygonForm, PolygonSide, TurnedVector, closing_polygons,
    snapped,
};
use crate::plan::{AngleSums, slider_numbers, triangle_numbers, turned_joints};

/// What closes planar loops.
pub(super) struct PolygonClosing {
    /// The function.
    pub function: TokenStream,
    /// The dependent velocities of all other loops.
    pub others: Vec<CoordinateId>,
}

/// Returns the function that closes all loops that are polygons; `None` if there are none.
pub(super) fn polygon_closing(closed: &ClosedTree) -> Option<PolygonClosing> {
    let (polygons, others) = closing_polygons(&closed.closure);
    let closings = polygons.iter().map(|polygon| {
        let name = format!("// {}", closed.closure.loops[polygon.closes].name);
        let closing = PolygonText { polygon }.closing();
        quote! { #[doc = #name] { #closing } }
    });
    let closings: Vec<TokenStream> = closings.collect();
    let function = quote! {
        /// Returns positions with those of planar loops in closed form, one root a loop: on the branch of the closed
        /// positions `branch`, without them on the branch that is nearer to `q`; angles with the whole turns nearest to
        /// those in `q`.
        fn close_polygons(
            &self,
            q: &__na::SVector<T, NQ>,
            branch: ::core::option::Option<&__na::SVector<T, NQ>>,
        ) -> __rt::closure::Closing<__na::SVector<T, NQ>> {
            use __rt::closure::polygon as plane;
            let [mut q] = q.data.0;
            let mut loops = plane::Polygons::new();
            #(#closings)*
            loops.finish(q).refined(&DEPENDENTS, |q| self.closing_step(q))
        }
    };
    (!polygons.is_empty()).then_some(PolygonClosing { function, others })
}

/// Sums of angles whose sines are computed in one call.
#[derive(Default)]
struct Angles {
    sums: AngleSums,
}

impl Angles {
    /// Returns the vector, turned by an angle of this call; `prefix` begins the names of its sines.
    fn turned(&mut self, prefix: &str, turned: &TurnedVector) -> TokenStream {
        let vector = constant_vector(turned.vector);
        let Some(k) = self.sums.index(turned) else {
            return quote! { plane::constant(#vector) };
        };
        let sine = format_ident!("{prefix}{k}");
        quote! { plane::turned(#sine, #vector) }
    }

    /// Returns the call, at the positions of this name.
    fn call(&self, prefix: &str, q: &str) -> TokenStream {
        let sines = (0..self.sums.all.len()).map(|k| format_ident!("{prefix}{k}"));
        let q = format_ident!("{q}");
        let sums = self.sums.all.iter().map(|angle| {
            let terms = angle.iter().map(|term| {
                let at = position(&q, term.joint);
                if term.opposite {
                    quote! { -#at }
                } else {
                    at
                }
            });
            quote! { &[#(#terms),*] }
        });
        let count = size(self.sums.all.len());
        match self.sums.all.is_empty() {
            true => TokenStream::new(),
            false => quote! {
                let [#(#sines),*] = T::sin_cos_all([#(#sums),*], [(0.0, 0.0); #count]);
            },
        }
    }
}

/// A loop.
struct PolygonText<'a> {
    polygon: &'a Polygon,
}

impl PolygonText<'_> {
    /// Returns the statements that set its dependent positions.
    fn closing(&self) -> TokenStream {
        match &self.polygon.form {
            PolygonForm::Triangle { first, second, .. } => self.triangle([first, second]),
            PolygonForm::Slider {
                arm, along, slide, ..
            } => self.slider(arm, along, *slide),
            PolygonForm::Cylinder {
                along,
                start,
                across,
                slide,
                ..
            } => self.cylinder(along, [*start, *across], *slide),
        }
    }

    /// Returns the branch as the run-time library has it.
    fn branch(&self) -> TokenStream {
        let (positive, place) = (self.polygon.positive, self.place());
        quote! { plane::PolygonBranch { positive: #positive, place: #place } }
    }

    fn place(&self) -> TokenStream {
        match self.polygon.closes {
            0 => quote! { NQ },
            closes => {
                let closes = size(closes);
                quote! { NQ + #closes }
            }
        }
    }

    /// Returns the vector D.
    fn known(&self, angles: &mut Angles) -> TokenStream {
        let q = format_ident!("q");
        let side = |side: &PolygonSide| {
            let turned = angles.turned("k", &side.turned);
            match side.slide {
                None => turned,
                Some(joint) => {
                    let x = position(&q, joint);
                    quote! { plane::scaled(#turned, #x) }
                }
            }
        };
        let sides: Vec<TokenStream> = self.polygon.known.iter().map(side).collect();
        quote! { plane::sum([#(#sides),*]) }
    }

    fn triangle(&self, arms: [&TurnedVector; 2]) -> TokenStream {
        let mut angles = Angles::default();
        let known = self.known(&mut angles);
        let here = arms.map(|arm| angles.turned("k", arm));
        let sines = angles.call("k", "q");
        let (there, sines_there) = turned_vectors("f", "from", &arms);
        let (lengths, unit) = triangle_numbers(arms);
        let (lengths, unit) = (lengths.map(constant), constant(unit));
        let (branch, positive) = (self.branch(), self.polygon.positive);
        let turning = self.turning(&arms);
        quote! {
            #sines
            let here = [#(#here),*];
            let found = loops.triangle(#known, [#(#lengths),*], #branch);
            let side = branch.map(|from| {
                let [from] = from.data.0;
                #sines_there
                plane::is_other(plane::cross(#(#there),*), #unit, #positive)
            });
            #turning
        }
    }

    fn slider(&self, arm: &TurnedVector, along: &TurnedVector, slide: PlaneJoint) -> TokenStream {
        let mut angles = Angles::default();
        let known = self.known(&mut angles);
        let [here, direction] = [arm, along].map(|v| angles.turned("k", v));
        let sines = angles.call("k", "q");
        let (there, sines_there) = turned_vectors("f", "from", &[arm, along]);
        let [square, unit] = slider_numbers(arm).map(constant);
        let (branch, positive) = (self.branch(), self.polygon.positive);
        let x = position(&format_ident!("q"), slide);
        let turning = self.turning(&[arm]);
        quote! {
            #sines
            let (here, along) = ([#here], #direction);
            let [own, opposite] = loops.slider((#known, along), #square, #branch);
            let found = [[own.0], [opposite.0]];
            let side = branch.map(|from| {
                let [from] = from.data.0;
                #sines_there
                plane::is_other(plane::dot(#(#there),*), #unit, #positive)
            });
            #turning
            #x = T::select(other, opposite.1, own.1);
        }
    }

    fn cylinder(&self, along: &TurnedVector, lengths: [Dd; 2], slide: PlaneJoint) -> TokenStream {
        let mut angles = Angles::default();
        let known = self.known(&mut angles);
        let here = angles.turned("k", along);
        let sines = angles.call("k", "q");
        let [start, across] = snapped(lengths).map(constant);
        let [x, there] = ["q", "from"].map(|q| position(&format_ident!("{q}"), slide));
        let (branch, positive) = (self.branch(), self.polygon.positive);
        let turning = self.turning(&[along]);
        quote! {
            #sines
            let here = [#here];
            let [own, opposite] = loops.cylinder(#known, [#start, #across], #branch);
            let found = [[own.0], [opposite.0]];
            let [from] = branch.map_or([q], |from| from.data.0);
            let length = #there + plane::number(#start);
            let side = ::core::option::Option::Some(plane::is_other(length, (1.0, 0.0), #positive));
            #turning
            #x = T::select(other, opposite.1, own.1);
        }
    }

    /// Returns the statements that turn links from the directions `here` to those `found` on either branch, by their
    /// dependent joints: first nearly, then to rounding.
    fn turning(&self, links: &[&TurnedVector]) -> TokenStream {
        let count = links.len();
        let number = size(count);
        let turns: Vec<_> = (0..count).map(|k| format_ident!("turn{k}")).collect();
        let vectors: Vec<_> = (0..count).map(|k| format_ident!("to{k}")).collect();
        let places: Vec<_> = (0..count).map(size).collect();
        let place = self.place();
        let joints = turned_joints(self.polygon, links);
        let changes = joints.iter().map(|(_, terms)| {
            let terms = terms.iter().map(|&(k, negative)| {
                let turn = &turns[k];
                if negative {
                    quote! { - #turn }
                } else {
                    quote! { + #turn }
                }
            });
            let sum: TokenStream = terms.collect();
            plain_sum(sum)
        });
        let changes: Vec<TokenStream> = changes.collect();
        let own: Vec<TokenStream> = (joints.iter())
            .map(|(joint, _)| position(&format_ident!("q"), *joint))
            .collect();
        let (near, sines) = turned_vectors("n", "q", links);
        quote! {
            let moved = |[#(#turns),*]: [T; #number]| [#(#changes),*];
            let turns = |[#(#vectors),*]: [_; #number]| [#(plane::turn(here[#places], #vectors)),*];
            let (other, turns) = match side {
                ::core::option::Option::Some(other) => {
                    (other, turns([#(plane::chosen(other, [found[0][#places], found[1][#places]])),*]))
                }
                ::core::option::Option::None => {
                    let turns = found.map(turns);
                    let other = plane::is_nearer(turns.map(moved));
                    (other, plane::chosen(other, turns))
                }
            };
            #(#own = #own + moved(turns)[#places];)*
            if !plane::are_exact(turns) {
                #sines
                let here = [#(#near),*];
                let found = [#(plane::chosen(other, [found[0][#places], found[1][#places]])),*];
                let left = [#(plane::small_turn(here[#places], found[#places])),*];
                let turns = plane::rest(turns, left);
                #(#own = #own + moved(turns)[#places];)*
            }
            #(loops.check_angle(#own, #place);)*
        }
    }
}

/// Returns vectors turned at the positions of this name, and the statement with their sines.
fn turned_vectors(
    prefix: &str,
    q: &str,
    links: &[&TurnedVector],
) -> (Vec<TokenStream>, TokenStream) {
    let mut angles = Angles::default();
    let turned = links.iter().map(|link| angles.turned(prefix, link));
    let turned = turned.collect();
    (turned, angles.call(prefix, q))
}

fn position(q: &Ident, joint: PlaneJoint) -> TokenStream {
    let p = size(joint.position.0);
    quote! { #q[#p] }
}

/// Returns a sum without a plus sign before its first term.
fn plain_sum(sum: TokenStream) -> TokenStream {
    let mut tokens = sum.into_iter().peekable();
    let plus = |token: &TokenTree| matches!(token, TokenTree::Punct(sign) if sign.as_char() == '+');
    if tokens.peek().is_some_and(plus) {
        tokens.next();
    }
    tokens.collect()
}

/// Returns a number in two words.
fn constant(x: Dd) -> TokenStream {
    let part = |x: f64| {
        let size = number(x.abs());
        if x < 0.0 {
            quote! { -#size }
        } else {
            quote! { #size }
        }
    };
    let (hi, lo) = (part(x.hi()), part(x.lo()));
    quote! { (#hi, #lo) }
}

fn constant_vector(v: PlaneVector) -> TokenStream {
    let [x, y] = snapped(v).map(constant);
    quote! { [#x, #y] }
}
