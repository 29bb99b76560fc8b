"""What several tests use: the repository's specs, random states, the command ``bgdyn``."""

from __future__ import annotations

import json
import os
import re
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import bgdyn

ROOT = Path(__file__).parents[2]
SPECS = ROOT / "specs"
GOLDEN = ROOT / "tests" / "golden"

Command = Callable[..., "subprocess.CompletedProcess[str]"]


def width(method: bgdyn.Method, argument: str) -> int:
    """Returns the number of components of an argument of a method, as its documentation says."""
    size = re.search(rf"^    {argument}: \(\.\.\., (\d+)\), \S", method.__doc__ or "", re.MULTILINE)
    assert size, (method, argument)
    return int(size.group(1))


@pytest.fixture
def random() -> np.random.Generator:
    """Random numbers, the same in each run."""
    return np.random.default_rng(2007)


@pytest.fixture
def command() -> Command:
    """Runs the command ``bgdyn``; the environment variable BGDYN is its path, as ``.ci/python`` sets it."""
    path = os.environ.get("BGDYN")
    if path is None:
        pytest.skip("BGDYN, the path of the command bgdyn, is not set")

    def run(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [path, *arguments], cwd=ROOT, capture_output=True, text=True, check=False
        )

    return run


@pytest.fixture
def evaluated(command: Command, tmp_path: Path) -> Callable[..., list[Any]]:
    """Evaluates a method by the command at states, arrays by argument."""

    def evaluate(spec: Path, method: str, **arguments: NDArray[np.float64]) -> list[Any]:
        count = len(next(iter(arguments.values())))
        rows = {"tau_in" if name == "tau" else name: x for name, x in arguments.items()}
        states = [{name: x[k].tolist() for name, x in rows.items()} for k in range(count)]
        file = tmp_path / "states.json"
        file.write_text(json.dumps({"states": states}))
        done = command("eval", spec, method, "--states", file)
        assert done.returncode == 0, done.stderr
        results: list[Any] = json.loads(done.stdout)["results"]
        return results

    return evaluate
