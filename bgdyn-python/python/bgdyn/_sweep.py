"""Many runs of one scene."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _bgdyn
from ._arguments import Settings, number, text, values_of, whole
from ._progress import Progress, shown_by
from ._workers import computed, cores

if TYPE_CHECKING:
    import pandas

Array = NDArray[np.float64]

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


class Varied:
    """The values of all runs: a row for each run, in it the parameters before the parts of the start."""

    def __init__(self, names: list[str], axes: list[Array], grid: bool) -> None:
        """Takes the values of each name: of every combination in a grid, otherwise one for each run."""
        self.names, self.axes, self.grid = names, axes, grid
        self.parameters: list[str] = []
        self.initial: list[str] = []

    @property
    def total(self) -> int:
        """The number of runs."""
        sizes = [len(axis) for axis in self.axes]
        return math.prod(sizes) if self.grid else sizes[0]

    def order(self, parameters: list[bool]) -> None:
        """Takes which of the names are those of parameters."""
        for name, parameter in zip(self.names, parameters, strict=True):
            (self.parameters if parameter else self.initial).append(name)

    def column(self, name: str, first: int, end: int) -> Array:
        """Returns the values of a name in the runs from ``first`` to before ``end``."""
        place = self.names.index(name)
        axis = self.axes[place]
        if not self.grid:
            return axis[first:end]
        # The last name of a grid changes fastest.
        stride = math.prod(len(other) for other in self.axes[place + 1 :])
        return axis[np.arange(first, end) // stride % len(axis)]

    def rows(self, first: int, end: int) -> Array:
        """Returns the rows of these runs."""
        columns = [self.column(name, first, end) for name in self.parameters + self.initial]
        return np.stack(columns, axis=1)

    def check_finite(self) -> None:
        """Refuses values that are NaN or infinite."""
        for place, (name, axis) in enumerate(zip(self.names, self.axes, strict=True)):
            wrong = np.flatnonzero(~np.isfinite(axis))
            if len(wrong):
                others = self.axes[place + 1 :] if self.grid else []
                run = int(wrong[0]) * math.prod(len(other) for other in others)
                raise ValueError(f"`{name}` is {axis[wrong[0]]} in run {run}")


class Parts(Sequence[Array]):
    """The rows of the runs, in parts of ``size`` runs; each part is made when it is asked for."""

    def __init__(self, given: Varied, size: int) -> None:
        self.given, self.size = given, size

    def __len__(self) -> int:
        return -(-self.given.total // self.size)

    def __getitem__(self, index: Any) -> Any:
        if not 0 <= index < len(self):
            raise IndexError(index)
        first = index * self.size
        return self.given.rows(first, min(first + self.size, self.given.total))


class Part:
    """Computes some of the runs; it is sent to other processes."""

    def __init__(self, scene: _bgdyn.Scene, varied: Varied, settings: Settings) -> None:
        self.scene, self.settings = scene, settings
        self.parameters, self.initial = varied.parameters, varied.initial

    def __call__(self, values: Array) -> tuple[Array, list[tuple[int, str]]]:
        return self.scene._summaries(self.parameters, self.initial, values, self.settings)


def names_of(runs: Any) -> tuple[list[str], list[Any] | None]:
    """Returns the names that the runs differ by, and the dictionaries of the runs; None for a grid."""
    if isinstance(runs, Mapping):
        names, each = list(runs), None
    elif isinstance(runs, Iterable):
        each = list(runs)
        for k, run in enumerate(each):
            if not isinstance(run, Mapping):
                raise TypeError(f"run {k} is a dictionary, {{name: number}}, not {run!r}")
        names = list(each[0]) if each else []
    else:
        raise TypeError(f"`runs` is a grid, {{name: values}}, or a list of dictionaries, not {runs!r}")
    if not names:
        raise ValueError("there are no values: give a grid, {name: values}, or a list of dictionaries")
    return [text("a name in runs", name) for name in names], each


def varied(scene: _bgdyn.Scene, runs: Any, settings: Settings) -> Varied:
    """Returns the values of all runs: of every combination in a grid, or those of each dictionary."""
    names, each = names_of(runs)
    # Names and settings come before the values, of which there may be many.
    parameters = scene._check_runs(names, settings)
    for k, run in enumerate(each or []):
        if set(run) != set(names):
            raise ValueError(f"run {k} has values for {', '.join(run)}, run 0 for {', '.join(names)}: give all the same")
    if each is None:
        columns = [values_of(name, runs[name]) for name in names]
    else:
        columns = [[number(name, run[name], f"a number in run {k}") for k, run in enumerate(each)] for name in names]
    given = Varied(names, [np.array(column, dtype=np.float64) for column in columns], each is None)
    given.order(parameters)
    given.check_finite()
    return given


def check_memory(runs: int, numbers: int) -> None:
    """Refuses runs whose results, ``numbers`` of each, take more memory than there is.

    Without this check the system ends the process when the last of it is taken.
    """
    needed = 8 * runs * numbers
    try:
        there = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError):  # not on Windows
        there = sys.maxsize
    if needed > there:
        raise MemoryError(
            f"{runs:,} runs: their results take {needed / 1e9:,.0f} GB, and this machine has {there / 1e9:,.0f} GB; "
            "give fewer values, or sweep over parts of them"
        )


def sweep(scene: _bgdyn.Scene, runs: Any, workers: Any, settings: Settings, progress: Progress | bool) -> Sweep:
    """Computes all runs, in ``workers`` processes or in this one."""
    workers = cores() if workers is None else whole("workers", workers, "a number of processes")
    if workers < 0:
        raise ValueError(f"workers={workers}: it is a number of processes, 0 for this one")
    given = varied(scene, runs, settings)
    names, total = given.parameters + given.initial, given.total
    width = 2 + 3 * len(scene.columns)
    check_memory(total, width + len(names))
    size = max(1, min(LONGEST_PART, total // (max(1, workers) * PARTS_OF_A_WORKER)))
    parts, table = Parts(given, size), np.empty((total, width))
    compute, show = Part(scene, given, settings), shown_by(progress)
    found = computed(compute, parts, workers) if workers else enumerate(map(compute, parts))
    failures: dict[int, str] = {}
    done = 0
    for index, (rows, failed) in found:
        table[index * size : index * size + len(rows)] = rows
        failures |= {index * size + k: reason for k, reason in failed}
        done += len(rows)
        show(done, total)
    columns = {name: given.column(name, 0, total) for name in names}
    return Sweep(scene.columns, scene.units, columns, table, dict(sorted(failures.items())))
