"""The options --section, --ratio and --poisson-ratio: what a beam is out of its plane."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from cyclopts import Parameter

from analytic import AnyBlade, Beam, OutOfPlane

Shape = Literal["rectangle", "tube", "given"]


@Parameter(name="*")
@dataclass(frozen=True, kw_only=True)
class SectionShape:
    """The section out of the plane.

    Parameters
    ----------
    section
        The section out of the plane: a rectangle, a thin tube, or that of the file given.
    ratio
        Height in the plane over width of the rectangle, whose material and size follow the beam's
        EA, EI and mass; without it, the rectangle that has the beam's A and I.
    poisson_ratio
        Poisson's ratio, for the torsional stiffness.
    """

    section: Shape = "given"
    ratio: float | None = None
    poisson_ratio: float = 0.3

    @property
    def name(self) -> str:
        """The shape as part of a file's name."""
        return self.section if self.ratio is None else f"{self.section}-{self.ratio:g}"

    def of(self, beam: AnyBlade) -> AnyBlade:
        """Return the beam with the section asked for; with what it has, where none is."""
        if self.ratio is not None and self.section != "rectangle":
            raise ValueError(
                f"--ratio is of a rectangle, and --section is {self.section}: leave it out"
            )
        if self.section == "tube":
            return beam.with_out_of_plane(OutOfPlane.circle(self.poisson_ratio))
        if self.section == "rectangle" and self.ratio is not None:
            return beam.with_out_of_plane(OutOfPlane.rectangle(self.ratio, self.poisson_ratio))
        if self.section == "rectangle":
            if not isinstance(beam, Beam):
                raise ValueError(
                    "a blade has EA and EI, but no area that tells its width: give --ratio, height "
                    "in the plane over width"
                )
            return beam.rectangle(poisson_ratio=self.poisson_ratio)
        return beam

    def required_of(self, beam: AnyBlade) -> AnyBlade:
        """Return the same, refusing a beam of whose section nothing is known out of the plane."""
        blade = self.of(beam)
        if blade.section.out_of_plane is None:
            raise ValueError(
                "what the section is out of the plane is unknown: give --section rectangle or "
                "--section tube, or [blade.section.out_of_plane] in --config"
            )
        return blade
