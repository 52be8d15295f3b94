"""Discretization of the exact blade: functions made once, refined, the same on every panel."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np

from ...beam import AnyBlade, require_planar
from ...input_checks import whole_number
from ...profiles import evaluated, in_units
from ...shape_functions import shape_functions
from ...theory import Theory, require_theory
from ...unit_blade import UnitBlade
from .continuum import Continuum

MOST_FUNCTIONS = 256
"""For θ; beyond, the eigenproblem takes seconds."""


continuum = lru_cache(maxsize=32)(Continuum)
"""The discretization, built once for each set of arguments."""


def finer_model(model: Continuum) -> Continuum:
    """Return the discretization with half as many functions again."""
    panels = model.blade.panel_count

    def more(count: int) -> int:
        a_panel = count // panels
        # One more at least, on every panel: the same functions would confirm themselves.
        return panels * (a_panel + max(a_panel // 2, 1))

    return continuum(
        model.slenderness,
        more(model.bending),
        more(model.axial) if model.slenderness > 0.0 else model.axial,
        model.blade,
        model.shear_ratio,
        model.engesser,
    )


def blade_continuum(beam: AnyBlade, theory: Theory, bending: int, axial: int) -> Continuum:
    """Return the discretization by at least so many functions, as many on every panel."""
    require_planar(beam)
    unit = _unit(beam, require_theory(theory))
    slenderness, axial = (beam.slenderness, axial) if theory.extension else (0.0, 1)
    bending, axial = (shape_functions(unit, count).count for count in (bending, axial))
    return continuum(slenderness, bending, axial, unit, theory.shear, theory.engesser)


def resolved_model(beam: AnyBlade, mode: int, theory: Theory, functions: int) -> Continuum:
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
    return blade_continuum(beam, theory, functions, max(4, 5 * functions // 8))


def require_shear(beam: AnyBlade, theory: Theory) -> None:
    """Refuse a number for sections that tell their shear stiffness, and True for others."""
    if theory.shear is not None and (theory.shear is True) != beam.section.at_stations:
        raise ValueError(
            f"shear = {theory.shear} does not fit the blade: a blade from stations tells its "
            "shear stiffness, take Theory(shear=True); others need the ratio to EA, as "
            "Theory(shear=0.32)"
        )


def _unit(beam: AnyBlade, theory: Theory) -> UnitBlade:
    """Return the blade without dimensions, with the rotary inertia of its slices."""
    require_shear(beam, theory)
    blade = beam.unit
    told = beam.section.rotary_inertia is not None
    if told or not theory.rotary_inertia:
        return blade
    x = np.linspace(0.0, 1.0, 257)
    if not np.allclose(evaluated(blade.mass, x), evaluated(blade.axial, x), rtol=1e-9):
        raise ValueError(
            "mass and axial stiffness of the blade do not vary alike, so that its sections "
            "have no one ρ/E to take their rotary inertia from: give "
            "Section(rotary_inertia=...) in kg m"
        )
    return replace(blade, rotary=in_units(blade.bending, 1.0, 1.0 / beam.slenderness))
