"""Values against equations of motion written out by hand."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest
from numpy.typing import NDArray

import bgdyn
from conftest import SPECS

Array = NDArray[np.float64]
G = 9.81


def double_pendulum(q: Array, v: Array) -> tuple[Array, Array, float, float]:
    """Returns M, bias, kinetic and potential energy of two masses of 1 kg on rods of 1 m."""
    (q1, q2), (v1, v2) = q, v
    c2, s2, s1, s12 = math.cos(q2), math.sin(q2), math.sin(q1), math.sin(q1 + q2)
    mass = np.array([[3 + 2 * c2, 1 + c2], [1 + c2, 1.0]])
    bias = np.array(
        [-s2 * (2 * v1 + v2) * v2 + G * (2 * s1 + s12), s2 * v1 * v1 + G * s12]
    )
    # Velocities of the masses, by their own coordinates.
    first = np.array([math.cos(q1), -s1]) * v1
    second = first + np.array([math.cos(q1 + q2), -s12]) * (v1 + v2)
    kinetic = 0.5 * (first @ first + second @ second)
    potential = -G * (2 * math.cos(q1) + math.cos(q1 + q2))
    return mass, bias, kinetic, potential


def test_double_pendulum(random: np.random.Generator) -> None:
    model = bgdyn.load(SPECS / "double_pendulum.yaml")
    q, v, a = random.uniform(-7, 7, (3, 50, 2))
    mass, bias = model.mass_matrix(q), model.bias(q, v)
    kinetic, potential = model.kinetic_energy(q, v), model.potential_energy(q)
    tau, found = model.inverse_dynamics(q, v, a), model.forward_dynamics(q, v, a)
    for k in range(50):
        by_hand = double_pendulum(q[k], v[k])
        assert mass[k] == pytest.approx(by_hand[0], abs=1e-13)
        assert bias[k] == pytest.approx(by_hand[1], abs=1e-11)
        assert kinetic[k] == pytest.approx(by_hand[2], rel=1e-12)
        assert potential[k] == pytest.approx(by_hand[3], abs=1e-12)
        assert tau[k] == pytest.approx(by_hand[0] @ a[k] + by_hand[1], abs=1e-11)
        assert by_hand[0] @ found[k] + by_hand[1] == pytest.approx(a[k], abs=1e-10)


def scara(q: Array, v: Array) -> tuple[Array, Array, complex]:
    """Returns M, bias and the place of the tool in the plane: its links as points in the complex plane.

    Each place is a sum of terms z e^{i w·q}; all joints but the stroke turn about the vertical.
    """
    first, second, last = (1.0, 0.0, 0.0, 0.0), (1.0, 1.0, 0.0, 0.0), (1.0, 1.0, 0.0, -1.0)
    to_elbow, to_quill = (0.325 + 0j, first), (0.275 + 0j, second)
    # Mass, inertia about the vertical, angle, place of the centre of mass. The quill's z points down.
    links = [
        (6.0, 0.0582125, first, [(0.170 + 0.004j, first)]),
        (4.5, 0.0317625, second, [to_elbow, (0.130 - 0.003j, second)]),
        (1.2, 0.0004, second, [to_elbow, to_quill]),
        (0.6, 0.0006, last, [to_elbow, to_quill, (0.012 - 0.005j, last)]),
    ]
    mass, bias = np.zeros((4, 4)), np.zeros(4)
    for m, inertia, angle, terms in links:
        turn = np.array(angle)
        mass += inertia * np.outer(turn, turn)
        slope, curving = np.zeros(4, complex), 0j
        for z, weights in terms:
            w = np.array(weights)
            at = z * cmath.exp(1j * float(w @ q))
            slope += 1j * w * at
            curving -= float(w @ v) ** 2 * at
        mass += m * np.real(np.outer(slope.conj(), slope))
        bias += m * np.real(slope.conj() * curving)
    mass[2, 2] += 1.2 + 0.6
    bias[2] -= (1.2 + 0.6) * G
    tool = sum(z * cmath.exp(1j * float(np.array(w) @ q)) for z, w in [to_elbow, to_quill])
    return mass, bias, tool


def test_scara(random: np.random.Generator) -> None:
    model = bgdyn.load(SPECS / "scara.yaml")
    q, v, a = random.uniform(-3, 3, (3, 50, 4))
    mass, bias = model.mass_matrix(q), model.bias(q, v)
    tau, found = model.inverse_dynamics(q, v, a), model.forward_dynamics(q, v, a)
    pose = model.pose_tool(q)
    for k in range(50):
        mass_by_hand, bias_by_hand, tool = scara(q[k], v[k])
        assert mass[k] == pytest.approx(mass_by_hand, abs=1e-14)
        assert bias[k] == pytest.approx(bias_by_hand, abs=1e-12)
        assert tau[k] == pytest.approx(mass_by_hand @ a[k] + bias_by_hand, abs=1e-12)
        assert mass_by_hand @ found[k] + bias_by_hand == pytest.approx(a[k], abs=1e-9)
        height = 0.45 - q[k, 2] - 0.15 - 0.06
        assert pose.translation[k] == pytest.approx([tool.real, tool.imag, height], abs=1e-15)
        turned = q[k, 0] + q[k, 1] - q[k, 3]
        assert pose.rotation[k] == pytest.approx(
            np.array(
                [
                    [math.cos(turned), math.sin(turned), 0],
                    [math.sin(turned), -math.cos(turned), 0],
                    [0, 0, -1],
                ]
            ),
            abs=1e-14,
        )


@pytest.mark.parametrize("name", ["panda", "puma560", "stanford", "ur5", "torso", "palletiser"])
def test_forward_dynamics_undo_inverse_dynamics(name: str, random: np.random.Generator) -> None:
    model = bgdyn.load(SPECS / f"{name}.yaml")
    q, v, a = random.uniform(-2, 2, (3, 200, model.nv))
    tau = model.inverse_dynamics(q, v, a)
    assert np.abs(model.forward_dynamics(q, v, tau) - a).max() < 1e-10
    assert np.abs(np.einsum("kij,kj->ki", model.mass_matrix(q), a) + model.bias(q, v) - tau).max() < 1e-10


def test_jacobians_are_rates_of_poses(random: np.random.Generator) -> None:
    model = bgdyn.load(SPECS / "ur5.yaml")
    q, v = random.uniform(-3, 3, (2, 20, 6))
    h = 1e-6
    ahead, behind = model.pose_wrist_3(q + h * v), model.pose_wrist_3(q - h * v)
    rate = (ahead.translation - behind.translation) / (2 * h)
    turning = (ahead.rotation - behind.rotation) / (2 * h) @ np.swapaxes(model.pose_wrist_3(q).rotation, 1, 2)
    omega = np.stack([turning[:, 2, 1], turning[:, 0, 2], turning[:, 1, 0]], axis=1)
    velocity = model.velocity_wrist_3(q, v)
    assert velocity == pytest.approx(np.concatenate([omega, rate], axis=1), abs=1e-7)
    assert np.einsum("kij,kj->ki", model.jacobian_world_wrist_3(q), v) == pytest.approx(velocity, abs=1e-13)


def test_derivatives_of_a_snakeboard_are_those_of_differences(random: np.random.Generator) -> None:
    """Its positions change in more directions than it has velocities: all of them may be moved."""
    board = bgdyn.load(SPECS / "constraints/snakeboard.yaml")
    q, v, tau = random.uniform(-1, 1, board.nq), random.uniform(-1, 1, board.nv), random.uniform(-1, 1, board.nv)
    found = board.forward_dynamics_derivatives(q, v, tau)
    tree = len(board.tree_joint_names)
    assert found.q.shape == (board.nv, tree) and found.v.shape == found.tau.shape == (board.nv, board.nv)
    h = 1e-6
    for k in range(board.nv):
        step = np.eye(board.nv)[k] * h
        column = (board.forward_dynamics(q, v + step, tau) - board.forward_dynamics(q, v - step, tau)) / (2 * h)
        np.testing.assert_allclose(found.v[:, k], column, rtol=1e-7, atol=1e-7)
    # Beyond the planar base a velocity is the rate of a position.
    for k in range(3, tree):
        step = np.eye(board.nq)[k] * h
        column = (board.forward_dynamics(q + step, v, tau) - board.forward_dynamics(q - step, v, tau)) / (2 * h)
        np.testing.assert_allclose(found.q[:, k], column, rtol=1e-7, atol=1e-7)
