"""The path of free orbits that grow out of one linear mode."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, ClassVar

from ...arrays import FloatArray
from ...beam import AnyBlade
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
from ..beam.steady import SteadyBeam, solve_modes, steady_rotation

_LONGEST_STEP = 0.1  # of |q|/L from one orbit to the next


class AmplitudeNotReachedError(RuntimeError):
    """An amplitude was not reached; `orbits` are the Orbits below it, or None."""

    def __init__(self, message: str, orbits: Any = None) -> None:
        super().__init__(message)
        self.orbits = orbits


@dataclass(frozen=True, kw_only=True, eq=False)
class ModePath:
    """Free orbits out of one mode, computed as far as they are needed; base of `Backbone`."""

    at_resonance: ClassVar[str] = "use backbone(...).branch to follow the branches"

    beam: AnyBlade
    omega: float
    mode: int = 1
    theory: Theory = BERNOULLI_EULER
    model: Any = field(repr=False)
    care: Care = field(default_factory=lambda: THOROUGH, repr=False)

    @property
    def name(self) -> str:
        """Its name in a sentence."""
        return f"mode {self.mode} at omega = {self.omega:g} rad/s"

    @property
    def omega_n(self) -> float:
        """Linear frequency ω_n [rad/s]."""
        return float(self.modes[self.mode - 1]) * self.beam.frequency_scale

    @property
    def modes(self) -> FloatArray:
        """Nondimensional frequencies that the functions resolve."""
        return self._begun[0]

    @property
    def path(self) -> Path[SteadyBeam]:
        """Orbits by their amplitude, computed as far as they are needed."""
        return self._begun[1]

    def _rotation(self) -> Any:
        """Return the system of the model."""
        return steady_rotation(self.beam, self.omega, self.model)

    def _solved(self, steady: Any) -> tuple[Any, FloatArray, FloatArray]:
        """Return the system, and frequencies and shapes (modes, n), odd ones in the sine."""
        modes = solve_modes(steady)
        return steady, modes.frequencies, modes.coordinates

    def softening(self) -> tuple[float, float]:
        """Return λ_ω, extrapolated from the two smallest orbits, and what that changed."""
        near, far = self._softenings(self.path.seed, self.path.double)
        return (4.0 * near - far) / 3.0, abs(near - far) / 3.0

    def _softenings(self, *orbits: Orbit[Any]) -> list[float]:
        linear = float(self.modes[self.mode - 1])
        return [float((1.0 - one.frequency / linear) / one.amplitude**2) for one in orbits]

    @cached_property
    def _begun(self) -> tuple[FloatArray, Path[SteadyBeam]]:
        """The modes and the path, with as many functions as its smallest orbits need."""
        steady = self._rotation()
        small, near = 0.02 / self.mode**2, "2 or 3 times its frequency may be that of another mode"
        while True:
            (steady, frequencies, shapes), tangent = self._solved(steady), LastTangent()
            shape, linear = shapes[self.mode - 1], frequencies[self.mode - 1]
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
                    return frequencies[: steady.functions // 2], path
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
