"""What figures.py and rattleback.py share: facts in words, slip and energy of a run, drawing."""

import sys
from math import cos, pi, sin, sqrt
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(1, str(HERE / "../free_machines"))

from canvas import GREY, fact
from wheels import Machine, dot

G = 9.81


def machine(name):
    return Machine(HERE / f"../../specs/constraints/{name}.yaml")


def row(run, i):
    return lambda name: run[name][i]


def rolls(run, own, words="all rows"):
    """The largest slip and gap of the wheels, and the drift of the energy, in all rows of the table."""
    found = [own.contacts(row(run, i)) for i in range(len(run.t))]
    slip = max(sqrt(dot(v, v)) for wheels in found for _, v in wheels.values())
    gap = max(abs(p[2]) for wheels in found for p, _ in wheels.values())
    fact(f"{words}: wheels slip by at most {slip:.1e} m/s, gap at most {gap:.1e} m, in {len(run.t)} rows")
    return found


def conserves(run, own):
    energies = [own.energy(row(run, i)) for i in range(len(run.t))]
    totals = [sum(e) for e in energies]
    fact(f"energy, from the table: {totals[0]:.3f} J, changes by at most {max(abs(e - totals[0]) for e in totals):.1e} J")
    return energies


def viewed(turn, rise, scale, place):
    """A parallel projection of the world onto the page, from `turn` and `rise` in degrees."""
    ct, st, cr, sr = (f(x * pi / 180) for x in (turn, rise) for f in (cos, sin))

    def project(r):
        across, away = -st * r[0] + ct * r[1], ct * r[0] + st * r[1]
        return (place[0] + scale * across, place[1] - scale * (cr * r[2] - sr * away))

    return project


def legend(page, x, y, names):
    for name, colour in names.items():
        page.line([(x, y - 4), (x + 14, y - 4)], colour, 2.2)
        page.text(x + 18, y, name, GREY, 12)
        x += 34 + 6.6 * len(name)
