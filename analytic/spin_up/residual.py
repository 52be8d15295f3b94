"""What a change of the speed leaves of the oscillation, in closed form.

While the speed changes slowly over a period, a mode keeps its action: its amplitude goes with
1/√(Mω_n(w)), and the Euler force Γ(w) θ̈ adds to it in phase ψ = ∫ω_n(w) dt. What is left is

    Z = (1/√(Mω_n)|_T) ∫_0^T Γ(w) θ̈ exp(i(ψ_T - ψ)) / √(Mω_n) dt,      a = |Z|,

and after the ramp q = -Im Z exp(iω_n(t - T)). Damping takes its share of every addition until T.
"""

from __future__ import annotations

import math
from typing import overload

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import ComplexArray, FloatArray
from ..beam import AnyBlade, require_planar
from ..input_checks import finite_array, flag, positive, whole_number
from ..lazily import interpolate
from ..quadrature import gauss_points, integrals_from_clamp
from ..ramps import AnyRamp, Table, fastest, require_ramp
from ..reduced.any_blade import blade_oscillator
from ..threads import one_thread
from .modes import ModesOverSpeed, modes_over_speed

_POINTS = 24
_A_PANEL = 12.0  # [rad] of the phase on 24 points
_LARGEST = 1.2
"""Amplitude up to which the action of the backbone is taken."""


@overload
def residual_amplitude(
    beam: AnyBlade, spin_up: AnyRamp, *, mode: int = 1, corrected: bool = False
) -> float: ...
@overload
def residual_amplitude(
    beam: AnyBlade,
    spin_up: AnyRamp,
    ramp_times: ArrayLike,
    *,
    mode: int = 1,
    corrected: bool = False,
) -> FloatArray: ...
@one_thread
def residual_amplitude(
    beam: AnyBlade,
    spin_up: AnyRamp,
    ramp_times: ArrayLike | None = None,
    *,
    mode: int = 1,
    corrected: bool = False,
) -> FloatArray | float:
    """Return the amplitude over L with which the tip swings after a change of the speed.

    Linear theory of the inextensible blade, adiabatic in the speed. Against the exact transient
    of the paper's 24 spin-ups it is 1 to 5 % high up to a = 0.36, 10 % at 0.6, 26 % at 0.84.

    Parameters
    ----------
    beam : Beam or Blade
    spin_up : SpinUp, SmoothRamp or Table
    ramp_times : array_like, optional
        Durations [s] of the same motion, stretched in time; otherwise its own.
    mode : int
        Bending mode, from 1.
    corrected : bool
        Take the linear action for that of the nonlinear orbit (FrM, Eq. 41), first mode only: 1 to
        3 % high up to a = 0.6, 10 % at 0.84; NaN beyond 1.2.

    Returns
    -------
    float or ndarray
        In the shape of `ramp_times`.

    Examples
    --------
    >>> from analytic import Beam, SpinUp, residual_amplitude
    >>> for ramp_time in (2.5, 3.0, 3.5):
    ...     left = residual_amplitude(Beam.reference(), SpinUp(omega=2.0, ramp_time=ramp_time))
    ...     print(f"{ramp_time} s leaves {left:.4f} L")
    2.5 s leaves 0.2826 L
    3.0 s leaves 0.1680 L
    3.5 s leaves 0.0797 L
    """
    mode = whole_number("mode", mode)
    if flag("corrected", corrected) and mode != 1:
        raise ValueError(f"corrected=True knows the backbone of mode 1, got mode={mode}")
    require_ramp(spin_up)
    times = np.asarray(spin_up.ramp_time if ramp_times is None else ramp_times)
    times = finite_array("ramp_times", times, "s")
    for T in times.ravel()[times.ravel() <= 0.0]:
        positive("ramp_times", T, "s")
    modes = modes_for(beam, spin_up, mode)
    left = np.abs(residuals(beam, spin_up, modes, times.ravel())[mode - 1]).reshape(times.shape)
    if corrected:
        left = _on_the_backbone(beam, spin_up.omega, left)
    return float(left) if ramp_times is None else left


def modes_for(beam: AnyBlade, spin_up: AnyRamp, count: int) -> ModesOverSpeed:
    """Return the modes for all speeds of a motion."""
    require_planar(beam)
    # A little more than needed, lest a hair's breadth makes a new one.
    top = max(1.0, math.ceil(10.0 * fastest(spin_up) / beam.frequency_scale) / 10.0)
    return modes_over_speed(beam.unit, top, count)


def residuals(
    beam: AnyBlade, spin_up: AnyRamp, modes: ModesOverSpeed, ramp_times: FloatArray
) -> ComplexArray:
    """Return Z (modes, ramp times) of the motion stretched to each of the `ramp_times` [s]."""
    scale, own = beam.frequency_scale, spin_up.ramp_time
    corners = np.array(spin_up.times) / own if isinstance(spin_up, Table) else np.array([0.0, 1.0])
    fast = float(modes.at(np.array([fastest(spin_up) / scale])).frequency.max())
    pieces = math.ceil(fast * scale * float(ramp_times.max(initial=0.0)) / _A_PANEL)
    pieces = max(pieces, math.ceil(own / spin_up.shortest_wave))
    edges = np.union1d(corners, np.linspace(0.0, 1.0, pieces + 1))
    x, weights = gauss_points(_POINTS)
    width = np.diff(edges)[:, None]
    s = (edges[:-1, None] + width * x).ravel()
    at = modes.at(spin_up.rate(own * s) / scale)
    end = modes.at(np.array([spin_up.omega / scale]))
    euler = spin_up.acceleration(own * s) * (own / scale) * (width * weights).ravel()
    # Phase and decay over T, from s to the end.
    wave = (1j * at.frequency - at.decay).reshape(at.frequency.shape[0], -1, _POINTS)
    whole = width[:, 0] * (wave @ weights)
    inside = width * (wave @ integrals_from_clamp(_POINTS, x).T)
    ahead = np.cumsum(whole[:, ::-1], axis=1)[:, ::-1, None] - inside
    exponent = scale * ahead.reshape(at.frequency.shape)
    strength = euler * at.force / np.sqrt(at.frequency)
    scaled = end.tip / np.sqrt(end.frequency)
    return np.asarray(
        scaled
        * np.stack(
            [
                np.exp(np.multiply.outer(ramp_times, wave)) @ force
                for wave, force in zip(exponent, strength, strict=True)
            ]
        )
    )


def _on_the_backbone(beam: AnyBlade, omega: float, linear: FloatArray) -> FloatArray:
    """Return the amplitudes of orbits that have the action of linear ones."""
    oscillator = blade_oscillator(beam.unit, omega / beam.frequency_scale, True).oscillator
    a = np.linspace(0.0, min(_LARGEST, oscillator.largest_amplitude), 241)
    same = np.sqrt(2.0 * oscillator.action(a) / oscillator.w_n)
    return np.asarray(interpolate.PchipInterpolator(same, a, extrapolate=False)(linear))
