"""Stability of planar motion in its plane, by Floquet multipliers out of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...arrays import ComplexArray, FloatArray
from ...beam import AnyBlade, require_out_of_plane, undamped
from ...input_checks import not_negative, rotation_speed
from ...methods.newton import NoOrbitError
from ...theory import BERNOULLI_EULER, Theory
from ...threads import one_thread
from ..free.backbone import periodic_orbits
from ..free.branch import OrbitSet
from .growth import grown_and_checked, lag_mode, planar_orbits


@one_thread
def growth_rates(
    blade: AnyBlade, omega: float, amplitudes: FloatArray, damping: float = 0.0
) -> FloatArray:
    """Return the growth rates [1/s] about orbits of the first mode, zero where stable.

    With a damping ratio of the modes out of the plane, the least decay rates, below zero. On as
    many functions and steps as `planar_stability` begins with, for maps; NaN from the first
    amplitude on that no orbit was found for.
    """
    require_out_of_plane(blade)
    orbits = planar_orbits(blade, rotation_speed(omega), damping=damping)
    rates = np.full(amplitudes.size, np.nan)
    for k, a in enumerate(amplitudes.tolist()):
        try:
            frequency = orbits.path.at(a).frequency * blade.frequency_scale
        except NoOrbitError:
            break
        found = orbits.growth(a)
        decays = damping and not found.unstable
        rates[k] = found.exponent * frequency / (2.0 * np.pi) if decays else found.rate(frequency)
    return rates


@dataclass(frozen=True, kw_only=True)
class GrowthOutOfPlane:
    """Growth out of their plane about planar orbits, free or of a response to a load.

    Attributes
    ----------
    amplitude : ndarray (orbits,)
        Peak |q|/L of the planar orbits.
    frequency : ndarray (orbits,)
        Their frequency [rad/s].
    multipliers : ndarray (orbits, 8)
        Floquet multipliers over a period of the orbit, with the motion in the lowest modes.
    growth_rate : ndarray (orbits,)
        Of the fastest growth [1/s], zero where nothing grows.
    kind : tuple of str
        How it grows: "period doubling", multiplier below -1; "divergence", above 1; "sum
        resonance", a complex pair; "" where nothing grows.
    modes : tuple of tuple of str
        The modes that hold its energy as the blade passes its straight shape, as "flap 1".
    converged : ndarray (orbits,)
        Whether on half, or two thirds, as many functions and steps it is stable as well, or grows
        within 1 % as fast.

    Examples
    --------
    >>> from analytic import Beam, Damping, TipForce, forced_response
    >>> blade = Beam.reference().with_section_out_of_plane(0.01, 0.02)
    >>> blade = blade.with_damping(Damping(bending=0.01))
    >>> found = forced_response(blade, 2.0, TipForce(amplitude=0.1), [2.4, 2.5], functions=8)
    >>> print(found.out_of_plane(confirm=False))
    The response stays in its plane, up to a = 0.01039
    """

    amplitude: FloatArray
    frequency: FloatArray
    multipliers: ComplexArray = field(repr=False)
    growth_rate: FloatArray
    kind: tuple[str, ...]
    modes: tuple[tuple[str, ...], ...]
    converged: NDArray[np.bool_]

    @property
    def stable(self) -> NDArray[np.bool_]:
        """Whether nothing grows out of the plane, (orbits,)."""
        return np.asarray(self.growth_rate == 0.0)

    def _how(self, i: int) -> str:
        """Return how orbit `i` leaves its plane."""
        return (
            f"its plane: {self.kind[i]} of {' and '.join(self.modes[i])}, growing at "
            f"{self.growth_rate[i]:.3g} 1/s"
        )

    def __str__(self) -> str:
        if self.stable.all():
            return f"The response stays in its plane, up to a = {self.amplitude.max():.4g}"
        first = int(np.argmin(np.where(self.stable, np.inf, self.amplitude)))
        return (
            f"The response leaves its plane at {np.sum(~self.stable)} of {self.stable.size} "
            f"points; the least, a = {self.amplitude[first]:.4g} at {self.frequency[first]:.6g} "
            f"rad/s, leaves {self._how(first)}"
        )


@dataclass(frozen=True, kw_only=True)
class PlanarStability(GrowthOutOfPlane):
    """Stability of periodic orbits against motion out of their plane; see `planar_stability`.

    Attributes
    ----------
    blade, omega, mode, theory : as given
    """

    blade: AnyBlade
    omega: float
    mode: str
    theory: Theory

    def __str__(self) -> str:
        unstable = ~self.stable
        if not unstable.any():
            return (
                f"The planar orbits at {self.omega:g} rad/s stay in their plane, "
                f"{self.amplitude.size} up to a = {self.amplitude.max():g}"
            )
        first = int(np.flatnonzero(unstable)[np.argmin(self.amplitude[unstable])])
        return (
            f"The planar orbit at {self.omega:g} rad/s with a = {self.amplitude[first]:g} leaves "
            f"{self._how(first)}"
        )


@one_thread
def planar_stability(
    blade: AnyBlade,
    omega: float,
    amplitudes: float | Sequence[float] | FloatArray,
    mode: str | int = "lag 1",
    *,
    damping: float = 0.0,
    theory: Theory = BERNOULLI_EULER,
) -> PlanarStability:
    """Return whether the planar orbits of a blade stay in the plane of rotation.

    Small motion out of the plane about an orbit of `periodic_orbits` obeys a Hill equation, which
    is integrated over a period by Gauss's method. Modes up to 48 times the frequency of the orbit
    are resolved; those beyond follow, or oscillate too fast to be excited.

    Free orbits are undamped, for damped motion is not periodic. What leaves their plane is damped:
    by the blade's own `Damping`, of flap and torsion, and by `damping`.

    Parameters
    ----------
    blade : Blade
        With a section out of the plane, of setting angle zero.
    omega : float
        Rotation speed ω [rad/s].
    amplitudes : float or sequence of float
        Peak tip deflections |q|/L of the orbits.
    mode : str or int
        Mode of lag from which they grow, as of `backbone`.
    damping : float
        Damping ratio ζ of every mode of flap and torsion of the straight blade in rotation.
    theory : Theory
        Of the orbits, without shear: slices do not shear out of the plane.

    Raises
    ------
    ValueError
        If the section out of the plane is unknown, or its torsion where that decides; if twist has
        no inertia; if the blade turns so fast that its flap modes are not resolved.
    AmplitudeNotReachedError
        If an orbit does not exist, as in `periodic_orbits`.

    Examples
    --------
    >>> from analytic import Beam, Rectangle, planar_stability
    >>> strip = Beam.reference().with_shape(Rectangle())
    >>> found = planar_stability(strip, 4.0, amplitudes=[0.01, 0.2])
    >>> print(found.stable, found.kind, found.growth_rate.round(1))
    [ True False] ('', 'divergence') [  0.  120.9]
    """
    require_out_of_plane(blade, theory)
    ratio = not_negative("damping", damping)
    free = undamped(blade)
    name = lag_mode(free, omega, mode, theory)
    orbits = periodic_orbits(
        free, omega, amplitudes, name, theory=theory, functions=max(16, 2 * int(name.split()[1]))
    )
    found = grown_about(blade, orbits, theory, ratio)
    return PlanarStability(
        blade=blade, omega=orbits.omega, mode=orbits.mode, theory=theory, **found
    )


def grown_about(
    blade: AnyBlade, orbits: OrbitSet, theory: Theory, ratio: float, confirm: bool = True
) -> dict[str, Any]:
    """Return the attributes of `GrowthOutOfPlane` about planar orbits."""
    how = (theory, ratio, confirm)
    found = [grown_and_checked(blade, orbit, *how) for orbit in orbits.nondimensional]
    rates = [growth.rate(f) for (growth, _), f in zip(found, orbits.frequency, strict=True)]
    return {
        "amplitude": orbits.amplitude,
        "frequency": orbits.frequency,
        "multipliers": np.array([growth.multipliers for growth, _ in found]),
        "growth_rate": np.array(rates),
        "kind": tuple(growth.kind for growth, _ in found),
        "modes": tuple(growth.modes for growth, _ in found),
        "converged": np.array([converged for _, converged in found]),
    }
