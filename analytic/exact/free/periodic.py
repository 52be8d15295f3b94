"""The exact backbone computed: periodic orbits of the exact beam, followed in amplitude."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ...arrays import FloatArray
from ...beam import AnyBlade, require_undamped, warn_if_rpm
from ...input_checks import finite_values, rotation_speed, whole_number
from ...methods.continuation import FREQUENCY_BOUND
from ...methods.newton import NoOrbitError
from ...theory import BERNOULLI_EULER, Theory
from ...threads import one_thread
from ..beam.discretization import finer_model
from ..beam.steady import BeamOrbit
from ..linear.modes import resolved_model
from .backbone import Backbone
from .branch import AmplitudeNotReachedError, Branch, branch_of
from .internal_resonance import nearest_resonance, outstanding, warn_of_resonances

_RELAID = 3  # times, each on half as many functions again


@one_thread
def periodic_orbits(
    beam: AnyBlade,
    omega: float,
    amplitudes: float | Sequence[float] | FloatArray,
    mode: int = 1,
    *,
    theory: Theory = BERNOULLI_EULER,
    functions: int = 16,
) -> Backbone:
    """Return the periodic orbits of the exact beam that grow out of one mode.

    Geometrically exact, undamped beam in steady rotation; harmonic balance in time on Legendre
    polynomials in space, continued in amplitude. The number of harmonics grows until the Jacobi
    integral is constant to 2e-11, that of functions until half as many again change the frequency
    by at most 1e-9. Near an internal resonance several orbits may have one amplitude: there the
    branch is laid again on more functions, until it leads to the same orbit. `frequency_error`
    tells what is left.

    Parameters
    ----------
    beam : Beam or Blade
    omega : float
        Rotation speed ω [rad/s].
    amplitudes : float or sequence of float
        Peak tip deflections |q|/L, above 0 and below 1, in any order.
    mode : int
        In-plane mode from which the orbits grow, from 1.
    theory : Theory
        Extension, shear and rotary inertia.
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

    Examples
    --------
    >>> from analytic import Beam, periodic_orbits
    >>> found = periodic_orbits(Beam.reference(), omega=6.0, amplitudes=[0.1, 0.2, 0.3])
    >>> print(found.frequency.round(5))
    [3.72966 3.72742 3.72357]
    >>> print(f"ω_NL = {found.omega_n:.5f} (1 - {found.lambda_omega:.4f} a²) rad/s as a → 0")
    ω_NL = 3.73040 (1 - 0.0197 a²) rad/s as a → 0
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
    model = resolved_model(beam, mode, theory, functions)
    branch = branch_of(beam, omega, mode, model)
    ascending, place = np.unique(asked, return_inverse=True)
    found, refused = _found(branch, ascending)
    found = _confirmed(branch, found)
    warn_of_resonances(list(found.values()), branch.modes, mode, beam.frequency_scale)
    kept = [found[a] for a in ascending[place].tolist() if a in found]
    backbone = _backbone(branch, kept) if kept else None
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


def _confirmed(branch: Branch, found: dict[float, BeamOrbit]) -> dict[float, BeamOrbit]:
    """Return the orbits; of those near a resonance, where several have one amplitude, confirmed.

    The branch is laid again on more functions, which may lead into another orbit, until that
    changes no frequency. What it changed last is the error.
    """
    for _ in range(_RELAID):
        suspects = [a for a, o in found.items() if outstanding(o, branch.modes, branch.mode)]
        if not suspects:
            break
        model = finer_model(branch.path.seed.system.model)
        branch = branch_of(branch.beam, branch.omega, branch.mode, model)
        finer, _ = _found(branch, np.sort(suspects))
        changes = []
        for a in suspects:
            one = finer.get(a, found[a])
            changes.append(
                abs(one.frequency / found[a].frequency - 1.0) if a in finer else math.inf
            )
            error = max(one.frequency_error, changes[-1])
            found[a] = replace(one, frequency_error=error)
        if max(changes) <= FREQUENCY_BOUND:
            break
    return found


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


def _backbone(branch: Branch, orbits: Sequence[BeamOrbit]) -> Backbone:
    """Return the orbits as a backbone; λ_ω is extrapolated from the two smallest."""
    linear = float(branch.modes[branch.mode - 1])
    near, far = (
        (1.0 - o.frequency / linear) / o.amplitude**2
        for o in (branch.path.seed, branch.path.double)
    )
    count = max(orbit.harmonics for orbit in orbits)
    per_second = branch.beam.frequency_scale
    return Backbone(
        beam=branch.beam,
        omega=branch.omega,
        mode=branch.mode,
        omega_n=linear * per_second,
        amplitude=np.array([orbit.amplitude for orbit in orbits]),
        frequency=np.array([orbit.frequency for orbit in orbits]) * per_second,
        lambda_omega=float((4.0 * near - far) / 3.0),
        lambda_omega_error=float(abs(near - far) / 3.0),
        harmonics=np.array([np.pad(o.gauge_sines, (0, count - o.harmonics)) for o in orbits]),
        frequency_error=np.array([orbit.frequency_error for orbit in orbits]),
        residual=np.array([orbit.residual for orbit in orbits]),
        jacobi_drift=np.array([orbit.invariant_drift for orbit in orbits]),
        _orbits=tuple(orbits),
    )
