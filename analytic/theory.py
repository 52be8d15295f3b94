"""The theory of the beam: which strains its slices have, and whether they have rotary inertia."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .beam import AnyBlade
from .input_checks import flag, positive, shown
from .profiles import evaluated, in_units
from .unit_blade import UnitBlade


@dataclass(frozen=True, kw_only=True)
class Theory:
    """Theory of the beam: Bernoulli and Euler's with extension, unless told otherwise.

    Parameters
    ----------
    extension : bool
        Whether the axis stretches; False is the limit of the slenderness μ → 0.
    shear : float or True, optional
        Shear stiffness over axial stiffness, k_s GA/(EA) = k_s/(2 (1 + ν)), the same all along the
        blade, of Reissner's beam. True takes that of a blade from stations, which tell it. None of
        a beam whose slices stay normal to the axis.
    engesser : bool
        Whether the tension acts along the slope of the axis, Engesser's law, not along the normal
        of the section, Reissner's; of a beam that shears, in the plane.
    rotary_inertia : bool
        Whether slices have inertia against rotation in the plane: that of a homogeneous section,
        ρI = m EI/EA, unless the section tells its own. What it tells is there in any case.
    trapeze : bool
        Whether slices of a blade in space have inertia against torsion too, with the propeller
        moment, and twist shortens the axis, the trapeze effect. Both are of the same size; codes
        without them are compared with False.

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
    shear: float | None = None  # True is a number too
    engesser: bool = False
    rotary_inertia: bool = False
    trapeze: bool = True

    def __post_init__(self) -> None:
        for name in ("extension", "engesser", "rotary_inertia", "trapeze"):
            object.__setattr__(self, name, flag(name, getattr(self, name)))
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

    def slenderness(self, beam: AnyBlade) -> float:
        """Return μ = I/(AL²) of a blade, zero for a blade that does not stretch."""
        return beam.slenderness if self.extension else 0.0

    def require_shear(self, beam: AnyBlade) -> None:
        """Refuse a number for sections that tell their shear stiffness, and True for others."""
        if self.shear is not None and (self.shear is True) != beam.section.at_stations:
            raise ValueError(
                f"shear = {self.shear} does not fit the blade: a blade from stations tells its "
                "shear stiffness, take Theory(shear=True); others need the ratio to EA, as "
                "Theory(shear=0.32)"
            )

    def unit(self, beam: AnyBlade) -> UnitBlade:
        """Return a blade without dimensions, with the rotary inertia of its slices.

        Raises
        ------
        ValueError
            If the section tells no rotary inertia, and has no one ρ/E to take it from.
        """
        self.require_shear(beam)
        blade = beam.unit
        told = beam.section.rotary_inertia is not None
        if told or not self.rotary_inertia:
            return blade
        x = np.linspace(0.0, 1.0, 257)
        if not np.allclose(evaluated(blade.mass, x), evaluated(blade.axial, x), rtol=1e-9):
            raise ValueError(
                "mass and axial stiffness of the blade do not vary alike, so that its sections "
                "have no one ρ/E to take their rotary inertia from: give "
                "Section(rotary_inertia=...) in kg m"
            )
        return replace(blade, rotary=in_units(blade.bending, 1.0, 1.0 / beam.slenderness))


BERNOULLI_EULER = Theory()
"""The beam that stretches, does not shear, and has no rotary inertia but what its section tells."""


def require_theory(theory: object) -> Theory:
    """Return a Theory; refuse other values."""
    if not isinstance(theory, Theory):
        raise TypeError(f"theory must be a Theory, got {shown(theory)}: as Theory(extension=False)")
    return theory
