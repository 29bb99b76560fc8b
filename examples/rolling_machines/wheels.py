"""Where links are and how they move, in plain Python: from a mechanism's file, positions and rates of its joints.

It knows revolute, continuous, prismatic, planar and floating joints, and the wheels of `constraints`. Nothing of it
comes from `bgdyn`, so that slip and gaps of wheels are measured independently.
"""

import sys
from math import cos, sin, sqrt
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(1, str(HERE / "../closed_machines"))

from tree import about, apply, axis, joined, origin, read, times

UP = [0.0, 0.0, 1.0]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def turned(rotation, r):
    return [dot(row, r) for row in rotation]


def of_quaternion(x, y, z, w):
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]


def direction(spec):
    return axis(spec) if isinstance(spec, str) else spec


def to_contact(wheel, rotation):
    """From the centre to the lowest point, in the world: of the rim of a wheel, or of an ellipsoid."""
    if "radii" in wheel:
        squares = [r * r for r in wheel["radii"]]
        scaled = [a * z for a, z in zip(squares, rotation[2])]
        height = sqrt(dot(scaled, rotation[2]))
        return [-x / height for x in turned(rotation, scaled)]
    axle, radius = turned(rotation, direction(wheel["axis"])), wheel["radius"]
    upright = sqrt(axle[0] ** 2 + axle[1] ** 2)
    return [-radius * (z - axle[2] * n) / upright for z, n in zip(UP, axle)]


class Machine:
    """A mechanism of a file."""

    def __init__(self, path):
        self.spec = read(path)
        self.wheels = {name: c for name, c in self.spec["constraints"].items() if c["type"] == "rolling"}

    def joint(self, joint, row):
        """Pose, angular velocity and velocity of the origin after a joint, in the axes before it; `row` gives the
        columns of a table by their names."""
        name = joint["name"]
        if joint["type"] == "floating":
            rotation = of_quaternion(*(row(f"{name}_q{a}") for a in "xyzw"))
            spin = turned(rotation, [row(f"{name}_r{a}_velocity") for a in "xyz"])
            speed = turned(rotation, [row(f"{name}_{a}_velocity") for a in "xyz"])
            return (rotation, [row(f"{name}_{a}") for a in "xyz"]), spin, speed
        if joint["type"] == "planar":
            rotation = about(UP, row(f"{name}_turn"))
            speed = turned(rotation, [row(f"{name}_x_velocity"), row(f"{name}_y_velocity"), 0.0])
            return (rotation, [row(f"{name}_x"), row(f"{name}_y"), 0.0]), [0, 0, row(f"{name}_turn_rate")], speed
        along, q, v = direction(joint["axis"]), row(name), row(f"{name}_rate")
        if joint["type"] == "prismatic":
            return (origin(None)[0], [q * x for x in along]), [0, 0, 0], [v * x for x in along]
        return (about(along, q), [0, 0, 0]), [v * x for x in along], [0, 0, 0]

    def links(self, row):
        """Of each link its pose, its angular velocity, and the velocity of its origin, in the world."""
        found = {"world": (origin(None), [0.0] * 3, [0.0] * 3)}
        for link in self.spec["links"]:
            pose, spin, speed = found[link.get("parent", "world")]
            base = joined(pose, origin(link["joint"].get("origin")))
            own, turning, moving = self.joint(link["joint"], row)
            place = joined(base, own)
            arm = [b - a for a, b in zip(pose[1], place[1])]
            carried = [a + b + c for a, b, c in zip(speed, cross(spin, arm), turned(base[0], moving))]
            found[link["name"]] = place, [a + b for a, b in zip(spin, turned(base[0], turning))], carried
        return found

    def contacts(self, row):
        """Of each wheel or ellipsoid: its lowest point, and the velocity of the material there."""
        links, found = self.links(row), {}
        for name, wheel in self.wheels.items():
            (rotation, centre), spin, speed = links[wheel["link"]]
            arm = to_contact(wheel, rotation)
            point = [a + b for a, b in zip(centre, arm)]
            found[name] = point, [a + b for a, b in zip(speed, cross(spin, arm))]
        return found

    def energy(self, row, gravity=9.81):
        """Kinetic and potential energy of all bodies."""
        links, kinetic, potential = self.links(row), 0.0, 0.0
        for link in self.spec["links"]:
            if "inertia" not in link:
                continue
            (rotation, place), spin, speed = links[link["name"]]
            com = turned(rotation, link.get("com", [0, 0, 0]))
            own = [dot(column, spin) for column in zip(*rotation)]
            tensor = lambda i, j: link["inertia"].get("xyz"[min(i, j)] + "xyz"[max(i, j)], 0.0)
            kinetic += sum(own[i] * tensor(i, j) * own[j] for i in range(3) for j in range(3)) / 2
            moving = [a + b for a, b in zip(speed, cross(spin, com))]
            kinetic += link["mass"] * dot(moving, moving) / 2
            potential += link["mass"] * gravity * (place[2] + com[2])
        return kinetic, potential
