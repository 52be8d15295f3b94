"""The truth of each case: shipped where it can be, computed where theory or blade are others."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from analytic import AnyBlade, linear_modes, periodic_orbits
from analytic.arrays import FloatArray
from analytic.lazily import interpolate
from analytic.theory import BERNOULLI_EULER, Theory

from .cases import CASES, Asked, Case
from .sampled import sampled_history, spline
from .shipped import FILE, Shipped, shipped

COMPUTED_BOUND = 1e-9
"""Relative error of computed frequencies: to it they settle."""


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
        return _first_frequency(self.theory, self.case.blade, speed)

    def frequency_at(self, amplitude: float, speed: float | None = None) -> float:
        """Return ω_NL [rad/s] of the exact orbit whose peak |q|/L is `amplitude`.

        Parameters
        ----------
        amplitude : float
        speed : float, optional
            [rad/s]; that of the case's steady rotation by default.

        Raises
        ------
        ValueError
            If the blade is damped, or the amplitude not between 0 and 1.
        RuntimeError
            If the orbit is not reached.
        """
        return float(self.frequencies_at([amplitude], speed)[0])

    def frequencies_at(self, amplitudes: Sequence[float], speed: float | None = None) -> FloatArray:
        """Return what `frequency_at` does, of several amplitudes: what is computed, in one go."""
        if speed is None:
            if self.case.motion is None:
                raise ValueError(f"case {self.case.name} has several speeds: say which")
            speed = self.case.motion.omega
        at = tuple(map(float, amplitudes))
        return np.array(_frequencies_at(self.theory, self.case.blade, speed, at))


@lru_cache(maxsize=64)
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
    if case.asked is not Asked.HISTORY:
        here = data if case in (CASES["L"], CASES["B"]) else None
        return Reference(
            case=case,
            theory=theory,
            bound=COMPUTED_BOUND if here is None else here.frequency_bound,
            source=_computed(theory) if here is None else here.source,
        )
    found = None if data is None else data.history(case)
    if data is not None and found is not None:
        (history, bound), source = found, data.source
    else:
        samples = sampled_history(case, theory)
        history, bound = spline(samples.time, samples.q), samples.error
        source = _computed(theory)
    return Reference(case=case, theory=theory, bound=bound, source=source, _history=history)


def _shipped_of(theory: Theory) -> Shipped | None:
    """Return the shipped data of a theory; there are none where they are being made anew."""
    return shipped() if theory == BERNOULLI_EULER and FILE.exists() else None


def _computed(theory: Theory) -> str:
    return f"computed from the exact beam, {theory.name}"


@lru_cache(maxsize=256)
def _first_frequency(theory: Theory, blade: AnyBlade, speed: float) -> float:
    data = _shipped_of(theory)
    here = None if data is None else data.first_frequency(blade, speed)
    return (
        float(linear_modes(blade, speed, 1, theory=theory).frequencies[0]) if here is None else here
    )


@lru_cache(maxsize=256)
def _frequencies_at(
    theory: Theory, blade: AnyBlade, speed: float, amplitudes: tuple[float, ...]
) -> tuple[float, ...]:
    data, found = _shipped_of(theory), dict[float, float]()
    for a in amplitudes:
        here = None if data is None else data.frequency_at(blade, speed, a)
        found |= {} if here is None else {a: here}
    missing = sorted(set(amplitudes) - set(found))
    if missing:
        # One backbone, for orbits are found from their neighbors.
        frequencies = periodic_orbits(blade, speed, missing, theory=theory).frequency.tolist()
        found |= dict(zip(missing, frequencies, strict=True))
    return tuple(found[a] for a in amplitudes)
