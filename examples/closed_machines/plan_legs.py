"""Plans the motion of the Stewart platform, and writes stewart_platform.scene.yaml.

The pose of the platform gives the length of each leg in closed form; the lengths become the references of the
six controllers. Nothing else is planned: the platform follows with an error, under its weight and its inertia.

    python3 examples/closed_machines/plan_legs.py
"""

from math import cos, pi, radians, sin, sqrt
from pathlib import Path

from tree import AXES, about, times

HERE = Path(__file__).parent
# The platform: radii of the balls and their height in its axes, radius of the pivots of the base, in m. The
# azimuths of legs 1 to 6 below and above, in degrees.
ABOVE, SUNK, BELOW = 0.3, -0.04, 0.5
FEET, HEADS = (-15, 15, 105, 135, 225, 255), (-45, 45, 75, 165, 195, 285)
HEIGHT = 0.7  # m, of the platform at rest
# The moves: start and duration in s.
HEAVE, ROLL, CIRCLE = (0.4, 1.6), (2.2, 1.6), (4.0, 2.6)
RISE, LEAN, RADIUS = 0.07, radians(12), 0.1
STIFFNESS, DAMPING, GREASE = 60e3, 500.0, 100.0  # N/m and N·s/m of a controller, N·s/m of a leg's own friction
STEP, END = 0.01, 7.2  # s: between points of the tables; of the run


def smooth(x):
    """From 0 to 1 with three zero derivatives at both ends."""
    x = min(max(x, 0.0), 1.0)
    return x**4 * (35 + x * (-84 + x * (70 - 20 * x)))


def swing(move, t):
    """Once up, once down and back, between rests."""
    return sin(2 * pi * smooth((t - move[0]) / move[1]))


def pose(t):
    """Place of the platform, its roll."""
    phi = 2 * pi * smooth((t - CIRCLE[0]) / CIRCLE[1])
    place = [RADIUS * sin(phi), RADIUS * (1 - cos(phi)), HEIGHT + RISE * swing(HEAVE, t)]
    return place, LEAN * swing(ROLL, t)


def heads(place, turn):
    """The balls of the platform in the world, for its place and rotation."""
    found = []
    for azimuth in HEADS:
        r = [ABOVE * cos(radians(azimuth)), ABOVE * sin(radians(azimuth)), SUNK]
        found.append([place[i] + sum(turn[i][k] * r[k] for k in range(3)) for i in range(3)])
    return found


def feet():
    return [[BELOW * cos(radians(a)), BELOW * sin(radians(a)), 0.0] for a in FEET]


def legs(place, turn):
    """The length of each leg."""
    return [sqrt(sum((x - y) ** 2 for x, y in zip(a, b))) for a, b in zip(heads(place, turn), feet())]


def plan(t):
    place, roll = pose(t)
    return legs(place, about(AXES["x"], roll))


HEAD = """# Written by plan_legs.py: the tables of the legs' lengths.
scene: 1
mechanism: ../../specs/loops/stewart_platform.yaml
description: A Stewart platform heaves, rolls and circles, driven by its six legs

effects:
  - gravity
  - inertia
  - velocity_products
  # The slides of the legs follow from the platform's six velocities.
  - grease: { type: viscous, joints: [LEGS], damping: GREASE N*s/m }

# The platform is independent: x, y, height, yaw, pitch, roll.
"""


def main():
    names = [f"leg{k}_length_position" for k in range(1, 7)]
    text = HEAD.replace("LEGS", ", ".join(names)).replace("GREASE", f"{GREASE:g}")
    text += f"initial: {{ pz_position: {HEIGHT} }}\n"
    text += f"integration: {{ method: rk4, step: 1 ms, end: {END:g} s }}\ninputs:\n"
    times_ = [STEP * i for i in range(round(END / STEP) + 1)]
    for k, name in enumerate(names):
        fit = lambda t: (14 * plan(t)[k] - plan(t - STEP)[k] - plan(t + STEP)[k]) / 12
        points = [f"[{t:.3f} s, {fit(t):.7f}]" for t in times_]
        lines = [", ".join(points[i : i + 6]) for i in range(0, len(points), 6)]
        text += f"  {name}:\n    pd:\n      stiffness: {STIFFNESS:g}\n      damping: {DAMPING:g}\n"
        text += "      target:\n        table: [\n          " + ",\n          ".join(lines) + "\n        ]\n"
    (HERE / "stewart_platform.scene.yaml").write_text(text)


if __name__ == "__main__":
    main()
