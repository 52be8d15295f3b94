"""Beams and blades that tests in several folders share."""

from analytic import Beam, Blade, Section
from analytic.quadrature import gauss_points, transverse_basis

SHARE = (5.0 / 6.0) / 2.6
"""Shear stiffness over axial stiffness, of a rectangle with Poisson's ratio 0.3."""
UNIFORM = Section(axial_stiffness=1e9, bending_stiffness=1.0, mass_per_length=1.0)
UNIT = Blade(length=1.0, section=UNIFORM)
"""EI = m = L = 1, so that ω is w̄."""
THICK = Beam(length=1.0, area=1e-2, second_moment=1e-2 / 1200, youngs_modulus=1e9, density=1e3)
REED = Beam(length=0.05, area=2.5e-6, second_moment=5.208e-14, youngs_modulus=2.1e11, density=7850)
"""360 times faster than the paper's beam."""
REED_TOML = (
    "[beam]\nlength = 0.05\narea = 2.5e-6\nsecond_moment = 5.208e-14\n"
    "youngs_modulus = 2.1e11\ndensity = 7850\n"
)
BLADE_TOML = (
    "[blade]\nlength = 8.0\n\n[blade.section]\naxial_stiffness = 5e6\n"
    "bending_stiffness = 566.0\nmass_per_length = 0.2\n"
)


def unit_beam(slenderness):
    """EI = ρA = L = 1, so that ω is w̄."""
    return Beam.from_stiffness(
        length=1.0, axial_stiffness=1.0 / slenderness, bending_stiffness=1.0, mass_per_length=1.0
    )


def deflection_matrices(w_bar, count):
    """K and M of the inextensible beam in rotation, on polynomials of v: K c = w̄_j² M c."""
    x, weights = gauss_points(count + 4)
    phi, slope, curvature = transverse_basis(count, x)
    M = phi.T * weights @ phi
    stiffening = 0.5 * w_bar**2 * slope.T * (weights * (1.0 - x**2)) @ slope
    return curvature.T * weights @ curvature + stiffening - w_bar**2 * M, M
