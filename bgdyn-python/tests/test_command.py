"""Values against those of ``bgdyn eval``, for every method of mechanisms of every kind."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import bgdyn
from conftest import ROOT, SPECS, width

TREES = [
    "specs/cart_pole.yaml", "specs/crane.yaml", "specs/panda.yaml", "specs/scara.yaml", "specs/torso.yaml",
    "specs/constraints/carousel.yaml", "specs/constraints/mimic_gripper.yaml", "specs/constraints/planetary_gear.yaml",
    "tests/free_joints/quadrotor_arm.yaml", "tests/free_joints/spherical_chain3.yaml",
]  # fmt: skip
CLOSED = [
    "specs/loops/four_bar.yaml", "specs/loops/five_bar.yaml", "specs/loops/slider_crank.yaml",
    "specs/constraints/differential_drive.yaml",
    "specs/constraints/snakeboard.yaml",
]  # fmt: skip


def numbers(result: Any) -> list[float]:
    """Returns all numbers of a result of the command or of the package, in one order."""
    match result:
        case {"force": force, "moment": moment}:
            return [*force, *moment]
        case dict():
            return [x for part in result.values() for x in numbers(part)]
        case list():
            return [x for part in result for x in numbers(part)]
        case bgdyn.Wrenches(force, moment):
            return [float(x) for x in np.concatenate([force, moment], axis=-1).ravel()]
        case tuple():
            return [x for part in result for x in numbers(part)]
        case np.ndarray():
            return [float(x) for x in result.ravel()]
        case _:
            return [float(result)]


def positions(model: bgdyn.Model, random: np.random.Generator) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Returns three random positions, with quaternions whose length is 1 to the bit: the command scales others."""
    q = random.uniform(-2, 2, (3, model.nq))
    for k, name in enumerate(model.position_names):
        if name.endswith("_qx"):
            q[:, k : k + 4] = [[0.5, -0.5, 0.5, 0.5], [0.0, 0.6, 0.0, -0.8], [0.8, 0.0, 0.6, 0.0]]
    return q


@pytest.mark.parametrize("path", [*TREES, *CLOSED])
def test_every_method(path: str, evaluated: Callable[..., list[Any]], random: np.random.Generator) -> None:
    model = bgdyn.load(ROOT / path)
    if path in CLOSED:
        # Near the start, so that the loops close.
        q = model.neutral() + np.zeros((3, 1))
        dependent = "constraint_residual" in model.methods
        q = model.close(q + random.uniform(-0.05, 0.05, q.shape)) if dependent else positions(model, random)
    else:
        q = positions(model, random)
    methods = [m for m in model.methods if not m.startswith(("pose_", "velocity_", "jacobian_", "operational_", "consistent_", "payload_")) or m.endswith(model.frame_names[-1])]
    skipped, compared = 0, 0
    for name in methods:
        method = getattr(model, name)
        arguments = {n: q if n == "q" else random.uniform(-3, 3, (3, width(method, n))) for n in method.arguments}
        if "qd" in arguments and name == "constrained_dynamics":
            arguments["qd"] = model.tree_velocity(q, random.uniform(-1, 1, (3, model.nv)))
        found, mask = method(**arguments, on_singular="nan")
        if mask.any():
            assert name.startswith(("operational_", "consistent_")), name
            skipped += 1
            continue
        compared += 1
        wanted = evaluated(ROOT / path, name, **arguments)
        for k in range(3):
            one = type(found)(*(part[k] for part in found)) if isinstance(found, tuple) else found[k]
            mine, theirs = np.array(numbers(one)), np.array(numbers(wanted[k]))
            assert mine.shape == theirs.shape, name
            if path in CLOSED:
                # The command closes the loops once more.
                assert mine == pytest.approx(theirs, rel=1e-11, abs=1e-11 * max(1.0, np.abs(theirs).max(initial=0))), name
            else:
                assert (mine == theirs).all(), name
    # Only frames that some posture, or the joints, do not move in six directions have no inertia.
    assert skipped <= 3 < compared
    assert skipped == 0 or "panda" not in path


def test_a_parameter(evaluated: Callable[..., list[Any]], tmp_path: Path) -> None:
    text = (SPECS / "double_pendulum.yaml").read_text().replace("mass: 1 kg", "mass: { parameter: load, value: 3 kg }", 1)
    file = tmp_path / "double_pendulum.yaml"
    file.write_text(text)
    q = np.array([[0.3, -0.4], [1.0, 2.0]])
    assert (bgdyn.load(file).gravity(q) == np.array(evaluated(file, "gravity", q=q))).all()
