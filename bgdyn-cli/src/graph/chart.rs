//! The data of a drawing: junctions, transformers and one-ports, in tree order.

use std::fmt;

/// The drawing of a bond graph, without coordinates.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Chart {
    /// The title.
    pub title: String,
    /// The description in the spec.
    pub description: Option<String>,
    /// 1-junctions of the generalized velocities, each before those of outboard joints.
    pub velocities: Vec<Velocity>,
    /// The links that move, in depth-first order.
    pub links: Vec<ChartLink>,
    /// Lines between two sites with an element along them, drawn like links without a joint.
    pub lines: Vec<ChartLink>,
    /// The velocities that loops hold at zero.
    pub loops: Vec<ChartLink>,
    /// Relative velocities at contacts.
    pub contacts: Vec<ChartLink>,
    /// Frames of links with an element: their flow is [ω; v].
    pub sites: Vec<ChartLink>,
    /// Names of links that no coordinate moves, which have no junctions.
    pub still: Vec<String>,
    /// Names of moving links with children, but without store and source: they have no junctions, and the
    /// velocities of their joints act on their children.
    pub folded: Vec<String>,
    /// Additional notes.
    pub notes: Vec<String>,
}

impl Chart {
    /// Returns links, then lines, then sites, then loops, then contacts.
    pub fn bands(&self) -> impl Iterator<Item = &ChartLink> {
        let places = self.lines.iter().chain(&self.sites);
        let relative = self.loops.iter().chain(&self.contacts);
        self.links.iter().chain(places).chain(relative)
    }

    /// Returns every flow, link by link.
    pub fn flows(&self) -> impl Iterator<Item = &Flow> {
        self.bands().flat_map(|link| &link.flows)
    }

    /// Returns every transformer, link by link.
    pub fn transformers(&self) -> impl Iterator<Item = &Transformer> {
        self.flows().flat_map(|flow| &flow.transformers)
    }

    /// Returns whether a modulus varies with the coordinates.
    pub fn varies(&self) -> bool {
        self.transformers().any(|t| t.symbol() == "MTF")
    }

    /// Returns whether a port on a junction has this property.
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

    /// Returns the size of the graph in words.
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
            with_count(nv, "velocity", "velocities"),
            with_count(links, "link", "links"),
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

/// Returns `1 link`, `2 links`.
fn with_count(n: usize, one: &str, several: &str) -> String {
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
    /// Its ports: the drive first.
    pub ports: Vec<Port>,
}

/// A link and the junctions of its flows.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ChartLink {
    /// Its name.
    pub name: String,
    /// The velocities that begin here, as indices into [`Chart::velocities`]: those of the folded links
    /// before it, then its own joint's.
    pub velocities: Vec<usize>,
    /// Its flows that transformers feed and that have ports.
    pub flows: Vec<Flow>,
}

/// The 1-junction of a link's flow, and its transformers.
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
    /// Returns whether its transformers meet in a 0-junction. A single one feeds the 1-junction directly.
    pub fn sums(&self) -> bool {
        self.transformers.len() > 1
    }

    /// Returns whether it is a vector.
    pub fn is_vector(&self) -> bool {
        self.transformers.iter().any(Transformer::is_vector)
    }
}

/// A transformer from a generalized velocity to a link's flow.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Transformer {
    /// The index of the velocity in [`Chart::velocities`].
    pub velocity: usize,
    /// `∂r₂/∂q₁` or `ρ₁²`
    pub name: String,
    /// Its components x, y, z; a single one for the rate of a length.
    pub modulus: Vec<Component>,
    /// The coordinates that it varies with: `q₁…q₃`; empty for a constant one.
    pub varies: String,
}

impl Transformer {
    /// Returns `MTF` if the modulus varies with the coordinates, `TF` if it does not.
    pub fn symbol(&self) -> &'static str {
        match self.varies.is_empty() {
            true => "TF",
            false => "MTF",
        }
    }

    /// Returns whether it is a vector.
    pub fn is_vector(&self) -> bool {
        self.modulus.len() > 1
    }

    /// Returns `(0, 0.17, ·)`.
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
    /// The same at every q, in printed form.
    Constant(String),
    /// The same at every q, but known only at run time.
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

/// A node that is joined to a junction by one bond.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Port {
    /// `Se`, `Sf`, `I`, `R`, `C`, `GY`, `TF`, or a junction of its own: `1`, `0`.
    pub symbol: &'static str,
    /// `m₂ = 4.5 kg`
    pub text: String,
    /// Text that does not fit beside it.
    pub more: Option<String>,
    /// Whether positive power flows from it into the junction.
    pub feeds: bool,
    /// Whether the effort acts on the junction, if that is determined: then the causal stroke is at the
    /// junction, else at the other end.
    pub on_junction: Option<bool>,
    /// The nodes behind it.
    pub ports: Vec<Port>,
}

impl Port {
    /// Returns whether it is a junction.
    pub fn is_junction(&self) -> bool {
        matches!(self.symbol, "0" | "1")
    }

    /// Returns the number of lines that it needs.
    pub fn lines(&self) -> usize {
        lines(&self.ports)
    }
}

/// Returns the number of lines that these need, one below the other.
pub(super) fn lines(ports: &[Port]) -> usize {
    ports.iter().map(Port::lines).sum::<usize>().max(1)
}
