"""Residual amplitude: the oscillation that a change of the speed leaves, in closed form.

While the speed changes slowly over a period, a mode keeps its action: its amplitude goes with
1/√(Mω_n(w)). The Euler force Γ(w) θ̈ adds to it in phase ψ = ∫ω_n(w) dt. The ramp leaves

    Z = (1/√(Mω_n)|_T) ∫_0^T Γ(w) θ̈ exp(i(ψ_T - ψ)) / √(Mω_n) dt,      a = |Z|,

and after the ramp q = -Im Z exp(iω_n(t - T)). Damping takes its share of every addition until T.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import ArrayLike

from ..arrays import ComplexArray, FloatArray
from ..blade import Blade
from ..blade_checks import require_planar
from ..exact.driven.spin_up import spin_up_response
from ..exact.linear.modes import driven_modes
from ..input_checks import finite_array, flag, positive
from ..lazily import interpolate
from ..motion import SpeedChange, require_ramp
from ..quadrature import gauss_points, integrals_from_clamp
from ..reduced.any_blade import blade_oscillator
from ..shape_functions import blade_functions
from ..threads import one_thread
from ..unit_blade import UnitBlade

_SETTLED = 1e-8
"""Share of the last coefficients of an interpolation that has settled."""
_FEWEST, _MOST = 17, 257
_FUNCTIONS = 20
"""Twice as many as the modes in use, and four √w̄ more for the layer at the clamp."""
_POINTS = 24
_DURING = 193  # instants of the ramp
_A_PANEL = 12.0  # [rad] of the phase on 24 points
_LARGEST = 1.2
"""Amplitude up to which the action of the backbone is taken."""


class ModesAt(NamedTuple):
    """Modes of unit mass at speeds w̄, each (modes, speeds), nondimensional.

    The natural frequency, the force of the Euler acceleration -θ̈ on the mode over -θ̈, the tip's
    deflection (positive), and the rate at which damping takes the amplitude.
    """

    frequency: FloatArray
    force: FloatArray
    tip: FloatArray
    decay: FloatArray


@dataclass(frozen=True)
class ModesOverSpeed:
    """Chebyshev series of the modes from standstill to the speed w̄ = `top`."""

    top: float
    coefficients: FloatArray = field(repr=False)

    def at(self, w: FloatArray) -> ModesAt:
        """Return the modes at speeds `w`, (speeds,), whose sign does not matter.

        Beyond the top they are those at the top.
        """
        inside = np.minimum(2.0 * np.abs(w) / self.top - 1.0, 1.0)
        values = chebyshev.chebval(inside, self.coefficients)
        return ModesAt(*np.asarray(values))


@lru_cache(maxsize=64)
def modes_over_speed(blade: UnitBlade, top: float, count: int) -> ModesOverSpeed:
    """Return the first `count` modes for speeds w̄ from 0 to `top`."""
    functions = max(_FUNCTIONS, 2 * count + 8) + math.ceil(4.0 * math.sqrt(top))
    of = blade_functions(blade, functions)
    x, dx = blade.quadrature(2 * (of.across.a_panel + 4))
    along = of.across.twice(x)
    viscous, air = blade.damping.bending * of.bending, blade.damping.external
    damping = viscous + air * along.T @ (dx[:, None] * along)

    def solve(x: FloatArray) -> Any:
        """Return the modes at speeds from x = -1 to 1, one in a row, in the order of `ModesAt`."""
        rows = []
        for w in 0.5 * top * (1.0 + x):
            frequencies, modes = of.modes(w, count)
            decay = 0.5 * np.sum(modes * (damping @ modes), axis=0)
            force, tip = blade.setting * of.euler @ modes, of.tip @ modes
            rows.append(np.concatenate([frequencies, force, tip, decay]))
        return np.array(rows)

    points = _FEWEST
    while True:
        coefficients: Any = chebyshev.chebinterpolate(solve, points - 1)
        size = np.abs(coefficients).max(axis=0) + np.finfo(float).tiny
        rest = float((np.abs(coefficients[-2:]).max(axis=0) / size).max())
        if rest < _SETTLED:
            return ModesOverSpeed(top, coefficients.reshape(points, 4, count))
        if points >= _MOST:
            raise ValueError(
                f"the modes up to w̄ = {top:.4g} do not settle over the speed with {points} "
                f"speeds ({rest:.1e}): take fewer modes, or a lower speed"
            )
        points = 2 * points - 1


@one_thread
def residual_amplitude(
    blade: Blade,
    spin_up: SpeedChange,
    ramp_times: ArrayLike | None = None,
    *,
    corrected: bool = False,
    exact: bool = False,
    tolerance: float = 1e-6,
) -> Any:
    """Return the amplitude over L of the tip's first mode after a change of the speed.

    Linear theory of the inextensible blade, adiabatic in the speed. Against the exact transient
    of the paper's 24 spin-ups it is 1 to 5 % high up to a = 0.36, 10 % at 0.6, 26 % at 0.84.

    Parameters
    ----------
    blade : Blade
    spin_up : SpinUp, FourierRamp or SpeedTable
    ramp_times : array_like, optional
        Durations [s] of the same motion, stretched in time; otherwise its own.
    corrected : bool
        Take the linear action for the action of the nonlinear orbit (FrM, Eq. 41):
        1 to 3 % high up to a = 0.6, 10 % at 0.84; NaN beyond 1.2.
    exact : bool
        Take half peak to peak of the tip in the first period after the exact transient, all modes
        and large deflections included, of the motion's own ramp time.
    tolerance : float
        Of the exact transient, as in `spin_up_response`.

    Returns
    -------
    float or ndarray
        In the shape of `ramp_times`.

    Examples
    --------
    >>> from analytic import Beam, SpinUp, residual_amplitude
    >>> beam, spin_up = Beam.reference(), SpinUp(omega=2.0, ramp_time=3.0)
    >>> print(residual_amplitude(beam, spin_up, [2.5, 3.0, 3.5]).round(4))
    [0.2826 0.168  0.0797]
    >>> print(f"{residual_amplitude(beam, spin_up, exact=True):.4f} L by the exact transient")
    0.1655 L by the exact transient
    """
    require_planar(blade)
    require_ramp(spin_up)
    corrected = flag("corrected", corrected)
    if flag("exact", exact):
        if ramp_times is not None or corrected:
            raise ValueError(
                "exact=True is of the motion's own ramp time and of all modes: leave out "
                "ramp_times and corrected"
            )
        return _exact(blade, spin_up, tolerance)
    times = finite_array("ramp_times", spin_up.ramp_time if ramp_times is None else ramp_times, "s")
    for T in times.ravel()[times.ravel() <= 0.0]:
        positive("ramp_times", T, "s")
    modes = modes_for(blade, spin_up, 1)
    left = np.abs(residuals(blade, spin_up, modes, times.ravel())[0]).reshape(times.shape)
    if corrected:
        left = _on_the_backbone(blade, spin_up.omega, left)
    return float(left) if ramp_times is None else left


def modes_for(blade: Blade, spin_up: SpeedChange, count: int) -> ModesOverSpeed:
    """Return the modes for all speeds of a motion."""
    require_planar(blade)
    # Rounded up, so that nearly equal speeds share one series.
    top = max(1.0, math.ceil(10.0 * spin_up.fastest / blade.frequency_scale) / 10.0)
    return modes_over_speed(blade.unit, top, count)


def residuals(
    blade: Blade, spin_up: SpeedChange, modes: ModesOverSpeed, ramp_times: FloatArray
) -> ComplexArray:
    """Return Z (modes, ramp times) of the motion stretched to each of the `ramp_times` [s]."""
    wave = _waves(blade, spin_up, modes, float(ramp_times.max(initial=0.0)))
    at_end = [
        np.exp(np.multiply.outer(ramp_times, exponent)) @ force
        for exponent, force in zip(wave.exponent, wave.force, strict=True)
    ]
    return np.asarray(wave.tip[:, -1:] * np.stack(at_end))


def swing(blade: Blade, spin_up: SpeedChange, modes: ModesOverSpeed, pieces: int) -> FloatArray:
    """Return the tip's deflection over L at the ends of so many equal pieces of the motion."""
    T = spin_up.ramp_time
    wave = _waves(blade, spin_up, modes, T, pieces)
    exponent = T * wave.exponent.reshape(*wave.exponent.shape[:1], -1, _POINTS)
    parts = np.exp(exponent) * wave.force.reshape(exponent.shape)
    so_far = np.cumsum(parts.sum(axis=2), axis=1)
    z = wave.tip[:, 1:] * so_far * np.exp(-T * wave.ahead)
    every = z.shape[1] // pieces
    return np.asarray(-z.imag.sum(axis=0)[every - 1 :: every])


class _Waves(NamedTuple):
    """Modes along a motion: what a force leaves at its end is tip Σ force exp(T exponent)."""

    exponent: ComplexArray
    """(iω_n - d) from each point to the end, (modes, points), over the duration [1/s]."""
    ahead: ComplexArray
    """The same from the ends of the pieces, (modes, pieces)."""
    force: FloatArray
    """Force of the Euler acceleration, with the weights of Gauss's method, (modes, points)."""
    tip: FloatArray
    """At the edges of the pieces, (modes, pieces + 1)."""


def _waves(
    blade: Blade, spin_up: SpeedChange, modes: ModesOverSpeed, longest: float, even: int = 1
) -> _Waves:
    """Return the modes along a motion that takes `longest` [s], in a multiple of `even` pieces."""
    scale, ramp_time = blade.frequency_scale, spin_up.ramp_time
    fast = float(modes.at(np.array([spin_up.fastest / scale])).frequency.max())
    pieces = math.ceil(fast * scale * longest / _A_PANEL)
    pieces = max(pieces, math.ceil(ramp_time / spin_up.shortest_wave))
    pieces = even * math.ceil(pieces / even)
    edges = np.union1d(spin_up.corners / ramp_time, np.linspace(0.0, 1.0, pieces + 1))
    x, weights = gauss_points(_POINTS)
    width = np.diff(edges)[:, None]
    s = (edges[:-1, None] + width * x).ravel()
    at = modes.at(spin_up.rate(ramp_time * s) / scale)
    end = modes.at(spin_up.rate(ramp_time * edges) / scale)
    euler = spin_up.acceleration(ramp_time * s) * (ramp_time / scale) * (width * weights).ravel()
    # Phase and decay over T, from s to the end.
    wave = (1j * at.frequency - at.decay).reshape(at.frequency.shape[0], -1, _POINTS)
    whole = width[:, 0] * (wave @ weights)
    inside = width * (wave @ integrals_from_clamp(_POINTS, x).T)
    ahead = np.cumsum(whole[:, ::-1], axis=1)[:, ::-1, None]
    return _Waves(
        exponent=scale * (ahead - inside).reshape(at.frequency.shape),
        ahead=scale * (ahead[..., 0] - whole),
        force=euler * at.force / np.sqrt(at.frequency),
        tip=end.tip / np.sqrt(end.frequency),
    )


def _exact(blade: Blade, spin_up: SpeedChange, tolerance: float) -> float:
    """Return half peak to peak of the tip over L in the first period after the exact transient."""
    period = 2.0 * math.pi / float(driven_modes(blade, spin_up.omega).frequencies[0])
    T = spin_up.ramp_time
    during, after = np.linspace(0.0, T, 33), np.linspace(T, T + 1.1 * period, 300)
    response = spin_up_response(blade, spin_up, np.append(during, after), tolerance=tolerance)
    return float(np.ptp(response.q[during.size :])) / (2.0 * blade.length)


def exact_residuals(
    blade: Blade, ramp: SpeedChange, count: int = 1, tolerance: float = 1e-6
) -> tuple[ComplexArray, float]:
    """Return Z (count,) of the first modes over L by the exact transient, for small oscillations.

    By least squares over the first period after the ramp, of q = -Im Σ Z_k exp((iω_k - d_k)(t - T))
    with one mode more, whose share is so kept out of the others. And the largest |q|/L of the ramp.
    """
    decay = (
        modes_for(blade, ramp, count + 1).at(np.array([ramp.omega / blade.frequency_scale])).decay
    )
    functions = max(20, 2 * (count + 1))
    omegas = driven_modes(blade, ramp.omega, count + 1, functions=functions).frequencies
    # The times before tell how large the motion is, of which the tolerance is a share.
    during = np.linspace(0.0, ramp.ramp_time, _DURING)
    after = np.linspace(0.0, 2.0 * math.pi / omegas[0], 100)
    times = np.append(during, ramp.ramp_time + after)
    response = spin_up_response(blade, ramp, times, tolerance=tolerance)
    wave = np.exp(np.outer(after, 1j * omegas - decay[:, 0] * blade.frequency_scale))
    shares = np.concatenate((-wave.imag, -wave.real), axis=1)
    q = response.q / blade.length
    fitted = np.linalg.lstsq(shares, q[during.size :], rcond=None)[0]
    left = np.asarray(fitted[:count] + 1j * fitted[count + 1 : -1])
    return left, float(np.abs(q[: during.size]).max())


def _on_the_backbone(blade: Blade, omega: float, linear: FloatArray) -> FloatArray:
    """Return the amplitudes of orbits that have the action of linear ones."""
    oscillator = blade_oscillator(blade.unit, omega / blade.frequency_scale, True).oscillator
    a = np.linspace(0.0, min(_LARGEST, oscillator.largest_amplitude), 241)
    same = np.sqrt(2.0 * oscillator.action(a) / oscillator.w_n)
    return np.asarray(interpolate.PchipInterpolator(same, a, extrapolate=False)(linear))
