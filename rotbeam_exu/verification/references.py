"""The exact answer of each case: shipped, or computed where theory or blade are others."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import lru_cache, partial
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from analytic import periodic_orbits, spin_up_response, steady_state
from analytic.arrays import FloatArray
from analytic.lazily import interpolate
from analytic.theory import BERNOULLI_EULER, Theory

from .case import Asked, Case
from .shipped import FILE, Shipped, shipped, spline
from .submission import Row

COMPUTED_BOUND = 1e-9
"""Relative error of computed frequencies: to it they settle."""

_BEYOND = 20  # samples beyond the end, for a last step that is longer


@dataclass(frozen=True, kw_only=True, eq=False)
class Reference:
    """The exact answer of one case; made by `reference`.

    Attributes
    ----------
    case : Case
    theory : Theory
        Of the code; the case may add to it, `Case.theory_of`.
    bound : float
        Relative error: of a history over max|q|, interpolation included, else of frequencies.
        A tip in space has that of its worst component.
    source : str
        Which file and how it was made, or how it was computed.
    """

    case: Case
    theory: Theory
    bound: float
    source: str
    _history: interpolate.BSpline | None = field(default=None, repr=False)
    # The search for mistakes asks for the same ones again.
    _rows: dict[float, FloatArray] = field(default_factory=dict, repr=False)

    def history(self, times: ArrayLike, derivative: int = 0) -> FloatArray:
        """Return q [m] at times [s] up to the end of the case, in their shape.

        In space lag, flap and twist, along one more axis. Its first `derivative`, the rate in the
        turning frame [m/s], has a larger error.

        Raises
        ------
        ValueError
            If the case asks for no history, or times lie outside of it.
        """
        if self._history is None:
            raise ValueError(
                f"case {self.case.name} asks for no history, but for {self.case.asked}"
            )
        t, end = np.asarray(times, dtype=float), float(self._history.t[-1])
        if t.size and not (t.min() >= 0.0 and t.max() <= end):
            wrong = t.min() if t.min() < 0.0 else t.max()
            raise ValueError(
                f"the reference of case {self.case.name} goes from 0 to {self.case.duration:g} s, "
                f"got {wrong:g} s: leave out what is beyond"
            )
        values: FloatArray = self._history(t, derivative)
        return values

    def row(self, speed: float) -> FloatArray:
        """Return the numbers asked for at a speed [rad/s]: frequencies, or `TIP`; (numbers,).

        Raises
        ------
        ValueError
            If theory refuses them.
        """
        if speed not in self._rows:
            data = _shipped()
            here = data.row(self.case, self.theory, speed) if data else None
            self._rows[speed] = row_of(self.case, self.theory, speed)[0] if here is None else here
        return self._rows[speed]

    def first_frequency(self, speed: float) -> float:
        """Return ω_n [rad/s] in steady rotation at `speed` [rad/s]; ValueError if refused."""
        return float(self.row(speed)[0])

    def numbers(self, row: Row) -> FloatArray:
        """Return the exact values of a row of the case's table, as its `values`.

        Raises
        ------
        ValueError, RuntimeError
            If theory refuses them.
        """
        if self.case.asked is Asked.BACKBONE:
            return self.frequency_at([row.amplitude], row.speed)
        values = self.row(row.speed)
        return values if self.case.asked is Asked.STEADY else values[row.number - 1 : row.number]

    def frequency_at(self, amplitudes: ArrayLike, speed: float | None = None) -> FloatArray:
        """Return ω_NL [rad/s] of the exact orbits whose peaks |q|/L are `amplitudes`, alike.

        Parameters
        ----------
        amplitudes : array_like
        speed : float, optional
            [rad/s]; by default the speed of the case's steady rotation.

        Raises
        ------
        ValueError
            If the blade is damped, or an amplitude not between 0 and 1.
        RuntimeError
            If an orbit is not reached.
        """
        speed = self.case.rotation.omega if speed is None else speed
        data = _shipped() if self.theory == BERNOULLI_EULER else None
        blade, a = self.case.blade, np.asarray(amplitudes, dtype=float)
        frequencies = {
            one: data and data.frequency_at(blade, speed, one) for one in a.ravel().tolist()
        }
        missing = sorted(one for one, here in frequencies.items() if here is None)
        if missing:
            # One backbone, for orbits are found from their neighbors.
            orbits = periodic_orbits(blade, speed, missing, theory=self.theory)
            frequencies.update(zip(missing, orbits.frequency.tolist(), strict=True))
        return np.array([frequencies[one] for one in a.ravel().tolist()], dtype=float).reshape(
            a.shape
        )


@lru_cache(maxsize=64)  # the histories of a theory take minutes, and all codes of a table ask
def reference(case: Case, theory: Theory = BERNOULLI_EULER) -> Reference:
    """Return the exact answer of a case: shipped of the theories that it names, else computed.

    Parameters
    ----------
    case : Case
        Of the benchmark, or another one.
    theory : Theory
        Of the beam that the code declares.

    Raises
    ------
    ValueError
        If theory refuses the case, as a blade that rotation tears.
    RuntimeError
        If its history does not settle, or the shipped data cannot be read.
    """
    data = _shipped()
    named = case.theory_of(theory).name
    bound, source, history = COMPUTED_BOUND, f"computed from the exact beam, {named}", None
    if case.asked is not Asked.HISTORY:
        here = data.bound(case, theory) if data else None
        if data and here is not None:
            bound, source = here, data.source
        elif case.asked is Asked.STEADY:
            bound = max(row_of(case, theory, speed)[1] for speed in case.speeds)
    elif data and (shipped_one := data.history(case, theory)):
        (history, bound), source = shipped_one, data.source
    else:
        samples = sampled_history(case, theory)
        history, bound = spline(samples.time, samples.q), samples.error
    return Reference(case=case, theory=theory, bound=bound, source=source, _history=history)


def _shipped() -> Shipped | None:
    """Return the shipped data; None while they are being made anew."""
    return shipped() if FILE.exists() else None


def row_of(case: Case, declared: Theory, speed: float) -> tuple[FloatArray, float]:
    """Compute the numbers asked for at a speed [rad/s], and the largest relative error of them."""
    theory, blade = case.theory_of(declared), case.blade
    if case.asked is Asked.STEADY:
        # Loads that stand still in the turning frame are weight, along the axis of rotation.
        weight = -sum(float(load.lift(np.zeros(1))[0]) for load in case.loads)
        steady = steady_state(blade, speed, gravity=weight, theory=theory, tolerance=COMPUTED_BOUND)
        row = np.array([steady.tip[1], steady.tip[2], steady.twist])
        scales = np.abs(row) / case.sizes[: row.size]
        return row, COMPUTED_BOUND + steady.error / float(scales.min())
    modes = case.modes(speed, theory)
    return modes.frequencies, max(modes.error, COMPUTED_BOUND)


class Sampled(NamedTuple):
    """A history of the tip at `time` [s]: `q` [m], in space lag, flap and twist (samples, 3).

    `error`, over max|q|, of the worst component: of the samples by the next coarser computation,
    and of the spline that joins them by the computation halfway between them.
    """

    time: FloatArray
    q: FloatArray
    error: float


def sampled_history(
    case: Case, theory: Theory, *, tolerance: float = 1e-6, spacing: float | None = None
) -> Sampled:
    """Compute a history: a spin-up to `tolerance` over max|q|, an orbit to its residual.

    Samples are `spacing` [s] apart, or some 400 in a period. RuntimeError if the history is not
    reached, ValueError if theory has no answer.
    """
    blade, motion, theory = case.blade, case.rotation, case.theory_of(theory)
    if spacing is None:
        spacing = 0.015 / max(blade.omega_0, motion.omega / 3.0)
    count = math.ceil(case.duration / spacing) + _BEYOND
    time = 0.5 * spacing * np.arange(2 * count + 1, dtype=np.float64)
    if case.is_spun_up:
        solved = partial(
            spin_up_response, blade, case.spin_up, time, loads=case.loads, theory=theory,
            kick=case.kick, start="steady" if case.settled else "straight",
        )  # fmt: skip
        response = solved(tolerance=tolerance)
        q = case.handed(response)
        error = case.error_of(q, response.error, partial(solved, tolerance=10.0 * tolerance))
    else:
        orbit = periodic_orbits(blade, motion.omega, case.amplitudes, theory=theory)
        q, error = blade.length * orbit.response(time, 0), float(orbit.residual.max())
    between = spline(time[::2], q[::2])(time[1::2]) - q[1::2]
    error += float(np.max(np.abs(between).max(axis=0) / np.abs(q).max(axis=0)))
    return Sampled(time=time[::2], q=q[::2], error=error)
