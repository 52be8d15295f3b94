"""Ramps that leave the first modes at rest: few more waves than Eq. 1, and the exact transient."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from ..arrays import ComplexArray, FloatArray
from ..blade import Blade
from ..blade_checks import require_blade, require_planar
from ..input_checks import peak_deflection, positive, rotation_speed, whole_number
from ..lazily import linalg, optimize
from ..ramps import FourierRamp
from ..theory import BERNOULLI_EULER, Theory, require_theory
from ..threads import one_thread
from .modes_over_speed import ModesOverSpeed, excited_modes
from .residual import exact_residuals, modes_for, residuals, swing

_MORE_WAVES = 4
_MOST_MODES = 20
_NEWTON_STEPS, _SETTLED, _DIFFERENCE = 20, 1e-3, 1e-6
_SOLVED = 1e-7  # of the length: what the closed form may leave
_INSTANTS = 0.5 - 0.5 * np.cos(np.pi * np.arange(1.0, 120.0) / 120.0)  # denser at both ends
_INSIDE = 3e-4  # share of the limits kept for what is between the instants
_IMPOSSIBLE = 1e-12
_WILD = 1e3  # coefficients of a ramp that goes to and fro for no use
_CORRECTIONS, _LEFT = 12, 1e-6
_OFF = 0.01  # error of the frequency over which its derivatives are differences
_DERIVATIVES = np.array([[1.0, 0.0, 0.0], [0.0, -0.5, 0.5], [-2.0, 1.0, 1.0]])
_PLACES, _BELOW = 64, 0.998
"""Places of the ramp at which the deflection is bounded, and the share of the bound aimed at."""
_LONGER, _LONGEST = 1.25, 12
"""Durations tried, for the sentence, where the one asked for is too short."""


@dataclass(frozen=True, kw_only=True)
class _Task:
    """Demands on a ramp, and the waves it may be made of.

    A_1 and B_1 follow from the sums of a `FourierRamp`; the unknowns are k² A_k, then k² B_k, of
    k = 2 and up: the smallest make a ramp with little jerk, of few waves.
    """

    blades: tuple[tuple[Blade, ModesOverSpeed], ...] = field(repr=False)
    """The blade and its modes; if robust those of lower and of higher frequency after it."""
    start: float
    omega: float
    duration: float
    names: tuple[str, ...]
    theory: Theory
    steepest: float
    largest: float
    robust: int

    @cached_property
    def order(self) -> FloatArray:
        """The k of the unknowns."""
        equations = len(self.names) * (1 + self.robust)
        return np.arange(2.0, equations + 2.0 * _MORE_WAVES + 1.0)

    @property
    def highest(self) -> float:
        """The higher of both speeds, which is not exceeded on the way [rad/s]."""
        return max(self.start, self.omega)

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

    def _derived(self, left: list[ComplexArray]) -> ComplexArray:
        """Return what the blades keep as Z, and its changes by 1 % of the frequency, all modes."""
        return np.asarray(_DERIVATIVES[: self.robust + 1, : len(left)] @ np.stack(left)).ravel()

    def closed_form(self, y: FloatArray) -> ComplexArray:
        """Return Z of the modes and its changes, (modes times one more than robust,)."""
        ramp, T = self.ramp(y), np.array([self.duration])
        return self._derived(
            [residuals(blade, ramp, modes, T)[:, 0] for blade, modes in self.blades]
        )

    def exact(self, y: FloatArray) -> tuple[ComplexArray, float]:
        """Return the same by the exact transient, and the blade's largest |q|/L on the way."""
        ramp = self.ramp(y)
        residuals = [
            exact_residuals(blade, ramp, self.names, self.theory) for blade, _ in self.blades
        ]
        return self._derived([left for left, _ in residuals]), residuals[0][1]

    def swing(self, y: FloatArray) -> FloatArray:
        """Return q/L at places of the ramp by the closed form."""
        return swing(self.blades[0][0], self.ramp(y), self.blades[0][1], _PLACES)

    def equations(self, y: FloatArray, target: ComplexArray) -> FloatArray:
        """Return the modes' distances from the target by the closed form, (2 modes,)."""
        z = self.closed_form(y) - target
        return np.concatenate((z.real, z.imag))

    def limits(self, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return G and h of the limits, G y + h ≥ 0, near the unknowns `y`."""
        G, h = self._room
        if math.isinf(self.largest):
            return G, h
        here, slopes = self.swing(y) / self.largest, _tangent(self.swing, y) / self.largest
        ahead = here - slopes @ y
        return np.vstack((G, -slopes, slopes)), np.concatenate((h, 1.0 - ahead, 1.0 + ahead))

    @cached_property
    def _room(self) -> tuple[FloatArray, FloatArray]:
        """G and h of rate and acceleration, which are linear in the unknowns."""

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


def _tangent(of: Callable[[FloatArray], FloatArray], y: FloatArray) -> FloatArray:
    """Return the derivatives of a function of the unknowns, (values, unknowns)."""
    here, steps = of(y), _DIFFERENCE * np.eye(y.size)
    return np.stack([of(y + step) - here for step in steps], axis=1) / _DIFFERENCE


@one_thread
def design_ramp(
    blade: Blade,
    omega: float,
    duration: float,
    modes: int = 2,
    *,
    start: float = 0.0,
    theory: Theory = BERNOULLI_EULER,
    acceleration_limit: float | None = None,
    robust: int = 0,
    largest: float | None = None,
) -> FourierRamp:
    """Return a smooth change of the speed that leaves the first modes at rest.

    Its acceleration is a Fourier series of `modes` (1 + `robust`) + 8 waves. Among the ramps
    within the limits without residual by the closed form (`residual_amplitude`), it is the
    closest to Eq. 1. The amplitude that the exact transient leaves becomes the next target of the
    closed form, with its sign changed, until each mode keeps less than 1e-6 L. During the ramp the
    blade swings, in short ramps as far as without a design. The design depends on the blade: in 2 s
    to 6 rad/s an error of 1 % in its frequency leaves 2.1e-2 L instead of 3e-6 L. A robust ramp
    makes the derivatives to the frequency vanish too, after Singer and Seering (1990).

    Parameters
    ----------
    blade : Blade
    omega : float
        Speed after the ramp [rad/s].
    duration : float
        T [s].
    modes : int
        Number of modes left at rest, the lowest but axial ones.
    start : float
        Speed before the ramp [rad/s]; on the way it is between zero and the higher of both.
    theory : Theory
        As for `residual_amplitude`.
    acceleration_limit : float, optional
        Largest |θ̈| [rad/s²]; none if not given. That of Eq. 1 is 2(ω - ω_start)/T.
    robust : int
        Derivatives of the residual by the blade's frequency that vanish, 0 to 2, as differences
        over ±1 %: an error ε of the frequency leaves a multiple of ε^(robust + 1), beyond 1 % if 2.
    largest : float, optional
        Largest |q|/L of a planar blade on the way by the exact transient; none if not given.

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
    require_blade(blade)
    omega, start = rotation_speed(omega), rotation_speed(start, "start")
    duration = positive("duration", duration, "s")
    modes = whole_number("modes", modes, most=_MOST_MODES)
    if omega == start:
        raise ValueError(f"omega and start are both {omega:g} rad/s: there is nothing to change")
    robust = whole_number("robust", robust, least=0, most=2)
    bound = math.inf
    if largest is not None:
        require_planar(blade, "largest is of", "the design without it")
        bound = peak_deflection("largest", largest)
    steepest = math.inf
    if acceleration_limit is not None:
        steepest = positive("acceleration_limit", acceleration_limit, "rad/s²")
        if steepest * duration <= abs(omega - start):
            raise ValueError(
                f"acceleration_limit = {steepest:g} rad/s² takes "
                f"{abs(omega - start) / steepest:.4g} s at least from {start:g} to {omega:g} "
                f"rad/s, and the duration is {duration:g} s: take a longer one"
            )
    widest = FourierRamp(start=max(start, omega), omega=omega, ramp_time=duration)
    others = [blade.in_units(1.0, 1.0, 1.0 + off) for off in (-_OFF, _OFF) if robust]
    names = excited_modes(blade, widest.fastest, modes, require_theory(theory))
    task = _Task(
        blades=tuple((one, modes_for(one, widest, theory, names)) for one in (blade, *others)),
        start=start, omega=omega, duration=duration, names=names, theory=theory,
        steepest=steepest, largest=bound, robust=robust,
    )  # fmt: skip
    return _corrected(task)


def _corrected(task: _Task) -> FourierRamp:
    """Return the ramp after which the exact transient has no residual."""
    target, y, aim = np.zeros_like(task.closed_form(task.eq_1)), task.eq_1, task
    # Broyden's method, from a Jacobian of one: the closed form misses by the same all around.
    inverse, last = np.eye(2 * target.size), None
    for _ in range(_CORRECTIONS):
        solution = _solved(aim, y, target)
        if solution is None:
            raise ValueError(_too_short(task))
        y = solution
        left, way = task.exact(y)
        size = float(np.abs(left).max())
        if size < _LEFT and way <= task.largest:
            return task.ramp(y)
        if way > task.largest:
            swing = float(np.abs(task.swing(y)).max())
            aim = replace(task, largest=_BELOW * task.largest * swing / way)
        # What is small already stays as it is.
        left = np.where(np.abs(left) > 0.1 * _LEFT, left, 0.0)
        now = np.stack((task.closed_form(y), left)).view(np.float64)
        if last is not None:
            step, moved = now - last
            off = step - inverse @ moved
            inverse += np.outer(off, step @ inverse) / (step @ inverse @ moved)
        here, defect = last = now
        target = (here - inverse @ defect).view(np.complex128)
    raise RuntimeError(
        f"on a ramp of {task.duration:g} s the blade swings so far, {way:.3g} of its length, that "
        f"corrections do not settle: {size:.1e} is left; take a longer duration"
    )


def _solved(task: _Task, near: FloatArray, target: ComplexArray) -> FloatArray | None:
    """Return the unknowns closest to `near` that meet target and limits, None without any."""
    y, still = near, np.zeros(near.size)
    for _ in range(_NEWTON_STEPS):
        defect = task.equations(y, target)
        J = _tangent(lambda y: task.equations(y, target), y)
        # Of all that meets the linear equations for the next y to _SOLVED, the closest: what is
        # small by itself, as of high modes, takes no effort.
        rows, sides = np.vstack((J / _SOLVED, np.eye(y.size))), (J @ (y - near) - defect) / _SOLVED
        slopes, room = task.limits(y)
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
    """Return the y of least |rows y - sides| with slopes y ≥ least (Lawson and Hanson, ch. 23)."""
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
    if math.isfinite(task.largest):
        limits = f"{limits} with a deflection of at most {task.largest:g} of the length"
    what = (
        f"{len(task.names)} modes at rest{f' with robust = {task.robust}' if task.robust else ''}"
    )
    missed = f"no ramp of {task.duration:g} s leaves {what} within {limits}"
    still = np.zeros_like(task.closed_form(task.eq_1))
    for n in range(1, _LONGEST):
        longer = replace(task, duration=float(f"{task.duration * _LONGER**n:.3g}"))
        if _solved(longer, longer.eq_1, still) is not None:
            return f"{missed}: take a duration of {longer.duration:g} s, or wider limits"
    return f"{missed}: take wider limits, or fewer modes"
