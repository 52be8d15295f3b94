"""Linear modes of the exact beam about its rotating steady state, and how fast they decay."""

from __future__ import annotations

import math
from typing import Any, Literal, get_args

import numpy as np

from ...arrays import FloatArray
from ...beam import AnyBlade, warn_if_rpm
from ...input_checks import rotation_speed, whole_number
from ...methods.system import inverse_eigenvalues
from ...settled import refined, settled
from ...theory import BERNOULLI_EULER, Theory, require_theory
from ...threads import one_thread
from ..beam.continuum import Continuum
from ..beam.steady import (
    MOST_FUNCTIONS,
    Modes,
    SteadyBeam,
    resolved_model,
    solve_modes,
    steady_rotation,
)
from ..space.modes import LinearModes, modes_across, space_modes
from ..space.steady import lives_in_space, space_rotation

_SETTLED = 1e-9  # relative change of the frequencies from one basis to the next, far above noise
_SAME = 0.3  # how far |λ| may be from the undamped frequency, relative to it


Plane = Literal["lag", "flap", "torsion"]
"""A family of modes: in the blade's plane of bending, out of it, or of its twist."""


@one_thread
def linear_modes(
    beam: AnyBlade,
    omega: float,
    count: int = 3,
    *,
    plane: Plane = "lag",
    theory: Theory = BERNOULLI_EULER,
    functions: int = 20,
) -> LinearModes:
    """Return the modes of the beam in steady rotation at `omega`, by default in its plane.

    Undamped and geometrically exact: about the stretched state, with the Coriolis coupling of
    bending and axial motion. Of a theory without extension they are the modes of
    v'''' - (w̄²/2)[(1 - x²)v']' - (w̄² + w̄_n²)v = 0, from which the corrected Eq. 81 follows.

    Parameters
    ----------
    beam : Beam or Blade
    omega : float
        Rotation speed ω [rad/s].
    count : int
        Number of modes.
    plane : str
        "lag" is the blade's own plane of bending, "flap" the plane normal to the plane of rotation.
        "flap" and "torsion" need a blade that bends in the plane of rotation and has a known
        section out of it. To this order they are independent of each
        other. Of a blade with a twist, precone, prebend, sweep, offset, or a setting angle and a
        known section out of the plane, they are not: then these are all of them.
    theory : Theory
        Extension, shear, rotary inertia, trapeze effect.
    functions : int
        Least number of functions for the tangent's angle, at most 256; half as many modes are
        resolved. They grow by half until half as many again change no frequency by 1e-9.

    Raises
    ------
    ValueError
        If the section out of the plane is needed and unknown; if `omega` is negative, not finite,
        or tears the beam; if the functions do not resolve `count` modes. If 256 functions do not
        settle the frequencies: beyond about w̄ = ω/√(EI/mL³) = 5000, where the layer at the clamp
        becomes too thin, and within 1 % of the burst.

    Examples
    --------
    >>> from analytic import Beam, linear_modes
    >>> print(linear_modes(Beam.reference(), omega=6.0).frequencies.round(5))
    [ 3.7304  23.01006 56.64712]
    """
    omega = rotation_speed(omega)
    count = whole_number("count", count)
    require_theory(theory)
    warn_if_rpm(beam, omega)
    if plane not in get_args(Plane):
        raise ValueError(f"plane must be 'lag', 'flap' or 'torsion', got {plane!r}")
    if lives_in_space(beam):
        if plane != "lag":
            raise ValueError(
                f"flap, lag and torsion of this blade go together, and plane is {plane!r}: leave "
                "it out, and take the shares of each mode"
            )
        return space_modes(beam, omega, count, theory)
    if plane != "lag":
        return modes_across(beam, omega, count, theory, plane)
    # Rotation bends the blade in a layer at the clamp, √2/w̄ thin, which takes ~√w̄ functions.
    first = steady_rotation(beam, omega, resolved_model(beam, count, theory, functions))
    (steady, modes), _, error = settled(
        lambda steady: (steady, solve_modes(steady)),
        refined(first, SteadyBeam.refined, lambda most: most.functions > MOST_FUNCTIONS),
        _SETTLED,
        lambda found: np.log(found[1].frequencies[:count]),
        f"the frequencies at omega = {omega:g} rad/s, w_bar = ω/√(EI/mL³) = {first.rate:.4g}",
        "rotate slower",
    )
    return _in_units(beam, omega, count, steady, modes, theory, error)


def modes_on(
    model: Continuum, beam: AnyBlade, omega: float, count: int, theory: Theory
) -> LinearModes:
    """Return the modes on a discretization that is known to resolve them, unchecked."""
    steady = steady_rotation(beam, omega, model)
    return _in_units(beam, omega, count, steady, solve_modes(steady), theory, math.nan)


def _in_units(
    beam: AnyBlade, omega: float, count: int, steady: SteadyBeam, modes: Modes, theory: Theory,
    error: float,
) -> LinearModes:  # fmt: skip
    shapes, setting = modes.coordinates[:count], beam.setting_angle
    return LinearModes(
        beam=beam,
        omega=omega,
        theory=theory,
        frequencies=modes.frequencies[:count] * beam.frequency_scale,
        shares=steady.model.shares(steady.equilibrium, shapes, setting),
        error=error,
        model=steady.model,
        coordinates=shapes,
        setting=setting,
        _steady=steady.equilibrium,
    )


@one_thread
def damping_ratios(
    beam: AnyBlade, omega: float, count: int = 3, *, theory: Theory = BERNOULLI_EULER
) -> FloatArray:
    """Return the damping ratios ζ of the modes of `linear_modes`, (count,).

    ζ = -Re λ/|λ| of the eigenvalues λ of small vibration about the stretched state; free vibration
    of mode j decays as exp(-ζ_j |λ_j| t), with |λ_j| near the frequency of `linear_modes`.

    Parameters
    ----------
    beam, omega, count, theory
        As for `linear_modes`.

    Raises
    ------
    ValueError
        If an input is refused, or a mode is damped so much that it does not oscillate.

    Examples
    --------
    >>> from analytic import Beam, Damping, damping_ratios
    >>> blade = Beam.reference().with_damping(Damping(bending=1e-3, external=0.01))
    >>> for omega in (0.0, 6.0):
    ...     print(damping_ratios(blade, omega).round(5))
    [0.00996 0.01047 0.02601]
    [0.00791 0.00831 0.02347]
    """
    omega, count = rotation_speed(omega), whole_number("count", count, most=MOST_FUNCTIONS // 2)
    modes = linear_modes(beam, omega, count, theory=theory, functions=max(20, 2 * count))
    rotation: Any = space_rotation if lives_in_space(beam) else steady_rotation
    steady = rotation(beam, omega, modes.model)
    at_rest = np.zeros((1, steady.size))
    tangent = steady.tangent(steady.equilibrium[None], at_rest, at_rest)
    inverse = inverse_eigenvalues(tangent.mass[0], tangent.damping[0], tangent.stiffness[0])
    inverse = inverse[inverse.imag < 0.0]
    size = 1.0 / (np.abs(inverse) * modes.frequencies[:, None] / beam.frequency_scale)
    nearest = np.argmin(np.abs(size - 1.0), axis=1)
    for mode, found in enumerate(nearest):
        if abs(size[mode, found] - 1.0) > _SAME or found in nearest[:mode]:
            raise ValueError(
                f"mode {mode + 1} is damped so much that it does not oscillate: ask for count="
                f"{mode} or less, or take less damping"
            )
    # -Re λ/|λ| is -Re(1/λ)/|1/λ|.
    return np.asarray(-inverse[nearest].real / np.abs(inverse[nearest]))
