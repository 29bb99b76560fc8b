"""Measures the five runs and draws them.

    python3 examples/free_machines/figures.py bgdyn runs [--draw] [MACHINE …]

reads the tables that `bgdyn simulate … --out runs` wrote and prints the facts of README.md. With `--draw`
it also writes the pictures next to it.
"""

import re
import sys
from itertools import accumulate
from math import acos, atan2, cos, degrees, pi, radians, sin, sqrt

import plan_flight
from canvas import BLUE, BROWN, GREEN, GREY, INK, PALE, RED, SHADE, Canvas, Plot, fact, write
from runs import HERE, Run, momenta, turned

G = 9.81


def norm(r):
    return sqrt(sum(x * x for x in r))


def less(a, b):
    return [x - y for x, y in zip(a, b)]


def viewed(turn, rise, scale, origin):
    """A parallel projection of the world onto the page, from `turn` and `rise` in degrees."""
    ct, st, cr, sr = cos(radians(turn)), sin(radians(turn)), cos(radians(rise)), sin(radians(rise))

    def project(r):
        across, away = -st * r[0] + ct * r[1], ct * r[0] + st * r[1]
        return (origin[0] + scale * across, origin[1] - scale * (cr * r[2] - sr * away))

    return project


# The spherical pendulum ---------------------------------------------------------------------------------


def spherical_pendulum(bgdyn, folder):
    run = Run(folder, "spherical_pendulum")
    rows = range(len(run.t))
    qs = [run.quaternion("ball", i) for i in rows]
    vs = [run.row([f"ball_r{axis}_velocity" for axis in "xyz"], i) for i in rows]
    ps = momenta(bgdyn, run.name, qs, vs)
    height = [run.place("disc", i)[2] for i in rows]
    energy = [sum(a * b for a, b in zip(v, p)) / 2 + 2 * G * z for v, p, z in zip(vs, ps, height)]
    about_gravity = [turned(q, p)[2] for q, p in zip(qs, ps)]
    across = [sqrt(run["disc_x"][i] ** 2 + run["disc_y"][i] ** 2) for i in rows]
    tilt = [degrees(atan2(across[i], height[i])) for i in rows]
    passes = [i for i in rows[1:-1] if tilt[i - 1] > tilt[i] <= tilt[i + 1] and tilt[i] < 20]
    fact(f"over the pole {len(passes)} times; lowest point {max(tilt):.2f}° from the pole")
    nearest = max(passing(run, i) for i in passes)
    fact(f"path of the disc passes the pole at {nearest:.0e} m at most, by curves through the table's points")
    for what, list_, unit in (("energy", energy, "J"), ("momentum about gravity", about_gravity, "kg m²/s")):
        off = max(abs(x - list_[0]) for x in list_)
        fact(f"{what}: {list_[0]:.9f} {unit}, changes by at most {off:.1e}")
    fact(f"length of the quaternion: differs from 1 by at most {max(abs(norm(q) - 1) for q in qs):.1e}")

    page = Canvas(960, 430)
    page.text(20, 28, "Path of the disc, seen from above; the pole is in the middle", bold=True)
    centre, scale = (220, 228), 340
    spot = lambda i: (centre[0] + scale * run["disc_x"][i], centre[1] - scale * run["disc_y"][i])
    ring = [(centre[0] + scale * 0.5 * cos(a / 50 * pi), centre[1] - scale * 0.5 * sin(a / 50 * pi)) for a in range(101)]
    page.line(ring, PALE, 1.5)
    upper = [height[i] > 0 for i in rows]
    start = 0
    for i in rows[1:]:
        if upper[i] != upper[start] or i == rows[-1]:
            page.line([spot(k) for k in range(start, i + 1)], BLUE if upper[start] else SHADE, 1.8)
            start = i
    page.disc(centre, 4, RED)
    page.text(centre[0] + 8, centre[1] - 6, "pole", RED)
    page.text(20, 424, "dark: above the pivot; pale: below it", GREY, 12)
    plot = Plot(page, (520, 60, 930, 200), range(0, 13, 2), range(0, 181, 45), "Angle from the pole, degrees")
    plot.curve(run.t, tilt, BLUE)
    exponent = 1e-11
    page.text(520, 242, "blue: energy, J; brown: momentum about gravity, kg m²/s", GREY, 12)
    ticks = [-10, -5, 0, 5, 10]
    plot = Plot(page, (520, 278, 930, 395), range(0, 13, 2), ticks, "Change since the start, times 10⁻¹¹")
    plot.curve(run.t, [(e - energy[0]) / exponent for e in energy], BLUE)
    plot.curve(run.t, [(h - about_gravity[0]) / exponent for h in about_gravity], BROWN)
    write(page, HERE / "spherical_pendulum.svg")


def passing(run, i):
    """The least distance from the vertical through the pivot, on the polynomials of degree 5 through six points."""
    knots = range(i - 2, i + 4)

    def at(u, name):
        total = 0.0
        for k in knots:
            weight = 1.0
            for j in knots:
                weight *= (u - j) / (k - j) if j != k else 1.0
            total += weight * run[name][k]
        return total

    away = lambda u: sqrt(at(u, "disc_x") ** 2 + at(u, "disc_y") ** 2)
    low, high = i - 1, i + 1
    while high - low > 1e-9:
        left, right = low + (high - low) / 3, high - (high - low) / 3
        low, high = (low, right) if away(left) < away(right) else (left, high)
    return away(low)


# The satellite ------------------------------------------------------------------------------------------


def satellite(bgdyn, folder):
    run = Run(folder, "satellite")
    rows = range(len(run.t))
    positions = ["free_x", "free_y", "free_z", "free_qx", "free_qy", "free_qz", "free_qw", "shoulder", "elbow"]
    speeds = [f"free_{a}_velocity" for a in ("x", "y", "z", "rx", "ry", "rz")] + ["shoulder_rate", "elbow_rate"]
    qs, vs = [run.row(positions, i) for i in rows], [run.row(speeds, i) for i in rows]
    ps = momenta(bgdyn, run.name, qs, vs)
    linear = max(norm(p[:3]) for p in ps)
    # The total is zero, so that the angular momentum is the same about every point.
    angular = max(norm(p[3:6]) for p in ps)
    alone = max(abs(v[4]) for v in vs) * 80 * 0.8**2 / 6
    # Anticlockwise in the picture, which looks along the y axis.
    turn = [-degrees(2 * atan2(q[4], q[6])) for q in qs]
    fact(f"turn of the satellite after the cycle: {turn[-1]:.4f}°; on the way up to {max(turn):.2f}°")
    fact(f"momentum at most {linear:.1e} kg m/s, angular momentum {angular:.1e} kg m²/s")
    fact(f"the bus alone has up to {alone:.2f} kg m²/s")
    last = degrees(run["shoulder"][-1]), degrees(run["elbow"][-1])
    fact(f"arm at the end: shoulder {last[0]:.6f}°, elbow {last[1]:.6f}°; rates below {max(map(abs, vs[-1])):.1e}")
    fact(f"turn by the integral over the closed path, without time: {-around(bgdyn, run, positions):.4f}°")

    page = Canvas(960, 470)
    times = (0, 6.4, 12, 17.4, 28)
    words = ("start", "shoulder moved", "elbow bent", "shoulder back", "elbow back: end")
    for k, (t, title) in enumerate(zip(times, words)):
        i, middle = run.at(t), (90 + 188 * k, 165)
        spot = lambda r: (middle[0] + 62 * r[0], middle[1] - 62 * r[2])
        page.text(middle[0] - 70, 28, title, bold=True)
        page.text(middle[0] - 70, 46, f"{t:g} s, turned by {abs(turn[i]):.1f}°", GREY, 12)
        pose = lambda r: spot([a + b for a, b in zip(run.place("free", i), turned(qs[i][3:7], r))])
        page.line([spot(run.place("tool", j)) for j in range(run.at(times[max(k - 1, 0)]), i + 1)], BROWN, 1.2, "2 3")
        page.line([(middle[0] - 70, middle[1]), (middle[0] + 70, middle[1])], PALE, 1)
        box = [pose([x, 0, z]) for x, z in ((0.4, 0.4), (-0.4, 0.4), (-0.4, -0.4), (0.4, -0.4))]
        page.area(box, SHADE, BLUE)
        page.line([pose([-0.4, 0, 0]), pose([0.4, 0, 0])], BLUE, 1.2)
        page.line([spot(run.place(f, i)) for f in ("shoulder_place", "elbow_place", "tool")], INK, 4)
        for f in ("shoulder_place", "elbow_place"):
            page.disc(spot(run.place(f, i)), 4, BROWN)
    plot = Plot(page, (60, 300, 450, 435), range(0, 29, 4), range(-60, 141, 40), "Shoulder (blue) and elbow (brown), degrees")
    plot.curve(run.t, [degrees(x) for x in run["shoulder"]], BLUE)
    plot.curve(run.t, [degrees(x) for x in run["elbow"]], BROWN)
    plot = Plot(page, (540, 300, 930, 435), range(0, 29, 4), range(0, 81, 20), "Turn of the satellite, anticlockwise, degrees")
    plot.curve(run.t, turn, GREEN)
    write(page, HERE / "satellite.svg")


def around(bgdyn, run, names):
    """The turn as an integral over the arm's path, from mass matrices alone: −M_bb⁻¹ M_ba times the arm's steps."""
    rows = range(len(run.t))
    shapes = [(run["shoulder"][i], run["elbow"][i]) for i in rows]
    middle = [[(a + b) / 2 for a, b in zip(*pair)] for pair in zip(shapes, shapes[1:])]
    rest = [0, 0, 0, 0, 0, 0, 1]
    units = [[float(k == j) for k in range(8)] for j in (0, 2, 4, 6, 7)]
    columns = [momenta(bgdyn, run.name, [rest + m for m in middle], [u] * len(middle)) for u in units]
    total = 0.0
    for n, (before, after) in enumerate(zip(shapes, shapes[1:])):
        step = less(after, before)
        pick = lambda c: [columns[c][n][k] for k in (0, 2, 4)]
        right = [-(pick(3)[k] * step[0] + pick(4)[k] * step[1]) for k in range(3)]
        x, z, turn = pick(0), pick(1), pick(2)
        det = lambda a, b, c: (
            a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
        )
        total += det(x, z, right) / det(x, z, turn)
    return degrees(total)


# The satellite that holds its attitude ------------------------------------------------------------------

STIFFNESS, DAMPING = 40, 60


def satellite_hold(_bgdyn, folder):
    run = Run(folder, "satellite_hold")
    rows = range(len(run.t))
    qs = [run.quaternion("free", i) for i in rows]
    ws = [run.row([f"free_r{axis}_velocity" for axis in "xyz"], i) for i in rows]
    angles = [degrees(2 * atan2(norm(q[:3]), abs(q[3]))) for q in qs]
    # The law of the hold, with the target along the world's axes.
    moments = [[-2 * STIFFNESS * q[3] * q[k] - DAMPING * w[k] for k in range(3)] for q, w in zip(qs, ws)]
    begin = run.at(16)
    near = next(i for i in rows if max(angles[i:begin]) < 0.1)
    fact(f"begins {angles[0]:.3f}° away; below 0.1° after {run.t[near]:.1f} s; {angles[begin]:.1e}° when the arm begins")
    fact(f"while the arm moves it turns by at most {max(angles[begin:]):.3f}°; {angles[-1]:.1e}° at the end")
    sizes = [norm(m) for m in moments]
    fact(f"moment: {sizes[0]:.3f} N m at the start, at most {max(sizes):.1f} N m; {max(sizes[begin:]):.1f} N m under the arm")

    page = Canvas(960, 500)
    for k, t in enumerate((0, 2, 3.5, 5, 16, 24)):
        i, middle = run.at(t), (90 + 155 * k, 170)
        project = viewed(-70, 22, 50, middle)
        title = "start" if t == 0 else f"{t:g} s"
        page.text(middle[0] - 66, 28, title, bold=True)
        page.text(middle[0] - 66, 46, f"{angles[i]:.1f}° away", GREY, 12)
        orbiting(page, run, i, project)
    plot = Plot(page, (50, 330, 290, 465), range(0, 17, 4), range(0, 181, 60), "Angle from the attitude, degrees")
    plot.curve(run.t[: begin + 1], angles, BLUE)
    later = range(15, 46, 10)
    plot = Plot(page, (370, 330, 610, 465), later, range(0, 7, 2), "The same while the arm moves")
    plot.curve(run.t[begin:], angles[begin:], BLUE)
    plot = Plot(page, (690, 330, 930, 465), range(0, 46, 15), range(-15, 16, 5), "Moments, N·m")
    for axis, (name, colour) in enumerate(zip("xyz", (BLUE, BROWN, GREEN))):
        plot.curve(run.t, [m[axis] for m in moments], colour)
        page.text((800, 860, 880)[axis], 320, f"about {name}" if axis == 0 else name, colour, 12)
    write(page, HERE / "satellite_hold.svg")


def orbiting(page, run, i, project):
    """The satellite in a row of the table: the faces of its bus that are seen, its arm, the axes of its target."""
    q, middle = run.quaternion("free", i), run.place("free", i)
    for axis, colour in enumerate((BLUE, BROWN, GREEN)):
        page.line([project([0, 0, 0]), project([1.3 * (k == axis) for k in range(3)])], colour, 1, "3 3")
    spot = lambda r: project(turned(q, r))
    faces = []
    for axis in range(3):
        for side in (-0.4, 0.4):
            corner = lambda a, b: [side if k == axis else (a, b)[(k - axis) % 3 - 1] for k in range(3)]
            corners = [corner(a, b) for a, b in ((0.4, 0.4), (-0.4, 0.4), (-0.4, -0.4), (0.4, -0.4))]
            outward = turned(q, [side * (k == axis) for k in range(3)])
            faces.append((toward(outward), corners))
    arm = [project(less(run.place(f, i), middle)) for f in ("shoulder_place", "elbow_place", "tool")]
    front = toward(turned(q, [1, 0, 0])) > 0
    draw = lambda: (page.line(arm, INK, 3.5), [page.disc(p, 3.5, BROWN) for p in arm[:2]])
    if not front:
        draw()
    for depth, corners in sorted(faces):
        if depth > 0:
            page.area([spot(c) for c in corners], SHADE, BLUE)
    for axis, colour in enumerate((BLUE, BROWN, GREEN)):
        page.line([spot([0, 0, 0]), spot([0.75 * (k == axis) for k in range(3)])], colour, 2)
    if front:
        draw()


def toward(r, turn=-70, rise=22):
    """How far a vector points towards the eye of `viewed`."""
    ct, st, cr, sr = cos(radians(turn)), sin(radians(turn)), cos(radians(rise)), sin(radians(rise))
    return cr * (ct * r[0] + st * r[1]) + sr * r[2]


# The quadruped ------------------------------------------------------------------------------------------

LEGS = ("front_left", "front_right", "hind_left", "hind_right")
MASS = 12 + 4 * (1 + 1.5 + 0.5)


def anchors():
    """The places of the springs in the world, from the mechanism's file."""
    found = {}
    for line in (HERE / "quadruped.yaml").read_text().splitlines():
        if "link: world" in line:
            name, place = line.split("name: ")[1].split(",")[0], line.split("[")[1].split("]")[0]
            found[name] = [float(x) for x in place.split(",")]
    return found


def springs(run, i):
    """For each leg the forces of its three springs on the foot, without the dampers."""
    found, places = {}, anchors()
    for leg in LEGS:
        foot = run.place(f"{leg}_foot", i)
        for side, stiffness in (("below", 8000), ("behind", 3000), ("beside", 3000)):
            away = less(foot, places[f"{leg}_{side}"])
            length = norm(away)
            found[leg, side] = [-stiffness * (length - 1) * x / length for x in away]
    return found


def quadruped(_bgdyn, folder):
    run = Run(folder, "quadruped")
    rows = range(len(run.t))
    up = [sum(f[2] for f in springs(run, i).values()) for i in rows]
    weight, last = MASS * G, springs(run, rows[-1])
    fact(f"weight {weight:.6f} N; vertical force of the settled springs {up[-1]:.6f} N; most {max(up):.1f} N")
    least = min(springs(run, i)[leg, "below"][2] for i in rows[1:] for leg in LEGS)
    fact(f"no spring below a foot pulls: least force {least:.2f} N at the first point after the touch")
    fact("under the feet: " + ", ".join(f"{leg} {last[leg, 'below'][2]:.2f} N" for leg in LEGS))
    sideways = [sum(f[axis] for f in last.values()) for axis in (0, 1)]
    fact(f"horizontal forces at the end: sum {sideways[0]:.1e} and {sideways[1]:.1e} N")
    z = run["trunk_z"]
    fact(f"trunk: {z[0]:.4f} m at the start, at least {min(z):.4f} m, {z[-1]:.4f} m at the end")
    fact(f"it then moves at {abs(run['free_z_velocity'][-1]):.1e} m/s")
    fact("feet sink by " + ", ".join(f"{-1000 * run[f'{leg}_foot_z'][-1]:.2f} mm" for leg in LEGS))

    page = Canvas(960, 570)
    deepest = z.index(min(z))
    for k, (i, title) in enumerate(((0, "touch, at 0.99 m/s"), (deepest, "lowest"), (rows[-1], "settled"))):
        project = viewed(-65, 18, 270, (165 + 315 * k, 235))
        page.text(60 + 315 * k, 28, f"{run.t[i]:.2f} s: {title}", bold=True)
        standing(page, run, i, project)
    page.text(60, 340, "Green: springs and dampers to places a metre away, drawn shortened", GREY, 12)
    early, ticks = run.at(1.5), [0, 0.5, 1, 1.5]
    plot = Plot(page, (60, 400, 450, 535), ticks, range(0, 601, 150), "Vertical force of the springs, N (dashed: the weight)")
    plot.curve(run.t[:early], up, BLUE)
    plot.curve([0, 1.5], [weight] * 2, RED, 1.5, "5 4")
    plot = Plot(page, (540, 400, 930, 535), ticks, range(420, 461, 10), "Height of the trunk, mm")
    plot.curve(run.t[:early], [1000 * x for x in z], GREEN)
    write(page, HERE / "quadruped.svg")


def standing(page, run, i, project):
    """The quadruped in a row of the table, with the ends of its springs."""
    ground = [project([x, y, 0]) for x, y in ((-0.45, -0.38), (0.45, -0.38), (0.45, 0.38), (-0.45, 0.38))]
    page.area(ground, "#ffffff", PALE)
    q, middle, places = run.quaternion("free", i), run.place("trunk", i), anchors()
    for leg in ("front_left", "hind_left", "trunk", "front_right", "hind_right"):
        if leg == "trunk":
            corner = lambda x, y, z: project([a + b for a, b in zip(middle, turned(q, [x, y, z]))])
            top = [corner(x, y, 0.07) for x, y in ((0.3, 0.12), (-0.3, 0.12), (-0.3, -0.12), (0.3, -0.12))]
            side = [corner(x, -0.12, z) for x, z in ((0.3, 0.07), (-0.3, 0.07), (-0.3, -0.07), (0.3, -0.07))]
            front = [corner(0.3, y, z) for y, z in ((0.12, 0.07), (-0.12, 0.07), (-0.12, -0.07), (0.12, -0.07))]
            for face in (top, side, front):
                page.area(face, SHADE, BLUE)
            continue
        foot = run.place(f"{leg}_foot", i)
        page.line([project(run.place(f"{leg}_{part}", i)) for part in ("shoulder", "bend", "foot")], INK, 4)
        page.disc(project(run.place(f"{leg}_bend", i)), 3.5, BROWN)
        for side in ("below", "behind", "beside"):
            along = less(places[f"{leg}_{side}"], foot)
            flat = project([f + 0.1 * a for f, a in zip(foot, along)])
            coil(page, project(foot), flat)


def coil(page, a, b):
    """A spring from a to b."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    length = max(sqrt(dx * dx + dy * dy), 1e-9)
    points = [(a[0] + k / 10 * dx, a[1] + k / 10 * dy) for k in range(11)]
    for k in range(1, 10):
        out = 4 * (-1) ** k / length
        points[k] = (points[k][0] - out * dy, points[k][1] + out * dx)
    page.line(points, GREEN, 1.2)


# The quadrotor ------------------------------------------------------------------------------------------


def quadrotor_arm(_bgdyn, folder):
    run = Run(folder, "quadrotor_arm")
    rows = range(len(run.t))
    away = [1000 * norm(less(run.place("free", i), plan_flight.place(run.t[i]))) for i in rows]
    tilts = [degrees(acos(turned(run.quaternion("free", i), [0, 0, 1])[2])) for i in rows]
    servo = max(abs(run[j][i] - plan_flight.arm(run.t[i])[k]) for i in rows for k, j in enumerate(plan_flight.ARM))
    fact(f"distance from the plan: at most {max(away):.4f} mm, {away[-1]:.4f} mm after the lap of {run.t[-1]:g} s")
    fact(f"tilt of the body: {min(tilts):.1f}° to {max(tilts):.1f}°; error of the servos at most {degrees(servo):.1e}°")
    ends = [f"({', '.join(f'{x:.4f}' for x in run.quaternion('free', i))})" for i in (0, -1)]
    fact(f"quaternion: {ends[0]} at the start, {ends[1]} at the end, after a full turn")

    page = Canvas(960, 520)
    page.text(20, 28, "One lap, drawn every 0.75 s; blue: path of the body, brown: of the arm's tip", bold=True)
    project = viewed(-75, 28, 120, (260, 415))
    page.line([project([1.5 * sin(k / 50 * pi), -1.5 * cos(k / 50 * pi), 0]) for k in range(101)], PALE, 1.5)
    page.line([project(run.place("tool", i)) for i in rows], BROWN, 1)
    page.line([project(run.place("free", i)) for i in rows], BLUE, 1)
    for k in range(8):
        flying(page, run, run.at(0.75 * k), project)
    page.text(20, 48, "green: the propellers in front; pale ring: the circle on the ground", GREY, 12)
    start = project(run.place("free", 0))
    page.text(start[0] + 12, start[1] + 46, "start and end", GREY, 12)
    ts, tables = thrusts()
    plot = Plot(page, (560, 60, 930, 200), range(7), range(0, 9, 2), "Thrust of each propeller, N")
    for u, colour in zip(tables, (BLUE, GREEN, BROWN, RED)):
        plot.curve(ts, u, colour)
    for k, (name, colour) in enumerate(zip(plan_flight.ROTORS, (BLUE, GREEN, BROWN, RED))):
        page.text(560 + 95 * k, 245, name.replace("_", " "), colour, 12)
    plot = Plot(page, (560, 320, 930, 470), range(7), [0, 0.01, 0.02, 0.03], "Distance of the body from the plan, mm")
    plot.curve(run.t, away, BLUE)
    write(page, HERE / "quadrotor_arm.svg")


def thrusts():
    """The tables of the propellers in the scene: times, and the thrusts of each."""
    text = (HERE / "quadrotor_arm.scene.yaml").read_text()
    found = []
    for name in plan_flight.ROTORS:
        block = text.split(f"{name}_propeller_fz:")[1].split("_fz:")[0].split("drag_mz:")[0]
        found.append([(float(t), float(u)) for t, u in re.findall(r"\[(\S+) s, (\S+)\]", block)])
    return [t for t, _ in found[0]], [[u for _, u in rows] for rows in found]


def flying(page, run, i, project):
    """The quadrotor in a row of the table: its propellers, their beams, its arm."""
    q, middle = run.quaternion("free", i), run.place("free", i)
    spot = lambda r: project([a + b for a, b in zip(middle, turned(q, r))])
    for x, y, _ in plan_flight.ROTORS.values():
        page.line([spot([0, 0, 0]), spot([0.18 * x, 0.18 * y, 0.03])], BLUE, 2.5)
        ring = [spot([0.18 * x + 0.12 * cos(a / 12 * pi), 0.18 * y + 0.12 * sin(a / 12 * pi), 0.03]) for a in range(24)]
        page.area(ring, SHADE, GREEN if x > 0 else BLUE, 0.8)
    page.line([spot([0, 0, 0])] + [project(run.place(f, i)) for f in ("shoulder_place", "elbow_place", "tool")], INK, 3)
    page.disc(project(run.place("elbow_place", i)), 3, BROWN)


MACHINES = (quadrotor_arm, quadruped, satellite, satellite_hold, spherical_pendulum)

if __name__ == "__main__":
    bgdyn, folder, *others = sys.argv[1:]
    names = [name for name in others if name != "--draw"]
    for machine in MACHINES:
        if machine.__name__ in names or not names:
            print(machine.__name__)
            machine(bgdyn, folder)
