"""Stiffness and inertia of a section out of its plane of bending.

In the plane a thin blade knows its EA, EI and m. Whether its motion stays there depends on how it
bends out of the plane and twists.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from .description import Described
from .input_checks import not_negative, positive


@dataclass(frozen=True, kw_only=True)
class OutOfPlane(Described):
    """Stiffness and inertia of a slice out of the plane, over those in it.

    The ratios hold all along the blade.

    Parameters
    ----------
    bending_ratio : float
        r, the bending stiffness out of the plane over the EI in it.
    torsion_ratio : float, optional
        g = GJ/EI; infinite of a section that does not twist. None where it is not known.
    polar_inertia : float, optional
        ρI_p at the root [kg m]; along the blade it goes as m EI/EA. None of a homogeneous section,
        which has m (1 + r) EI/EA. Its parts in the plane and across it, whose difference stiffens
        the twist as the blade turns, are taken as 1 to r. Zero makes the twist follow without
        inertia.

    Examples
    --------
    >>> from analytic import Beam, Rectangle
    >>> strip = Beam.reference().with_shape(Rectangle())
    >>> print(f"GJ = {strip.section.out_of_plane.torsion_ratio:.5f} EI")
    GJ = 0.00434 EI
    """

    bending_ratio: float
    torsion_ratio: float | None = None
    polar_inertia: float | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "bending_ratio", positive("bending_ratio", self.bending_ratio))
        if self.torsion_ratio is not None and not _is_infinite(self.torsion_ratio):
            ratio = positive("torsion_ratio", self.torsion_ratio)
            object.__setattr__(self, "torsion_ratio", ratio)
        if self.polar_inertia is not None:
            inertia = not_negative("polar_inertia", self.polar_inertia, "kg m")
            object.__setattr__(self, "polar_inertia", inertia)


def _is_infinite(value: object) -> bool:
    # A masked number compares to something that is neither True nor False.
    return isinstance(value, float) and value == math.inf
