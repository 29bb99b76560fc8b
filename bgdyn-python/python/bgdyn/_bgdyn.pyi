"""The compiled part of the package."""

import os
from collections.abc import Mapping, Sequence
from inspect import Signature
from typing import Any, Literal, overload

import numpy as np
from typing_extensions import Self
from numpy.typing import NDArray

from ._method_types import (
    _Q,
    _QQd,
    _QQdTau,
    _QV,
    _QVA,
    _QVAAlong,
    _QVAL,
    _QVATau,
    _QVTau,
    _QVTauAlong,
    _QVTauL,
)
from ._methods import MethodOfClass
from ._results import (
    ConstrainedDynamics,
    Curvature,
    ForwardDerivatives,
    InverseDerivatives,
    Pose,
    SecondDerivatives,
    Wrenches,
)

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Values = Array | Sequence[float] | Sequence[Sequence[float]]
"""An array of ``float64``, or numbers in lists. Other arrays are refused."""

__version__: str

def class_methods() -> list[tuple[str, list[str], str]]:
    """Returns name, arguments and text of the methods that the class ``Model`` shows."""

def import_file(path: str | os.PathLike[str]) -> tuple[str, str, list[str]]:
    """Returns text, name and losses of an imported robot."""

class Method:
    """A method of a model, ``arm.pose_tool``: arrays in, arrays out.

    Every argument has the shape ``(n,)``, or ``(..., n)`` for many states; all leading shapes are the same, and
    an argument without one is shared by all states. ``out`` receives the result: an array, or a tuple of arrays
    for results with several. ``threads`` is the number of threads that share the states. With
    ``on_singular="nan"`` singular states are NaN, and the call returns ``(result, mask)``.

    Raises ``TypeError`` for arrays that are not ``float64``, ``ValueError`` for wrong shapes, ``SingularError``
    for the first singular state; ``out`` then contains NaN at all of them.
    """

    @property
    def name(self) -> str:
        """Its name."""
    @property
    def __name__(self) -> str:
        """Its name, as functions have it."""
    @property
    def __signature__(self) -> Signature:
        """Its arguments."""
    @property
    def _documentation(self) -> str: ...
    @property
    def arguments(self) -> tuple[str, ...]:
        """The names of its arguments: q, v, a, tau, qd."""
    @property
    def summary(self) -> str:
        """What it returns."""
    @property
    def units(self) -> str:
        """The SI units of the result."""
    @property
    def formulation(self) -> str:
        """The formulation that computes it."""
    def __call__(
        self,
        *args: Values,
        out: Any = None,
        threads: int = 1,
        on_singular: Literal["raise", "nan"] = "raise",
        **named: Values,
    ) -> Any: ...

class Model:
    """A mechanism with values of its run-time parameters. It does not change; ``bgdyn.load`` makes it.

    ``q`` are positions (nq; rad, m, parts of quaternions x, y, z, w), ``v`` velocities (nv; rad/s, m/s; those of
    planar, spherical and floating joints in link axes), ``a`` accelerations dv/dt, ``tau`` efforts along v (N·m,
    N). Every method takes a leading shape of any rank, see ``Method``.

    Beside the methods below there are ``pose_X``, ``velocity_X``, ``jacobian_world_X`` and
    ``jacobian_dot_v_world_X`` for each X of ``frame_names``, and others of mechanisms with prescribed joints:
    ``methods`` lists all. A pickled model is its text; copies are the model itself.
    """

    def __new__(
        cls,
        text: str,
        name: str,
        shown: str | None = None,
        formulation: str | None = None,
        prefer: str = "operations",
        parameters: dict[str, float] | None = None,
    ) -> Model: ...
    @property
    def name(self) -> str:
        """The name of the mechanism."""
    @property
    def text(self) -> str:
        """The text that it was read from."""
    @property
    def nq(self) -> int:
        """Number of positions."""
    @property
    def nv(self) -> int:
        """Number of velocities."""
    @property
    def joint_names(self) -> tuple[str, ...]:
        """A name for each velocity."""
    @property
    def position_names(self) -> tuple[str, ...]:
        """A name for each position."""
    @property
    def tree_joint_names(self) -> tuple[str, ...]:
        """A name for each velocity of the open tree; without loops those of ``joint_names``."""
    @property
    def constraint_names(self) -> tuple[str, ...]:
        """A name for each row of loops, wheels and knife edges."""
    @property
    def contact_names(self) -> tuple[str, ...]:
        """The names of the pairs that may touch, in the order of the methods of contacts."""
    @property
    def link_names(self) -> tuple[str, ...]:
        """The links, parents before children: the order of ``joint_reactions``."""
    @property
    def reaction_names(self) -> tuple[str, ...]:
        """The loops and contacts, in the order of ``reactions``."""
    @property
    def actuated_names(self) -> tuple[str, ...]:
        """The joints of ``actuated`` in the file."""
    @property
    def frame_names(self) -> tuple[str, ...]:
        """The links and frames that have a pose, a velocity and a Jacobian."""
    @property
    def parameters(self) -> dict[str, float]:
        """The values of the run-time parameters, SI units. Changing the dictionary changes no model."""
    @property
    def methods(self) -> tuple[str, ...]:
        """The names of all methods."""
    @property
    def _warnings(self) -> str: ...
    def with_parameters(self, **parameters: float) -> Model:
        """Returns the model with these values of run-time parameters, SI units. Functions are shared."""
    def operations(self, method: str) -> dict[str, int]:
        """Counts the operations of a method for one state: mul, add, div, sqrt, sincos (pairs), other."""
    @property
    def engine(self) -> Literal["tape"]:
        """The engine that computes the methods: always "tape", lists of operations without a compiler.

        Python has no machine code, which the command makes.
        """
    @overload
    def source(
        self,
        method: str | Sequence[str] | None = None,
        *,
        bundles: Mapping[str, str | Sequence[str]] | None = None,
        backend: Literal["rust"] = "rust",
        options: Mapping[str, str] | None = None,
    ) -> str:
        """Returns the generated code, as ``bgdyn generate`` writes it: the text of a Rust module.

        ``method`` is a name or a list of names, as in ``--methods``; without it the command's choice of methods is
        written. ``bundles`` are several methods as one function each: ``{"control": ["mass_matrix", "bias"]}``.
        ``options`` are those of ``--option``: module, visibility, crate, plain.

        The functions are compared with equation (6) first. Run-time parameters remain parameters, with the file's values
        as defaults. Raises ``ValueError`` with the command's text for an unknown backend, method, bundle or option.
        """
    @overload
    def source(
        self,
        method: str | Sequence[str] | None = None,
        *,
        bundles: Mapping[str, str | Sequence[str]] | None = None,
        backend: Literal["c"],
        options: Mapping[str, str] | None = None,
    ) -> dict[str, str]:
        """Returns the same in C99: texts by the names of their files, ``NAME.h`` and ``NAME.c``.

        ``options`` are prefix, float, sincos, cmake.
        """
    @overload
    def source(
        self,
        method: str | Sequence[str] | None = None,
        *,
        bundles: Mapping[str, str | Sequence[str]] | None = None,
        backend: str,
        options: Mapping[str, str] | None = None,
    ) -> str | dict[str, str]:
        """Returns the text of a backend with one file, or texts by the names of files."""
    def neutral(self) -> Array:
        """Returns q, (nq,), with every coordinate zero and every quaternion (0, 0, 0, 1).

        With loops or wheels it is the start at which they are closed.
        """
    @overload
    def close(
        self,
        q: Values,
        *,
        out: Array | None = None,
        threads: int = 1,
        on_singular: Literal["raise"] = "raise",
    ) -> Array:
        """Returns q, (..., nq), with the dependent positions changed so that all loops close.

        Raises ``SingularError`` if they do not close from here.
        """
    @overload
    def close(
        self, q: Values, *, out: Array | None = None, threads: int = 1, on_singular: Literal["nan"]
    ) -> tuple[Array, Mask]:
        """Returns the positions, NaN where the loops do not close, and where that is."""
    @overload
    def integrate(
        self,
        q: Values,
        dv: Values,
        *,
        out: Array | None = None,
        threads: int = 1,
        on_singular: Literal["raise"] = "raise",
    ) -> Array:
        """Returns q, (..., nq), after the constant velocities ``dv``, (..., nv), for one unit of time.

        Each joint moves by the exponential of its group; quaternions get length 1. Loops are closed on the branch of
        ``q``; wheels and knife edges are followed at constant independent velocities, to fourth order. Raises
        ``SingularError`` where a loop cannot be closed on the way.
        """
    @overload
    def integrate(
        self,
        q: Values,
        dv: Values,
        *,
        out: Array | None = None,
        threads: int = 1,
        on_singular: Literal["nan"],
    ) -> tuple[Array, Mask]:
        """Returns the positions, NaN where a loop cannot be closed, and where that is."""
    def difference(
        self, q1: Values, q0: Values, *, out: Array | None = None, threads: int = 1
    ) -> Array:
        """Returns the displacement, (..., nv), with which ``integrate`` goes from ``q0`` to ``q1``, by the shorter turn."""
    def position_rates(
        self, q: Values, v: Values, *, out: Array | None = None, threads: int = 1
    ) -> Array:
        """Returns q̇ = N(q) v, (..., nq): a displacement changes by R v, a quaternion by ½ q∘ω."""
    def normalize(self, q: Values, *, out: Array | None = None, threads: int = 1) -> Array:
        """Returns q, (..., nq), with every quaternion divided by its length."""
    @overload
    def sample(
        self,
        n: int | tuple[int, ...] | None = None,
        seed: int | np.random.Generator | None = None,
        *,
        threads: int = 1,
        on_singular: Literal["raise"] = "raise",
    ) -> Array:
        """Returns random positions, (n, nq); (nq,) without ``n``.

        Angles are in [−π, π), displacements in [−1, 1) m, orientations evenly distributed. With loops or wheels the
        positions are closed: those for such numbers, or else the last closed ones on the way to them from ``neutral()``.
        ``seed`` is what ``numpy.random.default_rng`` takes.
        """
    @overload
    def sample(
        self,
        n: int | tuple[int, ...] | None = None,
        seed: int | np.random.Generator | None = None,
        *,
        threads: int = 1,
        on_singular: Literal["nan"],
    ) -> tuple[Array, Mask]:
        """Returns the positions, NaN where loops do not close, and where that is."""
    inverse_dynamics: MethodOfClass[_QVA[Array, Array]]
    """The efforts, (..., nv), that produce the accelerations ``a``: N·m, N."""
    forward_dynamics: MethodOfClass[_QVTau[Array, Array]]
    """The accelerations, (..., nv), under the efforts ``tau``: rad/s², m/s²."""
    mass_matrix: MethodOfClass[_Q[Array, Array]]
    """M(q), (..., nv, nv), exactly symmetric: kg·m², kg·m, kg."""
    bias: MethodOfClass[_QV[Array, Array]]
    """The efforts, (..., nv), without M a: N·m, N."""
    gravity: MethodOfClass[_Q[Array, Array]]
    """The efforts, (..., nv), that hold the mechanism at rest: N·m, N."""
    coriolis_matrix: MethodOfClass[_QV[Array, Array]]
    """C(q, v), (..., nv, nv): bias = C v + gravity, and Ṁ − 2C is skew."""
    kinetic_energy: MethodOfClass[_QV[Any, Array]]
    """½ vᵀ M v, an array (...), a number for a single state: J."""
    potential_energy: MethodOfClass[_Q[Any, Array]]
    """The potential energy of gravity, an array (...), a number for a single state: J.

    It is zero with all centres of mass at the world's origin.
    """
    inverse_dynamics_derivatives: MethodOfClass[_QVA[InverseDerivatives, tuple[Array, Array]]]
    """∂τ/∂q (along the tangent) and ∂τ/∂v, (..., nv, nv) each."""
    forward_dynamics_derivatives: MethodOfClass[_QVTau[ForwardDerivatives, tuple[Array, Array, Array]]]
    """∂a/∂q (along the tangent), ∂a/∂v and ∂a/∂τ, (..., nv, nv) each."""
    joint_reactions: MethodOfClass[_QVATau[Wrenches, tuple[Array, Array]]]
    """Force and moment on each link of ``link_names`` through its joint, at the link's origin, in link axes.

    With ``actuated`` in the file, ``tau`` are the efforts of these joints; otherwise it is not an argument.
    """
    drive_efforts: MethodOfClass[_QVA[Array, Array]]
    """With prescribed joints: the efforts of their drives, N·m, N."""
    regressor: MethodOfClass[_QVA[Array, Array]]
    """Y(q, v, a), (..., nv, 10 nb): the efforts are Y π, with ten parameters of each body that moves."""
    base_regressor: MethodOfClass[_QVA[Array, Array]]
    """Y of the base parameters, (..., nv, nbp)."""
    gravity_regressor: MethodOfClass[_Q[Array, Array]]
    """Y(q, 0, 0), (..., nv, 10 nb)."""
    base_gravity_regressor: MethodOfClass[_Q[Array, Array]]
    """Y(q, 0, 0) of the base parameters, (..., nv, nbp)."""
    momentum_regressor: MethodOfClass[_QV[Array, Array]]
    """The momenta M v by the parameters of the bodies, (..., nv, 10 nb)."""
    base_momentum_regressor: MethodOfClass[_QV[Array, Array]]
    """The momenta M v by the base parameters, (..., nv, nbp)."""
    kinetic_energy_regressor: MethodOfClass[_QV[Array, Array]]
    """The kinetic energy by the parameters of the bodies, (..., 10 nb)."""
    potential_energy_regressor: MethodOfClass[_Q[Array, Array]]
    """The potential energy by the parameters of the bodies, (..., 10 nb)."""
    centre_of_mass: MethodOfClass[_Q[Array, Array]]
    """The centre of mass in the world, (..., 3): m."""
    com_jacobian: MethodOfClass[_Q[Array, Array]]
    """Jacobian of the centre of mass, (..., 3, nv): its velocity is J v."""
    centroidal_map: MethodOfClass[_Q[Array, Array]]
    """A_g, (..., 6, nv): the momentum about the centre of mass is A_g v, angular part first; world axes."""
    centroidal_momentum: MethodOfClass[_QV[Array, Array]]
    """The momentum about the centre of mass, (..., 6), angular part first: kg·m²/s, kg·m/s."""
    centroidal_bias: MethodOfClass[_QV[Array, Array]]
    """Its rate where the accelerations are zero, (..., 6): N·m, N."""
    mass_matrix_rate: MethodOfClass[_QV[Array, Array]]
    """The rate of the mass matrix along v, (..., nv, nv)."""
    inverse_mass_matrix: MethodOfClass[_Q[Array, Array]]
    """M⁻¹, (..., nv, nv), exactly symmetric: accelerations by efforts."""
    contact_gaps: MethodOfClass[_Q[Array, Array]]
    """With contacts: the distances of the surfaces, (..., contacts), negative where they overlap: m."""
    contact_frames: MethodOfClass[_Q[Pose, tuple[Array, Array]]]
    """With contacts: axes x, y, n as columns, (..., contacts, 3, 3), and contact points, (..., contacts, 3)."""
    contact_velocity: MethodOfClass[_QV[Array, Array]]
    """With contacts: velocities along x, y and n of each, (..., 3 contacts): m/s."""
    contact_jacobian: MethodOfClass[_Q[Array, Array]]
    """With contacts: J, (..., 3 contacts, nv); the velocities are J v."""
    contact_bias: MethodOfClass[_QV[Array, Array]]
    """With contacts: J̇ v, (..., 3 contacts): m/s²."""
    contact_delassus: MethodOfClass[_Q[Array, Array]]
    """With contacts: G = J M⁻¹ Jᵀ, (..., 3 contacts, 3 contacts), exactly symmetric: 1/kg."""
    contact_response: MethodOfClass[_Q[Array, Array]]
    """With contacts: M⁻¹ Jᵀ, (..., nv, 3 contacts)."""
    inverse_dynamics_along: MethodOfClass[_QVAAlong[Array, Array]]
    """∂τ/∂q dq + ∂τ/∂v dv + M da, (..., nv)."""
    forward_dynamics_along: MethodOfClass[_QVTauAlong[Array, Array]]
    """∂q̈/∂q dq + ∂q̈/∂v dv + M⁻¹ dtau, (..., nv)."""
    inverse_dynamics_adjoint: MethodOfClass[_QVAL[Array, Array]]
    """(∂τ/∂q)ᵀ l, (∂τ/∂v)ᵀ l, M l, (..., 3, nv)."""
    forward_dynamics_adjoint: MethodOfClass[_QVTauL[Array, Array]]
    """(∂q̈/∂q)ᵀ l, (∂q̈/∂v)ᵀ l, M⁻¹ l, (..., 3, nv)."""
    inverse_dynamics_curvature: MethodOfClass[_QVAL[Curvature, tuple[Array, Array, Array, Array]]]
    """Second derivatives of l·τ: by q and q, by q and v, by v and v, by a and q, (..., nv, nv) each."""
    inverse_dynamics_second: MethodOfClass[_QVA[SecondDerivatives, tuple[Array, Array, Array, Array]]]
    """Second derivatives of τ: by q and q, by q and v, by v and v, by a and q, (..., nv, nv, nv) each."""
    parameter_derivatives: MethodOfClass[_QVTau[Array, Array]]
    """∂q̈/∂π_b by base parameters, (..., nv, nbp)."""
    run_time_parameter_derivatives: MethodOfClass[_QVTau[Array, Array]]
    """With run-time parameters: ∂q̈/∂p, (..., nv, number of parameters)."""
    velocity_map: MethodOfClass[_Q[Array, Array]]
    """With loops: S(q), (..., nt, nv); the velocities of the open tree are S v."""
    tree_velocity: MethodOfClass[_QV[Array, Array]]
    """With loops: the velocities of the open tree, (..., nt)."""
    tree_acceleration: MethodOfClass[_QVA[Array, Array]]
    """With loops: the accelerations of the open tree, (..., nt)."""
    constraint_residual: MethodOfClass[_Q[Array, Array]]
    """With loops: by how much they are open, (..., nc): m, rad."""
    constraint_jacobian: MethodOfClass[_Q[Array, Array]]
    """With loops: B(q), (..., nc, nt); B S = 0."""
    constraint_bias: MethodOfClass[_QQd[Array, Array]]
    """With loops: Ḃ q̇, (..., nc), for velocities of the open tree: m/s², rad/s²."""
    closing_step: MethodOfClass[_Q[Array, Array]]
    """With loops: the step of Newton's method that closes them, (..., nt), with the opposite sign: rad, m."""
    project_velocity: MethodOfClass[_QQd[Array, Array]]
    """With loops: the nearest velocities of the open tree, (..., nt), that the rows allow."""
    multipliers: MethodOfClass[_QVA[Array, Array]]
    """With loops: the efforts of the rows, (..., nc): N, N·m."""
    constrained_dynamics: MethodOfClass[_QQdTau[ConstrainedDynamics, tuple[Array, Array]]]
    """With loops: accelerations and multipliers under efforts on all joints of the open tree."""
    reactions: MethodOfClass[_QVTau[Wrenches, tuple[Array, Array]]]
    """With loops or wheels: force and moment at each of ``reaction_names``."""
    def __getattr__(self, name: str) -> Method:
        """Returns a method that not every model has: those of sites, for each X of ``frame_names``.

        ``pose_X(q)`` is a ``Pose``, ``velocity_X(q, v)`` and ``jacobian_dot_v_world_X(q, v)`` are arrays (..., 6),
        ``jacobian_world_X(q)`` is (..., 6, nv), the angular part first. A checker cannot know X: what the call
        returns is ``Any``.
        """
    def _method(self, name: str) -> Method: ...
    def __copy__(self) -> Model: ...
    def __deepcopy__(self, _memo: object) -> Model: ...
    def __dir__(self) -> list[str]: ...
    def __hash__(self) -> int: ...
    def __eq__(self, other: object, /) -> bool: ...
    def _repr_html_(self) -> str: ...

class Scene:
    def __new__(
        cls,
        text: str,
        name: str,
        shown: str | os.PathLike[str] | None = None,
        mechanism: str | None = None,
    ) -> Self: ...
    @property
    def name(self) -> str:
        """The name of the scene."""
    @property
    def text(self) -> str:
        """The text that it was read from."""
    @property
    def mechanism_text(self) -> str:
        """The text of its mechanism."""
    @property
    def parameters(self) -> dict[str, float]:
        """The values of the run-time parameters in the files, SI units."""
    @property
    def columns(self) -> tuple[str, ...]:
        """The names of the quantities that a run records."""
    @property
    def units(self) -> dict[str, str]:
        """Their SI units by name; empty for a pure number."""
    @property
    def engine(self) -> Literal["tape"]:
        """The engine that computes runs: always "tape", lists of operations without a compiler.

        Python has no machine code, which the command makes.
        """
    @property
    def _warnings(self) -> str: ...
    def _simulate(
        self,
        parameters: list[tuple[str, float]],
        initial: list[tuple[str, float]],
        settings: tuple[float | None, float | None, float | None, int],
    ) -> Mapping[str, Any]: ...
    def _check_runs(
        self, names: list[str], settings: tuple[float | None, float | None, float | None, int]
    ) -> list[bool]: ...
    def _summaries(
        self,
        parameters: list[str],
        initial: list[str],
        values: Array,
        settings: tuple[float | None, float | None, float | None, int],
    ) -> tuple[Array, list[tuple[int, str]]]: ...
    def __hash__(self) -> int: ...
    def __eq__(self, other: object, /) -> bool: ...
