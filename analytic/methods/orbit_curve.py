"""A curve of orbits, resolved as finely as each of its points needs."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Generic, Protocol, Self, TypeVar

from ..arrays import FloatArray
from .arclength import Curve, Point, advanced, corrected


class OrbitCurve(Curve, Protocol):
    """Equations whose solutions are orbits, on some harmonics and functions."""

    def orbit(self, z: FloatArray) -> Any:
        """Return the orbit of the unknowns."""
        ...

    def unknowns(self, orbit: Any) -> FloatArray:
        """Return the unknowns of an orbit, its series and coordinates cut or padded to these."""
        ...

    def finer(self, orbit: Any) -> Self | None:
        """Return the curve on as many more harmonics or functions as the orbit lacks, if any.

        Raises
        ------
        NoWayOnError
            If that is more than are taken.
        """
        ...


C = TypeVar("C", bound=OrbitCurve)


@dataclass(frozen=True, eq=False)
class At(Generic[C]):
    """A point of a curve of orbits."""

    curve: C
    point: Point

    @cached_property
    def orbit(self) -> Any:
        """The orbit."""
        return self.curve.orbit(self.point.z)

    def on(self, curve: C) -> At[C]:
        """Return the nearest point of a finer curve."""
        z, tangent = self.point.z, self.point.tangent
        here = curve.unknowns(self.orbit)
        ahead = curve.unknowns(self.curve.orbit(z + tangent))
        return At(curve, corrected(curve, here, ahead - here))

    def resolved(self) -> At[C]:
        """Return the same with as many harmonics and functions as it needs."""
        at = self
        while (curve := at.curve.finer(at.orbit)) is not None:
            at = at.on(curve)
        return at

    def advanced(self, step: float, longest: float) -> tuple[At[C], At[C], float]:
        """Return this point and the next, on the curve that resolves both, and the step after it.

        Raises
        ------
        NoWayOnError
            If no step, however short, finds one, or it needs more than is taken.
        """
        point, following = advanced(self.curve, self.point, step, longest)
        there = At(self.curve, point).resolved()
        here = self if there.curve is self.curve else self.on(there.curve)
        return here, there, following
