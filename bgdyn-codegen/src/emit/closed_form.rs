//! Emits the dependent positions of planar loops in closed form, one loop after the other.

use bgdyn_runtime::Dd;
use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::constants::size;
use super::tokens::number;
use crate::bond_graph::ClosedTree;
use crate::mechanism::CoordinateId;
use crate::mechanism::closure::{
    AngleTerm, PlaneJoint, PlaneVector, Polygon, PolygonForm, PolygonSide, TurnedVector,
    closing_polygons, snapped,
};

/// What closes planar loops.
pub(super) struct ClosedForm {
    /// The function.
    pub function: TokenStream,
    /// The dependent velocities of all other loops.
    pub others: Vec<CoordinateId>,
}

/// Returns the function that closes all loops that are polygons; `None` if there are none.
pub(super) fn closed_form(closed: &ClosedTree) -> Option<ClosedForm> {
    let (polygons, others) = closing_polygons(&closed.closure);
    let closings = polygons.iter().map(|polygon| {
        let name = format!("// {}", closed.closure.loops[polygon.closes].name);
        let closing = PolygonText { polygon }.closing();
        quote! { #[doc = #name] { #closing } }
    });
    let closings: Vec<TokenStream> = closings.collect();
    let function = quote! {
        /// Returns positions with those of planar loops in closed form: one root a loop, on the branch of the positions
        /// `branch` or, without them, of `q`; angles with the whole turns nearest to those in `q`.
        fn close_polygons(
            &self,
            q: &__na::SVector<T, NQ>,
            branch: ::core::option::Option<&__na::SVector<T, NQ>>,
        ) -> __rt::closure::Closing<__na::SVector<T, NQ>> {
            let [mut q] = q.data.0;
            let mut loops = __rt::closure::polygon::Polygons::new();
            #(#closings)*
            loops.finish(q)
        }
    };
    (!polygons.is_empty()).then_some(ClosedForm { function, others })
}

/// Sums of angles whose sines are computed in one call.
#[derive(Default)]
struct Angles {
    all: Vec<Vec<AngleTerm>>,
}

impl Angles {
    /// Returns the vector, turned by an angle of this call; `prefix` begins the names of its sines.
    fn turned(&mut self, prefix: &str, turned: &TurnedVector) -> TokenStream {
        let vector = constant_vector(turned.vector);
        if turned.angle.is_empty() {
            return quote! { __rt::closure::polygon::constant(#vector) };
        }
        let known = self.all.iter().position(|angle| *angle == turned.angle);
        let k = known.unwrap_or_else(|| {
            self.all.push(turned.angle.clone());
            self.all.len() - 1
        });
        let sine = format_ident!("{prefix}{k}");
        quote! { __rt::closure::polygon::turned(#sine, #vector) }
    }

    /// Returns the call, at the positions of this name.
    fn call(&self, prefix: &str, q: &str) -> TokenStream {
        let sines = (0..self.all.len()).map(|k| format_ident!("{prefix}{k}"));
        let q = format_ident!("{q}");
        let sums = self.all.iter().map(|angle| {
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
        let count = size(self.all.len());
        match self.all.is_empty() {
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
        quote! { __rt::closure::polygon::PolygonBranch { positive: #positive, place: #place } }
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
                    quote! { __rt::closure::polygon::scaled(#turned, #x) }
                }
            }
        };
        let sides: Vec<TokenStream> = self.polygon.known.iter().map(side).collect();
        quote! { __rt::closure::polygon::sum([#(#sides),*]) }
    }

    fn triangle(&self, arms: [&TurnedVector; 2]) -> TokenStream {
        let mut angles = Angles::default();
        let known = self.known(&mut angles);
        let here = arms.map(|arm| angles.turned("k", arm));
        let sines = angles.call("k", "q");
        let (there, sines_there) = turned_vectors("f", "from", &arms);
        let [a, b] = arms.map(|arm| length(arm.vector));
        let [outer, inner] = [a + b, a - b].map(|x| x * x);
        let lengths = [outer, inner, a * a - b * b, Dd::ONE / (a * b)].map(constant);
        let branch = self.branch();
        let turning = self.turning(&arms);
        quote! {
            #sines
            let here = [#(#here),*];
            let there = match branch {
                ::core::option::Option::None => here,
                ::core::option::Option::Some(from) => {
                    let [from] = from.data.0;
                    #sines_there
                    [#(#there),*]
                }
            };
            let wanted = loops.triangle(#known, [#(#lengths),*], there, #branch);
            #turning
        }
    }

    fn slider(&self, arm: &TurnedVector, along: &TurnedVector, slide: PlaneJoint) -> TokenStream {
        let mut angles = Angles::default();
        let known = self.known(&mut angles);
        let [here, direction] = [arm, along].map(|v| angles.turned("k", v));
        let sines = angles.call("k", "q");
        let (there, sines_there) = turned_vectors("f", "from", &[arm, along]);
        let a = length(arm.vector);
        let lengths = [a * a, Dd::ONE / a].map(constant);
        let (branch, x) = (self.branch(), position(&format_ident!("q"), slide));
        let turning = self.turning(&[arm]);
        quote! {
            #sines
            let (here, along) = ([#here], #direction);
            let there = match branch {
                ::core::option::Option::None => (here[0], along),
                ::core::option::Option::Some(from) => {
                    let [from] = from.data.0;
                    #sines_there
                    (#(#there),*)
                }
            };
            let (arm, x) = loops.slider((#known, along), [#(#lengths),*], there, #branch);
            let wanted = [arm];
            #x = x;
            #turning
        }
    }

    fn cylinder(&self, along: &TurnedVector, lengths: [Dd; 2], slide: PlaneJoint) -> TokenStream {
        let mut angles = Angles::default();
        let known = self.known(&mut angles);
        let here = angles.turned("k", along);
        let sines = angles.call("k", "q");
        let [start, across] = snapped(lengths);
        let lengths = [start, across].map(constant);
        let [x, from] = ["q", "from"].map(|q| position(&format_ident!("{q}"), slide));
        let branch = self.branch();
        let turning = self.turning(&[along]);
        quote! {
            #sines
            let here = [#here];
            let there = match branch {
                ::core::option::Option::None => #x,
                ::core::option::Option::Some(from) => {
                    let [from] = from.data.0;
                    #from
                }
            };
            let (along, x) = loops.cylinder(#known, [#(#lengths),*], there, #branch);
            let wanted = [along];
            #x = x;
            #turning
        }
    }

    /// Returns the statements that turn links from the directions `here` to those `wanted`, by their dependent joints:
    /// first nearly, then to rounding.
    fn turning(&self, links: &[&TurnedVector]) -> TokenStream {
        let count = links.len();
        let turns: Vec<_> = (0..count).map(|k| format_ident!("turn{k}")).collect();
        let (places, place): (Vec<_>, _) = ((0..count).map(size).collect(), self.place());
        let joints = self.turned_joints(links);
        let moved = joints.iter().map(|(joint, terms)| {
            let x = position(&format_ident!("q"), *joint);
            let terms = terms.iter().map(|&(k, negative)| {
                let turn = &turns[k];
                if negative {
                    quote! { - #turn }
                } else {
                    quote! { + #turn }
                }
            });
            quote! { #x = #x #(#terms)*; }
        });
        let moved: Vec<TokenStream> = moved.collect();
        let checked = joints.iter().map(|(joint, _)| {
            let x = position(&format_ident!("q"), *joint);
            quote! { loops.check_angle(#x, #place); }
        });
        let (near, sines) = turned_vectors("n", "q", links);
        quote! {
            #(let #turns = loops.turn(here[#places], wanted[#places]);)*
            #(#moved)*
            #sines
            let here = [#(#near),*];
            #(let #turns = loops.small_turn(here[#places], wanted[#places]);)*
            #(#moved)*
            #(#checked)*
        }
    }

    /// Returns the dependent joints whose positions are angles, each with the links whose turns its change is the sum of,
    /// and whether these are subtracted.
    fn turned_joints(&self, links: &[&TurnedVector]) -> Vec<(PlaneJoint, Vec<(usize, bool)>)> {
        let dependents = self.polygon.dependents();
        let own = |link: usize| -> Vec<AngleTerm> {
            let terms = links[link].angle.iter().copied();
            terms
                .filter(|term| dependents.contains(&term.joint))
                .collect()
        };
        let mut order: Vec<usize> = (0..links.len()).collect();
        order.sort_by_key(|&k| own(k).len());
        let mut found: Vec<(PlaneJoint, Vec<(usize, bool)>)> = vec![];
        for link in order {
            let terms = own(link);
            let known = |term: &AngleTerm| found.iter().find(|(joint, _)| *joint == term.joint);
            let Some(last) = terms.iter().find(|term| known(term).is_none()) else {
                continue;
            };
            let mut sum = vec![(link, last.opposite)];
            for other in &terms {
                for &(k, negative) in known(other).iter().flat_map(|(_, terms)| terms) {
                    // The turn of this link less that of the joint before.
                    sum.push((k, negative != (other.opposite == last.opposite)));
                }
            }
            found.push((last.joint, sum));
        }
        found
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

fn length([x, y]: PlaneVector) -> Dd {
    (x * x + y * y).sqrt()
}
