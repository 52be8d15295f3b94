"""Residual amplitude: the oscillation that a change of the speed leaves, in closed form.

While the speed changes slowly over a period, a mode keeps its action. The Euler force, and the
inertia of the moving steady state, add φᴴg(w) θ̈ to it in phase ψ = ∫ω_n(w) dt, by the modes φ(w)
of unit action of `modes_over_speed`. After the ramp stays

    Z = v(w_T) ∫_0^T φᴴg(w) θ̈ exp(i(ψ_T - ψ)) dt,      a = |Z|,

v being the motion of the tip in the mode, and after the ramp q = -Im Z exp(iω_n(t - T)). Damping
takes its share of every addition until T.
"""

from __future__ import annotations

import math
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import ComplexArray, FloatArray
from ..blade import Blade
from ..blade_checks import require_blade, require_planar
from ..exact.driven.spin_up import spin_up_response
from ..input_checks import finite_array, flag, positive
from ..lazily import interpolate
from ..motion import SpeedChange, require_ramp
from ..quadrature import gauss_points, integrals_from_clamp
from ..reduced.any_blade import blade_oscillator
from ..theory import BERNOULLI_EULER, Theory, require_theory
from ..threads import one_thread
from .modes_over_speed import (
    ModesOverSpeed,
    excited_mode,
    modes_at,
    modes_over_speed,
    period_of,
    top_of,
    with_neighbors,
)

_POINTS = 24
_DURING, _A_PERIOD = 193, 100  # instants of the ramp, and of a period after it
_A_PANEL = 12.0  # [rad] of the phase on 24 points
_LARGEST = 1.2
"""Amplitude up to which the action of the backbone is taken."""


@one_thread
def residual_amplitude(
    blade: Blade,
    spin_up: SpeedChange,
    ramp_times: ArrayLike | None = None,
    *,
    mode: str | int = "lag 1",
    theory: Theory = BERNOULLI_EULER,
    corrected: bool = False,
    all_modes: bool = False,
    exact: bool = False,
    tolerance: float = 1e-6,
) -> Any:
    """Return the amplitude over L of the tip in a mode after a change of the speed.

    Linear about the steady state, adiabatic in the speed. Against the exact transient of the
    paper's 24 spin-ups it is 1 to 5 % high up to a = 0.36, 10 % at 0.6, 26 % at 0.84. The amplitude
    of a flap mode is that normal to the plane of rotation, of other modes that in it.

    Parameters
    ----------
    blade : Blade
    spin_up : SpinUp, FourierRamp or SpeedTable
    ramp_times : array_like, optional
        Durations [s] of the same motion, stretched in time; otherwise its own.
    mode : str or int
        By its name in `linear_modes` at the highest speed, or its number there, from 1.
    theory : Theory
        Extension, shear, rotary inertia, trapeze effect.
    corrected : bool
        Take the linear action for the action of the nonlinear orbit (FrM, Eq. 41), of lag 1 of a
        planar blade: 1 to 3 % high up to a = 0.6, 10 % at 0.84; NaN beyond 1.2.
    all_modes : bool
        Half peak to peak of the tip in the mode's direction, in its first period after the
        ramp, of all modes up to the next of its family.
    exact : bool
        Take the same of the exact transient, all modes and large deflections included, of the
        motion's own ramp time.
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
    require_blade(blade)
    require_ramp(spin_up)
    names = (excited_mode(blade, spin_up.fastest, mode, require_theory(theory)),)
    corrected, all_modes = flag("corrected", corrected), flag("all_modes", all_modes)
    if corrected:
        if all_modes:
            raise ValueError("corrected=True is of lag 1 alone: leave out all_modes, or corrected")
        require_planar(blade, "corrected=True is of", "the closed form without it, or exact=True")
        if names != ("lag 1",):
            raise ValueError(f"corrected=True is of the orbit of lag 1, and mode is {names[0]}")
    if flag("exact", exact):
        if ramp_times is not None or corrected:
            raise ValueError(
                "exact=True is of the motion's own ramp time and of all modes: leave out "
                "ramp_times and corrected"
            )
        return _exact(blade, spin_up, names, theory, tolerance)
    times = finite_array("ramp_times", spin_up.ramp_time if ramp_times is None else ramp_times, "s")
    for T in times.ravel()[times.ravel() <= 0.0]:
        positive("ramp_times", T, "s")
    of = partial(_of_all, names) if all_modes else partial(_of_one, names)
    left = of(blade, spin_up, theory, times.ravel()).reshape(times.shape)
    if corrected:
        left = _on_the_backbone(blade, spin_up.omega, left)
    return float(left) if ramp_times is None else left


def _of_one(
    names: tuple[str, ...], blade: Blade, spin_up: SpeedChange, theory: Theory, times: FloatArray
) -> FloatArray:
    modes = modes_for(blade, spin_up, theory, names)
    return np.asarray(np.abs(residuals(blade, spin_up, modes, times)[0]))


def _of_all(
    names: tuple[str, ...], blade: Blade, spin_up: SpeedChange, theory: Theory, times: FloatArray
) -> FloatArray:
    """Return half peak to peak of the lowest modes together, over L."""
    omega, flap = spin_up.omega, names[0].startswith("flap")
    period = period_of(blade, omega, theory, *names)
    names = tuple(
        name
        for name in with_neighbors(blade, omega, theory, names)
        if not name.startswith("torsion")
    )
    _, at = modes_at(blade, omega, theory, names)
    after = np.linspace(0.0, blade.frequency_scale * period, _A_PERIOD)
    moving = np.exp(np.multiply.outer(1j * at.frequency - at.decay, after))
    shares = at.tips[:, 1 + flap] / at.tip
    Z = residuals(blade, spin_up, modes_for(blade, spin_up, theory, names), times)
    return np.asarray(0.5 * np.ptp(np.imag(Z.T @ (shares[:, None] * moving)), axis=1))


def modes_for(
    blade: Blade, spin_up: SpeedChange, theory: Theory, names: tuple[str, ...]
) -> ModesOverSpeed:
    """Return the modes for all speeds of a motion."""
    return modes_over_speed(blade, top_of(blade, spin_up.fastest), theory, names)


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
    force: ComplexArray
    """Force of the acceleration, with the weights of Gauss's method, (modes, points)."""
    tip: ComplexArray
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
        force=euler * at.force,
        tip=end.tip,
    )


def _exact(
    blade: Blade, spin_up: SpeedChange, names: tuple[str, ...], theory: Theory, tolerance: float
) -> float:
    """Return half peak to peak of the tip over L in the first period after the exact transient."""
    T, period = spin_up.ramp_time, period_of(blade, spin_up.omega, theory, *names)
    during, after = np.linspace(0.0, T, 33), np.linspace(T, T + 1.1 * period, 300)
    response = spin_up_response(
        blade, spin_up, np.append(during, after), tolerance=tolerance, theory=theory
    )
    seen = response.flap if names[0].startswith("flap") else response.q
    return float(np.ptp(seen[during.size :])) / (2.0 * blade.length)


def exact_residuals(
    blade: Blade,
    ramp: SpeedChange,
    names: tuple[str, ...],
    theory: Theory,
    tolerance: float = 1e-6,
) -> tuple[ComplexArray, float]:
    """Return Z (modes,) over L by the exact transient, for small oscillations.

    By least squares over the longest period of these modes, of the tip's place less the steady one.
    Modes up to the next of their family are fitted, too. And the largest |q|/L of the ramp.
    """
    all_names = with_neighbors(blade, ramp.omega, theory, names)
    still, modes = modes_at(blade, ramp.omega, theory, all_names)
    # The times before tell how large the motion is, of which the tolerance is a share.
    during = np.linspace(0.0, ramp.ramp_time, _DURING)
    period = 2.0 * math.pi / (blade.frequency_scale * float(modes.frequency.min()))
    after = np.linspace(0.0, period, _A_PERIOD)
    response = spin_up_response(
        blade, ramp, np.append(during, ramp.ramp_time + after), tolerance=tolerance, theory=theory
    )
    wave = np.exp(np.outer(after, blade.frequency_scale * (1j * modes.frequency - modes.decay)))
    places = np.stack((response.q, response.flap))[: still.size] / blade.length
    moving = np.einsum("tk,kc->ctk", wave, modes.tips[:, 1:])
    shares = np.concatenate((-moving.imag, -moving.real), axis=2).reshape(-1, 2 * len(modes.tip))
    left = (places[:, during.size :] - still[:, None]).ravel()
    real, imaginary = np.split(np.linalg.lstsq(shares, left, rcond=None)[0], 2)
    Z = (modes.tip * (real + 1j * imaginary))[: len(names)]
    return Z, float(np.abs(places[0, : during.size]).max())


def _on_the_backbone(blade: Blade, omega: float, linear: FloatArray) -> FloatArray:
    """Return the amplitudes of orbits that have the action of linear ones."""
    oscillator = blade_oscillator(blade.unit, omega / blade.frequency_scale, True).oscillator
    a = np.linspace(0.0, min(_LARGEST, oscillator.largest_amplitude), 241)
    same = np.sqrt(2.0 * oscillator.action(a) / oscillator.w_n)
    return np.asarray(interpolate.PchipInterpolator(same, a, extrapolate=False)(linear))
