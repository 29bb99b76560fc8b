"""Measures and draws the runs of the rattleback."""

from math import cos, degrees, hypot, pi, sin
from pathlib import Path

from canvas import BLUE, BROWN, GREEN, GREY, INK, PALE, RED, SHADE, Canvas, Plot, fact, write
from measures import conserves, legend, machine, rolls, row, viewed
from runs import Run
from wheels import apply

HERE = Path(__file__).parent


def tilts(run, own):
    """In each row: the pitch of the long axis and the roll of the short one, from the level, rad."""
    found = []
    for i in range(len(run.t)):
        (rotation, _), *_ = own.links(row(run, i))["stone"]
        found.append((-rotation[2][0], rotation[2][1]))
    return found


def ellipse(pose, radii, a, b):
    """A section of the ellipsoid by two of its axes; only the half below its middle is of the stone."""
    points = []
    for k in range(61):
        at = [0.0, 0.0, 0.0]
        at[a] += radii[a] * cos(pi * k / 60)
        at[b] += radii[b] * (-sin(pi * k / 60) if b == 2 else sin(pi * k / 60))
        points.append(apply(pose, at))
    return points


def stone(page, own, run, i, place, scale=640):
    """The stone in a row of the table, from beside, as half an ellipsoid."""
    pose, *_ = own.links(row(run, i))["stone"]
    centre = [run["free_x"][i], run["free_y"][i], 0]
    seen = viewed(-60, 32, scale, place)
    spot = lambda r: seen([r[0] - centre[0], r[1] - centre[1], r[2]])
    for k in range(-2, 3):
        ends = ([-0.2, 0.1 * k, 0], [0.2, 0.1 * k, 0]), ([0.1 * k, -0.2, 0], [0.1 * k, 0.2, 0])
        for line in ends:
            page.line([seen(p) for p in line], PALE, 1)
    radii = own.spec["constraints"]["table"]["radii"]
    rim = [apply(pose, [radii[0] * cos(2 * pi * k / 90), radii[1] * sin(2 * pi * k / 90), 0]) for k in range(91)]
    keel = ellipse(pose, radii, 0, 2)
    page.area([spot(p) for p in keel], SHADE, BLUE, 0.9)
    page.area([spot(p) for p in rim], SHADE, BLUE, 0.75)
    # The end of the long axis, so that turning can be seen.
    page.disc(spot(apply(pose, [radii[0], 0, 0])), 4, RED)


def rattleback(bgdyn, folder):
    own, run = machine("rattleback"), Run(folder, "rattleback")
    other = Run(Path(folder) / "other", "rattleback")
    found = rolls(run, own)
    conserves(run, own)
    rolls(other, own, "the other way")
    conserves(other, own)
    spin = run["free_rz_velocity"]
    stop = next(i for i in range(1, len(spin)) if spin[i] <= 0)
    back = next(i for i in range(stop, len(spin)) if spin[i] <= -0.99 * spin[0])
    fact(f"spin {spin[0]:g} rad/s at the start, 0 at {run.t[stop]:.2f} s, {min(spin):.3f} rad/s at least; -0.99 of the first at {run.t[back]:.2f} s")
    tilt = tilts(run, own)
    most = [max(abs(degrees(t[k])) for t in tilt) for k in (0, 1)]
    at = [max(range(len(tilt)), key=lambda i: abs(tilt[i][k])) for k in (0, 1)]
    fact(f"pitch up to {most[0]:.2f}° (at {run.t[at[0]]:.2f} s), roll up to {most[1]:.2f}° (at {run.t[at[1]]:.2f} s)")
    fact(f"in the first second: pitch up to {max(abs(degrees(t[0])) for t in tilt[: run.at(1)]):.3f}°, roll up to {max(abs(degrees(t[1])) for t in tilt[: run.at(1)]):.3f}°")
    slowed = other["free_rz_velocity"]
    fact(f"the other way: {slowed[0]:g} rad/s becomes {slowed[-1]:.3f} rad/s in {other.t[-1]:g} s")
    path = [w["table"][0] for w in found]
    far = max(hypot(p[0] - path[0][0], p[1] - path[0][1]) for p in path)
    fact(f"the contact stays within {1000 * far:.0f} mm of its first place")

    page = Canvas(960, 735)
    page.text(20, 26, "The stone at three times: it spins, it rattles, it spins the other way", bold=True)
    for i, x in ((run.at(0.6), 170), (stop, 480), (run.at(11), 790)):
        stone(page, own, run, i, (x, 165))
        page.text(x, 285, f"{run.t[i]:.1f} s", INK, 12, "middle")
        turning = f"{spin[i]:.1f}".replace("-", "−").replace("−0.0", "0.0")
        page.text(x, 302, f"{turning} rad/s", GREY, 12, "middle")
    ticks = [0, 2, 4, 6, 8, 10, 12]
    page.text(50, 342, "Spin about its vertical axis, rad/s", bold=True)
    legend(page, 330, 342, {"counterclockwise": BLUE, "clockwise": GREEN})
    plot = Plot(page, (50, 362, 930, 522), ticks, [-6, -3, 0, 3, 6], "")
    plot.curve(other.t, slowed, GREEN)
    plot.curve(run.t, spin, BLUE)
    page.text(50, 568, "Tilt of the stone that turns back, degrees", bold=True)
    legend(page, 400, 568, {"pitch of its long axis": BROWN, "roll about it": RED})
    plot = Plot(page, (50, 588, 930, 708), ticks, [-10, 0, 10], "")
    plot.curve(run.t, [degrees(t[1]) for t in tilt], RED, 1)
    plot.curve(run.t, [degrees(t[0]) for t in tilt], BROWN, 1)
    write(page, HERE / "rattleback.svg")
