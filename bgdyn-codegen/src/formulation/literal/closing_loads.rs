//! Loads of loops and contacts from the poses of their places in fixed axes.

use super::relative_poses::RelativePoses;
use super::sum::PlacedLoad;
use crate::expr::Expr;
use crate::mechanism::LinkId;

impl<'g> RelativePoses<'_, 'g> {
    /// Returns force and moment of each loop on place b about its origin, in the axes of the link of place a; of each
    /// wheel and ball at its contact, in the axes of the contact; of each knife edge in the axes of its link.
    pub(super) fn reactions(&self, lambda: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let reaction = |closes: usize| {
            let [force, moment, _] = self.load(closes, lambda);
            let axes = self.reaction_axes(closes);
            let (force, moment) = (axes * force, axes * moment);
            force.0.into_iter().chain(moment.0)
        };
        let loops = 0..self.closure.loops.len();
        loops.flat_map(reaction).collect()
    }

    /// Returns the loads on the links, in fixed axes.
    pub(super) fn loads(&self, lambda: &[Expr<'g>]) -> Vec<PlacedLoad<'g>> {
        let mut all = Vec::new();
        for (closes, one) in self.closure.loops.iter().enumerate() {
            let [force, moment, point] = self.load(closes, lambda);
            let (axes, origin) = self.carriers[closes];
            let (force, moment) = (axes * force, axes * moment);
            let point = origin + axes * point;
            let [a, b] = one.links;
            // On b of a loop, on the wheel of a contact; the opposite load on the other one.
            let (on, other) = match one.contact {
                None => (b, a),
                Some(_) => (a, b),
            };
            let load = |link: LinkId, sign: bool| PlacedLoad {
                link,
                point,
                force: if sign { force } else { -force },
                moment: if sign { moment } else { -moment },
            };
            all.extend(on.map(|link| load(link, true)));
            all.extend(other.map(|link| load(link, false)));
        }
        all
    }
}
