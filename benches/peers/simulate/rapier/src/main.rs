//! The arm with viscous friction in rapier, its multibody joints in `f64`: rapier-peer DESCRIPTION STEPS ...
//!
//! Prints lines of JSON as the other programs.

use std::hint::black_box;
use std::time::Instant;

use rapier3d_f64::prelude::*;

const END: f64 = 2.0;
const DAMPING: f64 = 0.8;
const START: [f64; 7] = [0.3, 0.6, -0.4, -1.2, 0.5, 1.4, -0.7];

/// A link as the description has it.
struct Link {
    turn: Rotation,
    place: Vector,
    axis: Vector,
    mass: f64,
    com: Vector,
    inertia: Matrix,
}

fn read(path: &str) -> (Vector, Vec<Link>) {
    let text = std::fs::read_to_string(path).expect("a description");
    let mut lines = text.lines();
    let numbers = |line: &str, skip: usize| -> Vec<f64> {
        line.split_whitespace().skip(skip).map(|x| x.parse().expect("a number")).collect()
    };
    let gravity = numbers(lines.nth(1).expect("a line"), 1);
    let links = lines.skip(1).map(|line| {
        let x = numbers(line, 3);
        let v = |k: usize| Vector::new(x[k], x[k + 1], x[k + 2]);
        // Row by row.
        let turn = Matrix::from_cols(v(0), v(3), v(6)).transpose();
        Link {
            turn: Rotation::from_mat3(&turn),
            place: v(9),
            axis: v(12),
            mass: x[15],
            com: v(16),
            inertia: Matrix::from_cols(
                Vector::new(x[19], x[20], x[21]),
                Vector::new(x[20], x[22], x[23]),
                Vector::new(x[21], x[23], x[24]),
            ),
        }
    });
    (Vector::new(gravity[0], gravity[1], gravity[2]), links.collect())
}

/// The arm and what rapier needs to step it.
struct World {
    bodies: RigidBodySet,
    joints: MultibodyJointSet,
    handles: Vec<RigidBodyHandle>,
    frames: Vec<(Pose, Pose)>,
    pipeline: PhysicsPipeline,
    islands: IslandManager,
    broad: BroadPhaseBvh,
    narrow: NarrowPhase,
    colliders: ColliderSet,
    impulse_joints: ImpulseJointSet,
    ccd: CCDSolver,
}

fn world(links: &[Link]) -> World {
    let mut bodies = RigidBodySet::new();
    let mut joints = MultibodyJointSet::new();
    let base = bodies.insert(RigidBodyBuilder::fixed());
    let (mut handles, mut frames, mut parent) = (vec![], vec![], base);
    let mut last = None;
    for (link, q) in links.iter().zip(START) {
        let properties = MassProperties::with_inertia_matrix(link.com, link.mass, link.inertia);
        let body = RigidBodyBuilder::dynamic().can_sleep(false).additional_mass_properties(properties);
        let handle = bodies.insert(body);
        // The joint's axis is x of both frames; they meet at the start.
        let to_axis = Rotation::from_rotation_arc(Vector::X, link.axis);
        let turned = link.turn * Rotation::from_axis_angle(link.axis, q);
        let first = Pose::from_parts(link.place, turned * to_axis);
        let second = Pose::from_parts(Vector::ZERO, to_axis);
        let joint = GenericJointBuilder::new(JointAxesMask::LOCKED_REVOLUTE_AXES)
            .local_frame1(first)
            .local_frame2(second)
            .build();
        last = joints.insert(parent, handle, joint, true);
        handles.push(handle);
        frames.push((first, second));
        parent = handle;
    }
    let (arm, _) = joints.get_mut(last.expect("a joint")).expect("a multibody");
    arm.damping_mut().fill(DAMPING);
    World {
        bodies,
        joints,
        handles,
        frames,
        pipeline: PhysicsPipeline::new(),
        islands: IslandManager::new(),
        broad: BroadPhaseBvh::new(),
        narrow: NarrowPhase::new(),
        colliders: ColliderSet::new(),
        impulse_joints: ImpulseJointSet::new(),
        ccd: CCDSolver::new(),
    }
}

/// Returns the angles at the end and the time of the steps, s.
fn run(gravity: Vector, links: &[Link], steps: usize) -> (Vec<f64>, f64) {
    let mut w = black_box(world(links));
    let parameters = IntegrationParameters {
        dt: END / steps as f64,
        ..IntegrationParameters::default()
    };
    let begun = Instant::now();
    for _ in 0..steps {
        w.pipeline.step(
            gravity,
            &parameters,
            &mut w.islands,
            &mut w.broad,
            &mut w.narrow,
            &mut w.bodies,
            &mut w.colliders,
            &mut w.impulse_joints,
            &mut w.joints,
            &mut w.ccd,
            &(),
            &(),
        );
    }
    let seconds = begun.elapsed().as_secs_f64();
    let mut carrier = Pose::IDENTITY;
    let mut angles = vec![];
    for ((handle, (first, second)), q) in w.handles.iter().zip(&w.frames).zip(START) {
        let pose = *w.bodies[*handle].position();
        let turn = ((carrier * *first).inverse() * (pose * *second)).rotation;
        angles.push(q + 2.0 * turn.x.atan2(turn.w));
        carrier = pose;
    }
    (angles, seconds)
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (gravity, links) = read(&arguments[0]);
    let patience = std::env::var("PEERS_PATIENCE").ok();
    let patience = patience.and_then(|x| x.parse().ok()).unwrap_or(0.3);
    for word in &arguments[1..] {
        let steps: usize = word.parse().expect("a number of steps");
        let all = Instant::now();
        let (mut angles, mut best) = run(gravity, &links, steps);
        while all.elapsed().as_secs_f64() < patience {
            let (again, seconds) = run(gravity, &links, steps);
            (angles, best) = (again, best.min(seconds));
        }
        println!("{{\"given\": {steps}, \"positions\": {angles:?}, \"seconds\": {:e}}}", best / END);
    }
}
