"""Imports MJCFs of Python packages and compares them with MuJoCo at random states.

    mjcf.py BGDYN FOLDER [TABLE.md]

BGDYN is the command; every *.xml below FOLDER whose root is <mujoco> and that has a <worldbody> with bodies is
taken. Compared are the mass matrix (mj_fullM, without armature) and the bias (mj_rne), in bgdyn's coordinates:
docs/conventions.md has the conversion. Prints a line per file, writes a table if asked, and fails where a
difference is above 1e-9, a result is not finite, or no file can be compared.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import mujoco
import numpy as np

FREE, BALL, SLIDE, HINGE = (int(getattr(mujoco.mjtJoint, f"mjJNT_{name}")) for name in ("FREE", "BALL", "SLIDE", "HINGE"))

STATES = 5
MOST = 1e-9
STILL = "no moving joint"


def run(*command):
    return subprocess.run(command, capture_output=True, text=True)


def rotation(quaternion):
    """Matrix of a quaternion w, x, y, z."""
    matrix = np.zeros(9)
    mujoco.mju_quat2Mat(matrix, quaternion)
    return matrix.reshape(3, 3)


class Conversion:
    """State of a model in MuJoCo's coordinates and in bgdyn's."""

    def __init__(self, model, followers):
        self.model = model
        # Joint: (leader, ratio, offset), chains resolved.
        self.followers = followers
        self.joints = [j for j in range(model.njnt) if j not in followers]

    def random(self, rng):
        """q of MuJoCo and the same q of bgdyn."""
        model = self.model
        q, own = np.zeros(model.nq), []
        for j in self.joints:
            at = model.jnt_qposadr[j]
            kind = int(model.jnt_type[j])
            if kind == FREE:
                q[at : at + 3] = rng.uniform(-1, 1, 3)
                own += list(q[at : at + 3])
                at += 3
            if kind in (FREE, BALL):
                quaternion = rng.normal(size=4)
                quaternion /= np.linalg.norm(quaternion)
                q[at : at + 4] = quaternion
                w, x, y, z = quaternion
                own += [x, y, z, w]
            else:
                q[at] = rng.uniform(-1, 1)
                own.append(q[at])
        for j, (leader, ratio, offset) in self.followers.items():
            q[model.jnt_qposadr[j]] = ratio * q[model.jnt_qposadr[leader]] + offset
        return q, own

    def map(self, q, v):
        """T and Ṫ v, with v_MuJoCo = T v."""
        model = self.model
        columns, rates, at = [], np.zeros(model.nv), 0
        for j in self.joints:
            row = model.jnt_dofadr[j]
            kind = int(model.jnt_type[j])
            count = {FREE: 6, BALL: 3}.get(kind, 1)
            block = np.zeros((model.nv, count))
            block[row : row + count] = np.eye(count)
            if kind == FREE:
                place = model.jnt_qposadr[j]
                turn = rotation(q[place + 3 : place + 7])
                block[row : row + 3, :3] = turn
                linear, angular = v[at : at + 3], v[at + 3 : at + 6]
                rates[row : row + 3] = turn @ np.cross(angular, linear)
            for follower, (leader, ratio, _) in self.followers.items():
                if leader == j:
                    block[model.jnt_dofadr[follower]] = ratio
            columns.append(block)
            at += count
        return np.hstack(columns), rates


def followers(model):
    """Joints with a linear equality to another joint, as the importer takes them."""
    own = {}
    for e in range(model.neq):
        first, second = model.eq_obj1id[e], model.eq_obj2id[e]
        data = model.eq_data[e]
        scalar = (SLIDE, HINGE)
        if int(model.eq_type[e]) != int(mujoco.mjtEq.mjEQ_JOINT) or second < 0 or data[1] == 0 or np.any(data[2:5]):
            continue
        if any(int(model.jnt_type[j]) not in scalar for j in (first, second)) or first in own or not model.eq_active0[e]:
            continue
        leader = second
        while leader in own and leader != first:
            leader = own[leader][0]
        if leader == first:
            # It would close a circle.
            continue
        y, x = (model.qpos0[model.jnt_qposadr[j]] for j in (first, second))
        own[first] = (second, data[1], data[0] + y - data[1] * x)
    for joint, (leader, ratio, offset) in list(own.items()):
        while leader in own:
            leader, r, b = own[leader]
            offset, ratio = ratio * b + offset, ratio * r
        own[joint] = (leader, ratio, offset)
    return own


def compiled(model):
    """The model without armature, which is an effect of a scene and no part of a mechanism, with the conversion."""
    model.dof_armature[:] = 0
    mujoco.mj_setConst(model, mujoco.MjData(model))
    return Conversion(model, followers(model))


def reference(conversion, q, v):
    """M and bias by MuJoCo in bgdyn's coordinates, with MuJoCo's data of the state."""
    model = conversion.model
    turn, rates = conversion.map(q, v)
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = q, turn @ v
    mujoco.mj_forward(model, data)
    full, h = np.zeros((model.nv, model.nv)), np.zeros(model.nv)
    mujoco.mj_fullM(model, data, full)
    mujoco.mj_rne(model, data, 0, h)
    return turn.T @ full @ turn, turn.T @ (full @ rates + h), data


def results(bgdyn, spec, method, states):
    done = run(bgdyn, "eval", str(spec), method, "--states", str(states))
    if done.returncode:
        raise RuntimeError(f"{method}: {done.stderr[:300]} {done.stdout[-500:]}")
    return np.array(json.loads(done.stdout)["results"], dtype=float)


def with_inertials(file, folder):
    """The file as MuJoCo saves it, with an <inertial> in each body: meshes are no longer needed for masses."""
    spec = mujoco.MjSpec.from_file(str(file))
    for attribute in ("meshdir", "texturedir"):
        given = getattr(spec.compiler, attribute) or "."
        setattr(spec.compiler, attribute, str((file.parent / given).resolve()))
    spec.compiler.saveinertial = True
    spec.compile()
    saved = folder / file.name
    saved.write_text(spec.to_xml())
    return saved


def imported(bgdyn, file, spec):
    done = run(bgdyn, "import", str(file), "-o", str(spec))
    return None if done.returncode == 0 else done.stderr.splitlines()[-1].split(": ", 2)[-1]


def compared(bgdyn, file, folder, rng):
    stem = re.sub(r"[^a-z0-9]+", "_", file.stem.lower()).strip("_")
    spec = folder / f"{stem}.yaml"
    try:
        mujoco.MjModel.from_xml_path(str(file))
    except (ValueError, RuntimeError) as error:
        return "not read by MuJoCo: " + str(error).splitlines()[0]
    note = ""
    refusal = imported(bgdyn, file, spec)
    if refusal and "`saveinertial`" in refusal:
        note = "inertia of meshes, as saved by MuJoCo"
        file = with_inertials(file, folder)
        refusal = imported(bgdyn, file, spec)
    if refusal:
        return "not imported: " + refusal
    report = json.loads(run(bgdyn, "check", "--json", str(spec)).stdout)
    if not report["ok"]:
        rules = {f["rule"] for f in report["findings"] if f["severity"] == "fault"}
        return "refused: " + ", ".join(sorted(rules))
    conversion = compiled(mujoco.MjModel.from_xml_path(str(file)))
    count = report["model"]["nv"]
    if count == 0:
        return STILL
    pairs = [conversion.random(rng) for _ in range(STATES)]
    velocities = [rng.uniform(-1, 1, count) for _ in pairs]
    states = [{"q": own, "v": v.tolist()} for (_, own), v in zip(pairs, velocities)]
    path = folder / "states.json"
    path.write_text(json.dumps({"states": states}))
    matrices = results(bgdyn, spec, "mass_matrix", path)
    biases = results(bgdyn, spec, "bias", path)
    worst = [0.0, 0.0]
    for (q, _), v, ours, bias in zip(pairs, velocities, matrices, biases):
        theirs, wanted, _ = reference(conversion, q, v)
        ours = ours.reshape(count, count)
        # The largest of a NaN and a number is the number.
        for numbers in (ours, bias, theirs, wanted):
            assert np.isfinite(numbers).all(), f"{file}: a result is not finite"
        # Relative to the largest entry; the bias at least to the efforts of unit accelerations.
        size = np.abs(theirs).max()
        worst[0] = max(worst[0], np.abs(ours - theirs).max() / size)
        worst[1] = max(worst[1], np.abs(bias - wanted).max() / max(size, np.abs(wanted).max()))
    return count, len(conversion.followers), worst, note


def robots(below):
    for file in sorted(Path(below).rglob("*.xml")):
        text = file.read_text(errors="replace")
        if re.search(r"<mujoco[\s>]", text) and "<body" in text:
            yield file


def main(bgdyn, below, table=None):
    rng = np.random.default_rng(1)
    worst, equal, still, rows = 0.0, 0, 0, []
    bgdyn, below = Path(bgdyn).resolve(), Path(below).resolve()
    table = table and Path(table).resolve()
    with tempfile.TemporaryDirectory() as folder:
        # MuJoCo writes its log into the current folder.
        os.chdir(folder)
        for file in robots(below):
            found = compared(bgdyn, file, Path(folder), rng)
            label = str(file.relative_to(below))
            if isinstance(found, tuple):
                count, follow, differences, note = found
                worst, equal = max(worst, *differences), equal + int(max(differences) <= MOST)
                mass, bias = (f"{x:.1e}" for x in differences)
                rows.append(f"| {label} | {count} | {mass} | {bias} | {note} |")
                found = f"{count} velocities, {follow} followers, M {mass}, bias {bias} {note}"
            else:
                still += found == STILL
                rows += [f"| {label} | | | | {found} |"] * (found != STILL)
            print(f"{label}: {found[:200]}", flush=True)
    print(f"{equal} equal to MuJoCo {mujoco.__version__}, {still} without a moving joint, largest difference {worst:.1e}")
    if table:
        head = "| file | velocities | M | bias | |\n|---|---|---|---|---|\n"
        table.write_text(head + "\n".join(rows) + "\n")
    # Without a file that can be compared nothing was shown.
    sys.exit(int(worst > MOST or equal == 0))


if __name__ == "__main__":
    main(*sys.argv[1:])
