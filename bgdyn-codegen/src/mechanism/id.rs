//! Indices of links, coordinates, positions and parameters.

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub usize);
    };
}
id!(/// A link of `Mechanism::links`.
    LinkId);
id!(/// A generalized coordinate: its place in v. Its rate is a velocity of a joint.
    CoordinateId);
id!(/// A position of a joint: its place in q.
    PositionId);
id!(/// A run-time parameter of `Mechanism::parameters`.
    ParameterId);
