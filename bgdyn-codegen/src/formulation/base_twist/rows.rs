//! Rows of contacts in the velocities of the base.

use bgdyn_runtime::Dd;

use crate::bond_graph::{ClosedTree, FreeBase, snap, tidy};
use crate::expr::{Builder, Expr};
use crate::formulation::loop_rows::{LoopForm, LoopRows, loop_bias, loop_rows};
use crate::math::Vec3;
use crate::mechanism::closure::{
    Closure, ClosureBlock, ContactAxes, ContactRow, ContactShape, DISC_ROWS, KinematicLoop,
    LoopChain, LoopRow, RowKind, TwistPoint,
};
use crate::mechanism::{CoordinateId, Motion, Pose};

/// The largest number of ways to write rows that are compared.
const MOST_WAYS: usize = 9;

/// The contacts, and the relation of the base's angular velocity to the rates of the joints that its free joint replaces,
/// ω = Σ a_j θ̇_j. The rates θ̇_j are further velocities, after those of the tree.
pub(super) struct BaseRows {
    /// The contacts alone.
    contacts: Closure,
    /// With the relation as rows after those of contacts.
    pub all: Closure,
    /// The joints from the base to the world, with their own velocities.
    replaced: LoopChain,
    turns: Vec<CoordinateId>,
    angular: [CoordinateId; 3],
}

impl BaseRows {
    /// Returns the rows; `None` if a contact is none of a link that the base carries with a plane at rest, or an
    /// independent velocity is that of a translation that the free joint replaces.
    pub fn new(closed: &ClosedTree, tree: &FreeBase, axes: &[Option<ContactAxes>]) -> Option<Self> {
        let own = &closed.closure;
        let graph = &closed.tree.multibody;
        let nt = tree.graph.coordinates.len();
        let mut contacts = own.clone();
        contacts.along_planes = None;
        contacts.of_plane = false;
        contacts.combined = Vec::new();
        contacts.constants = Vec::new();
        contacts.positions = vec![None; nt + tree.turns.len()];
        let moved = |one: &KinematicLoop| contact(closed, tree, one);
        contacts.loops = own.loops.iter().map(moved).collect::<Option<_>>()?;
        for (one, &axes) in contacts.loops.iter_mut().zip(axes) {
            one.contact.as_mut()?.solved = axes;
        }
        let replaced = |j: &CoordinateId| {
            let merged = !tree.turns.is_empty();
            merged && (tree.linear.contains(j) || tree.angular.contains(j))
        };
        let independent = |j: &CoordinateId| match tree.turns.iter().position(|turn| turn == j) {
            Some(k) => Some(CoordinateId(nt + k)),
            None if replaced(j) => None,
            None => Some(*j),
        };
        contacts.independents = own
            .independents
            .iter()
            .map(independent)
            .collect::<Option<_>>()?;
        let mut all = contacts.clone();
        let turning = LoopRow {
            name: "turning",
            ..*all.rows.first()?
        };
        if !tree.turns.is_empty() {
            all.rows.extend([turning; 3]);
        }
        let dependents = (0..all.positions.len()).map(CoordinateId);
        let dependents = dependents.filter(|j| !all.independents.contains(j));
        all.blocks = vec![ClosureBlock {
            rows: (0..all.rows.len()).collect(),
            dependents: dependents.collect(),
        }];
        if all.blocks[0].dependents.len() != all.rows.len() {
            return None;
        }
        Some(BaseRows {
            contacts,
            all,
            replaced: tree.to_world(graph, false),
            turns: tree.turns.clone(),
            angular: tree.angular,
        })
    }

    /// Returns the rates per unit of each velocity.
    pub fn rates<'g>(&self, b: &'g Builder, q: &[Expr<'g>], form: LoopForm) -> LoopRows<'g> {
        let mut rows = loop_rows(b, &self.contacts, q, form);
        let frames = self.replaced.frames(q, &b);
        let place = self.replaced.place(&frames, TwistPoint::B, &b);
        let nt = self.all.positions.len() - self.turns.len();
        // The twist of the world relative to the base is −Σ a θ̇.
        let about = match self.turns.is_empty() {
            true => &[],
            false => &self.angular[..],
        };
        for (k, about) in about.iter().enumerate() {
            let mut row = vec![b.zero(); self.all.positions.len()];
            row[about.0] = b.constant(Dd::ONE);
            for (j, column) in &place.columns {
                if let Some(turn) = self.turns.iter().position(|turn| turn == j) {
                    row[nt + turn] = column.angular.0[k];
                }
            }
            rows.rates.push(row);
        }
        rows
    }

    /// Returns −γ, row by row.
    pub fn bias<'g>(
        &self,
        b: &'g Builder,
        (q, v): (&[Expr<'g>], &[Expr<'g>]),
        form: LoopForm,
    ) -> Vec<Expr<'g>> {
        let mut all = loop_bias(b, &self.contacts, (q, v), form);
        if self.turns.is_empty() {
            return all;
        }
        let nt = self.all.positions.len() - self.turns.len();
        let mut rates = vec![b.zero(); nt];
        for (k, turn) in self.turns.iter().enumerate() {
            rates[turn.0] = v[nt + k];
        }
        let frames = self.replaced.frames(q, &b);
        let of_world = self.replaced.rates(&frames, &rates, &b);
        all.extend(of_world.bias.angular.0);
        all
    }

    /// Returns a vector of the world's axes in the axes of the base.
    pub fn of_base<'g>(&self, b: &'g Builder, q: &[Expr<'g>], v: Vec3<Dd>) -> Vec3<Expr<'g>> {
        let frames = self.replaced.frames(q, &b);
        frames.last_axes() * v.map(|x| b.constant(x))
    }
}

/// Returns the ways to write the rows of all contacts: for each in the axes of its link, or in those of its wheel.
pub(super) fn row_axes(closure: &Closure) -> Vec<Vec<Option<ContactAxes>>> {
    let ways = |closes: usize| -> Vec<Option<ContactAxes>> {
        let one = &closure.loops[closes];
        let has = |row: ContactRow| {
            let mut rows = closure.rows.iter();
            rows.any(|r| r.closes == closes && r.kind == RowKind::Contact(row))
        };
        let whole = DISC_ROWS.iter().all(|(_, row)| has(*row));
        match one
            .contact
            .as_ref()
            .map(|contact| (contact.shape, contact.crown))
        {
            Some((ContactShape::Disc(_), crown)) if whole && crown == Dd::ZERO => {
                let all = [ContactAxes::Link, ContactAxes::Wheel];
                all.map(Some).to_vec()
            }
            Some((ContactShape::Disc(_), _)) => vec![None, Some(ContactAxes::Plane)],
            _ => vec![None],
        }
    };
    let mut all: Vec<Vec<Option<ContactAxes>>> = vec![Vec::new()];
    for one in 0..closure.loops.len() {
        let ways = ways(one);
        let longer = |with: &Vec<Option<ContactAxes>>| {
            let with = with.clone();
            ways.clone()
                .into_iter()
                .map(move |way| with.iter().copied().chain([way]).collect())
        };
        all = all.iter().flat_map(longer).collect();
        // Of many contacts all in the same way.
        if all.len() > MOST_WAYS {
            let same = |all: &Vec<Option<ContactAxes>>| all.windows(2).all(|w| w[0] == w[1]);
            all.retain(same);
        }
    }
    all
}

/// Returns a contact on the link that carries its axle, not before the base, in the new axes.
fn contact(closed: &ClosedTree, tree: &FreeBase, one: &KinematicLoop) -> Option<KinematicLoop> {
    let graph = &closed.tree.multibody;
    let mut moved = one.clone();
    let contact = moved.contact.as_mut()?;
    let steps = &one.chain.steps;
    if one.links[1].is_some() || steps.iter().any(|step| step.outward) {
        return None;
    }
    let carrier = steps.first()?.link;
    let (mut carrier, mut start) = (carrier, one.chain.start);
    // Outward through rotations about the axle, to the base.
    if let Some(at) = tree.path.iter().position(|link| *link == carrier) {
        for &link in &tree.path[at + 1..] {
            let frame = &graph.frames[link.0];
            let own = frame
                .coordinate
                .filter(|_| frame.motion == Motion::Rotation)?;
            let spins = contact.spin.len();
            contact.spin.retain(|(j, _)| *j != own);
            if contact.spin.len() == spins {
                return None;
            }
            start = frame.origin.inverse().of(start);
            contact.upward = None;
            carrier = link;
        }
    }
    let start = tidy(tree.axes[carrier.0].inverse().of(start));
    // The axes of the place are those of its link, but for the half-axes of an ellipsoid.
    let turned = |v: Vec3<Dd>| (start.rotation * v).map(snap);
    let rotation = match &mut contact.shape {
        ContactShape::Ellipsoid(_) => start.rotation,
        ContactShape::Sphere => Pose::IDENTITY.rotation,
        ContactShape::Edge(direction) | ContactShape::Disc(direction) => {
            *direction = turned(*direction);
            Pose::IDENTITY.rotation
        }
    };
    contact.upward = contact.upward.map(turned);
    let inward = steps.iter().map(|step| step.link);
    let inward = inward.filter(|link| !tree.path.contains(link));
    let mut all: Vec<_> = inward.map(|link| tree.step(link)).collect();
    all.extend(tree.to_world(graph, true).steps);
    moved.chain = LoopChain {
        start: Pose { rotation, ..start },
        steps: all,
        end: one.chain.end,
    };
    Some(moved)
}
