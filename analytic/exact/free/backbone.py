"""The exact backbone: what the periodic orbits of the exact beam at one speed answer."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...arrays import ComplexArray, FloatArray
from ...beam import AnyBlade
from ...input_checks import finite_array, finite_number, finite_values, points_of_beam, whole_number
from ...methods.floquet import Multipliers, floquet_multipliers
from ...plotting import axes_or_new, backbone_drawn
from ..beam.state import BeamState, orbit_state
from ..beam.steady import BeamOrbit

if TYPE_CHECKING:
    from ...plotting import Axes


@dataclass(frozen=True, kw_only=True)
class Backbone:
    """Periodic orbits of the exact beam at one speed; made by `periodic_orbits`.

    Time and phase start where the beam is straight and q rises, in every method.

    Attributes
    ----------
    beam : Beam or Blade
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
    frequency_error : ndarray (orbits,)
        Relative change of ω_NL under one more refinement; above 1e-9 only where refinement ended.
    residual : ndarray (orbits,)
        Largest residual of the equations of motion in the energy norm, relative to the bending.
    jacobi_drift : ndarray (orbits,)
        Change of the Jacobi integral along the orbit, relative to the largest kinetic energy.

    Examples
    --------
    >>> from analytic import Beam, periodic_orbits
    >>> amplitudes = [0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5]
    >>> found = periodic_orbits(Beam.reference(), omega=6.0, amplitudes=amplitudes)
    >>> print(f"{found.frequency[-1]:.5f} rad/s, third harmonic {found.harmonics[-1, 2]:.5f} L")
    3.71003 rad/s, third harmonic 0.00814 L
    >>> axes = found.plot()
    """

    beam: AnyBlade
    omega: float
    mode: int
    omega_n: float
    amplitude: FloatArray
    frequency: FloatArray
    lambda_omega: float
    lambda_omega_error: float
    harmonics: FloatArray = field(repr=False)
    frequency_error: FloatArray = field(repr=False)
    residual: FloatArray = field(repr=False)
    jacobi_drift: FloatArray = field(repr=False)
    _orbits: tuple[BeamOrbit, ...] = field(repr=False)

    @property
    def first_harmonic(self) -> FloatArray:
        """First harmonic of q/L, (orbits,)."""
        return self.harmonics[:, 0]

    @cached_property
    def peak_time(self) -> FloatArray:
        """Time at which q is greatest [s], (orbits,); there the reduced models start theirs."""
        return np.array([orbit.peak_phase for orbit in self._orbits]) / self.frequency

    @property
    def nondimensional(self) -> tuple[BeamOrbit, ...]:
        """The orbits as `analytic.methods` have them, in time t √(EI/mL³)."""
        return self._orbits

    def _orbit(self, i: int) -> BeamOrbit:
        count = len(self._orbits)
        if not -count <= i < count:
            raise IndexError(f"orbit {i} is none of the {count} of this backbone, 0 to {count - 1}")
        return self._orbits[i]

    def response(self, t: ArrayLike, i: int, phase: float = 0.0) -> FloatArray:
        """Return q/L of orbit `i` at the times `t` [s], starting at `phase` [rad]."""
        orbit, times = self._orbit(i), finite_array("t", t, "s")
        phases = self.frequency[i] * times.ravel() + finite_number("phase", phase, "rad")
        return orbit.gauge(phases).reshape(times.shape)

    def orbit(self, i: int, n: int = 200) -> tuple[FloatArray, FloatArray]:
        """Return x = q/L and dx/dτ, τ = t √(EI/mL³), each (n,), once around orbit `i`.

        Equally spaced in time; the last point is the first.
        """
        n = whole_number("n", n, least=2)
        orbit = self._orbit(i)
        q, q_dot, _ = orbit.coordinates(np.linspace(0.0, 2.0 * np.pi, n))
        return orbit.system.gauge(q), orbit.system.gauge_rate(q, q_dot)

    def state(self, i: int, x: ArrayLike, phase: float = 0.0) -> BeamState:
        """Return the state of orbit `i` at the material points `x` [m], to start a code from.

        Points beyond the beam, from 0 to L, are refused.
        """
        return orbit_state(self.beam, self._orbit(i), x, phase)

    def axis(self, i: int, x: ArrayLike, phase: ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Return where the material points `x` [m] of orbit `i` are at the phases `phase` [rad].

        Along and across the undeformed axis in the rotating frame [m], each (phases, points): the
        deflected beam, as one draws it.
        """
        orbit, length = self._orbit(i), self.beam.length
        at = points_of_beam("x", x, length)
        q, _, _ = orbit.coordinates(finite_values("phase", phase, "rad"))
        z = length * orbit.system.model.integrated(orbit.system.model.slope(q), at)
        return z.real, z.imag

    @cached_property
    def _stability(self) -> tuple[Multipliers, ...]:
        return tuple(floquet_multipliers(orbit) for orbit in self._orbits)

    @property
    def multipliers(self) -> ComplexArray:
        """Floquet multipliers (orbits, 8) of the lowest four modes; the first two are 1.

        Computed when first asked for.
        """
        return np.array([found.lowest for found in self._stability])

    @property
    def stable(self) -> NDArray[np.bool_]:
        """Whether the orbits are stable against small disturbances in the plane, (orbits,).

        No Floquet multiplier lies outside the unit circle, of as many modes as `stable_modes`
        says: those that the integration over a period resolves. Of motion out of the plane
        `out_of_plane` and `planar_stability` tell.
        """
        return np.array([found.stable() for found in self._stability])

    @property
    def stable_modes(self) -> NDArray[np.int_]:
        """How many modes `stable` covers, the lowest, (orbits,)."""
        return np.array([found.modes for found in self._stability])

    @cached_property
    def out_of_plane(self) -> str:
        """One sentence if the largest orbit leaves the plane of rotation, "" if not.

        "" too of a blade whose section out of the plane is unknown; computed when first asked for.
        """
        from ..plane.orbit_growth import planar_note  # noqa: PLC0415  (a study, when it is asked for)

        return planar_note(self.beam, self.omega, float(self.amplitude.max()), self.mode)

    def plot(self, ax: Axes | None = None, **line: Any) -> Axes:
        """Draw the peak amplitude over the frequency, from ω_n on, and return the axes.

        Dots are the orbits; between them is a cubic in a², which leaves ω_n by λ_ω.

        Parameters
        ----------
        ax : Axes, optional
            Drawn on these; otherwise on a new figure.
        **line
            As for matplotlib's `Axes.plot`, such as color and label; a marker is the orbits'.

        Examples
        --------
        >>> from analytic import Beam, periodic_orbits
        >>> ax = periodic_orbits(Beam.reference(), 6.0, [0.1, 0.2, 0.3]).plot()
        """
        ax = axes_or_new(ax)
        mode = "" if self.mode == 1 else f", mode {self.mode}"
        frequency = np.append(self.omega_n, self.frequency)
        amplitude = np.append(0.0, self.amplitude)
        marker = line.pop("marker", ".")
        (curve,) = ax.plot(
            *backbone_drawn(frequency, amplitude, -self.lambda_omega * self.omega_n),
            **{"label": f"ω = {self.omega:g} rad/s{mode}", **line},
        )
        ax.plot(frequency, amplitude, ls="none", marker=marker, color=curve.get_color())
        ax.set(xlabel="frequency $ω_{NL}$ [rad/s]", ylabel="peak |q|/L")
        ax.set_ylim(bottom=0.0, auto=None)  # a second backbone may be higher
        ax.legend()
        return ax

    def __str__(self) -> str:
        return (
            f"Exact backbone of mode {self.mode} at {self.omega:g} rad/s: "
            f"ω_n = {self.omega_n:.8f} rad/s, λ_ω = {self.lambda_omega:.6f}, "
            f"{self.amplitude.size} orbits up to a = {self.amplitude.max():g}, "
            f"which refinement changes by at most {self.frequency_error.max():.0e}"
        )
