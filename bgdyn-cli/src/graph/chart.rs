//! The data of a drawing: junctions, transformers and one-ports, in the order of the tree.

use std::fmt;

/// The drawing of a bond graph, without places.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Chart {
    /// What it is the graph of.
    pub title: String,
    /// What the spec says of it.
    pub description: Option<String>,
    /// 1-junctions of the generalized velocities, each before those that it carries.
    pub velocities: Vec<Velocity>,
    /// The links that move, parents first, each before the next of its carrier's other links.
    pub links: Vec<ChartLink>,
    /// Lines between two places, along which something acts: as links without a joint.
    pub lines: Vec<ChartLink>,
    /// Frames of links at which something acts: their flow is [ω; v].
    pub sites: Vec<ChartLink>,
    /// Names of links that no coordinate moves: none of their junctions is there.
    pub still: Vec<String>,
    /// Names of links that move and carry others, but have no store and no source: none of their
    /// junctions is there, the velocities of their joints act on the links that they carry.
    pub folded: Vec<String>,
    /// What has to be said of it beside.
    pub notes: Vec<String>,
}

impl Chart {
    /// Links, then lines, then sites.
    pub fn bands(&self) -> impl Iterator<Item = &ChartLink> {
        self.links.iter().chain(&self.lines).chain(&self.sites)
    }

    /// Every flow, link by link.
    pub fn flows(&self) -> impl Iterator<Item = &Flow> {
        self.bands().flat_map(|link| &link.flows)
    }

    /// Every transformer, link by link.
    pub fn transformers(&self) -> impl Iterator<Item = &Transformer> {
        self.flows().flat_map(|flow| &flow.transformers)
    }

    /// Whether a modulus varies with the coordinates.
    pub fn varies(&self) -> bool {
        self.transformers().any(|t| t.symbol() == "MTF")
    }

    /// Whether something with this property stands on a junction.
    pub fn has(&self, property: impl Fn(&Port) -> bool) -> bool {
        let on_links = self.flows().flat_map(|flow| &flow.ports);
        let on_velocities = self.velocities.iter().flat_map(|v| &v.ports);
        let mut waiting: Vec<&Port> = on_velocities.chain(on_links).collect();
        while let Some(port) = waiting.pop() {
            if property(port) {
                return true;
            }
            waiting.extend(&port.ports);
        }
        false
    }

    /// How much of the graph is there.
    pub fn census(&self) -> String {
        let not_drawn = self.still.len() + self.folded.len();
        let (nv, links) = (self.velocities.len(), self.links.len() + not_drawn);
        let of_links = || self.transformers().filter(|t| t.is_vector());
        let there = of_links().count();
        let count = |of: fn(&Component) -> bool| {
            let components = of_links().flat_map(|t| &t.modulus);
            components.filter(|c| of(c)).count()
        };
        let zero = count(|c| *c == Component::Zero);
        let varying = count(|c| *c == Component::Varying);
        let constant = 3 * there - zero - varying;
        let mut text = format!(
            "{}, {}: {there} of {} transformers are there; of their {} components {zero} are zero, {constant} constant, {varying} vary with the coordinates",
            counted(nv, "velocity", "velocities"),
            counted(links, "link", "links"),
            2 * nv * links,
            3 * there
        );
        if !self.still.is_empty() {
            text += &format!(". No joint moves {}", self.still.join(", "));
        }
        if !self.folded.is_empty() {
            let names = self.folded.join(", ");
            text += &format!(". Massless and not drawn, with their transformers: {names}");
        }
        text
    }
}

/// `1 link`, `2 links`
fn counted(n: usize, one: &str, several: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { several })
}

/// The 1-junction of a generalized velocity.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Velocity {
    /// `q̇₂`
    pub symbol: String,
    /// The joint's name.
    pub name: String,
    /// `rad/s`
    pub unit: &'static str,
    /// `N·m`
    pub effort: &'static str,
    /// What acts on it: the drive first.
    pub ports: Vec<Port>,
}

/// A link and the junctions of its flows.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ChartLink {
    /// Its name.
    pub name: String,
    /// The velocities that begin here, as places among [`Chart::velocities`]: those of the folded
    /// links that carry it, then its own joint's.
    pub velocities: Vec<usize>,
    /// Its flows that transformers feed and on which something acts.
    pub flows: Vec<Flow>,
}

/// The 1-junction of a link's flow, and what feeds it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Flow {
    /// `ṙ₂` or `ω₂`
    pub symbol: String,
    /// The transformers whose flows add up to it, at least one.
    pub transformers: Vec<Transformer>,
    /// Its store and its source.
    pub ports: Vec<Port>,
}

impl Flow {
    /// Whether its transformers meet in a 0-junction. A single one feeds the 1-junction itself.
    pub fn sums(&self) -> bool {
        self.transformers.len() > 1
    }

    /// Whether it is a vector.
    pub fn is_vector(&self) -> bool {
        self.transformers.iter().any(Transformer::is_vector)
    }
}

/// A transformer from a generalized velocity to a link's flow.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Transformer {
    /// The velocity, as its place among [`Chart::velocities`].
    pub velocity: usize,
    /// `∂r₂/∂q₁` or `ρ₁²`
    pub name: String,
    /// Its components x, y, z; a single one on the way to the rate of a length.
    pub modulus: Vec<Component>,
    /// What it varies with: `q₁…q₃`; empty for a constant one.
    pub varies: String,
}

impl Transformer {
    /// `MTF` where the modulus varies with the coordinates, `TF` where it does not.
    pub fn symbol(&self) -> &'static str {
        match self.varies.is_empty() {
            true => "TF",
            false => "MTF",
        }
    }

    /// Whether it is a vector's.
    pub fn is_vector(&self) -> bool {
        self.modulus.len() > 1
    }

    /// `(0, 0.17, ·)`
    pub fn vector(&self) -> String {
        let entries: Vec<String> = self.modulus.iter().map(Component::to_string).collect();
        format!("({})", entries.join(", "))
    }
}

/// A component of a modulus.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Component {
    /// Zero at every q.
    Zero,
    /// The same at every q, as it is written.
    Constant(String),
    /// The same at every q, but known at run time only.
    Parameter,
    /// Varies with the coordinates.
    Varying,
}

impl fmt::Display for Component {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Component::Zero => "0",
            Component::Constant(number) => number,
            Component::Parameter => "p",
            Component::Varying => "·",
        })
    }
}

/// What stands on a junction, by one bond.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Port {
    /// `Se`, `Sf`, `I`, `R`, `C`, `GY`, `TF`, or a junction of its own: `1`, `0`.
    pub symbol: &'static str,
    /// `m₂ = 4.5 kg`
    pub text: String,
    /// What does not fit beside it.
    pub more: Option<String>,
    /// Whether positive power flows from it into the junction.
    pub feeds: bool,
    /// Whether the effort acts on the junction, where that is determined: there is the causal
    /// stroke, else at the other end.
    pub on_junction: Option<bool>,
    /// What stands behind it in turn.
    pub ports: Vec<Port>,
}

impl Port {
    /// Whether it is a junction.
    pub fn is_junction(&self) -> bool {
        matches!(self.symbol, "0" | "1")
    }

    /// How many lines it takes.
    pub fn lines(&self) -> usize {
        lines(&self.ports)
    }
}

/// How many lines these take, one below the other.
pub(super) fn lines(ports: &[Port]) -> usize {
    ports.iter().map(Port::lines).sum::<usize>().max(1)
}
