"""Rigid-body dynamics: a mechanism in YAML, NumPy arrays in and out.

    >>> import bgdyn, numpy
    >>> arm = bgdyn.load("scara.yaml")
    >>> tau = arm.inverse_dynamics(q, v, a)

SI units and radians throughout, world axes with z up. Arrays are ``float64``; a leading shape of any rank
means many states. The page ``docs/python.md`` of the repository describes the package.
"""

from ._bgdyn import Method, Model, __version__
from ._errors import LossWarning, SingularError, SpecError, SpecWarning
from ._load import load
from ._methods import document
from ._results import (
    ConstrainedDynamics,
    Curvature,
    ForwardDerivatives,
    InverseDerivatives,
    Pose,
    SecondDerivatives,
    Wrenches,
)
from ._scene import EnergyEntry, Event, Run, Scene
from ._sweep import Sweep

__all__ = [
    "ConstrainedDynamics",
    "Curvature",
    "EnergyEntry",
    "Event",
    "ForwardDerivatives",
    "InverseDerivatives",
    "LossWarning",
    "Method",
    "Model",
    "Pose",
    "Run",
    "Scene",
    "SecondDerivatives",
    "SingularError",
    "SpecError",
    "SpecWarning",
    "Sweep",
    "Wrenches",
    "__version__",
    "load",
]

document()
del document
