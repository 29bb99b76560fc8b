"""Plans the flight of the quadrotor with its arm, and writes quadrotor_arm.scene.yaml.

The centre of mass flies once round a circle that rises and falls, the nose ahead, while the arm swings.
A propeller pulls along the body's z only. The body is therefore tilted so that its z points along the sum
of acceleration and -gravity; thrust and moments follow from inverse dynamics (Mellinger, Kumar 2011, for
a quadrotor without an arm). They become the tables of the scene. Nothing is fed back to the propellers.

    python3 examples/free_machines/plan_flight.py bgdyn
"""

import json
import subprocess
import sys
import tempfile
from math import atan2, cos, pi, sin, sqrt
from pathlib import Path

HERE = Path(__file__).parent
LAP, STEP, H = 6.0, 0.02, 0.01  # s: the lap, between points of the tables, of the differences
RADIUS, HEIGHT, RISE, G = 1.5, 1.5, 0.3, 9.81
# Amplitude and offset in rad, phase of the arm's two joints; two swings a lap.
ARM = {"shoulder": (0.6, 0.9, 0.0), "elbow": (0.9, 0.7, pi / 2)}
SWINGS = 2 / LAP
# Half the distance of propellers, and moment per thrust of one.
D, C = 0.18, 0.016
ROTORS = {"front_left": (1, 1, -1), "front_right": (1, -1, 1), "hind_left": (-1, 1, 1), "hind_right": (-1, -1, -1)}


def rate(f, t):
    """The derivative of a list of numbers, by six points."""
    weights = ((1, 45 / 60), (2, -9 / 60), (3, 1 / 60))
    sides = [(w, f(t + k * H), f(t - k * H)) for k, w in weights]
    return [sum(w * (p[i] - m[i]) for w, p, m in sides) / H for i in range(len(sides[0][1]))]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    length = sqrt(sum(x * x for x in a))
    return [x / length for x in a]


def arm(t):
    return [o + a * sin(2 * pi * SWINGS * t + p) for a, o, p in ARM.values()]


def centre(t):
    """The path of the centre of mass in the world."""
    phi = 2 * pi * t / LAP
    return [RADIUS * sin(phi), -RADIUS * cos(phi), HEIGHT + RISE * sin(2 * phi)]


def axes(t):
    """The body's axes in the world: z along the thrust, x as near as possible to the path."""
    up = rate(lambda s: rate(centre, s), t)
    z = unit([up[0], up[1], up[2] + G])
    ahead = [cos(2 * pi * t / LAP), sin(2 * pi * t / LAP), 0]
    y = unit(cross(z, ahead))
    return cross(y, z) + y + z


def centre_in_body(t):
    """The centre of mass of all links, in the body's axes."""
    shoulder, elbow = arm(t)
    both = shoulder + elbow
    bend = [0.03 + 0.22 * cos(shoulder), -0.06 - 0.22 * sin(shoulder)]
    upper = [0.03 + 0.11 * cos(shoulder), -0.06 - 0.11 * sin(shoulder)]
    fore = [bend[0] + 0.09 * cos(both), bend[1] - 0.09 * sin(both)]
    mass = 1.6 + 0.3 + 0.2
    return [(0.3 * upper[0] + 0.2 * fore[0]) / mass, 0, (1.6 * 0.01 + 0.3 * upper[1] + 0.2 * fore[1]) / mass]


def place(t):
    """The place of the body's origin in the world."""
    r, c, p = axes(t), centre_in_body(t), centre(t)
    return [p[i] - sum(r[3 * j + i] * c[j] for j in range(3)) for i in range(3)]


def quaternion(t):
    """The body's rotation as x, y, z, w, by the trace, or by z where the trace is small."""
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = [axes(t)[k : k + 3] for k in (0, 3, 6)]
    if xx + yy + zz > 0:
        w = sqrt(1 + xx + yy + zz) / 2
        return [(yz - zy) / (4 * w), (zx - xz) / (4 * w), (xy - yx) / (4 * w), w]
    z = sqrt(1 - xx - yy + zz) / 2
    return [(zx + xz) / (4 * z), (yz + zy) / (4 * z), z, (xy - yx) / (4 * z)]


def velocity(t):
    """Velocity of the origin and angular velocity in the body's axes, rates of the arm."""
    r, dr, dp = axes(t), rate(axes, t), rate(place, t)
    along = [sum(r[3 * j + i] * dp[i] for i in range(3)) for j in range(3)]
    turn = [sum(dr[3 * j + i] * r[3 * k + i] for i in range(3)) for j, k in ((1, 2), (2, 0), (0, 1))]
    return along + turn + rate(arm, t)


def efforts(bgdyn, times):
    """Efforts at every velocity, by inverse dynamics."""
    states = [{"q": place(t) + quaternion(t) + arm(t), "v": velocity(t), "a": rate(velocity, t)} for t in times]
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump({"states": states}, file)
        file.flush()
        command = [bgdyn, "eval", HERE / "quadrotor_arm.yaml", "inverse_dynamics", "--states", file.name]
        return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["results"]


def inputs(effort):
    """Thrust of each propeller, moment of their drags, torques of the arm."""
    thrust, (mx, my, mz) = effort[2], effort[3:6]
    of = lambda x, y, s: (thrust + (y * mx - x * my) / D + s * mz / C) / 4
    thrusts = {f"{name}_propeller_fz": of(*signs) for name, signs in ROTORS.items()}
    return thrusts | {"drag_mz": mz, "shoulder": effort[6], "elbow": effort[7]}


HEAD = """# Written by plan_flight.py. The inputs of the propellers are tables, without feedback. The arm follows its
# plan by springs and dampers with a moving reference.
scene: 1
mechanism: quadrotor_arm.yaml
description: A quadrotor flies a circle and swings its arm, by thrusts that were planned with inverse dynamics

effects:
  - gravity
  - inertia
  - velocity_products
  - front_left_propeller: { type: wrench, at: front_left, axes: link, components: [fz] }
  - front_right_propeller: { type: wrench, at: front_right, axes: link, components: [fz] }
  - hind_left_propeller: { type: wrench, at: hind_left, axes: link, components: [fz] }
  - hind_right_propeller: { type: wrench, at: hind_right, axes: link, components: [fz] }
  - drag: { type: wrench, at: body, axes: link, components: [mz] }   # of the four propellers
  - shoulder_spring: { type: spring, joint: shoulder, stiffness: 20 N*m/rad, reference: shoulder_plan }
  - shoulder_damper: { type: damper, joint: shoulder, damping: 1 N*m*s/rad, reference: shoulder_plan }
  - elbow_spring: { type: spring, joint: elbow, stiffness: 10 N*m/rad, reference: elbow_plan }
  - elbow_damper: { type: damper, joint: elbow, damping: 0.3 N*m*s/rad, reference: elbow_plan }
"""
OUTPUTS = """outputs:
  - shoulder
  - elbow
  - free_x
  - free_y
  - free_z
  - free_qx
  - free_qy
  - free_qz
  - free_qw
  - front_left
  - front_right
  - hind_left
  - hind_right
  - shoulder_place
  - elbow_place
  - tool
"""


def start():
    """The initial state of the scene."""
    p, q, v = place(0), quaternion(0), velocity(0)
    pose = ", ".join(f"{x:.12f}" for x in p), ", ".join(f"{x:.12f}" for x in q)
    text = f"initial:\n  free: {{ xyz: [{pose[0]}], quaternion: [{pose[1]}] }}\n"
    for name, x in zip(("x", "y", "z", "rx", "ry", "rz"), v):
        text += f"  free_{name}_velocity: {x:.12f}\n"
    for name, x, w in zip(ARM, arm(0), v[6:]):
        text += f"  {name}: {x:.12f}\n  {name}_rate: {w:.12f}\n"
    return text


def servos():
    """The planned angles of the arm, references of its springs and dampers."""
    of = "  {}_plan: {{ harmonic: {{ amplitude: {}, offset: {}, frequency: {:.15f}, phase: {:.15f} }} }}\n"
    return "".join(of.format(name, a, o, SWINGS, p) for name, (a, o, p) in ARM.items())


def table(name, points):
    rows = [f"[{t:.2f} s, {u:.6f}]" for t, u in points]
    lines = [", ".join(rows[i : i + 6]) for i in range(0, len(rows), 6)]
    return f"  {name}:\n    table: [\n      " + ",\n      ".join(lines) + "\n    ]\n"


def main():
    count = round(LAP / STEP)
    times = [STEP * i for i in range(-1, count + 2)]
    found = efforts(sys.argv[1], times)
    sideways = max(abs(f) for effort in found for f in effort[:2])
    rows = [inputs(effort) for effort in found]
    thrusts = [row[f"{name}_propeller_fz"] for row in rows for name in ROTORS]
    print(f"force across the thrust: at most {sideways:.1e} N, which no propeller can give")
    print(f"thrust of a propeller: {min(thrusts):.2f} to {max(thrusts):.2f} N")
    text = HEAD + start() + OUTPUTS
    text += f"integration: {{ method: rk4, step: 2 ms, end: {LAP} s }}\ninputs:\n" + servos()
    for name in rows[0]:
        u = [row[name] for row in rows]
        # Straight lines between these points have the mean of the curve: u less u'' h²/12.
        fitted = [u[i] - (u[i + 1] - 2 * u[i] + u[i - 1]) / 12 for i in range(1, count + 2)]
        text += table(name, zip(times[1:], fitted))
    (HERE / "quadrotor_arm.scene.yaml").write_text(text)


if __name__ == "__main__":
    main()
