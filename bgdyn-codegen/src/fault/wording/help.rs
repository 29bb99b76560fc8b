//! What a fault of an effect's value adds: why the value is wrong, or a way out.

/// The reason why a value of an effect is wrong, or the way out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Help {
    /// A gear that lets nothing through is a lock.
    EfficiencyOfLock,
    /// An efficiency above 1 makes power of nothing.
    EfficiencyAboveOne,
    /// A negative damping would drive the joint.
    DampingDrivesJoint,
    /// A negative damping would drive the motion.
    DampingDrivesMotion,
    /// A negative stiffness pushes away from rest.
    StiffnessPushes,
    /// No winding has it.
    ResistanceOfWinding,
    /// Leave it out for the motor without inductance, whose current follows from the voltage at once.
    InductanceIsOptional,
    /// Leave it out where nothing limits the motor.
    LimitsAreOptional,
    /// Without it the law has no rest: leave the effect out.
    BristlesNeedRest,
    /// It would drive the joint.
    BristlesDriveJoint,
    /// A negative drag would drive the link.
    DragDrivesLink,
    /// No body has it.
    NoBodyHasIt,
    /// Rest holds at least what slipping resists.
    RestHoldsMore,
    /// Friction opposes the motion.
    FrictionOpposes,
    /// Friction without the curve is `type: coulomb_smooth`.
    CurveIsOptional,
    /// Friction that jumps with the direction is `type: coulomb`, which sticks and slips.
    WidthOfJump,
    /// A scene without stops leaves the effect out.
    StopsAreOptional,
    /// No damping takes all the speed from an impact: write a small one, 0.01.
    RestitutionIsPositive,
    /// An impact would give back more than it took.
    RestitutionAboveOne,
    /// A scene without this contact leaves the effect out.
    ContactIsOptional,
    /// Contact without friction has none of these keys.
    ContactWithoutFriction,
    /// An impact has a speed.
    SpeedOfImpact,
    /// The joint moves between its stops.
    JointIsBetweenStops,
    /// Without a spring nothing connects the drive with its joint.
    SpringIsNeeded,
    /// Without a rotor there is nothing on the drive's side: use `type: spring`.
    RotorIsNeeded,
    /// Oil has about 1.4 GPa, less with air in it.
    ModulusOfOil,
    /// What lets nothing through is left out.
    ClosedIsOptional,
    /// Leave it out for turbulent flow alone.
    LaminarIsOptional,
    /// Write its pressure, against the surroundings; less than a vacuum there is none.
    PressureAboveVacuum,
    /// A side that does not act is left out.
    SideIsOptional,
    /// Leave it out where `dead_b` is the volume at `offset`.
    StrokeIsOptional,
    /// There is no such volume.
    VolumeIsPositive,
    /// See to `offset`, `stroke` and the dead volumes, or to the joint's limits.
    CylinderIsLongEnough,
    /// What has no volume is a junction: `{ type: junction }`.
    LineIsJunction,
}

impl Help {
    /// Returns its text.
    pub(crate) fn text(self) -> &'static str {
        match self {
            Help::EfficiencyOfLock => "a gear that lets nothing through is a lock",
            Help::EfficiencyAboveOne => "an efficiency above 1 makes power of nothing",
            Help::DampingDrivesJoint => "a negative damping would drive the joint",
            Help::DampingDrivesMotion => "a negative damping would drive the motion",
            Help::StiffnessPushes => "a negative stiffness pushes away from rest",
            Help::ResistanceOfWinding => "no winding has it",
            Help::InductanceIsOptional => {
                "leave it out for the motor without inductance, whose current follows from the voltage at once"
            }
            Help::LimitsAreOptional => "leave it out where nothing limits the motor",
            Help::BristlesNeedRest => "without it the law has no rest: leave the effect out",
            Help::BristlesDriveJoint => "it would drive the joint",
            Help::DragDrivesLink => "a negative drag would drive the link",
            Help::NoBodyHasIt => "no body has it",
            Help::RestHoldsMore => "rest holds at least what slipping resists",
            Help::FrictionOpposes => "friction opposes the motion",
            Help::CurveIsOptional => "friction without the curve is `type: coulomb_smooth`",
            Help::WidthOfJump => {
                "friction that jumps with the direction is `type: coulomb`, which sticks and slips"
            }
            Help::StopsAreOptional => "a scene without stops leaves the effect out",
            Help::RestitutionIsPositive => {
                "no damping takes all the speed from an impact: write a small one, 0.01"
            }
            Help::RestitutionAboveOne => "an impact would give back more than it took",
            Help::ContactIsOptional => "a scene without this contact leaves the effect out",
            Help::ContactWithoutFriction => {
                "a contact without friction has none of `kinetic`, `width` and `bristles`"
            }
            Help::SpeedOfImpact => "write the speed at which the restitution was measured",
            Help::JointIsBetweenStops => "the joint moves between its stops",
            Help::SpringIsNeeded => "without a spring nothing connects the drive with its joint",
            Help::RotorIsNeeded => {
                "without a rotor there is nothing on the drive's side: use `type: spring`"
            }
            Help::ModulusOfOil => "oil has about 1.4 GPa, less with air in it",
            Help::ClosedIsOptional => "what lets nothing through is left out",
            Help::LaminarIsOptional => "leave it out for turbulent flow alone",
            Help::PressureAboveVacuum => {
                "write its pressure, against the surroundings; less than a vacuum there is none"
            }
            Help::SideIsOptional => "a side that does not act is left out",
            Help::StrokeIsOptional => "leave it out where `dead_b` is the volume at `offset`",
            Help::VolumeIsPositive => "there is no such volume",
            Help::CylinderIsLongEnough => {
                "see to `offset`, `stroke` and the dead volumes, or to the joint's limits"
            }
            Help::LineIsJunction => "what has no volume is a junction: `{ type: junction }`",
        }
    }
}
