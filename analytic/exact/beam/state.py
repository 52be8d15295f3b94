"""The state of the exact beam at material points, to start a code from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import FloatArray
from ...beam import AnyBlade
from ...input_checks import finite_number, points_of_beam
from ...methods.orbit import Orbit
from ...theory import BERNOULLI_EULER
from .continuum import Continuum
from .discretization import blade_continuum
from .steady import steady_rotation


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


def stretched_state(beam: AnyBlade, omega: float, x: ArrayLike) -> BeamState:
    """Return the state of the beam that turns at `omega` [rad/s] and does not swing."""
    steady = steady_rotation(beam, omega, blade_continuum(beam, BERNOULLI_EULER, 20, 10))
    return _state(beam, steady.model, steady.equilibrium, np.zeros(steady.size), x)


def orbit_state(
    beam: AnyBlade,
    orbit: Orbit[Any],
    x: ArrayLike,
    phase: float,
) -> BeamState:
    """Return the state of an orbit of `beam` at the points `x` [m] and the `phase` [rad]."""
    phases = np.array([finite_number("phase", phase, "rad")])
    (q,), (q_dot,), _ = orbit.coordinates(phases)
    return _state(beam, orbit.system.model, q, q_dot, x)


def _state(
    beam: AnyBlade, model: Continuum, q: FloatArray, q_dot: FloatArray, x: ArrayLike
) -> BeamState:
    at, length, per_second = points_of_beam("x", x, beam.length), beam.length, beam.frequency_scale
    slope, slope_rate = model.slope(q, at), per_second * model.slope_rate(q, q_dot, at)
    z = length * model.integrated(model.slope(q), at)
    z_dot = length * per_second * model.integrated(model.slope_rate(q, q_dot), at)
    shear, shear_rate = model.shear_angle(q, q_dot, at)
    return BeamState(
        u=z.real - length * at,
        v=z.imag,
        u_slope=slope.real - 1.0,
        v_slope=slope.imag,
        u_dot=z_dot.real,
        v_dot=z_dot.imag,
        u_slope_dot=slope_rate.real,
        v_slope_dot=slope_rate.imag,
        shear_angle=shear,
        shear_angle_dot=per_second * shear_rate,
    )
