"""Ctrl-C ends a computation that releases the interpreter's lock; each of these would take seconds or hours to its own end."""

from __future__ import annotations

import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

import bgdyn
from conftest import SPECS

CRANE = SPECS / "scenes" / "crane.scene.yaml"

RUN = f"bgdyn.Scene({str(CRANE)!r}).simulate(duration=1e5, step=1e-3)"
LONG_RUNS = f"bgdyn.Scene({str(CRANE)!r}).sweep({{'load_mass': [400.0, 500.0]}}, workers=0, duration=1e5, step=1e-3)"
MANY_RUNS = f"bgdyn.Scene({str(CRANE)!r}).sweep({{'load_mass': np.linspace(200, 500, 100_000)}}, workers=WORKERS, duration=1.0)"
BATCH = """q, v = np.zeros((4_000_000, 9)), np.zeros(3)
bicycle.forward_dynamics(q, v, v, threads=THREADS, on_singular="nan")"""
CLOSING = """q = np.zeros((1_000_000, 4)) + bars.neutral()
bars.close(q, threads=THREADS)"""


@pytest.fixture(autouse=True)
def signals_arrive() -> Iterator[None]:
    """A process that is started in the background may ignore SIGINT, and so do those that it starts."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def interrupted(code: str) -> subprocess.CompletedProcess[str]:
    """Runs lines of Python, sends a signal to the last of them, and returns how the process ended."""
    *before, last = code.splitlines()
    script = "\n".join([
        "import numpy as np",
        "import bgdyn",
        f"bicycle = bgdyn.load({str(SPECS / 'constraints' / 'whipple_bicycle.yaml')!r})",
        f"bars = bgdyn.load({str(SPECS / 'loops' / 'five_bar.yaml')!r})",
        *before,
        "print('begins', flush=True)",
        last,
        "print('was not interrupted')",
    ])  # fmt: skip
    process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        assert process.stdout is not None
        first = process.stdout.readline()
        assert first == "begins\n", process.communicate()
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
    finally:
        process.kill()
        process.wait()
    return subprocess.CompletedProcess([], process.returncode, out, err)


@pytest.mark.parametrize("code", [
    # No array was made before: NumPy is not asked for the first one while a signal waits.
    RUN,
    LONG_RUNS,
    MANY_RUNS.replace("WORKERS", "0"),
    MANY_RUNS.replace("WORKERS", "2"),
    BATCH.replace("THREADS", "1"),
    BATCH.replace("THREADS", "2"),
    CLOSING.replace("THREADS", "1"),
    CLOSING.replace("THREADS", "3"),
], ids=["run", "long runs", "many runs", "processes", "batch", "batch in threads", "closing", "closing in threads"])  # fmt: skip
def test_a_signal_ends_a_computation(code: str) -> None:
    done = interrupted(code)
    assert done.stdout == "" and "panicked" not in done.stderr
    assert done.stderr.rstrip().endswith("KeyboardInterrupt"), done.stderr
    assert done.returncode == -signal.SIGINT


def test_a_run_in_another_thread_has_no_signals() -> None:
    """Python handles signals in its main thread: a run elsewhere goes on to its end."""
    scene = bgdyn.Scene(CRANE)
    found: list[bgdyn.Run] = []
    thread = threading.Thread(target=lambda: found.append(scene.simulate(duration=2.0, step=1e-4)))
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)
    thread.join()
    assert found[0].failure is None and found[0].t[-1] == 2.0


def test_a_scene_runs_again_after_a_signal() -> None:
    scene = bgdyn.Scene(CRANE)
    before = scene.simulate(duration=0.2)
    timer = threading.Timer(0.2, signal.raise_signal, [signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        scene.simulate(duration=1e5, step=1e-3)
    assert (scene.simulate(duration=0.2).values == before.values).all()
