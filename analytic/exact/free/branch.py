"""A branch of periodic orbits of the exact blade, with its special points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...arrays import ComplexArray, FloatArray
from ...beam import AnyBlade
from ...input_checks import finite_number, finite_values, points_of_beam, whole_number
from ...methods.floquet import Multipliers, floquet_multipliers
from ...methods.orbit import Orbit
from ...theory import Theory
from ..beam.state import BeamState, SectionLoads, in_newtons
from ..beam.steady import state_of

_SAMPLES = 4096  # of a period, which find its ends to 3e-7 of a swing


class SpecialPoint(NamedTuple):
    """A point of a branch that is special.

    Attributes
    ----------
    frequency : float
        [rad/s].
    amplitude : float
        Peak |q|/L.
    """

    frequency: float
    amplitude: float


@dataclass(frozen=True, kw_only=True)
class OrbitSet:
    """Periodic orbits of one blade; base of `Orbits`, `BackboneBranch` and `ForcedResponse`."""

    _covered: ClassVar[int] = 6
    _tolerance: ClassVar[float] = 1e-6

    beam: AnyBlade
    theory: Theory
    frequency: FloatArray  # [rad/s], (orbits,)
    amplitude: FloatArray  # peak |q|/L, (orbits,)
    nondimensional: tuple[Orbit[Any], ...] = field(repr=False)  # in time t √(EI/mL³)

    @staticmethod
    def told(beam: AnyBlade, theory: Theory, orbits: Sequence[Orbit[Any]]) -> dict[str, Any]:
        """Return these attributes of orbits of a blade."""
        return {
            "beam": beam,
            "theory": theory,
            "frequency": beam.frequency_scale * np.array([orbit.frequency for orbit in orbits]),
            "amplitude": np.array([orbit.amplitude for orbit in orbits]),
            "nondimensional": tuple(orbits),
        }

    def _orbit(self, i: int) -> Orbit[Any]:
        count = len(self.nondimensional)
        if not -count <= i < count:
            raise IndexError(f"orbit {i} is none of the {count} that there are, 0 to {count - 1}")
        return self.nondimensional[i]

    def orbit(self, i: int, n: int = 200) -> tuple[FloatArray, FloatArray]:
        """Return x = q/L and dx/dτ, τ = t √(EI/mL³), each (n,), once around orbit `i`.

        Equally spaced in time; the last point is the first.
        """
        n = whole_number("n", n, least=2)
        orbit = self._orbit(i)
        q, q_dot, _ = orbit.coordinates(np.linspace(0.0, 2.0 * np.pi, n))
        return orbit.system.gauge(q), orbit.system.gauge_rate(q, q_dot)

    def state(self, i: int, x: ArrayLike, phase: float = 0.0) -> BeamState:
        """Return the state of orbit `i` at the material points `x` [m], to start a code from.

        In the frame of the clamp. Points beyond the beam, from 0 to L, are refused.
        """
        orbit = self._orbit(i)
        (q,), (q_dot,), _ = orbit.coordinates(np.array([finite_number("phase", phase, "rad")]))
        return state_of(self.beam, orbit.system.model, q, q_dot, x)

    def axis(self, i: int, x: ArrayLike, phase: ArrayLike) -> FloatArray:
        """Return the places of the material points `x` [m] of orbit `i`, (phases, points, 3).

        At the phases [rad], from the clamp [m]: along it, in the direction of rotation (lag) and
        normal to both (flap). The frame turns with the clamp.
        """
        orbit, at = self._orbit(i), points_of_beam("x", x, self.beam.length)
        q, _, _ = orbit.coordinates(finite_values("phase", phase, "rad"))
        places = orbit.system.model.places(q, at, self.beam.setting_angle)
        return np.asarray(self.beam.length * places)

    def tip(self, i: int, phase: ArrayLike) -> FloatArray:
        """Return the tip's places [m] at the phases [rad], as `axis`, (phases, 3)."""
        return np.asarray(self.axis(i, self.beam.length, phase)[:, 0])

    def section_loads(self, i: int, x: ArrayLike, phase: ArrayLike) -> SectionLoads:
        """Return the sections at `x` [m] of orbit `i` at phases [rad], force and moment in them.

        The first dimension of all is that of the phases.
        """
        orbit, at = self._orbit(i), points_of_beam("x", x, self.beam.length)
        phases = finite_values("phase", phase, "rad")
        state = (*orbit.coordinates(phases), *orbit.drive(phases))
        standing = orbit.system.model.standing(state[0], at, self.beam.setting_angle)
        loads = orbit.system.section_loads(at, *state)
        return in_newtons(self.beam, at, standing, loads, orbit.system.model.trapeze)

    @cached_property
    def _stability(self) -> tuple[Multipliers, ...]:
        return tuple(floquet_multipliers(one, self._covered) for one in self.nondimensional)

    @property
    def multipliers(self) -> ComplexArray:
        """Floquet multipliers (orbits, 8) of the lowest four modes; of free orbits two are 1.

        Computed when first asked for.
        """
        return np.array([found.lowest for found in self._stability])

    @property
    def stable(self) -> NDArray[np.bool_]:
        """Whether small disturbances in the plane do not grow, (orbits,).

        No Floquet multiplier lies outside the unit circle: of a free orbit in the plane for the
        lowest six modes, which the integration over a period resolves. Of motion out of the
        plane `planar_stability` tells; of a blade in space this covers all directions.
        """
        return np.array([found.stable(self._tolerance) for found in self._stability])

    @property
    def lag(self) -> FloatArray:
        """Half the way of the tip from end to end in the direction of rotation, over L."""
        return self._swings[:, 0]

    @property
    def flap(self) -> FloatArray:
        """The same normal to it and to the clamp."""
        return self._swings[:, 1]

    @property
    def twist(self) -> FloatArray:
        """Half the swing of the tip's section about the clamp's axis [rad]."""
        return self._swings[:, 2]

    @property
    def _swings(self) -> FloatArray:
        """Half the swings of lag, flap and twist, (orbits, 3)."""
        return np.array([0.5 * np.ptp(course, axis=0) for course in self._courses])

    @cached_property
    def _courses(self) -> list[FloatArray]:
        """Lag, flap and twist of each orbit, (samples, 3), between some by their Fourier series."""
        found = []
        for orbit in self.nondimensional:
            count, model = 8 * orbit.harmonics, orbit.system.model
            q, _, _ = orbit.coordinates(2.0 * np.pi * np.arange(count) / count)
            place = model.places(q, np.ones(1), self.beam.setting_angle)[:, 0]
            series = np.fft.rfft(np.column_stack((place[:, 1:], model.tip_turn(q))), axis=0)
            found.append(np.fft.irfft(series, _SAMPLES, axis=0) * _SAMPLES / count)
        return found


@dataclass(frozen=True, kw_only=True)
class Branch(OrbitSet):
    """Periodic orbits in order along a curve, with marks at the special ones."""

    marks: tuple[str, ...] = field(repr=False)  # each a `Mark` of `methods.orbit_curve`

    def _marked(self, mark: str) -> tuple[SpecialPoint, ...]:
        return tuple(
            SpecialPoint(float(self.frequency[i]), float(self.amplitude[i]))
            for i, here in enumerate(self.marks)
            if here == mark
        )

    @property
    def folds(self) -> tuple[SpecialPoint, ...]:
        """Folds, where the curve turns around, in order along it."""
        return self._marked("fold")
