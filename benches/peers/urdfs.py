"""Imports URDFs of robot packages and compares inverse dynamics at random states with Pinocchio's.

    urdfs.py BGDYN FOLDER

BGDYN is the command; every *.urdf below FOLDER is taken. Prints a line per file: joints, largest difference
over the largest effort; or why it was refused. Fails where a difference is above 1e-9.
"""

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import pinocchio as pin

STATES = 3
MOST = 1e-9


def told(*command):
    return subprocess.run(command, capture_output=True, text=True)


def state(model, names, rng):
    """Random q, v, a in our order, and Pinocchio's efforts in the same order."""
    ours = rng.uniform(-1, 1, (3, len(names)))
    q, v, a = np.zeros(model.nq), np.zeros(model.nv), np.zeros(model.nv)
    places = []
    for name, x, rate, acceleration in zip(names, *ours):
        joint = model.joints[model.getJointId(name)]
        # A continuous joint is a point on the unit circle there.
        q[joint.idx_q : joint.idx_q + joint.nq] = [x] if joint.nq == 1 else [np.cos(x), np.sin(x)]
        v[joint.idx_v], a[joint.idx_v] = rate, acceleration
        places.append(joint.idx_v)
    efforts = pin.rnea(model, model.createData(), q, v, a)[places]
    return dict(zip("qva", ours.tolist())), efforts


def original_names(yaml, coordinates):
    """Names of the joints in the URDF: a renamed one keeps its old name as its label."""
    labels = dict(re.findall(r"^      name: (\S+)\n      label: (.+)$", yaml, re.M))
    return [labels.get(name, name).strip("'\"") for name in coordinates]


def compared(bgdyn, urdf, folder, rng):
    stem = re.sub(r"[^a-z0-9]+", "_", urdf.stem.lower()).strip("_")
    spec = folder / f"{stem}.yaml"
    run = told(bgdyn, "import", str(urdf), "-o", str(spec))
    if run.returncode:
        return "not imported: " + run.stderr.splitlines()[-1].split(": ", 2)[-1]
    report = json.loads(told(bgdyn, "check", "--json", str(spec)).stdout)
    if not report["ok"]:
        rules = {f["rule"] for f in report["findings"] if f["severity"] == "fault"}
        return "refused: " + ", ".join(sorted(rules))
    coordinates = report["model"]["coordinates"]
    if not coordinates:
        return "0 joints"
    model = pin.buildModelFromUrdf(str(urdf))
    names = original_names(spec.read_text(), coordinates)
    states, efforts = zip(*(state(model, names, rng) for _ in range(STATES)))
    (folder / "states.json").write_text(json.dumps({"states": states}))
    run = told(bgdyn, "eval", str(spec), "inverse_dynamics", "--states", str(folder / "states.json"))
    ours = np.array(json.loads(run.stdout)["results"], dtype=float)
    scale = max(1.0, np.abs(efforts).max())
    return len(coordinates), np.abs(ours - efforts).max() / scale


def main(bgdyn, below):
    rng = np.random.default_rng(1)
    worst, equal = 0.0, 0
    with tempfile.TemporaryDirectory() as folder:
        for urdf in sorted(Path(below).rglob("*.urdf")):
            found = compared(bgdyn, urdf, Path(folder), rng)
            if isinstance(found, tuple):
                joints, difference = found
                worst, equal = max(worst, difference), equal + (difference <= MOST)
                found = f"{joints} joints, {difference:.1e}"
            print(f"{urdf.stem}: {found}", flush=True)
    print(f"{equal} equal to Pinocchio, largest difference {worst:.1e}")
    sys.exit(worst > MOST)


if __name__ == "__main__":
    main(*sys.argv[1:])
