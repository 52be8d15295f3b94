"""The exact backbone over speed too: curves at some speeds, and polynomials of ω² between them.

A global polynomial in ω would carry one internal resonance into every speed. So each answer comes
from the few curves next to it, and where they differ, or one of them ends, the map says so.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.polynomial import Chebyshev
from numpy.typing import ArrayLike, NDArray

from ..arrays import FloatArray
from ..beam import AnyBlade, require_undamped, warn_if_rpm
from ..input_checks import (
    finite_array,
    finite_values,
    peak_deflection,
    positive,
    rotation_speed,
    shown,
    whole_number,
)
from ..threads import one_thread
from .backbone_series import BackboneCurve, in_powers, in_square
from .branch import AmplitudeNotReachedError, branch_of
from .curve import care_for, fitted_curve
from .modes import resolved_model

_POINTS = 8  # curves that an answer comes from
_COEFFICIENTS = 10
_LOOKS = 25  # amplitudes at which the map is compared with what fewer curves say


@dataclass(frozen=True, kw_only=True, eq=False)
class BackboneMap:
    """The exact backbone over speed and amplitude; made by `backbone_map`.

    Attributes
    ----------
    beam : Beam or Blade
    mode : int
        From 1.
    tolerance : float
        Of ω_NL/ω_n, within which the map holds.
    up_to : float
        Largest peak |q|/L.
    speeds : ndarray (speeds,)
        Of the curves [rad/s], ascending.
    omega_n : ndarray (speeds,)
        [rad/s].
    reach : ndarray (speeds,)
        Peak |q|/L up to which each curve holds; 0 where there is none.
    series, first : ndarray (speeds, coefficients)
        Of powers of a², of ω_NL/ω_n and of the first harmonic over the peak.
    cell_reach : ndarray (speeds - 1,)
        Peak |q|/L up to which the map holds between one speed and the next.

    Examples
    --------
    >>> from analytic import Beam, backbone_map
    >>> found = backbone_map(Beam.reference(), (5.5, 6.5), up_to=0.3, speeds=8)
    >>> print(found.frequency([[5.6], [6.4]], [0.1, 0.2, 0.3]).round(5))
    [[3.65077 3.64874 3.64527]
     [3.80878 3.80635 3.80216]]
    >>> print(found.holds(6.0, 0.3))
    True
    """

    beam: AnyBlade
    mode: int
    tolerance: float
    up_to: float
    speeds: FloatArray
    omega_n: FloatArray
    reach: FloatArray
    series: FloatArray = field(repr=False)
    first: FloatArray = field(repr=False)
    cell_reach: FloatArray = field(repr=False)

    def frequency(self, omega: ArrayLike, a: ArrayLike) -> FloatArray:
        """Return ω_NL [rad/s] at speeds [rad/s] and peaks |q|/L, which broadcast.

        NaN where the map does not hold, as `holds` says.

        Raises
        ------
        ValueError
            If a speed is none of the map's, or an amplitude negative or above `up_to`.
        """
        return self._answer(omega, a, self.omega_n[:, None] * self.series)

    def first_harmonic(self, omega: ArrayLike, a: ArrayLike) -> FloatArray:
        """Return the first harmonic of q/L; all else is as for `frequency`."""
        share: FloatArray = self._answer(omega, a, self.first)
        return np.asarray(share * finite_array("amplitude", a))[()]

    def linear_frequency(self, omega: ArrayLike) -> FloatArray:
        """Return ω_n [rad/s], of the shape of `omega`."""
        return self._answer(omega, 0.0, self.omega_n[:, None])

    def holds(self, omega: ArrayLike, a: ArrayLike) -> NDArray[np.bool_]:
        """Return whether the map holds, of the shape to which both broadcast."""
        speed, amplitude = self._within(omega, a)
        return np.asarray(amplitude <= self.cell_reach[self._cell(speed)] * (1.0 + 1e-12))

    def _cell(self, speed: FloatArray) -> NDArray[np.intp]:
        return np.clip(np.searchsorted(self.speeds, speed, "right") - 1, 0, self.speeds.size - 2)

    def _within(self, omega: ArrayLike, a: ArrayLike) -> tuple[FloatArray, FloatArray]:
        speed, amplitude = finite_array("omega", omega, "rad/s"), finite_array("amplitude", a)
        for name, unit, values, low, high in (
            ("omega", " rad/s", speed, self.speeds[0], self.speeds[-1]),
            ("amplitude", "", amplitude, 0.0, self.up_to),
        ):
            least, most = values.min(initial=low), values.max(initial=low)
            if least < low - 1e-12 or most > high + 1e-12:
                wrong = least if least < low - 1e-12 else most
                raise ValueError(
                    f"the map is for {name} from {low:g} to {high:g}{unit}, got {wrong:g}{unit}; "
                    f"make one for more by backbone_map"
                )
        return tuple(np.broadcast_arrays(speed, amplitude))  # type: ignore[return-value]

    def _answer(self, omega: ArrayLike, a: ArrayLike, powers: FloatArray) -> FloatArray:
        speed, amplitude = self._within(omega, a)
        result = np.full(speed.shape, np.nan)
        cells = self._cell(speed)
        held = amplitude <= self.cell_reach[cells] * (1.0 + 1e-12)
        for cell in np.unique(cells[held]).tolist():
            here = held & (cells == cell)
            result[here] = _between(
                self.speeds, powers, nearest(cell, self.speeds.size), speed[here], amplitude[here]
            )
        return result[()]

    def __str__(self) -> str:
        least = int(np.argmin(self.cell_reach))
        ends = "everywhere" if self.cell_reach[least] >= self.up_to else (
            f"up to a = {self.cell_reach[least]:.3g} at the least, between "
            f"{self.speeds[least]:g} and {self.speeds[least + 1]:g} rad/s"
        )  # fmt: skip
        return (
            f"Exact backbones of mode {self.mode} from {self.speeds[0]:g} to {self.speeds[-1]:g} "
            f"rad/s up to a = {self.up_to:g}, {self.speeds.size} curves: holds to "
            f"{self.tolerance:g} {ends}"
        )


def nearest(cell: int, count: int, points: int = _POINTS) -> slice:
    """Return which curves an answer between curve `cell` and the next comes from."""
    points = min(points, count)
    start = min(max(cell + 1 - points // 2, 0), count - points)
    return slice(start, start + points)


def _between(
    speeds: FloatArray, powers: FloatArray, which: slice, speed: FloatArray, a: FloatArray
) -> FloatArray:
    """Return the answers of some curves, by the polynomial of ω² through them."""
    nodes, at = speeds[which] ** 2, speed**2
    total = np.zeros_like(at)
    for i, row in enumerate(powers[which]):
        others = np.delete(nodes, i)
        weight = np.prod((at[:, None] - others) / (nodes[i] - others), axis=1)
        total += weight * in_square(row, a)
    return total


@one_thread
def backbone_map(
    beam: AnyBlade,
    omegas: tuple[float, float] = (0.0, 10.0),
    up_to: float = 0.6,
    mode: int = 1,
    *,
    speeds: int = 33,
    tolerance: float = 1e-6,
    inextensible: bool = False,
    functions: int = 16,
    progress: Callable[[int, int], None] | None = None,
) -> BackboneMap:
    """Return the exact backbone of a mode over speed and amplitude.

    Series as of `backbone_curve` at speeds that lie evenly, and polynomials of ω² through eight of
    them; how far that holds is judged between the speeds, by what six of the eight say.

    Parameters
    ----------
    beam : Beam or Blade
        Without damping.
    omegas : tuple of two floats
        Lowest and highest speed [rad/s].
    up_to : float
        Largest peak |q|/L asked for, below 1.
    mode, inextensible, functions
        As for `periodic_orbits`.
    speeds : int
        How many curves; at least 8.
    tolerance : float
        Of ω_NL/ω_n; at least 1e-9.
    progress : callable, optional
        Called with the number of curves done, and of all.

    Raises
    ------
    ValueError
        If an argument is refused.

    Examples
    --------
    >>> from analytic import Beam, backbone_map
    >>> found = backbone_map(Beam.reference(), (5.5, 6.5), up_to=0.3, speeds=8)
    >>> round(float(found.frequency(6.0, 0.3)), 5)
    3.72357
    """
    ends = finite_values("omegas", omegas, "rad/s").tolist()
    if len(ends) != 2 or not ends[0] < ends[1]:
        raise ValueError(f"omegas must be the lowest and the highest speed, got {shown(ends)}")
    low, high = (rotation_speed(omega, "omegas") for omega in ends)
    up_to = peak_deflection("up_to", up_to)
    count, mode = whole_number("speeds", speeds, least=_POINTS), whole_number("mode", mode)
    if positive("tolerance", tolerance) < 1e-9:
        raise ValueError(f"tolerance must be at least 1e-9, got {tolerance:g}")
    warn_if_rpm(beam, high)
    require_undamped(beam, "a damped blade has no free periodic orbits")
    model = resolved_model(beam, mode, inextensible, False, functions)
    at = np.linspace(low, high, count)
    curves: list[BackboneCurve | None] = []
    for omega in at.tolist():
        try:
            branch = branch_of(beam, omega, mode, model, care_for(0.3 * tolerance))
            curves.append(fitted_curve(branch, up_to, _COEFFICIENTS, 0.3 * tolerance))
        except AmplitudeNotReachedError:
            curves.append(None)
        if progress is not None:
            progress(len(curves), count)
    return _of_curves(beam, mode, tolerance, up_to, at, curves)


def _of_curves(
    beam: AnyBlade,
    mode: int,
    tolerance: float,
    up_to: float,
    speeds: FloatArray,
    curves: list[BackboneCurve | None],
) -> BackboneMap:
    none = Chebyshev(np.zeros(_COEFFICIENTS))
    series, first = (
        np.array([in_powers(getattr(curve, name, none)) for curve in curves])
        for name in ("series", "first")
    )
    omega_n = np.array([curve.omega_n if curve else 0.0 for curve in curves])
    reach = np.array([curve.holds_up_to if curve else 0.0 for curve in curves])
    cells = range(speeds.size - 1)
    cell_reach = [
        _held(speeds, omega_n[:, None] * series, reach, cell, up_to, tolerance) for cell in cells
    ]
    return BackboneMap(
        beam=beam,
        mode=mode,
        tolerance=tolerance,
        up_to=up_to,
        speeds=speeds,
        omega_n=omega_n,
        reach=reach,
        series=series,
        first=first,
        cell_reach=np.array(cell_reach),
    )


def _held(
    speeds: FloatArray,
    powers: FloatArray,
    reach: FloatArray,
    cell: int,
    up_to: float,
    tolerance: float,
) -> float:
    """Return the amplitude up to which all curves hold, and fewer of them say the same."""
    which = nearest(cell, speeds.size)
    fewer = nearest(cell, speeds.size, _POINTS - 2)
    a = np.linspace(0.0, min(up_to, float(reach[which].min())), _LOOKS)
    if a[-1] == 0.0:
        return 0.0
    amid = np.full(_LOOKS, 0.5 * (speeds[cell] + speeds[cell + 1]))
    all_say, fewer_say = (_between(speeds, powers, some, amid, a) for some in (which, fewer))
    # Two curves more gain far more than a factor of two.
    wrong = np.flatnonzero(np.abs(all_say / fewer_say - 1.0) > tolerance)
    if wrong.size == 0:
        return float(a[-1])
    return float(a[wrong[0] - 1]) if wrong[0] else 0.0
