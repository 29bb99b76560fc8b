"""Imports URDFs of robot packages and compares them with Pinocchio at random states.

    urdfs.py BGDYN FOLDER [TABLE.md]

BGDYN is the command; every *.urdf below FOLDER is taken, once with its base fixed and once with `--base floating`.
Compared are the mass matrix and the bias. Followers are independent joints for Pinocchio here, and the ratios of
the file are applied to its results. Prints a line per file, or why it was refused, and writes a table if asked.
Fails where a difference is above 1e-9.
"""

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import pinocchio as pin
import yaml

STATES = 3
MOST = 1e-9
BASES = {"fixed": [], "floating": ["--base", "floating"]}


def run(*command):
    return subprocess.run(command, capture_output=True, text=True)


class Joints:
    """The joints of a spec, by the names that Pinocchio knows them by."""

    def __init__(self, spec, coordinates, floats):
        joints = [link["joint"] for link in yaml.safe_load(spec)["links"] if "joint" in link]
        joints = [joint for joint in joints if joint["type"] != "fixed"]
        label = {joint["name"]: str(joint.get("label", joint["name"])) for joint in joints}
        if floats:
            label["root"] = "root_joint"
        # A parent comes first, even if the file has it later.
        moving = [joint for joint in joints if "mimic" not in joint]
        first = {name: index for index, name in reversed(list(enumerate(coordinates)))}
        moving.sort(key=lambda joint: first.get(joint["name"], first.get(joint["name"] + "_x")))
        self.moving = [(label[joint["name"]], joint["type"]) for joint in moving]
        direct = {}
        for joint in joints:
            if "mimic" in joint:
                mimic = joint["mimic"]
                direct[joint["name"]] = (mimic["joint"], float(mimic.get("ratio", 1)), float(mimic.get("offset", 0)))
        # Follower: (leader, ratio, offset), chains resolved.
        self.followers = {}
        for name, (leader, ratio, offset) in direct.items():
            while leader in direct:
                leader, r, b = direct[leader]
                offset, ratio = ratio * b + offset, ratio * r
            self.followers[label[name]] = (label[leader], ratio, offset)


def place(model, name):
    return model.joints[model.getJointId(name)]


def put(model, q, name, value):
    joint = place(model, name)
    # A continuous joint is a point on the unit circle there.
    q[joint.idx_q : joint.idx_q + joint.nq] = [value] if joint.nq == 1 else [np.cos(value), np.sin(value)]


def state(model, joints, rng):
    """Random q of Pinocchio and of bgdyn, and the matrix from bgdyn's velocities to Pinocchio's."""
    q, own, columns, values = pin.neutral(model), [], [], {}
    for name, kind in joints.moving:
        joint = place(model, name)
        block = np.zeros((model.nv, joint.nv))
        block[joint.idx_v : joint.idx_v + joint.nv] = np.eye(joint.nv)
        if kind == "floating":
            quaternion = rng.normal(size=4)
            seven = np.concatenate([rng.uniform(-1, 1, 3), quaternion / np.linalg.norm(quaternion)])
            q[joint.idx_q : joint.idx_q + 7] = seven
            own += seven.tolist()
        else:
            values[name] = rng.uniform(-1, 1)
            put(model, q, name, values[name])
            own.append(values[name])
            for follower, (leader, ratio, _) in joints.followers.items():
                if leader == name:
                    block[place(model, follower).idx_v] = ratio
        columns.append(block)
    for follower, (leader, ratio, offset) in joints.followers.items():
        put(model, q, follower, ratio * values[leader] + offset)
    return q, own, np.hstack(columns)


def results(bgdyn, spec, method, states):
    done = run(bgdyn, "eval", str(spec), method, "--states", str(states))
    if done.returncode:
        raise RuntimeError(f"{spec.name}: {method}: {done.stderr[:300]}")
    return np.array(json.loads(done.stdout)["results"], dtype=float)


def compared(bgdyn, urdf, folder, rng, base):
    stem = re.sub(r"[^a-z0-9]+", "_", urdf.stem.lower()).strip("_")
    spec = folder / f"{stem}.yaml"
    done = run(bgdyn, "import", str(urdf), "-o", str(spec), *BASES[base])
    if done.returncode:
        return "not imported: " + done.stderr.splitlines()[-1].split(": ", 2)[-1]
    report = json.loads(run(bgdyn, "check", "--json", str(spec)).stdout)
    if not report["ok"]:
        rules = {f["rule"] for f in report["findings"] if f["severity"] == "fault"}
        return "refused: " + ", ".join(sorted(rules))
    count = report["model"]["nv"]
    if count == 0:
        return "no moving joint"
    floats = base == "floating"
    model = pin.buildModelFromUrdf(str(urdf), *([pin.JointModelFreeFlyer()] if floats else []))
    joints = Joints(spec.read_text(), report["model"]["coordinates"], floats)
    data = model.createData()
    samples = [(*state(model, joints, rng), rng.uniform(-1, 1, count)) for _ in range(STATES)]
    states = folder / "states.json"
    states.write_text(json.dumps({"states": [{"q": own, "v": v.tolist()} for _, own, _, v in samples]}))
    matrices = results(bgdyn, spec, "mass_matrix", states)
    biases = results(bgdyn, spec, "bias", states)
    worst = [0.0, 0.0]
    for (q, _, turn, v), ours, bias in zip(samples, matrices, biases):
        mass = pin.crba(model, data, q)
        mass = np.triu(mass) + np.triu(mass, 1).T
        theirs = turn.T @ mass @ turn
        wanted = turn.T @ pin.nonLinearEffects(model, data, q, turn @ v)
        # The largest of a NaN and a number is the number.
        for numbers in (ours, bias, theirs, wanted):
            assert np.isfinite(numbers).all(), f"{urdf}: a result is not finite"
        # Relative to the largest entry; the bias at least to the efforts of unit accelerations.
        size = np.abs(theirs).max()
        worst[0] = max(worst[0], np.abs(ours.reshape(count, count) - theirs).max() / size)
        worst[1] = max(worst[1], np.abs(bias - wanted).max() / max(size, np.abs(wanted).max()))
    return count, len(joints.followers), worst


def main(bgdyn, below, table=None):
    rng = np.random.default_rng(1)
    worst, equal, rows = 0.0, dict.fromkeys(BASES, 0), []
    with tempfile.TemporaryDirectory() as folder:
        for urdf in sorted(Path(below).rglob("*.urdf")):
            cells = []
            for base in BASES:
                found = compared(bgdyn, urdf, Path(folder), rng, base)
                if isinstance(found, tuple):
                    count, follow, differences = found
                    worst, equal[base] = max(worst, *differences), equal[base] + int(max(differences) <= MOST)
                    mass, bias = (f"{x:.1e}" for x in differences)
                    cells += [str(count), str(follow), mass, bias]
                    found = f"{count} velocities, {follow} followers, M {mass}, bias {bias}"
                else:
                    # The first of several reasons is enough for a table.
                    cells += [found.split("; ")[0].split(": correct")[0], "", "", ""]
                print(f"{urdf.stem}, {base}: {found[:200]}", flush=True)
            rows.append(f"| {urdf.stem} | " + " | ".join(cells) + " |")
    counts = ", ".join(f"{count} {base}" for base, count in equal.items())
    print(f"equal to Pinocchio {pin.__version__}: {counts}; largest difference {worst:.1e}")
    if table:
        head = "| file | v, fixed | followers | M | bias | v, floating | followers | M | bias |\n" + "|---" * 9 + "|\n"
        Path(table).write_text(head + "\n".join(rows) + "\n")
    # Without a file that can be compared nothing was shown.
    sys.exit(int(worst > MOST or not all(equal.values())))


if __name__ == "__main__":
    main(*sys.argv[1:])
