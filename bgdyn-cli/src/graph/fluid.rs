//! Drawing of the hydraulic circuit of a joint, followed from the sides of its cylinders.
//!
//! A side of a cylinder is a transformer between the joint's velocity and the flow into the side. The
//! pressure of a volume is a 0-junction with the fluid's compliance. What lets fluid run between two
//! pressures is a resistor on a 1-junction; resistors in series, with no volume between them, share
//! one. A source of pressure is drawn wherever it is met. A pressure that is met again, where
//! the hoses close a circle, is named and not drawn again.

use std::collections::HashSet;

use bgdyn_codegen::declaration::Element;

use super::chart::Port;
use super::notation::value;

/// The hydraulics of a scene, and how much of it is drawn by now.
pub(super) struct Fluid<'a> {
    elements: &'a [Element],
    pipes: Vec<Pipe<'a>>,
    /// Names of elements and nodes.
    drawn: HashSet<String>,
}

/// A way by which fluid runs.
struct Pipe<'a> {
    element: &'a Element,
    from: &'a str,
    to: &'a str,
    /// What its resistor is called.
    text: String,
    drawn: bool,
}

impl<'a> Fluid<'a> {
    pub(super) fn new(elements: &'a [Element]) -> Self {
        Fluid {
            elements,
            pipes: elements.iter().flat_map(pipes).collect(),
            drawn: HashSet::new(),
        }
    }

    /// Whether an element has been met.
    pub(super) fn has_drawn(&self, element: &Element) -> bool {
        self.drawn.contains(&element.name)
    }

    /// The transformers of the cylinders at a joint, and all that is behind them.
    pub(super) fn at(&mut self, joint: &str) -> Vec<Port> {
        let all = self.elements.iter().filter(|e| !e.nodes().is_empty());
        let own: Vec<&Element> = all.filter(|e| e.name("joint") == Some(joint)).collect();
        own.into_iter().flat_map(|e| self.sides(e)).collect()
    }

    /// f = p_a A_a − p_b A_b
    pub(super) fn sides(&mut self, cylinder: &Element) -> Vec<Port> {
        let areas = [("", "area_a"), ("−", "area_b")];
        let sides = cylinder.nodes().into_iter().zip(areas);
        sides
            .map(|(node, (sign, key))| {
                let area = value(cylinder, key).unwrap_or_default();
                Port {
                    symbol: "TF",
                    ports: vec![self.pressure(&node, true)],
                    ..Port::source(format!("{}, A = {sign}{area}", cylinder.name))
                }
            })
            .collect()
    }

    /// A node's pressure, on a bond whose power flows from the node where it `feeds`.
    fn pressure(&mut self, node: &str, feeds: bool) -> Port {
        let owner = self.owner(node);
        let Some(owner) = owner else {
            return Port::junction("0", node.into(), feeds);
        };
        let known = !self.drawn.insert(node.to_owned());
        self.drawn.insert(owner.name.clone());
        if owner.effect.symbol() == "Se" {
            let text = match value(owner, "pressure") {
                Some(pressure) => format!("{node}, p = {pressure}"),
                None => format!("{node}, p = 0"),
            };
            return Port {
                feeds,
                ..Port::source(text)
            };
        }
        if known {
            return Port::junction("0", format!("{node}, see above"), feeds);
        }
        let mut ports = vec![self.compliance(owner, node)];
        while let Some(next) = self.pipes.iter().position(|p| p.leaves(node)) {
            ports.push(self.run(next, node));
        }
        Port {
            ports,
            ..Port::junction("0", node.into(), feeds)
        }
    }

    /// Fluid that runs from or to a node, by one resistor or by several in series.
    fn run(&mut self, first: usize, node: &str) -> Port {
        let outwards = self.pipes[first].from == node;
        let (mut resistors, mut at, mut next) = (Vec::new(), node.to_owned(), Some(first));
        while let Some(number) = next {
            let pipe = &mut self.pipes[number];
            pipe.drawn = true;
            at = pipe.other(&at).to_owned();
            self.drawn.insert(pipe.element.name.clone());
            // The first one gives the flow, the others answer it.
            resistors.push(Port {
                on_junction: Some(!resistors.is_empty()),
                ..Port::taking("R", pipe.text.clone())
            });
            let open = self.owner(&at).filter(|e| e.effect.symbol() == "0");
            next = open.and_then(|junction| {
                self.drawn.insert(junction.name.clone());
                self.pipes.iter().position(|p| p.leaves(&at))
            });
        }
        resistors.push(self.pressure(&at, !outwards));
        Port {
            on_junction: Some(false),
            ports: resistors,
            ..Port::junction("1", "q".into(), !outwards)
        }
    }

    /// The element that has a node.
    fn owner(&self, node: &str) -> Option<&'a Element> {
        let has = |e: &&Element| e.nodes().iter().any(|name| name == node);
        self.elements.iter().find(has)
    }

    /// The fluid in a volume.
    fn compliance(&mut self, owner: &Element, node: &str) -> Port {
        let mut fluids = self.elements.iter();
        let own = owner.name("fluid");
        let fluid = fluids.find(|e| match own {
            Some(name) => e.name == name,
            None => e.effect.keyword() == "fluid",
        });
        let fluid = fluid.map_or("fluid", |e| e.name.as_str());
        self.drawn.insert(fluid.to_owned());
        let side = node.strip_prefix(&owner.name).unwrap_or_default();
        let volume = match side {
            "" => value(owner, "volume").map(|v| format!("V = {v}")),
            side => value(owner, &format!("dead{side}")).map(|v| format!("V₀ = {v}")),
        };
        let volume = volume.map_or(String::new(), |v| format!(", {v}"));
        Port::taking("C", format!("{fluid} in {node}{volume}"))
    }
}

impl Pipe<'_> {
    /// Whether it is still to be drawn and ends at a node.
    fn leaves(&self, node: &str) -> bool {
        !self.drawn && (self.from == node || self.to == node)
    }

    fn other(&self, node: &str) -> &str {
        if self.from == node {
            self.to
        } else {
            self.from
        }
    }
}

/// The ways of an element: one of a resistor, four of a four-way valve.
fn pipes(element: &Element) -> Vec<Pipe<'_>> {
    let pipe = |from, to, text| Pipe {
        element,
        from,
        to,
        text,
        drawn: false,
    };
    let keys = ["supply", "tank", "a", "b"].map(|key| element.name(key));
    let (joins, name) = (element.joins(), &element.name);
    match (keys, joins.as_slice()) {
        ([Some(supply), Some(tank), Some(a), Some(b)], _) => {
            let open = |sign| format!("{name}, open where x {sign} 0");
            vec![
                pipe(supply, a, open('>')),
                pipe(a, tank, open('<')),
                pipe(supply, b, open('<')),
                pipe(b, tank, open('>')),
            ]
        }
        (_, [from, to]) => {
            let text = format!("{name} ({})", element.effect.keyword());
            vec![pipe(from, to, text)]
        }
        _ => Vec::new(),
    }
}
