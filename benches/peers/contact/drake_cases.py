"""The cases in Drake: `drake_cases.py CASE SETTING MORE STEPS|ACCURACY ...`, lines of JSON as bgdyn's program prints them.
`drake_cases.py lift SETTING STEPS`: how the slipping disc leaves the slope.

Point contact. Settings, with the parts of Drake's documentation that recommend them:

- `lagged`: the approximation of a discrete plant that is the default and preferred (DiscreteContactApproximation), with the
  default stiffness, dissipation and stiction tolerance.
- `sap`: the SAP solver with a stiffness beyond the threshold from which it is as stiff as the step allows
  (set_sap_near_rigid_threshold), and a relaxation time of one step.
- `continuous`: a plant without steps, by Drake's integrator of order 3 with this accuracy: for the ball on a spring.
- `spring`: the ball on a spring, discrete, `lagged`.
"""

import json
import math
import os
import sys
import time

import numpy as np
from pydrake.geometry import AddContactMaterial, HalfSpace, ProximityProperties, Sphere
from pydrake.math import RigidTransform, RotationMatrix
from pydrake.multibody.plant import (
    AddMultibodyPlantSceneGraph,
    ContactModel,
    CoulombFriction,
    DiscreteContactApproximation,
    MultibodyPlant,
)
from pydrake.multibody.tree import FixedOffsetFrame, PlanarJoint, PrismaticJoint, SpatialInertia, UnitInertia
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder

import cases

# Repetitions of a run go on for this time, s, but are at least and at most so many.
PATIENCE, REPEATS = float(os.environ.get("PEERS_PATIENCE", 0.1)), (int(os.environ.get("PEERS_REPEATS", 3)), 2000)
APPROXIMATIONS = {
    "lagged": DiscreteContactApproximation.kLagged,
    "sap": DiscreteContactApproximation.kSap,
    "spring": DiscreteContactApproximation.kLagged,
}
NEAR_RIGID = 1e12


def inertia(mass, moments):
    return SpatialInertia(mass, np.zeros(3), UnitInertia(*[x / mass for x in moments]))


def ball(plant):
    body = plant.AddRigidBody("body", inertia(cases.BALL_MASS, [0.4 * cases.BALL_MASS * cases.BALL_RADIUS**2] * 3))
    return body, [(cases.BALL_RADIUS, [0, 0, 0])]


def block(plant):
    last = plant.world_body()
    for axis, name in zip(np.eye(3), "xyz"):
        end = name == "z"
        body = plant.AddRigidBody(name, inertia(cases.BLOCK_MASS, [1, 1, 1]) if end else SpatialInertia.Zero())
        plant.AddJoint(PrismaticJoint(name, last.body_frame(), body.body_frame(), axis))
        last = body
    return last, [(0.05, [-0.05 / cases.ROOT, 0, 0.15 / cases.ROOT])]


def planar(plant, mass, moments):
    body = plant.AddRigidBody("body", inertia(mass, moments))
    turned = RigidTransform(RotationMatrix.MakeXRotation(math.pi / 2))
    frames = [plant.AddFrame(FixedOffsetFrame(n, b.body_frame(), turned)) for n, b in (("on", plant.world_body()), ("of", body))]
    plant.AddJoint(PlanarJoint("joint", *frames))
    return body


def disc(plant):
    moments = [0.05, cases.DISC_INERTIA, 0.05]
    return planar(plant, cases.DISC_MASS, moments), [(cases.DISC_RADIUS, [0, 0, 0])]


def rocker(plant):
    body = planar(plant, cases.ROCKER_MASS, [0.6, cases.ROCKER_INERTIA, 0.1])
    return body, [(0.0, [x, 0, -cases.HALF_HEIGHT]) for x in (-cases.HALF_WIDTH, cases.HALF_WIDTH)]


# Body with its spheres, normal of the plane, friction, positions and velocities at the start, numbers of a state.
# Those of a floating body: quaternion and place; spin and velocity in axes of the world.
BALL_AT = [1, 0, 0, 0, 0, 0]
MODELS = {
    "compliant": (ball, [0, 0, 1], 0.0, [*BALL_AT, cases.HEIGHT + cases.BALL_RADIUS], [0] * 6, lambda q, v: [q[6]]),
    "sticks": (block, [-1, 0, 3], 0.5, [0] * 3, [3, 0, 1], lambda q, v: q),
    "across": (block, [-1, 0, 3], 0.2, [0] * 3, [0, 2, 0], lambda q, v: v),
    "bowls": (ball, [0, 0, 1], cases.BALL_FRICTION, [*BALL_AT, cases.BALL_RADIUS], [*cases.BALL_SPIN, 3, 0, 0],
              lambda q, v: [*q[4:6], *v[3:5]]),
    "rolls": (disc, [-3, 0, 4], 0.3, [0, 0.25, 0], [0] * 3, lambda q, v: v[:2]),
    "slips": (disc, [-3, 0, 4], 0.1, [0, 0.25, 0], [0] * 3, lambda q, v: v[:2]),
    "rocks": (rocker, [0, 0, 1], 0.5, cases.TILTED, [0] * 3, lambda q, v: [q[2]]),
}


def build(name, setting, h):
    """The simulator at the start, and its plant."""
    make, normal, friction = MODELS[name][:3]
    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlantSceneGraph(builder, MultibodyPlant(0.0 if setting == "continuous" else h))
    plant.set_contact_model(ContactModel.kPoint)
    if setting in APPROXIMATIONS:
        plant.set_discrete_contact_approximation(APPROXIMATIONS[setting])
    plant.mutable_gravity_field().set_gravity_vector(np.array([0, 0, -cases.G]))
    body, spheres = make(plant)
    material = ProximityProperties()
    # Two surfaces in series have half of the stiffness.
    given = {}
    if name == "compliant":
        given = {"point_stiffness": 2 * cases.STIFFNESS, "dissipation": cases.DISSIPATION}
    elif setting == "sap":
        given = {"point_stiffness": NEAR_RIGID}
        material.AddProperty("material", "relaxation_time", h)
    AddContactMaterial(properties=material, friction=CoulombFriction(friction, friction), **given)
    plane = HalfSpace.MakePose(np.array(normal, float), np.zeros(3))
    plant.RegisterCollisionGeometry(plant.world_body(), plane, HalfSpace(), "ground", material)
    for k, (radius, at) in enumerate(spheres):
        plant.RegisterCollisionGeometry(body, RigidTransform(np.array(at, float)), Sphere(radius), f"sphere{k}", material)
    plant.Finalize()
    simulator = Simulator(builder.Build())
    return simulator, plant


def run(name, setting, more, given):
    end = cases.CASES[name].end
    continuous = setting == "continuous"
    h = end / given
    simulator, plant = build(name, setting, h)
    if continuous:
        simulator.get_mutable_integrator().set_target_accuracy(given)
    q, v, values = MODELS[name][3:]
    root = simulator.get_mutable_context()
    context = plant.GetMyContextFromRoot(root)
    found = lambda: [float(x) for x in values(plant.GetPositions(context), plant.GetVelocities(context))]
    seconds, begun = math.inf, time.perf_counter()
    for repeat in range(REPEATS[1]):
        if repeat >= REPEATS[0] and time.perf_counter() - begun > PATIENCE:
            break
        root.SetTime(0.0)
        plant.SetPositions(context, q)
        plant.SetVelocities(context, v)
        simulator.Initialize()
        start = time.perf_counter()
        # The update of a step is taken at its beginning.
        simulator.AdvanceTo(end if continuous else end - 0.5 * h)
        seconds = min(seconds, time.perf_counter() - start)
    result = found()
    if more:
        simulator.AdvanceTo(end + more - 0.5 * h)
        result += found()
    steps, tolerance = (None, given) if continuous else (given, None)
    return {"setting": setting, "steps": steps, "tolerance": tolerance, "values": result, "seconds": seconds}


def lift(setting, steps):
    """How the slipping disc leaves the slope."""
    h = cases.CASES["slips"].end / steps
    simulator, plant = build("slips", setting, h)
    context = plant.GetMyContextFromRoot(simulator.get_mutable_context())
    plant.SetPositions(context, MODELS["slips"][3])
    simulator.Initialize()
    gaps = []
    for k in range(steps):
        simulator.AdvanceTo((k + 0.5) * h)
        gaps.append(cases.gap(*plant.GetPositions(context)[:2]))
    return cases.lifted(gaps)


if __name__ == "__main__":
    if sys.argv[1] == "lift":
        print(json.dumps(lift(sys.argv[2], int(sys.argv[3]))))
        sys.exit()
    name, setting, more = sys.argv[1:4]
    for count in sys.argv[4:]:
        number = float(count) if setting == "continuous" else int(count)
        print(json.dumps(run(name, setting, float(more), number)), flush=True)
