"""The cases in MuJoCo: `mujoco_cases.py CASE SETTING MORE STEPS ...`, lines of JSON as bgdyn's program prints them.
`mujoco_cases.py lift SETTING STEPS`: how the slipping disc leaves the slope.

Settings, with the sections of MuJoCo's documentation ("Modeling") that recommend them:

- `default`: elliptic cones, `implicitfast` (Performance tuning), else as MuJoCo comes.
- `stiff`: `solref` with the shortest time constant that is allowed, two steps (Solver parameters), `solimp` 0.9999, the
  largest; `impratio` 100, three iterations of the Noslip solver and `tolerance` 1e-10 (Preventing slip, Solver settings).
- `spring`: for the ball that bounces. There is no coefficient of restitution, but a spring and a damper, `solref` with two
  negative numbers (Restitution). A contact lasts BOUNCE steps; the damper gives the restitution 0.8.
"""

import json
import math
import os
import sys
import time

import mujoco

import cases
import quadruped

# How many steps a contact of the ball that bounces lasts.
BOUNCE = 20
# Repetitions of a run go on for this time, s, but are at least and at most so many.
PATIENCE, REPEATS = float(os.environ.get("PEERS_PATIENCE", 0.1)), (int(os.environ.get("PEERS_REPEATS", 3)), 2000)


def damping_ratio(restitution):
    """ζ of a spring and damper that never pulls: e = exp(−ζ (π − 2 asin ζ)/√(1 − ζ²)), by bisection."""
    low, high = 0.0, 0.9
    for _ in range(100):
        z = 0.5 * (low + high)
        e = math.exp(-z / math.sqrt(1 - z * z) * (math.pi - 2 * math.asin(z)))
        low, high = (z, high) if e > restitution else (low, z)
    return z


def spring(h):
    """`solref` of the ball that bounces."""
    z = damping_ratio(cases.RESTITUTION)
    rate = math.pi / (BOUNCE * h * math.sqrt(1 - z * z))
    return f"{-rate * rate!r} {-2 * z * rate!r}"


def settings(name, h):
    """Attributes of a contact, and of the solver."""
    stiff = 'solimp="0.9999 0.9999 0.001"', 'impratio="100" noslip_iterations="3" tolerance="1e-10"'
    if name == "default":
        return "", ""
    if name == "stiff":
        return f'solref="{2 * h!r} 1" {stiff[0]}', stiff[1]
    return f'solref="{spring(h)}" {stiff[0]}', 'tolerance="1e-10"'


BALL = (
    f'<freejoint/><inertial pos="0 0 0" mass="{cases.BALL_MASS}" '
    f'diaginertia="{" ".join([repr(0.4 * cases.BALL_MASS * cases.BALL_RADIUS**2)] * 3)}"/>'
    f'<geom type="sphere" size="{cases.BALL_RADIUS}" {{contact}}/>'
)
PLANAR = '<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/><joint type="hinge" axis="0 -1 0"/>'
BLOCK = (
    "".join(f'<joint type="slide" axis="{axis}"/>' for axis in ("1 0 0", "0 1 0", "0 0 1"))
    + f'<inertial pos="0 0 0" mass="{cases.BLOCK_MASS}" diaginertia="1 1 1"/>'
    + f'<geom type="sphere" size="0.05" pos="{-0.05 / cases.ROOT!r} 0 {0.15 / cases.ROOT!r}" {{contact}}/>'
)
DISC = (
    f'{PLANAR}<inertial pos="0 0 0" mass="{cases.DISC_MASS}" diaginertia="0.05 {cases.DISC_INERTIA} 0.05"/>'
    f'<geom type="sphere" size="{cases.DISC_RADIUS}" {{contact}}/>'
)
ROCKER = (
    f'{PLANAR}<inertial pos="0 0 0" mass="{cases.ROCKER_MASS}" diaginertia="0.6 {cases.ROCKER_INERTIA!r} 0.1"/>'
    f'<geom type="box" size="{cases.HALF_WIDTH} 0.05 {cases.HALF_HEIGHT}" {{contact}}/>'
)
# Body, normal of the plane, friction, positions and velocities at the start, numbers of a state.
MODELS = {
    "bounces": (BALL, "0 0 1", None, [0, 0, 0.5 + cases.BALL_RADIUS, 1, 0, 0, 0], [0] * 6, lambda d: [d.qpos[2]]),
    "sticks": (BLOCK, "-1 0 3", 0.5, [0] * 3, [3, 0, 1], lambda d: d.qpos),
    "across": (BLOCK, "-1 0 3", 0.2, [0] * 3, [0, 2, 0], lambda d: d.qvel),
    "bowls": (BALL, "0 0 1", cases.BALL_FRICTION, [0, 0, cases.BALL_RADIUS, 1, 0, 0, 0], [3, 0, 0, *cases.BALL_SPIN],
              lambda d: [*d.qpos[:2], *d.qvel[:2]]),
    "rolls": (DISC, "-3 0 4", 0.3, [0, 0.25, 0], [0] * 3, lambda d: d.qvel[:2]),
    "slips": (DISC, "-3 0 4", 0.1, [0, 0.25, 0], [0] * 3, lambda d: d.qvel[:2]),
    "rocks": (ROCKER, "0 0 1", 0.5, cases.TILTED, [0] * 3, lambda d: [d.qpos[2]]),
    "stands": (None, None, None, quadruped.POSITIONS, [0] * 18, quadruped.values),
}


def xml(name, setting, h):
    if name == "stands":
        return quadruped.xml(h, *settings(setting, h))
    body, normal, friction, *_ = MODELS[name]
    softness, options = settings(setting, h)
    rubs = 'condim="1"' if friction is None else f'condim="3" friction="{friction} 0 0"'
    contact = f"{rubs} {softness}"
    return (
        f'<mujoco><option timestep="{h!r}" integrator="implicitfast" cone="elliptic" {options}/>'
        f'<worldbody><geom type="plane" size="0 0 1" zaxis="{normal}" {contact}/>'
        f"<body>{body.format(contact=contact)}</body></worldbody></mujoco>"
    )


def run(name, setting, more, steps):
    h = cases.CASES[name].end / steps
    model = mujoco.MjModel.from_xml_string(xml(name, setting, h))
    data = mujoco.MjData(model)
    q, v, values = MODELS[name][3:]
    controls = quadruped.TARGETS if name == "stands" else []
    seconds, begun = math.inf, time.perf_counter()
    for repeat in range(REPEATS[1]):
        if repeat >= REPEATS[0] and time.perf_counter() - begun > PATIENCE:
            break
        mujoco.mj_resetData(model, data)
        data.qpos[:], data.qvel[:], data.ctrl[:] = q, v, controls
        start = time.perf_counter()
        mujoco.mj_step(model, data, nstep=steps)
        seconds = min(seconds, time.perf_counter() - start)
    found = [float(x) for x in values(data)]
    if more:
        mujoco.mj_step(model, data, nstep=round(more / h))
        found += [float(x) for x in values(data)]
    return {"setting": setting, "steps": steps, "tolerance": None, "values": found, "seconds": seconds}


def lift(setting, steps):
    """How the slipping disc leaves the slope."""
    model = mujoco.MjModel.from_xml_string(xml("slips", setting, cases.CASES["slips"].end / steps))
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = MODELS["slips"][3:5]
    gaps = []
    for _ in range(steps):
        mujoco.mj_step(model, data)
        gaps.append(cases.gap(*data.qpos[:2]))
    return cases.lifted(gaps)


if __name__ == "__main__":
    if sys.argv[1] == "lift":
        print(json.dumps(lift(sys.argv[2], int(sys.argv[3]))))
        sys.exit()
    for count in sys.argv[4:]:
        print(json.dumps(run(sys.argv[1], sys.argv[2], float(sys.argv[3]), int(count))), flush=True)
