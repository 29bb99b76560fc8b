"""The results that consist of several arrays. Each array has the leading shape of the arguments first."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Pose(NamedTuple):
    """Position and orientation of a link or frame in the world."""

    rotation: NDArray[np.float64]
    """(..., 3, 3): its columns are the frame's axes in the world's."""
    translation: NDArray[np.float64]
    """(..., 3): its origin in world axes, m."""


class InverseDerivatives(NamedTuple):
    """Derivatives of joint efforts; row j is effort j. Those by q are along the tangent."""

    q: NDArray[np.float64]
    """(..., nv, nv): efforts per rad or m; with wheels or knife edges (..., nv, nt), by each velocity of the open tree."""
    v: NDArray[np.float64]
    """(..., nv, nv): efforts per rad/s or m/s."""


class ForwardDerivatives(NamedTuple):
    """Derivatives of accelerations; row j is acceleration j. Those by q are along the tangent."""

    q: NDArray[np.float64]
    """(..., nv, nv): accelerations per rad or m; with wheels or knife edges (..., nv, nt), likewise."""
    v: NDArray[np.float64]
    """(..., nv, nv): accelerations per rad/s or m/s."""
    tau: NDArray[np.float64]
    """(..., nv, nv): accelerations per N·m or N, the inverse of the mass matrix."""


class Curvature(NamedTuple):
    """Second derivatives of l·τ. Those by q are along the tangent: row i, column j is the derivative along v_j of that
    along v_i."""

    qq: NDArray[np.float64]
    """(..., nv, nv): by q and q."""
    qv: NDArray[np.float64]
    """(..., nv, nv): by q (rows) and v (columns)."""
    vv: NDArray[np.float64]
    """(..., nv, nv): by v and v."""
    aq: NDArray[np.float64]
    """(..., nv, nv): by a (rows) and q (columns)."""


class SecondDerivatives(NamedTuple):
    """Second derivatives of joint efforts, for each a matrix. Those by q are along the tangent: row i, column j is the
    derivative along v_j of that along v_i."""

    qq: NDArray[np.float64]
    """(..., nv, nv, nv): by q and q."""
    qv: NDArray[np.float64]
    """(..., nv, nv, nv): by q (rows) and v (columns)."""
    vv: NDArray[np.float64]
    """(..., nv, nv, nv): by v and v."""
    aq: NDArray[np.float64]
    """(..., nv, nv, nv): by a (rows) and q (columns), ∂M/∂q."""


class ConstrainedDynamics(NamedTuple):
    """Accelerations of the open tree and efforts of the rows."""

    accelerations: NDArray[np.float64]
    """(..., nt): as in ``tree_joint_names``, rad/s² or m/s²."""
    multipliers: NDArray[np.float64]
    """(..., nc): as in ``constraint_names``, N or N·m."""


class Wrenches(NamedTuple):
    """Forces and moments, one for each loop or contact, or for each link."""

    force: NDArray[np.float64]
    """(..., n, 3), N."""
    moment: NDArray[np.float64]
    """(..., n, 3), N·m."""
