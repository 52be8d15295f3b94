"""Linear modes of the exact beam about its rotating steady state."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ...blade import Blade
from ...blade_checks import warn_if_rpm, with_torsion
from ...input_checks import rotation_speed, shown, whole_number
from ...settled import require_tolerance, settled
from ...theory import BERNOULLI_EULER, Theory, require_theory
from ...threads import one_thread
from ..continuum.discretization import FUNCTIONS, continuum_of, leaves_plane
from ..continuum.rotation import SteadyBlade, finer_blades, rotating_blade
from .families import FAMILIES, Family, LinearModes, mode_names, modes_of, places_of

_WHOLE = 1.25  # times the last change is an error that falls by 5 or more each time
_FALLS = 50.0  # by which functions made of answers lessen it once; 300 and more in 240 trials
_SLOW = 12.0  # up to this w̄: in faster rotation it falls by less


@one_thread
def linear_modes(
    blade: Blade,
    omega: float,
    count: int = 3,
    *,
    only: Family | None = None,
    theory: Theory = BERNOULLI_EULER,
    functions: int = 20,
    tolerance: float | None = None,
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
        modes are resolved. They grow until more change no frequency by the tolerance.
    tolerance : float, optional
        Largest relative change of the frequencies by the last refinement; by default 1e-9, of a
        blade from stations 1e-6. Short of it a warning comes with the answer, whose `error` states
        how far.

    Raises
    ------
    ValueError
        If the section out of the plane is needed and unknown; if `omega` is negative, not finite,
        or tears the beam; if the functions do not resolve `count` modes, or 256 do not settle the
        frequencies to 1e-3, as far beyond w̄ = ω/√(EI/mL³) = 5000, where the layer at the clamp
        becomes too thin, or within 1 % of the burst.

    Examples
    --------
    >>> from analytic import Beam, linear_modes
    >>> modes = linear_modes(Beam.reference(), omega=6.0)
    >>> print(*modes.names, modes.frequencies.round(5))
    lag 1 lag 2 lag 3 [ 3.7304  23.01006 56.64712]
    """
    omega = rotation_speed(omega)
    warn_if_rpm(blade, omega)
    return modes_from(None, blade, omega, count, only, theory, functions, tolerance)


def modes_from(
    near: LinearModes | None,
    blade: Blade,
    omega: float,
    count: int,
    only: Family | None,
    theory: Theory,
    functions: int,
    tolerance: float | None,
) -> LinearModes:
    """Return `linear_modes`, of a table with the functions that modes at a speed nearby took."""
    count = whole_number("count", count)
    require_theory(theory)
    require_family(only)
    section = blade.section
    unknown = section.out_of_plane is None and not section.knows_space
    leaves = only not in ("lag", "axial") and not unknown
    if leaves:
        blade = _known_in_space(blade, only)
    return _settled_modes(
        blade, omega, count, theory, functions, tolerance, only, leaves=leaves, near=near
    )


def driven_modes(
    blade: Blade,
    omega: float,
    count: int = 1,
    *,
    theory: Theory = BERNOULLI_EULER,
    functions: int = 20,
    tolerance: float | None = None,
) -> LinearModes:
    """Return the lowest modes that a drive in the plane of rotation excites.

    Those of the plane of bending of a planar blade, and all of others.
    """
    warn_if_rpm(blade, rotation_speed(omega))
    return _settled_modes(blade, omega, count, theory, functions, tolerance)


def _settled_modes(
    blade: Blade,
    omega: float,
    count: int,
    theory: Theory,
    functions: int,
    tolerance: float | None,
    only: Family | None = None,
    *,
    leaves: bool = False,
    near: LinearModes | None = None,
) -> LinearModes:
    # Rotation bends the blade in a layer at the clamp, √2/w̄ thin, which takes ~√w̄ functions.
    each = max(FUNCTIONS, 2 * count + 4)
    model = continuum_of(blade, theory, functions, each, mode=count, leaves=leaves)
    if near is not None and model.answers:
        model = near.model
    first = rotating_blade(blade, omega, model)

    def finer(steady: SteadyBlade) -> SteadyBlade:
        if only is None or not model.answers:
            return steady.resolving(count)
        return steady.resolving(
            1 + max(places_of(mode_names(steady.shares), count, only), default=0)
        )

    modes, _, error = settled(
        lambda steady: modes_of(blade, omega, theory, steady).lowest(count, only),
        finer_blades(first, finer),
        require_tolerance(tolerance, model.tolerance),
        lambda modes: _WHOLE * np.log(modes.frequencies),
        f"the frequencies at omega = {omega:g} rad/s, w_bar = ω/√(EI/mL³) = {first.rate:.4g}",
        "ask for fewer modes, or rotate slower",
        falls=_FALLS if model.answers and first.rate <= _SLOW else 1.0,
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
    if only == "torsion" and out is not None and out.torsion_ratio in (None, math.inf):
        raise ValueError(
            "torsion has no modes where torsion_ratio is unknown or infinite: give GJ/EI by "
            "with_section_out_of_plane or with_shape"
        )
    return blade if leaves_plane(blade) else with_torsion(blade)


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
