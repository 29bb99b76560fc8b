//! The columns of all parameters, with those that a parent moves alike as sums of the columns of the parent.

use bgdyn_runtime::Dd;

use super::super::base_parameters::take_to_parent;
use super::super::inertia::BodyInertia;
use super::super::inverse_dynamics::BodyWrench;
use super::super::plan::Plan;
use super::base_parameter::bodies;
use super::columns::{Columns, GivenMotion};
use super::directions::{CoordinateDirection, directions};
use super::wrenches::{ENTRIES, of_entries, of_parameters};
use crate::expr::Expr;
use crate::mechanism;

/// The efforts of a one in the place of a parameter, one for each coordinate.
type ParameterEfforts<'g> = Vec<Expr<'g>>;

/// Indices of D_xx, D_yy, D_zz among the entries of a body's inertia.
const XX: usize = 5;
const YY: usize = 6;
const ZZ: usize = 7;

impl<'g> Columns<'_, 'g> {
    /// Returns the matrix of all parameters of the bodies, row by row: m, h_z, D_zz of a body that turns about z are
    /// those of its parent, about the parent's origin.
    pub(super) fn whole_transported(&self, motion: GivenMotion, plan: &Plan) -> Vec<Expr<'g>> {
        let b = self.b;
        let moving = self.moving(motion);
        let directions = directions(b, &self.frames);
        b.section(|| "columns of the parameters".into());
        let mut entries: Vec<[ParameterEfforts<'g>; ENTRIES]> = Vec::new();
        let mut parameters: Vec<[ParameterEfforts<'g>; 10]> = Vec::new();
        for (j, (angular, a)) in moving.iter().enumerate() {
            let parent = self.frames.bodies[j].parent.map(|p| &entries[p]);
            let direct = of_entries(b, angular, *a).map(|w| self.column(&directions[j], &w));
            let of_body: [ParameterEfforts<'g>; ENTRIES] =
                std::array::from_fn(|entry| self.transported((plan, j), entry, &direct, parent));
            let straight = of_parameters(b, angular, *a).map(|w| self.column(&directions[j], &w));
            parameters.push(self.parameters_from(j, &of_body, &straight));
            entries.push(of_body);
        }
        let bodies = bodies(self.graph, self.geometry).into_iter();
        let columns = bodies.flat_map(|body| self.in_link_axes(body, &parameters[body]));
        self.rows(&columns.collect::<Vec<_>>())
    }

    /// Returns the column of an entry of body j: what remains in the body by its own columns, what moves to the parent
    /// by the parent's; what moves to the world is zero.
    fn transported(
        &self,
        (plan, j): (&Plan, usize),
        entry: usize,
        direct: &[ParameterEfforts<'g>; ENTRIES],
        parent: Option<&[ParameterEfforts<'g>; ENTRIES]>,
    ) -> ParameterEfforts<'g> {
        let b = self.b;
        let one = std::array::from_fn(|k| if k == entry { Dd::ONE } else { Dd::ZERO });
        let mut own = BodyInertia::of_numbers(b, &one);
        let moved = take_to_parent(b, self.graph, self.geometry, (plan, j), &mut own);
        let mut column = self.empty();
        let mut add = |inertia: &BodyInertia<'g>, columns: &[ParameterEfforts<'g>; ENTRIES]| {
            for (factor, other) in inertia.entries().into_iter().zip(columns) {
                for (sum, x) in column.iter_mut().zip(other) {
                    *sum = *sum + factor * *x;
                }
            }
        };
        add(&own, direct);
        if let Some(columns) = parent {
            add(&moved, columns);
        }
        column
    }

    /// Returns the columns of m, h and I in the axes of body j from those of its entries. I = tr(D)·1 − D: D_xx is
    /// I_yy + I_zz, and so on.
    fn parameters_from(
        &self,
        j: usize,
        entries: &[ParameterEfforts<'g>; ENTRIES],
        straight: &[ParameterEfforts<'g>; 10],
    ) -> [ParameterEfforts<'g>; 10] {
        let frame = &self.frames.bodies[j];
        let own: Vec<usize> = frame.columns.iter().map(|c| c.coordinate).collect();
        let whole_moves = frame.motion == mechanism::Motion::Translation;
        let rows = 0..self.graph.coordinates.len();
        let diagonal: Vec<[Expr<'g>; 3]> = rows
            .map(|k| {
                let [xx, yy, zz] = [XX, YY, ZZ].map(|entry| entries[entry][k]);
                if own.contains(&k) {
                    return [4, 6, 9].map(|p: usize| straight[p][k]);
                }
                if whole_moves {
                    let half = (xx + yy + zz) * Dd::from_f64(0.5);
                    return [half - xx, half - yy, half - zz];
                }
                let first = straight[4][k];
                let second = zz - first;
                [first, second, xx - second]
            })
            .collect();
        let of_diagonal = |i: usize| diagonal.iter().map(|d| d[i]).collect();
        let opposite = |entry: usize| entries[entry].iter().map(|&x| -x).collect();
        let mass = entries[0].iter().zip(&entries[1]);
        [
            mass.map(|(&across, &along)| across + along).collect(),
            entries[2].clone(),
            entries[3].clone(),
            entries[4].clone(),
            of_diagonal(0),
            opposite(8),
            of_diagonal(1),
            opposite(9),
            opposite(10),
            of_diagonal(2),
        ]
    }

    fn column(
        &self,
        directions: &[CoordinateDirection<'g>],
        wrench: &BodyWrench<'g>,
    ) -> ParameterEfforts<'g> {
        let mut column = self.empty();
        self.add(&mut column, directions, wrench);
        column
    }
}
