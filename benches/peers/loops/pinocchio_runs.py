"""Pinocchio: `constraintDynamics` with a 3-D point for each pin. The loop over steps is Python's."""

import time

import numpy as np
import pinocchio as pin

from mechanisms import GRAVITY, gap


def build(mechanism, kp, kd):
    model = pin.Model()
    model.gravity.linear = np.array(GRAVITY)
    ids = []
    for one in mechanism["links"]:
        parent = 0 if one["parent"] is None else ids[one["parent"]]
        origin = pin.SE3(np.eye(3), np.array(one["origin"]))
        joint = model.addJoint(parent, pin.JointModelRZ(), origin, one["name"])
        inertia = pin.Inertia(one["mass"], np.array(one["com"]), np.diag(one["inertia"]))
        model.appendBodyToJoint(joint, inertia, pin.SE3.Identity())
        ids.append(joint)
    constraints = pin.StdVec_RigidConstraintModel()
    for a, p, b, r in mechanism["pins"]:
        places = [pin.SE3(np.eye(3), np.array(x)) for x in (p, r)]
        one = pin.RigidConstraintModel(pin.ContactType.CONTACT_3D, model, ids[a], places[0], ids[b], places[1], pin.LOCAL)
        one.m_baumgarte_parameters.Kp, one.m_baumgarte_parameters.Kd = kp, kd
        constraints.append(one)
    return model, constraints, ids


def run(mechanism, setting, step, measured):
    """Returns positions, energy, the largest gap (if `measured`, else 0) and the time for a simulated second."""
    method, mu, kp, kd = setting["method"], setting["mu"], setting["kp"](step), setting["kd"](step)
    model, constraints, ids = build(mechanism, kp, kd)
    data = model.createData()
    datas = pin.StdVec_RigidConstraintData()
    datas.extend(one.createData() for one in constraints)
    pin.initConstraintDynamics(model, data, constraints, datas)
    settings = pin.ProximalSettings(1e-14, mu, 20)
    tau = np.zeros(model.nv)

    def acceleration(t, q, v):
        for k, drive in mechanism["drives"].items():
            tau[k] = drive(t, q[k])
        return pin.constraintDynamics(model, data, q, v, tau, constraints, datas, settings)

    def open_by(q):
        pin.forwardKinematics(model, data, q)
        return gap(mechanism, lambda k, x: data.oMi[ids[k]].act(np.array(x)))

    q, v = np.array(mechanism["q"]), np.array(mechanism["v"])
    steps = round(mechanism["end"] / step)
    h, largest = mechanism["end"] / steps, 0.0
    begun = time.perf_counter()
    for k in range(steps):
        t = k * h
        if method == "RK4":
            a = acceleration(t, q, v).copy()
            v2 = v + 0.5 * h * a
            b = acceleration(t + 0.5 * h, q + 0.5 * h * v, v2).copy()
            v3 = v + 0.5 * h * b
            c = acceleration(t + 0.5 * h, q + 0.5 * h * v2, v3).copy()
            v4 = v + h * c
            d = acceleration(t + h, q + h * v3, v4)
            q, v = q + h / 6 * (v + 2 * (v2 + v3) + v4), v + h / 6 * (a + 2 * (b + c) + d)
        else:
            v = v + h * acceleration(t, q, v)
            q = q + h * v
        if measured:
            largest = max(largest, open_by(q))
        if not np.all(np.isfinite(q)) or np.abs(v).max() > 1e6:
            return {"diverged": t, "gap": largest}
    seconds = (time.perf_counter() - begun) / mechanism["end"]
    energy = pin.computeKineticEnergy(model, data, q, v) + pin.computePotentialEnergy(model, data, q)
    return {"positions": list(q), "energy": energy, "gap": largest, "seconds": seconds, "inside": "Python"}
