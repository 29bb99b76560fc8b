"""Scenes, and the runs of them."""

from __future__ import annotations

import html
import os
import warnings
from collections.abc import Iterable, Mapping
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, overload

import numpy as np
from numpy.typing import NDArray

from . import _arguments, _bgdyn
from ._errors import SpecWarning
from ._load import _stem, read_text
from ._progress import Progress
from ._sweep import Sweep, sweep

if TYPE_CHECKING:
    import pandas
    from typing_extensions import Self


class Event(NamedTuple):
    """An instant at which a mode changed."""

    t: float
    """Time, s."""
    text: str
    """What changed: "`belt` is held"."""


class EnergyEntry(NamedTuple):
    """Energy of one element over a run, J."""

    supplied: float
    """Work supplied from outside."""
    stored: float
    """Increase of stored energy."""
    dissipated: float
    """Dissipated work."""


class Run:
    """The record of a run: ``run.t`` and, by name, the scene's outputs or its whole state.

    The rows are equally spaced in time; events and the end of a run that ends early have rows of their own.
    """

    t: NDArray[np.float64]
    """(n,): times, s."""
    values: NDArray[np.float64]
    """(n, columns): the recorded quantities."""
    columns: tuple[str, ...]
    """Names of the quantities."""
    units: dict[str, str]
    """Their SI units; empty for a pure number."""
    events: tuple[Event, ...]
    """The instants at which a mode changed."""
    balance: dict[str, EnergyEntry]
    """Energy by element."""
    drift: float
    """Stored + dissipated − supplied, J: the energy error of the integration."""
    steps: int
    """Number of steps."""
    failure: str | None
    """Why the run ended early; None if it did not."""
    report: str
    """The summary that ``bgdyn simulate`` prints."""
    page: str
    """A self-contained HTML page that replays the run."""

    def __init__(self, found: Mapping[str, Any]) -> None:
        self.name: str = found["name"]
        self.t = found["t"]
        self.values = found["values"]
        self.columns = tuple(found["columns"])
        self.units = dict(zip(self.columns, found["units"], strict=True))
        self.events = tuple(Event(*event) for event in found["events"])
        self.balance = {name: EnergyEntry(*parts) for name, parts in found["balance"]}
        self.drift = found["drift"]
        self.steps = found["steps"]
        self.failure = found["failure"]
        self.report = found["report"]
        self.page = found["page"]

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        """Returns a quantity at the times ``t``, (n,), in its SI unit."""
        try:
            return self.values[:, self.columns.index(name)]
        except ValueError:
            raise KeyError(f"no column `{name}`; there are {', '.join(self.columns)}") from None

    def __len__(self) -> int:
        return len(self.t)

    def to_pandas(self) -> pandas.DataFrame:
        """Returns the table of the run with the index ``t``. Needs pandas."""
        import pandas

        index = pandas.Index(self.t, name="t")
        return pandas.DataFrame(self.values, index=index, columns=list(self.columns))

    def __repr__(self) -> str:
        end = f"ends early: {self.failure}" if self.failure else f"{len(self.events)} events"
        return f"<bgdyn.Run {self.name}: {len(self)} rows to t = {self.t[-1]:g} s, {end}>"

    def _repr_html_(self) -> str:
        page = html.escape(self.page, quote=True)
        return f'<iframe srcdoc="{page}" width="100%" height="640" style="border: 0"></iframe>'


class Scene(_bgdyn.Scene):
    """A scene: a mechanism with the effects, inputs and start of one run.

    ``Scene(path)`` reads a scene and the mechanism that it names. Raises ``SpecError`` for a refused file.
    """

    def __new__(
        cls,
        path: str | os.PathLike[str] | None = None,
        *,
        text: str | None = None,
        mechanism: str | None = None,
        name: str | None = None,
    ) -> Self:
        """Reads ``path``, or takes the scene's ``text`` with its ``name`` and the text of its ``mechanism``."""
        for argument, value in {"text": text, "mechanism": mechanism, "name": name}.items():
            if value is not None:
                _arguments.text(argument, value)
        if path is not None and text is None and mechanism is None:
            _arguments.path("path", path)
            stem = name if name is not None else _stem(path)
            scene = super().__new__(cls, read_text(path), stem, Path(path))
        elif path is None and text is not None and mechanism is not None and name is not None:
            scene = super().__new__(cls, text, name, None, mechanism)
        else:
            raise TypeError("give path, or text=..., mechanism=... and name=...")
        if scene._warnings:
            warnings.warn(scene._warnings, SpecWarning, stacklevel=2)
        return scene

    def simulate(
        self,
        *,
        duration: float | None = None,
        parameters: Mapping[str, float] | None = None,
        initial: Mapping[str, float] | None = None,
        step: float | None = None,
        tolerance: float | None = None,
        points: int = 1001,
    ) -> Run:
        """Runs the scene by its own integrator and returns the record.

        ``duration`` (s), ``step`` (s) and ``tolerance`` replace those of the file. ``parameters`` are values of
        run-time parameters, ``initial`` of positions, velocities (``NAME_rate``), states and modes at the start,
        SI units. ``points`` is the number of rows from 0 to the end; events add rows of their own. Inputs that
        the scene does not drive are 0.

        A run that ends early is returned with its ``failure``. Raises ``ValueError`` for a setting or a start
        that the scene cannot have, ``TypeError`` for what is no number. The interpreter's lock is released during the
        run, and Ctrl-C ends it.
        """
        found = self._simulate(
            list(_arguments.values_by_name("parameters", parameters).items()),
            list(_arguments.values_by_name("initial", initial).items()),
            _arguments.settings(duration, step, tolerance, points),
        )
        return Run(found)

    @overload
    def sweep(
        self,
        runs: Mapping[str, Iterable[float] | float],
        *,
        workers: int | None = None,
        duration: float | None = None,
        step: float | None = None,
        tolerance: float | None = None,
        points: int = 101,
        progress: Progress | bool = True,
    ) -> Sweep: ...
    @overload
    def sweep(
        self,
        runs: Iterable[Mapping[str, float]],
        *,
        workers: int | None = None,
        duration: float | None = None,
        step: float | None = None,
        tolerance: float | None = None,
        points: int = 101,
        progress: Progress | bool = True,
    ) -> Sweep: ...
    def sweep(
        self,
        runs: Mapping[str, Iterable[float] | float] | Iterable[Mapping[str, float]],
        *,
        workers: int | None = None,
        duration: float | None = None,
        step: float | None = None,
        tolerance: float | None = None,
        points: int = 101,
        progress: Progress | bool = True,
    ) -> Sweep:
        """Runs the scene with many values of parameters and of its start, and returns the ends and extremes.

        ``runs`` is a grid, ``{name: values}``, of which every combination is run, the last name changing fastest (a
        number in place of values is the value of all runs); or a list of dictionaries ``{name: value}``, one for each
        run. Names are those of ``parameters``, and of positions, velocities, states and modes as in ``initial`` of
        ``simulate``. SI units.

        ``workers`` is the number of processes: by default that of the cores, with 0 the runs are computed in this
        process. The results are the same to the bit. A part of a process that dies is computed again. The scene is
        prepared once in each process.

        ``duration``, ``step``, ``tolerance`` as in ``simulate``; ``points`` is the number of times, from 0 to the
        end, of which the extremes are taken. ``progress`` is called with the number of finished runs and of all; True
        shows a line in a terminal or a notebook.

        A run that ends early, or cannot start, is no error: see ``Sweep.failures``. Raises ``ValueError`` for unknown
        names, for values that are NaN or infinite, and for settings that the scene cannot have, ``TypeError`` for what
        is no number, ``MemoryError`` for more runs than results can be held of, before the first run.
        """
        return sweep(self, runs, workers, _arguments.settings(duration, step, tolerance, points), progress)

    def __reduce__(self) -> tuple[Any, ...]:
        return (_restored, (self.text, self.mechanism_text, self.name))

    def __copy__(self) -> Scene:
        return self

    def __deepcopy__(self, memo: object) -> Scene:
        return self


@lru_cache(maxsize=16)
def _restored(text: str, mechanism: str, name: str) -> Scene:
    """Returns a pickled scene; the same one for the same text, so that a process prepares its functions once."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SpecWarning)
        return Scene(text=text, mechanism=mechanism, name=name)
