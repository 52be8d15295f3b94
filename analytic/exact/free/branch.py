"""A branch of periodic orbits of the exact blade, with its special points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...arrays import ComplexArray, FloatArray
from ...blade import Blade
from ...blade_checks import require_out_of_plane
from ...input_checks import (
    finite_number,
    finite_values,
    not_negative,
    points_of_beam,
    whole_number,
)
from ...methods.floquet import Multipliers, floquet_multipliers
from ...methods.orbit import Orbit
from ...parts import Damping
from ...theory import Theory
from ...threads import one_thread
from ..continuum.state import BladeState, SectionLoads, in_newtons, state_of
from ..stability.growth import GrowthOutOfPlane, growth_about

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
    _confirms: ClassVar[bool] = True  # `stable`, as `out_of_plane`

    blade: Blade
    theory: Theory
    omega: Any  # rotation speed [rad/s], of a response (orbits,)
    mode: str = ""  # from which free orbits grow
    frequency: FloatArray  # [rad/s], (orbits,)
    amplitude: FloatArray  # peak |q|/L, (orbits,)
    nondimensional: tuple[Orbit[Any], ...] = field(repr=False)  # in time t √(EI/mL³)

    @staticmethod
    def common_fields(blade: Blade, theory: Theory, orbits: Sequence[Orbit[Any]]) -> dict[str, Any]:
        """Return the attributes that all sets of orbits of a blade have."""
        return {
            "blade": blade,
            "theory": theory,
            "frequency": blade.frequency_scale * np.array([orbit.frequency for orbit in orbits]),
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

    def state(self, i: int, x: ArrayLike, phase: float = 0.0) -> BladeState:
        """Return the state of orbit `i` at the material points `x` [m], to start a code from.

        In the frame of the clamp. Points beyond the beam, from 0 to L, are refused.
        """
        orbit = self._orbit(i)
        (q,), (q_dot,), _ = orbit.coordinates(np.array([finite_number("phase", phase, "rad")]))
        return state_of(self.blade, orbit.system.model, q, q_dot, x)

    def axis(self, i: int, x: ArrayLike, phase: ArrayLike) -> FloatArray:
        """Return the places of the material points `x` [m] of orbit `i`, (phases, points, 3).

        At the phases [rad], from the clamp [m]: along it, in the direction of rotation (lag) and
        normal to both (flap). The frame turns with the clamp.
        """
        orbit, at = self._orbit(i), points_of_beam("x", x, self.blade.length)
        q, _, _ = orbit.coordinates(finite_values("phase", phase, "rad"))
        places = orbit.system.model.places(q, at)
        return np.asarray(self.blade.length * places)

    def tip(self, i: int, phase: ArrayLike) -> FloatArray:
        """Return the tip's places [m] at the phases [rad], as `axis`, (phases, 3)."""
        return np.asarray(self.axis(i, self.blade.length, phase)[:, 0])

    def section_loads(self, i: int, x: ArrayLike, phase: ArrayLike) -> SectionLoads:
        """Return the sections at `x` [m] of orbit `i` at phases [rad], force and moment in them.

        The first dimension of all is that of the phases.
        """
        orbit, at = self._orbit(i), points_of_beam("x", x, self.blade.length)
        phases = finite_values("phase", phase, "rad")
        state = (*orbit.coordinates(phases), *orbit.drive(phases))
        standing = orbit.system.model.standing(state[0], at)
        loads = orbit.system.section_loads(at, *state)
        return in_newtons(self.blade, at, standing, loads, orbit.system.model.trapeze)

    @cached_property
    def _stability(self) -> tuple[Multipliers, ...]:
        return tuple(floquet_multipliers(one, self._covered) for one in self.nondimensional)

    @property
    def multipliers(self) -> ComplexArray:
        """Floquet multipliers (orbits, 8) of the lowest four modes; of free orbits two are 1.

        Those of motion in the plane, if the orbits are planar; `out_of_plane` has the others.
        Computed when first asked for.
        """
        return np.array([stability.lowest for stability in self._stability])

    @property
    def stable(self) -> NDArray[np.bool_]:
        """Whether small disturbances do not grow, (orbits,): in all directions, or as `covers`.

        No Floquet multiplier lies outside the unit circle: of a free orbit in the plane for the
        lowest six modes, which the integration over a period resolves, and out of it as
        `out_of_plane` has it. Computed when first asked for.
        """
        inside = np.array([one.stable(self._tolerance) for one in self._stability])
        return inside if self._growth is None else inside & self._growth.stable

    @property
    def covers(self) -> str:
        """Directions that `stable` is about: "all directions", or the plane alone and the reason.

        Out of the plane it is unknown where the section is, or shears.
        """
        return f"the plane alone: {self._beyond}" if self._beyond else "all directions"

    @cached_property
    def _beyond(self) -> str | None:
        """Reason why nothing is known out of the plane, "" if it is; None of orbits in space."""
        reason: str | None = self.nondimensional[0].system.model.beyond(self.blade, self.theory)
        return reason

    @cached_property
    def _growth(self) -> GrowthOutOfPlane | None:
        """Growth out of the plane, None where the multipliers have all or it is unknown."""
        return self.out_of_plane(confirm=self._confirms) if self._beyond == "" else None

    @one_thread
    def out_of_plane(
        self,
        damping: float = 0.0,
        *,
        blade_damping: Damping | None = None,
        confirm: bool = True,
    ) -> GrowthOutOfPlane:
        """Return how what leaves the plane grows about each planar orbit.

        The planar orbits stay as they are: free ones are undamped, for damped motion is not
        periodic. What leaves their plane may be damped.

        Parameters
        ----------
        damping : float
            Damping ratio ζ of every mode of flap and torsion of the straight blade in rotation.
        blade_damping : Damping, optional
            Damping of the blade against flap and torsion. By default that of the orbits' blade:
            of a response its own, of free orbits none.
        confirm : bool
            Whether twice as many functions and steps confirm each number. Without it, about a
            drive slower than the blade in a tenth of the time, nothing is marked as converged.

        Raises
        ------
        ValueError
            If the orbits are in space; if the section out of the plane is unknown, or its torsion
            where that decides; if twist has no inertia; if the theory has shear; if the blade
            turns so fast that its flap modes are not resolved.

        Examples
        --------
        >>> from analytic import Beam, Rectangle, periodic_orbits
        >>> strip = Beam.reference().with_shape(Rectangle())
        >>> orbits = periodic_orbits(strip, 4.0, [0.02, 0.08])
        >>> print(orbits.stable, orbits.covers)
        [ True False] all directions
        >>> print(orbits.out_of_plane(damping=0.005).modes[1])
        ('flap 4', 'flap 5')
        """
        if self._beyond is None:
            raise ValueError(
                "these orbits are in space and have no plane to leave: `stable` is about all "
                "directions"
            )
        blade = self.blade if blade_damping is None else self.blade.with_damping(blade_damping)
        require_out_of_plane(blade, self.theory)
        ratio = not_negative("damping", damping)
        return GrowthOutOfPlane(
            blade=blade, omega=self.omega, mode=self.mode, theory=self.theory,
            amplitude=self.amplitude, frequency=self.frequency,
            **growth_about(self.nondimensional, blade, self.theory, ratio, confirm),
        )  # fmt: skip

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
        courses = []
        for orbit in self.nondimensional:
            count, model = 8 * orbit.harmonics, orbit.system.model
            q, _, _ = orbit.coordinates(2.0 * np.pi * np.arange(count) / count)
            place = model.places(q, np.ones(1))[:, 0]
            series = np.fft.rfft(np.column_stack((place[:, 1:], model.tip_turn(q))), axis=0)
            courses.append(np.fft.irfft(series, _SAMPLES, axis=0) * _SAMPLES / count)
        return courses


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
