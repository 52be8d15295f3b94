"""The section of a shear-deformable beam, which the paper leaves open."""

from __future__ import annotations

from analytic.input_checks import finite_number, positive

POISSON_RATIO = 0.3
"""Default ν; the paper gives neither ν nor a shear modulus."""

SHEAR_CORRECTION = 5.0 / 6.0
"""Default k_s of a rectangle whose section stays plane; an element may have reason for another."""


def shear_share(poisson_ratio: float, shear_correction: float) -> float:
    """k_s G A over EA, with G = E/(2 (1 + ν))."""
    return shear_correction / (2.0 * (1.0 + poisson_ratio))


def checked_shear(poisson_ratio: float, shear_correction: float) -> None:
    """Refuse a Poisson ratio outside (-1, 1/2) and a shear correction that is not positive."""
    if not -1.0 < finite_number("poisson_ratio", poisson_ratio) < 0.5:
        raise ValueError(f"poisson_ratio must lie between -1 and 0.5, got {poisson_ratio!r}")
    positive("shear_correction", shear_correction)
