"""Writes loops.json: accelerations of the mechanisms with loops beside it, from MuJoCo's matrices.

    loops.py

Needs mujoco and numpy. MuJoCo holds loops by soft constraints; here its mass matrix M, its bias h and the rows J of its
equality constraints are solved as exact ones: M a + h = J' f, J a = -(dJ/dt) v, at positions that close to rounding.
"""

import json
from pathlib import Path

import mujoco
import numpy as np

HERE = Path(__file__).resolve().parent
STATES = 3
STEP = 1e-6
# Small enough that no loop passes a dead point of its dependent joints.
SPREAD = 0.08


class Machine:
    def __init__(self, path):
        self.model = mujoco.MjModel.from_xml_path(str(path))
        off = mujoco.mjtDisableBit
        self.model.opt.disableflags |= off.mjDSBL_CONTACT | off.mjDSBL_LIMIT
        self.data = mujoco.MjData(self.model)

    def rows(self, q):
        """The gaps and the rows of the equality constraints at a position."""
        self.data.qpos[:], self.data.qvel[:] = q, 0
        mujoco.mj_forward(self.model, self.data)
        count = self.data.nefc
        jacobian = np.zeros((count, self.model.nv))
        for k in range(self.model.nv):
            column = np.zeros(count)
            mujoco.mj_mulJacVec(self.model, self.data, column, np.eye(self.model.nv)[k])
            jacobian[:, k] = column
        equal = np.array(self.data.efc_type[:count]) == mujoco.mjtConstraint.mjCNSTR_EQUALITY
        return np.array(self.data.efc_pos[:count])[equal], jacobian[equal]

    def closed(self, q):
        for _ in range(60):
            gap, jacobian = self.rows(q)
            q = q - np.linalg.pinv(jacobian, rcond=1e-9) @ gap
        assert np.abs(self.rows(q)[0]).max() < 1e-15
        return q

    def state(self, rng):
        n = self.model.nv
        q = self.closed(self.model.qpos0 + SPREAD * rng.standard_normal(n))
        _, jacobian = self.rows(q)
        v = (np.eye(n) - np.linalg.pinv(jacobian, rcond=1e-9) @ jacobian) @ rng.standard_normal(n)
        turning = (self.rows(q + STEP * v)[1] - self.rows(q - STEP * v)[1]) / (2 * STEP)
        self.data.qpos[:], self.data.qvel[:] = q, v
        mujoco.mj_forward(self.model, self.data)
        mass = np.zeros((n, n))
        mujoco.mj_fullM(self.model, self.data, mass)
        count = len(jacobian)
        matrix = np.block([[mass, -jacobian.T], [jacobian, np.zeros((count, count))]])
        side = np.concatenate([-np.array(self.data.qfrc_bias), -turning @ v])
        a = np.linalg.lstsq(matrix, side, rcond=1e-10)[0][:n]
        return {"q": q.tolist(), "v": v.tolist(), "a": a.tolist()}


def main():
    found = {}
    for path in sorted(HERE.glob("loop_*.xml")):
        machine, rng = Machine(path), np.random.default_rng(7)
        joints = [machine.model.joint(i).name for i in range(machine.model.njnt)]
        found[path.stem] = {"joints": joints, "states": [machine.state(rng) for _ in range(STATES)]}
    text = json.dumps({"mujoco": mujoco.__version__, "machines": found}, indent=1)
    (HERE / "loops.json").write_text(text + "\n")


main()
