//! The meaning and units of the names and signs in generated code: the rows of a module's legend.

/// The components in a quantity's names.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Components {
    /// None: `mass_forearm`.
    One,
    /// An axis: `h_x_forearm`.
    Vector,
    /// Two axes: `d_xy_forearm`.
    Matrix,
}

/// A quantity that formulations name.
pub struct LegendQuantity {
    /// Prefix of its names: `h`.
    pub prefix: &'static str,
    components: Components,
    /// Its meaning.
    pub meaning: &'static str,
    /// Its unit; `L` is the unit of length.
    pub unit: &'static str,
}

const fn quantity(
    prefix: &'static str,
    components: Components,
    meaning: &'static str,
    unit: &'static str,
) -> LegendQuantity {
    LegendQuantity {
        prefix,
        components,
        meaning,
        unit,
    }
}

/// In the order of the legend. A unit with an `L` is that of lengths in units of `L` metres.
pub static QUANTITIES: [LegendQuantity; 30] = {
    use Components::{Matrix, One, Vector};
    [
        quantity("omega", Vector, "angular velocity ω", "rad/s"),
        quantity("alpha", Vector, "angular acceleration ω̇", "rad/s²"),
        quantity(
            "u",
            Matrix,
            "U: the point s accelerates by a + U s",
            "rad²/s²",
        ),
        quantity(
            "a",
            Vector,
            "acceleration of the origin, less gravity",
            "L m/s²",
        ),
        quantity(
            "g",
            Vector,
            "gravity, in the axes before the joint turns",
            "L m/s²",
        ),
        quantity(
            "r",
            Vector,
            "origin, from the carrier's origin, in the axes before the joint turns",
            "L m",
        ),
        quantity("mass", One, "mass", "kg/L²"),
        quantity(
            "h",
            Vector,
            "first moment h = Σ m s about the origin",
            "kg·m/L",
        ),
        quantity(
            "d",
            Matrix,
            "D = Σ m s sᵀ = ½ tr(J)·1 − J about the origin",
            "kg·m²",
        ),
        quantity("j", Matrix, "inertia tensor J about the origin", "kg·m²"),
        quantity(
            "armature",
            One,
            "inertia of the rotors that the joint turns",
            "kg·m² or kg",
        ),
        quantity(
            "f",
            Vector,
            "force on the body and all that it carries",
            "N/L",
        ),
        quantity("n", Vector, "moment on them about the origin", "N·m"),
        quantity(
            "bias",
            One,
            "effort of the joint without accelerations",
            "N·m or N",
        ),
        quantity("gravity", One, "effort of the joint at rest", "N·m or N"),
        quantity("v", Vector, "velocity of the origin", "L m/s"),
        quantity("tau", One, "effort of the joint", "N·m or N"),
        quantity(
            "massc",
            One,
            "mass of the composite body: all that the joint moves",
            "kg/L²",
        ),
        quantity("hc", Vector, "first moment of the composite body", "kg·m/L"),
        quantity("dc", Matrix, "D of the composite body", "kg·m²"),
        quantity(
            "p",
            Vector,
            "linear momentum of all that a unit rate of the first joint moves",
            "kg·m/L",
        ),
        quantity(
            "l",
            Vector,
            "its angular momentum about the origin at the second joint",
            "kg·m²",
        ),
        quantity(
            "m",
            One,
            "entry of the mass matrix M, by its two joints",
            "kg·m², kg·m, kg",
        ),
        quantity(
            "ia",
            Matrix,
            "angular part of the articulated inertia: moment of an angular acceleration",
            "kg·m²",
        ),
        quantity(
            "ha",
            Matrix,
            "coupling part of it: moment of an acceleration of the origin",
            "kg·m/L",
        ),
        quantity(
            "ma",
            Matrix,
            "linear part of it: force of an acceleration of the origin",
            "kg/L²",
        ),
        quantity(
            "pivot",
            One,
            "inertia that the joint moves while the joints beyond are free, checked",
            "kg·m² or kg/L²",
        ),
        quantity(
            "fa",
            Vector,
            "force of the articulated body that the joint passes on",
            "N/L",
        ),
        quantity("na", Vector, "moment on them about the origin", "N·m"),
        quantity(
            "u",
            One,
            "effort of the joint less what the motion of the bodies beyond takes",
            "N·m or N/L",
        ),
    ]
};

impl LegendQuantity {
    /// Returns the quantity of a name, and the name of its owner.
    pub fn of_name(name: &str) -> Option<(&'static LegendQuantity, &str)> {
        let (prefix, rest) = name.split_once('_')?;
        let mut found = QUANTITIES.iter().filter(|q| q.prefix == prefix);
        found.find_map(|q| Some((q, q.owner(rest)?)))
    }

    /// Returns the part of a name after the components.
    fn owner<'n>(&self, rest: &'n str) -> Option<&'n str> {
        let axes = match self.components {
            Components::One => return Some(rest),
            Components::Vector => 1,
            Components::Matrix => 2,
        };
        let (components, owner) = rest.split_once('_')?;
        let is_axis = |c| matches!(c, 'x' | 'y' | 'z');
        (components.len() == axes && components.chars().all(is_axis)).then_some(owner)
    }

    /// Returns the pattern of its names: `h_x_…`.
    pub fn pattern(&self) -> String {
        let components = match self.components {
            Components::One => "",
            Components::Vector => "x_",
            Components::Matrix => "xy_",
        };
        format!("{}_{components}…", self.prefix)
    }

    /// Returns its unit if lengths are in units of `length` metres.
    pub fn unit_in(&self, length: f64) -> String {
        if length == 1.0 {
            let plain = self.unit.replace("/L²", "").replace("/L", "");
            return plain.replace("L ", "");
        }
        self.unit.replace('L', &format!("{length}"))
    }

    /// Returns whether its unit depends on that of length.
    pub fn scales(&self) -> bool {
        self.unit.contains('L')
    }
}

/// Signs in the titles of sections: the text in a title, and its meaning.
pub static SIGNS: [(&str, &str); 5] = [
    (
        "U = [",
        "`U = [ω̇]× + [ω]×[ω]×`: the point s of a body accelerates by a + U s.",
    ),
    (
        "U h",
        "h = Σ m s, the first moment of a body about its origin.",
    ),
    (
        "U D",
        "D = Σ m s sᵀ = ½ tr(J)·1 − J. skew(U D) is the vector of the skew part of U D: J ω̇ + ω × J ω.",
    ),
    (
        "all it carries",
        "A body with all it carries is its composite body; its momenta are those of unit rates of joints.",
    ),
    (
        "Lᵀ D L",
        "M = Lᵀ D L: L has ones on its diagonal, D is diagonal and holds the pivots.",
    ),
];

/// Conventions for all names.
pub static AXES: [&str; 4] = [
    "The axes of a body: z along its joint's axis, or against it so that parallel joints share z; x along",
    "the common normal with the next joint's axis. Names end with the body or the joint that they belong to.",
    "Components of a body's vectors are in its axes, those `at` a joint in the axes before that joint turns.",
    "Inertia is regrouped: part of what a body has may count with its carrier (base parameters). `neg_` is the opposite.",
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_told_apart_by_their_components() {
        let found = |name| LegendQuantity::of_name(name).map(|(q, owner)| (q.prefix, owner));
        assert_eq!(found("h_x_forearm"), Some(("h", "forearm")));
        assert_eq!(found("hc_y_at_elbow"), Some(("hc", "at_elbow")));
        assert_eq!(found("d_xy_forearm"), Some(("d", "forearm")));
        assert_eq!(found("m_elbow_turn"), Some(("m", "elbow_turn")));
        assert_eq!(found("u_xy_forearm"), Some(("u", "forearm")));
        assert_eq!(found("u_elbow"), Some(("u", "elbow")));
        assert_eq!(found("a_elbow"), None);
        assert_eq!(found("x1"), None);
    }

    #[test]
    fn units_follow_the_unit_of_length() {
        let unit = |prefix, length| {
            let found = QUANTITIES.iter().find(|q| q.prefix == prefix);
            found.map(|q| q.unit_in(length)).unwrap_or_default()
        };
        assert_eq!(unit("a", 1.0), "m/s²");
        assert_eq!(unit("a", 0.325), "0.325 m/s²");
        assert_eq!(unit("h", 0.325), "kg·m/0.325");
        assert_eq!(unit("f", 1.0), "N");
        assert_eq!(unit("mass", 2.0), "kg/2²");
        assert_eq!(unit("pivot", 1.0), "kg·m² or kg");
    }
}
