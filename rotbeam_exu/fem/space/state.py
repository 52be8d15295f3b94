"""The state of a blade in space: a planar one, and a small deflection out of the plane."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import cumulative_simpson

from analytic import BeamState
from analytic.arrays import FloatArray

_BETWEEN = 8
"""Pieces of an element over which the kick is integrated."""


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


def _at_rest(x: FloatArray) -> BeamState:
    zero = np.zeros(x.size)
    return BeamState(
        u=zero, v=zero, u_slope=zero, v_slope=zero,
        u_dot=zero, v_dot=zero, u_slope_dot=zero, v_slope_dot=zero,
    )  # fmt: skip


def kicked(
    planar: Callable[[FloatArray], BeamState] | None, x: FloatArray, length: float, kick: float
) -> SpaceState:
    """Return a planar state, or the straight blade at rest, bent out of its plane by an arc.

    Its tangents are turned out of the plane by 2 kick x/L, and w = kick L (x/L)² of small kicks.
    An arc is no mode: it has a share of each, so that whatever grows has something to grow from.
    It bends and does not stretch, which of a slender blade would take all its energy.

    Parameters
    ----------
    planar : callable, optional
        State of points, as in `simulate`.
    x : ndarray (nodes,)
        From 0 to the length, evenly [m].
    length : float
        [m].
    kick : float
    """
    fine = np.linspace(0.0, length, _BETWEEN * (x.size - 1) + 1)
    zero = np.zeros(fine.size)
    state = (planar or _at_rest)(fine)
    tilt = 2.0 * kick * fine / length
    # What is added to the slopes (u', v', w') turns the tangent, and leaves it as long as it was.
    tangent = np.stack((1.0 + state.u_slope, state.v_slope))
    added = np.vstack((tangent * (np.cos(tilt) - 1.0), np.hypot(*tangent) * np.sin(tilt)))
    (u_slope, v_slope, w_slope), (u, v, w) = added, cumulative_simpson(added, x=fine, initial=0.0)
    bent = vars(state) | {
        "u": state.u + u, "v": state.v + v, "w": w,
        "u_slope": state.u_slope + u_slope, "v_slope": state.v_slope + v_slope,
        "w_slope": w_slope, "w_dot": zero, "w_slope_dot": zero,
    }  # fmt: skip
    nodes = slice(None, None, _BETWEEN)
    return SpaceState(**{name: np.add(value, zero)[nodes] for name, value in bent.items()})
