"""Loading, descriptions, parameters, equality, pickles."""

from __future__ import annotations

import copy
import multiprocessing
import pickle
import re
import warnings
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import bgdyn
from conftest import GOLDEN, ROOT, SPECS, Command, width

# A pendulum with a load that is known at run time.
PENDULUM = """
format: 1
links:
  - name: rod
    joint: { name: swing, type: continuous, axis: y }
    mass: { parameter: load, value: 2 kg }
    com: [0, 0, -0.5]
"""


def test_sizes_and_names() -> None:
    arm = bgdyn.load(SPECS / "scara.yaml")
    assert (arm.name, arm.nq, arm.nv) == ("scara", 4, 4)
    assert arm.joint_names == arm.position_names == ("shoulder", "elbow", "stroke", "turn")
    assert arm.frame_names[-1] == "tool"
    assert {"inverse_dynamics", "pose_tool", "jacobian_dot_v_world_forearm"} <= set(arm.methods) <= set(dir(arm))
    assert repr(arm) == "<bgdyn.Model scara: NQ 4, NV 4: shoulder, elbow, stroke, turn>"
    assert repr(arm.gravity) == (
        "<gravity(q: (4,)) of scara: Joint efforts that hold the mechanism at rest. "
        "N·m for a rotation, N for a translation>"
    )
    drawing = arm._repr_html_()
    assert drawing.startswith("<svg") and drawing.rstrip().endswith("</svg>") and "elbow" in drawing


def test_every_method_can_be_called(random: np.random.Generator) -> None:
    names = ["scara", "torso", "constraints/carousel", "loops/four_bar", "loops/stewart_platform",
             "constraints/differential_drive", "constraints/planetary_gear"]  # fmt: skip
    for name in names:
        model = bgdyn.load(SPECS / f"{name}.yaml")
        q = model.neutral()
        for method in (getattr(model, name) for name in model.methods):
            arguments = [q if n == "q" else random.uniform(-1, 1, width(method, n)) for n in method.arguments]
            one, _ = method(*arguments, on_singular="nan")
            many, mask = method(*([x, x] for x in arguments), on_singular="nan")
            ones, manys = (x if isinstance(x, tuple) else (x,) for x in (one, many))
            assert mask.shape == (2,)
            for single, several in zip(ones, manys, strict=True):
                assert several.shape == (2, *single.shape), (name, method)
                assert np.array_equal(several[1], single, equal_nan=True), (name, method)


def test_unknown_methods() -> None:
    arm = bgdyn.load(SPECS / "scara.yaml")
    with pytest.raises(AttributeError, match="did you mean `gravity`"):
        arm.gravty
    with pytest.raises(ValueError, match="did you mean `bias`"):
        arm.operations("biass")


def test_counts_are_those_of_the_command(command: Command) -> None:
    arm = bgdyn.load(SPECS / "scara.yaml")
    import json

    done = command("ops", "specs/scara.yaml", "--json")
    counts = json.loads(done.stdout)["functions"]
    assert counts
    for name, count in counts.items():
        assert arm.operations(name) == count


def test_formulations() -> None:
    literal = bgdyn.load(SPECS / "scara.yaml", formulation="literal")
    own = bgdyn.load(SPECS / "scara.yaml")
    ways = [getattr(model, "inverse_dynamics").formulation for model in (literal, own)]
    assert literal != own and ways[0] == "literal" and ways[1].startswith("recursion")
    assert literal.operations("inverse_dynamics")["mul"] > own.operations("inverse_dynamics")["mul"]
    q = np.array([0.3, -0.4, 0.1, 2.0])
    assert literal.bias(q, q) == pytest.approx(own.bias(q, q), abs=1e-14)
    with pytest.raises(ValueError, match="formulation"):
        bgdyn.load(SPECS / "scara.yaml", formulation="literally")
    with pytest.raises(ValueError, match="preference"):
        bgdyn.load(SPECS / "scara.yaml", prefer="speed")
    with pytest.raises(ValueError, match="does not serve"):
        bgdyn.load(SPECS / "constraints" / "mimic_gripper.yaml", formulation="articulated")


def test_parameters() -> None:
    light = bgdyn.load(text=PENDULUM, name="pendulum")
    assert light.parameters == {"load": 2.0}
    heavy = light.with_parameters(load=5.0)
    assert heavy.parameters == {"load": 5.0} and light.parameters == {"load": 2.0}
    q = np.array([[np.pi / 2], [0.3]])
    for model, load in ((light, 2.0), (heavy, 5.0)):
        assert model.gravity(q) == pytest.approx(load * 9.81 * 0.5 * np.sin(q), rel=1e-14)
    assert heavy != light and heavy.with_parameters(load=2.0) == light
    assert heavy == bgdyn.load(text=PENDULUM, name="pendulum", parameters={"load": 5.0})
    assert pickle.loads(pickle.dumps(heavy)) == heavy
    with pytest.raises(ValueError, match="no parameter `loaf`; there are load"):
        light.with_parameters(loaf=1.0)
    with pytest.raises(ValueError, match="the spec has none"):
        bgdyn.load(SPECS / "scara.yaml").with_parameters(load=1.0)
    with pytest.raises(ValueError, match="`load` is NaN"):
        light.with_parameters(load=float("nan"))


def test_equality_and_copies() -> None:
    text = (SPECS / "scara.yaml").read_text()
    arm, same = bgdyn.load(SPECS / "scara.yaml"), bgdyn.load(text=text, name="scara")
    assert arm == same and hash(arm) == hash(same) and arm.gravity == same.gravity
    assert arm != bgdyn.load(text=text + "# other\n", name="scara") and arm != "scara"
    assert copy.copy(arm) is arm and copy.deepcopy([arm])[0] is arm


def worst(method: bgdyn.Method, q: NDArray[np.float64]) -> NDArray[np.float64]:
    """Computes in another process."""
    result: NDArray[np.float64] = method(q)
    return result


def test_pickles_in_another_process(random: np.random.Generator) -> None:
    arm = bgdyn.load(SPECS / "panda.yaml")
    q = random.uniform(-2, 2, (4, 7))
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        [mass, efforts] = pool.starmap(worst, [(arm.mass_matrix, q), (arm.gravity, q)])
    assert (mass == arm.mass_matrix(q)).all() and (efforts == arm.gravity(q)).all()
    assert len(pickle.dumps(arm)) < len(arm.text) + 500


@pytest.mark.parametrize("name", sorted(p.name for p in (SPECS / "invalid").glob("*.yaml")))
def test_refusals_are_those_of_check(name: str, command: Command) -> None:
    done = command("check", f"specs/invalid/{name}")
    path = f"specs/invalid/{name}"
    text = (ROOT / path).read_text()
    if done.returncode == 0:
        pytest.skip("valid as it stands")
    with pytest.raises(bgdyn.SpecError) as caught:
        with pytest.MonkeyPatch.context() as patch:
            patch.chdir(ROOT)
            bgdyn.load(path)
    assert isinstance(caught.value, ValueError)
    assert str(caught.value) == done.stderr.rstrip(), text


def test_warnings_are_those_of_check(tmp_path: Path, command: Command) -> None:
    file = tmp_path / "bare.yaml"
    file.write_text("format: 1\nlinks:\n  - name: rod\n    joint: { name: swing, type: revolute, axis: z }\n")
    done = command("check", file)
    assert done.returncode == 0 and "warning" in done.stderr
    with pytest.warns(bgdyn.SpecWarning) as caught:
        model = bgdyn.load(file)
    assert [str(w.message).rstrip() for w in caught] == [done.stderr.rstrip()]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert pickle.loads(pickle.dumps(model)) == model


def test_files_of_other_kinds(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        bgdyn.load(tmp_path / "none.yaml")
    with pytest.raises(FileNotFoundError):
        bgdyn.load(urdf=tmp_path / "none.urdf")
    with pytest.raises(bgdyn.SpecError, match=re.escape('load(urdf="')):
        bgdyn.load(GOLDEN / "urdf" / "panda7.urdf")
    with pytest.raises(bgdyn.SpecError, match="is a scene: see bgdyn.Scene"):
        bgdyn.load(SPECS / "scenes" / "crane.scene.yaml")
    latin = tmp_path / "latin.yaml"
    latin.write_bytes("format: 1 # \xe9".encode("latin-1"))
    with pytest.raises(bgdyn.SpecError, match="is not UTF-8"):
        bgdyn.load(latin)
    with pytest.raises(TypeError, match="one of path, text=..., urdf=..."):
        bgdyn.load()
    with pytest.raises(TypeError, match="takes name=..."):
        bgdyn.load(text=PENDULUM)


def test_losses_of_an_import_are_warnings(tmp_path: Path, command: Command) -> None:
    file = tmp_path / "arm.urdf"
    file.write_text(
        '<robot name="Two Arm"><link name="base"/><link name="rod"><inertial><mass value="2"/>'
        '<origin xyz="0 0 -0.5"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>'
        '<visual><geometry><box size="1 1 1"/></geometry></visual></link>'
        '<joint name="swing" type="continuous"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/></joint>'
        "</robot>"
    )
    done = command("import", file)
    wanted = [line[9:] for line in done.stderr.splitlines() if line.startswith("warning: ")]
    assert wanted
    with pytest.warns(bgdyn.LossWarning) as caught:
        model = bgdyn.load(urdf=file)
    assert [str(w.message) for w in caught] == wanted
    assert model.name == "two_arm" and model.text == done.stdout
    assert model.gravity([np.pi / 2]) == pytest.approx([9.81])
    file.write_text('<robot name="r"><link/></robot>')
    with pytest.raises(bgdyn.SpecError, match=rf"^{re.escape(str(file))}:1:\d+: "):
        bgdyn.load(urdf=file)
