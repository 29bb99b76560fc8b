"""The two mechanisms: planar links about z, pins that close the loops, drives, the reference at the end."""

import json
import math
from pathlib import Path

GOLDEN = Path(__file__).resolve().parents[3] / "tests/golden/loops"
GRAVITY = (0.0, -9.81, 0.0)


def link(name, parent, origin, mass, com, inertia):
    """A link with a joint about z; `parent` is an index or None, `inertia` (xx, yy, zz) about the centre of mass."""
    return {"name": name, "parent": parent, "origin": origin, "mass": mass, "com": com, "inertia": inertia}


def reference(name):
    data = json.loads((GOLDEN / f"{name}.json").read_text())
    return data["columns"], data["samples"]


def parallelograms(end):
    """Two parallelograms from upright; the error is that of the end of the first rod, m."""
    rod = lambda name, parent, x: link(name, parent, (x, 0.0, 0.0), 1.0, (0.5, 0.0, 0.0), (0.0, 1 / 12, 1 / 12))
    columns, samples = reference("parallelograms")
    last = min(samples, key=lambda s: abs(s[0] - end))
    x, y = (last[columns.index(c)] for c in ("x_B0", "y_B0"))
    upright = math.pi / 2
    return {
        "name": "parallelograms",
        "links": [rod("rod0", None, 0.0), rod("coupler1", 0, 1.0), rod("rod1", None, 1.0),
                  rod("coupler2", 2, 1.0), rod("rod2", None, 2.0)],
        "pins": [(1, (1.0, 0.0, 0.0), 2, (1.0, 0.0, 0.0)), (3, (1.0, 0.0, 0.0), 4, (1.0, 0.0, 0.0))],
        "q": [upright, -upright, upright, -upright, upright],
        "v": [-1.0, 1.0, -1.0, 1.0, -1.0],
        "drives": {},
        "end": last[0],
        "error": lambda q: math.hypot(math.cos(q[0]) - x, math.sin(q[0]) - y),
        "compared": [0],
        # 3 rods of 1 m and 2 couplers: T = 3 α̇²/2, V = 3.5 g cos α, upright with 1 rad/s.
        "energy_at_end": 1.5 + 3.5 * 9.81,
        "energy_unit": 24.5,
    }


def five_bar(end):
    """A five-bar with drives and springs at its cranks; the error is the larger one of both cranks, rad."""
    data = json.loads((GOLDEN / "five_bar_parallel.json").read_text())
    columns, samples = data["columns"], data["samples"]
    last = min(samples, key=lambda s: abs(s[0] - end))
    at = lambda sample, c: sample[columns.index(c)]
    names = [b["name"] for b in data["mechanism"]]
    links = [
        link(b["name"], None if b["parent"] == "world" else names.index(b["parent"]),
             # The file has the moment about z, which is all that matters in a plane.
             tuple(map(float, b["origin_in_parent"])), b["mass"], tuple(map(float, b["com"])), (b["inertia_com"][2],) * 3)
        for b in data["mechanism"]
    ]
    cranks = [names.index("proximal1"), names.index("proximal2")]
    return {
        "name": "five_bar",
        "links": links,
        "pins": [(names.index("distal1"), (0.35, 0.0, 0.0), names.index("distal2"), (0.35, 0.0, 0.0))],
        "q": [at(samples[0], n) for n in names],
        "v": [0.0] * len(names),
        "drives": {
            cranks[0]: lambda t, q: -20 * (q - 1.9) + 3 * math.sin(4 * t) + 1.2,
            cranks[1]: lambda t, q: -20 * (q - 1.2) + 2 * math.cos(3 * t) - 0.5,
        },
        "end": last[0],
        "error": lambda q: max(abs(q[k] - at(last, names[k])) for k in cranks),
        "compared": cranks,
        "energy_at_end": at(last, "energy"),
        "energy_unit": 4.7,
    }


def gap(mechanism, place):
    """The largest distance of two pins; `place(link, point)` is a point in the world."""
    return max(math.dist(place(a, p), place(b, r)) for a, p, b, r in mechanism["pins"])
