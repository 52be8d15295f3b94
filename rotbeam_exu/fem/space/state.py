"""The state of a blade in space: a planar one, and a small deflection out of the plane."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from analytic import BeamState
from analytic.arrays import FloatArray


@dataclass(frozen=True, kw_only=True)
class SpaceState(BeamState):
    """State of the blade at material points in the frame of the clamp: r = (x + u, v, w).

    Sections are turned about their tangent by nothing, in motion as at rest.

    Attributes
    ----------
    w : ndarray (points,)
        Displacement along the axis of rotation [m].
    w_slope : ndarray (points,)
        Its derivative to x, w' [-].
    w_dot, w_slope_dot : ndarray (points,)
        Their rates [m/s, 1/s].
    """

    w: FloatArray
    w_slope: FloatArray
    w_dot: FloatArray
    w_slope_dot: FloatArray


def kicked(state: BeamState | None, x: FloatArray, length: float, kick: float) -> SpaceState:
    """Return a planar state, or the straight blade at rest, deflected by w = kick L (x/L)².

    That parabola is no mode: it has a share of each, so that whatever grows has something to grow
    from.
    """
    zero, at = np.zeros(x.size), x / length
    names = [field.name for field in fields(BeamState)]
    planar: dict[str, Any] = (
        dict.fromkeys(names, zero)
        if state is None
        else {name: getattr(state, name) for name in names}
    )
    return SpaceState(
        **planar, w=kick * length * at**2, w_slope=2.0 * kick * at, w_dot=zero, w_slope_dot=zero
    )
