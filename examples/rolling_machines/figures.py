"""Measures the runs and draws them.

    python3 examples/rolling_machines/figures.py bgdyn runs [--draw] [MACHINE …]

reads the tables that `bgdyn simulate … --out runs` wrote and prints the facts of README.md. With `--draw`
it also writes the pictures next to it. Slip, gaps and energies are computed here, from the mechanisms' files and the
tables (wheels.py); `bgdyn` is asked for the torques of the robot's controllers only.
"""

import json
import subprocess
import sys
import tempfile
from cmath import log
from math import acos, atan2, cos, degrees, exp, hypot, pi, sin, sqrt
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(1, str(HERE / "../free_machines"))

import plan_path
from canvas import BLUE, BROWN, GREEN, GREY, INK, PALE, RED, SHADE, Canvas, Plot, fact, write
from measures import G, conserves, legend, machine, rolls, row, viewed
from rattleback import rattleback
from runs import Run
from wheels import apply, turned

# Sums of exponentials --------------------------------------------------------------------------------------


def roots(coefficients):
    """Of x^n + c1 x^(n-1) + …, all at once (Durand 1960, Kerner 1966)."""
    n = len(coefficients)
    found = [(0.4 + 0.9j) ** k for k in range(n)]
    for _ in range(500):
        for i, x in enumerate(found):
            value, apart = 1, 1
            for c in coefficients:
                value = value * x + c
            for j, other in enumerate(found):
                apart *= x - other if j != i else 1
            found[i] = x - value / apart
    return found


def solved(a, b):
    """a x = b, by elimination with pivots."""
    n, rows = len(b), [list(r) + [x] for r, x in zip(a, b)]
    for k in range(n):
        best = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[best] = rows[best], rows[k]
        for i in range(n):
            if i != k:
                f = rows[i][k] / rows[k][k]
                rows[i] = [x - f * y for x, y in zip(rows[i], rows[k])]
    return [rows[k][n] / rows[k][k] for k in range(n)]


def exponents(series, step, modes):
    """The rates of `modes` exponentials that add up to the series (Prony 1795), by least squares."""
    lines = [series[i : i + modes + 1] for i in range(len(series) - modes)]
    normal = [[sum(line[i] * line[j] for line in lines) for j in range(modes)] for i in range(modes)]
    right = [sum(line[i] * line[modes] for line in lines) for i in range(modes)]
    law = solved(normal, right)
    return [log(z) / step for z in roots([-x for x in reversed(law)])]


def fitted(series, step, modes):
    """Weave (that with a frequency) and the slower of the other two, capsize."""
    found = exponents(series, step, modes)
    weave = max((z for z in found if abs(z.imag) > 0.5), key=lambda z: z.imag)
    others = [z.real for z in found if abs(z.imag) < 0.5]
    return weave, max(others) if others else None


# The bicycle -----------------------------------------------------------------------------------------------

# M q'' + v C1 q' + (g K0 + v² K2) q = 0 for q = (lean, steer), as the benchmark publishes it (Meijaard et al. 2007).
BENCHMARK = {
    "M": [[80.81722, 2.31941332208709], [2.31941332208709, 0.29784188199686]],
    "C1": [[0, 33.86641391492494], [-0.85035641456978, 1.68540397397560]],
    "K0": [[-80.95, -2.59951685249872], [-2.59951685249872, -0.80329488458618]],
    "K2": [[0, 76.59734589573222], [0, 2.65431523794604]],
}


def times(p, q):
    found = [0.0] * (len(p) + len(q) - 1)
    for i, x in enumerate(p):
        for j, y in enumerate(q):
            found[i + j] += x * y
    return found


def eigenvalues(v):
    """Of the published equations at a speed: weave and capsize."""
    b = BENCHMARK
    entry = lambda i, j: [b["M"][i][j], v * b["C1"][i][j], G * b["K0"][i][j] + v * v * b["K2"][i][j]]
    det = [x - y for x, y in zip(times(entry(0, 0), entry(1, 1)), times(entry(0, 1), entry(1, 0)))]
    found = roots([x / det[0] for x in det[1:]])
    weave = max((z for z in found if z.imag > 0.5), key=lambda z: z.imag)
    return weave, max(z.real for z in found if abs(z.imag) < 1e-6)


def crossed(f, low, high):
    """Where a function is zero, by halving."""
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if f(low) * f(middle) > 0 else (low, middle)
    return low


RADII = {"rear_wheel": 0.3, "front_wheel": 0.35}


def compared(run, start, end, modes, words):
    step = 20
    i, j = run.at(start), run.at(end)
    weave, capsize = fitted(run["lean"][i : j + 1 : step], step * (run.t[1] - run.t[0]), modes)
    speed = RADII["rear_wheel"] * run["rear_spin_rate"][j]
    w, c = eigenvalues(speed)
    sign = lambda z: f"{z.real:.5f} ± {z.imag:.5f} i"
    fact(f"{words}, {start:g} to {end:g} s: weave {sign(weave)} 1/s, capsize {capsize:.5f} 1/s; "
         f"of the benchmark at {speed:.5f} m/s: {sign(w)}, {c:.5f}; apart {abs(weave - w):.1e}, {abs(capsize - c):.1e}")


def bicycle(bgdyn, folder):
    own, run = machine("whipple_bicycle"), Run(folder, "bicycle")
    slow, small, small_slow, fall = (Run(Path(folder) / n, "bicycle") for n in ("slow", "small", "small_slow", "fall"))
    contacts = rolls(run, own, "5 m/s")
    slow_contacts = rolls(slow, own, "3.5 m/s")
    conserves(run, own)
    conserves(slow, own)
    weave_speed = crossed(lambda v: eigenvalues(v)[0].real, 4.0, 5.0)
    capsize_speed = crossed(lambda v: eigenvalues(v)[1], 5.5, 6.5)
    fact(f"benchmark: weave decays above {weave_speed:.3f} m/s, capsize below {capsize_speed:.3f} m/s")
    for v in (5.0, 3.5):
        w, c = eigenvalues(v)
        fact(f"benchmark at {v:g} m/s: weave {w.real:.5f} ± {w.imag:.5f} i, capsize {c:.5f}")
    compared(run, 4, 10, 3, "5 m/s, lean 3°")
    compared(small, 2, 10, 3, "5 m/s, lean 0.01°")
    compared(small_slow, 0, 4, 4, "3.5 m/s, lean 0.001°")
    least, most = min(run["lean"]), max(run["lean"])
    fact(f"5 m/s: lean {degrees(least):.2f}° to {degrees(most):.2f}°, steer {degrees(min(run['steer'])):.2f}° to {degrees(max(run['steer'])):.2f}°")
    i = run.at(5)
    late = max(abs(degrees(x)) for x in run["lean"][i:])
    fact(f"5 m/s: lean at most {late:.3f}° after 5 s, {degrees(run['lean'][-1]):.4f}° at the end")
    fact(f"5 m/s: heading at the end {degrees(run['ground_turn'][-1]):.2f}°, speed {0.3 * run['rear_spin_rate'][-1]:.4f} m/s")
    fact(f"5 m/s: pitch up to {max(abs(degrees(x)) for x in run['pitch']):.4f}°")
    fact(f"3.5 m/s: lean {degrees(min(slow['lean'])):.1f}° to {degrees(max(slow['lean'])):.1f}°, steer {degrees(min(slow['steer'])):.1f}° to {degrees(max(slow['steer'])):.1f}°")
    speeds = [0.3 * x for x in slow["rear_spin_rate"]]
    fact(f"3.5 m/s: speed of the rear wheel {min(speeds):.2f} to {max(speeds):.2f} m/s")
    across = [crossing(own, fall, i) for i in range(len(fall.t))]
    last = next(i for i, x in enumerate(across) if abs(x) > 90) - 1
    fact(f"3 m/s: at {fall.t[last]:.2f} s lean {degrees(fall['lean'][last]):.1f}°, steer {degrees(fall['steer'][last]):.1f}°, the wheels' directions {abs(across[last]):.1f}° apart; the run ends at {fall.t[-1]:.2f} s")

    page = Canvas(960, 800)
    page.text(20, 26, "The bicycle, started with a lean of 3°; nobody steers. Seen from behind.", bold=True)
    steered = max(range(len(run.t)), key=lambda i: run["steer"][i])
    leant = max(range(len(slow.t)), key=lambda i: slow["lean"][i])
    shots = ((run, 0, "5 m/s: it leans to its right"), (run, steered, "5 m/s: it steers into the lean"), (slow, leant, "3.5 m/s: it leans further"))
    for k, (one, i, words) in enumerate(shots):
        standing(page, own, one, i, (160 + 315 * k, 222))
        page.text(30 + 315 * k, 52, f"{words}, {one.t[i]:.2f} s", INK, 13)
        page.text(30 + 315 * k, 69, f"lean {signed(one['lean'][i])}, steer {signed(one['steer'][i])}", GREY, 12)
    for k, (one, words) in enumerate(((run, "5 m/s: it comes upright"), (slow, "3.5 m/s: the weave grows"))):
        left = 50 + 480 * k
        page.text(left, 308, words, bold=True)
        page.text(left, 326, "lean and steer in degrees", GREY, 12)
        legend(page, left + 180, 326, {"lean": BLUE, "steer": BROWN})
        most = 6 if k == 0 else 30
        plot = Plot(page, (left, 345, left + 400, 545), range(0, 11, 2), [most * x / 3 for x in range(-3, 4)], "")
        plot.curve(one.t, [degrees(x) for x in one["steer"]], BROWN)
        plot.curve(one.t, [degrees(x) for x in one["lean"]], BLUE)
    page.text(50, 602, "From above: the tracks of the wheels in 10 s, turned so that each goes across the page", bold=True)
    legend(page, 50, 621, {"rear wheel": GREEN, "front wheel": RED})
    scale, top = 16.8, 645
    for one, found, words in ((run, contacts, "5 m/s"), (slow, slow_contacts, "3.5 m/s")):
        end = found[-1]["rear"][0]
        c, s = end[0] / hypot(*end[:2]), end[1] / hypot(*end[:2])
        level = lambda p: (c * p[0] + s * p[1], s * p[0] - c * p[1])
        downs = [level(p)[1] for w in found for p, _ in w.values()]
        spot = lambda p: (50 + scale * level(p)[0], top + scale * (level(p)[1] - min(downs)))
        for name, colour in (("front", RED), ("rear", GREEN)):
            page.line([spot(w[name][0]) for w in found], colour, 1.5)
        x, y = spot(end)
        page.text(x + 30, y + 4, words, INK, 12)
        top += scale * (max(downs) - min(downs)) + 26
    page.line([(50, top), (50 + 5 * scale, top)], INK, 2)
    page.text(60 + 5 * scale, top + 4, "5 m", GREY, 12)
    page.size = (960, round(top + 22))
    write(page, HERE / "bicycle.svg")


def crossing(own, run, i):
    """The angle between the directions in which the two wheels roll, in degrees."""
    links = own.links(row(run, i))
    rear, front = (turned(links[f"{end}_wheel"][0][0], [0, 1, 0]) for end in ("rear", "front"))
    return degrees(atan2(rear[0] * front[1] - rear[1] * front[0], rear[0] * front[0] + rear[1] * front[1]))


def signed(x):
    return f"{degrees(x):.1f}°".replace("-", "−")


def standing(page, own, run, i, place):
    """The bicycle in a row of the table, from behind."""
    links = own.links(row(run, i))
    turn = run["ground_turn"][i]
    c, s = cos(turn), sin(turn)
    centre = [run["ground_x"][i] + 0.55 * c, run["ground_y"][i] + 0.55 * s]
    seen = viewed(degrees(turn) + 180 - 22, 12, 125, place)
    spot = lambda r: seen([r[0] - centre[0], r[1] - centre[1], r[2]])
    at = lambda link, r=(0, 0, 0): spot(apply(links[link][0], r))
    ground = lambda x, y: spot([centre[0] + x * c - y * s, centre[1] + x * s + y * c, 0])
    for y in (-0.8, -0.4, 0, 0.4, 0.8):
        page.line([ground(-1.2, y), ground(1.2, y)], PALE, 1)
    for x in (-1.2, -0.6, 0, 0.6, 1.2):
        page.line([ground(x, -0.8), ground(x, 0.8)], PALE, 1)
    for link, colour in (("front_wheel", RED), ("rear_wheel", GREEN)):
        radius = RADII[link]
        (rotation, _), *_ = links[link]
        rim = [at(link, (radius * cos(a), 0, radius * sin(a))) for a in (2 * pi * k / 60 for k in range(61))]
        page.line(rim, colour, 3)
        for k in range(3):
            a = pi * k / 3
            page.line([at(link, (radius * cos(a), 0, radius * sin(a))), at(link, (-radius * cos(a), 0, -radius * sin(a)))], GREY, 0.7)
    rear, front = at("rear_wheel"), at("front_wheel")
    seat, crank, head = at("rear_frame", (0.18, 0, 0.62)), at("rear_frame", (0.42, 0, -0.02)), at("fork", (-0.26, 0, 0.86))
    low = at("fork", (-0.22, 0, 0.72))
    page.line([rear, crank, seat, rear], BLUE, 3)
    page.line([crank, low], BLUE, 3)
    page.line([seat, head], BLUE, 3)
    page.line([at("rear_frame", (0.08, 0, 0.68)), at("rear_frame", (0.3, 0, 0.68))], INK, 4)
    bar = at("fork", (-0.3, 0, 0.98))
    page.line([front, head, bar], INK, 3)
    page.line([at("fork", (-0.33, -0.26, 0.98)), bar, at("fork", (-0.33, 0.26, 0.98))], INK, 3)


# The robot -------------------------------------------------------------------------------------------------


def robot_path(bgdyn, folder):
    own, run = machine("differential_drive"), Run(folder, "robot_path")
    beside = Run(Path(folder) / "beside", "robot_path")
    rolls(run, own)
    rows = range(len(run.t))
    fact(f"sideways velocity: at most {max(map(abs, run['base_y_velocity'])):.1e} m/s")
    planned, poses, moves = ([f(t) for t in run.t] for f in (plan_path.plan, plan_path.pose, plan_path.motion))
    off = [max(abs(run[n][i] - planned[i][k]) for k, n in enumerate(("right", "left"))) for i in rows]
    away = [hypot(run["base_x"][i] - poses[i][0], run["base_y"][i] - poses[i][1]) for i in rows]
    fact(f"wheels from the plan: at most {max(off):.1e} rad; robot: at most {max(away):.1e} m, {away[-1]:.1e} m at the end")
    fact(f"figure: {plan_path.LENGTH[-1]:.3f} m long; up to {max(m[0] for m in moves):.2f} m/s, turning with up to {max(abs(m[1]) for m in moves):.2f} rad/s")
    torques = asked(bgdyn, run)
    # In the middle between two points of the tables their slope is that of the curve.
    middles = [i for i, t in enumerate(run.t) if abs((t / plan_path.STEP) % 1 - 0.5) < 1e-6]
    for k, name in enumerate(("right", "left")):
        u = [torques[i][k] for i in middles]
        fact(f"torque, {name}: {min(u):.3f} to {max(u):.3f} N m")
    far_off = lambda rows: max(abs(a - b) for i in rows for a, b in zip(torques[i], closed(run.t[i])))
    fact(f"torques from the closed form on the plan: at most {far_off(middles):.1e} N m in the middle between points of the tables ({len(middles)} rows), {far_off(rows):.1e} N m at all rows")
    sideways = [plan_path_side(t) for t in run.t]
    weight = G * sum(link["mass"] for link in own.spec["links"])
    most = max(map(abs, sideways))
    fact(f"the wheels hold up to {most:.2f} N sideways, {100 * most / weight:.1f} % of the weight")
    first = beside["right"][0] - planned[0][0]
    errors = [beside["right"][i] - plan_path.plan(t)[0] for i, t in enumerate(beside.t)]
    rate = plan_path.DAMPING / 2
    decay = max(abs(e - first * (1 + rate * t) * exp(-rate * t)) for e, t in zip(errors, beside.t))
    left = max(abs(beside["left"][i] - plan_path.plan(t)[1]) for i, t in enumerate(beside.t))
    fact(f"right wheel moved by {first:.2f} rad at the start: the error is e (1 + {rate:g} t) exp(-{rate:g} t) to {decay:.1e} rad; the left wheel stays on its plan to {left:.1e} rad")
    turn = beside["base_turn"][-1] - poses[-1][2]
    far = hypot(beside["base_x"][-1] - poses[-1][0], beside["base_y"][-1] - poses[-1][1])
    apart = [1000 * hypot(beside["base_x"][i] - p[0], beside["base_y"][i] - p[1]) for i, p in enumerate(map(plan_path.pose, beside.t))]
    after = max(abs(e) for e, t in zip(errors, beside.t) if t >= 2)
    expected = -first * plan_path.RADIUS / (2 * plan_path.HALF)
    fact(f"… the robot ends turned by {degrees(turn):.4f}° (R e / 2 B: {degrees(expected):.4f}°) and {1000 * far:.1f} mm away, up to {max(apart):.1f} mm on the way; its wheel is within {after:.1e} rad after 2 s")

    page = Canvas(960, 685)
    page.text(20, 26, "From above: the path of the middle of the axle; one square is 0.5 m", bold=True)
    legend(page, 20, 46, {"run": BLUE, "plan": SHADE, "run with the right wheel moved by 0.2 rad at the start": RED})
    scale = 150
    spot = lambda x, y: (360 + scale * x, 230 - scale * y)
    for k in range(-4, 5):
        page.line([spot(k / 2, -1.1), spot(k / 2, 1.1)], PALE, 1)
    for k in range(-2, 3):
        page.line([spot(-2.2, k / 2), spot(2.2, k / 2)], PALE, 1)
    page.line([spot(*p[:2]) for p in poses], SHADE, 6)
    page.line([spot(x, y) for x, y in zip(beside["base_x"], beside["base_y"])], RED, 1.4)
    page.line([spot(x, y) for x, y in zip(run["base_x"], run["base_y"])], BLUE, 1.4)
    for t in (0.0, 3.2, 5.2, 9.2, 11.6):
        i = run.at(t)
        robot(page, spot, run["base_x"][i], run["base_y"][i], run["base_turn"][i])
        # The label is at the end that does not hide the path.
        x, y = spot(run["base_x"][i], run["base_y"][i])
        aside = {0.0: (0, 58), 3.2: (58, -18), 5.2: (60, 34), 9.2: (62, 10), 11.6: (-58, 22)}[t]
        page.text(x + aside[0], y + aside[1], f"{t:g} s", GREY, 12, "middle")
    page.text(730, 90, "The robot:", bold=True)
    big = lambda x, y: (820 + 190 * x, 220 - 190 * y)
    robot(page, big, 0, 0, pi / 2)
    page.text(big(-0.25, 0)[0] - 12, big(0, 0)[1] + 4, "left", GREY, 12, "end")
    page.text(big(0.25, 0)[0] + 12, big(0, 0)[1] + 4, "right", GREY, 12)
    page.disc(big(0, 0.06), 3.5, RED)
    page.line([big(0.0, 0.06), big(0.2, -0.25)], GREY, 0.8)
    page.text(big(0.1, 0)[0], big(0, -0.25)[1] + 16, "centre of mass", GREY, 12, "middle")
    ticks = [0, 3, 6, 9, 12, 15]
    page.text(50, 462, "Torques of the wheels, N m", bold=True)
    legend(page, 250, 462, {"right": BROWN, "left": GREEN})
    plot = Plot(page, (50, 482, 450, 652), ticks, [-0.8, -0.4, 0, 0.4, 0.8], "")
    for k, colour in ((0, BROWN), (1, GREEN)):
        plot.curve([run.t[i] for i in middles], [torques[i][k] for i in middles], colour)
    page.text(530, 462, "The red run: distance from the plan, mm", bold=True)
    plot = Plot(page, (530, 482, 930, 652), ticks, [0, 25, 50, 75, 100], "")
    plot.curve(beside.t, apart, RED)
    write(page, HERE / "robot_path.svg")


def robot(page, spot, x, y, heading):
    c, s = cos(heading), sin(heading)
    at = lambda u, v: spot(x + c * u - s * v, y + s * u + c * v)
    page.area([at(-0.12, -0.2), at(0.2, -0.2), at(0.28, 0), at(0.2, 0.2), at(-0.12, 0.2)], SHADE, BLUE, 0.8)
    for v in (-0.25, 0.25):
        page.area([at(-0.1, v - 0.025), at(0.1, v - 0.025), at(0.1, v + 0.025), at(-0.1, v + 0.025)], INK, INK)
    page.line([at(0, -0.25), at(0, 0.25)], INK, 1.2)


def asked(bgdyn, run):
    """The torques of the controllers in each row."""
    names = ("base_x", "base_y", "base_turn", "right", "left", "right_rate", "left_rate")
    states = [{"t": t, "y": {n: run[n][i] for n in names}} for i, t in enumerate(run.t)]
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump({"states": states}, file)
        file.flush()
        command = [bgdyn, "eval", HERE / "robot_path.scene.yaml", "input", "--states", file.name]
        found = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    columns = [found["names"].index(n) for n in ("right", "left")]
    return [[result[k] for k in columns] for result in found["results"]]


# The cart's mass and its centre's distance ahead of the axle; wheels; moments of inertia about the middle of the axle
# and of a wheel about its axle, from specs/constraints/differential_drive.yaml.
CART, AHEAD, WHEEL = 10.0, 0.06, 0.5
TURNING, SPIN = 0.4 + CART * AHEAD**2 + 2 * (0.003 + WHEEL * plan_path.HALF**2), 0.005


def closed(t):
    """The torques on the plan, from the equations of a cart with two wheels in closed form."""
    (v, w), (a, aa) = plan_path.motion(t), plan_path.changes(t)
    push = (CART + 2 * WHEEL) * a - CART * AHEAD * w * w
    moment = TURNING * aa + CART * AHEAD * w * v
    found = []
    for sign in (1, -1):
        rate, change = (v + sign * plan_path.HALF * w) / plan_path.RADIUS, (a + sign * plan_path.HALF * aa) / plan_path.RADIUS
        force = push / 2 + sign * moment / (2 * plan_path.HALF)
        found.append(force * plan_path.RADIUS + SPIN * change + plan_path.BEARING * rate)
    return found


def plan_path_side(t):
    """The force along the axle that the plan asks of the wheels."""
    (v, w), (_, aa) = plan_path.motion(t), plan_path.changes(t)
    return (CART + 2 * WHEEL) * v * w + CART * AHEAD * aa


# The coin --------------------------------------------------------------------------------------------------

RADIUS = 0.5


def leans(run, own):
    """The angle of the coin from upright in each row."""
    axles = [turned(own.links(row(run, i))["coin"][0][0], [0, 1, 0]) for i in range(len(run.t))]
    return [atan2(n[2], hypot(n[0], n[1])) for n in axles]


def rolling_disc(bgdyn, folder):
    own, run = machine("rolling_disc"), Run(folder, "rolling_disc")
    small, slow = (Run(Path(folder) / n, "rolling_disc") for n in ("small", "slow"))
    found = rolls(run, own)
    energies = conserves(run, own)
    lean = leans(run, own)
    fact(f"height from radius times cosine of the lean: at most {max(abs(z - RADIUS * cos(a)) for z, a in zip(run['free_z'], lean)):.1e} m")
    lengths = [sqrt(sum(x * x for x in run.quaternion("free", i))) for i in range(len(run.t))]
    fact(f"length of the quaternion from 1: at most {max(abs(x - 1) for x in lengths):.1e}")
    fact(f"lean {degrees(min(lean)):.2f}° to {degrees(max(lean)):.2f}°")
    lows = [i for i in range(1, len(lean) - 1) if lean[i] >= lean[i - 1] and lean[i] > lean[i + 1]]
    gaps = [run.t[b] - run.t[a] for a, b in zip(lows, lows[1:])]
    fact(f"{len(lows)} times low in {run.t[-1]:g} s, every {min(gaps):.4f} to {max(gaps):.4f} s")
    kinetic = [k for k, _ in energies]
    fact(f"kinetic energy {min(kinetic):.2f} to {max(kinetic):.2f} J")
    own_lean = leans(small, own)
    speed = small["free_ry_velocity"][0]
    change = [b - a for a, b in zip(own_lean, own_lean[1:])]
    pairs = [(change[i - 1] + change[i + 1], change[i]) for i in range(1, len(change) - 1)]
    wobble = acos(sum(a * b for a, b in pairs) / sum(b * b for _, b in pairs) / 2) / (small.t[1] - small.t[0])
    law = sqrt(2.4 * speed**2 - 0.8 * G / RADIUS)
    fact(f"lean {degrees(own_lean[0]):.1f}°, {speed:g} rad/s: wobble {wobble:.4f} rad/s, small wobble in closed form {law:.4f} rad/s; lean up to {max(abs(degrees(x)) for x in own_lean):.2f}°")
    fact(f"least speed of upright rolling in closed form: {sqrt(G / (3 * RADIUS)):.4f} rad/s")
    fact(f"lean 1°, {slow['free_ry_velocity'][0]:g} rad/s: lean up to {max(abs(degrees(x)) for x in leans(slow, own)):.1f}°")

    page = Canvas(960, 730)
    points = [w["rim"][0] for w in found]
    shots = (0, lows[1], lows[3])
    page.text(20, 26, f"The coin at three times, and the path of its contact until {run.t[shots[-1]]:.2f} s", bold=True)
    spot = viewed(-62, 36, 150, (275, 250))
    for k in range(-5, 6, 2):
        page.line([spot([k / 4, -1.25, 0]), spot([k / 4, 1.25, 0])], PALE, 1)
        page.line([spot([-1.25, k / 4, 0]), spot([1.25, k / 4, 0])], PALE, 1)
    page.line([spot(p) for p in points[: shots[-1] + 1]], BROWN, 1.6)
    for i in sorted(shots, key=lambda i: spot(points[i])[1]):
        (rotation, place), *_ = own.links(row(run, i))["coin"]
        rim = [spot(apply((rotation, place), [RADIUS * cos(a), 0, RADIUS * sin(a)])) for a in (2 * pi * k / 90 for k in range(91))]
        page.area(rim, SHADE, BLUE, 0.75)
        page.disc(spot(points[i]), 4, RED)
        x, y = spot(place)
        page.text(x, y - 3, f"{run.t[i]:.2f} s", INK, 12, "middle")
        page.text(x, y + 13, f"lean {degrees(lean[i]):.0f}°", INK, 12, "middle")
    page.disc((30, 44), 4, RED)
    page.text(40, 48, "contact", GREY, 12)
    page.text(570, 26, "From above: the path of the contact in 10 s", bold=True)
    page.text(570, 46, "one square is 0.5 m", GREY, 12)
    above = lambda p: (750 + 140 * p[0], 235 - 140 * p[1])
    for k in range(-2, 3):
        page.line([above([k / 2, -1.25]), above([k / 2, 1.25])], PALE, 1)
        page.line([above([-1.25, k / 2]), above([1.25, k / 2])], PALE, 1)
    page.line([above(p) for p in points], BROWN, 1.4)
    page.disc(above(points[0]), 4, RED)
    x, y = above(points[0])
    page.text(x + 6, y - 6, "start", RED, 12)
    ticks = [0, 2, 4, 6, 8, 10]
    page.text(50, 512, "Lean, degrees", bold=True)
    plot = Plot(page, (50, 540, 450, 700), ticks, [0, 30, 60, 90], "")
    plot.curve(run.t, [degrees(x) for x in lean], BLUE)
    page.text(530, 512, "Energy, J", bold=True)
    legend(page, 620, 512, {"kinetic": GREEN, "of height": BROWN, "sum": INK})
    plot = Plot(page, (530, 540, 930, 700), ticks, [0, 2, 4, 6, 8], "")
    plot.curve(run.t, kinetic, GREEN)
    plot.curve(run.t, [p for _, p in energies], BROWN)
    plot.curve(run.t, [sum(e) for e in energies], INK)
    write(page, HERE / "rolling_disc.svg")


MACHINES = (bicycle, robot_path, rolling_disc, rattleback)

if __name__ == "__main__":
    bgdyn, folder, *others = sys.argv[1:]
    names = [name for name in others if name != "--draw"]
    for one in MACHINES:
        if one.__name__ in names or not names:
            print(one.__name__)
            one(bgdyn, folder)
