"""Discretization of the exact blade: functions made once, refined, the same on every panel."""

from __future__ import annotations

from functools import lru_cache

from ...beam import AnyBlade, require_planar
from ...shape_functions import shape_functions
from ...theory import Theory, require_theory
from ...unit_blade import UNIFORM, UnitBlade
from .continuum import Continuum


@lru_cache(maxsize=32)
def continuum(
    slenderness: float,
    bending: int,
    axial: int,
    blade: UnitBlade = UNIFORM,
    shear: float | None = None,
    engesser: bool = False,
) -> Continuum:
    """Return the discretization, built once for each set of arguments."""
    return Continuum(slenderness, bending, axial, blade=blade, shear=shear, engesser=engesser)


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
    unit = require_theory(theory).unit(beam)
    axial = axial if theory.extension else 1
    bending, axial = (shape_functions(unit, count).count for count in (bending, axial))
    mu = theory.slenderness(beam)
    return continuum(mu, bending, axial, unit, theory.shear, theory.engesser)
