"""Places of a mechanism's links, from its file and the positions of its joints, in plain Python.

It reads as much of YAML as the mechanisms of this folder need, and knows revolute, continuous and prismatic
joints. Nothing of it comes from `bgdyn`, so that the gaps of loops are measured independently.
"""

import re
from math import cos, pi, sin, sqrt

UNITS = {"m": 1.0, "mm": 1e-3, "rad": 1.0, "deg": pi / 180, "kg": 1.0}
AXES = {"x": [1, 0, 0], "y": [0, 1, 0], "z": [0, 0, 1]}


def scalar(text):
    """A number, also one with a unit of length, angle or mass, or the text."""
    found = re.fullmatch(r"([-+0-9.eE]+)(?: (\w+))?", text.strip())
    if found and found[2] in (None, *UNITS):
        return float(found[1]) * UNITS.get(found[2], 1.0)
    return text.strip()


def flow(text):
    """A value in one line: {…}, […] or a scalar."""
    tokens = re.findall(r"[{}\[\],]|[^{}\[\],]+", text)

    def value():
        token = tokens.pop(0)
        if token == "[":
            found = []
            while (token := tokens.pop(0)) != "]":
                if token.strip() and token != ",":
                    tokens.insert(0, token)
                    found.append(value())
            return found
        if token == "{":
            found = {}
            while (token := tokens.pop(0)) != "}":
                if token.strip() and token != ",":
                    key, rest = token.split(":", 1)
                    if rest.strip():
                        tokens.insert(0, rest)
                    found[key.strip()] = value()
            return found
        return scalar(token) if token.strip() else value()

    return value()


def block(lines):
    """A block of lines (indent, text)."""
    if lines[0][1].startswith("- "):
        starts = [i for i, (indent, _) in enumerate(lines) if indent == lines[0][0]] + [len(lines)]
        items = [lines[a:b] for a, b in zip(starts, starts[1:])]
        opened = lambda item: [(item[0][0] + 2, item[0][1][2:].strip())] + item[1:]
        return [flow(item[0][1][2:]) if item[0][1][2:].lstrip().startswith("{") else block(opened(item)) for item in items]
    found, at = {}, 0
    while at < len(lines):
        indent, text = lines[at]
        key, rest = text.split(":", 1)
        end = at + 1
        while end < len(lines) and lines[end][0] > indent:
            end += 1
        found[key.strip()] = flow(rest.strip()) if rest.strip() else block(lines[at + 1 : end])
        at = end
    return found


def read(path):
    texts = [line.split(" #")[0].rstrip() for line in path.read_text().splitlines()]
    kept = [t for t in texts if t.strip() and not t.lstrip().startswith("#")]
    return block([(len(t) - len(t.lstrip()), t.strip()) for t in kept])


def about(axis, angle):
    """The rotation about a unit axis, row by row."""
    (x, y, z), c, s = axis, cos(angle), sin(angle)
    d = 1 - c
    return [
        [c + x * x * d, x * y * d - z * s, x * z * d + y * s],
        [x * y * d + z * s, c + y * y * d, y * z * d - x * s],
        [x * z * d - y * s, y * z * d + x * s, c + z * z * d],
    ]


def times(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def apply(pose, r):
    """The point r of a body in the world."""
    rotation, place = pose
    return [place[i] + sum(rotation[i][k] * r[k] for k in range(3)) for i in range(3)]


def joined(a, b):
    """The pose b, given in a, in the world."""
    return times(a[0], b[0]), apply(a, b[1])


def origin(spec):
    """The pose of an `origin` with `xyz` and `rpy`."""
    spec = spec or {}
    roll, pitch, yaw = spec.get("rpy", [0, 0, 0])
    turn = times(about(AXES["z"], yaw), times(about(AXES["y"], pitch), about(AXES["x"], roll)))
    return turn, spec.get("xyz", [0, 0, 0])


def axis(word):
    sign = -1 if word.startswith("-") else 1
    return [sign * x for x in AXES[word.lstrip("-")]]


class Tree:
    """A mechanism of a file."""

    def __init__(self, path):
        self.spec = read(path)
        self.joints = [link["joint"]["name"] for link in self.spec["links"]]

    def poses(self, q):
        """The pose of every link and frame, from the position of each joint by its name."""
        found = {"world": origin(None)}
        for link in self.spec["links"]:
            joint = link["joint"]
            base = joined(found[link.get("parent", "world")], origin(joint.get("origin")))
            along = axis(joint["axis"])
            if joint["type"] == "prismatic":
                moved = origin(None)[0], [q[joint["name"]] * x for x in along]
            else:
                moved = about(along, q[joint["name"]]), [0, 0, 0]
            found[link["name"]] = joined(base, moved)
        for frame in self.spec.get("frames", []):
            found[frame["name"]] = joined(found[frame["link"]], origin(frame.get("origin")))
        return found

    def gaps(self, q):
        """For each loop the distance of its two places."""
        poses = self.poses(q)
        place = lambda spec: joined(poses[spec["link"]], origin(spec.get("origin")))[1]
        return [distance(place(loop["a"]), place(loop["b"])) for loop in self.spec["loops"]]


def distance(a, b):
    return sqrt(sum((x - y) ** 2 for x, y in zip(a, b)))
