"""Plans the motion of the Stewart platform, and writes stewart_platform.scene.yaml.

The pose of the platform gives the length l of each leg in closed form. Each leg is pushed by a spring with a moving
reference and braked by a damper. The reference is l + (f + d l̇)/k, with the push f that carries the weight of
platform and legs, found by virtual work, and what the damper takes. Inertia and friction are not planned for, and
nothing is fed back: the platform follows with an error.

    python3 examples/closed_machines/plan_legs.py
"""

from math import asin, atan2, cos, pi, radians, sin
from pathlib import Path

from tree import AXES, Tree, about, apply, distance

HERE = Path(__file__).parent
MACHINE = Tree(HERE / "../../specs/loops/stewart_platform.yaml")
G, HEIGHT = 9.81, 0.7  # m/s²; m, of the platform in the middle pose
# The moves: start and duration in s, and their sizes.
HEAVE, ROLL, CIRCLE = (0.4, 2.0), (2.5, 2.0), (4.6, 3.0)
RISE, LEAN, RADIUS = 0.07, radians(12), 0.1
STIFFNESS, DAMPING = 40e3, 600.0  # N/m, N·s/m
STEP, END, H = 0.02, 8.0, 1e-4  # s: between points of the tables, of the run, of differences
POSE = ("px_position", "py_position", "pz_position", "yaw_angle", "pitch_angle", "platform_angle")
LEGS = [f"leg{k}_length_position" for k in range(1, 7)]


def smooth(x):
    """From 0 to 1 with three zero derivatives at both ends."""
    x = min(max(x, 0.0), 1.0)
    return x**4 * (35 + x * (-84 + x * (70 - 20 * x)))


def swing(move, t):
    """Once up, once down and back, between rests."""
    return sin(2 * pi * smooth((t - move[0]) / move[1]))


def pose(t):
    """x, y, z, yaw, pitch, roll of the platform."""
    phi = 2 * pi * smooth((t - CIRCLE[0]) / CIRCLE[1])
    place = [RADIUS * sin(phi), RADIUS * (1 - cos(phi)), HEIGHT + RISE * swing(HEAVE, t)]
    return place + [0.0, 0.0, LEAN * swing(ROLL, t)]


def balls(pose):
    """For each leg its foot on the base and the ball on the platform, in the world."""
    poses = MACHINE.poses(dict.fromkeys(MACHINE.joints, 0.0) | dict(zip(POSE, pose)))
    for k, loop in enumerate(MACHINE.spec["loops"], 1):
        yield poses[f"leg{k}_x"][1], apply(poses["platform"], loop["b"]["origin"]["xyz"])


def lengths(pose):
    return [distance(foot, ball) for foot, ball in balls(pose)]


def closed(pose):
    """All joints."""
    q = dict(zip(POSE, pose))
    for k, (foot, ball) in enumerate(balls(pose), 1):
        long = distance(foot, ball)
        x, y, z = [(b - a) / long for a, b in zip(foot, ball)]
        q |= {f"leg{k}_x_angle": atan2(-y, z), f"leg{k}_y_angle": asin(x), f"leg{k}_length_position": long}
    return q


def weight_energy(pose):
    poses = MACHINE.poses(closed(pose))
    bodies = [link for link in MACHINE.spec["links"] if "mass" in link]
    return sum(G * link["mass"] * apply(poses[link["name"]], link["com"])[2] for link in bodies)


def slopes(f, pose):
    """The derivatives of a list of numbers along x, y, z, yaw, pitch, roll."""
    moved = lambda j, s: [x + s * (i == j) for i, x in enumerate(pose)]
    return [[(a - b) / (2 * H) for a, b in zip(f(moved(j, H)), f(moved(j, -H)))] for j in range(6)]


def carried(pose):
    """The push of each leg that carries the weight: its work is that of the weight in each small motion."""
    return solved([a + b for a, b in zip(slopes(lengths, pose), slopes(lambda p: [weight_energy(p)], pose))])


def solved(rows):
    """The solution of linear equations, each row with its right side at the end."""
    count = len(rows)
    for i in range(count):
        best = max(range(i, count), key=lambda k: abs(rows[k][i]))
        rows[i], rows[best] = rows[best], rows[i]
        rows[i] = [x / rows[i][i] for x in rows[i]]
        rows = [row if k == i else [x - row[i] * y for x, y in zip(row, rows[i])] for k, row in enumerate(rows)]
    return [row[count] for row in rows]


def reference(t):
    """The length of each leg, and what its spring is shortened by."""
    before, after = lengths(pose(t - H)), lengths(pose(t + H))
    pushes = [f + DAMPING * (b - a) / (2 * H) for f, a, b in zip(carried(pose(t)), before, after)]
    return [l + f / STIFFNESS for l, f in zip(lengths(pose(t)), pushes)]


HEAD = """# Written by plan_legs.py: the references of the legs' springs.
scene: 1
mechanism: ../../specs/loops/stewart_platform.yaml
description: A Stewart platform heaves, rolls and circles, pushed by its six legs

# The platform's six velocities are independent: the loops make all joints of the legs dependent.
effects:
  - gravity
  - inertia
  - velocity_products
"""


def table(name, times, values):
    value = [f"{v:.8f}" for v in values]
    last = len(value) - 1
    # Of equal points the first and the last are enough.
    kept = [i for i in range(last + 1) if not 0 < i < last or not value[i - 1] == value[i] == value[i + 1]]
    points = [f"[{times[i]:.2f} s, {value[i]}]" for i in kept]
    lines = [", ".join(points[i : i + 6]) for i in range(0, len(points), 6)]
    return f"  {name}:\n    table: [\n      " + ",\n      ".join(lines) + "\n    ]\n"


def main():
    text = HEAD
    for k, name in enumerate(LEGS, 1):
        text += f"  - push{k}: {{ type: spring, joint: {name}, stiffness: {STIFFNESS:g} N/m, reference: plan{k} }}\n"
    joints = f"joints: [{', '.join(LEGS)}]"
    text += f"  - brake:\n      type: damper\n      {joints}\n      damping: {DAMPING:g} N*s/m\n"
    text += f"  - seal:\n      type: lugre\n      {joints}\n      stiffness: 20000 N/m\n      damping: 60 N*s/m\n"
    text += "      viscous: 30 N*s/m\n      kinetic: 6 N\n\ninitial: { "
    text += ", ".join(f"{name}: {x:g}" for name, x in zip(POSE, pose(0))) + " }\n"
    text += "outputs:\n" + "".join(f"  - {name}\n" for name in MACHINE.joints + [f"{name}_rate" for name in LEGS])
    text += f"integration: {{ method: rk4, step: 2 ms, end: {END:g} s }}\ninputs:\n"
    times = [STEP * i for i in range(round(END / STEP) + 1)]
    rows = [reference(t) for t in [-STEP] + times + [END + STEP]]
    for k in range(6):
        # Straight lines between these points have the mean of the curve: u less u'' h²/12.
        fitted = [(14 * b[k] - a[k] - c[k]) / 12 for a, b, c in zip(rows, rows[1:], rows[2:])]
        text += table(f"plan{k + 1}", times, fitted)
    (HERE / "stewart_platform.scene.yaml").write_text(text)


if __name__ == "__main__":
    main()
