"""Free periodic orbits of the exact beam by their amplitudes: found, and as a value."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import FloatArray
from ...input_checks import finite_array, finite_number, finite_values
from ...methods.newton import NoOrbitError
from ...plotting import axes_or_new, backbone_drawn
from ..continuum.rotation import BladeOrbit
from .branch import OrbitSet
from .internal_resonance import FOLLOWED, nearest_resonance, prominent_harmonics, warn_of_resonances
from .path import AmplitudeNotReachedError, ModePath

if TYPE_CHECKING:
    from ...plotting import Axes

_RELAID = 3  # times, each on half as many functions again


@dataclass(frozen=True, kw_only=True)
class Orbits(OrbitSet):
    """Free periodic orbits of the exact beam at one speed; made by `periodic_orbits`.

    Time and phase start where the beam is straight and q rises, in every method. Of a blade in
    space q is the gauge, the tip's place along lag or flap less that of the steady state.

    Attributes
    ----------
    beam, omega, mode, theory : as given
    omega_n : float
        Its linear frequency ω_n [rad/s].
    amplitude : ndarray (orbits,)
        Peak |q|/L.
    frequency : ndarray (orbits,)
        ω_NL [rad/s].
    lambda_omega : float
        λ_ω of ω_NL = ω_n (1 - λ_ω a²) as a → 0.
    lambda_omega_error : float
        Change by the extrapolation to a = 0: an upper estimate of its error.
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

    omega_n: float
    lambda_omega: float
    lambda_omega_error: float
    harmonics: FloatArray = field(repr=False)
    frequency_error: FloatArray = field(repr=False)
    residual: FloatArray = field(repr=False)
    jacobi_drift: FloatArray = field(repr=False)

    @property
    def first_harmonic(self) -> FloatArray:
        """First harmonic of q/L, (orbits,)."""
        return self.harmonics[:, 0]

    @cached_property
    def peak_time(self) -> FloatArray:
        """Time at which q is greatest [s], (orbits,); there the reduced models start theirs."""
        return np.array([orbit.peak_phase for orbit in self.nondimensional]) / self.frequency

    def response(self, t: ArrayLike, i: int, phase: float = 0.0) -> FloatArray:
        """Return q/L of orbit `i` at the times `t` [s], starting at `phase` [rad]."""
        orbit, times = self._orbit(i), finite_array("t", t, "s")
        phases = self.frequency[i] * times.ravel() + finite_number("phase", phase, "rad")
        return orbit.gauge(phases).reshape(times.shape)

    def plot(self, ax: Axes | None = None, **line: Any) -> Axes:
        """Draw the peak amplitude over the frequency, from ω_n on, and return the axes.

        Dots are the orbits; between them is a cubic in a², which leaves ω_n by λ_ω.

        Parameters
        ----------
        ax : Axes, optional
            Drawn on these; otherwise on a new figure.
        **line
            As for matplotlib's `Axes.plot`, such as color and label; a marker is the orbits'.
        """
        ax = axes_or_new(ax)
        mode = "" if self.mode == "lag 1" else f", {self.mode}"
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
            f"Exact backbone of {self.mode} at {self.omega:g} rad/s: "
            f"ω_n = {self.omega_n:.8f} rad/s, λ_ω = {self.lambda_omega:.6f}, "
            f"{self.amplitude.size} orbits up to a = {self.amplitude.max():g}, "
            f"which refinement changes by at most {self.frequency_error.max():.0e}"
        )


def orbits_of(of: ModePath, amplitudes: ArrayLike) -> Orbits:
    """Return the orbits of a backbone, as `periodic_orbits` says."""
    sizes = finite_values("amplitudes", amplitudes)
    if sizes.min() <= 0.0 or sizes.max() >= 1.0:
        wrong = sizes.min() if sizes.min() <= 0.0 else sizes.max()
        raise ValueError(
            f"amplitudes must lie between 0 and 1, got {wrong:g}: they are the peak deflection "
            "of the tip over the beam's length"
        )
    ascending, place = np.unique(sizes, return_inverse=True)
    by_amplitude, refused = _followed(of, ascending)
    by_amplitude = _confirmed(of, by_amplitude)
    warn_of_resonances(of, by_amplitude.values())
    kept = [by_amplitude[a] for a in ascending[place].tolist() if a in by_amplitude]
    orbits = _packed(of, kept) if kept else None
    if orbits is None or refused:
        raise AmplitudeNotReachedError(refused, orbits)
    return orbits


def _followed(of: ModePath, ascending: FloatArray) -> tuple[dict[float, BladeOrbit], str]:
    """Return the orbits found by their amplitudes, and what to say of the first that was not."""
    orbits: dict[float, BladeOrbit] = {}
    refused = ""
    for a in ascending.tolist():
        try:
            orbits[a] = of.path.at(a)
        except NoOrbitError as reason:
            refused = refused or (
                f"no orbit of {of.name} with a peak |q|/L of {a:g} was found: {reason}{_why(of, a)}"
            )
    return orbits, refused


def _confirmed(of: ModePath, orbits: dict[float, BladeOrbit]) -> dict[float, BladeOrbit]:
    """Return the orbits; of those near a resonance, where several have one amplitude, confirmed.

    The branch is computed again on more functions, which may lead into another orbit, until that
    changes no frequency. The last change is the error.
    """
    suspects = list(orbits)
    for _ in range(_RELAID):
        suspects = [a for a in suspects if prominent_harmonics(of, orbits[a])]
        if not suspects:
            break
        of = replace(of, model=of.path.seed.system.refined().model)
        finer, _ = _followed(of, np.sort(suspects))
        changing = []
        for a in suspects:
            one = finer.get(a, orbits[a])
            change = abs(one.frequency / orbits[a].frequency - 1.0) if a in finer else math.inf
            orbits[a] = replace(one, frequency_error=max(one.frequency_error, change))
            if change > of.care.change:
                changing.append(a)
        suspects = changing
    return orbits


def _why(of: ModePath, a: float) -> str:
    """Return what stands in the way of an orbit, and what to try."""
    if a < of.path.seed.amplitude:
        return (
            "; round-off drowns so small an orbit, so take linear_modes, from which it differs by "
            "the square of its amplitude"
        )
    nodes = of.path.nodes
    below = [orbit for orbit in nodes if orbit.amplitude <= a]
    nearest = nearest_resonance(of, below)
    if below[-1] is nodes[-1]:
        return f"{nearest}; ask for smaller amplitudes"
    return f"{nearest}; ask for amplitudes beyond it, or {FOLLOWED}"


def _packed(of: ModePath, orbits: list[BladeOrbit]) -> Orbits:
    """Return the orbits as a value."""
    softening, error = of.softening()
    count = max(orbit.harmonics for orbit in orbits)
    return Orbits(
        **Orbits.common_fields(of.blade, of.theory, orbits),
        omega=of.omega,
        mode=of.mode,
        omega_n=of.omega_n,
        lambda_omega=softening,
        lambda_omega_error=error,
        harmonics=np.array([np.pad(o.gauge_sines, (0, count - o.harmonics)) for o in orbits]),
        frequency_error=np.array([orbit.frequency_error for orbit in orbits]),
        residual=np.array([orbit.residual for orbit in orbits]),
        jacobi_drift=np.array([orbit.invariant_drift for orbit in orbits]),
    )
