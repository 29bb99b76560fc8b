//! Parses a spec from the tree of a file: one function for each mapping of the format.

use super::walk::{At, Mapping, Reader};
use super::yaml::{self, Data};
use super::{
    Field, FrameSpec, InertiaSpec, JointSpec, LENGTHS, LIMIT_PARTS, LimitsSpec, LinkSpec, Located,
    MimicSpec, Number, Origin, Spec, Vector,
};
use crate::fault::Faults;
use crate::fault::wording::{self, expected};
use crate::unit::Dimension;
use bgdyn_runtime::Dd;

/// Parses a spec. Unreadable parts are reported and omitted; the rest is returned.
pub fn parse(text: &str) -> (Option<Spec>, Faults) {
    let mut reader = Reader::default();
    let tree = yaml::read(text, &mut reader.faults);
    let spec = tree.and_then(|tree| reader.spec(&At::root(&tree)));
    let complete = !reader.faults.any_fault();
    reader.faults.sort();
    (spec.map(|spec| Spec { complete, ..spec }), reader.faults)
}

impl Reader {
    fn spec(&mut self, at: &At<'_>) -> Option<Spec> {
        let keys = [
            "format",
            "name",
            "label",
            "description",
            "gravity",
            "base",
            "snap",
            "links",
            "frames",
            "constraints",
            "planes",
            "contacts",
            "loops",
            "independent",
            "actuated",
            "effects",
        ];
        let map = self.mapping(at, expected::SPEC, &keys)?;
        Some(Spec {
            format: self.needed(&map, "format", expected::FORMAT_KEY, |r, at| {
                r.number(at, &[Dimension::One])
            }),
            name: self.text_field(&map, "name"),
            label: self.text_field(&map, "label"),
            description: self.text_field(&map, "description"),
            gravity: self.vector_field(&map, "gravity", &[Dimension::Acceleration]),
            base: self.text_field(&map, "base"),
            snap: self.number_field(&map, "snap", &[Dimension::Angle]),
            links: self.needed(&map, "links", expected::LINKS_KEY, |r, at| {
                Some(
                    r.list(at, expected::LINKS)?
                        .iter()
                        .filter_map(|at| r.link(at))
                        .collect(),
                )
            }),
            frames: self.field(&map, "frames", |r, at| {
                Some(
                    r.list(at, expected::FRAMES)?
                        .iter()
                        .filter_map(|at| r.frame(at))
                        .collect(),
                )
            }),
            constraints: self.field(&map, "constraints", |r, at| {
                r.table(at, expected::CONSTRAINTS)
            }),
            planes: self.field(&map, "planes", |r, at| {
                let what = expected::PLANES;
                r.table(at, what)
            }),
            contacts: self.field(&map, "contacts", |r, at| r.table(at, expected::CONTACTS)),
            loops: self.field(&map, "loops", |r, at| {
                let what = expected::LOOPS;
                let all = r.list(at, what)?;
                Some(all.iter().filter_map(|at| r.closing(at)).collect())
            }),
            independent: self.field(&map, "independent", |r, at| {
                r.names_list(at, expected::LISTED_JOINTS)
            }),
            actuated: self.field(&map, "actuated", |r, at| {
                r.names_list(at, expected::LISTED_JOINTS)
            }),
            effects: self.field(&map, "effects", |r, at| r.table(at, expected::EFFECTS)),
            location: map.location,
            complete: false,
        })
    }

    fn link(&mut self, at: &At<'_>) -> Option<LinkSpec> {
        let keys = [
            "name",
            "label",
            "parent",
            "joint",
            "mass",
            "com",
            "inertia",
            "nonphysical",
        ];
        let map = self.mapping(at, expected::LINK, &keys)?;
        Some(LinkSpec {
            name: self.needed(&map, "name", expected::LINK_NAME_KEY, Self::text),
            label: self.text_field(&map, "label"),
            parent: self.text_field(&map, "parent"),
            joint: self.field(&map, "joint", Self::joint),
            mass: self.field(&map, "mass", |r, at| r.value(at, &[Dimension::Mass])),
            com: self.field(&map, "com", |r, at| {
                r.triple(at, |r, at| r.value(at, &[Dimension::Length]))
            }),
            inertia: self.field(&map, "inertia", Self::inertia),
            nonphysical: self.text_field(&map, "nonphysical"),
            location: map.location,
        })
    }

    fn joint(&mut self, at: &At<'_>) -> Option<JointSpec> {
        let keys = [
            "name",
            "label",
            "type",
            "axis",
            "axis2",
            "lead",
            "origin",
            "limits",
            "mimic",
            "quaternion",
        ];
        let map = self.mapping(at, expected::JOINT, &keys)?;
        Some(JointSpec {
            name: self.text_field(&map, "name"),
            label: self.text_field(&map, "label"),
            kind: self.needed(&map, "type", expected::JOINT_TYPE_KEY, Self::text),
            axis: self.field(&map, "axis", Self::axis),
            axis2: self.field(&map, "axis2", Self::axis),
            lead: self.number_field(&map, "lead", &[Dimension::Length, Dimension::Lead]),
            mimic: self.field(&map, "mimic", Self::mimic),
            quaternion: self.text_field(&map, "quaternion"),
            origin: self.field(&map, "origin", Self::origin),
            limits: self.field(&map, "limits", Self::limits),
            location: map.location,
        })
    }

    fn mimic(&mut self, at: &At<'_>) -> Option<MimicSpec> {
        let what = expected::MIMIC;
        let map = self.mapping(at, what, &["joint", "ratio", "offset"])?;
        let ratios = [Dimension::One, Dimension::Lead, Dimension::AnglePerLength];
        let offsets = [Dimension::Angle, Dimension::Length];
        Some(MimicSpec {
            joint: self.needed(&map, "joint", expected::MIMIC_JOINT_KEY, Self::text),
            ratio: self.number_field(&map, "ratio", &ratios),
            offset: self.number_field(&map, "offset", &offsets),
        })
    }

    pub(super) fn axis(&mut self, at: &At<'_>) -> Option<Vector> {
        let Data::Scalar { text, .. } = &at.tree.data else {
            return self.vector(at, &[Dimension::One]);
        };
        let (sign, letter) = match text.strip_prefix('-') {
            Some(letter) => (-1.0, letter),
            None => (1.0, text.as_str()),
        };
        let Some(location) = ["x", "y", "z"].iter().position(|l| *l == letter) else {
            self.faults.push(wording::unknown_axis(&at.location, text));
            return None;
        };
        Some(std::array::from_fn(|i| {
            let value = Dd::from_f64(if i == location { sign } else { 0.0 });
            let value = Number {
                value,
                unit: None,
                text: text.clone(),
                parameter: None,
            };
            Located {
                value,
                location: at.location.clone(),
            }
        }))
    }

    pub(super) fn origin(&mut self, at: &At<'_>) -> Option<Origin> {
        let map = self.mapping(at, expected::ORIGIN, &["xyz", "rpy"])?;
        Some(Origin {
            xyz: self.vector_field(&map, "xyz", &[Dimension::Length]),
            rpy: self.vector_field(&map, "rpy", &[Dimension::Angle]),
        })
    }

    fn limits(&mut self, at: &At<'_>) -> Option<LimitsSpec> {
        self.limits_with(at, &LIMIT_PARTS)
    }

    /// Parses limits that may have these parts, which have none themselves.
    fn limits_with(&mut self, at: &At<'_>, parts: &[&'static str]) -> Option<LimitsSpec> {
        let keys = [&["lower", "upper", "velocity", "effort"][..], parts].concat();
        let what = expected::LIMITS;
        let map = self.mapping(at, what, &keys)?;
        let position = [Dimension::Angle, Dimension::Length];
        Some(LimitsSpec {
            lower: self.number_field(&map, "lower", &position),
            upper: self.number_field(&map, "upper", &position),
            velocity: self.number_field(
                &map,
                "velocity",
                &[Dimension::AngularSpeed, Dimension::Speed],
            ),
            effort: self.number_field(&map, "effort", &[Dimension::Torque, Dimension::Force]),
            parts: parts
                .iter()
                .map(|key| self.field(&map, key, |r, at| r.limits_with(at, &[])))
                .collect(),
        })
    }

    fn inertia(&mut self, at: &At<'_>) -> Option<InertiaSpec> {
        let entries = ["xx", "yy", "zz", "xy", "xz", "yz"];
        let others = ["products", "about", "rpy", "solid", "size", "axis"];
        let keys: Vec<&'static str> = [&entries[..], &others, &LENGTHS].concat();
        let what = expected::INERTIA;
        let map = self.mapping(at, what, &keys)?;
        Some(InertiaSpec {
            entries: entries
                .map(|key| self.field(&map, key, |r, at| r.value(at, &[Dimension::Inertia]))),
            products: self.field(&map, "products", Self::products),
            about: self.text_field(&map, "about"),
            rpy: self.vector_field(&map, "rpy", &[Dimension::Angle]),
            solid: self.text_field(&map, "solid"),
            size: self.vector_field(&map, "size", &[Dimension::Length]),
            lengths: LENGTHS.map(|key| self.number_field(&map, key, &[Dimension::Length])),
            axis: self.field(&map, "axis", Self::axis),
        })
    }

    fn products(&mut self, at: &At<'_>) -> Option<[Field<Number>; 3]> {
        let keys = ["xy", "xz", "yz"];
        let what = expected::PRODUCTS;
        let map = self.mapping(at, what, &keys)?;
        Some(keys.map(|key| self.number_field(&map, key, &[Dimension::Inertia])))
    }

    fn frame(&mut self, at: &At<'_>) -> Option<FrameSpec> {
        let keys = ["name", "link", "origin", "label"];
        let map = self.mapping(at, expected::FRAME, &keys)?;
        Some(FrameSpec {
            name: self.needed(&map, "name", expected::FRAME_NAME_KEY, Self::text),
            label: self.text_field(&map, "label"),
            link: self.needed(&map, "link", expected::FRAME_LINK_KEY, Self::text),
            origin: self.field(&map, "origin", Self::origin),
            location: map.location,
        })
    }

    pub(super) fn text_field(&mut self, map: &Mapping<'_>, key: &str) -> Field<String> {
        self.field(map, key, Self::text)
    }

    pub(super) fn number_field(
        &mut self,
        map: &Mapping<'_>,
        key: &str,
        fit: &[Dimension],
    ) -> Field<Number> {
        self.field(map, key, |r, at| r.number(at, fit))
    }

    fn vector_field(&mut self, map: &Mapping<'_>, key: &str, fit: &[Dimension]) -> Field<Vector> {
        self.field(map, key, |r, at| r.vector(at, fit))
    }
}
