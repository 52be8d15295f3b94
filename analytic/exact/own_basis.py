"""The polynomials and the inertia that are a blade's own."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray
from ..profiles import Profile, evaluated
from ..quadrature import axial_basis
from ..unit_blade import UnitBlade


def own_bases(blade: UnitBlade, bending: int, axial: int) -> tuple[FloatArray, FloatArray] | None:
    """Return what makes Legendre's polynomials orthonormal in the blade's own EI and EA.

    Then its stiffness is the identity. The matrices, (bending, bending) and (axial, axial), are
    triangular, so that a larger basis begins with the smaller one. None of a uniform section, for
    panels make no difference to it.
    """
    if blade.bending == blade.axial == 1.0:
        return None
    most = max(bending, axial) // blade.panel_count
    x, weights = blade.quadrature(most + 1 + (blade.degree + 1) // 2)

    def inverse_factor(count: int, profile: Profile) -> FloatArray:
        legendre = axial_basis(count // blade.panel_count, x, blade.panels).slope
        gram = (legendre.T * (weights * evaluated(profile, x))) @ legendre
        return np.asarray(np.linalg.inv(np.linalg.cholesky(gram)).T)

    return inverse_factor(bending, blade.bending), inverse_factor(axial, blade.axial)


def turning_inertia(
    blade: UnitBlade, uniform: float, points: FloatArray, weights: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return the measure of what resists ϑ̈: of the sections, and of the point masses.

    Parameters
    ----------
    blade : UnitBlade
    uniform : float
        ρI of every section, beside the blade's own.
    points, weights : ndarray
        Gauss points, which do for a uniform section.
    """
    at = np.array([position for position, _, _ in blade.masses])
    lumped = np.array([inertia for _, _, inertia in blade.masses])
    x, dj = points, uniform * weights
    if blade.rotary != 0.0:
        x, dx = blade.quadrature(points.size // blade.panel_count + blade.degree)
        dj = dx * (uniform + evaluated(blade.rotary, x))
    return np.append(x, at), np.append(dj, lumped)
