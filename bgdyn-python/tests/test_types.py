"""The stubs: a type checker accepts the package and right uses of it, and reports wrong ones."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import bgdyn

HERE = Path(__file__).parent
USER = HERE / "typed" / "user.py"


def checked(what: list[str], cache: Path) -> list[str]:
    """Returns the lines that mypy reports."""
    pytest.importorskip("mypy")
    settings = ["--config-file", str(HERE.parent / "pyproject.toml"), "--no-error-summary", "--hide-error-context"]
    package = str(Path(bgdyn.__file__).parents[1])
    installed = "site-packages" in package
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--cache-dir", str(cache), *settings, *what],
        cwd=cache,
        env=os.environ if installed else os.environ | {"MYPYPATH": package},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stderr == ""
    return done.stdout.splitlines()


def test_a_users_file(tmp_path: Path) -> None:
    lines = USER.read_text().splitlines()
    marks = ((k, re.search(r"# mistake: (\S+)$", line)) for k, line in enumerate(lines, start=1))
    wanted = [(k, mark.group(1)) for k, mark in marks if mark]
    found = []
    for line in checked([str(USER)], tmp_path):
        if mark := re.fullmatch(r".*user\.py:(\d+): error: .*\[(\S+)\]", line):
            found.append((int(mark.group(1)), mark.group(2)))
        else:
            assert ": note: " in line, line
    assert found == wanted and len(wanted) == 9


def test_the_package_itself(tmp_path: Path) -> None:
    assert checked(["-p", "bgdyn"], tmp_path) == []


def test_stubs_name_what_there_is() -> None:
    """Every method and property of the stub exists in a model that can have it."""
    root = Path(__file__).parents[2]
    models = [bgdyn.load(root / "specs" / f"{name}.yaml") for name in ("scara", "loops/five_bar", "constraints/carousel")]
    models.append(bgdyn.load(root / "tests" / "numeric" / "specs" / "puma_payload.yaml"))  # run-time parameters
    models.append(bgdyn.load(root / "specs" / "contact" / "hopper.yaml"))  # contacts
    stub = (Path(bgdyn.__file__).parent / "_bgdyn.pyi").read_text()
    part = stub[stub.index("class Model:") : stub.index("class Scene:")]
    names = set(re.findall(r"^    (?:def )?(\w+)(?:\(|: MethodOfClass)", part, re.MULTILINE)) - {"__getattr__"}
    assert len(names) > 45
    for name in names:
        assert any(hasattr(model, name) for model in models), name
