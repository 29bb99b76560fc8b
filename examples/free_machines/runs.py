"""Reads the tables of `bgdyn simulate`, and computes momenta with `bgdyn eval`."""

import csv
import json
import subprocess
import tempfile
from pathlib import Path

HERE = Path(__file__).parent


class Run:
    """The table of a run: a list per column, by its name without the unit."""

    def __init__(self, folder, name):
        self.name = name
        with open(Path(folder) / f"{name}.csv", encoding="utf-8") as file:
            head, *rows = list(csv.reader(file))
        self.columns = {h.split(" [")[0]: [float(row[i]) for row in rows] for i, h in enumerate(head)}
        self.t = self.columns["t"]

    def __getitem__(self, name):
        return self.columns[name]

    def at(self, t):
        """The row at a time, or the next one."""
        return next((i for i, x in enumerate(self.t) if x >= t - 1e-9), len(self.t) - 1)

    def place(self, name, i):
        """Where a link or frame is in the world in a row."""
        return [self[f"{name}_{axis}"][i] for axis in "xyz"]

    def quaternion(self, joint, i):
        return [self[f"{joint}_q{axis}"][i] for axis in "xyzw"]

    def row(self, names, i):
        return [self[name][i] for name in names]


def turned(q, r):
    """The vector r, turned by a unit quaternion x, y, z, w."""
    u, w = q[:3], q[3]
    cross = lambda a, b: [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    c = cross(u, r)
    cc = cross(u, c)
    return [r[k] + 2 * (w * c[k] + cc[k]) for k in range(3)]


def momenta(bgdyn, name, qs, vs):
    """M v in each state: the momenta that belong to the velocities, in link axes."""
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump({"states": [{"q": q} for q in qs]}, file)
        file.flush()
        command = [bgdyn, "eval", HERE / f"{name}.yaml", "mass_matrix", "--states", file.name]
        found = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    return [[sum(m * x for m, x in zip(row, v)) for row in matrix] for matrix, v in zip(found["results"], vs)]
