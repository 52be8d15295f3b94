"""The ramp times of Eq. 1 with almost no residual vibration, refined on the exact transient."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..blade import Blade
from ..blade_checks import require_blade
from ..input_checks import positive, rotation_speed
from ..lazily import optimize, signal
from ..motion import SpinUp
from ..theory import BERNOULLI_EULER, Theory, require_theory
from ..threads import one_thread
from .modes_over_speed import ModesOverSpeed, excited_mode
from .residual import exact_residuals, modes_for, residuals

_A_PERIOD = 40  # ramp times tried by the formula
_PERIODS = 5.0
_REFINEMENTS, _SETTLED = 6, 1e-4
"""And the share of a period by which the last one moves the minimum at most."""
_PRECISE = 1e-8 * _A_PERIOD  # of the spacing, of which a period has so many


@dataclass(frozen=True, kw_only=True)
class QuietRamps:
    """Ramp times of Eq. 1 at which less is left than at those around; from `quiet_ramp_times`.

    Attributes
    ----------
    blade : Blade
    omega : float
        Speed after the ramp [rad/s].
    mode : str
        Name of the mode.
    ramp_times : ndarray (count,)
        Ascending [s].
    left : ndarray (count,)
        Amplitude of the tip in the mode over L after the exact transient [-].
    linear : ndarray (count,)
        The same by the closed form.
    """

    blade: Blade
    omega: float
    mode: str
    ramp_times: FloatArray
    left: FloatArray
    linear: FloatArray


@one_thread
def quiet_ramp_times(
    blade: Blade,
    omega: float,
    *,
    mode: str | int = "lag 1",
    theory: Theory = BERNOULLI_EULER,
    shortest: float | None = None,
    longest: float | None = None,
    tolerance: float = 1e-6,
    progress: Callable[[int, int], None] | None = None,
) -> QuietRamps:
    """Return the ramp times of Eq. 1 up to `longest` at which the least is left.

    They lie near whole numbers of periods, two at least, of the natural frequency averaged over
    the ramp. The closed form finds them to a hundredth of a period, the exact transient the rest.

    Parameters
    ----------
    blade : Blade
    omega : float
        Speed after the ramp [rad/s].
    mode, theory
        As for `residual_amplitude`.
    shortest : float, optional
        Shortest ramp time [s]; half a period of the blade at rest if not given.
    longest : float, optional
        Longest ramp time [s]; five periods of the blade at rest if not given.
    tolerance : float
        Of the exact transients, relative to the largest deflection.
    progress : callable, optional
        Called with the ramp times found and their number.

    Raises
    ------
    ValueError
        If an input is refused, or no speed leaves anything.

    Examples
    --------
    >>> from analytic import Beam, quiet_ramp_times
    >>> found = quiet_ramp_times(Beam.reference(), omega=2.0, longest=5.0, tolerance=1e-4)
    >>> print(found.ramp_times.round(2), "s leave", found.left.round(4), "L")
    [4.3] s leave [0.0069] L
    """
    require_blade(blade)
    omega, period = rotation_speed(omega), 2.0 * math.pi / blade.omega_0
    if omega == 0.0:
        raise ValueError("omega = 0 rad/s has no residual at any ramp time: take a higher speed")
    longest = _PERIODS * period if longest is None else positive("longest", longest, "s")
    shortest = 0.5 * period if shortest is None else positive("shortest", shortest, "s")
    unit = SpinUp(omega=omega, ramp_time=longest)
    names = (excited_mode(blade, omega, mode, require_theory(theory)),)
    modes = modes_for(blade, unit, theory, names)
    frequency = modes.at(np.array([omega / blade.frequency_scale])).frequency[0, 0]
    spacing = 2.0 * math.pi / (_A_PERIOD * frequency * blade.frequency_scale)
    tried = np.arange(shortest, longest + spacing, spacing)
    sizes = np.abs(residuals(blade, unit, modes, tried)[0])
    candidates, minima = [], tried[signal.argrelmin(sizes)[0]]
    for T in minima.tolist():
        candidates.append(_refined(blade, unit, names, theory, modes, T, spacing, tolerance))
        if progress is not None:
            progress(len(candidates), minima.size)
    ramp_times, left = np.array([one for one in candidates if one[0] <= longest]).reshape(-1, 2).T
    return QuietRamps(
        blade=blade,
        omega=omega,
        mode=names[0],
        ramp_times=ramp_times,
        left=left,
        linear=np.abs(residuals(blade, unit, modes, ramp_times)[0]),
    )


def _refined(
    blade: Blade,
    ramp: SpinUp,
    names: tuple[str, ...],
    theory: Theory,
    modes: ModesOverSpeed,
    T: float,
    spacing: float,
    tolerance: float,
) -> tuple[float, float]:
    """Return the ramp time near `T` at which the exact transient leaves the least, and what.

    The error of the closed form changes slowly with the ramp time: a straight line through its last
    two values corrects it.
    """

    def form(at: float) -> complex:
        return complex(residuals(blade, ramp, modes, np.array([at]))[0, 0])

    def lacking(at: float) -> complex:
        spin_up = SpinUp(omega=ramp.omega, ramp_time=at)
        return complex(exact_residuals(blade, spin_up, names, theory, tolerance)[0][0]) - form(at)

    def left(at: float, T: float, lack: complex, slope: complex) -> float:
        return abs(form(at) + lack + slope * (at - T)) ** 2

    # Two from the start: without a slope a minimum that is there by chance would be believed.
    lack, aside = lacking(T), 0.5 * spacing
    slope = (lacking(T + aside) - lack) / aside
    for _ in range(_REFINEMENTS):
        least = optimize.minimize_scalar(
            left,
            args=(T, lack, slope),
            bounds=(T - 2.0 * spacing, T + 2.0 * spacing),
            options={"xatol": _PRECISE * spacing},
        )
        moved = float(least.x) - T
        if abs(moved) <= _SETTLED * _A_PERIOD * spacing:
            break
        before, lack, T = lack, lacking(T + moved), T + moved
        slope = (lack - before) / moved
    return T, abs(form(T) + lack)
