"""Many runs of a scene: their values, processes, what a dead process loses, progress."""

from __future__ import annotations

import io
import math
import os
import pickle
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import bgdyn
from bgdyn import _progress, _sweep, _workers
from conftest import SPECS
from test_scenes import BLOCK, SWING


@pytest.fixture(scope="module")
def swing() -> bgdyn.Scene:
    return bgdyn.Scene(text=SWING, mechanism=BLOCK, name="swing")


def test_a_grid(swing: bgdyn.Scene) -> None:
    """A block of mass m on a spring of 50 N/m: x = x₀ cos ωt."""
    found = swing.sweep({"slide": [0.1, -0.2], "load": [1.0, 2.0, 4.5]}, workers=0, duration=3.0, tolerance=1e-10)
    assert len(found) == 6 and found.failures == {}
    assert found.columns == ("slide", "slide_rate") and found.units == {"slide": "m", "slide_rate": "m/s"}
    # The last name changes fastest.
    assert found.runs["slide"].tolist() == [0.1] * 3 + [-0.2] * 3 and found.runs["load"].tolist() == [1.0, 2.0, 4.5] * 2
    rate = np.sqrt(50.0 / found.runs["load"])
    assert found.end["slide"] == pytest.approx(found.runs["slide"] * np.cos(3 * rate), abs=1e-8)
    assert found.end["slide_rate"] == pytest.approx(-rate * found.runs["slide"] * np.sin(3 * rate), abs=1e-7)
    times = np.linspace(0, 3, 101)
    for k in range(6):
        way = found.runs["slide"][k] * np.cos(rate[k] * times)
        assert (found.low["slide"][k], found.high["slide"][k]) == pytest.approx((way.min(), way.max()), abs=1e-8)
    assert (found.t == 3.0).all() and (np.abs(found.drift) < 1e-8).all()
    assert repr(found) == "<bgdyn.Sweep of load, slide: 6 runs, 0 of them failed>"


def test_runs_are_those_of_simulate() -> None:
    scene = bgdyn.Scene(SPECS / "scenes" / "stick_slip.scene.yaml")
    starts = [{"slide_rate": x, "slide": 0.01 * x} for x in (0.1, 0.0, -0.3)]
    found = scene.sweep(starts, workers=0, duration=1.0, points=51)
    for k, start in enumerate(starts):
        run = scene.simulate(duration=1.0, points=51, initial=start)
        for name in scene.columns:
            assert found.end[name][k] == run[name][-1]
            assert (found.low[name][k], found.high[name][k]) == (run[name].min(), run[name].max())


def test_processes_give_the_same_bits(swing: bgdyn.Scene) -> None:
    runs = [{"load": 1.0 + 0.1 * k} for k in range(40)]
    one = swing.sweep(runs, workers=0, duration=0.5)
    for workers in (1, 2, 3):
        seen: list[tuple[int, int]] = []
        many = swing.sweep(runs, workers=workers, duration=0.5, progress=lambda done, total: seen.append((done, total)))
        assert many.end["slide"].tobytes() == one.end["slide"].tobytes()
        assert [total for _, total in seen] == [40] * len(seen) and seen[-1] == (40, 40)
        assert [done for done, _ in seen] == sorted({done for done, _ in seen}) and len(seen) > 3


def test_runs_that_fail_are_not_errors() -> None:
    scene = bgdyn.Scene(SPECS / "scenes" / "crane.scene.yaml")
    found = scene.sweep({"load_mass": [400.0, -1e5]}, workers=0, duration=0.01)
    good = scene.simulate(duration=0.01, points=101)
    assert found.end["luff"][0] == good["luff"][-1]
    assert list(found.failures) == [1] and found.failures[1]


@pytest.mark.parametrize(("runs", "message"), [
    ({"loaf": [1.0]}, "did you mean `load`"),
    ({"slide": [0.0, 0.1], "load": [1.0, math.inf, 2.0]}, "`load` is inf in run 1"),
    ({"load": [1.0, math.nan], "slide": [0.0, 0.1, 0.2]}, "`load` is nan in run 3"),
    ({"load": [1.0, math.nan]}, "`load` is nan in run 1"),
    ([{"load": 1.0}, {"load": math.inf}], "`load` is inf in run 1"),
    ([{"load": 1.0}, {"slide": 1.0}], "run 1 has values for slide, run 0 for load"),
    ([], "there are no values"),
    ({}, "there are no values"),
])  # fmt: skip
def test_wrong_values(swing: bgdyn.Scene, runs: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        swing.sweep(runs, workers=0)


@pytest.mark.parametrize(("runs", "message"), [
    ({"load": ["two"]}, "`load` is a number in SI units, not 'two'"),
    ({"load": "two"}, "`load` is a number in SI units, not 'two'"),
    ({"load": [None]}, "`load` is a number in SI units, not None"),
    ([{"load": 1.0}, {"load": "two"}], "`load` is a number in run 1, not 'two'"),
    ([{"load": 1.0}, 2.0], "run 1 is a dictionary, {name: number}, not 2.0"),
    ({1: [2.0]}, "`a name in runs` is a text, not 1"),
    (5, "`runs` is a grid, {name: values}, or a list of dictionaries, not 5"),
])  # fmt: skip
def test_wrong_kinds(swing: bgdyn.Scene, runs: Any, message: str) -> None:
    with pytest.raises(TypeError, match=message):
        swing.sweep(runs, workers=0)


def test_one_value_for_all_runs(swing: bgdyn.Scene) -> None:
    found = swing.sweep({"load": 2.0, "slide": np.array([0.1, 0.2])}, workers=0, duration=0.1)
    assert found.runs["load"].tolist() == [2.0, 2.0] and found.runs["slide"].tolist() == [0.1, 0.2]
    assert len(swing.sweep({"load": np.float64(2.0), "slide": np.array(0.1)}, workers=0, duration=0.1)) == 1


def test_grids_that_are_too_large(swing: bgdyn.Scene) -> None:
    """Names come before the runs are laid out, and runs that cannot be held are refused by their number."""
    many = range(1000)
    names = ("load", "slide", "slide_rate")
    with pytest.raises(MemoryError, match="^1,000,000,000,000 runs: their results take "):
        swing.sweep({name: range(10_000) for name in names}, workers=0)
    # 10²⁷ runs: nothing of this size is made before the names are compared.
    values: dict[str, Any] = {f"{name}{k}": many for name in names for k in range(3)}
    with pytest.raises(ValueError, match="is called `load0`"):
        swing.sweep(values, workers=0)


def test_a_grid_is_made_part_by_part() -> None:
    """Each part is laid out when it is computed; the rows are those of the whole grid."""
    axes = [np.arange(float(n)) for n in (7, 11, 13)]
    given = _sweep.Varied(["a", "b", "c"], axes, grid=True)
    given.order([False, True, False])
    parts = _sweep.Parts(given, 10)
    assert len(parts) == 101 and len(parts[100]) == 1
    whole = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    assert (np.concatenate(list(parts)) == whole[:, [1, 0, 2]]).all()
    large = _sweep.Varied(["a", "b", "c"], [np.arange(1000.0)] * 2 + [np.zeros(1)], grid=True)
    large.order([True] * 3)
    assert _sweep.Parts(large, 1000)[999][-1].tolist() == [999.0, 999.0, 0.0]


def test_wrong_settings(swing: bgdyn.Scene) -> None:
    with pytest.raises(ValueError, match="workers=-1"):
        swing.sweep({"load": [1.0]}, workers=-1)
    with pytest.raises(ValueError, match="`duration` is a positive number"):
        swing.sweep({"load": [1.0]}, duration=-1.0)
    with pytest.raises(TypeError, match="`workers` is a number of processes, not 'two'"):
        swing.sweep({"load": [1.0]}, workers="two")  # type: ignore[call-overload]
    assert len(swing.sweep({"load": []}, workers=2)) == 0


class Deadly:
    """Kills its process at the parts for which there is no file yet: the first time that each of them is computed."""

    def __init__(self, folder: Path, deadly: set[int]) -> None:
        self.folder, self.deadly = folder, deadly

    def __call__(self, part: int) -> int:
        mark = self.folder / str(part)
        if part in self.deadly and not mark.exists():
            mark.touch()
            os.kill(os.getpid(), signal.SIGKILL)
        with open(self.folder / f"{part}.done", "a") as file:
            file.write("x")
        return part * part


class Fails:
    def __call__(self, part: int) -> int:
        print("words on the output do not disturb the answers")
        if part == 3:
            raise KeyError("three")
        return part


class Always:
    def __call__(self, part: int) -> int:
        os.kill(os.getpid(), signal.SIGKILL)
        return part


def test_a_killed_process_loses_nothing(tmp_path: Path) -> None:
    parts = list(range(12))
    found = dict(_workers.computed(Deadly(tmp_path, {0, 5, 6}), parts, 2))
    assert found == {k: k * k for k in parts}
    # The parts of the dead processes were computed again, the others once.
    assert {k: (tmp_path / f"{k}.done").read_text() for k in parts} == dict.fromkeys(parts, "x")
    assert all((tmp_path / str(k)).exists() for k in (0, 5, 6))


def test_a_process_killed_from_outside(swing: bgdyn.Scene) -> None:
    runs = [{"load": 1.0 + 0.01 * k} for k in range(200)]
    killed: list[int] = []

    def kill_one(done: int, total: int) -> None:
        if not killed:
            children = subprocess.run(["ps", "-o", "pid=,args=", "--ppid", str(os.getpid())], capture_output=True, text=True, check=True)
            own = [line.split()[0] for line in children.stdout.splitlines() if "bgdyn._worker" in line]
            killed.append(int(own[0]))
            os.kill(killed[0], signal.SIGKILL)

    many = swing.sweep(runs, workers=2, progress=kill_one)
    assert killed and many.end["slide"].tobytes() == swing.sweep(runs, workers=0).end["slide"].tobytes()


def test_errors_of_processes() -> None:
    with pytest.raises(KeyError, match="three"):
        dict(_workers.computed(Fails(), list(range(8)), 2))
    with pytest.raises(RuntimeError, match="ended its process 3 times"):
        dict(_workers.computed(Always(), [1], 1))
    left = subprocess.run(["ps", "-o", "args=", "--ppid", str(os.getpid())], capture_output=True, text=True, check=True)
    assert "bgdyn._worker" not in left.stdout


def test_a_script_needs_no_guard(tmp_path: Path) -> None:
    script = tmp_path / "study.py"
    scene = SPECS / "scenes" / "stick_slip.scene.yaml"
    script.write_text(f"""
import bgdyn
found = bgdyn.Scene({str(scene)!r}).sweep({{"slide": [0.0, 0.01]}}, workers=2, duration=0.1)
print(len(found))
""")
    done = subprocess.run([sys.executable, str(script)], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "2\n", "")


def test_the_line_of_progress() -> None:
    stream = io.StringIO()
    line = _progress._Line(_progress._Written(stream))
    line(250, 1000)
    line(251, 1000)  # too early for another line
    line(1000, 1000)
    first, second, third = stream.getvalue().split("\r")
    assert first == "" and second.startswith("250 of 1,000 runs, ") and second.endswith(" s left")
    assert third.startswith("1,000 of 1,000 runs, ") and third.endswith("\n")


def test_tables(swing: bgdyn.Scene) -> None:
    pytest.importorskip("pandas")
    found = swing.sweep({"load": [1.0, 2.0]}, workers=0, duration=0.5)
    table = found.to_pandas()
    assert list(table.columns) == ["load", "slide end", "slide min", "slide max", "slide_rate end", "slide_rate min", "slide_rate max",
                                   "drift", "t end", "failure"]  # fmt: skip
    assert (table["slide end"].to_numpy() == found.end["slide"]).all() and table.index.name == "run"


def test_a_process_prepares_a_scene_once(swing: bgdyn.Scene) -> None:
    sent = pickle.dumps(swing)
    assert pickle.loads(sent) is pickle.loads(sent)
