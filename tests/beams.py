"""Beams and blades that tests in several folders share."""

from dataclasses import replace

import numpy as np
from numpy.polynomial import Legendre
from scipy.sparse import coo_array
from scipy.sparse.linalg import eigsh

from analytic import Beam, Blade, Section
from analytic.quadrature import BasisValues, gauss_points

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
BEAM_TOML = (
    "[beam]\nlength = 8.0\naxial_stiffness = 5e6\nbending_stiffness = 566.0\n"
    "mass_per_length = 0.2\n"
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


def irregular(seed, sigma, count=None):
    """A blade with twist, a cone, steps at its root, and centers that jump at each station."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(4, 30)) if count is None else count
    x = np.concatenate(([0.0], np.sort(rng.uniform(0.0, 1.0, count - 2)), [1.0]))
    steps = np.where(x > rng.uniform(0.05, 0.3), 1.0, rng.uniform(1.0, 3.0, count))
    taper, axial = steps * (1.0 - 0.7 * x), 4e3 * steps * (1.0 - 0.5 * x)
    stiffness = np.stack([axial, axial, axial, 0.08 * taper, 0.0625 * taper, taper], axis=1)
    mass = np.outer(np.ones(count), [1.0, 3e-3, 2e-3, 1e-3])
    mass[:, 0] -= 0.5 * x
    centers = {
        name: sigma * rng.standard_normal((count, 2)) for name in ("center", "tension", "shear")
    }
    blade = Blade.from_stations(x, stiffness, mass, twist=0.6 * rng.random(count), **centers)
    return blade.with_precone(0.05)


def told(blade, inertia, *out_of_plane):
    """A blade whose section tells its rotary inertia in the plane, and these out of it."""
    section = replace(blade.section, rotary_inertia=inertia)
    return blade.with_section(section).with_section_out_of_plane(*out_of_plane)


def clamped_basis(count, x, order=2):
    """φ_k, φ_k' and φ_k'' at `x`, of which the derivative of that order is √(2k+1) P_k(2x-1)."""
    waves = [np.sqrt(2 * k + 1) * Legendre.basis(k, domain=[0.0, 1.0]) for k in range(count)]
    functions = [wave.integ(order, lbnd=0.0) for wave in waves]
    kinds = ([f.deriv(n)(x) if n else f(x) for f in functions] for n in range(3))
    return BasisValues(*(np.stack(kind, axis=-1) for kind in kinds))


def deflection_matrices(w_bar, count):
    """K and M of the inextensible beam in rotation, on polynomials of v: K c = w̄_j² M c."""
    x, weights = gauss_points(count + 4)
    phi, slope, curvature = clamped_basis(count, x)
    M = phi.T * weights @ phi
    stiffening = 0.5 * w_bar**2 * slope.T * (weights * (1.0 - x**2)) @ slope
    return curvature.T * weights @ curvature + stiffening - w_bar**2 * M, M


def finite_elements(nodes, frames, stiffness, mass, count):
    """Lowest frequencies [rad/s] of a clamped line of linear shear-flexible elements at rest.

    Of nodes (n + 1, 3), and at the middles sections' axes in columns, (n, 3, 3), with 6x6 matrices
    (n, 6, 6) in these: strains r' + t x turn and turn', in the middle alone, which does not lock.
    """
    step = np.diff(nodes, axis=0)
    h = np.linalg.norm(step, axis=1)[:, None, None]
    n = len(step)
    turn = np.zeros((n, 6, 6))
    turn[:, :3, :3] = turn[:, 3:, 3:] = np.swapaxes(frames, 1, 2)
    strain = np.concatenate([-np.tile(np.eye(6), (n, 1, 1)) / h, np.eye(6) / h], axis=2)
    across = np.cross(np.eye(3), -(step[:, None] / h)).swapaxes(1, 2)
    strain[:, :3, 3:6] += 0.5 * across
    strain[:, :3, 9:] += 0.5 * across
    strain = turn @ strain
    K = h * (strain.swapaxes(1, 2) @ stiffness @ strain)
    M = h * (turn.swapaxes(1, 2) @ mass @ turn)
    M = np.concatenate([np.tile(M, (1, 1, 2)), np.tile(M, (1, 1, 2))], axis=1) / 6.0
    M[:, :6, :6] *= 2.0
    M[:, 6:, 6:] *= 2.0
    at = 6 * np.arange(n)[:, None] + np.arange(12)
    places = np.repeat(at, 12, axis=1).ravel(), np.tile(at, (1, 12)).ravel()
    K, M = (coo_array((one.ravel(), places)).tocsc()[6:, 6:] for one in (K, M))
    return np.sort(np.sqrt(eigsh(K, count, M, sigma=0.0, return_eigenvectors=False)))
