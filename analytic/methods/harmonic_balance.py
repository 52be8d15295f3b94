"""Harmonic balance: one periodic orbit of a system that time reversal maps onto itself.

The residual of the orbit's Fourier series is projected onto its waves at midpoints of half a
period, and the peak of the gauge is the amplitude a. These are as many equations as unknowns: the
coefficients and the frequency Ω. Newton's method solves them with the exact tangent. For a rotating
beam the gauge is the tip's deflection, and the Coriolis force brings in even harmonics.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import count
from typing import Any

import numpy as np

from ..arrays import FloatArray
from .fourier import Period, packed, unpacked
from .newton import LARGE, Newton, NoOrbitError, factored, length, solved
from .orbit import Orbit, S

# Of the odd coordinates and of Ω; in the energies they count a 1000 times. Small orbits may
# stagnate by the round-off of the mean.
_NEWTON = Newton(
    converged=4e-15,
    stagnates=1e-9,
    slow=0.4,
    steps=25,
    tangents=8,
    largest=1.0,
    broyden=True,
    patience=LARGE,
)
_SAME_PEAK = 1e-8  # relative distance of peaks that are one
_PEAKS = 3  # tried, where another becomes the highest
_FINER_STEPS = 2  # after which a tenth of the change is left out, or less
_DIFFERENCE = 1e-3  # of a frequency, for derivatives to it


def projected(orbit: Orbit[Any]) -> FloatArray:
    """Return the harmonics of the residual, as many as the orbit has unknowns."""
    at = orbit.period()
    defect = orbit.system.residual(*orbit.summed(at.waves), *orbit.drive(at.phase))
    return packed(at.onto @ defect, orbit.parts)


def jacobian(orbit: Orbit[Any], *, coarse: bool = False) -> FloatArray:
    """Return the derivatives of the residual's harmonics with respect to q's and to Ω.

    The last row is left to the amplitude, or to whatever picks one orbit of the branch. By half of
    the tangent's harmonics, `coarse`, they cost a quarter and are good to about 1e-3.
    """
    at = orbit.period(coarse=coarse)
    tangent, by_frequency = orbit.tangent(at.phase), _by_frequency(orbit)
    # A change exp(ikφ) of q changes the residual by the sum of these times 1, ik, k².
    powers = np.stack(
        (tangent.stiffness, orbit.frequency * tangent.damping, -(orbit.frequency**2) * tangent.mass)
    ).swapaxes(-1, -2)
    matrix, right = np.zeros((by_frequency.size + 1,) * 2, order="F"), 0  # as LAPACK takes it
    matrix[:-1, -1] = by_frequency
    for by, columns in orbit.parts:
        below, end = 0, right + (columns.stop - columns.start) * by.size
        for of, rows in orbit.parts:
            under = below + (rows.stop - rows.start) * of.size
            part = powers[:, :, by[:, None], of]
            _waves_onto_waves(at, part, rows, columns, matrix[below:under, right:end].T)
            below = under
        right = end
    return matrix


def _waves_onto_waves(
    at: Period, powers: FloatArray, rows: slice, columns: slice, transposed: FloatArray
) -> None:
    """Write the Jacobian between rows of the coefficients, from powers (3, phases, by, of)."""
    # Waves of orders j and k multiply to j - k and j + k: two of the tangent's own coefficients.
    _, _, by, of = powers.shape
    H, count = len(at.onto) // 2, rows.stop - rows.start
    from_sines, to_sines = columns.start > H, rows.start > H
    cos, sin = at.products
    even, odd = (cos, sin) if from_sines == to_sines else (sin, -cos)
    means = np.stack((even, odd, even)) @ powers.reshape(3, len(at.phase), -1)
    means = (-means if from_sines and not to_sines else means).reshape(3, -1)
    for place in range(columns.stop - columns.start):
        k = columns.start - H * from_sines + place
        near, far = (
            means[:, first * by * of : (first + count) * by * of]
            for first in (H + rows.start - H * to_sines + order for order in (-k, k))
        )
        mirrored = np.array([[1.0, -k, k * k]]) @ far
        onto = np.array([[1.0, k, k * k]]) @ near
        onto = (onto - mirrored if from_sines else onto + mirrored).reshape(count, by, of)
        if rows.start == 0:
            onto[0] *= 0.5
        transposed[place * by : (place + 1) * by].reshape(by, count, of)[...] = onto.swapaxes(0, 1)


def _by_frequency(orbit: Orbit[Any]) -> FloatArray:
    """Return the derivatives of the residual's harmonics to Ω: they are of second degree in it."""
    step = _DIFFERENCE * orbit.frequency
    ahead, behind = (
        projected(replace(orbit, frequency=orbit.frequency + by)) for by in (step, -step)
    )
    return (ahead - behind) / (2.0 * step)


class LastTangent:
    """The last tangent that was factored; orbits near it make do with it."""

    def __init__(self) -> None:
        self.factors: Any = None

    def fits(self, unknowns: int) -> bool:
        """Return whether it is one for so many unknowns, the frequency among them."""
        return self.factors is not None and len(self.factors[0]) == unknowns

    def factor(self, orbit: Orbit[Any], *, coarse: bool = True) -> None:
        """Factor the tangent at the orbit, the derivatives of its peak the last row.

        Of many unknowns a `coarse` one, unless it is not to be.
        """
        peak = orbit.peak_gradient()
        matrix = jacobian(orbit, coarse=coarse and peak.size > LARGE)
        matrix[-1] = peak
        self.factors = factored(matrix)


def solve(guess: Orbit[S], amplitude: float, tangent: LastTangent | None = None) -> Orbit[S]:
    """Return the orbit near `guess` whose gauge has the peak `amplitude`.

    The `tangent`, of an orbit near by, is factored anew only where the iteration contracts slowly;
    until then Broyden's method improves its steps. Raises NoOrbitError.
    """
    tangent, crest = tangent or LastTangent(), guess.crest()
    parts, shape = guess.parts, guess.coefficients.shape
    moving = guess.moving

    def orbit(z: FloatArray) -> Orbit[S]:
        return replace(
            guess,
            coefficients=unpacked(z[:-1], parts, shape),
            frequency=float(z[-1]),
            peak_phase=crest.phase,
            low_phase=crest.low_phase,
        )

    def residual(z: FloatArray) -> FloatArray:
        here = orbit(z)
        crest.follow(here)
        return np.append(projected(here), crest.height - amplitude)

    made = count()

    def linearized(z: FloatArray) -> tuple[Any, FloatArray]:
        defect = residual(z)
        tangent.factor(orbit(z), coarse=next(made) == 0)
        return tangent.factors, defect

    def size(z: FloatArray, change: FloatArray) -> float:
        if z[-1] <= 0.0:
            return np.inf
        return length(change[:-1]) / length(z[moving]) + abs(float(change[-1])) / float(z[-1])

    z = np.append(packed(guess.coefficients, parts), guess.frequency)
    others = factors = tangent.factors if tangent.fits(z.size) else None
    for _ in range(_PEAKS):
        root = _NEWTON.root(z, residual, linearized, size=size, factors=factors)
        if root is None:
            break
        z, factors = root.z, root.factors
        crest = orbit(z).crest()
        if abs(crest.height - amplitude) < _SAME_PEAK * amplitude:
            return replace(orbit(z), amplitude=amplitude)
    if others is not None and tangent.factors is others:  # they led astray
        tangent.factors = None
        return solve(guess, amplitude, tangent)
    raise NoOrbitError("Newton's method does not converge")


def frequency_change(orbit: Orbit[Any], tangent: LastTangent | None = None) -> float:
    """Return the relative change of an orbit's frequency on the refined system.

    At the same amplitude, by a tangent that fits the orbit or its own.
    """
    unknowns = packed(orbit.coefficients, orbit.parts).size + 1
    if tangent is None or not tangent.fits(unknowns):
        tangent = LastTangent()
        tangent.factor(orbit)
    phases, weights = orbit.crests

    def height(moved: Orbit[Any]) -> float:
        gauge = moved.system.gauge(moved.coordinates(phases)[0])
        return float(weights @ gauge) - orbit.amplitude

    moved = on_finer(orbit, tangent.factors, height)
    return abs(moved.frequency / orbit.frequency - 1.0)


def on_finer(
    orbit: Orbit[S], factors: Any, last: Callable[[Orbit[S]], float], scale: float = 1.0
) -> Orbit[S]:
    """Return an orbit on the refined system, with as many harmonics.

    By two steps with the factors of its own tangent and, for what refinement adds, by its
    stiffness, which is 1. The `last` equation is zero; the last unknown is Ω over the scale.
    """
    finer = orbit.finer
    kept = orbit.system.lifted(np.ones(orbit.system.size), finer) > 0.0
    moved, at, defect = orbit.on(finer), orbit.period(fine=True), orbit.finer_defect
    for step in range(_FINER_STEPS):
        if step > 0:
            at = orbit.period()
            defect = finer.residual(*moved.summed(at.waves), *moved.drive(at.phase))
        harmonics = packed(at.onto @ defect, moved.parts)
        change = -unpacked(harmonics, moved.parts, moved.coefficients.shape)
        defects = np.append(-packed(change[:, kept], orbit.parts), last(moved))
        change_of_all = -solved(factors, defects)
        change[:, kept] = unpacked(change_of_all[:-1], orbit.parts, orbit.coefficients.shape)
        moved = replace(
            moved,
            coefficients=moved.coefficients + change,
            frequency=moved.frequency + scale * float(change_of_all[-1]),
        )
    return moved
