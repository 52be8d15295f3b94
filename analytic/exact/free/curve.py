"""The exact backbone at the price of a formula: a series in a² through a few exact orbits.

Frequency and harmonics of an orbit are analytic functions of a², a the peak, up to the next
internal resonance. So a polynomial through the Chebyshev points of a², the linear mode among them,
converges geometrically: with ten of them ω_NL/ω_n keeps 1e-10 where no resonance is near.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.polynomial import Chebyshev

from ...arrays import FloatArray
from ...beam import AnyBlade, require_undamped, warn_if_rpm
from ...input_checks import peak_deflection, positive, rotation_speed, whole_number
from ...methods.continuation import MOST_FUNCTIONS, THOROUGH, Care
from ...methods.harmonic_balance import frequency_change
from ...methods.newton import NoOrbitError
from ...theory import BERNOULLI_EULER, Theory
from ...threads import one_thread
from ...warning import warn
from ..beam.discretization import finer_model
from ..beam.steady import BeamOrbit
from ..linear.modes import resolved_model
from .backbone_series import BackboneCurve
from .branch import AmplitudeNotReachedError, Branch, branch_of
from .internal_resonance import nearest_resonance

_SHORTER = 0.93  # of the range, where orbits end
_SHORTEST = 0.1  # of what was asked for
_LARGEST_DRIFT = 5e-9  # of the Jacobi integral: ω_NL then keeps 1e-10, the first harmonic 2e-9
_MOST_HARMONICS = 40  # those of orbits up to 0.8; near a resonance they need more
_MOST_COEFFICIENTS = 1000  # an orbit for each
_APART = 0.08  # orbits at which resonances are looked for


@one_thread
def backbone_curve(
    beam: AnyBlade,
    omega: float,
    up_to: float = 0.6,
    mode: int = 1,
    *,
    coefficients: int = 10,
    tolerance: float = 1e-8,
    theory: Theory = BERNOULLI_EULER,
    functions: int = 16,
) -> BackboneCurve:
    """Return the exact backbone of a mode as a Chebyshev series in a².

    Through `coefficients` - 1 orbits and the linear mode, on the extrema of Chebyshev's polynomials
    in a². Where the series does not converge to the tolerance, near an internal resonance, or the
    orbits end, its range is made shorter, and `holds_up_to` says how far it goes. Resonances so
    narrow that no orbit shows them are passed unseen: `backbone_branch` lists all.

    Parameters
    ----------
    beam : Beam or Blade
        Without damping.
    omega : float
        Rotation speed ω [rad/s].
    up_to : float
        Largest peak |q|/L asked for, below 1.
    mode, theory, functions
        As for `periodic_orbits`.
    coefficients : int
        Of the series; at least 5.
    tolerance : float
        Of ω_NL/ω_n and of the first harmonic over the peak; at least 1e-10.

    Raises
    ------
    ValueError
        If an argument is refused.
    AmplitudeNotReachedError
        If no orbit grows out of the mode, or no range of a tenth of what is asked for is held.

    Warns
    -----
    RotbeamWarning
        If the series holds less far than asked, with the nearest internal resonance.

    Examples
    --------
    >>> from analytic import Beam, backbone_curve
    >>> curve = backbone_curve(Beam.reference(), omega=6.0)
    >>> round(float(curve.frequency(0.3)), 6), round(curve.lambda_omega, 6)
    (3.723567, 0.019669)
    """
    omega, mode = rotation_speed(omega), whole_number("mode", mode)
    up_to = peak_deflection("up_to", up_to)
    count = whole_number("coefficients", coefficients, least=5, most=_MOST_COEFFICIENTS)
    if positive("tolerance", tolerance) < 1e-10:
        raise ValueError(
            f"tolerance must be at least 1e-10, got {tolerance:g}: orbits keep no more"
        )
    warn_if_rpm(beam, omega)
    require_undamped(beam, "a damped blade has no free periodic orbits")
    model = resolved_model(beam, mode, theory, functions)
    while True:
        branch = branch_of(beam, omega, mode, model, care_for(tolerance))
        curve = fitted_curve(branch, up_to, count, tolerance)
        largest = [o for o in branch.path.nodes if o.amplitude <= curve.holds_up_to][-1]
        model = finer_model(largest.system.model)
        change = frequency_change(largest, branch.path.tangent)
        if change <= tolerance or model.bending > MOST_FUNCTIONS:
            break
    curve = replace(curve, error=max(curve.error, change))
    if curve.holds_up_to < up_to:
        below = _apart([o for o in branch.path.nodes if o.amplitude <= curve.holds_up_to])
        warn(
            f"the backbone at omega = {omega:g} rad/s has a series of {count} coefficients that "
            f"holds to {tolerance:g} up to a = {curve.holds_up_to:.4g} only, not up to {up_to:g}"
            f"{nearest_resonance(below, branch.modes, mode)}; ask for more coefficients, or take "
            f"backbone_branch"
        )
    return curve


def care_for(tolerance: float) -> Care:
    """Return with how much care orbits are sought for a series of this tolerance."""
    drift = max(THOROUGH.drift, min(_LARGEST_DRIFT, 0.5 * tolerance))
    return Care(drift=drift, harmonics=_MOST_HARMONICS, halvings=1)


def fitted_curve(branch: Branch, up_to: float, count: int, tolerance: float) -> BackboneCurve:
    """Return the series of a branch, on as much of the range as it holds for."""
    linear, top = float(branch.modes[branch.mode - 1]), up_to
    while top > _SHORTEST * up_to:
        try:
            fitted = _fitted(branch, top, count)
        except NoOrbitError:
            top = _SHORTER * min(top, branch.path.nodes[-1].amplitude)
            continue
        if fitted.error <= tolerance:
            return BackboneCurve(
                beam=branch.beam,
                omega=branch.omega,
                mode=branch.mode,
                omega_n=linear * branch.beam.frequency_scale,
                holds_up_to=top,
                error=fitted.error,
                series=fitted.series,
                first=fitted.first,
            )
        top = _converging(fitted, top, 0.5 * tolerance)
    raise AmplitudeNotReachedError(
        f"{count} coefficients do not resolve the backbone of {branch.name} to {tolerance:g} even "
        f"up to a = {top:.3g}: ask for more of them, or take backbone_branch"
    )


def _apart(orbits: list[BeamOrbit]) -> list[BeamOrbit]:
    """Return the last orbit and those below it that are not close to the next."""
    kept = orbits[-1:]
    for orbit in orbits[-2::-1]:
        if kept[-1].amplitude - orbit.amplitude > _APART:
            kept.append(orbit)
    return kept[::-1]


class _Fitted(NamedTuple):
    """Series in a² of ω_NL/ω_n and of the first harmonic over the peak, and their error."""

    series: Chebyshev
    first: Chebyshev
    error: float


def _fitted(branch: Branch, top: float, count: int) -> _Fitted:
    angle = 0.5 * np.pi / (count - 1)
    at, between = (top * np.sin(angle * (np.arange(count) + half)) for half in (0.0, 0.5))
    # The highest that it was not made from, where it is worst, one amid, and a low one.
    checked = np.sort(between[[count - 2, count // 2, 1]])
    # Laid in one row, so that a tangent serves its neighbours.
    asked = np.sort(np.concatenate((at[1:], checked)))
    found = _of_orbits(branch, asked)
    made, shown = (found[np.isin(asked, which)] for which in (at, checked))
    values = np.vstack(([1.0, 1.0], made))
    series, first = (
        Chebyshev.fit(at**2, column, count - 1, domain=[0.0, top**2]) for column in values.T
    )
    apart = np.stack((series(checked**2), first(checked**2)), axis=1) - shown
    error = max(_tail(series), _tail(first), float(np.abs(apart).max()))
    return _Fitted(series, first, error)


def _of_orbits(branch: Branch, amplitudes: FloatArray) -> FloatArray:
    """Return ω_NL/ω_n and the first harmonic over the peak of orbits, (orbits, 2)."""
    linear = float(branch.modes[branch.mode - 1])
    orbits = [branch.path.laid(a) for a in amplitudes.tolist()]
    return np.array([[o.frequency / linear, o.gauge_sines[0] / o.amplitude] for o in orbits])


def _rate(series: Chebyshev) -> float:
    """Return by what the coefficients fall, from the last three."""
    earlier, last = abs(float(series.coef[-3])), abs(float(series.coef[-1]))
    return min(0.9, math.sqrt(last / earlier)) if earlier > 0.0 else 0.0


def _tail(series: Chebyshev) -> float:
    """Return the sum of the coefficients left out."""
    rate = _rate(series)
    return abs(float(series.coef[-1])) * rate / (1.0 - rate)


def _converging(fitted: _Fitted, top: float, error: float) -> float:
    """Return the range on which a series of as many coefficients has about this error.

    They fall by 1/(z + √(z² - 1)), z the place of the next singularity where the range is [-1, 1].
    """
    rate = max(_rate(fitted.series), _rate(fitted.first), 0.1)
    wanted = rate * (error / fitted.error) ** (1.0 / fitted.series.degree())
    here, there = (0.5 * (1.0 / r + r) for r in (rate, wanted))
    return top * min(0.97, max(0.7, math.sqrt((here + 1.0) / (there + 1.0))))
