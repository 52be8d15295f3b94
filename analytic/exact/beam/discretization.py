"""Which functions the exact blade is resolved by: made once, refined, the same on every panel."""

from __future__ import annotations

from functools import lru_cache

from ...shape_functions import shape_functions
from ...unit_blade import UNIFORM, UnitBlade
from .continuum import Continuum


@lru_cache(maxsize=32)
def continuum(
    slenderness: float,
    bending: int,
    axial: int,
    rotary_inertia: float = 0.0,
    blade: UnitBlade = UNIFORM,
    shear_share: float | None = None,
) -> Continuum:
    """Return the discretization, built once for each set of arguments."""
    return Continuum(
        slenderness,
        bending,
        axial,
        rotary_inertia=rotary_inertia,
        blade=blade,
        shear_share=shear_share,
    )


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
        model.rotary,
        model.blade,
        model.shear_share,
    )


def blade_continuum(
    blade: UnitBlade,
    slenderness: float,
    bending: int,
    axial: int,
    rotary_inertia: float,
    shear_share: float | None = None,
) -> Continuum:
    """Return the discretization by at least so many functions, as many on every panel."""
    bending, axial = (shape_functions(blade, count).count for count in (bending, axial))
    return continuum(slenderness, bending, axial, rotary_inertia, blade, shear_share)
