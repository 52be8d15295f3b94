"""The theory of the beam: which strains its slices have, and whether they have rotary inertia."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Literal

import numpy as np

from .input_checks import flag, positive, shown


@dataclass(frozen=True, kw_only=True)
class Theory:
    """Theory of the beam: Bernoulli and Euler's with extension, unless stated otherwise.

    Parameters
    ----------
    extension : bool
        Whether the axis stretches; False is the limit of the slenderness μ → 0.
    shear : float or bool, optional
        Shear stiffness over axial stiffness, k_s GA/(EA) = k_s/(2 (1 + ν)), the same all along the
        blade, of Reissner's beam. True takes that of a blade from stations, which have it. None or
        False of a beam whose slices stay normal to the axis.
    engesser : bool
        Whether the tension acts along the slope of the axis, Engesser's law, not along the normal
        of the section, Reissner's; of a beam that shears, in the plane.
    rotary_inertia : bool
        Whether slices have inertia against rotation about all axes: that of a homogeneous section,
        ρI = m EI/EA, unless the section has its own. What it has counts in any case. Without
        it they have inertia against torsion, but none against the rates of bending.
    trapeze : bool or "elastic"
        Whether twist shortens the axis, the trapeze effect, and slices without rotary inertia
        feel the rotation of the clamp, which gives the propeller moment. Both untwist a blade and
        are of the same size; slices with rotary inertia have the propeller moment in any case.
        "elastic" is the trapeze effect of the elastic twist alone, as BeamDyn has it: tension
        stiffens torsion, and does not untwist. GXBeam and many others have none: compare with
        False.

    Raises
    ------
    ValueError
        If the shear is not positive, or the beam shears and does not stretch, or Engesser's law is
        asked of one that does not shear.

    Examples
    --------
    >>> from analytic import Beam, Theory, linear_modes
    >>> for theory in (Theory(extension=False), Theory(), Theory(shear=0.32, rotary_inertia=True)):
    ...     print(linear_modes(Beam.reference(), 6.0, theory=theory).frequencies.round(4))
    [ 3.7307 23.0107 56.6487]
    [ 3.7304 23.0101 56.6471]
    [ 3.7302 23.0079 56.6332]
    """

    extension: bool = True
    shear: float | bool | None = None
    engesser: bool = False
    rotary_inertia: bool = False
    trapeze: bool | Literal["elastic"] = True

    def __post_init__(self) -> None:
        switches = ["extension", "engesser", "rotary_inertia", "trapeze"]
        if isinstance(self.trapeze, str):
            if self.trapeze != "elastic":
                raise ValueError(
                    f'trapeze must be True, False or "elastic", got {shown(self.trapeze)}'
                )
            switches.remove("trapeze")
        for name in switches:
            object.__setattr__(self, name, flag(name, getattr(self, name)))
        if isinstance(self.shear, bool | np.bool_):
            object.__setattr__(self, "shear", bool(self.shear) or None)
        if self.shear is None:
            if self.engesser:
                raise ValueError("engesser=True is a law of shear: give shear, as shear=0.32")
            return
        if self.shear is not True:
            object.__setattr__(self, "shear", positive("shear", self.shear))
        if not self.extension:
            raise ValueError(
                "extension=False is the limit of the slender beam, which does not shear either: "
                "leave shear out, or extension"
            )

    @property
    def name(self) -> str:
        """Name of the beam."""
        if self.shear is not None:
            return "Timoshenko, Engesser's law" if self.engesser else "Timoshenko"
        return "with rotary inertia" if self.rotary_inertia else "Bernoulli-Euler"

    def __str__(self) -> str:
        given = ((one.name, getattr(self, one.name), one.default) for one in fields(self))
        return (
            f"Theory({', '.join(f'{name}={now!r}' for name, now, usual in given if now != usual)})"
        )


BERNOULLI_EULER = Theory()
"""The beam that stretches, does not shear, and has no rotary inertia but that of its section."""


def require_theory(theory: object) -> Theory:
    """Return a Theory; refuse other values."""
    if not isinstance(theory, Theory):
        raise TypeError(f"theory must be a Theory, got {shown(theory)}: as Theory(extension=False)")
    return theory
