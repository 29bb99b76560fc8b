"""How positions move, against rotation matrices, matrix exponentials and the geometry of linkages in NumPy."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from numpy.typing import NDArray

import bgdyn
from conftest import ROOT, SPECS

Array = NDArray[np.float64]


def rotation(quaternion: Array) -> Array:
    """Returns the matrix of a unit quaternion x, y, z, w: its columns are q∘(e_k, 0)∘q*."""
    columns = [product(product(quaternion, np.append(e, 0.0)), quaternion * [-1, -1, -1, 1])[:3] for e in np.eye(3)]
    return np.stack(columns, axis=1)


def product(a: Array, b: Array) -> Array:
    """Returns a∘b (Hamilton)."""
    (x, y), (s, t) = (a[:3], b[:3]), (a[3], b[3])
    return np.append(s * y + t * x + np.cross(x, y), s * t - x @ y)


def cross(w: Array) -> Array:
    return np.array([[0.0, -w[2], w[1]], [w[2], 0.0, -w[0]], [-w[1], w[0], 0.0]])


def exponential(a: Array) -> Array:
    """Returns the exponential of a matrix: its series at a / 8, squared three times."""
    small, total, term = a / 8, np.eye(len(a)), np.eye(len(a))
    for k in range(1, 30):
        term = term @ small / k
        total = total + term
    for _ in range(3):
        total = total @ total
    return total


def pose(place: Array, quaternion: Array) -> Array:
    t = np.eye(4)
    t[:3, :3], t[:3, 3] = rotation(quaternion), place
    return t


def moved(linear: Array, angular: Array) -> Array:
    """Returns the pose after the velocities of a body, in its own axes, for one unit of time."""
    twist = np.zeros((4, 4))
    twist[:3, :3], twist[:3, 3] = cross(angular), linear
    return exponential(twist)


@pytest.fixture(scope="module")
def quadrotor() -> bgdyn.Model:
    return bgdyn.load(ROOT / "tests" / "free_joints" / "quadrotor_arm.yaml")


PLANAR = """
format: 1
links:
  - name: puck
    joint: { name: ice, type: planar }
    mass: 1 kg
    inertia: { xx: 1, yy: 1, zz: 1 }
  - name: ball
    parent: puck
    joint: { name: hook, type: spherical }
    mass: 1 kg
    com: [0.1, 0, 0]
    inertia: { xx: 1, yy: 1, zz: 1 }
  - name: rod
    parent: ball
    joint: { name: reach, type: prismatic, axis: x }
    mass: 1 kg
"""


def test_a_floating_joint_moves_by_the_exponential(quadrotor: bgdyn.Model, random: np.random.Generator) -> None:
    q = quadrotor.sample((6, 4), seed=3)
    d = random.uniform(-2, 2, (6, 4, 8))
    d[0, 0, :6] = 0.0
    d[0, 1, 3:6] *= 1e-9
    there = quadrotor.integrate(q, d)
    for k in np.ndindex(6, 4):
        wanted = pose(q[k][:3], q[k][3:7]) @ moved(d[k][:3], d[k][3:6])
        assert pose(there[k][:3], there[k][3:7]) == pytest.approx(wanted, abs=2e-14)
        assert np.linalg.norm(there[k][3:7]) == pytest.approx(1, abs=1e-15)
        assert there[k][7:] == pytest.approx(q[k][7:] + d[k][6:], abs=1e-15)


def test_differences_lead_back(quadrotor: bgdyn.Model) -> None:
    q1, q0 = quadrotor.sample(40, seed=4), quadrotor.sample(40, seed=5)
    d = quadrotor.difference(q1, q0)
    for a, b, step in zip(q1, q0, d, strict=True):
        assert np.linalg.norm(step[3:6]) <= math.pi
        assert pose(b[:3], b[3:7]) @ moved(step[:3], step[3:6]) == pytest.approx(pose(a[:3], a[3:7]), abs=1e-13)
    assert d[:, 6:] == pytest.approx(q1[:, 7:] - q0[:, 7:], abs=1e-15)


def test_position_rates_are_half_a_product(quadrotor: bgdyn.Model, random: np.random.Generator) -> None:
    q, v = quadrotor.sample(20, seed=6), random.uniform(-3, 3, (20, 8))
    rates = quadrotor.position_rates(q, v)
    for at, own, rate in zip(q, v, rates, strict=True):
        assert rate[:3] == pytest.approx(rotation(at[3:7]) @ own[:3], abs=1e-14)
        assert rate[3:7] == pytest.approx(0.5 * product(at[3:7], np.append(own[3:6], 0.0)), abs=1e-14)
        assert rate[7:] == pytest.approx(own[6:])


def test_planar_spherical_and_prismatic_joints(random: np.random.Generator) -> None:
    model = bgdyn.load(text=PLANAR, name="puck")
    assert (model.nq, model.nv) == (8, 7)
    q, d = model.sample(20, seed=1), random.uniform(-2.5, 2.5, (20, 7))
    there, rates, back = model.integrate(q, d), model.position_rates(q, d), model.difference(q[::-1].copy(), q)
    for k in range(20):
        turn = np.array([0, 0, math.sin(q[k, 2] / 2), math.cos(q[k, 2] / 2)])
        flat = np.array([q[k, 0], q[k, 1], 0.0])
        step = np.array([d[k, 0], d[k, 1], 0.0])
        wanted = pose(flat, turn) @ moved(step, np.array([0, 0, d[k, 2]]))
        assert there[k, :2] == pytest.approx(wanted[:2, 3], abs=1e-14) and there[k, 2] == q[k, 2] + d[k, 2]
        assert rotation(there[k, 3:7]) == pytest.approx(rotation(q[k, 3:7]) @ moved(step, d[k, 3:6])[:3, :3], abs=1e-14)
        assert rates[k, :2] == pytest.approx((rotation(turn) @ step)[:2], abs=1e-14)
        assert rates[k, 7] == d[k, 6]
        whole = rotation(q[k, 3:7]) @ moved(step, back[k, 3:6])[:3, :3]
        assert whole == pytest.approx(rotation(q[19 - k, 3:7]), abs=1e-13)


def test_quaternions_of_any_length(random: np.random.Generator) -> None:
    model = bgdyn.load(ROOT / "tests" / "free_joints" / "any_length.yaml")
    unit, v = model.sample(10, seed=2), random.uniform(-1, 1, (10, model.nv))
    long = unit.copy()
    long[:, 3:7] *= 3.0
    long[:, 7:11] *= 0.2
    assert model.integrate(long, v) == pytest.approx(model.integrate(unit, v), abs=1e-14)
    assert model.normalize(long) == pytest.approx(unit, abs=1e-15)
    rates, of_unit = model.position_rates(long, v), model.position_rates(unit, v)
    assert rates[:, :3] == pytest.approx(of_unit[:, :3], abs=1e-14)
    assert rates[:, 3:7] == pytest.approx(3.0 * of_unit[:, 3:7], abs=1e-14)
    assert rates[:, 7:] == pytest.approx(0.2 * of_unit[:, 7:], abs=1e-14)


def test_samples_are_even_and_repeat(quadrotor: bgdyn.Model) -> None:
    q = quadrotor.sample(20000, seed=11)
    assert (q == quadrotor.sample(20000, seed=11)).all() and (q != quadrotor.sample(20000, seed=12)).any()
    assert quadrotor.sample(seed=1).shape == (9,) and quadrotor.sample((2, 3)).shape == (2, 3, 9)
    same = np.random.default_rng(5)
    assert (quadrotor.sample(3, np.random.default_rng(5)) == quadrotor.sample(3, same)).all()
    assert q[:, :3].min() < -0.99 and np.abs(q[:, :3]).max() <= 1 and 3.13 < np.abs(q[:, 7:]).max() <= math.pi
    # Each component of an evenly distributed unit quaternion has the mean square 1/4 and the mean fourth power 1/8.
    assert np.mean(q[:, 3:7] ** 2, axis=0) == pytest.approx(np.full(4, 1 / 4), abs=0.01)
    assert np.mean(q[:, 3:7] ** 4, axis=0) == pytest.approx(np.full(4, 1 / 8), abs=0.01)


def five_bar(q: Array) -> tuple[Array, Array, Array]:
    """Returns the tip by either arm, and on which side of the line between the elbows it is."""
    ends = []
    for base, (first, second) in ((0.0, q[:2]), (0.3, q[2:])):
        elbow = np.array([base + 0.25 * math.cos(first), 0.25 * math.sin(first)])
        ends += [elbow, elbow + 0.35 * np.array([math.cos(first + second), math.sin(first + second)])]
    (x1, y1), (x2, y2) = ends[2] - ends[0], ends[1] - ends[0]
    return ends[1], ends[3], np.sign(x1 * y2 - y1 * x2)


def test_loops_stay_closed_on_their_branch(random: np.random.Generator) -> None:
    model = bgdyn.load(SPECS / "loops" / "five_bar.yaml")
    side = five_bar(model.neutral())[2]
    q = model.sample(60, seed=8)
    d = random.uniform(-0.4, 0.4, (60, 2))
    there, open_ = model.integrate(q, d, on_singular="nan")
    assert 0 < open_.sum() < 40  # the tip is out of reach for some
    for at in (*q, *there[~open_]):
        tips = five_bar(at)
        assert tips[0] == pytest.approx(tips[1], abs=1e-14) and tips[2] == side
    assert there[~open_][:, [0, 2]] == pytest.approx((q[:, [0, 2]] + d)[~open_], abs=1e-15)
    assert np.isnan(there[open_]).all()
    assert model.difference(there[~open_], q[~open_]) == pytest.approx(d[~open_], abs=1e-14)
    with pytest.raises(bgdyn.SingularError, match=rf"state \({np.argmax(open_)},\): the loops do not close") as caught:
        model.integrate(q, d)
    assert caught.value.index == (np.argmax(open_),)


def test_a_long_way_stays_on_the_branch() -> None:
    """A whole turn of the crank in one step: Newton's method from its end would take any branch."""
    model = bgdyn.load(SPECS / "loops" / "four_bar.yaml")
    q = model.neutral()
    ends = model.integrate(q, np.array([[2 * math.pi], [math.pi], [-math.pi]]))
    assert ends[0] == pytest.approx(q + [2 * math.pi, ends[0, 1] - q[1], 0], abs=1e-9)
    assert (ends[0, 1] - q[1] + 2 * math.pi) % (2 * math.pi) == pytest.approx(0, abs=1e-9)
    assert ends[1, 2] == pytest.approx(ends[2, 2], abs=1e-12)


def test_rates_of_loops_are_those_of_the_geometry(random: np.random.Generator) -> None:
    model = bgdyn.load(SPECS / "loops" / "five_bar.yaml")
    q, v = model.sample(10, seed=9), random.uniform(-1, 1, (10, 2))
    rates = model.position_rates(q, v)
    assert rates[:, [0, 2]] == pytest.approx(v)
    for at, rate in zip(q, rates, strict=True):
        ahead, behind = five_bar(at + 1e-7 * rate), five_bar(at - 1e-7 * rate)
        assert ahead[0] - behind[0] == pytest.approx(ahead[1] - behind[1], abs=1e-13)


def test_wheels_follow_their_arcs(random: np.random.Generator) -> None:
    """Two wheels of radius 0.1 m, 0.5 m apart: the cart moves along a circle."""
    model = bgdyn.load(SPECS / "constraints" / "differential_drive.yaml")
    assert model.joint_names == ("right", "left")
    for d in random.uniform(-20, 20, (10, 2)):
        q = model.sample(seed=3)
        names = list(model.position_names)
        x, y, turn = (names.index(f"base_{part}") for part in ("x", "y", "turn"))
        there = model.integrate(q, d)
        ahead, angle = 0.1 * (d[0] + d[1]) / 2, 0.1 * (d[0] - d[1]) / 0.5
        heading = complex(math.cos(q[turn]), math.sin(q[turn]))
        chord = ahead * heading * (np.exp(1j * angle) - 1) / (1j * angle)
        assert complex(*(there - q)[[x, y]]) == pytest.approx(chord, abs=1e-13)
        assert there[turn] - q[turn] == pytest.approx(angle, abs=1e-13)
        assert model.difference(there, q) == pytest.approx(d, abs=1e-12)


def test_ways_of_order_four() -> None:
    """A rolling disc changes its direction as it leans: half the step, a sixteenth of the error."""
    model = bgdyn.load(SPECS / "constraints" / "rolling_disc.yaml")
    q = model.integrate(model.neutral(), np.full(model.nv, 0.1))
    d = np.linspace(0.3, 0.5, model.nv)

    def end(parts: int) -> Array:
        at = q
        for _ in range(parts):
            at = model.integrate(at, d / parts)
        return at

    exact = end(64)
    errors = [float(np.abs(end(parts) - exact).max()) for parts in (1, 2, 4)]
    assert errors[0] > 1e-9
    for coarse, fine in itertools.pairwise(errors):
        assert 10 < coarse / fine < 26


@pytest.mark.parametrize("path", ["tests/free_joints/quadrotor_arm.yaml", "specs/loops/five_bar.yaml", "specs/constraints/rolling_disc.yaml"])
def test_shapes_threads_and_memory(path: str, random: np.random.Generator) -> None:
    model = bgdyn.load(ROOT / path)
    q = model.sample((3, 5), seed=1)
    assert (q == model.sample((3, 5), seed=1, threads=4)).all()
    d = random.uniform(-0.05, 0.05, model.nv)
    there = model.integrate(q, d)
    assert there.shape == q.shape
    out = np.empty_like(q)
    assert model.integrate(q, d, out=out, threads=4) is out and (out == there).all()
    for index in np.ndindex(3, 5):
        assert (model.integrate(q[index], d) == there[index]).all()
    back = model.difference(there, q)
    assert back.shape == (3, 5, model.nv)
    assert back == pytest.approx(np.broadcast_to(d, back.shape), abs=1e-4)
    assert model.position_rates(q, np.zeros((3, 5, model.nv))) == pytest.approx(np.zeros(q.shape))
    assert model.integrate(np.zeros((0, model.nq)), d).shape == (0, model.nq)
    assert model.sample(0).shape == (0, model.nq)


def test_samples_of_wheels_are_closed() -> None:
    """Where the wheels do not close at the numbers drawn, it is the last position on the way there at which they do."""
    bicycle = bgdyn.load(SPECS / "constraints" / "whipple_bicycle.yaml")
    q, mask = bicycle.sample(400, seed=5, on_singular="nan")
    assert not mask.any()
    assert np.abs(bicycle.constraint_residual(q)).max() < 1e-12
    assert (q == bicycle.sample(400, seed=5, threads=3)).all()
    # They are spread, also those that were ended on the way.
    assert len(np.unique(q.round(9), axis=0)) > 390
    for seed in range(200):
        bicycle.sample(1, seed=seed)


def test_wrong_arguments(quadrotor: bgdyn.Model) -> None:
    q, v = quadrotor.neutral(), np.zeros(8)
    with pytest.raises(ValueError, match=r"`dv` has the shape \(9,\): \(8,\) is expected"):
        quadrotor.integrate(q, q)
    with pytest.raises(TypeError, match="`q0` is an array of float32"):
        quadrotor.difference(q, q.astype(np.float32))
    with pytest.raises(ValueError, match=r"`v` has the leading shape \(3,\), the arguments before it \(2,\)"):
        quadrotor.position_rates(np.stack([q] * 2), np.zeros((3, 8)))
    with pytest.raises(ValueError, match="`threads` is at least 1"):
        quadrotor.integrate(q, v, threads=0)
    with pytest.raises(ValueError, match="shares memory"):
        quadrotor.normalize(q, out=q)
    with pytest.raises(TypeError):
        quadrotor.sample(2.5)  # type: ignore[call-overload]


def test_not_a_number_stays_in_its_state() -> None:
    for path in ("tests/free_joints/quadrotor_arm.yaml", "specs/loops/five_bar.yaml"):
        model = bgdyn.load(ROOT / path)
        q = model.sample(4, seed=2)
        wanted = model.integrate(q, np.full(model.nv, 0.01))
        q[1, 0] = np.nan
        found, mask = model.integrate(q, np.full(model.nv, 0.01), on_singular="nan")
        assert not mask.any() and np.isnan(found[1]).any()
        assert (found[[0, 2, 3]] == wanted[[0, 2, 3]]).all()
