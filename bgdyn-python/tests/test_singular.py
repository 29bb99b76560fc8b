"""States without a result."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from numpy.typing import NDArray

import bgdyn
from conftest import SPECS

# A mass that slides along a turning rod: M = diag(m r², m), singular at r = 0.
POLAR = """
format: 1
gravity: [0, 0, 0]
links:
  - name: rod
    joint: { name: turn, type: continuous, axis: z }
    mass: 0
  - name: bead
    parent: rod
    joint: { name: reach, type: prismatic, axis: x }
    mass: 2
"""


Array = NDArray[np.float64]


@pytest.fixture(scope="module")
def polar() -> bgdyn.Model:
    return bgdyn.load(text=POLAR, name="polar")


@pytest.fixture
def states() -> tuple[Array, Array, Array]:
    """Six states, (2, 3), of which (0, 2) and (1, 0) are singular."""
    q, v, tau = np.full((2, 3, 2), 0.5), np.full((2, 3, 2), 0.3), np.full((2, 3, 2), 4.0)
    q[0, 2, 1] = q[1, 0, 1] = 0.0
    return q, v, tau


@pytest.mark.parametrize("threads", [1, 2, 6])
def test_the_first_singular_state_is_named(
    polar: bgdyn.Model, states: tuple[Array, Array, Array], threads: int
) -> None:
    message = r"state \(0, 2\): singular mass matrix: joint `turn` has no inertia left to accelerate"
    with pytest.raises(bgdyn.SingularError, match=message) as caught:
        polar.forward_dynamics(*states, threads=threads)
    error = caught.value
    assert isinstance(error, ArithmeticError)
    assert (error.index, error.joint, error.loop) == ((0, 2), "turn", None)
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.index, again.joint) == (str(error), (0, 2), "turn")


def test_a_single_singular_state(polar: bgdyn.Model) -> None:
    with pytest.raises(bgdyn.SingularError, match=r"^singular mass matrix: joint `turn`") as caught:
        polar.forward_dynamics(np.zeros(2), np.zeros(2), np.zeros(2))
    assert caught.value.index == ()


@pytest.mark.parametrize("threads", [1, 4])
def test_singular_states_are_filled_and_masked(
    polar: bgdyn.Model, states: tuple[Array, Array, Array], threads: int
) -> None:
    q, v, tau = states
    out = np.zeros((2, 3, 2))
    found, mask = polar.forward_dynamics(q, v, tau, out=out, threads=threads, on_singular="nan")
    assert found is out
    assert mask.tolist() == [[False, False, True], [True, False, False]]
    assert np.isnan(found[mask]).all()
    # m r² θ̈ + 2 m r ṙ θ̇ = τ and m (r̈ − r θ̇²) = F.
    r, (turning, sliding) = q[..., 1][~mask], v[~mask].T
    by_hand = (tau[~mask][:, 0] - 4 * r * sliding * turning) / (2 * r * r), tau[~mask][:, 1] / 2 + r * turning**2
    assert found[~mask] == pytest.approx(np.stack(by_hand, axis=1), rel=1e-13)
    slopes, same = polar.forward_dynamics_derivatives(q, v, tau, on_singular="nan")
    assert (same == mask).all() and np.isnan(slopes.tau[mask]).all()
    assert slopes.tau[~mask][:, 1, 1] == pytest.approx(0.5)


def test_methods_without_division_do_not_refuse(polar: bgdyn.Model, states: tuple[Array, Array, Array]) -> None:
    q, v, a = states
    tau = polar.inverse_dynamics(q, v, a)
    assert np.isfinite(tau).all()
    assert (polar.mass_matrix(q)[0, 2] == np.diag([0.0, 2.0])).all()


def test_unknown_ways(polar: bgdyn.Model) -> None:
    with pytest.raises(ValueError, match='it is "raise" or "nan"'):
        polar.forward_dynamics([0, 1], [0, 0], [0, 0], on_singular="ignore")  # type: ignore[call-overload]


def test_loops_that_do_not_close() -> None:
    model = bgdyn.load(SPECS / "loops" / "four_bar.yaml")
    start = model.close(model.neutral())
    assert np.abs(model.constraint_residual(start)).max() < 1e-15
    far = np.array([[0.3, 0.0, 1.0], [np.nan, 0.0, 0.0]])
    assert np.isfinite(model.close(far)[0]).all() and np.isnan(model.close(far)[1]).all()
    bars = bgdyn.load(SPECS / "loops" / "five_bar.yaml")
    far = np.stack([bars.neutral(), [3.1, 0.0, 0.0, 0.0]])  # the elbows 0.8 m apart, the rods 0.35 m long each
    with pytest.raises(bgdyn.SingularError, match=r"state \(1,\): the loops do not close from here: `tip_pin`") as caught:
        bars.close(far)
    assert caught.value.loop == "tip_pin" and caught.value.index == (1,)
    closed, mask = bars.close(far, on_singular="nan")
    assert mask.tolist() == [False, True] and np.isnan(closed[1]).all()
    with pytest.raises(ValueError, match="has no loops"):
        bgdyn.load(text=POLAR, name="polar").close(np.zeros(2))
