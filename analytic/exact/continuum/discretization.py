"""The discretization of a blade: of the plane of bending, or in space."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ...blade import Blade
from ...blade_checks import require_blade
from ...loads import Load
from ...theory import Theory, require_theory
from ...warning import warn
from .basis import StrainFunctions
from .loading import loaded
from .planar import Continuum
from .planar_rotation import require_shear, resolved_model
from .space import SpaceContinuum
from .unit import space_unit

FUNCTIONS = 12
"""Functions for each curvature of bending, at least, on a blade without point masses."""
Model = Continuum | SpaceContinuum
_STEEP = 0.5  # slope of fibers, whose square is left out


def space_continuum(
    blade: Blade, theory: Theory, functions: int, loads: Sequence[Load] = ()
) -> SpaceContinuum:
    """Return the discretization by at least so many functions for each curvature."""
    require_section(blade)
    require_shear(blade, require_theory(theory))
    if theory.engesser:
        raise ValueError("Engesser's law of shear is known in the plane: leave engesser out")
    unit = replace(space_unit(blade), loaded=loaded(loads, blade))
    a_panel = max(4, math.ceil(functions / unit.panel_count))
    model = SpaceContinuum(
        StrainFunctions(
            blade=unit,
            theory=theory,
            slenderness=blade.slenderness,
            bending=a_panel,
            torsion=a_panel,
            axial=max(4, 5 * a_panel // 8),
        )
    )
    _warn_if_steep(blade, model)
    return model


def _warn_if_steep(blade: Blade, model: SpaceContinuum) -> None:
    """Warn of a twist so steep that its trapeze effect, which grows without bound, is none."""
    strains = model.strains
    fibers = np.abs(strains.twist) * np.sqrt(strains.trapeze)
    if (steepest := float(fibers.max())) > _STEEP:
        place = blade.length * float(model.points[fibers.argmax()])
        warn(
            f"at x = {place:.6g} m the twist is so steep that fibers at the radius of gyration "
            f"slope by {steepest:.3g}: the trapeze effect of the twist holds for small slopes. "
            "Where the twist steps take Theory(trapeze='elastic'), on the command line "
            """--theory 'trapeze="elastic"'"""
        )


def leaves_plane(blade: Blade) -> bool:
    """Whether flap, lag and torsion of a blade go together.

    A setting angle mixes them where the stiffness out of the plane and in torsion is known.
    """
    require_blade(blade)
    return not blade.is_planar or (blade.unit.angle != 0.0 and blade.section.knows_space)


def continuum_of(
    blade: Blade,
    theory: Theory,
    functions: int,
    for_each: int,
    *,
    mode: int = 1,
    axial: int | None = None,
    loads: Sequence[Load] = (),
    leaves: bool = False,
) -> Model:
    """Return the discretization: of the plane of bending, the quick way, where nothing leaves it.

    There `functions` are those for the tangent's angle, which resolve the `mode`, elsewhere
    `for_each` those for each curvature. A setting angle mixes flap, lag and torsion where the
    stiffness out of the plane and in torsion is known.
    """
    require_blade(blade)
    lifted = any(load.leaves_plane for load in loads)
    if leaves_plane(blade) or leaves or lifted or blade.section.needs_space(require_theory(theory)):
        return space_continuum(blade, theory, for_each, loads)
    return resolved_model(blade, mode, theory, functions, axial, loaded(loads, blade))


def require_section(blade: Blade) -> None:
    """Refuse a blade whose stiffness out of the plane or in torsion is not known."""
    if not blade.section.knows_space:
        raise ValueError(
            "twist, precone, prebend, sweep, offsets, a setting angle, tilted gravity, moments, "
            "loads that follow sections or leave the plane, or a kick bend a blade out of its "
            "plane and twist it: give its stiffness there by "
            "blade.with_section_out_of_plane(bending_ratio, torsion_ratio), math.inf for a section "
            "that does not twist"
        )
