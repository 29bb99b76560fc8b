"""Plans one cycle of the Delta robot, pick and place and back, and writes delta_pick.scene.yaml.

The path of the platform gives the angles r of the arms in closed form. They are followed by computed torque, with the
acceleration d (ẇ - q̇) + k (w - q): a table w has no acceleration between its points, and that of the plan would be
missing. So the tables are not the plan but w = r + y, where d ẏ + k y = r̈. On the plan, q = r, the acceleration is r̈.

    python3 examples/closed_machines/plan_pick.py
"""

from math import asin, atan2, cos, hypot, pi, sin, sqrt
from pathlib import Path

HERE = Path(__file__).parent
# The robot: radii of the base and of the platform, lengths of arm and forearm, in m.
BASE, PLATFORM, ARM, FOREARM = 0.2, 0.05, 0.25, 0.6
AZIMUTHS = (0.0, 2 * pi / 3, 4 * pi / 3)
# Two places, above which the platform turns, in m; a wait at the start, at the place and at the end, a way, in s.
PICK, PLACE, TOP = (-0.13, -0.05, -0.6), (0.13, 0.07, -0.57), -0.5
WAIT, WAY = 0.1, 0.5
STIFFNESS, DAMPING = 100.0, 20.0  # 1/s², 1/s: an error e decays as (1 + 10 t) exp(-10 t)
STEP, H = 0.002, 0.0002  # s: between points of the tables; of the integration, and of differences
END = 3 * WAIT + 2 * WAY


def smooth(x):
    """From 0 to 1 with three zero derivatives at both ends."""
    x = min(max(x, 0.0), 1.0)
    return x**4 * (35 + x * (-84 + x * (70 - 20 * x)))


def platform(t):
    """The path of the platform: up, across, down; after a wait the same way back."""
    forth = t < WAIT + WAY + WAIT / 2
    s = (t - WAIT) / WAY if forth else 1 - (t - 2 * WAIT - WAY) / WAY
    across, up, down = smooth((s - 0.15) / 0.7), smooth(s / 0.5), smooth((s - 0.5) / 0.5)
    x, y = [a + (b - a) * across for a, b in zip(PICK[:2], PLACE[:2])]
    return [x, y, PICK[2] + (TOP - PICK[2]) * up + (PLACE[2] - TOP) * down]


def arms(place):
    """The angle of each arm, its elbow outside; 0 is level, a positive one is down."""
    found = []
    for azimuth in AZIMUTHS:
        c, s = cos(azimuth), sin(azimuth)
        out, aside = c * place[0] + s * place[1] + PLATFORM - BASE, c * place[1] - s * place[0]
        # out cos θ - z sin θ is what the lengths of arm and forearm ask for.
        asked = (out**2 + aside**2 + place[2] ** 2 + ARM**2 - FOREARM**2) / (2 * ARM)
        reach = hypot(out, place[2])
        if abs(asked) > reach:
            raise ValueError(f"no arm reaches {place}")
        turn = atan2(sqrt(reach**2 - asked**2), asked)
        found.append(atan2(-place[2], out) - turn)
    return found


def plan(t):
    return arms(platform(t))


def closed(place):
    """All joints, by their names."""
    q = dict(zip(("px_position", "py_position", "platform_position"), place))
    for k, (angle, azimuth) in enumerate(zip(arms(place), AZIMUTHS), 1):
        c, s = cos(azimuth), sin(azimuth)
        out = c * place[0] + s * place[1] + PLATFORM - BASE - ARM * cos(angle)
        aside, up = c * place[1] - s * place[0], place[2] + ARM * sin(angle)
        q[f"arm{k}_angle"] = angle
        q[f"forearm{k}_pitch_angle"] = atan2(-up, out) - angle
        q[f"forearm{k}_yaw_angle"] = asin(aside / FOREARM)
    return q


def acceleration(t):
    a, b, c = plan(t - H), plan(t), plan(t + H)
    return [(x - 2 * y + z) / H**2 for x, y, z in zip(a, b, c)]


def leading():
    """The tables: times, and the plan with its lead y, integrated by the trapezoidal rule."""
    y, before, rows = [0.0] * 3, acceleration(0), []
    every = round(STEP / H)
    for n in range(round(END / H) + 2 * every + 1):
        t = n * H
        now = acceleration(t)
        fade = H * STIFFNESS / DAMPING / 2
        y = [((1 - fade) * u + H / DAMPING * (a + b) / 2) / (1 + fade) for u, a, b in zip(y, before, now)]
        before = now
        if n % every == 0:
            rows.append([r + u for r, u in zip(plan(t), y)])
    first = [2 * a - b for a, b in zip(rows[0], rows[1])]
    # Straight lines between these points have the mean of the curve: u less u'' h²/12.
    fit = lambda a, b, c: [v - (u - 2 * v + w) / 12 for u, v, w in zip(a, b, c)]
    return [(STEP * i, fit(*three)) for i, three in enumerate(zip([first] + rows, rows, rows[1:]))]


HEAD = """# Written by plan_pick.py: the tables of the arms' angles. The other nine joints follow from the loops.
scene: 1
mechanism: ../../specs/loops/delta_robot.yaml
description: A Delta robot picks, places and comes back, by computed torque at its three arms

effects:
  - gravity
  - inertia
  - velocity_products
  - bearings: { type: viscous, joints: [arm1_angle, arm2_angle, arm3_angle], damping: 0.05 N*m*s/rad }
  # Joints that the loops make dependent.
  - elbows:
      type: viscous
      joints: [forearm1_pitch_angle, forearm2_pitch_angle, forearm3_pitch_angle]
      damping: 0.01 N*m*s/rad

"""


def main():
    rows = leading()
    text = HEAD + "initial:\n"
    for k, angle in enumerate(plan(0)):
        text += f"  arm{k + 1}_angle: {angle:.12f}\n"
    text += f"integration: {{ method: rk4, step: 1 ms, end: {END:g} s }}\ninputs:\n"
    for k in range(3):
        points = [f"[{t:.3f} s, {r[k]:.8f}]" for t, r in rows]
        lines = [", ".join(points[i : i + 6]) for i in range(0, len(points), 6)]
        text += f"  arm{k + 1}_angle:\n    computed_torque:\n      stiffness: {STIFFNESS:g}\n      damping: {DAMPING:g}\n"
        text += "      target:\n        table: [\n          " + ",\n          ".join(lines) + "\n        ]\n"
    (HERE / "delta_pick.scene.yaml").write_text(text)


if __name__ == "__main__":
    main()
