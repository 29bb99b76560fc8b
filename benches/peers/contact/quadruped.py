"""The quadruped of specs/contact as a model of MuJoCo, and its state at the start, from the same files."""

import math
from pathlib import Path

import yaml

SPECS = Path(__file__).resolve().parents[3] / "specs/contact"
MACHINE = yaml.safe_load((SPECS / "quadruped.yaml").read_text())
SCENE = yaml.safe_load((SPECS / "quadruped_rigid.scene.yaml").read_text())
FRICTION = next(e["soles"]["friction"] for e in SCENE["effects"] if isinstance(e, dict))
UNITS = {"m": 1.0, "mm": 1e-3, "deg": math.pi / 180}


def number(x):
    """A number of a file, in SI units."""
    if not isinstance(x, str):
        return float(x)
    value, unit = x.split()[:2]
    return float(value) * UNITS[unit]


def text(numbers):
    return " ".join(repr(float(x)) for x in numbers)


def quaternion(roll, pitch, yaw):
    """(w, x, y, z) of Rz(yaw) Ry(pitch) Rx(roll)."""
    (a, b), (c, d), (e, f) = [(math.cos(x / 2), math.sin(x / 2)) for x in (roll, pitch, yaw)]
    return [a * c * e + b * d * f, b * c * e - a * d * f, a * d * e + b * c * f, a * c * f - b * d * e]


LINKS = MACHINE["links"]
JOINTS = [link["joint"]["name"] for link in LINKS[1:]]
AXES = {"x": "1 0 0", "y": "0 1 0", "z": "0 0 1"}
DAMPING = float(MACHINE["effects"]["bearings"]["damping"].split()[0])


def inertia(link):
    one = link["inertia"]
    if "solid" in one:
        x, y, z = one["size"]
        return [link["mass"] / 12 * s for s in (y * y + z * z, x * x + z * z, x * x + y * y)]
    return [one["xx"], one["yy"], one["zz"]]


def body(link, contact):
    """A link with what it carries."""
    name, joint = link["name"], link["joint"]
    place = joint.get("origin", {}).get("xyz", [0, 0, 0])
    lines = [f'<body pos="{text(place)}">']
    if joint["type"] == "floating":
        lines.append("<freejoint/>")
    else:
        lines.append(f'<joint name="{joint["name"]}" axis="{AXES[joint["axis"]]}" damping="{DAMPING}"/>')
    lines.append(f'<inertial pos="{text(link["com"])}" mass="{link["mass"]}" diaginertia="{text(inertia(link))}"/>')
    touches = f'contype="1" conaffinity="2" {contact}'
    for frame in MACHINE["frames"]:
        if frame["link"] == name:
            sole = next(c for c in MACHINE["contacts"].values() if c["link"] == frame["name"])
            at = text(frame["origin"]["xyz"])
            lines.append(f'<geom type="sphere" size="{number(sole["radius"])}" pos="{at}" {touches}/>')
    for box in MACHINE["contacts"].values():
        if box["link"] == name:
            lines.append(f'<geom type="box" size="{text(x / 2 for x in box["size"])}" {touches}/>')
    lines += [body(other, contact) for other in LINKS if other.get("parent") == name]
    return "".join(lines) + "</body>"


def xml(h, softness, options):
    contact = f'condim="3" friction="{FRICTION} 0 0" {softness}'
    drives = "".join(
        f'<position joint="{name}" kp="{pd["pd"]["stiffness"]}" kv="{pd["pd"]["damping"]}"/>'
        for name, pd in ((name, SCENE["inputs"][name]) for name in JOINTS)
    )
    return (
        f'<mujoco><compiler autolimits="false"/>'
        f'<option timestep="{h!r}" integrator="implicitfast" cone="elliptic" {options}/>'
        f'<worldbody><geom type="plane" size="0 0 1" contype="2" conaffinity="1" {contact}/>{body(LINKS[0], contact)}</worldbody>'
        f"<actuator>{drives}</actuator></mujoco>"
    )


START = SCENE["initial"]
POSE = [number(x) for x in START["base"]["xyz"]] + quaternion(*[number(x) for x in START["base"]["rpy"]])
POSITIONS = POSE + [number(START.get(name, 0)) for name in JOINTS]
TARGETS = [number(SCENE["inputs"][name]["pd"]["target"]) for name in JOINTS]


def values(d):
    """Place of the trunk, and the joints."""
    return [*d.qpos[:3], *d.qpos[7:]]
