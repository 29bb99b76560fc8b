//! Sets the couplings of the joints that rows make dependent.

use bgdyn_runtime::Dd;

use super::elimination::{Dependent, ExpandedRow, Leftover, solve, sum};
use super::row::Row;
use crate::fault::{Faults, wording};
use crate::mechanism::check::mimic::narrow;
use crate::mechanism::{Coupling, Leader, Link, LinkId};

/// What joints follow: by `mimic`, by rows on positions, and by rows on velocities.
pub struct Relations {
    mimics: Vec<Option<Coupling>>,
    positions: Vec<Dependent>,
    velocities: Vec<Dependent>,
}

/// Couples the joints; `kept` stay independent. Joints with `mimic` are coupled already.
pub(super) fn couple(links: &mut [Link], rows: &[Row], kept: &[LinkId], faults: &mut Faults) {
    let mimics = links.iter().map(|link| link.joint.degrees.coupling.clone());
    let mut relations = Relations {
        mimics: mimics.collect(),
        positions: Vec::new(),
        velocities: Vec::new(),
    };
    let (positions, velocities): (Vec<&Row>, Vec<&Row>) =
        rows.iter().partition(|row| row.offset.is_some());
    let expanded: Vec<ExpandedRow> = (positions.iter())
        .map(|row| relations.without_mimics(row))
        .collect();
    let (dependents, left) = solve(&expanded, links.len(), kept);
    report(links, &positions, (&left, &dependents), faults);
    relations.positions = dependents;
    let expanded: Vec<ExpandedRow> = (velocities.iter())
        .map(|row| relations.of_independent_positions(row))
        .collect();
    let (dependents, left) = solve(&expanded, links.len(), kept);
    report(links, &velocities, (&left, &dependents), faults);
    relations.velocities = dependents;
    for i in 0..links.len() {
        if let Some(coupling) = relations.coupling(LinkId(i)) {
            links[i].joint.degrees.coupling = Some(coupling);
        }
    }
    for dependent in &relations.positions {
        limit(links, dependent, &positions, faults);
    }
}

impl Relations {
    /// Returns what joints follow by `mimic` and these rows on positions.
    pub fn of(links: &[Link], rows: &[Row]) -> Self {
        let mimics = links.iter().map(|link| link.joint.degrees.coupling.clone());
        let mut relations = Relations {
            mimics: mimics.collect(),
            positions: Vec::new(),
            velocities: Vec::new(),
        };
        let expanded = rows.iter().map(|row| relations.without_mimics(row));
        let expanded: Vec<ExpandedRow> = expanded.collect();
        (relations.positions, _) = solve(&expanded, links.len(), &[]);
        relations
    }

    /// Returns a sum of positions in joints that follow no others, and a constant.
    pub fn reduced(&self, terms: &[Leader]) -> ExpandedRow {
        let (terms, constant) = replaced(terms, Dd::ZERO, |link| self.by_mimic(link));
        replaced(&terms, constant, |link| self.by_positions(link))
    }

    fn by_mimic(&self, link: LinkId) -> Option<(&[Leader], Dd)> {
        let coupling = self.mimics[link.0].as_ref()?;
        Some((&coupling.positions, coupling.offset))
    }

    fn by_positions(&self, link: LinkId) -> Option<(&[Leader], Dd)> {
        let own = self.positions.iter().find(|d| d.link == link)?;
        Some((&own.leaders, own.offset))
    }

    fn by_velocities(&self, link: LinkId) -> Option<(&[Leader], Dd)> {
        let own = self.velocities.iter().find(|d| d.link == link)?;
        Some((&own.leaders, Dd::ZERO))
    }

    /// Returns a row in joints without `mimic`: its terms and the value of their sum.
    fn without_mimics(&self, row: &Row) -> ExpandedRow {
        let (terms, constant) = replaced(&row.terms, Dd::ZERO, |link| self.by_mimic(link));
        (terms, sum(row.offset.unwrap_or(Dd::ZERO), -constant))
    }

    /// Returns a row on velocities in joints whose positions follow no others.
    fn of_independent_positions(&self, row: &Row) -> ExpandedRow {
        let (terms, _) = replaced(&row.terms, Dd::ZERO, |link| self.by_mimic(link));
        let (terms, _) = replaced(&terms, Dd::ZERO, |link| self.by_positions(link));
        (terms, Dd::ZERO)
    }

    /// Returns what a joint follows; `None` for an independent one.
    fn coupling(&self, link: LinkId) -> Option<Coupling> {
        let relation = match self.by_mimic(link) {
            Some((leaders, offset)) => {
                Some(replaced(leaders, offset, |link| self.by_positions(link)))
            }
            None => (self.by_positions(link)).map(|(leaders, offset)| (leaders.to_vec(), offset)),
        };
        match relation {
            Some((positions, offset)) => {
                let (velocities, _) = replaced(&positions, Dd::ZERO, |l| self.by_velocities(l));
                Some(Coupling {
                    positions,
                    offset,
                    velocities,
                })
            }
            None => self.by_velocities(link).map(|(leaders, offset)| Coupling {
                positions: vec![],
                offset,
                velocities: leaders.to_vec(),
            }),
        }
    }
}

/// Returns Σ ratio · leader + offset with every leader that follows others replaced by its sum over those.
fn replaced<'a>(
    leaders: &[Leader],
    offset: Dd,
    of: impl Fn(LinkId) -> Option<(&'a [Leader], Dd)>,
) -> ExpandedRow {
    let (mut terms, mut constant): ExpandedRow = (Vec::new(), offset);
    let mut add = |link: LinkId, ratio: Dd| match terms.iter_mut().find(|l| l.link == link) {
        Some(own) => own.ratio = sum(own.ratio, ratio),
        None => terms.push(Leader { link, ratio }),
    };
    for leader in leaders {
        match of(leader.link) {
            None => add(leader.link, leader.ratio),
            Some((others, own)) => {
                let others = others.iter();
                others.for_each(|other| add(other.link, leader.ratio * other.ratio));
                constant = sum(constant, leader.ratio * own);
            }
        }
    }
    terms.retain(|leader| leader.ratio != Dd::ZERO);
    (terms, constant)
}

/// Narrows the limits of the joint that a dependent one follows, if it is one joint.
fn limit(links: &mut [Link], dependent: &Dependent, rows: &[&Row], faults: &mut Faults) {
    let [leader] = dependent.leaders.as_slice() else {
        return;
    };
    let limits = links[dependent.link.0].joint.limits;
    let other = &mut links[leader.link.0].joint;
    narrow(&mut other.limits, limits, (leader.ratio, dependent.offset));
    let range = (other.limits.lower, other.limits.upper);
    if let ((Some(lower), Some(upper)), Some(&row)) = (range, dependent.rows.first())
        && lower > upper
    {
        let location = &rows[row].location;
        faults.push(wording::constraint_empty_range(
            location,
            &other.name,
            [lower, upper],
        ));
    }
}

/// Reports rows that determine no joint, and joints that rows leave no motion.
fn report(
    links: &[Link],
    rows: &[&Row],
    (left, dependents): (&[Leftover], &[Dependent]),
    faults: &mut Faults,
) {
    let joint = |link: LinkId| links[link.0].joint.name.as_str();
    for leftover in left {
        let row = rows[leftover.row];
        let others: Vec<(&str, f64)> = (leftover.others.iter())
            .map(|(r, k)| (rows[*r].name.as_str(), k.to_f64()))
            .collect();
        let kept: Vec<&str> = leftover.kept.iter().map(|&link| joint(link)).collect();
        let (location, name) = (&row.location, (row.of, row.name.as_str()));
        faults.push(if !kept.is_empty() {
            wording::row_of_independents(location, name, &kept)
        } else if leftover.gap == Dd::ZERO {
            wording::dependent_row(location, name, &others)
        } else {
            wording::contradicting_row(location, name, &others, leftover.gap.to_f64())
        });
    }
    for dependent in dependents.iter().filter(|d| d.leaders.is_empty()) {
        let own: Vec<&Row> = dependent.rows.iter().map(|&r| rows[r]).collect();
        let mut names: Vec<(&str, &str)> = own.iter().map(|r| (r.of, r.name.as_str())).collect();
        names.dedup();
        if let Some(row) = own.first() {
            let at = row.offset.map(|_| dependent.offset.to_f64());
            let name = joint(dependent.link);
            faults.push(wording::no_motion_left(&row.location, name, &names, at));
        }
    }
}
