"""Discretizations of a blade in its plane of bending, as many functions as are asked for."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...arrays import FloatArray, evaluated, in_units
from ...blade import Blade
from ...blade_checks import require_planar
from ...input_checks import whole_number
from ...shape_functions import shape_functions
from ...theory import Theory, require_theory
from ...unit_blade import UnitBlade
from .planar import MOST_FUNCTIONS, Continuum, continuum


def blade_continuum(
    blade: Blade, theory: Theory, bending: int, axial: int, loaded: tuple[float, ...] = ()
) -> Continuum:
    """Return the discretization by at least so many functions, as many on every panel."""
    require_planar(blade)
    unit = replace(_unit(blade, require_theory(theory)), loaded=loaded)
    slenderness, axial = (blade.slenderness, axial) if theory.extension else (0.0, 1)
    bending, axial = (shape_functions(unit, count).count for count in (bending, axial))
    share = theory.shear
    if share is True:
        GA, L = blade.section.shear_stiffness, blade.length
        root = float(evaluated(GA, np.zeros(1))[0])
        share, unit = root / blade.axial_stiffness, replace(unit, shear=in_units(GA, L, root))
    return continuum(slenderness, bending, axial, unit, share, theory.engesser)


def resolved_model(
    blade: Blade,
    mode: int,
    theory: Theory,
    functions: int,
    axial: int | None = None,
    loaded: tuple[float, ...] = (),
) -> Continuum:
    """Return the discretization, refusing a mode that it does not resolve."""
    functions = whole_number("functions", functions, least=4)
    if functions > MOST_FUNCTIONS or mode > MOST_FUNCTIONS // 2:
        raise ValueError(
            f"at most {MOST_FUNCTIONS} functions are taken, which resolve {MOST_FUNCTIONS // 2} "
            f"modes, got functions={functions} for mode {mode}: ask for less"
        )
    if mode > functions // 2:
        raise ValueError(
            f"mode {mode} is beyond the {functions // 2} that {functions} functions resolve; "
            f"ask for functions={2 * mode} or more"
        )
    return blade_continuum(blade, theory, functions, axial or max(4, 5 * functions // 8), loaded)


def require_shear(blade: Blade, theory: Theory) -> None:
    """Refuse a number for sections that have their shear stiffness, and True for others."""
    if theory.shear is not None and (theory.shear is True) != bool(blade.table):
        raise ValueError(
            f"shear = {theory.shear} does not fit the blade: a blade from stations has its "
            "shear stiffness, take Theory(shear=True); others need the ratio to EA, as "
            "Theory(shear=0.32)"
        )


def _unit(blade: Blade, theory: Theory) -> UnitBlade:
    """Return the blade without dimensions, with the rotary inertia of its slices."""
    require_shear(blade, theory)
    unit = replace(blade.unit, cuts=blade.section.cuts(blade.length))
    given = blade.section.rotary_inertia is not None
    if given or not theory.rotary_inertia:
        return unit
    x = np.linspace(0.0, 1.0, 257)
    if not np.allclose(evaluated(unit.mass, x), evaluated(unit.axial, x), rtol=1e-9):
        raise ValueError(
            "mass and axial stiffness of the blade do not vary alike, so that its sections "
            "have no one ρ/E to take their rotary inertia from: give "
            "Section(rotary_inertia=...) in kg m"
        )
    return replace(unit, rotary=in_units(unit.bending, 1.0, 1.0 / blade.slenderness))


def on_more(q: FloatArray, counts: tuple[int, ...], finer: tuple[int, ...]) -> FloatArray:
    """Return coordinates of the same shape where each family has as many functions or more."""
    parts = np.split(q, np.cumsum(counts)[:-1], axis=-1)
    more = [[(0, 0)] * (q.ndim - 1) + [(0, n - m)] for m, n in zip(counts, finer, strict=True)]
    return np.concatenate(list(map(np.pad, parts, more)), axis=-1)
