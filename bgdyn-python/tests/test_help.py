"""What help, inspect and notebooks show of methods: shapes that are those of results, units, frames."""

from __future__ import annotations

import inspect
import pydoc
import re
from typing import Any

import numpy as np
import pytest

import bgdyn
from conftest import SPECS, width

FILES = ("scara", "loops/five_bar", "constraints/whipple_bicycle")


def described(text: str) -> dict[str, tuple[int, ...]]:
    """Returns the shapes in a text, without the leading one, by name; a single array has the name ``""``."""
    returned = text[text.index("\n\nReturns ") :]
    pairs = re.findall(r"(\w+)?:? ?\(\.\.\.((?:, \d+)*)\)", returned.replace("Returns", ""))
    return {name: tuple(int(size) for size in sizes.split(", ")[1:]) for name, sizes in pairs}


@pytest.mark.parametrize("file", FILES)
def test_shapes_are_those_of_results(file: str) -> None:
    model = bgdyn.load(SPECS / f"{file}.yaml")
    q = np.stack([model.neutral()] * 2)
    for name in model.methods:
        method = getattr(model, name)
        text = method.__doc__
        arguments = []
        for argument in method.arguments:
            arguments.append(q if argument == "q" else np.zeros((2, width(method, argument))))
        if "q" in method.arguments:
            assert f"    q: (..., {model.nq}), positions: rad, m" in text
        result, _ = method(*arguments, on_singular="nan")
        found = result._asdict() if hasattr(result, "_asdict") else {"": result}
        assert described(text) == {field: array.shape[1:] for field, array in found.items()}, name
        if hasattr(result, "_asdict"):
            assert f"Returns bgdyn.{type(result).__name__}, " in text
        # The units, and no names of Rust.
        assert text.endswith(method.units) and "[`" not in text + repr(method)
        assert method.summary in text


def test_functions_have_names_and_signatures() -> None:
    arm, bars = (bgdyn.load(SPECS / f"{file}.yaml") for file in FILES[:2])
    signature = inspect.signature(arm.inverse_dynamics)
    assert str(signature) == "(q, v, a, *, out=None, threads=1, on_singular='raise')"
    assert str(inspect.signature(bars.constraint_bias)) == "(q, qd, *, out=None, threads=1, on_singular='raise')"
    assert arm.pose_tool.__name__ == "pose_tool"
    shown = pydoc.plain(pydoc.render_doc(arm.joint_reactions))
    assert "about the link's origin, in link axes" in shown and "links as in `link_names`" in shown
    assert "world axes" in (arm.velocity_tool.__doc__ or "")
    # The class has a text of its own.
    assert bgdyn.Method.__doc__ and "out" in bgdyn.Method.__doc__


def test_the_class_shows_its_methods() -> None:
    shown = pydoc.plain(pydoc.render_doc(bgdyn.Model))
    for name, arguments in {"mass_matrix": "q", "forward_dynamics": "q, v, tau", "constrained_dynamics": "q, qd, tau"}.items():
        # Newer versions of Python break long lines.
        wanted = f"{name}(self, {arguments}, *, out=None, threads=1, on_singular='raise')"
        assert wanted.replace(" ", "") in re.sub(r"[\s|]", "", shown)
    assert "(..., nv, nv): kg·m²" in shown
    arm = bgdyn.load(SPECS / "scara.yaml")
    of_class: Any = bgdyn.Model.bias
    assert of_class(arm, [0.0] * 4, [0.0] * 4).tolist() == arm.bias([0.0] * 4, [0.0] * 4).tolist()


@pytest.mark.parametrize("file", FILES)
def test_a_model_lists_what_it_has(file: str) -> None:
    model = bgdyn.load(SPECS / f"{file}.yaml")
    assert set(model.methods) <= set(dir(model))
    for name in dir(model):
        assert hasattr(model, name), name
    assert ("reactions" in dir(model)) == hasattr(model, "reactions") == (file != "scara")


def test_names_of_the_rows_of_loads() -> None:
    bars = bgdyn.load(SPECS / "loops" / "five_bar.yaml")
    assert bars.link_names == ("proximal1", "distal1", "proximal2", "distal2")
    assert bars.reaction_names == ("tip_pin",) and bars.actuated_names == ()


def test_the_version() -> None:
    text = (SPECS.parent / "bgdyn-python" / "Cargo.toml").read_text()
    assert f'\nversion = "{bgdyn.__version__}"\n' in text
