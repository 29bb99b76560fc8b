"""Shapes, memory, number types, threads."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import bgdyn
from conftest import ROOT, SPECS, width


@pytest.fixture(scope="module")
def arm() -> bgdyn.Model:
    return bgdyn.load(SPECS / "panda.yaml")


@pytest.mark.parametrize("batch", [(), (1,), (5,), (2, 3), (2, 1, 3, 2), (0,), (3, 0, 2)])
def test_leading_shapes(arm: bgdyn.Model, batch: tuple[int, ...], random: np.random.Generator) -> None:
    q, v, a = random.uniform(-2, 2, (3, *batch, 7))
    tau, mass = arm.inverse_dynamics(q, v, a), arm.mass_matrix(q)
    energy, jacobian = arm.kinetic_energy(q, v), arm.jacobian_world_tool(q)
    pose, slopes = arm.pose_tool(q), arm.inverse_dynamics_derivatives(q, v, a)
    assert tau.shape == (*batch, 7) and mass.shape == (*batch, 7, 7)
    assert energy.shape == batch and jacobian.shape == (*batch, 6, 7)
    assert pose.rotation.shape == (*batch, 3, 3) and pose.translation.shape == (*batch, 3)
    assert slopes.q.shape == slopes.v.shape == (*batch, 7, 7)
    for index in np.ndindex(batch):
        assert (tau[index] == arm.inverse_dynamics(q[index], v[index], a[index])).all()
        assert (mass[index] == arm.mass_matrix(q[index])).all()
        assert energy[index] == arm.kinetic_energy(q[index], v[index])
        assert (pose.translation[index] == arm.pose_tool(q[index]).translation).all()
        assert (slopes.v[index] == arm.inverse_dynamics_derivatives(q[index], v[index], a[index]).v).all()


def test_a_single_state_gives_a_number(arm: bgdyn.Model) -> None:
    assert type(arm.potential_energy(np.zeros(7))) is np.float64
    fallen, mask = arm.forward_dynamics(np.zeros(7), np.zeros(7), np.zeros(7), on_singular="nan")
    assert fallen.shape == (7,) and type(mask) is np.bool_ and not mask


def test_an_argument_without_leading_shape_is_shared(arm: bgdyn.Model, random: np.random.Generator) -> None:
    q, still = random.uniform(-2, 2, (10, 7)), np.zeros(7)
    found = arm.inverse_dynamics(q, still, still)
    assert (found == arm.inverse_dynamics(q, np.zeros((10, 7)), np.zeros((10, 7)))).all()
    later = arm.inverse_dynamics(q[0], random.uniform(-1, 1, (4, 7)), still)
    assert later.shape == (4, 7)


def test_order_in_memory_does_not_matter(arm: bgdyn.Model, random: np.random.Generator) -> None:
    plain = random.uniform(-2, 2, (6, 7))
    wanted = arm.gravity(plain)
    wide = np.zeros((12, 14))
    wide[::2, ::2] = plain
    unaligned = np.zeros(6 * 7 * 8 + 1, dtype=np.uint8)[1:].view(np.float64).reshape(6, 7)
    unaligned[...] = plain
    read_only = plain.copy()
    read_only.flags.writeable = False
    for q in (wide[::2, ::2], np.asfortranarray(plain), plain[::-1][::-1], unaligned, read_only):
        assert (arm.gravity(q) == wanted).all()
    assert (arm.gravity(plain.tolist()) == wanted).all()
    assert (arm.gravity([0, 0, 0, 0, 0, 0, 0]) == arm.gravity(np.zeros(7))).all()


def test_arguments_by_name(arm: bgdyn.Model, random: np.random.Generator) -> None:
    q, v, a = random.uniform(-2, 2, (3, 7))
    assert (arm.inverse_dynamics(a=a, q=q, v=v) == arm.inverse_dynamics(q, v, a)).all()
    assert (arm.inverse_dynamics(q, v, a=a) == arm.inverse_dynamics(q, v, a)).all()


@pytest.mark.parametrize("call", [
    lambda arm, x: arm.gravity(),
    lambda arm, x: arm.gravity(x, x),
    lambda arm, x: arm.gravity(x, q=x),
    lambda arm, x: arm.gravity(p=x),
    lambda arm, x: arm.gravity(q=x, p=x),
    lambda arm, x: arm.inverse_dynamics(x, x),
    lambda arm, x: arm.inverse_dynamics(x, x, q=x),
])  # fmt: skip
def test_wrong_arguments(arm: bgdyn.Model, call: Any) -> None:
    with pytest.raises(TypeError, match=r"the arguments are \w+\(q(, v, a)?\), and by name"):
        call(arm, np.zeros(7))


@pytest.mark.parametrize("dtype", ["float32", "float16", "int64", "bool", "complex128", ">f8", "object"])
def test_other_numbers_are_refused(arm: bgdyn.Model, dtype: str) -> None:
    q = np.zeros(7, dtype=dtype)
    with pytest.raises(TypeError, match=rf"`v` is an array of {np.dtype(dtype)}: bgdyn computes in float64"):
        arm.inverse_dynamics(np.zeros(7), q, np.zeros(7))
    with pytest.raises(TypeError, match="`out` is an array of"):
        arm.gravity(np.zeros(7), out=q)


def test_lists_of_single_precision_are_refused(arm: bgdyn.Model) -> None:
    with pytest.raises(TypeError, match="float32"):
        arm.gravity([np.float32(x) for x in range(7)])
    with pytest.raises(TypeError, match="`q` is an array of object"):
        arm.gravity(None)  # type: ignore[call-overload]


@pytest.mark.parametrize("shape", [(), (6,), (8,), (7, 1), (7, 6), (2, 7, 6)])
def test_wrong_shapes_are_named_with_the_expected_ones(arm: bgdyn.Model, shape: tuple[int, ...]) -> None:
    with pytest.raises(ValueError, match=r"`q` has the shape \(.*\): \(7,\) is expected, or \(\.\.\., 7\)"):
        arm.gravity(np.zeros(shape))
    with pytest.raises(ValueError, match=r"`out` has the shape \(.*\): \(7,\) is expected"):
        arm.gravity(np.zeros(7), out=np.zeros(shape))


def test_different_leading_shapes(arm: bgdyn.Model) -> None:
    with pytest.raises(ValueError, match=r"`v` has the leading shape \(3,\), the arguments before it \(2,\)"):
        arm.bias(np.zeros((2, 7)), np.zeros((3, 7)))


def test_results_into_given_arrays(arm: bgdyn.Model, random: np.random.Generator) -> None:
    q, v, a = random.uniform(-2, 2, (3, 4, 7))
    out = np.full((4, 7, 7), 9.0)
    assert arm.mass_matrix(q, out=out) is out
    assert (out == arm.mass_matrix(q)).all()
    number = np.array(9.0)
    assert arm.potential_energy(q[0], out=number) is number
    assert number == arm.potential_energy(q[0])
    both = np.empty((4, 7, 7)), np.empty((4, 7, 7))
    found = arm.inverse_dynamics_derivatives(q, v, a, out=both)
    assert found.q is both[0] and found.v is both[1]
    assert (both[1] == arm.inverse_dynamics_derivatives(q, v, a).v).all()


def test_arrays_that_results_cannot_go_to(arm: bgdyn.Model) -> None:
    q = np.zeros((3, 7))
    with pytest.raises(ValueError, match="not row by row"):
        arm.gravity(q, out=np.zeros((7, 3)).T)
    fixed = np.zeros((3, 7))
    fixed.flags.writeable = False
    with pytest.raises(ValueError, match="read-only"):
        arm.gravity(q, out=fixed)
    with pytest.raises(ValueError, match="shares memory"):
        arm.gravity(q, out=q)
    one = np.zeros((3, 7, 7))
    with pytest.raises(ValueError, match="shares memory"):
        arm.inverse_dynamics_derivatives(q, q, q, out=(one, one))
    with pytest.raises(TypeError, match="a tuple of 2 arrays, or a bgdyn.InverseDerivatives"):
        arm.inverse_dynamics_derivatives(q, q, q, out=one)  # type: ignore[call-overload]
    with pytest.raises(TypeError, match="`out` is of type list"):
        arm.gravity(q, out=[0.0] * 7)  # type: ignore[call-overload]
    assert (arm.gravity(q) == arm.gravity(q[0])).all()  # nothing stays borrowed


@pytest.mark.parametrize("threads", [2, 3, 7, 64])
def test_threads_give_the_same_bits(arm: bgdyn.Model, threads: int, random: np.random.Generator) -> None:
    q, v, a = random.uniform(-50, 50, (3, 13, 5, 7))
    for name in ("inverse_dynamics", "forward_dynamics", "mass_matrix", "pose_tool", "forward_dynamics_derivatives"):
        method = getattr(arm, name)
        arguments = (q, v, a)[: len(method.arguments)]
        one, many = method(*arguments), method(*arguments, threads=threads)
        pairs = zip(one, many, strict=True) if isinstance(one, tuple) else [(one, many)]
        for x, y in pairs:
            assert x.tobytes() == y.tobytes(), name
    with pytest.raises(ValueError, match="`threads` is at least 1"):
        arm.gravity(q, threads=0)


def test_not_a_number_stays_in_its_state(arm: bgdyn.Model, random: np.random.Generator) -> None:
    q, v, tau = random.uniform(-2, 2, (3, 5, 7))
    wanted = arm.forward_dynamics(q, v, tau)
    q[1, 3], v[2, 5], tau[4, 0] = np.nan, np.inf, np.nan
    found, mask = arm.forward_dynamics(q, v, tau, on_singular="nan")
    assert not mask.any()
    assert (arm.forward_dynamics(q, v, tau)[[0, 3]] == wanted[[0, 3]]).all()
    assert (found[[0, 3]] == wanted[[0, 3]]).all()
    assert np.isnan(found[1]).any() and not np.isfinite(found[2]).all() and np.isnan(found[4]).any()
    efforts = arm.gravity(q)
    assert np.isnan(efforts[1]).any() and np.isfinite(efforts[[0, 2, 3, 4]]).all()


@pytest.mark.parametrize(
    "path",
    ["specs/panda.yaml", "specs/loops/five_bar.yaml", "tests/free_joints/quadrotor_arm.yaml", "tests/golden/specs/chain32.yaml"],
)
def test_batches_have_the_bits_of_single_calls(path: str, random: np.random.Generator) -> None:
    """Most states of a batch are computed several at once, also where angles are large or not finite."""
    model = bgdyn.load(ROOT / path)
    size = np.array([1.0, 1.0, 1e3, 1.0, 1e6, 1.0, 1.0, 1e9, 1.0])[:, None]
    q = model.neutral() + size * random.uniform(-0.3, 0.3, (9, model.nq))
    q[5, 0] = np.inf
    tree = [name for name in model.methods if not name.startswith(("pose_", "velocity_", "jacobian_", "operational_", "consistent_", "payload_"))]
    if model.nv > 16:
        tree = ["mass_matrix", "forward_dynamics"]  # the others take long to choose
    frame = model.frame_names[-1]
    for name in [*tree, f"pose_{frame}", f"jacobian_dot_v_world_{frame}", f"operational_inverse_{frame}"]:
        method = getattr(model, name)
        arguments = [q if n == "q" else random.uniform(-3, 3, (9, width(method, n))) for n in method.arguments]
        many, mask = method(*arguments, on_singular="nan")
        for k in range(9):
            one, singular = method(*(x[k] for x in arguments), on_singular="nan")
            assert singular == mask[k], (name, k)
            pairs = zip(one, many, strict=True) if isinstance(one, tuple) else [(one, many)]
            for x, y in pairs:
                assert np.array_equal(x, y[k], equal_nan=True), (name, k)
