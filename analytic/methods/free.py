"""The free orbits of a system as a curve in coefficients and frequency, with all its folds."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Generic

import numpy as np

from ..arrays import FloatArray
from .arclength import NoWayOnError
from .continuation import refined
from .fourier import half_period, packed, unpacked
from .harmonic_balance import NoOrbitError, jacobian
from .periodic_orbit import PeriodicOrbit, S, at_peak

_ROUGHLY = 1e-4  # drift of the invariant up to which a fold is still told, beyond all harmonics
_FREQUENCY_SCALE = 0.05  # relative change of Ω that counts as much as a unit of the coordinates


@dataclass(frozen=True, eq=False)
class FreeCurve(Generic[S]):
    """The projected equations of free orbits; their frequency is the last unknown.

    Attributes
    ----------
    like : PeriodicOrbit
        An orbit on the same system and harmonics.
    origin : float
        Frequency that is the zero of the last unknown.
    """

    like: PeriodicOrbit[S]
    origin: float

    def unknowns(self, orbit: PeriodicOrbit[Any]) -> FloatArray:
        """Return the unknowns of an orbit, cut or padded to these harmonics and functions."""
        orbit = orbit.with_harmonics(self.like.harmonics).on(self.like.system)
        last = (orbit.frequency / self.origin - 1.0) / _FREQUENCY_SCALE
        return np.append(packed(orbit.coefficients, orbit.system.odd), last)

    def _raw(self, z: FloatArray) -> PeriodicOrbit[S]:
        return replace(
            self.like,
            coefficients=unpacked(z[:-1], self.like.system.odd),
            frequency=self.origin * (1.0 + _FREQUENCY_SCALE * float(z[-1])),
        )

    def orbit(self, z: FloatArray) -> PeriodicOrbit[S]:
        """Return the orbit of the unknowns, its phase such that the gauge's peak is positive."""
        orbit, peak, _ = at_peak(self._raw(z))
        return replace(orbit, amplitude=peak)

    def residual(self, z: FloatArray) -> FloatArray:
        """Return the projected residual, as many as there are coefficients."""
        orbit, half = self._raw(z), half_period(self.like.harmonics)
        defect = orbit.system.residual(*orbit.coordinates(half.phase))
        return half.project(defect, orbit.system.odd)

    def jacobian(self, z: FloatArray) -> FloatArray:
        """Return its derivatives to all unknowns."""
        matrix = jacobian(self._raw(z))[:-1]
        matrix[:, -1] *= self.origin * _FREQUENCY_SCALE
        return matrix

    def finer(self, orbit: PeriodicOrbit[S]) -> FreeCurve[S] | None:
        """Return the curve on more harmonics or functions, if the orbit needs them."""
        try:
            larger = refined(orbit)
        except NoOrbitError as reason:
            if orbit.invariant_drift < _ROUGHLY:
                return None
            raise NoWayOnError(str(reason)) from None
        return None if larger is None else replace(self, like=larger)

    def climb(self, z: FloatArray, along: FloatArray) -> float:
        """Return how the amplitude changes along a direction of the unknowns."""
        return float(at_peak(self._raw(z))[2] @ along)
