//! State and modes after events, and at the start.

use bgdyn_runtime::{MOST_EVENT_CONTACTS, Scalar as _, StateVector};

use super::equations::{ErrorOf, EventDriven, PlantModes, touching};
use super::error::EventError;
use super::impact::impact;
use super::impulses::note_losses;
use super::modes::{self, Closing, ContactMode, ContactModes, Jump, PerContact, speed, still};
use super::projection::held;
use super::settle::{Touch, settled};
use super::snapshot::{Snapshot, contacts_of};
use super::system::{Unknowns, solved};
use crate::plant::{Plant, Time};
use crate::real::Real;

/// Surfaces this near, m, touch at the start of a run: the decimals of a file.
const NEAR: f64 = 1e-9;

/// A flight no higher than this, in units of what touches, ends at an instant that is known beforehand: 1.5e-11 m in `f64`.
const LOW: f64 = 1024.0;

/// Rounding of a gap, in the same unit.
const MARGIN: f64 = 1.0 / 64.0;

/// Why modes may change.
pub(super) enum Cause<'a> {
    /// For these contacts the event 0, a gap or a normal force, or 1, friction or slip, fell.
    Events(&'a dyn Fn(usize, usize) -> bool),
    /// A run begins, or inputs or parameters have changed.
    Outside,
}

impl Cause<'_> {
    fn fell(&self, contact: usize, which: usize) -> bool {
        match self {
            Cause::Events(fell) => fell(contact, which),
            Cause::Outside => false,
        }
    }
}

/// The state and modes before a jump.
pub(super) struct Next<'a, P: Plant> {
    of: &'a EventDriven<P>,
    t: Time<P>,
    y: P::State,
    /// The modes of the plant after the jump.
    plant: P::Modes,
    /// The modes of the contacts before it.
    contacts: PerContact<ContactMode<Time<P>>>,
}

/// The state after impulses.
struct Pushed<P: Plant> {
    y: P::State,
    jump: Jump<Time<P>>,
    /// Whether there was an impact.
    hit: bool,
    /// The largest speed of a contact that ended its series of impacts.
    ended: Time<P>,
}

/// The directions in which contacts begin to slip.
type Began<P> = PerContact<Option<[Time<P>; 2]>>;

/// Where a jump ends: its state, modes and accelerations.
struct Landed<P: Plant> {
    y: P::State,
    touches: PerContact<Touch<Time<P>>>,
    modes: PerContact<ContactMode<Time<P>>>,
    /// γ_n and γ̇_n of each contact.
    normal: PerContact<[Time<P>; 2]>,
    gaps: PerContact<Time<P>>,
}

impl<'a, P: Plant> Next<'a, P>
where
    Time<P>: Real,
{
    pub(super) fn new(
        of: &'a EventDriven<P>,
        t: Time<P>,
        y: &P::State,
        modes: &PlantModes<P>,
    ) -> Self {
        Next {
            of,
            t,
            y: y.clone(),
            plant: modes.plant.clone(),
            contacts: modes.contacts,
        }
    }

    /// The same with other modes of the plant.
    pub(super) fn with_modes(self, plant: P::Modes) -> Self {
        Next { plant, ..self }
    }

    /// Returns state and modes after the jump: impulses where contacts approach, then the modes. If a contact would meet
    /// again after next to no time, it comes to rest instead, and the jump is repeated.
    pub(super) fn after(self, cause: &Cause<'_>) -> Result<(P::State, PlantModes<P>), ErrorOf<P>> {
        let snapshot = Snapshot::new(&self.of.plant, self.t, &self.y, &self.plant)?;
        let touch = self.touching(&snapshot, cause);
        let began = self.began(&snapshot, cause)?;
        let mut ends = [false; MOST_EVENT_CONTACTS];
        loop {
            let pushed = self.pushed(&snapshot, &touch, &ends);
            let jump = pushed.jump;
            let landed = self.landed(pushed, (&touch, &began), cause)?;
            let again = self.returns_at_once(&snapshot, &landed, &touch);
            let more = (0..MOST_EVENT_CONTACTS).any(|c| again[c] && !ends[c]);
            if more {
                for (end, again) in ends.iter_mut().zip(again) {
                    *end = *end || again;
                }
                continue;
            }
            let closing = core::array::from_fn(|c| self.closing(c, &landed, &touch));
            let modes = ContactModes {
                plant: self.plant,
                contacts: landed.modes,
                jump,
                closing,
            };
            let mut y = landed.y;
            let exactly = Time::<P>::from_f64(0.0);
            self.of.close(self.t, &mut y, &modes, exactly)?;
            return Ok((y, modes));
        }
    }

    /// Returns when an open contact closes. One that separates now does so after its overlap by rounding, or, if it flies no
    /// higher than that, after the time 2 γ_n/−γ̇_n; one that touches without a force may overlap by the rounding of steps.
    fn closing(&self, c: usize, landed: &Landed<P>, touch: &PerContact<bool>) -> Closing<Time<P>> {
        let [zero, two] = [0.0, 2.0].map(Time::<P>::from_f64);
        let [low, margin] = [LOW, MARGIN].map(Time::<P>::from_f64);
        let rounding = touching(&self.of.plant, &landed.y);
        let [speed, rate] = landed.normal[c];
        let low = rate < zero && speed * speed <= -two * rate * low * rounding;
        match landed.touches[c] {
            _ if landed.modes[c].is_closed() || !touch[c] => Closing::Overlap(zero),
            Touch::Apart if low => Closing::Instant(self.t - two * speed / rate),
            Touch::Apart => Closing::Overlap(zero.max(-landed.gaps[c]) + margin * rounding),
            _ => Closing::Overlap(rounding.max(-landed.gaps[c])),
        }
    }

    /// Returns which contacts touch.
    fn touching(&self, snapshot: &Snapshot<P::State>, cause: &Cause<'_>) -> PerContact<bool> {
        let mut near = touching(&self.of.plant, &self.y);
        if matches!(cause, Cause::Outside) {
            near = near.max(Time::<P>::from_f64(NEAR));
        }
        core::array::from_fn(|c| {
            let close = snapshot.contacts[c].gap <= near;
            c < snapshot.number && (self.contacts[c].is_closed() || close || cause.fell(c, 0))
        })
    }

    /// Returns the direction in which contacts that stuck until now begin to slip: against their friction.
    fn began(
        &self,
        snapshot: &Snapshot<P::State>,
        cause: &Cause<'_>,
    ) -> Result<Began<P>, ErrorOf<P>> {
        let stuck = |c: usize| self.contacts[c] == ContactMode::Stick && cause.fell(c, 1);
        let mut began = [None; MOST_EVENT_CONTACTS];
        if !(0..snapshot.number).any(stuck) {
            return Ok(began);
        }
        let modes = ContactModes {
            contacts: self.contacts,
            ..ContactModes::open(self.plant.clone())
        };
        let rates = self.of.plant.rates(self.t, &self.y, &self.plant);
        let rates = rates.map_err(EventError::Plant)?;
        let forces = self
            .of
            .forces_at(self.t, &self.y, &modes, (snapshot, &rates))?;
        for c in (0..snapshot.number).filter(|&c| stuck(c)) {
            let rubbed = speed(forces[c]);
            if rubbed > Time::<P>::from_f64(0.0) {
                began[c] = Some([-forces[c][0] / rubbed, -forces[c][1] / rubbed]);
            }
        }
        Ok(began)
    }

    /// Returns the state after the impulses of contacts that touch, if one of them approaches or ends a series of impacts.
    fn pushed(
        &self,
        snapshot: &Snapshot<P::State>,
        touch: &PerContact<bool>,
        ends: &PerContact<bool>,
    ) -> Pushed<P> {
        let still = resolved(snapshot);
        let hits =
            (0..snapshot.number).any(|c| touch[c] && snapshot.contacts[c].velocity[2] < -still);
        let mut y = self.y.clone();
        let mut jump = Jump::none();
        if hits {
            jump = impact(snapshot, self.of.law, touch, ends);
            snapshot.push(&mut y, &jump.impulses);
        }
        let mut ended = Time::<P>::from_f64(0.0);
        if ends.contains(&true) {
            for c in (0..snapshot.number).filter(|&c| ends[c]) {
                let velocity = snapshot.contacts[c].velocity;
                let after = snapshot.velocity(c, &jump.impulses, velocity);
                ended = ended.max(after[2].abs()).max(velocity[2].abs());
            }
            let rest = stopped(snapshot, &jump, touch, ends, still);
            snapshot.push(&mut y, &rest);
            for (sum, more) in jump
                .impulses
                .as_flattened_mut()
                .iter_mut()
                .zip(rest.as_flattened())
            {
                *sum = *sum + *more;
            }
            note_losses(snapshot, &mut jump);
        }
        Pushed {
            y,
            jump,
            hit: hits,
            ended,
        }
    }

    /// Returns the modes after impulses, with the positions of touching contacts put right.
    fn landed(
        &self,
        pushed: Pushed<P>,
        (touch, began): (&PerContact<bool>, &Began<P>),
        cause: &Cause<'_>,
    ) -> Result<Landed<P>, ErrorOf<P>> {
        let Pushed {
            mut y, hit, ended, ..
        } = pushed;
        self.of.lift(self.t, &mut y, &self.plant, touch)?;
        let mut snapshot = Snapshot::new(&self.of.plant, self.t, &y, &self.plant)?;
        let rates = self.of.plant.rates(self.t, &y, &self.plant);
        let rates = rates.map_err(EventError::Plant)?;
        let free = self
            .of
            .accelerations(self.t, &y, &self.plant, (&snapshot, &rates))?;
        let zero = Time::<P>::from_f64(0.0);
        let still = resolved(&snapshot).max(resolved_before(&self.y, &snapshot));
        // Beside a contact that comes to rest, speeds like its own are at rest.
        let slow = ended * Time::<P>::from_f64(16.0);
        let touches = core::array::from_fn(|c| {
            let velocity = snapshot.contacts[c].velocity;
            if !touch[c] || velocity[2] > still {
                return Touch::Apart;
            }
            self.touch(c, velocity, (hit, still.max(slow)), began[c], cause)
        });
        // What an event leaves of the velocities of contacts at rest would stay for ever.
        let resting = touches.map(|touch| match touch {
            Touch::Apart => ContactMode::Open,
            Touch::Rests => ContactMode::Stick,
            Touch::Opens => ContactMode::Slip([zero; 2]),
            Touch::Starts(d) | Touch::Slips(d) => ContactMode::Slip(d),
        });
        snapshot.push(&mut y, &held(&snapshot, &resting));
        snapshot.contacts = contacts_of(&self.of.plant, self.t, &y, &self.plant)?;
        let modes = settled(&snapshot, &free, &touches)?;
        let forces = snapshot
            .forces(&modes, &free)
            .map_err(|contact| EventError::Paradox { contact })?;
        let normal = core::array::from_fn(|c| {
            let after = snapshot.velocity(c, &forces, free[c]);
            [snapshot.contacts[c].velocity[2], after[2]]
        });
        Ok(Landed {
            y,
            touches,
            modes,
            normal,
            gaps: snapshot.contacts.map(|contact| contact.gap),
        })
    }

    /// Returns what is known of a contact that touches and does not separate.
    fn touch(
        &self,
        c: usize,
        velocity: [Time<P>; 3],
        (hit, slow): (bool, Time<P>),
        began: Option<[Time<P>; 2]>,
        cause: &Cause<'_>,
    ) -> Touch<Time<P>> {
        let slip = speed(velocity);
        let along = || Touch::Slips([velocity[0] / slip, velocity[1] / slip]);
        let before = self.contacts[c];
        if before.is_closed() && !hit && cause.fell(c, 0) {
            return Touch::Opens;
        }
        match before {
            _ if hit && slip > slow => along(),
            _ if hit => Touch::Rests,
            ContactMode::Stick => began.map_or(Touch::Rests, Touch::Starts),
            ContactMode::Start(direction) => match cause.fell(c, 1) {
                true if slip >= modes::slow() => along(),
                true => Touch::Rests,
                false => Touch::Starts(direction),
            },
            ContactMode::Slip(_) if self.stops(cause, slip) => Touch::Rests,
            ContactMode::Slip(direction) if slip <= still() => Touch::Slips(direction),
            ContactMode::Slip(_) => along(),
            ContactMode::Open if slip > slow => along(),
            ContactMode::Open => Touch::Rests,
        }
    }

    /// Returns whether a slip ends: its own event or that of another contact leaves no more than a tenth of the speed at which
    /// slip begins. The corners of a box that slides come to rest together.
    fn stops(&self, cause: &Cause<'_>, slip: Time<P>) -> bool {
        let slips = |c: usize| matches!(self.contacts[c], ContactMode::Slip(_));
        let ended = (0..MOST_EVENT_CONTACTS).any(|d| slips(d) && cause.fell(d, 1));
        let least = match cause {
            Cause::Events(_) if ended => modes::stopped(),
            Cause::Events(_) => return false,
            Cause::Outside => still(),
        };
        slip <= least
    }

    /// Returns the contacts that separate, but would meet again within next to no time: after 2 γ_n/−γ̇_n, and all over after
    /// 1/(1 − e) times that.
    fn returns_at_once(
        &self,
        snapshot: &Snapshot<P::State>,
        landed: &Landed<P>,
        touch: &PerContact<bool>,
    ) -> PerContact<bool> {
        let [zero, one, two] = [0.0, 1.0, 2.0].map(Time::<P>::from_f64);
        let soon = Time::<P>::EPSILON.sqrt() * Time::<P>::from_f64(1e-2);
        core::array::from_fn(|c| {
            let [speed, rate] = landed.normal[c];
            let apart = touch[c] && landed.touches[c] == Touch::Apart;
            let left = one - snapshot.contacts[c].restitution;
            apart && rate < zero && two * speed < -rate * left.max(Time::<P>::EPSILON) * soon
        })
    }
}

/// Returns the speed, m/s, that the velocities of contacts resolve: 4096 ε of the largest, and what is rounding anyway.
fn resolved<Y: StateVector>(snapshot: &Snapshot<Y>) -> Y::Scalar
where
    Y::Scalar: Real,
{
    let all = snapshot.contacts.iter().flat_map(|c| c.velocity);
    let most = all.fold(Y::Scalar::from_f64(0.0), |most, v| most.max(v.abs()));
    still::<Y::Scalar>() + most * Y::Scalar::EPSILON * Y::Scalar::from_f64(4096.0)
}

/// Returns the same for velocities before a jump, which had the rounding errors of larger numbers.
fn resolved_before<Y: StateVector>(before: &Y, snapshot: &Snapshot<Y>) -> Y::Scalar
where
    Y::Scalar: Real,
{
    let all = (0..snapshot.number).flat_map(|c| snapshot.along(c, before));
    let most = all.fold(Y::Scalar::from_f64(0.0), |most, v| most.max(v.abs()));
    most * Y::Scalar::EPSILON * Y::Scalar::from_f64(4096.0)
}

/// Returns the impulses along normals that stop the contacts which end their series, and hold those that neither separate.
fn stopped<Y: StateVector>(
    snapshot: &Snapshot<Y>,
    jump: &Jump<Y::Scalar>,
    touch: &PerContact<bool>,
    ends: &PerContact<bool>,
    still: Y::Scalar,
) -> PerContact<[Y::Scalar; 3]>
where
    Y::Scalar: Real,
{
    let mut unknowns = Unknowns::new();
    for c in (0..snapshot.number).filter(|&c| touch[c]) {
        let after = snapshot.velocity(c, &jump.impulses, snapshot.contacts[c].velocity);
        if ends[c] || after[2] <= still {
            unknowns.add_axis(c, 2, -after[2]);
        }
    }
    solved(&unknowns, &snapshot.delassus)
}
