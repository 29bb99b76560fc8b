"""Drake: a discrete plant with the SAP solver and a ball constraint for each pin. Without drives its simulator takes all
steps."""

import time

import numpy as np
from pydrake.math import RigidTransform
from pydrake.multibody.plant import DiscreteContactApproximation, MultibodyPlant
from pydrake.multibody.tree import FixedOffsetFrame, RevoluteJoint, SpatialInertia, UnitInertia
from pydrake.systems.analysis import Simulator

from mechanisms import GRAVITY, gap


def build(mechanism, step):
    plant = MultibodyPlant(step)
    plant.set_discrete_contact_approximation(DiscreteContactApproximation.kSap)
    plant.mutable_gravity_field().set_gravity_vector(np.array(GRAVITY))
    bodies, joints = [], []
    for one in mechanism["links"]:
        com, mass = np.array(one["com"]), one["mass"]
        about_com = UnitInertia(*[x / mass for x in one["inertia"]])
        inertia = SpatialInertia(mass, com, about_com.ShiftFromCenterOfMass(-com))
        body = plant.AddRigidBody(one["name"], inertia)
        parent = plant.world_body() if one["parent"] is None else bodies[one["parent"]]
        frame = plant.AddFrame(fixed(f"{one['name']}_origin", parent, one["origin"]))
        joints.append(plant.AddJoint(RevoluteJoint(one["name"], frame, body.body_frame(), [0, 0, 1])))
        bodies.append(body)
    for a, p, b, r in mechanism["pins"]:
        plant.AddBallConstraint(body_A=bodies[a], p_AP=np.array(p), body_B=bodies[b], p_BQ=np.array(r))
    for k in mechanism["drives"]:
        plant.AddJointActuator(f"drive{k}", joints[k])
    plant.Finalize()
    return plant, bodies, joints


def fixed(name, parent, origin):
    return FixedOffsetFrame(name, parent.body_frame(), RigidTransform(np.array(origin)))


def run(mechanism, setting, step, measured):
    steps = round(mechanism["end"] / step)
    h = mechanism["end"] / steps
    plant, bodies, joints = build(mechanism, h)
    context = plant.CreateDefaultContext()
    for joint, q, v in zip(joints, mechanism["q"], mechanism["v"]):
        joint.set_angle(context, q)
        joint.set_angular_rate(context, v)
    drives = mechanism["drives"]
    port = plant.get_actuation_input_port()
    if drives:
        port.FixValue(context, np.zeros(len(drives)))
    simulator = Simulator(plant, context)
    simulator.Initialize()
    alone = not drives and not measured
    largest = 0.0

    def place(k, point):
        return plant.EvalBodyPoseInWorld(context, bodies[k]) @ np.array(point)

    begun = time.perf_counter()
    if alone:
        # The update of the last step is taken a step before the end.
        simulator.AdvanceTo(mechanism["end"] - 0.5 * h)
    else:
        for k in range(steps):
            if drives:
                t = k * h
                efforts = [drive(t, joints[j].get_angle(context)) for j, drive in drives.items()]
                port.FixValue(context, np.array(efforts))
            # The update of step k + 1 is taken at the time k h.
            simulator.AdvanceTo((k + 0.5) * h)
            if measured:
                largest = max(largest, gap(mechanism, place))
    seconds = (time.perf_counter() - begun) / mechanism["end"]
    q = [joint.get_angle(context) for joint in joints]
    energy = plant.CalcKineticEnergy(context) + plant.CalcPotentialEnergy(context)
    return {"positions": q, "energy": energy, "gap": largest, "seconds": seconds,
            "inside": "Python" if drives else "C++"}
