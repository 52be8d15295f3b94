"""Harmonic balance: one periodic orbit of a system that time reversal maps onto itself.

The residual of the orbit's Fourier series, projected onto its waves at midpoints of half a period,
and the peak of the gauge, fixed to the amplitude a, are as many equations as the coefficients and
the frequency Ω are unknowns. Newton's method solves them with the exact tangent. For a rotating
beam the gauge is the tip's deflection, and the Coriolis force brings in even harmonics.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np

from ..arrays import FloatArray
from ..lazily import linalg
from .fourier import fine_half_period, half_period, packed, unpacked
from .periodic_orbit import Crest, PeriodicOrbit, S, highest, peak_gradient

_NEWTON_STEPS, _MOST_TANGENTS = 25, 8
_CONVERGED = 4e-15  # of the odd coordinates and of Ω; in the energies they count a 1000 times
_ROUND_OFF = 1e-9  # of the same: where small orbits may stagnate, by the round-off of the mean
_SAME_PEAK = 1e-8  # relative distance of peaks that are one
_FINER_STEPS = 2  # after which a tenth of the change is left out, or less
_SLOW = 0.4  # a contraction worse than this pays for a new tangent


class NoOrbitError(Exception):
    """Newton's method found no orbit; the message says why, `last` is the last orbit found."""

    def __init__(self, message: str, last: PeriodicOrbit[Any] | None = None) -> None:
        super().__init__(message)
        self.last = last


def jacobian(orbit: PeriodicOrbit[Any]) -> FloatArray:
    """Return the derivatives of the harmonics of the residual to those of q and to Ω.

    The last row is left to the amplitude, or to whatever picks one orbit of the branch.
    """
    half, system = half_period(orbit.harmonics), orbit.system
    q, q_dot, q_ddot = orbit.at_waves(half.waves)
    tangent = system.tangent(q, q_dot, q_ddot)
    in_time = np.concatenate(
        (
            tangent.stiffness,
            orbit.frequency * tangent.damping,
            orbit.frequency**2 * tangent.mass,
        )
    )
    sides = (
        (np.flatnonzero(system.odd), half.onto_odd, half.waves.odd),
        (np.flatnonzero(~system.odd), half.onto_even, half.waves.even),
    )
    cut = len(half.onto_odd) * len(sides[0][0])
    unknowns = cut + len(half.onto_even) * len(sides[1][0]) + 1
    matrix = np.zeros((unknowns, unknowns), order="F")  # as LAPACK takes it
    places = (slice(0, cut), slice(cut, unknowns - 1))
    for down, (rows, onto, _) in zip(places, sides, strict=True):
        for across, (columns, _, waves) in zip(places, sides, strict=True):
            part = in_time[:, rows[:, None], columns]
            products = onto[:, None, None, :] * waves.transpose(2, 0, 1)[None]
            block = products.reshape(-1, len(part)) @ part.reshape(len(part), -1)
            place = matrix[down, across]
            place.shape = len(onto), len(rows), -1, len(columns)  # a view
            place[...] = block.reshape(len(onto), -1, len(rows), len(columns)).swapaxes(1, 2)
    by_frequency = (tangent.damping @ q_dot[..., None] + 2.0 * tangent.mass @ q_ddot[..., None])[
        ..., 0
    ] / orbit.frequency
    matrix[:-1, -1] = half.project(by_frequency, system.odd)
    return matrix


class LastTangent:
    """The last tangent that was factored; orbits near it make do with it.

    Attributes
    ----------
    factors : tuple or None
        As `scipy.linalg.lu_factor` returns them.
    """

    def __init__(self) -> None:
        self.factors: Any = None

    def fits(self, orbit: PeriodicOrbit[Any]) -> bool:
        """Return whether it is one for as many unknowns as the orbit has."""
        unknowns = orbit.harmonics * orbit.system.size + int((~orbit.system.odd).sum()) + 1
        return self.factors is not None and len(self.factors[0]) == unknowns

    def factor(self, orbit: PeriodicOrbit[Any]) -> None:
        """Factor the tangent at the orbit, the derivatives of its peak the last row."""
        matrix = jacobian(orbit)
        matrix[-1] = peak_gradient(orbit)
        self.factors = linalg.lu_factor(matrix, overwrite_a=True, check_finite=False)

    def solve(self, defect: FloatArray) -> FloatArray:
        """Return what the defect takes to vanish."""
        assert self.factors is not None
        # As `linalg.lu_solve`, whose checks take longer than it does.
        return np.asarray(linalg.lapack.dgetrs(*self.factors, defect)[0])


def solve(
    guess: PeriodicOrbit[S], amplitude: float, tangent: LastTangent | None = None
) -> PeriodicOrbit[S]:
    """Return the orbit near `guess` whose gauge has the peak `amplitude`.

    The tangent is factored anew only where the iteration contracts slowly; until then Broyden's
    method improves its steps.

    Parameters
    ----------
    guess : PeriodicOrbit
    amplitude : float
    tangent : LastTangent, optional
        That of an orbit near by, tried first.

    Raises
    ------
    NoOrbitError
        If Newton's method does not converge.
    """
    tangent = tangent or LastTangent()
    orbit, last = highest(guess), np.inf
    crest = Crest(orbit)
    own, fresh = False, not tangent.fits(orbit)
    half, odd = half_period(orbit.harmonics), orbit.system.odd
    tangents, steps = 0, list[FloatArray]()
    for _ in range(_NEWTON_STEPS):
        crest.follow(orbit)
        defect = orbit.system.residual(*orbit.at_waves(half.waves))
        defect = np.append(half.project(defect, odd), crest.height - amplitude)
        if not np.all(np.isfinite(defect)):
            break
        if fresh:
            tangents += 1
            if tangents > _MOST_TANGENTS:
                break
            tangent.factor(replace(orbit, peak_phase=crest.phase))
            own, fresh = True, False
            steps = []
        change = _improved(-tangent.solve(defect), steps)
        steps.append(change)
        orbit = replace(
            orbit,
            coefficients=orbit.coefficients + unpacked(change[:-1], odd),
            frequency=orbit.frequency + float(change[-1]),
        )
        size = _norm(change[:-1]) / _norm(orbit.sines.ravel())
        size += abs(float(change[-1])) / orbit.frequency
        contraction = size / last if np.isfinite(last) else 1.0
        stagnates = own and size < _ROUND_OFF and contraction > _SLOW
        if stagnates or size * min(1.0, contraction) < _CONVERGED:
            found = highest(orbit)
            if abs(found.peak_phase - crest.phase) > half.spacing:
                crest = Crest(found)
            if abs(crest.height - amplitude) < _SAME_PEAK * amplitude:
                return replace(orbit, amplitude=amplitude, peak_phase=crest.phase)
            orbit = found  # a second peak is higher
        if size > 1.0 or orbit.frequency <= 0.0:
            break
        fresh = contraction > _SLOW and bool(np.isfinite(last))
        last = size
    if not own:  # another orbit's tangent led astray
        tangent.factors = None
        return solve(guess, amplitude, tangent)
    raise NoOrbitError("Newton's method does not converge")


def frequency_change(orbit: PeriodicOrbit[Any], tangent: LastTangent | None = None) -> float:
    """Return the relative change of an orbit's frequency on the refined system.

    The refined equations are solved at the same amplitude and as many harmonics, by a tangent of
    the orbit and, for what refinement adds, by its stiffness, which is 1.

    Parameters
    ----------
    orbit : PeriodicOrbit
    tangent : LastTangent, optional
        One that fits the orbit; its own is factored otherwise.
    """
    if tangent is None or not tangent.fits(orbit):
        tangent = LastTangent()
        tangent.factor(orbit)
    finer, odd = orbit.system.refined(), orbit.system.odd
    kept = orbit.system.lifted(np.ones(orbit.system.size), finer) > 0.0
    moved, peak = orbit.on(finer), np.array([orbit.peak_phase])
    half, defect = fine_half_period(orbit.harmonics), orbit.finer_defect
    for step in range(_FINER_STEPS):
        if step > 0:
            half = half_period(orbit.harmonics)
            defect = finer.residual(*moved.at_waves(half.waves))
        change = -unpacked(half.project(defect, finer.odd), finer.odd)
        height = finer.gauge(moved.coordinates(peak)[0])
        known = -tangent.solve(np.append(-packed(change[:, kept], odd), height - orbit.amplitude))
        change[:, kept] = unpacked(known[:-1], odd)
        moved = replace(
            moved,
            coefficients=moved.coefficients + change,
            frequency=moved.frequency + float(known[-1]),
        )
    return abs(moved.frequency / orbit.frequency - 1.0)


def _norm(vector: FloatArray) -> float:
    return math.sqrt(float(vector @ vector))


def _improved(step: FloatArray, steps: Sequence[FloatArray]) -> FloatArray:
    """Return a step by a factored tangent, improved by what the `steps` since then tell of it.

    Broyden's method, in the form that keeps steps instead of matrices (Kelley 1995, Sec. 7.3).
    """
    if not steps:
        return step
    for last, following in pairwise(steps):
        step = step + following * (last @ step) / (last @ last)
    return np.asarray(step / (1.0 - (steps[-1] @ step) / (steps[-1] @ steps[-1])))
