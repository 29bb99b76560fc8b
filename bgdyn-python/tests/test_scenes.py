"""Runs of scenes."""

from __future__ import annotations

import copy
import csv
import pickle
from pathlib import Path

import numpy as np
import pytest

import bgdyn
from conftest import SPECS, Command

# A block of 2 kg on a spring of 50 N/m without friction: x = 0.1 cos 5t.
BLOCK = """
format: 1
links:
  - name: block
    joint: { name: slide, type: prismatic, axis: x }
    mass: { parameter: load, value: 2 kg }
effects:
  pull: { type: spring, joint: slide, stiffness: 50 N/m }
"""
SWING = """
scene: 1
mechanism: block.yaml
effects: [pull]
initial: { slide: 0.1 m }
integration: { method: dopri5, tolerance: 1e-10, end: 2 s }
"""


@pytest.fixture
def swing() -> bgdyn.Scene:
    return bgdyn.Scene(text=SWING, mechanism=BLOCK, name="swing")


def test_a_spring(swing: bgdyn.Scene) -> None:
    run = swing.simulate(points=101)
    assert run.failure is None and run.events == () and run.columns == swing.columns == ("slide", "slide_rate")
    assert run.units == {"slide": "m", "slide_rate": "m/s"}
    assert run.t == pytest.approx(np.linspace(0, 2, 101)) and len(run) == 101
    assert run["slide"] == pytest.approx(0.1 * np.cos(5 * run.t), abs=1e-9)
    assert run["slide_rate"] == pytest.approx(-0.5 * np.sin(5 * run.t), abs=1e-8)
    assert (run.values == np.stack([run["slide"], run["slide_rate"]], axis=1)).all()
    with pytest.raises(KeyError, match="no column `slid`; there are slide, slide_rate"):
        run["slid"]
    # The spring gives what the block takes.
    kinetic = 0.25 * np.sin(10) ** 2
    assert run.balance["links"].stored == pytest.approx(kinetic, abs=1e-9)
    assert run.balance["pull"].stored == pytest.approx(-kinetic, abs=1e-9)
    assert abs(run.drift) < 1e-9
    assert repr(run) == "<bgdyn.Run swing: 101 rows to t = 2 s, 0 events>"


def test_sampled_controllers(command: Command, tmp_path: Path) -> None:
    control = "control: { period: 50 ms, delay: 20 ms }"
    text = """
scene: 1
mechanism: block.yaml
effects: [inertia]
inputs: { slide: { pd: { target: 1 m, stiffness: 10, damping: 3 } } }
integration: { method: rk4, step: 7 ms, end: 1 s }
"""
    run = bgdyn.Scene(text=text + control, mechanism=BLOCK, name="sampled").simulate(points=101)
    # Samples are at 0, 50, 100, … ms and act at 20, 70, 120, … ms.
    q = v = effort = late = 0.0
    by_hand = [(q, v)]
    for point in range(100):
        if point % 5 == 0:
            late = 10 * (1 - q) - 3 * v
        if point % 5 == 2:
            effort = late
        h, a = 0.01, effort / 2
        q, v = q + h * v + h * h * a / 2, v + h * a
        by_hand.append((q, v))
    assert run.values == pytest.approx(np.array(by_hand), abs=1e-9)
    # Noise is that of the seed, and that of the command.
    noisy = text + control.replace(" }", ", noise: { position: 1 mm, velocity: 0.01 }, quantisation: { effort: 0.1 }, seed: SEED }")
    (tmp_path / "block.yaml").write_text(BLOCK)
    runs = []
    for seed in ["3", "3", "4"]:
        path = tmp_path / "noisy.scene.yaml"
        path.write_text(noisy.replace("SEED", seed))
        runs.append(bgdyn.Scene(path).simulate(points=101).values)
        out = tmp_path / "out"
        command("simulate", path, "--out", out, "--points", "101")
        with (out / "noisy.csv").open() as table:
            rows = [[float(x) for x in row] for row in list(csv.reader(table))[1:]]
        assert runs[-1] == pytest.approx(np.array(rows)[:, 1:3], abs=1e-12)
    assert (runs[0] == runs[1]).all() and abs(runs[0] - runs[2]).max() > 1e-5
    assert abs(runs[0] - run.values).max() > 1e-4


def test_controllers_with_a_model_of_their_own() -> None:
    text = """
scene: 1
mechanism: block.yaml
effects: [inertia, pull]
inputs: { slide: { computed_torque: { target: 1 m, stiffness: 10, damping: 3 } } }
controller_model: { effects: [inertia], parameters: { load: 3 kg } }
integration: { method: dopri5, tolerance: 1e-11, end: 2 s }
"""
    run = bgdyn.Scene(text=text, mechanism=BLOCK, name="model").simulate(points=51)
    # 2 a + 9 v + 80 q = 30
    w = np.sqrt(40 - 2.25**2)
    turned = np.cos(w * run.t) + 2.25 / w * np.sin(w * run.t)
    assert run["slide"] == pytest.approx(0.375 * (1 - np.exp(-2.25 * run.t) * turned), abs=1e-8)
    other = text.replace("effects: [inertia], p", "mechanism: other.yaml, p")
    with pytest.raises(bgdyn.SpecError, match="only the text of the scene's `mechanism` was given"):
        bgdyn.Scene(text=other, mechanism=BLOCK, name="model")


def test_settings(swing: bgdyn.Scene) -> None:
    assert swing.parameters == {"load": 2.0}
    run = swing.simulate(duration=3.0, parameters={"load": 8.0}, initial={"slide": -0.2, "slide_rate": 0.5}, tolerance=1e-11)
    assert run.t[-1] == 3.0
    assert run["slide"] == pytest.approx(-0.2 * np.cos(2.5 * run.t) + 0.2 * np.sin(2.5 * run.t), abs=1e-8)
    coarse = swing.simulate(step=0.1)
    assert coarse.steps == 20 and coarse["slide"] != pytest.approx(0.1 * np.cos(5 * coarse.t), abs=1e-9)
    for wrong in ({"duration": -1.0}, {"step": 0.0}, {"tolerance": float("nan")}, {"points": 1}, {"step": 0.1, "tolerance": 0.1},
                  {"parameters": {"loaf": 1.0}}, {"initial": {"load": 1.0}}, {"initial": {"slide": float("inf")}},
                  {"step": 1e-12}):  # fmt: skip
        with pytest.raises(ValueError):
            swing.simulate(**wrong)
    with pytest.raises(ValueError, match="does not go by a tolerance"):
        bgdyn.Scene(SPECS / "scenes" / "stick_slip.scene.yaml").simulate(tolerance=1e-6)


@pytest.mark.parametrize("name", ["stick_slip", "crane", "scara_friction", "hydraulic_cylinder"])
def test_runs_are_those_of_the_command(name: str, command: Command, tmp_path: Path) -> None:
    path = SPECS / "scenes" / f"{name}.scene.yaml"
    done = command("simulate", path, "--out", tmp_path, "--end", "1 s", "--points", "101")
    assert done.returncode == 0, done.stderr
    run = bgdyn.Scene(path).simulate(duration=1.0, points=101)
    with open(tmp_path / f"{name}.csv", newline="") as file:
        header, *rows = csv.reader(file)
    assert [head.rsplit(" ", 1)[0] for head in header] == ["t", *run.columns]
    table = np.array(rows, dtype=np.float64)
    assert (table[:, 0] == run.t).all() and (table[:, 1:] == run.values).all()
    assert run.report in done.stdout
    assert done.stdout.count("  t = ") == len(run.events)
    total = np.sum([list(entry) for entry in run.balance.values()], axis=0)
    assert total[1] + total[2] - total[0] == pytest.approx(run.drift, abs=1e-12)
    # The page of the command has a line about its second run, and ours has not.
    page = (tmp_path / f"{name}.html").read_text()
    assert run.page.split("differs most")[0][:2000] == page[:2000] and len(run.page) > 0.9 * len(page)


def test_events_and_pages() -> None:
    run = bgdyn.Scene(SPECS / "scenes" / "stick_slip.scene.yaml").simulate(duration=1.0)
    # It breaks away when the spring holds 4 N: 0.04 m at 0.1 m/s.
    assert run.events[0].t == pytest.approx(0.4) and run.events[0].text == "`belt` is released, -1"
    shown = run._repr_html_()
    assert shown.startswith("<iframe srcdoc=") and "&lt;!doctype html" in shown.lower()


def test_tables(swing: bgdyn.Scene) -> None:
    pytest.importorskip("pandas")
    run = swing.simulate(points=11)
    table = run.to_pandas()
    assert list(table.columns) == list(run.columns) and table.index.name == "t"
    assert (table["slide"].to_numpy() == run["slide"]).all() and (table.index.to_numpy() == run.t).all()


def test_pickles_and_copies(swing: bgdyn.Scene) -> None:
    of_file = bgdyn.Scene(SPECS / "scenes" / "crane.scene.yaml")
    for scene in (swing, of_file):
        again = pickle.loads(pickle.dumps(scene))
        assert again == scene and hash(again) == hash(scene) and type(again) is bgdyn.Scene
        assert copy.copy(scene) is scene and copy.deepcopy(scene) is scene
        one, two = scene.simulate(duration=0.2), again.simulate(duration=0.2)
        assert one.values.tobytes() == two.values.tobytes()
    assert swing != of_file
    assert swing != bgdyn.Scene(text=SWING, mechanism=BLOCK.replace("50 N/m", "51 N/m"), name="swing")


def test_doubtful_scenes_warn(command: Command) -> None:
    path = SPECS / "scenes" / "lugre_stick_slip.scene.yaml"
    with pytest.warns(bgdyn.SpecWarning, match="this friction can feed energy into the motion"):
        scene = bgdyn.Scene(path)
    assert pickle.loads(pickle.dumps(scene)) == scene  # without a warning


def test_refused_scenes(tmp_path: Path, command: Command) -> None:
    (tmp_path / "block.yaml").write_text(BLOCK.replace("axis: x", "axis: 3"))
    file = tmp_path / "swing.scene.yaml"
    file.write_text(SWING)
    with pytest.raises(bgdyn.SpecError, match="block.yaml:5:") as caught:
        bgdyn.Scene(file)
    for line in command("check", file).stderr.splitlines():
        assert line.split(": ")[-1] in str(caught.value)
    file.write_text(SWING.replace("effects: [pull]", "effects: [pul]"))
    (tmp_path / "block.yaml").write_text(BLOCK)
    with pytest.raises(bgdyn.SpecError) as caught:
        bgdyn.Scene(file)
    assert str(caught.value) == command("check", file).stderr.rstrip()
    file.write_text(SWING.replace("block.yaml", "none.yaml"))
    with pytest.raises(bgdyn.SpecError, match="none.yaml"):
        bgdyn.Scene(file)
    with pytest.raises(bgdyn.SpecError, match="is no scene"):
        bgdyn.Scene(SPECS / "scara.yaml")
    with pytest.raises(TypeError, match="give path, or"):
        bgdyn.Scene()
    with pytest.raises(FileNotFoundError):
        bgdyn.Scene(tmp_path / "missing.scene.yaml")
