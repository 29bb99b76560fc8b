"""Writes golden.json: mass matrices, biases and poses of sites of everything.xml, by MuJoCo.

    golden.py

Needs mujoco and numpy; the conversion of states is that of benches/peers/mjcf.py. The variants are those of
bgdyn-cli/tests/import/mjcf.rs.
"""

import json
import os
import sys
import tempfile
from pathlib import Path

import mujoco
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "../../../benches/peers"))

from mjcf import compiled, reference  # noqa: E402

COMPILER = '<compiler angle="degree" eulerseq="xYz" inertiagrouprange="0 3"/>'
VARIANTS = {
    "everything": [],
    "bounds": [
        (COMPILER, '<compiler boundmass="0.4" boundinertia="0.012" angle="radian" settotalmass="9" eulerseq="ZYX"/>')
    ],
    "balance": [
        (COMPILER, '<compiler balanceinertia="true" boundinertia="0.001" autolimits="false"/>'),
        ('fullinertia="0.02 ', 'fullinertia="0.05 '),
        (' range="-30 120"', ""),
        (' range="0 0.1"', ""),
    ],
    "geoms": [(COMPILER, '<compiler inertiafromgeom="true"/>')],
}
STATES = 2


def golden(text, rng):
    conversion = compiled(mujoco.MjModel.from_xml_string(text))
    model = conversion.model
    states = []
    for _ in range(STATES):
        q, own = conversion.random(rng)
        v = rng.uniform(-1, 1, model.nv - len(conversion.followers))
        mass, bias, data = reference(conversion, q, v)
        sites = {model.site(i).name: [*data.site_xmat[i], *data.site_xpos[i]] for i in range(model.nsite)}
        states.append(
            {
                "q": list(own),
                "v": v.tolist(),
                "mass_matrix": mass.ravel().tolist(),
                "bias": bias.tolist(),
                "sites": sites,
            }
        )
    return states


def main():
    # MuJoCo writes its log into the current folder.
    os.chdir(tempfile.mkdtemp())
    rng = np.random.default_rng(7)
    everything = (HERE / "everything.xml").read_text()
    models = {}
    for name, changes in VARIANTS.items():
        text = everything
        for old, new in changes:
            assert old in text
            text = text.replace(old, new)
        models[name] = golden(text, rng)
    result = {"source": f"MuJoCo {mujoco.__version__}", "models": models}
    (HERE / "golden.json").write_text(json.dumps(result, indent=1) + "\n")


if __name__ == "__main__":
    main()
