"""The path of free orbits that grow out of one linear mode."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from ...arrays import FloatArray
from ...blade import Blade
from ...methods.continuation import (
    MOST_FUNCTIONS,
    THOROUGH,
    Care,
    Path,
    linear_orbit,
    meets_the_equations,
)
from ...methods.harmonic_balance import LastTangent, solve
from ...methods.newton import NoOrbitError
from ...methods.orbit import Orbit
from ...theory import BERNOULLI_EULER, Theory
from ...warning import PartialError
from ..continuum.discretization import Model
from ..continuum.rotation import SteadyBlade, rotating_blade
from ..linear.families import modes_of, orbit_shapes

_LONGEST_STEP = 0.1  # of |q|/L from one orbit to the next


class AmplitudeNotReachedError(PartialError):
    """An amplitude was not reached; its `part` are the Orbits below, or None."""


def place_of(mode: str, names: Sequence[str]) -> int:
    """Return the place of a mode among names, refusing one that is not there."""
    if mode not in names:
        raise ValueError(
            f"this blade has no mode {mode!r}: its lowest are {', '.join(names[:6])}; flap and "
            "torsion need a section that is known out of the plane, as blade.with_shape(...)"
        )
    return names.index(mode)


@dataclass(frozen=True, kw_only=True, eq=False)
class ModePath:
    """Free orbits out of one mode, computed as far as they are needed; base of `Backbone`."""

    blade: Blade
    omega: float
    mode: str = "lag 1"
    theory: Theory = BERNOULLI_EULER
    model: Model = field(repr=False)
    care: Care = field(default_factory=lambda: THOROUGH, repr=False)

    @property
    def name(self) -> str:
        """Its name in a sentence."""
        return f"{self.mode} at omega = {self.omega:g} rad/s"

    @property
    def omega_n(self) -> float:
        """Linear frequency ω_n [rad/s]."""
        return float(self.modes[self.place]) * self.blade.frequency_scale

    @property
    def modes(self) -> FloatArray:
        """Nondimensional frequencies that the functions resolve."""
        return self._begun[0]

    @property
    def names(self) -> tuple[str, ...]:
        """Names of these modes."""
        return self._begun[1]

    @property
    def place(self) -> int:
        """Place of the mode among them, from 0."""
        return self.names.index(self.mode)

    @property
    def path(self) -> Path[SteadyBlade]:
        """Orbits by their amplitude, computed as far as they are needed."""
        return self._begun[2]

    def softening(self) -> tuple[float, float]:
        """Return λ_ω, extrapolated from the smallest orbits, and what the last of them changed.

        From two, or three, as the discretization has it and they are found.
        """
        near, far = self._softening(self.path.seed), self._softening(self.path.double)
        by_two = (4.0 * near - far) / 3.0
        third = None
        if self.model.softening_orbits > 2:
            with suppress(NoOrbitError):
                third = self._softening(self.path.at(3.0 * self.path.seed.amplitude))
        if third is None:
            return by_two, abs(near - far) / 3.0
        by_three = 1.5 * near - 0.6 * far + 0.1 * third
        return by_three, abs(by_three - by_two)

    def _softening(self, orbit: Orbit[Any]) -> float:
        linear = float(self.modes[self.place])
        return float((1.0 - orbit.frequency / linear) / orbit.amplitude**2)

    @cached_property
    def _begun(self) -> tuple[FloatArray, tuple[str, ...], Path[SteadyBlade]]:
        """The modes and the path, with as many functions as its smallest orbits need."""
        family, number = self.mode.split()[0], int(self.mode.split()[1])
        gauge = family if family in self.model.gauges else self.model.gauges[0]
        steady = rotating_blade(self.blade, self.omega, self.model, gauge)
        small, near = 0.02 / number**2, "2 or 3 times its frequency may be that of another mode"
        while True:
            modes, tangent = modes_of(self.blade, self.omega, self.theory, steady), LastTangent()
            place = place_of(self.mode, modes.names)
            frequencies = modes.frequencies / self.blade.frequency_scale
            shape, linear = orbit_shapes(modes)[place], frequencies[place]
            try:
                seed = solve(linear_orbit(steady, shape, float(linear), small), small, tangent)
                double = solve(seed.scaled(2.0 * small), 2.0 * small, tangent)
            except NoOrbitError as failed:
                reason = f"{failed}; {near}"
            else:
                if meets_the_equations(double, self.care):
                    path = Path(
                        seed=seed, double=double, longest=_LONGEST_STEP,
                        care=self.care, tangent=tangent,
                    )  # fmt: skip
                    count = max(steady.model.resolved, place + 1)
                    return frequencies[:count], modes.names[:count], path
                slow = double.truncation > 0.5 * double.residual
                reason = (
                    f"{double.harmonics} harmonics leave a residual of {double.truncation:.1e}; "
                    f"{near}"
                    if slow
                    else f"{steady.functions} functions meet the equations of motion to "
                    f"{double.residual:.1e} only; rotate slower"
                )
            steady = steady.refined()
            if steady.functions > MOST_FUNCTIONS:
                raise AmplitudeNotReachedError(
                    f"no periodic orbit grows out of {self.name} even at a = {small:g}: {reason}"
                )
