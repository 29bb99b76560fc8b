"""Plans a figure of eight of the robot with two wheels, and writes robot_path.scene.yaml.

Neither wheel slips: on a path with the length s and the heading θ, wheels with the radius R, each at the distance B
from the middle of the axle, turn by (s ± B θ) / R. These angles r are followed by computed torque, with the
acceleration d (ẇ - q̇) + k (w - q): a table w has no acceleration between its points, and that of the plan would be
missing. So the tables are not the plan but w = r + y, where d ẏ + k y = r̈. On the plan, q = r, the acceleration is r̈.

    python3 examples/rolling_machines/plan_path.py
"""

from math import atan2, cos, hypot, pi, sin
from pathlib import Path

HERE = Path(__file__).parent
RADIUS, HALF = 0.1, 0.25  # m: of the wheels, and from the middle of the axle to a wheel
LONG, WIDE = 2.0, 0.8  # m: half of the figure's length and of its width
WAIT, WAY, END = 0.5, 13.0, 14.5  # s: before the start, for the path, of the run
STIFFNESS, DAMPING = 100.0, 20.0  # 1/s², 1/s: an error e decays as (1 + 10 t) exp(-10 t)
BEARING = 0.02  # N·m·s/rad of each wheel
STEP, PARTS, H = 0.02, 40, 1e-4  # s between points of the tables, parts of it to integrate, s of differences
NODES = 2000


def share(t):
    """Of the path, from 0 to 1: an even speed between two soft ends, each a quarter of the time."""
    x, soft = min(max((t - WAIT) / WAY, 0.0), 1.0), 0.25
    late = x > 0.5
    x = 1 - x if late else x
    y = min(x / soft, 1.0)
    found = (soft * y**4 * (2.5 + y * (y - 3)) + max(x - soft, 0.0)) / (1 - soft)
    return 1 - found if late else found


def along(p):
    """First and second derivatives of the place with respect to the angle p of the figure."""
    return (LONG * cos(p), 2 * WIDE * cos(2 * p)), (-LONG * sin(p), -4 * WIDE * sin(2 * p))


def heading(p):
    """Continuous along the figure: between -270 and 90 degrees."""
    (x, y), _ = along(p)
    found = atan2(y, x)
    return found - 2 * pi if found > pi / 2 else found


def simpson(a, b):
    rate = lambda p: hypot(*along(p)[0])
    return (b - a) / 6 * (rate(a) + 4 * rate((a + b) / 2) + rate(b))


NODE = [2 * pi * i / NODES for i in range(NODES + 1)]
LENGTH = [0.0]
for a, b in zip(NODE, NODE[1:]):
    LENGTH.append(LENGTH[-1] + simpson(a, b))


def pose(t):
    """Place of the middle of the axle, and heading."""
    p = 2 * pi * share(t)
    return [LONG * sin(p), WIDE * sin(2 * p), heading(p)]


def wheels(length, turn):
    return [(length + HALF * turn) / RADIUS, (length - HALF * turn) / RADIUS]


def plan(t):
    """The angles of the right and of the left wheel."""
    p = 2 * pi * share(t)
    k = min(int(p / (2 * pi) * NODES), NODES - 1)
    return wheels(LENGTH[k] + simpson(NODE[k], p), heading(p) - heading(0))


def motion(t):
    """Speed ahead, and of turning."""
    p, fast = 2 * pi * share(t), 2 * pi * (share(t + H) - share(t - H)) / (2 * H)
    (x, y), (xx, yy) = along(p)
    return [hypot(x, y) * fast, (x * yy - y * xx) / (x * x + y * y) * fast]


def changes(t):
    """The derivatives of both."""
    return [(b - a) / (2 * H) for a, b in zip(motion(t - H), motion(t + H))]


def leading():
    """The tables: times, and the plan with its lead y, integrated by the trapezoidal rule."""
    step = STEP / PARTS
    y, before, rows = [0.0] * 2, [0.0] * 2, []
    for n in range(round(END / STEP) * PARTS + 2 * PARTS + 1):
        t = n * step
        now = wheels(*changes(t))
        fade = step * STIFFNESS / DAMPING / 2
        y = [((1 - fade) * u + step / DAMPING * (a + b) / 2) / (1 + fade) for u, a, b in zip(y, before, now)]
        before = now
        if n % PARTS == 0:
            rows.append([r + u for r, u in zip(plan(t), y)])
    first = [2 * a - b for a, b in zip(rows[0], rows[1])]
    # Straight lines between these points have the mean of the curve: u less u'' h²/12.
    fit = lambda a, b, c: [v - (u - 2 * v + w) / 12 for u, v, w in zip(a, b, c)]
    return [(STEP * i, fit(*three)) for i, three in enumerate(zip([first] + rows, rows, rows[1:]))]


HEAD = f"""# Written by plan_path.py: the tables of the wheels' angles. The way of the robot follows, because no wheel slips.
scene: 1
mechanism: ../../specs/constraints/differential_drive.yaml
description: A robot with two wheels rolls round a figure of eight, by computed torque at its wheels

effects:
  - gravity
  - inertia
  - velocity_products
  - bearings: {{ type: viscous, joints: [right, left], damping: {BEARING:g} N*m*s/rad }}

initial: {{ base_turn: {heading(0):.15f} rad }}
outputs:
  - base_x
  - base_y
  - base_turn
  - right
  - left
  - base_x_velocity
  - base_y_velocity
  - base_turn_rate
  - right_rate
  - left_rate
integration: {{ method: rk4, step: 2 ms, end: {END:g} s }}
inputs:
"""


def main():
    text, rows = HEAD, leading()
    for k, name in enumerate(("right", "left")):
        points = [f"[{t:.2f} s, {r[k] + 0.0:.7f}]".replace("-0.0000000", "0.0000000") for t, r in rows]
        value = [p.split(", ")[1] for p in points]
        last = len(points) - 1
        # Of equal points the first and the last are enough.
        kept = [p for i, p in enumerate(points) if not 0 < i < last or not value[i - 1] == value[i] == value[i + 1]]
        lines = [", ".join(kept[i : i + 6]) for i in range(0, len(kept), 6)]
        text += f"  {name}:\n    computed_torque:\n      stiffness: {STIFFNESS:g}\n      damping: {DAMPING:g}\n"
        text += "      target:\n        table: [\n          " + ",\n          ".join(lines) + "\n        ]\n"
    (HERE / "robot_path.scene.yaml").write_text(text)


if __name__ == "__main__":
    main()
