"""The arm with viscous friction in Drake: drake_runs.py DESCRIPTION METHOD NUMBER ...

METHOD is `discrete`, with numbers of steps, or the name of an integrator such as `runge_kutta3`, with accuracies. Its own
simulator takes all steps. Prints lines of JSON as the other programs.
"""

import json
import os
import sys
import time

import numpy as np
from pydrake.math import RigidTransform, RotationMatrix
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import FixedOffsetFrame, RevoluteJoint, RotationalInertia, SpatialInertia, UnitInertia
from pydrake.systems.analysis import ResetIntegratorFromFlags, Simulator

END, DAMPING = 2.0, 0.8
START = [0.3, 0.6, -0.4, -1.2, 0.5, 1.4, -0.7]


def read(path):
    """The gravity, and for each link the numbers of its line."""
    lines = open(path).read().splitlines()
    gravity = [float(x) for x in lines[1].split()[1:]]
    links = []
    for line in lines[3:]:
        words = line.split()
        links.append((words[0], int(words[1]), np.array([float(x) for x in words[3:]])))
    return gravity, links


def build(path, step):
    gravity, links = read(path)
    plant = MultibodyPlant(step)
    plant.mutable_gravity_field().set_gravity_vector(np.array(gravity))
    bodies, joints = [], []
    for name, parent, x in links:
        turn, place, axis, mass, com, moments = x[:9], x[9:12], x[12:15], x[15], x[16:19], x[19:]
        xx, xy, xz, yy, yz, zz = moments
        about_com = RotationalInertia(xx, yy, zz, xy, xz, yz)
        inertia = SpatialInertia.MakeFromCentralInertia(mass, com, about_com)
        body = plant.AddRigidBody(name, inertia)
        carrier = plant.world_body() if parent < 0 else bodies[parent]
        pose = RigidTransform(RotationMatrix.ProjectToRotationMatrix(turn.reshape(3, 3)), place)
        frame = plant.AddFrame(FixedOffsetFrame(f"{name}_origin", carrier.body_frame(), pose))
        joints.append(plant.AddJoint(RevoluteJoint(name, frame, body.body_frame(), axis, DAMPING)))
        bodies.append(body)
    plant.Finalize()
    return plant, joints


def run(path, method, number):
    h = END / number if method == "discrete" else 0.0
    plant, joints = build(path, h)
    simulator = Simulator(plant)
    if method != "discrete":
        ResetIntegratorFromFlags(simulator, method, 0.1)
        simulator.get_mutable_integrator().set_target_accuracy(number)
    best, patience = float("inf"), float(os.environ.get("PEERS_PATIENCE", 0.3))
    all_of_it = time.perf_counter()
    while True:
        context = simulator.get_mutable_context()
        context.SetTime(0.0)
        for joint, q in zip(joints, START):
            joint.set_angle(context, q)
            joint.set_angular_rate(context, 0.0)
        simulator.Initialize()
        begun = time.perf_counter()
        # The update of the last step is taken a step before the end.
        simulator.AdvanceTo(END - 0.5 * h)
        best = min(best, time.perf_counter() - begun)
        if time.perf_counter() - all_of_it > patience:
            break
    q = [joint.get_angle(context) for joint in joints]
    print(json.dumps({"given": number, "positions": q, "seconds": best / END}), flush=True)


for word in sys.argv[3:]:
    run(sys.argv[1], sys.argv[2], float(word))
