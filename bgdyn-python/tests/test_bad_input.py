"""What a user of NumPy does wrong: each is an exception of the usual type that says what to do."""

from __future__ import annotations

import pickle
from pathlib import Path

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
    with pytest.raises(TypeError):
        scene.simulate(parameters={"load_mass": "heavy"})  # type: ignore[dict-item]


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


def test_arrays_that_are_no_states() -> None:
    arm = bgdyn.load(SPECS / "scara.yaml")
    for wrong in ("text", object(), {"q": 1}):
        with pytest.raises((TypeError, ValueError), match="`q`"):
            arm.gravity(wrong)  # type: ignore[arg-type]
    with pytest.raises((TypeError, ValueError)):
        arm.gravity([[0.0, 1.0], [0.0]])
    with pytest.raises(TypeError, match="`q` is an array of"):
        arm.gravity(np.ma.masked_array(np.zeros(4, dtype=np.float32)))
    with pytest.raises(AttributeError, match="inverse_dynamics"):
        arm.inverse_dynamic  # noqa: B018
