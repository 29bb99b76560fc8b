"""Checks what a caller gives, and names it where it is wrong."""

from __future__ import annotations

import operator
import os
from collections.abc import Iterable, Mapping
from typing import Any

Settings = tuple[float | None, float | None, float | None, int]
"""Duration (s), step (s), tolerance, number of points."""


def number(name: str, value: Any, what: str = "a number in SI units") -> float:
    """Returns a number of Python or NumPy; no text is read as one."""
    if isinstance(value, (str, bytes, bytearray)):
        raise TypeError(f"`{name}` is {what}, not {value!r}")
    try:
        return float(value)
    except (TypeError, ValueError):
        raise TypeError(f"`{name}` is {what}, not {value!r}") from None


def whole(name: str, value: Any, what: str) -> int:
    """Returns a whole number."""
    try:
        return operator.index(value)
    except TypeError:
        raise TypeError(f"`{name}` is {what}, not {value!r}") from None


def values_by_name(name: str, given: Any) -> dict[str, float]:
    """Returns numbers by name; none for None."""
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise TypeError(f"`{name}` is a dictionary, {{name: number}}, not {given!r}")
    return {text(f"a name in {name}", one): number(one, value) for one, value in given.items()}


def text(name: str, value: Any, what: str = "a text") -> str:
    """Returns a text."""
    if not isinstance(value, str):
        raise TypeError(f"`{name}` is {what}, not {value!r}")
    return value


def path(name: str, value: Any) -> str | os.PathLike[str]:
    """Returns a path of a file."""
    if not isinstance(value, (str, os.PathLike)):
        raise TypeError(f"`{name}` is the path of a file, not {value!r}")
    return value


def settings(duration: Any, step: Any, tolerance: Any, points: Any) -> Settings:
    """Returns the settings of a run; their values are checked with those of the scene."""
    found = [
        None if value is None else number(name, value, "a positive number")
        for name, value in (("duration", duration), ("step", step), ("tolerance", tolerance))
    ]
    count = whole("points", points, "a number of times, 2 or more")
    if count < 2:
        raise ValueError(f"`points` is a number of times, 2 or more, not {count}: the start and the end are 2")
    return found[0], found[1], found[2], count


def values_of(name: str, given: Any) -> list[float]:
    """Returns the values of a grid with this name; a single number is one value."""
    if isinstance(given, (str, bytes, bytearray)) or not isinstance(given, Iterable):
        return [number(name, given)]
    try:
        each = list(given)
    except TypeError:  # an array of NumPy without axes
        each = [given]
    return [number(name, value) for value in each]
