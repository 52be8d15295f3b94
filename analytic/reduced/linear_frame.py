"""The blade that is linear in the wrong place: small deflections in the frame of the clamp.

Nothing in the stiffness K of a linear floating frame knows of the tension by rotation, so that

    M q̈ + (K - c²θ̇² M) q = -cΓ θ̈,      Γ = ∫(R + x) φ dm,

is stable only up to the first natural frequency at rest: beyond, the inertia -θ̇² M wins. Bending
brings a point nearer to the axis, by ½∫v'². The foreshortening is of second order in the
deflection, but the centrifugal force N = θ̇² ∫(R + x) dm acts through it. With θ̇² G = ∫N φ_i'φ_j'
dx added to K the same model has the blade's own frequencies.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import FloatArray
from ..blade import Blade
from ..blade_checks import require_planar, require_undamped, warn_if_rpm
from ..input_checks import flag, points_of_beam, times_from_rest
from ..lazily import integrate
from ..motion import SpeedChange, require_ramp
from ..shape_functions import blade_functions
from ..threads import one_thread

_FUNCTIONS, _MODES = 28, 5
_TOLERANCE = 1e-8  # of a step


@dataclass(frozen=True, kw_only=True)
class LinearResponse:
    """Response of the linear model to a spin-up; made by `linear_response`.

    Attributes
    ----------
    beam, spin_up, foreshortening : as given
    time, q, points, axis : ndarray
        As of `SpinUpResponse`. A linear model moves the points across only: it grows longer as it
        bends.
    """

    blade: Blade
    spin_up: SpeedChange
    foreshortening: bool
    time: FloatArray
    q: FloatArray = field(repr=False)
    points: FloatArray = field(repr=False)
    axis: FloatArray = field(repr=False)


@one_thread
def linear_response(
    blade: Blade,
    spin_up: SpeedChange,
    times: float | ArrayLike,
    *,
    foreshortening: bool = False,
    points: ArrayLike = (),
) -> LinearResponse:
    """Return the response of one linear floating frame, clamped to the root, at rest before t = 0.

    Linear theory of the inextensible, undamped blade, in its first five modes. Without the
    foreshortening it diverges above the first natural frequency at rest, ω0, at the rate
    √(ω² - ω0²) in the plane of rotation; `spin_up_response` has the true motion.

    Parameters
    ----------
    beam, spin_up, times, points
        As for `spin_up_response`.
    foreshortening : bool
        Give the model the term that it lacks.

    Raises
    ------
    ValueError
        If the times are not ascending from 0 on, a point is beyond the blade, or it is damped.
    RuntimeError
        If the deflection grows beyond all numbers before the last time.

    Examples
    --------
    >>> from analytic import Beam, SpinUp, linear_response
    >>> spin_up = SpinUp(omega=4.0, ramp_time=3.0)
    >>> for term in (False, True):
    ...     q = linear_response(Beam.reference(), spin_up, [5.0], foreshortening=term).q
    ...     print(f"{q[0]:.4g} m")
    -2.177e+04 m
    1.673 m
    """
    require_ramp(spin_up)
    foreshortening = flag("foreshortening", foreshortening)
    require_planar(blade)
    require_undamped(blade, "the linear frame has no damping")
    warn_if_rpm(blade, spin_up.fastest)
    time = times_from_rest(times)
    along = points_of_beam("points", points, blade.length)
    unit, scale = blade.unit, blade.frequency_scale
    of = blade_functions(unit, _FUNCTIONS)
    softening = -(unit.setting**2) * (of.mass - of.turning)
    turned = of.centrifugal if foreshortening else softening
    # The modes after the ramp, or at rest: more would cost shorter steps, for 5e-4 of q.
    _, modes = of.modes(spin_up.fastest / scale * foreshortening, _MODES)
    bending, rotation = (modes.T @ part @ modes for part in (of.bending, turned))
    lever = unit.setting * of.euler @ modes

    def derivative(t: float, state: FloatArray) -> FloatArray:
        """Return what solves q̈ + (bending + θ̇² rotation) q = -θ̈ lever, times in 1/√(EI/mL³)."""
        rate, acceleration = spin_up.rate(t / scale) / scale, spin_up.acceleration(t / scale)
        q, q_dot = state.reshape(2, -1)
        force = -(acceleration / scale**2) * lever - (bending + rate**2 * rotation) @ q
        return np.concatenate((q_dot, force))

    instants, back = np.unique(scale * time, return_inverse=True)
    with np.errstate(over="ignore", invalid="ignore"):
        solution = integrate.solve_ivp(
            derivative, (0.0, instants[-1] or 1.0), np.zeros(2 * _MODES), t_eval=instants,
            method="DOP853", rtol=_TOLERANCE, atol=1e-3 * _TOLERANCE,
        )  # fmt: skip
    if not solution.success or not np.isfinite(solution.y).all():
        raise RuntimeError(
            f"the linear model's deflection grows beyond all numbers before t = {time[-1]:g} s: "
            "ask for earlier times"
        )
    coordinates = solution.y[:_MODES, back].T
    across = coordinates @ (of.across.twice(along) @ modes).T
    places = along, unit.setting * across, math.sin(unit.angle) * across
    axis = np.stack(np.broadcast_arrays(*places), axis=-1)
    return LinearResponse(
        blade=blade, spin_up=spin_up, foreshortening=foreshortening, time=time,
        q=blade.length * coordinates @ (of.tip @ modes), points=blade.length * along,
        axis=blade.length * axis,
    )  # fmt: skip
