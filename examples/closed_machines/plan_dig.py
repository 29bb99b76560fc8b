"""Plans a dig of the excavator, and writes excavator.scene.yaml.

Boom, stick and rocker follow smooth angles. The loop of the bucket and the three rams are closed in plain Python;
by virtual work follow the force that weight and earth ask of each ram, and by the law of its valve the opening for its
speed. The torque of the slew is moment of inertia times acceleration, and friction. Nothing is fed back, and the
masses' inertia is left out for the rams: the run shows how far the plan holds.

    python3 examples/closed_machines/plan_dig.py
"""

from math import atan2, cos, hypot, radians, sin, sqrt
from pathlib import Path

from tree import Tree, apply, distance

HERE = Path(__file__).parent
MACHINE = Tree(HERE / "../../specs/loops/excavator.yaml")
G, STEP, H, END = 9.81, 0.1, 1e-4, 12.0  # m/s²; s: between points of the tables, of differences, of the run
# Start, duration and turn of the moves of each joint, in s and degrees.
BEGIN = {"slew": 0, "lift": 10, "fold": -50, "rocker_angle": 25}
MOVES = {
    "lift": [(0.5, 5.2, 11), (6.0, 4.2, 25)],
    "fold": [(0.5, 5.4, -50), (6.4, 3.8, -26)],
    "rocker_angle": [(0.5, 3.6, -30), (3.4, 3.2, -43)],
    "slew": [(6.7, 4.8, 100)],
}
# The earth resists the teeth where they are below the ground, z = 0: most N, the depth for it, the speed for half.
EARTH, DEPTH, SLOW = 8000.0, 0.3, 0.05
MASS, MIDDLE = 150.0, [0.35, 0, 0.1]  # kg of earth in the bucket, its place there
# Each ram: the frames at its ends, areas of its sides in m², the valve's k in m³/(s·√Pa).
RAMS = {
    "lift": ("lift_foot", "lift_head", 78.54e-4, 50.27e-4, 2.5e-7),
    "fold": ("fold_foot", "fold_head", 63.62e-4, 39.86e-4, 2e-7),
    "curl": ("curl_foot", "curl_head", 50.27e-4, 30.63e-4, 2e-7),
}
SUPPLY, BACK = 20e6, 5e6  # Pa: of the pump, and of the rods' sides at the start
SLEW_FRICTION = 2000.0
DRIVEN = ("lift", "fold", "rocker_angle")


def smooth(x):
    """From 0 to 1: an even speed between two soft ends."""
    x, soft = min(max(x, 0.0), 1.0), 0.35
    if x > 0.5:
        return 1 - smooth(1 - x)
    y = min(x / soft, 1.0)
    return (soft * (y**3 - y**4 / 2) + max(x - soft, 0.0)) / (1 - soft)


def closed(q):
    """All joints, with those of the bucket's loop: two circles meet in its pin."""
    rocker = q["rocker_angle"]
    head, pivot = (1.36 - 0.3 * sin(rocker), 0.3 * cos(rocker)), (1.6, 0.0)
    across, reach = hypot(pivot[0] - head[0], pivot[1] - head[1]), hypot(0.06, 0.264)
    along = (across**2 + 0.336**2 - reach**2) / (2 * across)
    aside = sqrt(0.336**2 - along**2)
    x, z = (pivot[0] - head[0]) / across, (pivot[1] - head[1]) / across
    pin = (head[0] + along * x - aside * z, head[1] + along * z + aside * x)
    coupler = atan2(pin[1] - head[1], pin[0] - head[0]) - rocker
    bucket = atan2(pin[1] - pivot[1], pin[0] - pivot[0]) - atan2(0.264, 0.06)
    return q | {"coupler_angle": coupler, "bucket_angle": bucket}


def plan(t):
    """The independent joints."""
    course = lambda name: BEGIN[name] + sum(by * smooth((t - at) / long) for at, long, by in MOVES[name])
    return {name: radians(course(name)) for name in BEGIN}


def bodies():
    """Name, mass and place of each body, and its tensor."""
    for link in MACHINE.spec["links"]:
        yield link["name"], link["mass"], link["com"], link["inertia"]
    yield "bucket", MASS, MIDDLE, {}


def height_energy(poses):
    return sum(G * mass * apply(poses[name], com)[2] for name, mass, com, _ in bodies())


def moment_of_inertia(t):
    """About the axis of the slew."""
    poses, total = MACHINE.poses(closed(plan(t))), 0.0
    for name, mass, com, tensor in bodies():
        x, y, _ = apply(poses[name], com)
        up = poses[name][0][2]
        entry = lambda i, j: tensor.get("".join("xyz"[k] for k in sorted((i, j))) * (1 if i != j else 1), 0.0)
        total += mass * (x * x + y * y) + sum(up[i] * up[j] * entry(i, j) for i in range(3) for j in range(3))
    return total


def lengths(poses):
    return {ram: distance(poses[a][1], poses[b][1]) for ram, (a, b, *_) in RAMS.items()}


def rate(f, t):
    return (f(t + H) - f(t - H)) / (2 * H)


def resistance(t):
    """The force of the earth on the teeth, in world axes."""
    teeth = lambda s: MACHINE.poses(closed(plan(s)))["teeth"][1]
    below = min(max(-teeth(t)[2] / DEPTH, 0.0), 1.0)
    v = [(a - b) / (2 * H) for a, b in zip(teeth(t + H), teeth(t - H))]
    return [-EARTH * below * x / (hypot(*v) + SLOW) for x in v]


def forces(q, earth):
    """The force of each ram that weight and earth ask for: work in small turns of boom, stick and rocker."""
    size, rows = 1e-5, []
    for joint in DRIVEN:
        ends = [MACHINE.poses(closed(q | {joint: q[joint] + s * size})) for s in (1, -1)]
        work = height_energy(ends[0]) - height_energy(ends[1])
        work -= sum(f * (a - b) for f, a, b in zip(earth, ends[0]["teeth"][1], ends[1]["teeth"][1]))
        longer = [a - b for a, b in zip(lengths(ends[0]).values(), lengths(ends[1]).values())]
        rows.append(longer + [work])
    # A turn of the boom moves the ram of the boom alone, one of the stick that of the stick, and so on.
    return {ram: rows[k][3] / rows[k][k] for k, ram in enumerate(RAMS)}


def opening(ram, speed, force):
    """Of the four-way valve: Δp = (A v/(k x))² at both paths, p_a A_a - p_b A_b = f."""
    _, _, a, b, k = RAMS[ram]
    left = SUPPLY * a - force if speed > 0 else SUPPLY * b + force
    return speed / k * sqrt((a**3 + b**3) / left)


def row(t):
    """What the tables say at a time."""
    earth = resistance(t)
    asked = forces(closed(plan(t)), earth)
    long = lambda ram: lambda s: lengths(MACHINE.poses(closed(plan(s))))[ram]
    found = {f"{ram}_valve": opening(ram, rate(long(ram), t), asked[ram]) for ram in RAMS}
    spin = lambda s: rate(lambda r: plan(r)["slew"], s)
    found["slew"] = rate(lambda s: moment_of_inertia(s) * spin(s), t) + SLEW_FRICTION * spin(t)
    return found | {"digging_fx": earth[0], "digging_fz": earth[2]}


HEAD = f"""# Written by plan_dig.py: the tables of valves, slew and earth, without feedback.
scene: 1
mechanism: ../../specs/loops/excavator.yaml
description: The excavator digs, curls its bucket, lifts {MASS:g} kg of earth and slews

effects:
  - gravity
  - inertia
  - velocity_products
  - slew_friction
  - pins
  - earth: {{ com: {MIDDLE} }}
  - digging: {{ type: wrench, at: teeth, components: [fx, fz] }}
  - hydraulics

"""
OUTPUTS = """outputs:
  - slew
  - lift
  - fold
  - rocker_angle
  - coupler_angle
  - bucket_angle
  - teeth
"""


def table(name, rows, digits):
    points = [f"[{t:.1f} s, {u[name] + 0.0:.{digits}f}]".replace("-" + f"{0:.{digits}f}", f"{0:.{digits}f}") for t, u in rows]
    # Of equal points the first and the last are enough.
    value = [p.split(", ")[1] for p in points]
    last = len(points) - 1
    kept = [p for i, p in enumerate(points) if not 0 < i < last or not value[i - 1] == value[i] == value[i + 1]]
    lines = [", ".join(kept[i : i + 7]) for i in range(0, len(kept), 7)]
    return f"  {name}:\n    table: [\n      " + ",\n      ".join(lines) + "\n    ]\n"


def main():
    text, q = HEAD + "initial:\n", closed(plan(0))
    for name in DRIVEN:
        text += f"  {name}: {BEGIN[name]} deg\n"
    for ram, force in forces(q, [0, 0, 0]).items():
        _, _, a, b, _ = RAMS[ram]
        text += f"  {ram}_ram_a: {(force + BACK * b) / a / 1e6:.6f} MPa\n  {ram}_ram_b: {BACK / 1e6:g} MPa\n"
    text += OUTPUTS
    for ram in RAMS:
        text += "".join(f"  - {ram}_ram_{what}\n" for what in ("length", "force", "a_pressure", "b_pressure"))
    text += f"integration: {{ method: rk4, step: 0.5 ms, end: {END:g} s }}\ninputs:\n"
    rows = [(STEP * i, row(STEP * i)) for i in range(round(END / STEP) + 1)]
    for name in rows[0][1]:
        text += table(name, rows, 5 if name.endswith("valve") else 1)
    (HERE / "excavator.scene.yaml").write_text(text)


if __name__ == "__main__":
    main()
