"""Forced response of the exact blade: damped, loaded, in steady rotation."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from ...arrays import FloatArray
from ...beam import AnyBlade, warn_if_rpm
from ...input_checks import finite_values, rotation_speed, whole_number
from ...loads import Gravity, HarmonicLoad
from ...methods.orbit_curve import Marked, ResponseNotFollowedError, response_curve
from ...theory import BERNOULLI_EULER, Theory
from ...threads import one_thread
from ..beam.steady import steady_rate
from ..linear.modes import linear_modes, resolved_model
from .forced_orbits import ForcedResponse, ResponseNotReachedError
from .loading import DrivenBeam, unit_load

_MOST_HARMONICS = 100  # dense matrices of so many times twice the functions
_LARGEST = 0.95  # |q|/L to which a response is followed


@one_thread
def forced_response(
    beam: AnyBlade,
    omega: float,
    load: HarmonicLoad,
    frequencies: Sequence[float] | FloatArray,
    *,
    theory: Theory = BERNOULLI_EULER,
    functions: int = 10,
    harmonics: int = 4,
) -> ForcedResponse:
    """Return the periodic response of the damped blade to a load, over the load's frequency.

    Harmonic balance with a full Fourier series, followed by arclength through folds, so that
    unstable responses between are found as well. Harmonics and functions grow until what they
    leave out changes the amplitude by about 1e-6. Curves that are not connected to the response at
    the first frequency (isolas) are not found.

    Parameters
    ----------
    beam : Beam or Blade
        With damping: see `Blade.with_damping`.
    omega : float
        Rotation speed ω [rad/s].
    load : SpeedRipple, TipForce or DistributedForce
        Without a frequency.
    frequencies : sequence of float
        Drive frequencies ν [rad/s], ascending: the first and the last are the ends of the curve,
        those between are among its points, wherever it passes them.
    theory : Theory
        Extension, shear and rotary inertia.
    functions, harmonics : int
        Least number of functions for the tangent's angle, and of harmonics.

    Raises
    ------
    ValueError, TypeError
        If an input is refused; if the blade is undamped and the frequencies hold a resonance.
    ResponseNotReachedError
        If the curve cannot be followed to its end; its `.response` holds what was found.

    Examples
    --------
    >>> from analytic import Beam, Damping, TipForce, forced_response
    >>> blade = Beam.reference().with_damping(Damping(external=0.1))
    >>> push = TipForce(amplitude=0.5)
    >>> found = forced_response(blade, 6.0, push, frequencies=[3.4, 3.7, 4.0], functions=8)
    >>> for peak in found.peaks:
    ...     print(f"{peak.amplitude:.4f} L at {peak.frequency:.4f} rad/s")
    0.0769 L at 3.7123 rad/s
    """
    if isinstance(load, Gravity):
        raise TypeError("gravity goes around once a turn, at ω itself: take gravity_response")
    unit = unit_load(beam, load)
    if not isinstance(load, HarmonicLoad):
        raise TypeError(f"forced_response varies the frequency of a load, and {load} has none")
    if load.frequency is not None:
        raise ValueError(
            f"the load has a frequency, {load.frequency:g} rad/s, and forced_response varies it: "
            "leave it out of the load, and give it among the frequencies"
        )
    omega, asked = rotation_speed(omega), _ascending("frequencies", frequencies)
    warn_if_rpm(beam, omega)
    if not any(beam.unit.damping):
        _require_no_resonance(beam, omega, asked)
    model = resolved_model(beam, 1, theory, functions)
    system = DrivenBeam(model, steady_rate(beam, omega, model), unit)
    return _followed(beam, load, theory, system, asked, harmonics)


@one_thread
def gravity_response(
    beam: AnyBlade,
    omegas: Sequence[float] | FloatArray,
    gravity: float = 9.81,
    *,
    theory: Theory = BERNOULLI_EULER,
    functions: int = 10,
    harmonics: int = 4,
) -> ForcedResponse:
    """Return the periodic response of the damped blade to its weight, over the rotation speed.

    The plane of rotation stands vertical, so that the weight goes around once a turn: the drive's
    frequency is ω.

    Parameters
    ----------
    beam : Beam or Blade
        With damping.
    omegas : sequence of float
        Rotation speeds [rad/s], ascending and above 0, as `frequencies` of `forced_response`.
    gravity : float
        g [m/s²].
    theory, functions, harmonics
        As for `forced_response`.

    Raises
    ------
    ValueError, ResponseNotReachedError
        As `forced_response` does.

    Examples
    --------
    >>> from analytic import Beam, Damping, gravity_response
    >>> blade = Beam.reference().with_damping(Damping(external=0.3))
    >>> found = gravity_response(blade, omegas=[4.5, 5.0, 5.5], functions=8)
    >>> print(found.amplitude[found.at(5.0)].round(4))
    [0.1355]
    """
    load, asked = Gravity(gravity), _ascending("omegas", omegas)
    for omega in asked.tolist():
        rotation_speed(omega, "omegas")
    model = resolved_model(beam, 1, theory, functions)
    steady_rate(beam, float(asked[-1]), model)
    if not any(beam.unit.damping):
        slow, fast = (linear_modes(beam, w, 1).frequencies[0] / w for w in asked[[0, -1]].tolist())
        if math.floor(slow) > math.floor(fast):
            raise ValueError(
                f"without damping the response has no end at resonance, and the first mode meets "
                f"{math.floor(slow)} times the speed in between: take "
                "beam.with_damping(Damping(...))"
            )
    system = DrivenBeam(model, None, unit_load(beam, load))
    return _followed(beam, load, theory, system, asked, harmonics)


def _ascending(name: str, values: Any) -> FloatArray:
    asked = finite_values(name, values, "rad/s")
    if asked.size < 2 or asked[0] <= 0.0 or np.any(np.diff(asked) <= 0.0):
        raise ValueError(
            f"{name} must be two or more, above 0 and ascending [rad/s], got {asked.tolist()}: "
            "the first and the last are the ends of the curve"
        )
    return asked


def _require_no_resonance(beam: AnyBlade, omega: float, asked: FloatArray) -> None:
    for mode, frequency in enumerate(linear_modes(beam, omega).frequencies, start=1):
        if asked[0] <= frequency <= asked[-1]:
            raise ValueError(
                f"without damping the response has no end at resonance, and mode {mode} is at "
                f"{frequency:.6g} rad/s: take beam.with_damping(Damping(...)), or periodic_orbits "
                "for the backbone on which it ends"
            )


def _followed(
    beam: AnyBlade,
    load: HarmonicLoad | Gravity,
    theory: Theory,
    system: DrivenBeam,
    asked: FloatArray,
    harmonics: int,
) -> ForcedResponse:
    least = whole_number("harmonics", harmonics, most=_MOST_HARMONICS)
    frequencies = asked / beam.frequency_scale
    try:
        found, failed = response_curve(system, frequencies, _LARGEST, least), None
    except ResponseNotFollowedError as reason:
        found, failed = reason.found, reason
    response = _packed(beam, load, theory, found) if found else None
    if failed is not None:
        last = f" at {asked[0]:g} rad/s"
        if response is not None:
            nu, a = response.frequency[-1], response.amplitude[-1]
            last = f" after {nu:.6g} rad/s, where |q|/L is {a:.4g}"
        remedy = failed.remedy or "take more damping or a smaller load"
        raise ResponseNotReachedError(
            f"the response to {load} was not found{last}: {failed}; {remedy}", response
        )
    assert response is not None
    return response


def _packed(
    beam: AnyBlade, load: HarmonicLoad | Gravity, theory: Theory, found: list[Marked]
) -> ForcedResponse:
    orbits, marks = zip(*found, strict=True)
    count = max(orbit.harmonics for orbit in orbits)
    harmonics = [np.pad(o.gauge_harmonics, (0, count - o.harmonics)) for o in orbits]
    per_second = beam.frequency_scale
    return ForcedResponse(
        beam=beam,
        load=load,
        theory=theory,
        omega=per_second * np.array([o.system.speed(o.frequency) for o in orbits]),
        frequency=per_second * np.array([orbit.frequency for orbit in orbits]),
        amplitude=np.array([orbit.amplitude for orbit in orbits]),
        harmonics=np.array(harmonics),
        residual=np.array([orbit.residual for orbit in orbits]),
        marks=marks,
        _orbits=orbits,
    )
