"""Linear modes of the exact beam about its rotating steady state, and how fast they decay."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ...arrays import ComplexArray, FloatArray
from ...blade import Blade
from ...blade_checks import warn_if_rpm
from ...input_checks import rotation_speed, shown, whole_number
from ...methods.system import inverse_eigenvalues
from ...settled import refined, settled
from ...theory import BERNOULLI_EULER, Theory, require_theory
from ...threads import one_thread
from ..continuum.planar import Continuum
from ..continuum.planar_rotation import (
    MOST_FUNCTIONS,
    Modes,
    SteadyBeam,
    resolved_model,
    solve_modes,
    steady_rotation,
)
from ..continuum.rotation import lives_in_space, rotating_blade
from ..continuum.space import SpaceContinuum
from .space_modes import FAMILIES, Family, LinearModes, mode_names, space_modes, space_modes_on

_SETTLED = 1e-9  # relative change of the frequencies from one basis to the next, far above noise
_SAME = 0.3  # how far |λ| may be from the undamped frequency, relative to it


@one_thread
def linear_modes(
    blade: Blade,
    omega: float,
    count: int = 3,
    *,
    only: Family | None = None,
    theory: Theory = BERNOULLI_EULER,
    functions: int = 20,
) -> LinearModes:
    """Return the modes of the beam in steady rotation at `omega`, by name and ascending.

    Undamped and geometrically exact: about the steady state, with the Coriolis coupling. They are
    all that the blade's data allow; where the section out of the plane is unknown, those of lag and
    axial motion. In the plane and without extension they are the modes of
    v'''' - (w̄²/2)[(1 - x²)v']' - (w̄² + w̄_n²)v = 0, from which the corrected Eq. 81 follows.

    Parameters
    ----------
    blade : Blade
    omega : float
        Rotation speed ω [rad/s].
    count : int
        Number of modes.
    only : {"flap", "lag", "torsion", "axial"}, optional
        One family: modes that have most of their kinetic energy in this motion.
    theory : Theory
        Extension, shear, rotary inertia, trapeze effect.
    functions : int
        Least number of functions for the tangent's angle in the plane, at most 256; half as many
        modes are resolved. They grow by half until half as many again change no frequency by 1e-9.

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
    >>> modes = linear_modes(Beam.reference(), omega=6.0)
    >>> print(*modes.names, modes.frequencies.round(5))
    lag 1 lag 2 lag 3 [ 3.7304  23.01006 56.64712]
    """
    omega = rotation_speed(omega)
    count = whole_number("count", count)
    require_theory(theory)
    warn_if_rpm(blade, omega)
    require_family(only)
    section = blade.section
    unknown = section.out_of_plane is None and not section.at_stations
    if not lives_in_space(blade) and (only in ("lag", "axial") or unknown):
        return _modes_in_plane(blade, omega, count, theory, functions, only)
    return space_modes(_known_in_space(blade, only), omega, count, theory, only)


def driven_modes(
    blade: Blade,
    omega: float,
    count: int = 1,
    *,
    theory: Theory = BERNOULLI_EULER,
    functions: int = 20,
) -> LinearModes:
    """Return the lowest modes that a drive in the plane of rotation excites.

    Those of the plane of bending of a planar blade, and all of others.
    """
    warn_if_rpm(blade, rotation_speed(omega))
    if lives_in_space(blade):
        return space_modes(blade, omega, count, theory)
    return _modes_in_plane(blade, omega, count, theory, functions, None)


def _modes_in_plane(
    blade: Blade, omega: float, count: int, theory: Theory, functions: int, only: Family | None
) -> LinearModes:
    # Rotation bends the blade in a layer at the clamp, √2/w̄ thin, which takes ~√w̄ functions.
    first = steady_rotation(blade, omega, resolved_model(blade, count, theory, functions))
    modes, _, error = settled(
        lambda steady: modes_on(steady.model, blade, omega, count, theory, only),
        refined(first, SteadyBeam.refined, lambda most: most.functions > MOST_FUNCTIONS),
        _SETTLED,
        lambda modes: np.log(modes.frequencies),
        f"the frequencies at omega = {omega:g} rad/s, w_bar = ω/√(EI/mL³) = {first.rate:.4g}",
        "rotate slower",
    )
    return replace(modes, error=error)


def require_family(only: object) -> None:
    """Refuse a name that is no family of modes."""
    if only is not None and only not in FAMILIES:
        raise ValueError(f"only must be one of {', '.join(FAMILIES)}, got {shown(only)}")


def _known_in_space(blade: Blade, only: Family | None) -> Blade:
    """Return a blade with its stiffness in torsion; one that is unknown is taken for rigid.

    Flap of a planar blade does without it; its torsion is refused.
    """
    out = blade.section.out_of_plane
    rigid = out is not None and (out.torsion_ratio is None or math.isinf(out.torsion_ratio))
    if only == "torsion" and rigid:
        raise ValueError(
            "torsion has no modes where torsion_ratio is unknown or infinite: give GJ/EI by "
            "with_section_out_of_plane or with_shape"
        )
    if out is None or out.torsion_ratio is not None or lives_in_space(blade):
        return blade
    return blade.with_section_out_of_plane(out.bending_ratio, math.inf)


def mode_name(blade: Blade, omega: float, mode: object, theory: Theory) -> str:
    """Return the name of a mode, given by name or by its number in `linear_modes`."""
    if not isinstance(mode, str) or mode.isdecimal():
        number = whole_number("mode", int(mode) if isinstance(mode, str) else mode)
        return linear_modes(blade, omega, number, theory=theory).names[number - 1]
    family, _, number_of = mode.partition(" ")
    if family not in FAMILIES or not number_of.isdecimal() or int(number_of) < 1:
        raise ValueError(
            f"mode must be a name, 'lag 1' say, or a number from 1, got {shown(mode)}: families "
            f"are {', '.join(FAMILIES)}"
        )
    return f"{family} {int(number_of)}"


def names_in_plane(steady: SteadyBeam, modes: Modes, setting: float) -> tuple[str, ...]:
    """Return the names of modes in the plane of bending, set at an angle [rad]."""
    return mode_names(steady.model.shares(steady.equilibrium, _phased(steady, modes), setting))


def _phased(steady: SteadyBeam, modes: Modes) -> ComplexArray:
    """Return the shapes with their phases: θ and γ go with the sine, e with the cosine."""
    return np.asarray(modes.coordinates * np.where(steady.odd, 1.0, 1.0j))


def modes_on(
    model: Continuum | SpaceContinuum,
    blade: Blade,
    omega: float,
    count: int,
    theory: Theory,
    only: Family | None = None,
    *,
    near: LinearModes | None = None,
) -> LinearModes:
    """Return the modes on a discretization known to resolve them, unchecked.

    In space the steady state is sought from that of modes on it at a speed nearby.
    """
    if isinstance(model, SpaceContinuum):
        return space_modes_on(model, blade, omega, count, only, near=near)
    steady, setting = steady_rotation(blade, omega, model), blade.setting_angle
    solved = solve_modes(steady)
    shapes = _phased(steady, solved)
    modes = LinearModes(
        blade=blade,
        omega=omega,
        theory=theory,
        frequencies=solved.frequencies * blade.frequency_scale,
        shares=model.shares(steady.equilibrium, shapes, setting),
        error=math.nan,
        model=model,
        coordinates=shapes,
        setting=setting,
        _steady=steady.equilibrium,
    )
    return modes.lowest(count, only)


@one_thread
def damping_ratios(
    blade: Blade, omega: float, count: int = 3, *, theory: Theory = BERNOULLI_EULER
) -> FloatArray:
    """Return the damping ratios ζ of modes, (count,): of a planar blade those in its plane.

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
    modes = driven_modes(blade, omega, count, theory=theory, functions=max(20, 2 * count))
    steady = rotating_blade(blade, omega, modes.model)
    at_rest = np.zeros((1, steady.size))
    tangent = steady.tangent(steady.equilibrium[None], at_rest, at_rest)
    inverse = inverse_eigenvalues(tangent.mass[0], tangent.damping[0], tangent.stiffness[0])
    inverse = inverse[inverse.imag < 0.0]
    size = 1.0 / (np.abs(inverse) * modes.frequencies[:, None] / blade.frequency_scale)
    nearest = np.argmin(np.abs(size - 1.0), axis=1)
    for mode, found in enumerate(nearest):
        if abs(size[mode, found] - 1.0) > _SAME or found in nearest[:mode]:
            raise ValueError(
                f"mode {mode + 1} is damped so much that it does not oscillate: ask for count="
                f"{mode} or less, or take less damping"
            )
    # -Re λ/|λ| is -Re(1/λ)/|1/λ|.
    return np.asarray(-inverse[nearest].real / np.abs(inverse[nearest]))
