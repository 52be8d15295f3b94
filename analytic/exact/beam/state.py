"""The state of the exact beam at material points, to start a code from."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any, NamedTuple

import numpy as np

from ...arrays import FloatArray


@dataclass(frozen=True, kw_only=True)
class BeamState:
    """State of the beam at material points, in the rotating frame: r = (x + u, v, w); SI units.

    Attributes
    ----------
    u, v : ndarray (points,)
        Displacements along and across the undeformed axis [m].
    u_slope, v_slope : ndarray (points,)
        Their derivatives to x, u' and v' [-].
    u_dot, v_dot, u_slope_dot, v_slope_dot : ndarray (points,)
        The rates of all four as seen in the rotating frame [m/s, 1/s].
    shear_angle, shear_angle_dot : ndarray (points,) or float
        How far the sections lag behind the tangent [rad], and its rate [rad/s]; 0 without shear.
    w, w_slope, w_dot, w_slope_dot : ndarray (points,) or float
        Displacement out of the plane [m], its derivative to x, and the rates of both; 0 in the
        plane. Sections are turned about their tangent by nothing.

    Examples
    --------
    >>> from analytic import Beam, periodic_orbits
    >>> orbit = periodic_orbits(Beam.reference(), omega=6.0, amplitudes=[0.3])
    >>> state = orbit.state(0, [4.0, 8.0], phase=1.0)
    >>> print(state.u.round(4), state.v.round(4))
    [-0.094  -0.2838] [0.8022 2.0198]
    """

    u: FloatArray
    v: FloatArray
    u_slope: FloatArray
    v_slope: FloatArray
    u_dot: FloatArray
    v_dot: FloatArray
    u_slope_dot: FloatArray
    v_slope_dot: FloatArray
    shear_angle: FloatArray | float = 0.0
    shear_angle_dot: FloatArray | float = 0.0
    w: FloatArray | float = 0.0
    w_slope: FloatArray | float = 0.0
    w_dot: FloatArray | float = 0.0
    w_slope_dot: FloatArray | float = 0.0


def straight_state(x: FloatArray, **moving: FloatArray) -> BeamState:
    """Return the state at `x` of a straight blade at rest, but for the parts that are given."""
    flat = dict.fromkeys((one.name for one in fields(BeamState)), np.zeros_like(x))
    return BeamState(**flat | moving)


class Driven(NamedTuple):
    """Rotation of the clamp and loads, without units, as the equations of motion take them.

    Attributes
    ----------
    rate, rate_dot : float or ndarray (samples,)
        w and its rate.
    push : ndarray or None
        Load beyond each Gauss point, as the discretization's `push` returns it.
    """

    rate: Any
    rate_dot: Any = 0.0
    push: Any = None


def flap_of_kick(x: FloatArray, derivative: int = 0) -> FloatArray:
    """Return x²(6 - 4x + x²)/3 of x/L, the flap of a kick over that of the tip, or a derivative.

    The shape that a uniform load gives a cantilever: its end has neither moment nor force.
    """
    found: FloatArray = np.polynomial.Polynomial([0.0, 0.0, 2.0, -4.0 / 3.0, 1.0 / 3.0]).deriv(
        derivative
    )(x)
    return found


def kicked_state(length: float, speed: float, x: FloatArray) -> BeamState:
    """Return the state at `x` [m] of a straight blade whose tip is kicked out of the plane."""
    slope = speed / length * flap_of_kick(x / length, 1)
    return straight_state(x, w_dot=speed * flap_of_kick(x / length), w_slope_dot=slope)
