"""What grows out of one linear mode: the branch of its periodic orbits."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

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
from ..beam.continuum import Continuum
from ..beam.steady import SteadyBeam, steady_rotation
from ..linear.modes import solve_modes

_LONGEST_STEP = 0.1  # of |q|/L from one orbit to the next


class AmplitudeNotReachedError(RuntimeError):
    """An amplitude was not reached; `backbone` is the Backbone of those that were, or None."""

    def __init__(self, message: str, backbone: Any = None) -> None:
        super().__init__(message)
        self.backbone = backbone


@dataclass(frozen=True, kw_only=True)
class Branch:
    """What grows out of one linear mode.

    Attributes
    ----------
    beam : Beam or Blade
    omega : float
    mode : int
    modes : ndarray
        Nondimensional frequencies that the functions resolve.
    path : Path
        The orbits, laid as far as they were asked for.
    """

    beam: AnyBlade
    omega: float
    mode: int
    modes: FloatArray
    path: Path[SteadyBeam]

    @property
    def name(self) -> str:
        """What it is called in a sentence."""
        return f"mode {self.mode} at omega = {self.omega:g} rad/s"


def branch_of(
    beam: AnyBlade, omega: float, mode: int, model: Continuum, care: Care | None = None
) -> Branch:
    """Return the branch of a mode, with as many functions as its smallest orbits need."""
    steady, small = steady_rotation(beam, omega, model), 0.02 / mode**2
    while True:
        modes = solve_modes(steady)
        shape, linear = modes.coordinates[mode - 1], float(modes.frequencies[mode - 1])
        try:
            tangent = LastTangent()
            seed = solve(linear_orbit(steady, shape, linear, small), small, tangent)
            double = solve(seed.scaled(2.0 * small), 2.0 * small, tangent)
        except NoOrbitError as failed:
            reason = f"{failed}; 2 or 3 times its frequency may be that of another mode"
        else:
            if meets_the_equations(double):
                resolved = modes.frequencies[: steady.functions // 2]
                path = Path(
                    seed=seed,
                    double=double,
                    longest=_LONGEST_STEP,
                    care=care or THOROUGH,
                    tangent=tangent,
                )
                return Branch(beam=beam, omega=omega, mode=mode, modes=resolved, path=path)
            reason = (
                f"{steady.functions} functions meet the equations of motion to "
                f"{double.residual:.1e} only; rotate slower"
            )
        steady = steady.refined()
        if steady.functions > MOST_FUNCTIONS:
            raise AmplitudeNotReachedError(
                f"no periodic orbit grows out of mode {mode} at omega = {omega:g} rad/s even at "
                f"a = {small:g}: {reason}"
            )
