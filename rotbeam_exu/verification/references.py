"""The exact answer of each case: shipped, or computed where theory or blade are others."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import cast

import numpy as np
from numpy.typing import ArrayLike

from analytic import SpinUp, linear_modes, periodic_orbits, spin_up_response
from analytic.arrays import FloatArray
from analytic.lazily import interpolate
from analytic.theory import BERNOULLI_EULER, Theory

from .cases import CASES, Asked, Case
from .shipped import FILE, Shipped, shipped, spline

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
    bound : float
        Relative error: of a history over max|q|, interpolation included, else of frequencies.
    source : str
        Which file and how it was made, or how it was computed.
    """

    case: Case
    theory: Theory
    bound: float
    source: str
    _history: interpolate.BSpline | None = field(default=None, repr=False)
    # Orbits take a second each, and the search for mistakes asks for the same ones again.
    _known: dict[tuple[float, float], float] = field(default_factory=dict, repr=False)

    def history(self, times: ArrayLike) -> FloatArray:
        """Return q [m] at times [s] up to the end of the case, in their shape.

        Raises
        ------
        ValueError
            If the case asks for no history, or times lie outside of it.
        """
        return self._evaluated(times, 0)

    def rate(self, times: ArrayLike) -> FloatArray:
        """Return dq/dt in the turning frame [m/s], as `history` does; its error is larger."""
        return self._evaluated(times, 1)

    def _evaluated(self, times: ArrayLike, derivative: int) -> FloatArray:
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
        found: FloatArray = self._history(t, derivative)
        return found

    def first_frequency(self, speed: float) -> float:
        """Return ω_n [rad/s] in steady rotation at `speed` [rad/s]; ValueError if refused."""
        data = _shipped_of(self.theory)
        here = None if data is None else data.first_frequency(self.case.blade, speed)
        if here is not None:
            return here
        at = speed, 0.0
        if at not in self._known:
            found = linear_modes(self.case.blade, speed, 1, theory=self.theory)
            self._known[at] = float(found.frequencies[0])
        return self._known[at]

    def frequency_at(self, amplitude: float, speed: float | None = None) -> float:
        """Return ω_NL [rad/s] of the exact orbit whose peak |q|/L is `amplitude`.

        Parameters
        ----------
        amplitude : float
        speed : float, optional
            [rad/s]; by default the speed of the case's steady rotation.

        Raises
        ------
        ValueError
            If the blade is damped, or the amplitude not between 0 and 1.
        RuntimeError
            If the orbit is not reached.
        """
        return float(self.frequencies_at([amplitude], speed)[0])

    def frequencies_at(self, amplitudes: Sequence[float], speed: float | None = None) -> FloatArray:
        """Return `frequency_at` of several amplitudes, computed in one go."""
        speed = self.case.rotation.omega if speed is None else speed
        data, blade, known = _shipped_of(self.theory), self.case.blade, self._known
        at = [(speed, float(a)) for a in amplitudes]
        for place in set(at) - set(known):
            here = data.frequency_at(blade, *place) if data else None
            if here is not None:
                known[place] = here
        missing = sorted(set(at) - set(known))
        if missing:
            # One backbone, for orbits are found from their neighbors.
            found = periodic_orbits(blade, speed, [a for _, a in missing], theory=self.theory)
            known.update(zip(missing, found.frequency.tolist(), strict=True))
        return np.array([known[place] for place in at])


@lru_cache(maxsize=64)  # the histories of a theory take minutes, and all codes of a table ask
def reference(case: Case, theory: Theory = BERNOULLI_EULER) -> Reference:
    """Return the exact answer of a case: shipped of Bernoulli and Euler's beam, else computed.

    Parameters
    ----------
    case : Case
        Of the benchmark, or another one.
    theory : Theory
        Of the beam that the code tends to.

    Raises
    ------
    ValueError
        If theory refuses the case, as a blade that rotation tears.
    RuntimeError
        If its history does not settle, or the shipped data cannot be read.
    """
    data = _shipped_of(theory)
    bound, source, found = COMPUTED_BOUND, f"computed from the exact beam, {theory.name}", None
    if case.asked is not Asked.HISTORY:
        if data and case in (CASES["L"], CASES["B"]):
            bound, source = data.frequency_bound, data.source
    elif data and (here := data.history(case)):
        (found, bound), source = here, data.source
    else:
        samples = sampled_history(case, theory)
        found, bound = spline(samples.time, samples.q), samples.error
    return Reference(case=case, theory=theory, bound=bound, source=source, _history=found)


def _shipped_of(theory: Theory) -> Shipped | None:
    """Return the shipped data of a theory; None while they are being made anew."""
    return shipped() if theory == BERNOULLI_EULER and FILE.exists() else None


@dataclass(frozen=True, kw_only=True, eq=False)
class Sampled:
    """A history of the tip as samples that a spline joins.

    Attributes
    ----------
    time, q : ndarray (samples,)
        [s], [m].
    error : float
        Over max|q|: of the samples by the next coarser computation, and of the spline by the
        computation halfway between them.
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
    blade, motion = case.blade, cast("SpinUp", case.rotation)
    if spacing is None:
        spacing = 0.015 / max(blade.omega_0, motion.omega / 3.0)
    count = math.ceil(case.duration / spacing) + _BEYOND
    time = 0.5 * spacing * np.arange(2 * count + 1, dtype=np.float64)
    if case.is_spun_up:
        found = spin_up_response(
            blade, motion, time, tolerance=tolerance, loads=case.loads, theory=theory
        )
        q, error = found.q, found.error
    else:
        orbit = periodic_orbits(blade, motion.omega, case.amplitudes, theory=theory)
        q, error = blade.length * orbit.response(time, 0), float(orbit.residual.max())
    between = spline(time[::2], q[::2])(time[1::2]) - q[1::2]
    error += float(np.abs(between).max() / np.abs(q).max())
    return Sampled(time=time[::2], q=q[::2], error=error)
