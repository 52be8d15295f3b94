"""The exact backbone at the price of a formula: a series in a² through a few exact orbits.

Frequency and harmonics of an orbit are analytic functions of a², a the peak, up to the next
internal resonance. So a polynomial through the Chebyshev points of a², the linear mode among them,
converges geometrically: with ten of them ω_NL/ω_n keeps 1e-10 where no resonance is near.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.polynomial import Chebyshev, Polynomial
from numpy.typing import ArrayLike

from ...arrays import FloatArray
from ...blade import Blade
from ...input_checks import finite_array
from ...methods.continuation import MOST_FUNCTIONS, Care
from ...methods.harmonic_balance import frequency_change
from ...methods.newton import NoOrbitError
from ...theory import Theory
from ...warning import warn
from ..continuum.rotation import BladeOrbit
from .internal_resonance import nearest_resonance
from .path import AmplitudeNotReachedError, ModePath

_COEFFICIENTS = 10
_TOLERANCE = 1e-8  # of ω_NL/ω_n and of the first harmonic over the peak
_SHORTER = 0.93  # of the range, where orbits end
_SHORTEST = 0.1  # of what was asked for
_DRIFT = 5e-9  # of the Jacobi integral: ω_NL then keeps 1e-10, the first harmonic 2e-9
_MOST_HARMONICS = 40  # those of orbits up to 0.8; near a resonance they need more
_APART = 0.08  # orbits at which resonances are looked for


@dataclass(frozen=True, kw_only=True)
class BackboneCurve:
    """The exact backbone at one speed as a series; made by `backbone_curve`.

    Attributes
    ----------
    beam, omega, mode, theory : as given
    omega_n : float
        ω_n [rad/s].
    holds_up_to : float
        Largest peak |q|/L.
    error : float
        Uncertainty of ω_NL/ω_n, and of the first harmonic over the peak: the tail of the series or
        the error at other orbits, whichever is larger.
    series, first : Chebyshev
        Series in a² of ω_NL/ω_n and of the first harmonic over the peak.
    """

    blade: Blade
    omega: float
    mode: str
    theory: Theory
    omega_n: float
    holds_up_to: float
    error: float
    series: Chebyshev = field(repr=False)
    first: Chebyshev = field(repr=False)

    @property
    def lambda_omega(self) -> float:
        """λ_ω of ω_NL = ω_n (1 - λ_ω a² - κ a⁴ - ...) [-], a the peak."""
        return -float(self.series.convert(kind=Polynomial).coef[1])

    @property
    def kappa(self) -> float:
        """κ of the same [-], the fifth order of the extensible beam."""
        return -float(self.series.convert(kind=Polynomial).coef[2])

    def frequency(self, a: ArrayLike) -> FloatArray:
        """Return ω_NL [rad/s] at the peaks `a`, of their shape.

        Raises
        ------
        ValueError
            If an amplitude is negative, or above `holds_up_to`.
        """
        return self.omega_n * self.series(self._within(a) ** 2)

    def first_harmonic(self, a: ArrayLike) -> FloatArray:
        """Return the first harmonic of q/L at the peaks `a`, of their shape; refuses as above."""
        amplitude = self._within(a)
        return amplitude * self.first(amplitude**2)

    def _within(self, a: ArrayLike) -> FloatArray:
        amplitude = finite_array("amplitude", a)
        low, high = np.min(amplitude, initial=0.0), np.max(amplitude, initial=0.0)
        if not (low >= 0.0 and high <= self.holds_up_to * (1.0 + 1e-12)):
            raise ValueError(
                f"the curve at omega = {self.omega:g} rad/s holds for amplitudes from 0 up to "
                f"{self.holds_up_to:.6g}, got {low if low < 0.0 else high:g}: they are the peak of "
                f"|q|/L; beyond, take periodic_orbits or backbone(...).branch"
            )
        return amplitude

    def __str__(self) -> str:
        return (
            f"Exact backbone of {self.mode} at {self.omega:g} rad/s up to a = "
            f"{self.holds_up_to:.4g}: ω_n = {self.omega_n:.8f} rad/s, λ_ω = "
            f"{self.lambda_omega:.6f}, κ = {self.kappa:.5f}, error {self.error:.0e}"
        )


def settled_curve(of: ModePath, up_to: float) -> BackboneCurve:
    """Return the series of a backbone, on as many functions as it needs."""
    model = of.model
    care = Care(drift=_DRIFT, harmonics=_MOST_HARMONICS, halvings=1, tail=of.care.tail)
    while True:
        of = replace(of, model=model, care=care)
        curve = _fitting(of, up_to)
        largest = [o for o in of.path.nodes if o.amplitude <= curve.holds_up_to][-1]
        model = largest.system.refined().model
        change = frequency_change(largest, of.path.tangent)
        if change <= _TOLERANCE or model.bending > MOST_FUNCTIONS:
            break
    curve = replace(curve, error=max(curve.error, change))
    if curve.holds_up_to < up_to:
        below = _apart([o for o in of.path.nodes if o.amplitude <= curve.holds_up_to])
        warn(
            f"the backbone at omega = {of.omega:g} rad/s has a series that holds to "
            f"{_TOLERANCE:g} up to a = {curve.holds_up_to:.4g} only, not up to {up_to:g}"
            f"{nearest_resonance(of, below)}; beyond, take backbone(...).branch"
        )
    return curve


def _fitting(of: ModePath, up_to: float) -> BackboneCurve:
    """Return the series of a backbone, on as much of the range as it holds for."""
    top = up_to
    while top > _SHORTEST * up_to:
        try:
            fitted = _fitted(of, top)
        except NoOrbitError:
            top = _SHORTER * min(top, of.path.nodes[-1].amplitude)
            continue
        if fitted.error <= _TOLERANCE:
            return fitted
        top = _converging(fitted, 0.5 * _TOLERANCE)
    raise AmplitudeNotReachedError(
        f"a series does not resolve the backbone of {of.name} to {_TOLERANCE:g} even up to "
        f"a = {top:.3g}: take backbone(...).branch"
    )


def _apart(orbits: list[BladeOrbit]) -> list[BladeOrbit]:
    """Return the last orbit and those below it that are not close to the next."""
    kept = orbits[-1:]
    for orbit in orbits[-2::-1]:
        if kept[-1].amplitude - orbit.amplitude > _APART:
            kept.append(orbit)
    return kept[::-1]


def _fitted(of: ModePath, top: float) -> BackboneCurve:
    count = _COEFFICIENTS
    angle = 0.5 * np.pi / (count - 1)
    at, between = (top * np.sin(angle * (np.arange(count) + half)) for half in (0.0, 0.5))
    # The highest that it was not made from, where it is worst, one amid, and a low one.
    checked = np.sort(between[[count - 2, count // 2, 1]])
    # Laid in one row, so that a tangent serves its neighbours.
    amplitudes = np.sort(np.concatenate((at[1:], checked)))
    orbits, linear = [of.path.laid(a) for a in amplitudes.tolist()], float(of.modes[of.place])
    of_orbits = np.array([[o.frequency / linear, o.gauge_sines[0] / o.amplitude] for o in orbits])
    made, shown = (of_orbits[np.isin(amplitudes, which)] for which in (at, checked))
    values = np.vstack(([1.0, 1.0], made))
    series, first = (
        Chebyshev.fit(at**2, column, count - 1, domain=[0.0, top**2]) for column in values.T
    )
    apart = np.stack((series(checked**2), first(checked**2)), axis=1) - shown
    return BackboneCurve(
        blade=of.blade,
        omega=of.omega,
        mode=of.mode,
        theory=of.theory,
        omega_n=of.omega_n,
        holds_up_to=top,
        error=max(_tail(series), _tail(first), float(np.abs(apart).max())),
        series=series,
        first=first,
    )


def _rate(series: Chebyshev) -> float:
    """Return the factor by which the coefficients fall, from the last three."""
    earlier, last = abs(float(series.coef[-3])), abs(float(series.coef[-1]))
    return min(0.9, math.sqrt(last / earlier)) if earlier > 0.0 else 0.0


def _tail(series: Chebyshev) -> float:
    """Return the sum of the coefficients left out."""
    rate = _rate(series)
    return abs(float(series.coef[-1])) * rate / (1.0 - rate)


def _converging(curve: BackboneCurve, error: float) -> float:
    """Return the range on which a series of as many coefficients has about this error.

    They fall by 1/(z + √(z² - 1)), z the place of the next singularity where the range is [-1, 1].
    """
    rate = max(_rate(curve.series), _rate(curve.first), 0.1)
    nearer = rate * (error / curve.error) ** (1.0 / curve.series.degree())
    here, there = (0.5 * (1.0 / r + r) for r in (rate, nearer))
    return curve.holds_up_to * min(0.97, max(0.7, math.sqrt((here + 1.0) / (there + 1.0))))
