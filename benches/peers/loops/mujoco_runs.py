"""MuJoCo: an equality constraint `connect` for each pin. Its own loop takes all steps; drives are a callback in Python."""

import time

import mujoco
import numpy as np

from mechanisms import GRAVITY, gap

# MuJoCo refuses a rod without a moment about its own line.
LEAST = 1e-12


def xml(mechanism, setting, step):
    text = lambda numbers: " ".join(repr(float(x)) for x in numbers)
    children = {}
    for k, one in enumerate(mechanism["links"]):
        children.setdefault(one["parent"], []).append(k)

    def bodies(parent):
        found = ""
        for k in children.get(parent, []):
            one = mechanism["links"][k]
            inertia = [max(x, LEAST) for x in one["inertia"]]
            found += (f'<body name="{one["name"]}" pos="{text(one["origin"])}"><joint type="hinge" axis="0 0 1"/>'
                      f'<inertial pos="{text(one["com"])}" mass="{one["mass"]!r}" diaginertia="{text(inertia)}"/>'
                      f"{bodies(k)}</body>")
        return found

    names = [one["name"] for one in mechanism["links"]]
    softness = setting["softness"](step)
    pins = ""
    for a, p, b, _ in mechanism["pins"]:
        pins += f'<connect body1="{names[a]}" body2="{names[b]}" anchor="{text(p)}" {softness}/>'
    return (f'<mujoco><option gravity="{text(GRAVITY)}" timestep="{step!r}" integrator="{setting["method"]}" '
            f'iterations="100" tolerance="1e-14"><flag energy="enable" contact="disable"/></option>'
            f'<compiler angle="radian" autolimits="true"/>'
            f"<worldbody>{bodies(None)}</worldbody><equality>{pins}</equality></mujoco>")


def run(mechanism, setting, step, measured):
    model = mujoco.MjModel.from_xml_string(xml(mechanism, setting, step))
    data = mujoco.MjData(model)
    # The places of the pins on both links, whatever the pose in which the file was compiled.
    for k, (_, p, _, r) in enumerate(mechanism["pins"]):
        model.eq_data[k, 0:3], model.eq_data[k, 3:6] = p, r
    data.qpos[:], data.qvel[:] = mechanism["q"], mechanism["v"]
    steps = round(mechanism["end"] / step)
    model.opt.timestep = mechanism["end"] / steps

    def place(k, point):
        return data.xpos[k + 1] + data.xmat[k + 1].reshape(3, 3) @ np.array(point)

    def drive(_, at):
        for k, effort in mechanism["drives"].items():
            at.qfrc_applied[k] = effort(at.time, at.qpos[k])

    mujoco.set_mjcb_control(drive if mechanism["drives"] else None)
    largest = 0.0
    begun = time.perf_counter()
    if measured:
        for _ in range(steps):
            mujoco.mj_step(model, data)
            mujoco.mj_kinematics(model, data)
            largest = max(largest, gap(mechanism, place))
    else:
        mujoco.mj_step(model, data, nstep=steps)
    seconds = (time.perf_counter() - begun) / mechanism["end"]
    mujoco.set_mjcb_control(None)
    if not np.all(np.isfinite(data.qpos)):
        return {"diverged": data.time, "gap": largest}
    q = list(data.qpos)
    mujoco.mj_forward(model, data)
    mujoco.mj_energyPos(model, data)
    mujoco.mj_energyVel(model, data)
    return {"positions": q, "energy": float(sum(data.energy)), "gap": largest, "seconds": seconds,
            "inside": "C, drives Python" if mechanism["drives"] else "C"}
