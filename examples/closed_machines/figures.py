"""Measures the runs and draws them.

    python3 examples/closed_machines/figures.py bgdyn runs [--draw] [MACHINE …]

reads the tables that `bgdyn simulate … --out runs` wrote and prints the facts of README.md. With `--draw`
it also writes the pictures next to it. Places of links, gaps of loops and static forces are computed here, from the
mechanisms' files, not by `bgdyn`; it is asked for its inputs and accelerations only.
"""

import json
import re
import subprocess
import sys
import tempfile
from math import cos, degrees, exp, pi, radians, sin, sqrt
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(1, str(HERE / "../free_machines"))

import plan_dig
import plan_legs
import plan_pick
from canvas import BLUE, BROWN, GREEN, GREY, INK, PALE, RED, SHADE, Canvas, Plot, fact, write
from runs import Run
from tree import Tree, apply, distance

SIX = (BLUE, GREEN, BROWN, RED, GREY, INK)


def viewed(turn, rise, scale, place):
    """A parallel projection of the world onto the page, from `turn` and `rise` in degrees."""
    ct, st, cr, sr = cos(radians(turn)), sin(radians(turn)), cos(radians(rise)), sin(radians(rise))

    def project(r):
        across, away = -st * r[0] + ct * r[1], ct * r[0] + st * r[1]
        return (place[0] + scale * across, place[1] - scale * (cr * r[2] - sr * away))

    return project


def evaluated(bgdyn, name, function, states):
    """A function of a scene in each state."""
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump({"states": states}, file)
        file.flush()
        command = [bgdyn, "eval", HERE / f"{name}.scene.yaml", function, "--states", file.name]
        return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def positions(run, machine, i):
    return {joint: run[joint][i] for joint in machine.joints}


def gap(run, machine):
    """The largest distance of two places that a loop joins, in all rows of the table."""
    found = max(max(machine.gaps(positions(run, machine, i))) for i in range(len(run.t)))
    fact(f"loops are open by at most {found:.1e} m, in {len(run.t)} rows of the table")


# The excavator ------------------------------------------------------------------------------------------

BOOM = [(0, -0.12), (1.45, 0.06), (3.02, -0.09), (3.05, 0.06), (1.68, 0.48), (1.25, 0.34), (-0.05, 0.1)]
STICK = [(-0.4, 0.2), (-0.1, -0.11), (1.62, -0.07), (1.65, 0.05), (0.3, 0.27), (-0.3, 0.28)]
BUCKET = [(-0.06, -0.06), (0.02, 0.3), (0.3, 0.42), (0.62, 0.3), (0.75, -0.1), (0.66, -0.02)]
HOUSE = [(-1.3, 0.5), (0.95, 0.5), (0.8, 0.8), (0.25, 0.92), (0.2, 1.75), (-0.5, 1.75), (-0.55, 1.2), (-1.35, 1.2)]
TRACKS = [(s * x, z) for s, side in ((-1, 1), (1, -1)) for x, z in ((1, 0), (1.15, 0.06), (1.15, 0.34), (1, 0.42))[::side]]
COLOURS = {"lift": BLUE, "fold": GREEN, "curl": BROWN}


def excavator(bgdyn, folder):
    run, machine = Run(folder, "excavator"), plan_dig.MACHINE
    rows = range(len(run.t))
    gap(run, machine)
    start = evaluated(bgdyn, "excavator", "derivative", [{}])
    first = {n: x for n, x in zip(start["names"], start["results"][0]) if n in [f"{j}_rate" for j in plan_dig.BEGIN]}
    most = max(map(abs, first.values()))
    fact(f"at the start, with the rams' forces by virtual work, accelerations are at most {most:.1e} rad/s²")
    planned = [plan_dig.closed(plan_dig.plan(t)) for t in run.t]
    off = {j: max(abs(degrees(run[j][i] - planned[i][j])) for i in rows) for j in machine.joints}
    fact("from the plan, at most: " + ", ".join(f"{j} {x:.2f}°" for j, x in off.items()))
    ends = [degrees(run[j][-1]) for j in ("slew", "lift", "fold", "bucket_angle")]
    fact("at the end: slew {:.2f}°, lift {:.2f}°, fold {:.2f}°, bucket {:.2f}°".format(*ends))
    for link in machine.spec["links"]:
        name, limits = link["joint"]["name"], link["joint"].get("limits")
        if limits:
            least, most = min(run[name]), max(run[name])
            inside = limits["lower"] <= least and most <= limits["upper"]
            fact(f"{name}: {degrees(least):.1f}° to {degrees(most):.1f}°, {'within' if inside else 'BEYOND'} its limits")
    strokes = {name: (e["offset"], e["stroke"]) for name, e in machine.spec["effects"].items() if "stroke" in e}
    for ram in plan_dig.RAMS:
        offset, stroke = strokes[f"{ram}_ram"]
        out = [x - offset for x in run[f"{ram}_ram_length"]]
        own = lambda i: plan_dig.lengths(machine.poses(positions(run, machine, i)))[ram]
        off = max(abs(own(i) - run[f"{ram}_ram_length"][i]) for i in rows)
        force, sides = run[f"{ram}_ram_force"], [run[f"{ram}_ram_{s}_pressure"] for s in "ab"]
        least, most = min(force) / 1e3, max(force) / 1e3
        words = [f"{min(p) / 1e6:.1f} to {max(p) / 1e6:.1f} MPa" for p in sides]
        fact(f"{ram}_ram: out by {min(out):.3f} to {max(out):.3f} m of {stroke:g} m; {least:.1f} to {most:.1f} kN")
        fact(f"{ram}_ram: sides a {words[0]}, b {words[1]}; length as computed here to {off:.0e} m")
    asked = [plan_dig.forces(planned[i], plan_dig.resistance(run.t[i])) for i in rows]
    for ram in plan_dig.RAMS:
        far = max(abs(run[f"{ram}_ram_force"][i] - asked[i][ram]) for i in rows)
        late = max(abs(run[f"{ram}_ram_force"][i] - asked[i][ram]) for i in range(run.at(11.8), len(run.t)))
        fact(f"{ram}_ram: force from that of the plan at most {far / 1e3:.2f} kN, {late / 1e3:.2f} kN at rest at the end")
    below = min(run["teeth_z"])
    push = max(sqrt(sum(f * f for f in plan_dig.resistance(t))) for t in run.t)
    fact(f"teeth: down to {below:.2f} m, up to {run['teeth_z'][-1]:.2f} m at the end")
    fact(f"resistance of the earth: up to {push / 1e3:.1f} kN")
    slews = [abs(x) for x in slew_torques()[1]]
    fact(f"slew: torque up to {max(slews) / 1e3:.2f} kN m")

    page = Canvas(960, 850)
    shots = ((0.5, "reaches out"), (3.2, "digs"), (6.4, "has curled its bucket"), (12.0, "has lifted and turned"))
    for k, (t, title) in enumerate(shots[:3]):
        i, place = run.at(t), (78 + 315 * k, 175)
        page.text(20 + 315 * k, 28, f"{run.t[i]:.1f} s: {title}", bold=True)
        digging(page, run, i, flat(place, 45), k > 0, 45)
    i = run.at(12.0)
    page.text(20, 255, f"{run.t[i]:.1f} s: {shots[3][1]}, seen from its side", bold=True)
    digging(page, run, i, flat((78, 440), 45), False, 45)
    page.text(335, 255, "From above: the slew, and the path of the teeth", bold=True)
    above(page, run, (440, 430), 38)
    page.text(650, 255, "The loop of the bucket", bold=True)
    bucket_loop(page, run, (0.5, 6.4), ((700, 315), (850, 315)), 105)
    ticks = [0, 3, 6, 9, 12]
    page.text(50, 532, "Forces of the rams, kN", bold=True)
    legend(page, 50, 550, {"boom": BLUE, "stick": GREEN, "bucket": BROWN})
    page.text(240, 550, "(pale: the plan)", GREY, 12)
    plot = Plot(page, (50, 572, 450, 802), ticks, range(-20, 51, 10), "")
    for ram, colour in COLOURS.items():
        plot.curve(run.t, [f[ram] / 1e3 for f in asked], SHADE, 5)
    for ram, colour in COLOURS.items():
        plot.curve(run.t, [x / 1e3 for x in run[f"{ram}_ram_force"]], colour, 1.4)
    page.text(530, 532, "Pressures, MPa", bold=True)
    page.text(530, 550, "full: side that extends the ram; dashed: side of the rod; the pump has 20 MPa", GREY, 12)
    plot = Plot(page, (530, 572, 930, 802), ticks, range(0, 11, 2), "")
    for ram, colour in COLOURS.items():
        for side, dash in (("a", None), ("b", "4 3")):
            plot.curve(run.t, [x / 1e6 for x in run[f"{ram}_ram_{side}_pressure"]], colour, 1.4, dash)
    write(page, HERE / "excavator.svg")


def legend(page, x, y, names):
    for name, colour in names.items():
        page.line([(x, y - 4), (x + 14, y - 4)], colour, 2)
        page.text(x + 18, y, name, GREY, 12)
        x += 30 + 7 * len(name)


def slew_torques():
    """The table of the slew in the scene: times and torques."""
    text = (HERE / "excavator.scene.yaml").read_text().split("  slew:\n    table:")[1].split("digging_fx:")[0]
    pairs = [(float(t), float(u)) for t, u in re.findall(r"\[(\S+) s, (\S+)\]", text)]
    return [t for t, _ in pairs], [u for _, u in pairs]


def flat(place, scale):
    """The plane of the arm on the page."""
    return lambda r: (place[0] + scale * r[0], place[1] - scale * r[2])


def digging(page, run, i, spot, trail, scale):
    """The excavator in a row of the table, seen along the axes of its arm, with the trail of the teeth or without."""
    machine = plan_dig.MACHINE
    poses = machine.poses(positions(run, machine, i) | {"slew": 0.0})
    local = lambda name, points: [spot(apply(poses[name], [x, 0, z])) for x, z in points]
    at = lambda name: spot(poses[name][1])
    ground = spot([0, 0, 0])[1]
    page.line([(spot([-1.6, 0, 0])[0], ground), (spot([5.4, 0, 0])[0], ground)], GREY, 1)
    page.text(spot([1.4, 0, 0])[0], ground + 14, "ground", GREY, 11)
    if trail:
        page.line([spot(run.place("teeth", k)) for k in range(i + 1)], BROWN, 1.2, "2 3")
    page.area([spot([x, 0, z]) for x, z in TRACKS], GREY, GREY)
    page.area([spot([x, 0, z]) for x, z in HOUSE], SHADE, BLUE)
    page.area(local("bucket", BUCKET), SHADE, INK)
    page.area(local("stick", STICK), SHADE, BLUE)
    page.area(local("boom", BOOM), SHADE, BLUE)
    page.line([at("rocker"), at("coupler")], INK, 2.5)
    page.line([at("coupler"), local("coupler", [(0.336, 0)])[0]], INK, 2.5)
    for ram, (foot, head, *_) in plan_dig.RAMS.items():
        a, b = at(foot), at(head)
        closed = {"lift": 0.85, "fold": 1.15, "curl": 0.87}[ram] * scale
        long = sqrt((b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2)
        barrel = tuple(p + min(0.93 * closed / long, 1) * (q - p) for p, q in zip(a, b))
        page.line([a, b], COLOURS[ram], 2)
        page.line([a, barrel], COLOURS[ram], 5)
    for name in ("boom", "stick", "bucket", "rocker", "coupler"):
        page.disc(at(name), 2.5, RED)


def above(page, run, place, scale):
    """Three positions of the slew, and the path of the teeth."""
    machine = plan_dig.MACHINE
    spot = lambda r: (place[0] + scale * r[0] - 20, place[1] - scale * r[1])
    page.area([spot([x, y, 0]) for x, y in ((-1.1, -0.8), (1.1, -0.8), (1.1, 0.8), (-1.1, 0.8))], PALE, GREY)
    for t, strength in ((0.5, 0.4), (9.2, 0.6), (12.0, 1.0)):
        i = run.at(t)
        poses = machine.poses(positions(run, machine, i))
        body = [spot(apply(poses["house"], [x, y, 0])) for x, y in ((-1.35, -0.75), (0.8, -0.75), (0.8, 0.75), (-1.35, 0.75))]
        page.area(body, SHADE, BLUE, strength)
        page.line([spot(poses[n][1]) for n in ("boom", "stick", "bucket", "teeth")], INK, 4, opacity=strength)
    page.line([spot(run.place("teeth", k)) for k in range(len(run.t))], BROWN, 1.4, "3 3")
    for t, across, up in ((0.5, -22, 18), (9.2, 28, -8), (12.0, -42, 4)):
        x, y = spot(run.place("teeth", run.at(t)))
        page.text(x + across, y + up, f"{t:g} s", GREY, 12)


def bucket_loop(page, run, times, places, scale):
    """The four-bar with its ram, in the axes of the stick, turned as in the other pictures."""
    machine = plan_dig.MACHINE
    for t, place in zip(times, places):
        i = run.at(t)
        poses = machine.poses(positions(run, machine, i) | {"slew": 0.0, "lift": 0.0, "fold": -pi / 2})
        base = poses["stick"][1]
        spot = lambda r: (place[0] + scale * (r[0] - base[0]), place[1] - scale * (r[2] - base[2] + 0.72))
        local = lambda name, points: [spot(apply(poses[name], [x, 0, z])) for x, z in points]
        at = lambda name: spot(poses[name][1])
        page.text(place[0] - 45, place[1] - 30, f"{run.t[i]:.1f} s", GREY, 12)
        page.area(local("bucket", BUCKET), SHADE, INK)
        page.line(local("stick", [(0.75, 0), (1.6, 0)]), BLUE, 6)
        pin = local("coupler", [(0.336, 0)])[0]
        page.line([at("rocker"), at("coupler"), pin, at("bucket")], INK, 3)
        ram = [p + 0.62 * (q - p) for p, q in zip(at("curl_foot"), at("curl_head"))]
        page.line([ram, at("curl_head")], BROWN, 3)
        for p in (at("rocker"), at("coupler"), pin, at("bucket")):
            page.disc(p, 3.5, RED)
    x, y = places[0]
    page.text(x - 50, y + 185, "stick", BLUE, 12)
    page.text(x - 10, y + 185, "ram", BROWN, 12)
    page.text(x + 20, y + 185, "rocker, coupler, bucket: a four-bar", INK, 12)


# The Delta robot ----------------------------------------------------------------------------------------

DELTA = Tree(HERE / "../../specs/loops/delta_robot.yaml")
ARMS = [f"arm{k}_angle" for k in (1, 2, 3)]
PLATFORM = ("px_position", "py_position", "platform_position")
PUSHED = "beside"


def delta_pick(bgdyn, folder):
    run = Run(folder, "delta_pick")
    rows = range(len(run.t))
    gap(run, DELTA)
    plans = [plan_pick.plan(t) for t in run.t]
    errors = [max(abs(run[a][i] - x) for a, x in zip(ARMS, plans[i])) for i in rows]
    away = [distance(run.row(PLATFORM, i), plan_pick.platform(run.t[i])) for i in rows]
    fact(f"arms from the plan: at most {max(errors):.1e} rad; platform: at most {max(away):.1e} m, {away[-1]:.0e} m at the end")
    step = 1e-3
    moves = [plan_pick.platform(k * step) for k in range(round(plan_pick.END / step))]
    speed = max(distance(a, b) / step for a, b in zip(moves, moves[1:]))
    bend = lambda a, b, c: sqrt(sum((x - 2 * y + z) ** 2 for x, y, z in zip(a, b, c))) / step**2
    most = max(bend(*three) for three in zip(moves, moves[1:], moves[2:]))
    fact(f"plan of the platform: up to {speed:.2f} m/s and {most:.1f} m/s²")
    torques = torque(bgdyn, run)
    fact("torques: " + "; ".join(f"arm{k + 1} {min(u):.2f} to {max(u):.2f} N m" for k, u in enumerate(zip(*torques))))
    first, off = torques[0], max(abs(a - b) for a, b in zip(torques[0], weight_torque(plan_pick.PICK)))
    fact(f"at the start {', '.join(f'{x:.4f}' for x in first)} N m, from virtual work by at most {off:.1e} N m")
    beside = Run(Path(folder) / PUSHED, "delta_pick")
    e = [beside[ARMS[0]][i] - plan_pick.plan(t)[0] for i, t in enumerate(beside.t)]
    rate = plan_pick.DAMPING / 2
    law = [e[0] * (1 + rate * t) * exp(-rate * t) for t in beside.t]
    differ = lambda k: max(abs(beside[ARMS[k]][i] - plan_pick.plan(t)[k]) for i, t in enumerate(beside.t))
    law_off, others = max(abs(a - b) for a, b in zip(e, law)), max(differ(1), differ(2))
    off = [distance(beside.row(PLATFORM, i), plan_pick.platform(t)) for i, t in enumerate(beside.t)]
    fact(f"with arm 1 moved by {e[0]:.4f} rad, {degrees(e[0]):.2f}°, the platform begins {1000 * off[0]:.2f} mm off")
    fact(f"its error is e (1 + {rate:g} t) exp(-{rate:g} t) to {law_off:.1e} rad; {1000 * off[-1]:.4f} mm after the cycle")
    fact(f"the other arms are off by at most {others:.1e} rad")

    page = Canvas(960, 640)
    shots = ((0.0, "picks"), (0.35, "carries"), (0.65, "places"))
    for k, (t, title) in enumerate(shots):
        i, place = run.at(t), (165 + 315 * k, 118)
        page.text(30 + 315 * k, 28, f"{run.t[i]:.2f} s: {title}", bold=True)
        reaching(page, run, i, viewed(-65, 20, 320, place))
    page.text(30, 352, "blue: arms, turned by the motors (red); brown: forearms; dashed: path of the platform", GREY, 12)
    ticks = [0, 0.325, 0.65, 0.975, 1.3]
    plot = Plot(page, (50, 410, 300, 600), ticks, range(-6, 5, 2), "Torques of the motors, N·m")
    for k, colour in enumerate((BLUE, GREEN, BROWN)):
        plot.curve(run.t, [u[k] for u in torques], colour, 1.4)
        page.text(50 + 60 * k, 633, f"arm {k + 1}", colour, 12)
    plot = Plot(page, (370, 410, 620, 600), ticks, [0, 0.05, 0.1, 0.15, 0.2], "Platform from the plan, µm")
    plot.curve(run.t, [1e6 * x for x in away], BLUE, 1.2)
    plot = Plot(page, (690, 410, 930, 600), ticks, range(0, 22, 7), "The same after a push of arm 1, mm")
    plot.curve(beside.t, [1e3 * x for x in off], RED)
    write(page, HERE / "delta_pick.svg")


def torque(bgdyn, run):
    """The torques of the three arms in each row, from the scene's inputs at its states."""
    names = DELTA.joints + [f"{a}_rate" for a in ARMS]
    states = [{"y": dict(zip(names, run.row(names, i))), "t": t} for i, t in enumerate(run.t)]
    found = evaluated(bgdyn, "delta_pick", "input", states)
    order = [found["names"].index(a) for a in ARMS]
    return [[row[k] for k in order] for row in found["results"]]


def weight_torque(place):
    """The torques that carry the weight, from small motions of the platform."""
    size, height = 1e-5, lambda poses, link: apply(poses[link["name"]], link.get("com", [0, 0, 0]))[2]

    def both(j, s):
        q = plan_pick.closed([x + s * (i == j) for i, x in enumerate(place)])
        poses = DELTA.poses(q)
        links = [link for link in DELTA.spec["links"] if "mass" in link]
        return [q[a] for a in ARMS] + [sum(9.81 * l["mass"] * height(poses, l) for l in links)]

    rows = [[(a - b) / (2 * size) for a, b in zip(both(j, size), both(j, -size))] for j in range(3)]
    return plan_legs.solved(rows)


def reaching(page, run, i, project):
    """The Delta robot in a row of the table."""
    poses = DELTA.poses(positions(run, DELTA, i))
    shoulders = [poses[f"arm{k}"][1] for k in (1, 2, 3)]
    corners = [[-2 * x for x in r] for r in shoulders]
    page.area([project(p) for p in corners], PALE, GREY)
    path = [run.row(PLATFORM, k) for k in range(len(run.t))]
    page.line([project(r) for r in path], GREY, 1.2, "3 3")
    balls = [apply(poses["platform"], loop["b"]["origin"]["xyz"]) for loop in DELTA.spec["loops"]]
    order = sorted((1, 2, 3), key=lambda k: -depth(shoulders[k - 1], -65))
    for k in order:
        arm = poses[f"arm{k}"]
        wide = lambda r, s: project([x + s * 0.035 * arm[0][n][1] for n, x in enumerate(r)])
        elbow = poses[f"forearm{k}_pitch"][1]
        for s in (-1, 1):
            page.line([wide(elbow, s), wide(balls[k - 1], s)], BROWN, 2)
        page.line([wide(elbow, -1), wide(elbow, 1)], INK, 2)
        page.line([project(arm[1]), project(elbow)], BLUE, 6)
        page.disc(project(arm[1]), 5, RED)
    middle = poses["platform"][1]
    ends = [[x + s * 0.035 * poses[f"arm{k}"][0][n][1] for n, x in enumerate(balls[k - 1])] for k in (1, 2, 3) for s in (-1, 1)]
    page.area([project(p) for p in ends], SHADE, BLUE)
    page.disc(project(middle), 3, INK)


def depth(r, turn):
    """How far a point is from the eye of `viewed`, seen from the side: larger is farther."""
    return cos(radians(turn)) * r[0] + sin(radians(turn)) * r[1]


# The Stewart platform -----------------------------------------------------------------------------------


def stewart_platform(bgdyn, folder):
    run, machine = Run(folder, "stewart_platform"), plan_legs.MACHINE
    rows, legs = range(len(run.t)), plan_legs.LEGS
    gap(run, machine)
    start = evaluated(bgdyn, "stewart_platform", "derivative", [{}])
    first = [x for n, x in zip(start["names"], start["results"][0]) if n in [f"{p}_rate" for p in plan_legs.POSE]]
    most = max(map(abs, first))
    fact(f"at the start, with pushes by virtual work, accelerations are at most {most:.1e} m/s² or rad/s²")
    poses = [plan_legs.pose(t) for t in run.t]
    away = [distance(run.row(plan_legs.POSE[:3], i), poses[i][:3]) for i in rows]
    turn = [max(abs(degrees(run[p][i] - poses[i][k])) for k, p in enumerate(plan_legs.POSE) if k > 2) for i in rows]
    fact(f"platform from the plan: at most {1000 * max(away):.2f} mm and {max(turn):.3f}°; {1000 * away[-1]:.2f} mm at the end")
    for name, (at, long) in (("heave", plan_legs.HEAVE), ("roll", plan_legs.ROLL), ("circle", plan_legs.CIRCLE)):
        part = range(run.at(at), run.at(at + long))
        fact(f"{name}: at most {1000 * max(away[i] for i in part):.2f} mm and {max(turn[i] for i in part):.3f}°")
    wanted = [plan_legs.lengths(p) for p in poses]
    late = [[run[leg][i] - wanted[i][k] for i in rows] for k, leg in enumerate(legs)]
    most, last = max(max(map(abs, x)) for x in late), ", ".join(f"{1000 * x[-1]:.3f}" for x in late)
    fact(f"legs from the plan: at most {1000 * most:.2f} mm; at the end {last} mm")
    long, rates = [x for leg in legs for x in run[leg]], [abs(x) for leg in legs for x in run[f"{leg}_rate"]]
    fact(f"legs: {min(long):.3f} to {max(long):.3f} m, at most {max(rates):.2f} m/s")
    pushes = forces(run)
    every, first = [x for push in pushes for x in push], ", ".join(f"{p[0]:.1f}" for p in pushes)
    fact(f"push of a leg, spring less damper: {min(every):.1f} to {max(every):.1f} N; at the start {first} N")
    carried = plan_legs.carried(run.row(plan_legs.POSE, rows[-1]))
    seals = ", ".join(f"{p[-1] - c:.2f}" for p, c in zip(pushes, carried))
    fact(f"at rest at the end they differ from the weight's by {seals} N: the seals, up to 6 N each, hold")
    height, roll = run["pz_position"], degrees(max(map(abs, run["platform_angle"])))
    fact(f"height {min(height):.3f} to {max(height):.3f} m, roll up to {roll:.2f}°, y up to {max(run['py_position']):.3f} m")

    page = Canvas(960, 660)
    shots = ((0.0, "middle"), (1.14, "up"), (3.24, "rolled"), (6.1, "far side of the circle"))
    for k, (t, title) in enumerate(shots):
        i, place = run.at(t), (124 + 237 * k, 268)
        page.text(20 + 237 * k, 28, f"{run.t[i]:.2f} s: {title}", bold=True)
        standing(page, run, i, viewed(-30, 22, 215, place))
    page.text(20, 355, "dashed: path of the platform's middle", GREY, 12)
    ticks = range(0, 9, 2)
    plot = Plot(page, (50, 425, 300, 600), ticks, range(-150, 201, 50), "Motion of the platform")
    for words, at, colour, values in (
        ("x, mm", 50, BLUE, [1000 * x for x in run["px_position"]]),
        ("y, mm", 95, GREEN, [1000 * x for x in run["py_position"]]),
        ("height − 700, mm", 140, BROWN, [1000 * x - 700 for x in run["pz_position"]]),
        ("roll, 0.1°", 240, RED, [10 * degrees(x) for x in run["platform_angle"]]),
    ):
        plot.curve(run.t, values, colour)
        page.text(at, 640, words, colour, 12)
    plot = Plot(page, (370, 425, 620, 600), ticks, [0, 0.5, 1, 1.5, 2, 2.5], "Platform from the plan, mm")
    plot.curve(run.t, [1000 * x for x in away], BLUE)
    plot = Plot(page, (690, 425, 930, 600), ticks, range(-80, 121, 40), "Pushes of the legs, N")
    for k, (push, colour) in enumerate(zip(pushes, SIX)):
        plot.curve(run.t, push, colour, 1.4)
        page.text(690 + 40 * k, 640, f"leg {k + 1}" if k == 0 else f"{k + 1}", colour, 12)
    write(page, HERE / "stewart_platform.svg")


def forces(run):
    """The push of each leg in each row: k (r - l) - d l̇, with the references of the scene."""
    text, found = (HERE / "stewart_platform.scene.yaml").read_text(), []
    for k, leg in enumerate(plan_legs.LEGS, 1):
        block = text.split(f"  plan{k}:\n")[1].split("]\n    ]")[0]
        points = [(float(t), float(u)) for t, u in re.findall(r"\[(\S+) s, (\S+?)\]", block + "]")]
        push, n = [], 0
        for i, t in enumerate(run.t):
            while n < len(points) - 2 and points[n + 1][0] < t:
                n += 1
            (t0, r0), (t1, r1) = points[n], points[n + 1]
            r = r0 + (r1 - r0) * (t - t0) / (t1 - t0)
            push.append(plan_legs.STIFFNESS * (r - run[leg][i]) - plan_legs.DAMPING * run[f"{leg}_rate"][i])
        found.append(push)
    return found


def standing(page, run, i, project):
    """The Stewart platform in a row of the table."""
    pose = run.row(plan_legs.POSE, i)
    pairs = list(plan_legs.balls(pose))
    poses = plan_legs.MACHINE.poses(positions(run, plan_legs.MACHINE, i))
    page.area([project(foot) for foot, _ in pairs], PALE, GREY)
    path = [run.row(plan_legs.POSE[:3], k) for k in range(len(run.t))]
    order = sorted(range(6), key=lambda k: -depth([a + b for a, b in zip(*pairs[k])], -30))
    for k in order:
        foot, ball = pairs[k]
        barrel = apply(poses[f"leg{k + 1}_y"], [0, 0, 0.42])
        page.line([project(foot), project(ball)], SIX[k], 2)
        page.line([project(foot), project(barrel)], SIX[k], 5)
        page.disc(project(foot), 3, INK)
    page.area([project(ball) for _, ball in pairs], SHADE, BLUE, 0.85)
    for foot, ball in pairs:
        page.disc(project(ball), 2.5, INK)
    page.line([project(r) for r in path], RED, 1, "2 2")
    page.line([project(apply(poses["platform"], [0, 0, z])) for z in (-0.04, 0.0)], INK, 1)
    page.disc(project(poses["platform"][1]), 3.5, RED)


MACHINES = (excavator, delta_pick, stewart_platform)

if __name__ == "__main__":
    bgdyn, folder, *others = sys.argv[1:]
    names = [name for name in others if name != "--draw"]
    for machine in MACHINES:
        if machine.__name__ in names or not names:
            print(machine.__name__)
            machine(bgdyn, folder)
