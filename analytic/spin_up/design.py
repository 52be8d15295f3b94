"""Ramps that leave the first modes at rest: few more waves than Eq. 1, and the exact transient."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from ..arrays import ComplexArray, FloatArray
from ..beam import AnyBlade
from ..input_checks import positive, rotation_speed, whole_number
from ..lazily import linalg, optimize
from ..ramps import FourierRamp
from ..threads import one_thread
from .modes import ModesOverSpeed
from .residual import exact_residuals, modes_for, residuals

_MORE_WAVES = 4
_MOST_MODES = 20
_NEWTON_STEPS, _SETTLED, _DIFFERENCE = 20, 1e-3, 1e-6
_SOLVED = 1e-7  # of the length: what the closed form may leave
_INSTANTS = 0.5 - 0.5 * np.cos(np.pi * np.arange(1.0, 120.0) / 120.0)  # denser at both ends
_INSIDE = 3e-4  # share of the limits kept for what is between the instants
_IMPOSSIBLE = 1e-12
_WILD = 1e3  # coefficients of a ramp that goes to and fro for no use
_CORRECTIONS, _LEFT = 6, 1e-6
_LONGER, _LONGEST = 1.25, 12
"""Durations tried, for the sentence, where the one asked for is too short."""


@dataclass(frozen=True, kw_only=True)
class _Task:
    """Demands on a ramp, and the waves it may be made of.

    A_1 and B_1 follow from the sums of a `FourierRamp`; the unknowns are k² A_k, then k² B_k, of
    k = 2 and up: the smallest make a ramp with little jerk, of few waves.
    """

    beam: AnyBlade
    start: float
    omega: float
    duration: float
    modes: ModesOverSpeed = field(repr=False)
    count: int
    highest: float
    steepest: float

    @cached_property
    def order(self) -> FloatArray:
        """The k of the unknowns."""
        return np.arange(2.0, self.count + 2.0 * _MORE_WAVES + 1.0)

    @property
    def eq_1(self) -> FloatArray:
        """The unknowns of Eq. 1: all zero."""
        return np.zeros(2 * self.order.size)

    def ramp(self, y: FloatArray) -> FourierRamp:
        """Return the ramp of the unknowns `y`."""
        a, b = y.reshape(2, -1) / self.order**2
        return FourierRamp(
            start=self.start,
            omega=self.omega,
            ramp_time=self.duration,
            cosines=(-1.0 - math.fsum(a), *a),
            sines=(-float(self.order @ b), *b),
        )

    def closed_form(self, y: FloatArray) -> ComplexArray:
        """Return Z of the modes, (modes,)."""
        return residuals(self.beam, self.ramp(y), self.modes, np.array([self.duration]))[:, 0]

    def equations(self, y: FloatArray, target: ComplexArray) -> FloatArray:
        """Return the modes' distances from the target by the closed form, (2 modes,)."""
        z = self.closed_form(y) - target
        return np.concatenate((z.real, z.imag))

    def tangent(self, y: FloatArray, target: ComplexArray) -> FloatArray:
        """Return the derivatives of the equations."""
        here = self.equations(y, target)
        step = _DIFFERENCE * np.eye(y.size)
        return np.stack([self.equations(y + d, target) - here for d in step], axis=1) / _DIFFERENCE

    @cached_property
    def room(self) -> tuple[FloatArray, FloatArray]:
        """G and h of the limits, G y + h ≥ 0: rate and acceleration are linear in the unknowns."""

        def at(y: FloatArray) -> FloatArray:
            ramp, t = self.ramp(y), self.duration * _INSTANTS
            share = ramp.rate(t) / self.highest
            room = [share, 1.0 - share]
            if math.isfinite(self.steepest):
                share = ramp.acceleration(t) / self.steepest
                room += [1.0 - _INSIDE - share, 1.0 - _INSIDE + share]
            return np.concatenate(room)

        here = at(self.eq_1)
        slopes = [at(unit) - here for unit in np.eye(self.eq_1.size)]
        return np.stack(slopes, axis=1), here


@one_thread
def design_ramp(
    beam: AnyBlade,
    omega: float,
    duration: float,
    modes: int = 2,
    *,
    start: float = 0.0,
    speed_limit: float | None = None,
    acceleration_limit: float | None = None,
) -> FourierRamp:
    """Return a smooth change of the speed that leaves the first modes at rest.

    Its acceleration is a Fourier series of `modes` + 8 waves over the duration. Among the ramps
    within the limits that leave nothing by the closed form (`residual_amplitude`), it is the
    closest to Eq. 1. The amplitude that the exact transient leaves becomes the next target of the
    closed form, with its sign changed, until each mode keeps less than 1e-6 L. During the ramp the
    blade swings, in short ramps as far as without a design. The design depends on the blade: in 2 s
    to 6 rad/s an error of 1 % in its frequency leaves 2.1e-2 L instead of 3e-6 L.

    Parameters
    ----------
    beam : Beam or Blade
    omega : float
        Speed after the ramp [rad/s].
    duration : float
        T [s].
    modes : int
        Number of modes left at rest.
    start : float
        Speed before the ramp [rad/s].
    speed_limit : float, optional
        Highest speed on the way [rad/s]; the higher of `start` and `omega` if not given. The
        lowest is zero.
    acceleration_limit : float, optional
        Largest |θ̈| [rad/s²]; none if not given. That of Eq. 1 is 2(ω - ω_start)/T.

    Raises
    ------
    ValueError
        If an input is refused, or no such ramp stays within the limits.
    RuntimeError
        If the blade swings so far on the way that the exact transient does not follow.

    Examples
    --------
    >>> from analytic import Beam, design_ramp, residual_amplitude
    >>> ramp = design_ramp(Beam.reference(), omega=2.0, duration=3.0, modes=1)
    >>> print(residual_amplitude(Beam.reference(), ramp, exact=True) < 1e-4)
    True
    """
    omega, start = rotation_speed(omega), rotation_speed(start, "start")
    duration = positive("duration", duration, "s")
    modes = whole_number("modes", modes, most=_MOST_MODES)
    higher = max(omega, start)
    if omega == start:
        raise ValueError(f"omega and start are both {omega:g} rad/s: there is nothing to change")
    highest = higher if speed_limit is None else positive("speed_limit", speed_limit, "rad/s")
    if highest < higher:
        raise ValueError(
            f"speed_limit = {highest:g} rad/s is below the {higher:g} rad/s at one end of the "
            f"ramp: take that at least"
        )
    steepest = math.inf
    if acceleration_limit is not None:
        steepest = positive("acceleration_limit", acceleration_limit, "rad/s²")
        if steepest * duration <= abs(omega - start):
            raise ValueError(
                f"acceleration_limit = {steepest:g} rad/s² takes "
                f"{abs(omega - start) / steepest:.4g} s at least from {start:g} to {omega:g} "
                f"rad/s, and the duration is {duration:g} s: take a longer one"
            )
    widest = FourierRamp(start=highest, omega=omega, ramp_time=duration)
    task = _Task(
        beam=beam, start=start, omega=omega, duration=duration, count=modes, highest=highest,
        modes=modes_for(beam, widest, modes), steepest=steepest,
    )  # fmt: skip
    return _corrected(task)


def _corrected(task: _Task) -> FourierRamp:
    """Return the ramp after which the exact transient leaves nothing."""
    target, y, last = np.zeros(task.count, dtype=np.complex128), task.eq_1, math.inf
    for _ in range(_CORRECTIONS):
        found = _solved(task, y, target)
        if found is None:
            raise ValueError(_too_short(task))
        y, ramp = found, task.ramp(found)
        left = exact_residuals(task.beam, ramp, task.count)
        size = float(np.abs(left).max())
        if size < _LEFT:
            return ramp
        if size > last:
            break
        # What is small already stays as it is.
        here, last = task.closed_form(y), size
        target = here - np.where(np.abs(left) > 0.1 * _LEFT, left, 0.0)
    raise RuntimeError(
        f"on a ramp of {task.duration:g} s the blade swings so far that corrections do not settle: "
        f"{size:.1e} of its length is left; take a longer duration"
    )


def _solved(task: _Task, near: FloatArray, target: ComplexArray) -> FloatArray | None:
    """Return the unknowns closest to `near` that meet target and limits, None without any."""
    y, still = near, np.zeros(near.size)
    for _ in range(_NEWTON_STEPS):
        defect, J = task.equations(y, target), task.tangent(y, target)
        # Of all that meets the linear equations for the next y to _SOLVED, the closest: what is
        # small by itself, as of high modes, takes no effort.
        rows, sides = np.vstack((J / _SOLVED, np.eye(y.size))), (J @ (y - near) - defect) / _SOLVED
        slopes, room = task.room
        change = _closest(rows, np.append(sides, still), slopes, -room - slopes @ near)
        if change is None or np.abs(near + change).max() > _WILD:
            return None
        before, y = y, near + change
        if np.abs(y - before).max() < _SETTLED and np.abs(defect).max() < 10.0 * _SOLVED:
            break
    else:
        return None
    return y


def _closest(
    rows: FloatArray, sides: FloatArray, slopes: FloatArray, least: FloatArray
) -> FloatArray | None:
    """Return y that makes |rows y - sides| least within slopes y ≥ least, None if there is none.

    The least-distance problem of Lawson and Hanson (1974), chapter 23.
    """
    Q, R = np.linalg.qr(rows)
    free = Q.T @ sides
    slopes = linalg.solve_triangular(R, slopes.T, trans="T").T
    both = np.vstack((slopes.T, least - slopes @ free))
    unit = np.append(np.zeros(free.size), 1.0)
    rest = both @ optimize.nnls(both, unit)[0] - unit
    if abs(rest[-1]) < _IMPOSSIBLE:
        return None
    return np.asarray(linalg.solve_triangular(R, free - rest[:-1] / rest[-1]))


def _too_short(task: _Task) -> str:
    """Return the sentence on a ramp that cannot stay within its limits, with limits that work."""
    limits = f"0 to {task.highest:g} rad/s"
    if math.isfinite(task.steepest):
        limits = f"{limits} and {task.steepest:g} rad/s²"
    asked = f"no ramp of {task.duration:g} s leaves {task.count} modes at rest within {limits}"
    still = np.zeros(task.count, dtype=np.complex128)
    for n in range(1, _LONGEST):
        longer = replace(task, duration=float(f"{task.duration * _LONGER**n:.3g}"))
        if _solved(longer, longer.eq_1, still) is not None:
            return f"{asked}: take a duration of {longer.duration:g} s, or wider limits"
    return f"{asked}: take wider limits, or fewer modes"
