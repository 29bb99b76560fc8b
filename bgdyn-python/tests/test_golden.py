"""Values of Pinocchio, by the files of the repository: for specs, and for the URDFs that they were made from."""

from __future__ import annotations

import json
import warnings
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import bgdyn
from conftest import GOLDEN

NAMES = [
    "dpend2", "iiwa_gen", "panda7", "panda_gen", "puma560", "puma_arm", "puma_gen", "scara4", "scara_rrpr",
    "stanford_gen", "ur5_gen",
]  # fmt: skip


def near(found: NDArray[np.float64], states: list[Any], key: str, tolerance: float) -> None:
    """Compares a batch with the states' values of a key, relative to the largest of a state."""
    for one, state in zip(found, states, strict=True):
        wanted = np.array(state[key]).reshape(one.shape)
        assert np.abs(one - wanted).max() <= tolerance * max(1.0, np.abs(wanted).max()), key


@pytest.mark.parametrize("source", ["spec", "urdf"])
@pytest.mark.parametrize("name", NAMES)
def test_values_of_pinocchio(name: str, source: str) -> None:
    golden = json.loads((GOLDEN / "values" / f"{name}.json").read_text())
    if source == "spec":
        model = bgdyn.load(GOLDEN / "specs" / f"{name}.yaml")
    else:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", bgdyn.LossWarning)
            model = bgdyn.load(urdf=GOLDEN / "urdf" / f"{name}.urdf")
    states: list[Any] = golden["states"]
    assert model.joint_names == tuple(golden["joints"])
    q, v, a, tau_in = (np.array([s[k] for s in states]) for k in ("q", "v", "a", "tau_in"))
    near(model.inverse_dynamics(q, v, a), states, "tau", 1e-12)
    near(model.forward_dynamics(q, v, tau_in), states, "qdd", 1e-9)
    near(model.gravity(q), states, "g", 1e-12)
    near(model.bias(q, v), states, "nle", 1e-12)
    near(np.asarray(model.kinetic_energy(q, v)), states, "T", 1e-12)
    n = sum("M" in state for state in states)
    assert n > 0
    near(model.mass_matrix(q[:n]), states[:n], "M", 1e-12)
    n = sum("dtau_dq" in state for state in states)
    by_inverse = model.inverse_dynamics_derivatives(q[:n], v[:n], a[:n])
    by_forward = model.forward_dynamics_derivatives(q[:n], v[:n], tau_in[:n])
    near(by_inverse.q, states[:n], "dtau_dq", 1e-9)
    near(by_inverse.v, states[:n], "dtau_dv", 1e-9)
    near(by_forward.q, states[:n], "dqdd_dq", 1e-6)
    near(by_forward.v, states[:n], "dqdd_dv", 1e-6)


@pytest.mark.parametrize("name", ["panda7", "puma560", "scara4"])
def test_second_derivatives_of_pinocchio(name: str) -> None:
    model = bgdyn.load(GOLDEN / "specs" / f"{name}.yaml")
    states = json.loads((GOLDEN / "second" / f"{name}.json").read_text())["states"]
    q, v, a, factors = (np.array([s[k] for s in states]) for k in ("q", "v", "a", "l"))
    of_number = np.stack(model.inverse_dynamics_curvature(q, v, a, factors), axis=1)
    near(of_number, states, "curvature", 1e-12)
    second = model.inverse_dynamics_second(q, v, a)
    contracted = [np.einsum("si,sijk->sjk", factors, matrices) for matrices in second]
    near(np.stack(contracted, axis=1), states, "curvature", 1e-12)
    for key, matrices in second._asdict().items():
        near(matrices[:1], [states[0]["second"]], key, 1e-12)
