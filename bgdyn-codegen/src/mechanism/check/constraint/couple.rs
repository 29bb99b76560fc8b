//! Sets the couplings of the joints that rows make dependent.

use bgdyn_runtime::Dd;

use super::elimination::{Dependent, Leftover, solve};
use super::row::Row;
use crate::fault::{Faults, wording};
use crate::mechanism::check::mimic::narrow;
use crate::mechanism::{Coupling, Leader, Link, LinkId};

/// A row in the joints that others follow: terms and the value of their sum.
type ExpandedRow = (Vec<(LinkId, Dd)>, Dd);

/// Couples the joints; `kept` stay independent. Joints with `mimic` are coupled already.
pub(super) fn couple(links: &mut [Link], rows: &[Row], kept: &[LinkId], faults: &mut Faults) {
    let n = links.len();
    for &link in kept {
        if let Some(coupling) = &links[link.0].joint.degrees.coupling {
            let names = names(links, &coupling.velocities);
            let fault = wording::independent_follower(
                &rows
                    .first()
                    .map_or_else(crate::fault::Location::file, |row| row.location.clone()),
                &links[link.0].joint.name,
                &names,
            );
            faults.push(fault);
            return;
        }
    }
    let given: Vec<Option<Coupling>> = links
        .iter()
        .map(|l| l.joint.degrees.coupling.clone())
        .collect();
    let (positions, velocities): (Vec<&Row>, Vec<&Row>) =
        rows.iter().partition(|row| row.offset.is_some());
    let of_mimic = |link: LinkId| given[link.0].as_ref().map(|c| (&c.positions, c.offset));
    let expanded: Vec<ExpandedRow> = positions.iter().map(|row| expand(row, &of_mimic)).collect();
    let (holonomic, left) = solve(&expanded, n, kept);
    report(links, &positions, &left, &holonomic, faults);
    let of_positions = |link: LinkId| {
        let own = holonomic.iter().find(|d| d.link == link);
        own.map(|d| (&d.leaders, d.offset))
    };
    let of_both = |row: &Row| {
        let (terms, offset) = expand(row, &of_mimic);
        let row = Row {
            terms,
            offset: Some(offset),
            ..row.clone()
        };
        expand(&row, &of_positions)
    };
    let expanded: Vec<ExpandedRow> = velocities.iter().map(|row| of_both(row)).collect();
    let (rates, left) = solve(&expanded, n, kept);
    report(links, &velocities, &left, &rates, faults);
    let of_velocities = |link: LinkId| {
        let own = rates.iter().find(|d| d.link == link);
        own.map(|d| (&d.leaders, Dd::ZERO))
    };
    for i in 0..n {
        let own = LinkId(i);
        let relation = match (&given[i], of_positions(own)) {
            (Some(mimic), _) => Some(replaced(&mimic.positions, mimic.offset, &of_positions)),
            (None, Some((leaders, offset))) => Some((leaders.clone(), offset)),
            (None, None) => None,
        };
        let coupling = match (relation, of_velocities(own)) {
            (Some((leaders, offset)), _) => {
                let (velocities, _) = replaced(&leaders, Dd::ZERO, &of_velocities);
                Coupling {
                    positions: leaders,
                    offset,
                    velocities,
                }
            }
            (None, Some((leaders, _))) => Coupling {
                positions: vec![],
                offset: Dd::ZERO,
                velocities: leaders.clone(),
            },
            (None, None) => continue,
        };
        limit(links, own, &coupling, given[i].is_some());
        links[i].joint.degrees.coupling = Some(coupling);
    }
}

/// Narrows the limits of the joint that a dependent one follows, if it is one joint.
fn limit(links: &mut [Link], follower: LinkId, coupling: &Coupling, known: bool) {
    if let ([leader], false) = (coupling.positions.as_slice(), known) {
        let limits = links[follower.0].joint.limits;
        let other = &mut links[leader.link.0].joint.limits;
        narrow(other, limits, (leader.ratio, coupling.offset));
    }
}

/// Returns the terms of a row in the joints that others follow.
fn expand<'a>(row: &Row, of: &impl Fn(LinkId) -> Option<(&'a Vec<Leader>, Dd)>) -> ExpandedRow {
    let leaders: Vec<Leader> = row
        .terms
        .iter()
        .map(|&(link, ratio)| Leader { link, ratio })
        .collect();
    let (terms, constant) = replaced(&leaders, Dd::ZERO, of);
    let offset = row.offset.unwrap_or(Dd::ZERO) - constant;
    (
        terms.into_iter().map(|l| (l.link, l.ratio)).collect(),
        offset,
    )
}

/// Returns Σ ratio · leader + offset with every leader that follows others replaced by its sum over those.
fn replaced<'a>(
    leaders: &[Leader],
    offset: Dd,
    of: &impl Fn(LinkId) -> Option<(&'a Vec<Leader>, Dd)>,
) -> (Vec<Leader>, Dd) {
    let (mut sum, mut constant): (Vec<Leader>, Dd) = (Vec::new(), offset);
    let mut add = |link: LinkId, ratio: Dd| match sum.iter_mut().find(|l| l.link == link) {
        Some(own) => own.ratio += ratio,
        None => sum.push(Leader { link, ratio }),
    };
    for leader in leaders {
        match of(leader.link) {
            None => add(leader.link, leader.ratio),
            Some((others, own)) => {
                others
                    .iter()
                    .for_each(|other| add(other.link, leader.ratio * other.ratio));
                constant += leader.ratio * own;
            }
        }
    }
    sum.retain(|leader| leader.ratio != Dd::ZERO);
    (sum, constant)
}

/// Reports rows that determine no joint, and joints that rows leave no motion.
fn report(
    links: &[Link],
    rows: &[&Row],
    left: &[Leftover],
    dependents: &[Dependent],
    faults: &mut Faults,
) {
    let joint = |link: LinkId| links[link.0].joint.name.as_str();
    for leftover in left {
        let row = rows[leftover.row];
        let others: Vec<(&str, f64)> = (leftover.others.iter())
            .map(|(r, k)| (rows[*r].name.as_str(), k.to_f64()))
            .collect();
        let kept: Vec<&str> = leftover.kept.iter().map(|&link| joint(link)).collect();
        let (location, name) = (&row.location, row.name.as_str());
        faults.push(if !kept.is_empty() {
            wording::row_of_independents(location, name, &kept)
        } else if leftover.gap == Dd::ZERO {
            wording::dependent_row(location, name, &others)
        } else {
            wording::contradicting_row(location, name, &others, leftover.gap.to_f64())
        });
    }
    for dependent in dependents.iter().filter(|d| d.leaders.is_empty()) {
        let names: Vec<&str> = rows.iter().map(|row| row.name.as_str()).collect();
        if let Some(row) = rows.first() {
            let at = dependent.offset.to_f64();
            faults.push(wording::no_motion_left(
                &row.location,
                joint(dependent.link),
                &names,
                at,
            ));
        }
    }
}

fn names(links: &[Link], leaders: &[Leader]) -> Vec<String> {
    let name = |leader: &Leader| links[leader.link.0].joint.name.clone();
    leaders.iter().map(name).collect()
}
