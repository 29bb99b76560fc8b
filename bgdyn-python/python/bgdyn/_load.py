"""Loads mechanisms: from a file, from text, from a URDF or an MJCF."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path

from . import _arguments
from ._bgdyn import Model, import_file
from ._errors import LossWarning, SpecError, SpecWarning


def load(
    path: str | os.PathLike[str] | None = None,
    *,
    text: str | None = None,
    urdf: str | os.PathLike[str] | None = None,
    name: str | None = None,
    formulation: str | None = None,
    prefer: str = "operations",
    parameters: Mapping[str, float] | None = None,
) -> Model:
    """Returns the model of a mechanism, from one of three sources.

    ``path`` is a file in bgdyn's YAML; its stem is the name of the mechanism. ``text`` is such a file's text,
    with ``name``. ``urdf`` is a URDF, an MJCF, an SDF or a table of Denavit–Hartenberg parameters (``.csv``),
    converted as ``bgdyn import`` does.

    ``formulation`` selects one formulation for every method, ``prefer`` is "operations" or "accuracy".
    ``parameters`` are values of run-time parameters, SI units.

    Raises ``SpecError`` for a refused file, ``OSError`` for one that cannot be read, ``TypeError`` for an argument of
    another kind. What a robot's file has and a mechanism cannot have is a ``LossWarning``.
    """
    if sum(source is not None for source in (path, text, urdf)) != 1:
        raise TypeError("give one of path, text=..., urdf=...")
    if name is not None:
        _arguments.text("name", name, "the name of the mechanism")
    values = _arguments.values_by_name("parameters", parameters)
    shown: str | None = None
    if path is not None:
        shown, stem = os.fspath(_arguments.path("path", path)), _stem(path)
        text = read_text(path)
    elif urdf is not None:
        with open(_arguments.path("urdf", urdf), "rb"):
            pass  # an OSError for a file that cannot be read
        text, stem, losses = import_file(urdf)
        shown = f"<converted from {os.fspath(urdf)}>"
        for loss in losses:
            warnings.warn(loss, LossWarning, stacklevel=2)
    else:
        _arguments.text("text", text, "the text of a mechanism")
        if name is None:
            raise TypeError("text=... takes name=..., the name of the mechanism")
        stem = name
    assert text is not None
    try:
        model = Model(text, name if name is not None else stem, shown, formulation, prefer, values)
    except SpecError as error:
        if urdf is None:
            raise
        lines = "the lines are those of the spec that the file is converted to"
        raise SpecError(f"{error}\n{lines}: `bgdyn import {os.fspath(urdf)}` prints it") from None
    if model._warnings:
        warnings.warn(model._warnings, SpecWarning, stacklevel=2)
    return model


def restored(
    text: str, name: str, formulation: str | None, prefer: str, parameters: dict[str, float]
) -> Model:
    """Returns a pickled model."""
    return _prepared(text, name, formulation, prefer).with_parameters(**parameters)


@lru_cache(maxsize=16)
def _prepared(text: str, name: str, formulation: str | None, prefer: str) -> Model:
    """Returns the model of a text, the same one each time: a process prepares its functions once."""
    return Model(text, name, None, formulation, prefer)


def read_text(path: str | os.PathLike[str]) -> str:
    """Returns the text of a file."""
    try:
        # Not by `Path`, for which an empty path is the folder.
        with open(path, encoding="utf-8") as file:
            return file.read()
    except UnicodeDecodeError as error:
        raise SpecError(f"{os.fspath(path)} is not UTF-8: convert the file first") from error


def _stem(path: str | os.PathLike[str]) -> str:
    return Path(path).name.split(".")[0]
