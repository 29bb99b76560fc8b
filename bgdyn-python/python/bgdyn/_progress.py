"""Shows how far a sweep is: by the caller's function, or as a line in a terminal or a notebook."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Any, TextIO

Progress = Callable[[int, int], Any]
"""Receives the number of finished runs, and of all."""

INTERVAL = 0.1
"""Shortest time between two lines, s."""


def shown_by(progress: Progress | bool) -> Progress:
    """Returns what receives the progress: the caller's function, a line, or nothing."""
    if callable(progress):
        return progress
    if progress and _in_notebook():
        return _Line(_Shown())
    if progress and sys.stderr.isatty():
        return _Line(_Written(sys.stderr))
    return lambda done, total: None


class _Line:
    """One line of text that changes, at most every `INTERVAL`; ``show`` receives it, and whether it is the last one."""

    def __init__(self, show: Callable[[str, bool], None]) -> None:
        self.show, self.begin, self.last = show, time.monotonic(), 0.0

    def __call__(self, done: int, total: int) -> None:
        now = time.monotonic()
        if done < total and now - self.last < INTERVAL:
            return
        self.last = now
        passed = now - self.begin
        left = f"{passed * (total - done) / done:.0f} s left" if 0 < done < total else f"{passed:.1f} s"
        self.show(f"{done:,} of {total:,} runs, {left}", done == total)


class _Written:
    """Writes the line in a terminal: a carriage return goes back to its start."""

    def __init__(self, stream: TextIO) -> None:
        self.stream, self.width = stream, 0

    def __call__(self, line: str, last: bool) -> None:
        self.stream.write("\r" + line.ljust(self.width) + ("\n" if last else ""))
        self.stream.flush()
        self.width = len(line)


class _Shown:
    """Shows the line in a notebook, as one output that changes."""

    def __init__(self) -> None:
        self.handle: Any = None

    def __call__(self, line: str, last: bool) -> None:
        text = {"text/plain": line}
        if self.handle is None:
            self.handle = sys.modules["IPython"].display.display(text, raw=True, display_id=True)
        else:
            self.handle.update(text, raw=True)


def _in_notebook() -> bool:
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    return shell is not None and hasattr(shell, "kernel")
