"""The exact backbone computed: periodic orbits of the exact beam, followed in amplitude."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..beam import AnyBlade, require_undamped, warn_if_rpm
from ..input_checks import finite_values, rotation_speed, whole_number
from ..methods.continuation import (
    MOST_FUNCTIONS,
    THOROUGH,
    Care,
    Path,
    linear_orbit,
    meets_the_equations,
)
from ..methods.harmonic_balance import LastTangent, NoOrbitError, solve
from .backbone import AmplitudeNotReachedError, Backbone
from .continuum import Continuum
from .internal_resonance import nearest_resonance, warn_of_resonances
from .modes import resolved_model, solve_modes
from .steady import BeamOrbit, SteadyBeam, steady_rotation

_LONGEST_STEP = 0.1  # of |q|/L from one orbit to the next


def periodic_orbits(
    beam: AnyBlade,
    omega: float,
    amplitudes: float | Sequence[float] | FloatArray,
    mode: int = 1,
    *,
    inextensible: bool = False,
    rotary_inertia: bool = False,
    functions: int = 16,
) -> Backbone:
    """Return the periodic orbits of the exact beam that grow out of one mode.

    Geometrically exact, extensible, undamped Bernoulli-Euler beam in steady rotation; harmonic
    balance in time on Legendre polynomials in space, continued in amplitude. The number of
    harmonics grows until the Jacobi integral is constant to 2e-11, that of functions until the
    residual is at most 1e-4.

    Parameters
    ----------
    beam : Beam or Blade
    omega : float
        Rotation speed ω [rad/s].
    amplitudes : float or sequence of float
        Peak tip deflections |q|/L, above 0 and below 1, in any order.
    mode : int
        In-plane mode from which the orbits grow, from 1.
    inextensible, rotary_inertia
        As for `linear_modes`.
    functions : int
        Least number of functions for the tangent's angle; they grow where an orbit needs more.

    Raises
    ------
    ValueError
        If an argument is out of range, or the mode beyond what the functions resolve.
    AmplitudeNotReachedError
        If an amplitude is not reached with a small residual; its `.backbone` holds those below.

    Warns
    -----
    RotbeamWarning
        Where a harmonic of an orbit comes within 2 % of another mode's frequency.
    """
    omega = rotation_speed(omega)
    mode = whole_number("mode", mode)
    asked = finite_values("amplitudes", amplitudes)
    if asked.min() <= 0.0 or asked.max() >= 1.0:
        wrong = asked.min() if asked.min() <= 0.0 else asked.max()
        raise ValueError(
            f"amplitudes must lie between 0 and 1, got {wrong:g}: they are the peak deflection "
            "of the tip over the beam's length"
        )
    warn_if_rpm(beam, omega)
    require_undamped(beam, "a damped blade has no free periodic orbits")
    model = resolved_model(beam, mode, inextensible, rotary_inertia, functions)
    branch = branch_of(beam, omega, mode, model)
    ascending, place = np.unique(asked, return_inverse=True)
    found, refused = _found(branch, ascending)
    warn_of_resonances(list(found.values()), branch.modes, mode, beam.frequency_scale)
    kept = [found[a] for a in ascending[place].tolist() if a in found]
    backbone = branch.backbone(kept) if kept else None
    if backbone is None or refused:
        raise AmplitudeNotReachedError(refused, backbone)
    return backbone


def _found(branch: Branch, ascending: FloatArray) -> tuple[dict[float, BeamOrbit], str]:
    """Return the orbits found by their amplitudes, and what to say of the first that was not."""
    found: dict[float, BeamOrbit] = {}
    refused = ""
    for a in ascending.tolist():
        try:
            found[a] = branch.path.at(a)
        except NoOrbitError as reason:
            refused = refused or (
                f"no orbit of {branch.name} with a peak |q|/L of {a:g} was found: {reason}"
                f"{_why(branch, a)}"
            )
    return found, refused


def _why(branch: Branch, a: float) -> str:
    """Return what stands in the way of an orbit, and what to try."""
    if a < branch.path.seed.amplitude:
        return (
            "; round-off drowns so small an orbit, so take linear_modes, from which it differs by "
            "the square of its amplitude"
        )
    nodes = branch.path.nodes
    below = [orbit for orbit in nodes if orbit.amplitude <= a]
    nearest = nearest_resonance(below, branch.modes, branch.mode)
    if below[-1] is nodes[-1]:
        return f"{nearest}; ask for smaller amplitudes"
    return f"{nearest}; ask for amplitudes beyond it, or take backbone_branch, which follows it"


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

    def backbone(self, orbits: Sequence[BeamOrbit]) -> Backbone:
        """Return the orbits as a backbone; λ_ω is extrapolated from the two smallest."""
        linear = float(self.modes[self.mode - 1])
        near, far = (
            (1.0 - o.frequency / linear) / o.amplitude**2
            for o in (self.path.seed, self.path.double)
        )
        count = max(orbit.harmonics for orbit in orbits)
        per_second = self.beam.frequency_scale
        return Backbone(
            beam=self.beam,
            omega=self.omega,
            mode=self.mode,
            omega_n=linear * per_second,
            amplitude=np.array([orbit.amplitude for orbit in orbits]),
            frequency=np.array([orbit.frequency for orbit in orbits]) * per_second,
            lambda_omega=float((4.0 * near - far) / 3.0),
            lambda_omega_error=float(abs(near - far) / 3.0),
            harmonics=np.array(
                [np.pad(o.gauge_harmonics, (0, count - o.harmonics)) for o in orbits]
            ),
            residual=np.array([orbit.residual for orbit in orbits]),
            jacobi_drift=np.array([orbit.invariant_drift for orbit in orbits]),
            _orbits=tuple(orbits),
        )


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
                path = Path(seed=seed, double=double, longest=_LONGEST_STEP, care=care or THOROUGH)
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
