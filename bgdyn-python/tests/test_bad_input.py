"""What a user of NumPy does wrong: each is an exception of the usual type that says what to do."""

from __future__ import annotations

import pickle
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import bgdyn
from conftest import SPECS, Command

INVALID = sorted((SPECS / "invalid").glob("*.yaml"))


def test_refused_files_have_the_text_of_check(command: Command) -> None:
    assert len(INVALID) > 50
    for path in INVALID:
        done = command("check", path)
        assert done.returncode != 0
        with pytest.raises(bgdyn.SpecError) as caught:
            bgdyn.load(path)
        assert isinstance(caught.value, ValueError)
        assert str(caught.value) == done.stderr.rstrip(), path


def test_unknown_parameters() -> None:
    text = (SPECS / "crane.yaml").read_text()
    with pytest.raises(ValueError, match="no parameter `mass`: the spec has none"):
        bgdyn.load(text=text.replace("{ parameter: load_mass, value: 400 kg }", "400 kg"), name="crane", parameters={"mass": 1.0})
    scene = bgdyn.Scene(SPECS / "scenes" / "crane.scene.yaml")
    with pytest.raises(ValueError, match="load_mass"):
        scene.simulate(parameters={"load_maas": 1.0})
    with pytest.raises(ValueError, match="`load_mass` is NaN"):
        scene.simulate(parameters={"load_mass": float("nan")})
    with pytest.raises(TypeError, match="`load_mass` is a number in SI units, not 'heavy'"):
        scene.simulate(parameters={"load_mass": "heavy"})  # type: ignore[dict-item]


def test_a_parameter_of_an_effect() -> None:
    with pytest.raises(ValueError, match=r"`load_mass` is no parameter of the mechanism: it belongs to its effect `load`.*bgdyn\.Scene"):
        bgdyn.load(SPECS / "crane.yaml", parameters={"load_mass": 5.0})
    with pytest.raises(ValueError, match="no parameter `load_maas`: the spec has none"):
        bgdyn.load(SPECS / "crane.yaml", parameters={"load_maas": 5.0})


def test_misspelt_names_of_scenes() -> None:
    """`simulate` and `sweep` say the same, of parameters and of parts of the state."""
    scene = bgdyn.Scene(SPECS / "scenes" / "crane.scene.yaml")
    for name, near in (("load_maas", "load_mass"), ("luff_rat", "luff_rate")):
        message = f"no parameter or part of the state is called `{name}`: did you mean `{near}`?"
        calls: list[Callable[[], object]] = [
            lambda name=name: scene.sweep({name: [1.0]}),  # type: ignore[misc]
            lambda name=name: scene.simulate(parameters={name: 1.0}),  # type: ignore[misc]
            lambda name=name: scene.simulate(initial={name: 1.0}),  # type: ignore[misc]
        ]
        for call in calls:
            with pytest.raises(ValueError) as caught:
                call()
            assert str(caught.value) == message
    with pytest.raises(ValueError, match="there are slew, .*, load_mass$"):
        scene.sweep({"weight_of_it_all": [1.0]})
    with pytest.raises(ValueError, match="`load_mass` is a parameter: give it in `parameters`"):
        scene.simulate(initial={"load_mass": 1.0})
    with pytest.raises(ValueError, match="`luff` is a part of the state: give it in `initial`"):
        scene.simulate(parameters={"luff": 1.0})


@pytest.mark.parametrize(("settings", "kind", "message"), [
    ({"duration": "1"}, TypeError, "`duration` is a positive number, not '1'"),
    ({"step": "1 ms"}, TypeError, "`step` is a positive number, not '1 ms'"),
    ({"tolerance": [1]}, TypeError, r"`tolerance` is a positive number, not \[1\]"),
    ({"tolerance": 0}, ValueError, "`tolerance` is a positive number, not 0"),
    ({"points": -3}, ValueError, "`points` is a number of times, 2 or more, not -3"),
    ({"points": 2.5}, TypeError, "`points` is a number of times, 2 or more, not 2.5"),
    ({"parameters": [1]}, TypeError, r"`parameters` is a dictionary, {name: number}, not \[1\]"),
    ({"initial": {1: 2.0}}, TypeError, "a name in initial` is a text, not 1"),
])  # fmt: skip
def test_settings_of_runs(settings: dict[str, Any], kind: type[Exception], message: str) -> None:
    scene = bgdyn.Scene(SPECS / "scenes" / "crane.scene.yaml")
    with pytest.raises(kind, match=message):
        scene.simulate(**settings)
    if not {"parameters", "initial"} & set(settings):
        with pytest.raises(kind, match=message):
            scene.sweep({"load_mass": [1.0]}, **settings)


def test_numbers_of_numpy_are_settings() -> None:
    scene = bgdyn.Scene(SPECS / "scenes" / "crane.scene.yaml")
    run = scene.simulate(duration=np.float32(0.25), points=np.int64(3))  # type: ignore[arg-type]
    assert run.t.tolist() == [0.0, 0.125, 0.25]


def test_numbers_of_threads_and_samples() -> None:
    arm = bgdyn.load(SPECS / "scara.yaml")
    for threads in (0, -1):
        with pytest.raises(ValueError, match=f"`threads` is at least 1, not {threads}"):
            arm.gravity(np.zeros(4), threads=threads)
        with pytest.raises(ValueError, match=f"`threads` is at least 1, not {threads}"):
            arm.normalize(np.zeros(4), threads=threads)
    for n in (-1, (2, -1)):
        with pytest.raises(ValueError, match=rf"`n` is {re.escape(str(n))}: a number of positions is 0 or more"):
            arm.sample(n)
    with pytest.raises(TypeError, match="`n` is 'ten': a number of positions is expected, or a shape"):
        arm.sample("ten")  # type: ignore[call-overload]


def test_arguments_of_load() -> None:
    with pytest.raises(TypeError, match="`text` is the text of a mechanism, not 5"):
        bgdyn.load(text=5, name="a")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="`path` is the path of a file, not 5"):
        bgdyn.load(5)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="`name` is the name of the mechanism, not 5"):
        bgdyn.load(text="", name=5)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="`payload` is a number in SI units, not '5 kg'"):
        bgdyn.load(SPECS / "scara.yaml", parameters={"payload": "5 kg"})  # type: ignore[dict-item]
    with pytest.raises(TypeError, match="`payload` is a number in SI units, not '5 kg'"):
        bgdyn.load(SPECS / "scara.yaml").with_parameters(payload="5 kg")  # type: ignore[arg-type]
    for load in (bgdyn.load, bgdyn.Scene, lambda path: bgdyn.load(urdf=path)):
        with pytest.raises(FileNotFoundError):
            load("")


def test_pickles_that_cannot_be_read() -> None:
    arm = bgdyn.load(SPECS / "scara.yaml")
    sent = pickle.dumps(arm)
    with pytest.raises((pickle.UnpicklingError, EOFError)):
        pickle.loads(sent[:-20])
    # The text of a version that knows other words: what `bgdyn check` says of it.
    for whole in (sent, pickle.dumps(bgdyn.Scene(SPECS / "scenes" / "scara_friction.scene.yaml"))):
        assert whole.count(b"revolute") > 0
        with pytest.raises(bgdyn.SpecError, match="unknown|revolved"):
            pickle.loads(whole.replace(b"revolute", b"revolved"))


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        bgdyn.load(tmp_path / "missing.yaml")
    with pytest.raises(FileNotFoundError):
        bgdyn.load(urdf=tmp_path / "missing.urdf")
    latin = tmp_path / "latin.yaml"
    latin.write_bytes("# Größe\nformat: 1\n".encode("latin-1"))
    with pytest.raises(bgdyn.SpecError, match="is not UTF-8"):
        bgdyn.load(latin)
    broken = tmp_path / "broken.urdf"
    broken.write_text("<robot name='x'><link")
    with pytest.raises(bgdyn.SpecError, match="broken.urdf:"):
        bgdyn.load(urdf=broken)


ROBOT = """<robot name="light">
  <link name="base"/>
  <link name="rod"><inertial><mass value="-2"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="turn" type="continuous"><parent link="base"/><child link="rod"/><axis xyz="0 0 1"/></joint>
</robot>
"""


@pytest.mark.filterwarnings("ignore::bgdyn.LossWarning")
def test_faults_of_a_converted_robot(tmp_path: Path) -> None:
    """The place of a fault is one in the spec that the robot is converted to: the message says so, and shows the line."""
    file = tmp_path / "light.urdf"
    file.write_text(ROBOT)
    with pytest.raises(bgdyn.SpecError) as caught:
        bgdyn.load(urdf=file)
    text = str(caught.value)
    assert text.startswith(f"<converted from {file}>:") and "| " in text and "mass: -2" in text
    assert text.endswith(f"the lines are those of the spec that the file is converted to: `bgdyn import {file}` prints it")
    file.write_text(ROBOT, encoding="utf-16")
    with pytest.raises(bgdyn.SpecError) as caught:
        bgdyn.load(urdf=file)
    assert str(caught.value).count(str(file)) == 1 and "is not UTF-8" in str(caught.value)


def test_arrays_that_are_no_states() -> None:
    arm = bgdyn.load(SPECS / "scara.yaml")
    for wrong in ("text", object(), {"q": 1}):
        with pytest.raises((TypeError, ValueError), match="`q`"):
            arm.gravity(wrong)  # type: ignore[call-overload]
    with pytest.raises((TypeError, ValueError)):
        arm.gravity([[0.0, 1.0], [0.0]])
    with pytest.raises(TypeError, match="`q` is a masked array, and bgdyn has no masks: `q.filled"):
        arm.gravity(np.ma.array([0.0, np.nan, 2.0, 3.0], mask=[False, True, False, False]))
    with pytest.raises(TypeError, match="`dv` is a masked array"):
        arm.integrate(np.zeros(4), np.ma.zeros(4))
    with pytest.raises(TypeError, match="`out` is a masked array"):
        arm.gravity(np.zeros(4), out=np.ma.zeros(4))
    with pytest.raises(AttributeError, match="inverse_dynamics"):
        arm.inverse_dynamic  # noqa: B018
