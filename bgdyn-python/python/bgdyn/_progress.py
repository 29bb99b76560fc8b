"""Shows how far a sweep is: by the caller's function, or as a line in a terminal or a notebook."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Any

Progress = Callable[[int, int], Any]
"""Receives the number of finished runs, and of all."""

INTERVAL = 0.1
"""Shortest time between two lines, s."""


def shown_by(progress: Progress | bool) -> Progress:
    """Returns what receives the progress: the caller's function, a line, or nothing."""
    if callable(progress):
        return progress
    notebook = _in_notebook()
    if progress and (notebook or sys.stderr.isatty()):
        return _Line(sys.stdout if notebook else sys.stderr)
    return lambda done, total: None


class _Line:
    """One line that is written again and again: a carriage return goes back to its start, in notebooks too."""

    def __init__(self, stream: Any) -> None:
        self.stream, self.begin, self.last, self.width = stream, time.monotonic(), 0.0, 0

    def __call__(self, done: int, total: int) -> None:
        now = time.monotonic()
        if done < total and now - self.last < INTERVAL:
            return
        self.last = now
        passed = now - self.begin
        left = f"{passed * (total - done) / done:.0f} s left" if 0 < done < total else f"{passed:.1f} s"
        line = f"{done:,} of {total:,} runs, {left}"
        self.stream.write("\r" + line.ljust(self.width) + ("\n" if done == total else ""))
        self.stream.flush()
        self.width = len(line)


def _in_notebook() -> bool:
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    return shell is not None and hasattr(shell, "kernel")
