"""The shapes of the blade: from coordinates of angle and strains to places, slopes and rates."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..arrays import ComplexArray, FloatArray
from ..quadrature import axial_basis, gauss_points_on, integrals_from_clamp
from ..unit_blade import UnitBlade
from .own_basis import own_bases


class Kinematics:
    """Polynomials of θ, e and γ, and what shape their coordinates q = (c, d) make.

    θ = Σ c_k φ_k with φ_k(0) = 0, and the strains are e + iγ = Σ d_k Ψ_k, with √μ ψ_k for e and
    then i√(μ/σ) ψ_k for γ: orthonormal in the blade's own stiffness. Samples in time come first in
    every array.

    Attributes
    ----------
    slenderness : float
        μ.
    bending, axial, shear, size : int
        Number of functions for θ, for e and for γ, as many on each of the blade's panels, and of
        all. Those for γ are those for e, or none.
    shear_share : float or None
        σ, shear over axial stiffness; None where sections stay normal to the axis.
    blade : UnitBlade
    points, weights : ndarray (points,)
        The Gauss points at which fields are evaluated, and their weights; 2 bending on one panel.
    """

    def __init__(
        self,
        slenderness: float,
        bending: int,
        axial: int,
        blade: UnitBlade,
        shear_share: float | None = None,
    ) -> None:
        self.slenderness = slenderness
        self.bending = bending
        self.axial = axial
        self.shear = 0 if shear_share is None else axial
        self.shear_share = shear_share
        self.size = bending + axial + self.shear
        self.blade = blade
        self._panels, panels = blade.panels, blade.panel_count
        if bending % panels or axial % panels:
            raise ValueError(f"{bending} and {axial} functions do not go on {panels} panels")
        self._a_panel = (bending // panels, axial // panels)
        # Functions of low degree still make fields that are not: exp(iθ).
        self._points_a_panel = 2 * self._a_panel[0] + (4 if panels > 1 else 0)
        self.points, self.weights = gauss_points_on(self._points_a_panel, self._panels)
        self._own = own_bases(blade, bending, axial)
        self._phi, self._psi = self._bases(self.points)

    def _integral(self, x: FloatArray) -> FloatArray:
        """Matrix from values at the Gauss points to the integral from the clamp to `x`."""
        return integrals_from_clamp(self._points_a_panel, x, self._panels)

    @property
    def odd(self) -> NDArray[np.bool_]:
        """Which coordinates change their sign in the mirror image of a shape, (n,): of θ and γ."""
        return np.repeat([True, False, True], [self.bending, self.axial, self.shear])

    @property
    def integrals_at_points(self) -> FloatArray:
        """Matrix from values at the Gauss points to the integrals from the clamp up to each."""
        return self._integral(self.points)

    def split(self, q: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the coordinates of θ and those of the strains, along the last axis."""
        return q[..., : self.bending], q[..., self.bending :]

    def padded(self, q: FloatArray, other: Kinematics) -> FloatArray:
        """Return the coordinates of the same shape in the larger basis of `other`."""
        result = np.zeros((*q.shape[:-1], other.size))
        start = end = 0
        for own, others in (
            (self.bending, other.bending),
            (self.axial, other.axial),
            (self.shear, other.shear),
        ):
            result[..., end : end + own] = q[..., start : start + own]
            start, end = start + own, end + others
        return result

    def _angle(self, q: FloatArray) -> FloatArray:
        return q[..., : self.bending] @ self._phi.T

    def _strain(self, q: FloatArray) -> FloatArray | ComplexArray:
        """Return e + iγ at the Gauss points, real without shear: (samples, points)."""
        strain: FloatArray | ComplexArray = q[..., self.bending :] @ self._psi.T
        return strain

    def bent(self, q: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the curvature ϑ', e and e' at the Gauss points, each (samples, points)."""
        bending, axial = self._a_panel
        theta, strains = self.split(q)
        turned = axial_basis(bending, self.points, self._panels).slope
        stretched = axial_basis(axial, self.points, self._panels).curvature
        if self._own is not None:
            turned, stretched = turned @ self._own[0], stretched @ self._own[1]
        change = math.sqrt(self.slenderness) * (strains[..., : self.axial] @ stretched.T)
        return theta @ turned.T, self._strain(q).real, change

    def slope(self, q: FloatArray, x: FloatArray | None = None) -> ComplexArray:
        """Return z' = (1 + e + iγ) exp(iθ) at `x`, the Gauss points if None: (samples, points)."""
        phi, psi = self._at(x)
        theta, strains = self.split(q)
        turn: ComplexArray = np.exp(1j * (theta @ phi.T))
        return (1.0 + strains @ psi.T) * turn

    def slope_rate(
        self, q: FloatArray, q_dot: FloatArray, x: FloatArray | None = None
    ) -> ComplexArray:
        """Return ż' at `x`, the Gauss points if None: (samples, points)."""
        phi, psi = self._at(x)
        (theta, strains), (theta_dot, strain_rates) = self.split(q), self.split(q_dot)
        turn: ComplexArray = np.exp(1j * (theta @ phi.T))
        # This also serves for any small change of q.
        turning = 1j * (1.0 + strains @ psi.T) * (theta_dot @ phi.T)
        return turn * (turning + strain_rates @ psi.T)

    def shear_angle(
        self, q: FloatArray, q_dot: FloatArray, x: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return the angle at `x` from the section's normal to the tangent, and its rate."""
        _, psi = self._bases(x)
        (_, strains), (_, strain_rates) = self.split(q), self.split(q_dot)
        stretch = 1.0 + strains @ psi.T
        return np.angle(stretch), np.asarray((strain_rates @ psi.T / stretch).imag)

    def _at(self, x: FloatArray | None) -> tuple[FloatArray, FloatArray | ComplexArray]:
        return (self._phi, self._psi) if x is None else self._bases(x)

    def _bases(self, x: FloatArray) -> tuple[FloatArray, FloatArray | ComplexArray]:
        """Return φ_k and Ψ_k at `x`, each (points, functions)."""
        bending, axial = self._a_panel
        phi = axial_basis(bending, x, self._panels).value
        psi = axial_basis(axial, x, self._panels).slope
        if self._own is not None:
            phi, psi = phi @ self._own[0], psi @ self._own[1]
        psi = math.sqrt(self.slenderness) * psi
        if self.shear_share is None:
            return phi, psi
        return phi, np.hstack([psi, 1j / math.sqrt(self.shear_share) * psi])

    def integrated(self, slope: ComplexArray, x: FloatArray) -> ComplexArray:
        """Return the integral from the clamp to `x` of a slope given at the Gauss points."""
        return slope @ self._integral(x).T

    def tip(self, q: FloatArray) -> ComplexArray:
        """Return the tip's position z(1), (samples,)."""
        return self.slope(q) @ self.weights

    def tip_rate(self, q: FloatArray, q_dot: FloatArray) -> ComplexArray:
        """Return the tip's velocity ż(1) in the rotating frame, (samples,)."""
        return self.slope_rate(q, q_dot) @ self.weights

    def tip_gradient(self, q: FloatArray) -> ComplexArray:
        """Return the derivatives of the tip's position to the coordinates, (samples, n)."""
        turn = np.exp(1j * self._angle(q)) * self.weights
        turning = 1j * (1.0 + self._strain(q)) * turn
        return np.concatenate((turning @ self._phi, turn @ self._psi), axis=-1)
