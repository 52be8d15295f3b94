"""The options --section, --ratio and --poisson-ratio: what a beam is out of its plane."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

from cyclopts import Parameter

from analytic import AnyBlade
from analytic.description import kinds_of
from analytic.section_shapes import SectionShape

_GIVEN = "given"


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class SectionOptions:
    """The section out of the plane.

    Parameters
    ----------
    section
        The section out of the plane: rectangle, ellipse, circle, tube, or given, that of the file.
    ratio
        Height in the plane over width, of a rectangle or an ellipse whose material and size follow
        the beam's EA, EI and mass; without it, the one that has the beam's A and I.
    poisson_ratio
        Poisson's ratio, for the torsional stiffness.
    """

    section: str = _GIVEN
    ratio: float | None = None
    poisson_ratio: float = 0.3

    @property
    def name(self) -> str:
        """The shape as part of a file's name."""
        return self.section if self.ratio is None else f"{self.section}-{self.ratio:g}"

    def of(self, beam: AnyBlade) -> AnyBlade:
        """Return the beam with the section asked for; with what it has, where none is."""
        kinds: dict[str, Any] = {
            name.lower(): kind for name, kind in kinds_of(SectionShape).items()
        }
        kind = kinds.get(self.section)
        if kind is None and self.section != _GIVEN:
            raise ValueError(
                f"--section must be {', '.join(kinds)} or {_GIVEN}, got {self.section!r}"
            )
        sides = kind is not None and "ratio" in (field.name for field in fields(kind))
        if self.ratio is not None and not sides:
            raise ValueError(
                f"--ratio is height over width, and --section {self.section} has none: leave it out"
            )
        if kind is None:
            return beam
        if sides and self.ratio is None and beam.gyration.area is None:
            raise ValueError(
                "a blade has EA and EI, but no area that tells its width: give --ratio, height in "
                "the plane over width"
            )
        if self.ratio is None:
            return beam.with_shape(kind(poisson_ratio=self.poisson_ratio))
        # With another material than the beam's, of which the blade knows none.
        shape = kind(ratio=self.ratio, poisson_ratio=self.poisson_ratio)
        return beam.blade.with_shape(shape)

    def required_of(self, beam: AnyBlade) -> AnyBlade:
        """Return the same, refusing a beam of whose section nothing is known out of the plane."""
        blade = self.of(beam)
        if blade.section.out_of_plane is None:
            raise ValueError(
                "what the section is out of the plane is unknown: give --section rectangle or "
                "--section tube, or [blade.section.out_of_plane] in --config"
            )
        return blade
