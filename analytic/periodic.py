"""The exact backbone: periodic orbits of the exact beam, followed in amplitude."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .basis import FloatArray
from .beam import Beam, warn_if_rpm
from .continuation import followed, linear_orbit
from .continuum import ComplexArray
from .floquet import floquet_multipliers, is_stable
from .harmonic_balance import NoOrbitError, PeriodicOrbit, solve
from .input_checks import RotbeamWarning, finite_values, rotation_speed, whole_number
from .modes import resolved_model, solve_modes, steady_rate

_NEAR = 0.02  # an internal resonance is this near, relative to the other mode's frequency
_NOTICEABLE = 1e-6  # size of a harmonic, relative to the first, that can drive another mode


@dataclass(frozen=True, kw_only=True)
class BeamState:
    """State of the beam at material points, in the rotating frame: r = (x + u, v); SI units.

    Attributes
    ----------
    u, v : ndarray (points,)
        Displacements along and across the undeformed axis [m].
    u_slope, v_slope : ndarray (points,)
        Their derivatives to x, u' and v' [-].
    u_dot, v_dot, u_slope_dot, v_slope_dot : ndarray (points,)
        The rates of all four as seen in the rotating frame [m/s, 1/s].
    """

    u: FloatArray
    v: FloatArray
    u_slope: FloatArray
    v_slope: FloatArray
    u_dot: FloatArray
    v_dot: FloatArray
    u_slope_dot: FloatArray
    v_slope_dot: FloatArray


@dataclass(frozen=True, kw_only=True)
class Backbone:
    """Periodic orbits of the exact beam at one speed; made by `periodic_orbits`.

    Time and phase start where the beam is straight and q rises, in every method.

    Attributes
    ----------
    beam : Beam
    omega : float
        Rotation speed ω [rad/s].
    mode : int
        The mode from which the orbits grow, from 1.
    omega_n : float
        Its linear frequency ω_n [rad/s].
    amplitude : ndarray (orbits,)
        Peak |q|/L.
    frequency : ndarray (orbits,)
        ω_NL [rad/s].
    lambda_omega : float
        λ_ω of ω_NL = ω_n (1 - λ_ω a²) as a → 0.
    lambda_omega_error : float
        What the extrapolation to a = 0 changed: an upper estimate of its error.
    harmonics : ndarray (orbits, H)
        Sine coefficients 1 to H of q/L.
    residual : ndarray (orbits,)
        Largest residual of the equations of motion in the energy norm, relative to the bending.
    jacobi_drift : ndarray (orbits,)
        Change of the Jacobi integral along the orbit, relative to the largest kinetic energy.
    """

    beam: Beam
    omega: float
    mode: int
    omega_n: float
    amplitude: FloatArray
    frequency: FloatArray
    lambda_omega: float
    lambda_omega_error: float
    harmonics: FloatArray = field(repr=False)
    residual: FloatArray = field(repr=False)
    jacobi_drift: FloatArray = field(repr=False)
    _orbits: tuple[PeriodicOrbit, ...] = field(repr=False)

    @property
    def first_harmonic(self) -> FloatArray:
        """First harmonic of q/L, (orbits,)."""
        return self.harmonics[:, 0]

    @cached_property
    def peak_time(self) -> FloatArray:
        """Time at which q is greatest [s], (orbits,); there the reduced models start theirs."""
        return np.array([orbit.peak_phase for orbit in self._orbits]) / self.frequency

    def response(self, t: ArrayLike, i: int, phase: float = 0.0) -> FloatArray:
        """Return q/L of orbit `i` at the times `t` [s], starting at `phase` [rad]."""
        times = np.asarray(t, dtype=np.float64)
        phases = self.frequency[i] * times.ravel() + phase
        return self._orbits[i].tip(phases).reshape(times.shape)

    def orbit(self, i: int, n: int = 200) -> tuple[FloatArray, FloatArray]:
        """Return x = q/L and dx/dτ, τ = t √(EI/mL³), at `n` + 1 instants of one period."""
        n = whole_number("n", n)
        orbit = self._orbits[i]
        q, q_dot, _ = orbit.coordinates(np.linspace(0.0, 2.0 * np.pi, n + 1))
        return orbit.model.tip(q).imag, orbit.model.tip_rate(q, q_dot).imag

    def state(self, i: int, x: ArrayLike, phase: float = 0.0) -> BeamState:
        """Return the state of orbit `i` at the material points `x` [m], to start a code from."""
        orbit, length = self._orbits[i], self.beam.length
        at = np.atleast_1d(np.asarray(x, dtype=np.float64)) / length
        q, q_dot, _ = (c[0] for c in orbit.coordinates(np.array([phase])))
        model, per_second = orbit.model, self.beam.frequency_scale
        slope, slope_rate = model.slope(q, at), per_second * model.slope_rate(q, q_dot, at)
        z = length * model.integrated(model.slope(q), at)
        z_dot = length * per_second * model.integrated(model.slope_rate(q, q_dot), at)
        return BeamState(
            u=z.real - length * at,
            v=z.imag,
            u_slope=slope.real - 1.0,
            v_slope=slope.imag,
            u_dot=z_dot.real,
            v_dot=z_dot.imag,
            u_slope_dot=slope_rate.real,
            v_slope_dot=slope_rate.imag,
        )

    def axis(self, i: int, x: ArrayLike, phase: ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Return where the material points `x` [m] of orbit `i` are at the phases `phase` [rad].

        Along and across the undeformed axis in the rotating frame [m], each (phases, points): the
        deflected beam, as one draws it.
        """
        orbit, length = self._orbits[i], self.beam.length
        at = np.atleast_1d(np.asarray(x, dtype=np.float64)) / length
        q, _, _ = orbit.coordinates(np.atleast_1d(np.asarray(phase, dtype=np.float64)))
        z = length * orbit.model.integrated(orbit.model.slope(q), at)
        return z.real, z.imag

    @cached_property
    def multipliers(self) -> ComplexArray:
        """Floquet multipliers (orbits, 8) of largest modulus; computed when first asked for."""
        return np.array([floquet_multipliers(orbit) for orbit in self._orbits])

    @property
    def stable(self) -> NDArray[np.bool_]:
        """Whether no Floquet multiplier lies outside the unit circle, (orbits,)."""
        return np.array([is_stable(multipliers) for multipliers in self.multipliers])

    def __str__(self) -> str:
        return (
            f"Exact backbone of mode {self.mode} at {self.omega:g} rad/s: "
            f"omega_n = {self.omega_n:.8f} rad/s, lambda_omega = {self.lambda_omega:.6f}, "
            f"{self.amplitude.size} orbits up to a = {self.amplitude.max():g}, "
            f"residual at most {self.residual.max():.1e}"
        )


def periodic_orbits(
    beam: Beam,
    omega: float,
    amplitudes: float | Sequence[float] | FloatArray,
    mode: int = 1,
    *,
    inextensible: bool = False,
    rotary_inertia: bool = False,
    functions: int = 16,
) -> Backbone:
    """Return the periodic orbits of the exact beam that grow out of one mode.

    Geometrically exact, extensible, undamped Bernoulli-Euler beam in steady rotation; harmonic
    balance in time on Legendre polynomials in space, continued in amplitude. The number of
    harmonics grows until the Jacobi integral is constant to 2e-11.

    Parameters
    ----------
    beam : Beam
    omega : float
        Rotation speed ω [rad/s].
    amplitudes : float or sequence of float
        Peak tip deflections |q|/L, above 0 and below 1, in any order.
    mode : int
        In-plane mode from which the orbits grow, from 1.
    inextensible, rotary_inertia, functions
        As for `linear_modes`.

    Raises
    ------
    ValueError
        If an argument is out of range, or the mode beyond what the functions resolve.
    RuntimeError
        If an amplitude is not reached, or an orbit's residual is not small.

    Warns
    -----
    RotbeamWarning
        Where a harmonic of an orbit comes within 2 % of another mode's frequency.
    """
    omega = rotation_speed(omega)
    mode = whole_number("mode", mode)
    asked = finite_values("amplitudes", amplitudes)
    if asked.min() <= 0.0 or asked.max() >= 1.0:
        wrong = asked.min() if asked.min() <= 0.0 else asked.max()
        raise ValueError(
            f"amplitudes must lie between 0 and 1, got {wrong:g}: they are the peak deflection "
            "of the tip over the beam's length"
        )
    warn_if_rpm(beam, omega)
    model = resolved_model(beam, mode, inextensible, rotary_inertia, functions)
    rate = steady_rate(beam, omega, model)
    modes = solve_modes(model, rate)
    resolved = modes.frequencies[: functions // 2]
    omega_n = float(modes.frequencies[mode - 1])
    small = 0.02 / mode**2
    where = f"mode {mode} at omega = {omega:g} rad/s"
    try:
        seed = solve(linear_orbit(model, rate, modes, mode, small), small)
        steady = model.split(model.steady_state(rate))[1]
        double = solve(seed.scaled(2.0 * small, steady), 2.0 * small)
    except NoOrbitError as reason:
        raise RuntimeError(
            f"no periodic orbit grows out of {where} even at a = {small:g}: {reason}; "
            "2 or 3 times its frequency may be that of another mode"
        ) from None
    near, far = ((1.0 - o.frequency / omega_n) / o.amplitude**2 for o in (seed, double))

    ascending, order = np.unique(asked, return_inverse=True)
    found: list[PeriodicOrbit] = []
    last: PeriodicOrbit = double
    before: PeriodicOrbit | None = seed
    for a in ascending:
        if a < last.amplitude:
            last, before = seed, None
        try:
            last, before = followed(last, before, float(a))
        except NoOrbitError as reason:
            raise RuntimeError(
                f"no orbit of {where} with a peak |q|/L of {a:g} was found: {reason}"
                f"{_nearest_resonance(reason.last or last, resolved, mode)}; ask for smaller "
                "amplitudes"
            ) from None
        found.append(last)
    orbits = tuple(found[k] for k in order)
    _warn_of_resonances(found, resolved, mode, beam.frequency_scale)
    count = max(orbit.harmonics for orbit in orbits)
    return Backbone(
        beam=beam,
        omega=omega,
        mode=mode,
        omega_n=float(omega_n * beam.frequency_scale),
        amplitude=asked,
        frequency=np.array([orbit.frequency for orbit in orbits]) * beam.frequency_scale,
        lambda_omega=float((4.0 * near - far) / 3.0),
        lambda_omega_error=float(abs(near - far) / 3.0),
        harmonics=np.array([np.pad(o.tip_harmonics, (0, count - o.harmonics)) for o in orbits]),
        residual=np.array([orbit.residual for orbit in orbits]),
        jacobi_drift=np.array([orbit.jacobi_drift for orbit in orbits]),
        _orbits=orbits,
    )


def _nearest_resonance(orbit: PeriodicOrbit, modes: FloatArray, mode: int) -> str:
    """Return which harmonic is nearest to another mode: the usual reason why a branch bends."""
    multiples = np.arange(2, orbit.harmonics + 1) * orbit.frequency
    distance = np.abs(multiples[:, None] / modes - 1.0)
    distance[:, mode - 1] = np.inf
    k, j = np.unravel_index(np.argmin(distance), distance.shape)
    return f" (harmonic {k + 2} is {100.0 * distance[k, j]:.1f} % from mode {j + 1} there)"


def _warn_of_resonances(
    orbits: Sequence[PeriodicOrbit], modes: FloatArray, mode: int, per_second: float
) -> None:
    """Warn once for each pair of a harmonic and another mode that come within 2 %."""
    warned: set[tuple[int, int]] = set()
    for orbit in orbits:
        sizes = np.linalg.norm(orbit.sines, axis=1) / np.linalg.norm(orbit.sines[0])
        for k in (1 + np.flatnonzero(sizes > _NOTICEABLE)).tolist():
            frequency = k * orbit.frequency
            near = np.abs(frequency / modes - 1.0) < _NEAR
            for j in (1 + np.flatnonzero(near)).tolist():
                if j == mode or (k, j) in warned:
                    continue
                warned.add((k, j))
                warnings.warn(
                    f"internal resonance: from a = {orbit.amplitude:g} on, harmonic {k} of the "
                    f"orbit of mode {mode} ({frequency * per_second:.4f} rad/s) is within 2 % of "
                    f"mode {j} ({modes[j - 1] * per_second:.4f} rad/s); the backbone may branch "
                    "there",
                    RotbeamWarning,
                    stacklevel=3,
                )
