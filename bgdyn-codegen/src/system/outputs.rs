//! The outputs of a scene: positions, velocities, readings of effects, first-order states, places of sites.

use super::{EffortSums, Named, SceneEquations};
use crate::bond_graph;
use crate::expr::Expr;
use crate::fault::{Faults, wording};
use crate::format::Dimension;
use crate::method::Method;
use crate::scene::Level;

/// Returns the outputs of the scene, with their expressions.
pub(super) fn outputs<'g>(
    system: &SceneEquations,
    sums: &EffortSums<'g, '_>,
    faults: &mut Faults,
) -> Vec<(Named, Expr<'g>)> {
    let layout = &system.scene.layout;
    let mut known: Vec<(Named, Expr<'g>)> = Vec::new();
    let mut add = |name: &str, unit: &'static str, about: &str, value: Expr<'g>| {
        let (name, about) = (name.to_owned(), about.to_owned());
        known.push((Named { name, unit, about }, value));
    };
    for (position, &q) in layout.positions.iter().zip(&sums.q) {
        let unit = position.dimension.si();
        add(&position.name, unit, &position.about(), q);
    }
    for joint in &layout.prescribed {
        let levels = [Level::Position, Level::Rate, Level::Acceleration];
        let names = levels.map(|level| level.name(joint));
        let own = layout.inputs.iter().zip(sums.inputs());
        for (part, &value) in own.filter(|(part, _)| names.contains(&part.name)) {
            add(&part.name, part.dimension.si(), &part.about, value);
        }
    }
    for (j, c) in layout.coordinates.iter().enumerate() {
        add(
            &c.rate_name,
            c.dimensions[1].si(),
            &c.about_velocity(),
            sums.v[j],
        );
    }
    for joint in &layout.dependents {
        let mut asked = system.scene.outputs.iter();
        let rate = match asked.any(|output| output.value == joint.rate_name) {
            true => sums.coordinate(&joint.name).rate,
            false => sums.b.zero(),
        };
        let unit = joint.dimensions[1].si();
        add(
            &joint.rate_name,
            unit,
            &format!("velocity of `{}`, {unit}", joint.name),
            rate,
        );
    }
    for reading in sums.readings() {
        add(&reading.name, reading.unit, &reading.about, reading.value);
    }
    for (part, &x) in layout.states.iter().zip(sums.states()) {
        add(&part.name, part.dimension.si(), &part.about, x);
    }
    let mut wanted = Vec::new();
    for output in &system.scene.outputs {
        if let Some(one) = known.iter().find(|(n, _)| n.name == output.value) {
            wanted.push(one.clone());
            continue;
        }
        let site = system
            .graph
            .sites
            .iter()
            .position(|s| s.name == output.value);
        if let Some(site) = site {
            let pose = sums.method(Method::Pose(bond_graph::SiteId(site)));
            for (axis, &p) in ["x", "y", "z"].into_iter().zip(&pose[9..]) {
                let name = format!("{}_{axis}", output.value);
                let about = format!("{axis} of `{}` in the world, m", output.value);
                let unit = Dimension::Length.si();
                wanted.push((Named { name, unit, about }, p));
            }
            continue;
        }
        let names = known.iter().map(|(n, _)| n.name.as_str());
        let sites = system.graph.sites.iter().map(|s| s.name.as_str());
        let all: Vec<&str> = names.chain(sites).collect();
        let (place, name) = (&output.location, &output.value);
        faults.push(wording::unknown_output(place, name, &all));
    }
    wanted
}
