"""The section of a shear-deformable beam, which the paper leaves open."""

from __future__ import annotations

from analytic.input_checks import finite_number, positive

POISSON_RATIO = 0.3
"""Default ν; the paper gives neither ν nor a shear modulus."""

SHEAR_CORRECTION = 5.0 / 6.0
"""Default k_s of a rectangle whose section stays plane; an element may have reason for another."""


class Sheared:
    """An element with the options ν and k_s, G = E/(2 (1 + ν))."""

    poisson_ratio: float
    shear_correction: float

    def __post_init__(self) -> None:
        if not -1.0 < finite_number("poisson_ratio", self.poisson_ratio) < 0.5:
            raise ValueError(
                f"poisson_ratio must lie between -1 and 0.5, got {self.poisson_ratio!r}"
            )
        positive("shear_correction", self.shear_correction)

    @property
    def shear_share(self) -> float:
        """k_s G A over EA."""
        return self.shear_correction / (2.0 * (1.0 + self.poisson_ratio))
