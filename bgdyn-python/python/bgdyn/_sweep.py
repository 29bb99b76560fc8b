"""Many runs of one scene."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _bgdyn
from ._progress import Progress, shown_by
from ._workers import computed, cores

if TYPE_CHECKING:
    import pandas

Array = NDArray[np.float64]
Settings = tuple[float | None, float | None, float | None, int]

PARTS_OF_A_WORKER = 16
"""A part is at most this fraction of a worker's runs: what is lost with a worker, and the unit of the progress."""

LONGEST_PART = 1000
"""Largest number of runs of a part."""


class Sweep:
    """The results of many runs: an array with an entry for each run, in the order in which they were given."""

    runs: dict[str, Array]
    """(n,) by name: the values that the runs differ by."""
    columns: tuple[str, ...]
    """Names of the recorded quantities."""
    units: dict[str, str]
    """Their SI units."""
    end: dict[str, Array]
    """(n,) by column: the value at the end of the run; NaN if the run did not start."""
    low: dict[str, Array]
    """(n,) by column: the least value at the recorded times."""
    high: dict[str, Array]
    """(n,) by column: the largest one."""
    t: Array
    """(n,): the time at which the run ended, s."""
    drift: Array
    """(n,): energy error of the integration, relative to the energy that moved."""
    failures: dict[int, str]
    """By the number of the run: why it ended early, or did not start."""

    def __init__(
        self,
        columns: tuple[str, ...],
        units: dict[str, str],
        runs: dict[str, Array],
        table: Array,
        failures: dict[int, str],
    ) -> None:
        self.columns, self.units, self.runs, self.failures = columns, units, runs, failures
        self.t, self.drift = table[:, 0], table[:, 1]
        parts = [{name: table[:, 2 + 3 * i + k] for i, name in enumerate(columns)} for k in range(3)]
        self.end, self.low, self.high = parts

    def __len__(self) -> int:
        return len(self.t)

    def to_pandas(self) -> pandas.DataFrame:
        """Returns a table with a row for each run. Needs pandas.

        Its columns are the varied quantities, ``NAME end``, ``NAME min``, ``NAME max``, ``drift``, ``t end`` and
        ``failure``, which is empty for a run that reached its end.
        """
        import pandas

        table: dict[str, Any] = dict(self.runs)
        for name in self.columns:
            parts = {"end": self.end, "min": self.low, "max": self.high}
            table |= {f"{name} {part}": values[name] for part, values in parts.items()}
        reasons = [self.failures.get(k, "") for k in range(len(self))]
        table |= {"drift": self.drift, "t end": self.t, "failure": reasons}
        return pandas.DataFrame(table, index=pandas.RangeIndex(len(self), name="run"))

    def __repr__(self) -> str:
        names = ", ".join(self.runs)
        return f"<bgdyn.Sweep of {names}: {len(self)} runs, {len(self.failures)} of them failed>"


class Varied(NamedTuple):
    """The values of the runs: an array with a row for each run; parameters come before parts of the start."""

    parameters: list[str]
    initial: list[str]
    values: Array


class Part:
    """Computes some of the runs; it is sent to other processes."""

    def __init__(self, scene: _bgdyn.Scene, varied: Varied, settings: Settings) -> None:
        self.scene, self.settings = scene, settings
        self.parameters, self.initial = varied.parameters, varied.initial

    def __call__(self, values: Array) -> tuple[Array, list[tuple[int, str]]]:
        return self.scene._summaries(self.parameters, self.initial, values, self.settings)


def varied(scene: _bgdyn.Scene, runs: Mapping[str, Iterable[float]] | Iterable[Mapping[str, float]]) -> Varied:
    """Returns the values of all runs: of every combination in a grid, or those of each dictionary."""
    if isinstance(runs, Mapping):
        names = list(runs)
        # The last name of a grid changes fastest.
        rows: list[Sequence[float]] = list(itertools.product(*(list(values) for values in runs.values())))
    else:
        each = list(runs)
        names = list(each[0]) if each else []
        for k, run in enumerate(each):
            if set(run) != set(names):
                raise ValueError(f"run {k} has values for {', '.join(run)}, run 0 for {', '.join(names)}: give all the same")
        rows = [[run[name] for name in names] for run in each]
    if not names:
        raise ValueError("there are no values: give a grid, {name: values}, or a list of dictionaries")
    # float() refuses what is no number; whole numbers are as Python prints them.
    values = np.array([[float(x) for x in row] for row in rows]).reshape(len(rows), len(names))
    for j, name in enumerate(names):
        wrong = np.flatnonzero(~np.isfinite(values[:, j]))
        if len(wrong):
            raise ValueError(f"`{name}` is {values[wrong[0], j]} in run {wrong[0]}")
    known = scene.parameters
    order = sorted(range(len(names)), key=lambda j: names[j] not in known)
    names, values = [names[j] for j in order], np.ascontiguousarray(values[:, order])
    return Varied([n for n in names if n in known], [n for n in names if n not in known], values)


def sweep(
    scene: _bgdyn.Scene,
    runs: Mapping[str, Iterable[float]] | Iterable[Mapping[str, float]],
    workers: int | None,
    settings: Settings,
    progress: Progress | bool,
) -> Sweep:
    """Computes all runs, in ``workers`` processes or in this one."""
    workers = cores() if workers is None else workers
    if workers < 0:
        raise ValueError(f"workers={workers}: it is a number of processes, 0 for this one")
    given = varied(scene, runs)
    scene._check_runs(given.parameters, given.initial, settings)
    names, total = given.parameters + given.initial, len(given.values)
    size = max(1, min(LONGEST_PART, total // (max(1, workers) * PARTS_OF_A_WORKER)))
    parts = [given.values[k : k + size] for k in range(0, total, size)]
    compute, show = Part(scene, given, settings), shown_by(progress)
    found = computed(compute, parts, workers) if workers else enumerate(map(compute, parts))
    table = np.empty((total, 2 + 3 * len(scene.columns)))
    failures: dict[int, str] = {}
    done = 0
    for index, (rows, failed) in found:
        table[index * size : index * size + len(rows)] = rows
        failures |= {index * size + k: reason for k, reason in failed}
        done += len(rows)
        show(done, total)
    columns = {name: given.values[:, j] for j, name in enumerate(names)}
    return Sweep(scene.columns, scene.units, columns, table, dict(sorted(failures.items())))
