"""examples/python: the tutorial notebook runs, and a study loses nothing when a worker is killed."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import bgdyn
from conftest import ROOT

EXAMPLES = ROOT / "examples" / "python"
RUNS = 4_000


def test_the_tutorial_runs() -> None:
    nbformat = pytest.importorskip("nbformat")
    client = pytest.importorskip("nbclient").NotebookClient
    pytest.importorskip("matplotlib")
    notebook = nbformat.read(EXAMPLES / "tutorial.ipynb", as_version=4)
    assert all(not cell.get("outputs") for cell in notebook.cells), "the notebook is stored without outputs"
    client(notebook, timeout=300, resources={"metadata": {"path": str(EXAMPLES)}}).execute()
    shown = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    assert not any(output.output_type == "error" for output in shown)
    data = [output.data for output in shown if "data" in output]
    assert sum("image/png" in one for one in data) >= 5
    assert sum("<svg" in one.get("text/html", "") for one in data) >= 1
    assert sum("<iframe srcdoc" in one.get("text/html", "") for one in data) == 1


def children(of: int) -> list[tuple[int, str]]:
    """Returns process number and command of the children of a process, and of theirs."""
    done = subprocess.run(["ps", "-o", "pid=,args=", "--ppid", str(of)], capture_output=True, text=True, check=False)
    lines = [line.split(None, 1) for line in done.stdout.splitlines()]
    own = [(int(pid), command) for pid, command in lines]
    return [*own, *(one for pid, _ in own for one in children(pid))]


def workers_of(name: str) -> list[int]:
    """Returns the process numbers of the workers that compute now."""
    if name == "on_dask":
        from distributed import default_client  # type: ignore[import-not-found,unused-ignore]

        return list(default_client().run(os.getpid).values())
    return [pid for pid, command in children(os.getpid()) if "loky" in command]


@pytest.mark.parametrize(("name", "module"), [("on_dask", "distributed"), ("on_joblib", "joblib")])
# Both warn of a worker that died, as they should here.
@pytest.mark.filterwarnings("ignore")
def test_a_killed_worker_loses_nothing(
    name: str, module: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip(module)
    pytest.importorskip("pyarrow")
    monkeypatch.syspath_prepend(str(EXAMPLES / "monte_carlo"))
    # Workers import the module `study` as well.
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(EXAMPLES / "monte_carlo"), *filter(None, sys.path)]))
    import study as studies  # type: ignore[import-not-found]

    run: Callable[..., None] = __import__(name).run
    killed: list[int] = []

    def kill_one(done: int, total: int) -> None:
        if done >= 3 and not killed:
            killed.append(workers_of(name)[-1])
            os.kill(killed[0], signal.SIGKILL)

    scene = bgdyn.Scene(studies.SCENE)
    study = studies.Study(tmp_path / "killed", runs=RUNS, part=100)
    run(study, scene, 2, kill_one)
    assert killed and study.left() == []
    # All runs, each with the results of a study in this process.
    alone = studies.Study(tmp_path / "alone", runs=RUNS, part=100)
    for part in range(alone.parts()):
        alone.write(*studies.computed(alone, scene, part))
    for column in ("mass", "compression", "rebound", "failed"):
        assert (study.read(column) == alone.read(column)).all() and len(study.read(column)) == RUNS
    assert not alone.read("failed").any()
    check_physics(alone)


def check_physics(study: Any) -> None:
    """The way of a damped oscillator from x = 0 with the velocity v₀, in closed form."""
    mass, stiffness, damping, v0 = (study.read(name) for name in ("mass", "stiffness", "damping", "travel_rate"))
    decay = damping / (2 * mass)
    rate = np.sqrt(stiffness / mass - decay**2)
    times = np.linspace(0.0, 0.15, 31)[:, None]
    ways = v0 / rate * np.exp(-decay * times) * np.sin(rate * times)
    assert study.read("compression") == pytest.approx(ways.max(axis=0), abs=1e-7)


def test_an_interrupted_study_goes_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("pyarrow")
    monkeypatch.syspath_prepend(str(EXAMPLES / "monte_carlo"))
    import study as studies

    scene = bgdyn.Scene(studies.SCENE)
    study = studies.Study(tmp_path, runs=250, part=100)
    assert study.left() == [0, 1, 2]
    study.write(*studies.computed(study, scene, 1))
    (tmp_path / "part-00002.unfinished").touch()
    assert study.left() == [0, 2]
    for part in study.left():
        study.write(*studies.computed(study, scene, part))
    assert len(study.read("mass")) == 250 and study.left() == []


def ran(script: str, *arguments: str | Path) -> subprocess.CompletedProcess[str]:
    """Runs a study as a user does."""
    command = [sys.executable, str(EXAMPLES / "monte_carlo" / script), *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.mark.parametrize(("script", "module"), [("on_dask.py", "distributed"), ("on_joblib.py", "joblib")])
def test_numbers_that_no_study_has(script: str, module: str, tmp_path: Path) -> None:
    pytest.importorskip(module)
    pytest.importorskip("pyarrow")
    for option, number in (("--runs", "0"), ("--runs", "-5"), ("--workers", "0"), ("--runs", "many")):
        done = ran(script, tmp_path / "study", option, number)
        assert done.returncode == 2 and "Traceback" not in done.stderr
        assert f"argument {option}: " in done.stderr and number in done.stderr
    assert not (tmp_path / "study").exists()


def test_a_folder_has_one_study(tmp_path: Path) -> None:
    """Parts of a study with more runs are not taken for those of one with fewer."""
    pytest.importorskip("joblib")
    pytest.importorskip("pyarrow")
    first = ran("on_joblib.py", tmp_path, "--runs", "300", "--workers", "1")
    assert first.returncode == 0, first.stderr
    other = ran("on_joblib.py", tmp_path, "--runs", "200", "--workers", "1")
    assert other.returncode == 2 and "give another folder" in other.stderr and "'runs': 300" in other.stderr
    # The same one goes on, or has nothing left to do.
    again = ran("on_joblib.py", tmp_path, "--runs", "300", "--workers", "1")
    assert again.returncode == 0 and again.stdout.splitlines()[-1] == first.stdout.splitlines()[-1]
    # Parts that say nothing of their study.
    (tmp_path / "study.json").unlink()
    assert "no study.json" in ran("on_joblib.py", tmp_path, "--runs", "300").stderr
