"""The exact backbone at the price of a formula: a series in a² through a few exact orbits.

Frequency and harmonics of an orbit are analytic functions of a², a the peak, up to the next
internal resonance. So a polynomial through the Chebyshev points of a², the linear mode among them,
converges geometrically: with ten of them ω_NL/ω_n keeps 1e-10 where no resonance is near.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple, overload

import numpy as np
from numpy.polynomial import Chebyshev, Polynomial
from numpy.typing import ArrayLike

from ..arrays import FloatArray
from ..beam import AnyBlade, require_undamped, warn_if_rpm
from ..input_checks import RotbeamWarning, finite_array, positive, rotation_speed, whole_number
from ..methods.continuation import DRIFT_BOUND
from ..methods.harmonic_balance import NoOrbitError
from .branch import AmplitudeNotReachedError, Branch, branch_of
from .internal_resonance import nearest_resonance
from .modes import resolved_model
from .steady import BeamOrbit

_SHORTER = 0.96  # of the range, where the series has not converged on it
_SHORTEST = 0.1  # of what was asked for
_LARGEST_DRIFT = 1e-9  # of the Jacobi integral: ω_NL then keeps 1e-11, the first harmonic 1e-9
_APART = 0.04  # orbits at which resonances are looked for
_BLOCK = 16384  # amplitudes that stay in the cache while powers are summed


@dataclass(frozen=True, kw_only=True)
class BackboneCurve:
    """The exact backbone at one speed as a series; made by `backbone_curve`.

    Attributes
    ----------
    beam : Beam or Blade
    omega : float
        Rotation speed ω [rad/s].
    mode : int
        From 1.
    omega_n : float
        ω_n [rad/s].
    holds_up_to : float
        Largest peak |q|/L.
    error : float
        Of ω_NL/ω_n, and of the first harmonic over the peak: what the tail of the series leaves, or
        orbits that it was not made from show, whichever is the most.
    series, first : Chebyshev
        Series in a² of ω_NL/ω_n and of the first harmonic over the peak.
    """

    beam: AnyBlade
    omega: float
    mode: int
    omega_n: float
    holds_up_to: float
    error: float
    series: Chebyshev = field(repr=False)
    first: Chebyshev = field(repr=False)

    @cached_property
    def _powers(self) -> FloatArray:
        return _in_powers(self.series)

    @property
    def lambda_omega(self) -> float:
        """λ_ω of ω_NL = ω_n (1 - λ_ω a² - κ a⁴ - ...) [-], a the peak."""
        return -float(self._powers[1])

    @property
    def kappa(self) -> float:
        """κ of the same [-], the fifth order of the extensible beam."""
        return -float(self._powers[2])

    @overload
    def frequency(self, a: float) -> float: ...
    @overload
    def frequency(self, a: ArrayLike) -> float | FloatArray: ...
    def frequency(self, a: ArrayLike) -> float | FloatArray:
        """Return ω_NL [rad/s] at the peaks `a`, of their shape.

        Raises
        ------
        ValueError
            If an amplitude is negative, or above `holds_up_to`.
        """
        result = in_square(self.omega_n * self._powers, self._within(a))
        return result if result.ndim else float(result)

    @overload
    def first_harmonic(self, a: float) -> float: ...
    @overload
    def first_harmonic(self, a: ArrayLike) -> float | FloatArray: ...
    def first_harmonic(self, a: ArrayLike) -> float | FloatArray:
        """Return the first harmonic of q/L at the peaks `a`, of their shape; refuses as above."""
        amplitude = self._within(a)
        result = amplitude * in_square(_in_powers(self.first), amplitude)
        return result if result.ndim else float(result)

    def _within(self, a: ArrayLike) -> FloatArray:
        amplitude = finite_array("amplitude", a)
        low, high = amplitude.min(initial=0.0), amplitude.max(initial=0.0)
        if low < 0.0 or high > self.holds_up_to * (1.0 + 1e-12):
            raise ValueError(
                f"the curve at omega = {self.omega:g} rad/s holds for amplitudes from 0 up to "
                f"{self.holds_up_to:.6g}, got {low if low < 0.0 else high:g}: they are the peak of "
                f"|q|/L; beyond, take periodic_orbits or backbone_branch"
            )
        return amplitude

    def __str__(self) -> str:
        return (
            f"Exact backbone of mode {self.mode} at {self.omega:g} rad/s up to a = "
            f"{self.holds_up_to:.4g}: omega_n = {self.omega_n:.8f} rad/s, lambda_omega = "
            f"{self.lambda_omega:.6f}, kappa = {self.kappa:.5f}, error {self.error:.0e}"
        )


def backbone_curve(
    beam: AnyBlade,
    omega: float,
    up_to: float = 0.6,
    mode: int = 1,
    *,
    coefficients: int = 10,
    tolerance: float = 1e-8,
    inextensible: bool = False,
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
    mode, inextensible, functions
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
    (3.723573, 0.019669)
    """
    omega, mode = rotation_speed(omega), whole_number("mode", mode)
    if positive("up_to", up_to) >= 1.0:
        raise ValueError(f"up_to must be below 1, got {up_to:g}: it is |q|/L of the tip")
    count = whole_number("coefficients", coefficients, least=5)
    if positive("tolerance", tolerance) < 1e-10:
        raise ValueError(
            f"tolerance must be at least 1e-10, got {tolerance:g}: orbits keep no more"
        )
    warn_if_rpm(beam, omega)
    require_undamped(beam, "a damped blade has no free periodic orbits")
    model = resolved_model(beam, mode, inextensible, False, functions)
    drift = max(DRIFT_BOUND, min(_LARGEST_DRIFT, 0.1 * tolerance))
    branch = branch_of(beam, omega, mode, model, drift)
    curve = fitted_curve(branch, up_to, count, tolerance)
    if curve.holds_up_to < up_to:
        below = _apart([o for o in branch.path.nodes if o.amplitude <= curve.holds_up_to])
        warnings.warn(
            f"the backbone at omega = {omega:g} rad/s has a series of {count} coefficients that "
            f"holds to {tolerance:g} up to a = {curve.holds_up_to:.4g} only, not up to {up_to:g}"
            f"{nearest_resonance(below, branch.modes, mode)}; ask for more coefficients, or take "
            f"backbone_branch",
            RotbeamWarning,
            stacklevel=2,
        )
    return curve


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
        top *= _SHORTER
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
    checked = between[[count - 2, count // 2, 1]]
    values = np.vstack(([1.0, 1.0], _of_orbits(branch, at[1:])))
    series, first = (
        Chebyshev.fit(at**2, column, count - 1, domain=[0.0, top**2]) for column in values.T
    )
    shown = _of_orbits(branch, np.sort(checked))
    apart = np.stack((series(np.sort(checked) ** 2), first(np.sort(checked) ** 2)), axis=1) - shown
    error = max(_tail(series), _tail(first), float(np.abs(apart).max()))
    return _Fitted(series, first, error)


def _of_orbits(branch: Branch, amplitudes: FloatArray) -> FloatArray:
    """Return ω_NL/ω_n and the first harmonic over the peak of orbits, (orbits, 2)."""
    linear = float(branch.modes[branch.mode - 1])
    orbits = [branch.path.laid(a) for a in amplitudes.tolist()]
    return np.array([[o.frequency / linear, o.gauge_harmonics[0] / o.amplitude] for o in orbits])


def _tail(series: Chebyshev) -> float:
    """Return the sum of the coefficients left out, which fall as the last three do."""
    earlier, last = abs(float(series.coef[-3])), abs(float(series.coef[-1]))
    rate = min(0.9, (last / earlier) ** 0.5) if earlier > 0.0 else 0.0
    return last * rate / (1.0 - rate)


def _in_powers(series: Chebyshev) -> FloatArray:
    """Return the coefficients of the powers of a²."""
    return np.asarray(series.convert(kind=Polynomial, domain=[-1.0, 1.0], window=[-1.0, 1.0]).coef)


def in_square(coefficients: FloatArray, a: FloatArray) -> FloatArray:
    """Return Σ c_k a^2k, of the shape of `a`: by Horner's rule, in blocks that fit the cache."""
    flat, powers = np.ravel(a), coefficients.tolist()
    result = np.empty_like(flat)
    for start in range(0, flat.size, _BLOCK):
        part = flat[start : start + _BLOCK]
        square, value = part * part, result[start : start + _BLOCK]
        value[:] = powers[-1]
        for power in powers[-2::-1]:
            value *= square
            value += power
    return result.reshape(np.shape(a))
