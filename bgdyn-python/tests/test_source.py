"""Generated code against that of ``bgdyn generate``, what is refused, and which engine computes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import bgdyn
from conftest import SPECS, Command

BUNDLES = {"control": ["mass_matrix", "bias"], "held": ["gravity", "pose_tool"]}
OF_COMMAND = ["--bundle", "control=mass_matrix,bias", "--bundle", "held=gravity,pose_tool"]


@pytest.mark.parametrize(
    ("arguments", "flags"),
    [
        ({}, []),
        ({"method": "gravity"}, ["--methods", "gravity"]),
        ({"method": ["dynamics", "pose_tool"]}, ["--methods", "dynamics,pose_tool"]),
        ({"options": {"plain": "yes", "module": "arm"}}, ["--plain", "--module", "arm"]),
        ({"method": "bias", "bundles": BUNDLES}, ["--methods", "bias", *OF_COMMAND]),
    ],
)
def test_rust_source_is_that_of_the_command(arguments: dict[str, Any], flags: list[str], command: Command) -> None:
    done = command("generate", "specs/scara.yaml", *flags)
    assert done.returncode == 0 and "pub fn " in done.stdout, done.stderr
    assert bgdyn.load(SPECS / "scara.yaml").source(**arguments) == done.stdout


@pytest.mark.parametrize(
    ("arguments", "flags"),
    [
        ({}, []),
        ({"method": ["gravity"], "options": {"float": "float", "prefix": "arm"}},
         ["--methods", "gravity", "--option", "float=float", "--option", "prefix=arm"]),
        ({"bundles": BUNDLES, "options": {"cmake": "yes"}}, [*OF_COMMAND, "--option", "cmake=yes"]),
    ],
)  # fmt: skip
def test_c_source_is_that_of_the_command(
    arguments: dict[str, Any], flags: list[str], command: Command, tmp_path: Path
) -> None:
    done = command("generate", "specs/scara.yaml", "--backend", "c", "-o", tmp_path, *flags)
    assert done.returncode == 0, done.stderr
    found = bgdyn.load(SPECS / "scara.yaml").source(backend="c", **arguments)
    assert len(found) >= 2 and found == {file.name: file.read_text() for file in tmp_path.iterdir()}


def test_source_follows_the_choice_of_the_model(command: Command) -> None:
    done = command("generate", "specs/scara.yaml", "--methods", "bias", "--formulation", "literal")
    assert bgdyn.load(SPECS / "scara.yaml", formulation="literal").source("bias") == done.stdout
    assert bgdyn.load(SPECS / "scara.yaml").source("bias") != done.stdout


@pytest.mark.parametrize(
    ("arguments", "flags"),
    [
        ({"backend": "fortran"}, ["--backend", "fortran"]),
        ({"options": {"float": "float"}}, ["--option", "float=float"]),
        ({"backend": "c", "options": {"float": "half"}}, ["--backend", "c", "--option", "float=half"]),
        ({"options": {"module": "2"}}, ["--module", "2"]),
        ({"method": ["biass", "gravty"]}, ["--methods", "biass,gravty"]),
        ({"bundles": {"control": ["mass"]}}, ["--bundle", "control=mass"]),
        ({"bundles": {"bias": ["gravity"]}}, ["--bundle", "bias=gravity"]),
        ({"bundles": {"control": []}}, ["--bundle", "control="]),
    ],
)
def test_what_the_command_refuses_is_refused_with_its_text(
    arguments: dict[str, Any], flags: list[str], command: Command
) -> None:
    done = command("generate", "specs/scara.yaml", *flags)
    assert done.returncode != 0
    with pytest.raises(ValueError) as refused:
        bgdyn.load(SPECS / "scara.yaml").source(**arguments)
    # The command says its name before each line.
    lines = done.stderr.splitlines()
    assert str(refused.value).splitlines() == [line.removeprefix("bgdyn: ") for line in lines]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"backend": "fortran"}, "no backend `fortran`: choose one of `rust`, `c`"),
        ({"options": {"flot": "float"}, "backend": "c"}, "the backend `c` has no option `flot`"),
        ({"method": "biass"}, "did you mean `bias`"),
    ],
)
def test_a_source_that_does_not_exist(arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        bgdyn.load(SPECS / "scara.yaml").source(**arguments)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"method": 5}, "`method` is a name or a list of names, not 5"),
        ({"method": ["bias", 5]}, "`method` is a name or a list of names"),
        ({"bundles": ["bias"]}, "`bundles` is a dictionary"),
        ({"bundles": {"control": 5}}, r'`bundles\["control"\]` is a name or a list of names, not 5'),
        ({"options": "float=float"}, "`options` is a dictionary"),
        ({"options": {"plain": True}}, r'`options\["plain"\]` is a text, not True'),
    ],
)
def test_arguments_of_source_of_another_kind(arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(TypeError, match=message):
        bgdyn.load(SPECS / "scara.yaml").source(**arguments)


def test_a_source_of_bundles_alone() -> None:
    text = bgdyn.load(SPECS / "scara.yaml").source([], bundles=BUNDLES)
    assert "pub fn control" in text and "pub fn held" in text and "pub fn bias" not in text


def test_the_engine() -> None:
    assert bgdyn.load(SPECS / "scara.yaml").engine == "tape"
    assert bgdyn.Scene(SPECS / "scenes" / "crane.scene.yaml").engine == "tape"
    for of_class in (bgdyn.Model, bgdyn.Scene):
        assert "without a compiler" in (getattr(of_class, "engine").__doc__ or "")
