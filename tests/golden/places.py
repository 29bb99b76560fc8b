#!/usr/bin/env python3
"""Poses, velocities, Jacobians and J̇v of links and frames, from the specs, with 60 digits.

Writes places/NAME.json, or checks with --check that they are what is there. Needs mpmath and PyYAML.

It shares no code with bgdyn and no formula of its Jacobians: the pose of a place is the product of
homogeneous transforms along its branch, as Taylor polynomials in time up to t². Their coefficients
are the pose, its rate and half of its second rate. A column of J is the rate with one joint moving at
unit speed, J̇v the second rate at constant v.
"""

import json
import pathlib
import random
import re
import sys

import yaml
from mpmath import mp, mpf

mp.dps = 60
HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent

# Specs, whether all links are evaluated or only tips and frames, and how many states.
SPECS = [
    ("tests/golden/specs/puma560.yaml", True, 4),
    ("tests/golden/specs/panda7.yaml", True, 4),
    ("tests/golden/specs/scara4.yaml", True, 4),
    ("tests/golden/specs/ur5_gen.yaml", False, 4),
    ("tests/golden/specs/iiwa_gen.yaml", False, 4),
    ("tests/golden/specs/stanford_gen.yaml", False, 4),
    ("tests/golden/specs/scara_rrpr.yaml", False, 4),
    ("tests/golden/specs/chain4.yaml", True, 4),
    ("tests/golden/specs/chain8.yaml", False, 4),
    ("tests/golden/specs/chain32.yaml", False, 2),
    ("bgdyn-codegen/tests/outside/general6r.yaml", False, 4),
    ("bgdyn-codegen/tests/outside/two_arms.yaml", False, 4),
    ("tests/chains/branched.yaml", False, 2),
    ("specs/crane.yaml", True, 4),
    ("specs/gantry.yaml", True, 4),
    ("specs/palletiser.yaml", True, 4),
    ("specs/panda.yaml", False, 4),
    ("specs/stanford.yaml", False, 4),
    ("specs/torso.yaml", True, 4),
]

UNITS = {"": mpf(1), "rad": mpf(1), "m": mpf(1), "mm": mpf("1e-3"), "cm": mpf("1e-2"), "deg": mp.pi / 180}


def number(text):
    """A number of a spec, exactly as its decimals say, in SI units."""
    value, unit = re.fullmatch(r"([-+.0-9eE]+)\s*([a-z°]*)", text).groups()
    return mpf(value) * UNITS[unit]


def vector(texts):
    return [number(t) for t in texts]


def matrix(rows):
    return [[mpf(x) for x in row] for row in rows]


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(len(b))) for j in range(len(b[0]))] for i in range(len(a))]


def combined(*terms):
    """Σ factor × matrix."""
    return [[sum(f * m[i][j] for f, m in terms) for j in range(4)] for i in range(4)]


def transform(rotation, place):
    return [list(rotation[i]) + [place[i]] for i in range(3)] + [[mpf(0)] * 3 + [mpf(1)]]


def meant(angle):
    """The quarter turn that is meant, as the format says: within its default `snap`, 1e-11 rad."""
    quarters = mp.nint(angle / (mp.pi / 2))
    return quarters * mp.pi / 2 if abs(angle - quarters * mp.pi / 2) < mpf("1e-11") else angle


def rpy(*angles):
    """About the fixed axes x, y, z, in this order."""
    roll, pitch, yaw = map(meant, angles)
    x = matrix([[1, 0, 0], [0, mp.cos(roll), -mp.sin(roll)], [0, mp.sin(roll), mp.cos(roll)]])
    y = matrix([[mp.cos(pitch), 0, mp.sin(pitch)], [0, 1, 0], [-mp.sin(pitch), 0, mp.cos(pitch)]])
    z = matrix([[mp.cos(yaw), -mp.sin(yaw), 0], [mp.sin(yaw), mp.cos(yaw), 0], [0, 0, 1]])
    return product(z, product(y, x))


def fixed(origin):
    """The transform of an `origin`."""
    turn = rpy(*vector(origin.get("rpy", ["0"] * 3)))
    return transform(turn, vector(origin.get("xyz", ["0"] * 3)))


def direction(axis):
    if isinstance(axis, str):
        sign = -1 if axis.startswith("-") else 1
        return [mpf(sign if axis[-1] == name else 0) for name in "xyz"]
    axis = vector(axis)
    length = mp.sqrt(sum(x * x for x in axis))
    return [x / length for x in axis]


ZERO = transform(matrix([[0] * 3] * 3), [mpf(0)] * 3)
ZERO[3][3] = mpf(0)
ONE = transform(matrix([[1, 0, 0], [0, 1, 0], [0, 0, 1]]), [mpf(0)] * 3)


def moved(joint, q, rate):
    """Taylor coefficients of a joint's transform along q + rate t."""
    n = direction(joint.get("axis", "z"))
    if joint["type"] == "prismatic":
        step = transform(matrix([[0] * 3] * 3), n)
        step[3][3] = mpf(0)
        return [combined((1, ONE), (q, step)), combined((rate, step)), ZERO]
    k = [[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]]
    kk = product(k, k)
    k, kk = ([row + [mpf(0)] for row in m] + [[mpf(0)] * 4] for m in (k, kk))
    sin, cos = mp.sin(q), mp.cos(q)
    return [
        combined((1, ONE), (sin, k), (1 - cos, kk)),
        combined((rate * cos, k), (rate * sin, kk)),
        combined((-rate**2 * sin / 2, k), (rate**2 * cos / 2, kk)),
    ]


def series(a, b):
    """The product of two Taylor polynomials of transforms."""
    return [combined(*[(1, product(a[i], b[k - i])) for i in range(k + 1)]) for k in range(3)]


class Mechanism:
    def __init__(self, text):
        # Scalars stay text: decimals are not rounded to binary.
        spec = yaml.load(text, Loader=yaml.BaseLoader)
        self.links = {link["name"]: link for link in spec["links"]}
        self.joints = []
        for name in self.links:
            self.visit(name)
        self.frames = spec.get("frames", [])

    def visit(self, name):
        """Coordinates come in the order of the links, parents first."""
        link = self.links[name]
        if link.get("parent", "world") != "world":
            self.visit(link["parent"])
        if self.moves(name) and link["joint"]["name"] not in self.joints:
            self.joints.append(link["joint"]["name"])

    def moves(self, name):
        return self.links[name].get("joint", {}).get("type", "fixed") != "fixed"

    def kinds(self):
        of = {l["joint"]["name"]: l["joint"]["type"] for n, l in self.links.items() if self.moves(n)}
        return [of[joint] for joint in self.joints]

    def places(self, everything):
        carriers = {link.get("parent") for link in self.links.values()}
        links = [name for name in self.links if everything or name not in carriers]
        return links + [frame["name"] for frame in self.frames]

    def pose(self, name, q, v):
        """Taylor coefficients of a place's pose."""
        if name == "world":
            return [ONE, ZERO, ZERO]
        for frame in self.frames:
            if frame["name"] == name:
                own = [fixed(frame.get("origin", {})), ZERO, ZERO]
                return series(self.pose(frame["link"], q, v), own)
        link = self.links[name]
        joint = link.get("joint", {"type": "fixed"})
        pose = series(self.pose(link.get("parent", "world"), q, v), [fixed(joint.get("origin", {})), ZERO, ZERO])
        if self.moves(name):
            j = self.joints.index(joint["name"])
            pose = series(pose, moved(joint, q[j], v[j]))
        return pose


def turn(pose):
    return [row[:3] for row in pose[:3]]


def place(pose):
    return [row[3] for row in pose[:3]]


def axial(m):
    """w of the skew part of [w]×."""
    return [(m[2][1] - m[1][2]) / 2, (m[0][2] - m[2][0]) / 2, (m[1][0] - m[0][1]) / 2]


def transposed(m):
    return [list(row) for row in zip(*m)]


def twist(pose):
    """Angular velocity and velocity of the origin, world axes."""
    return axial(product(turn(pose[1]), transposed(turn(pose[0])))) + place(pose[1])


def acceleration(pose):
    """Angular acceleration and acceleration of the origin: of Ω = Ṙ Rᵀ the rate is R̈ Rᵀ + Ṙ Ṙᵀ."""
    second, first = turn(pose[2]), turn(pose[1])
    a, b = product(second, transposed(turn(pose[0]))), product(first, transposed(first))
    rate = [[2 * a[i][j] + b[i][j] for j in range(3)] for i in range(3)]
    return axial(rate) + [2 * x for x in place(pose[2])]


def rounded(x):
    x = float(x)
    return x if abs(x) > 1e-40 else 0.0


def values(mechanism, name, q, v):
    pose = mechanism.pose(name, q, v)
    units = [[mpf(int(i == j)) for i in range(len(q))] for j in range(len(q))]
    columns = [twist(mechanism.pose(name, q, unit)) for unit in units]
    velocity = twist(pose)
    for i in range(6):
        assert abs(sum(c[i] * x for c, x in zip(columns, v)) - velocity[i]) < mpf("1e-50")
    return {
        "rotation": [[rounded(x) for x in row] for row in turn(pose[0])],
        "translation": [rounded(x) for x in place(pose[0])],
        "velocity": [rounded(x) for x in velocity],
        "jacobian": [[rounded(c[i]) for c in columns] for i in range(6)],
        "jacobian_dot_v": [rounded(x) for x in acceleration(pose)],
    }


def written(path, everything, states):
    mechanism = Mechanism((ROOT / path).read_text())
    numbers = random.Random(path)
    found = {"spec": path, "joints": mechanism.joints, "states": []}
    for _ in range(states):
        reach = [1.0 if kind == "prismatic" else 3.2 for kind in mechanism.kinds()]
        q = [numbers.uniform(-size, size) for size in reach]
        v = [numbers.uniform(-2, 2) for _ in reach]
        exact = [[mpf(x) for x in xs] for xs in (q, v)]
        places = {name: values(mechanism, name, *exact) for name in mechanism.places(everything)}
        found["states"].append({"q": q, "v": v, "places": places})
    return json.dumps(found, separators=(",", ":")).replace('{"q"', '\n{"q"').replace('},"', '},\n"') + "\n"


def main():
    check, wrong = "--check" in sys.argv[1:], []
    for path, everything, states in SPECS:
        target = HERE / "places" / (pathlib.Path(path).stem + ".json")
        text = written(path, everything, states)
        if not check:
            target.write_text(text)
        elif not target.exists() or target.read_text() != text:
            wrong.append(target.name)
    if wrong:
        sys.exit("not what the specs say: " + ", ".join(wrong))


main()
