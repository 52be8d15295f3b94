"""The shapes of the blade: from coordinates of angle and elongation to places, slopes and rates."""

from __future__ import annotations

import math

import numpy as np

from ..arrays import ComplexArray, FloatArray
from ..quadrature import axial_basis, gauss_points_on, integrals_from_clamp
from ..unit_blade import UnitBlade
from .own_basis import own_bases


class Kinematics:
    """Polynomials of θ and e, and what shape their coordinates q = (c, d) make.

    θ = Σ c_k φ_k with φ_k(0) = 0 and e = √μ Σ d_k ψ_k, orthonormal in the blade's own stiffness.
    Samples in time come first in every array.

    Attributes
    ----------
    slenderness : float
        μ.
    bending, axial, size : int
        Number of functions for θ and for e, as many on each of the blade's panels, and of both.
    blade : UnitBlade
    points, weights : ndarray (points,)
        The Gauss points at which fields are evaluated, and their weights; 2 bending on one panel.
    """

    def __init__(self, slenderness: float, bending: int, axial: int, blade: UnitBlade) -> None:
        self.slenderness = slenderness
        self.bending = bending
        self.axial = axial
        self.size = bending + axial
        self._epsilon = math.sqrt(slenderness)  # e = √μ ε makes the axial stiffness 1 as well
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
    def integrals_at_points(self) -> FloatArray:
        """Matrix from values at the Gauss points to the integrals from the clamp up to each."""
        return self._integral(self.points)

    def split(self, q: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the coordinates of θ and those of e, along the last axis."""
        return q[..., : self.bending], q[..., self.bending :]

    def padded(self, q: FloatArray, other: Kinematics) -> FloatArray:
        """Return the coordinates of the same shape in the larger basis of `other`."""
        result = np.zeros((*q.shape[:-1], other.size))
        theta, epsilon = self.split(q)
        result[..., : self.bending] = theta
        result[..., other.bending : other.bending + self.axial] = epsilon
        return result

    def _angle(self, q: FloatArray) -> FloatArray:
        return q[..., : self.bending] @ self._phi.T

    def _elongation(self, q: FloatArray) -> FloatArray:
        return self._epsilon * (q[..., self.bending :] @ self._psi.T)

    def bent(self, q: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the curvature ϑ', e and e' at the Gauss points, each (samples, points)."""
        bending, axial = self._a_panel
        theta, epsilon = self.split(q)
        turned = axial_basis(bending, self.points, self._panels).slope
        stretched = axial_basis(axial, self.points, self._panels).curvature
        if self._own is not None:
            turned, stretched = turned @ self._own[0], stretched @ self._own[1]
        change = self._epsilon * (epsilon @ stretched.T)
        return theta @ turned.T, self._elongation(q), change

    def slope(self, q: FloatArray, x: FloatArray | None = None) -> ComplexArray:
        """Return z' = (1 + e) exp(iθ) at `x`, the Gauss points if None: (samples, points)."""
        phi, psi = self._at(x)
        theta, epsilon = self.split(q)
        turn: ComplexArray = np.exp(1j * (theta @ phi.T))
        return (1.0 + self._epsilon * (epsilon @ psi.T)) * turn

    def slope_rate(
        self, q: FloatArray, q_dot: FloatArray, x: FloatArray | None = None
    ) -> ComplexArray:
        """Return ż' at `x`, the Gauss points if None: (samples, points)."""
        phi, psi = self._at(x)
        theta_dot, epsilon_dot = self.split(q_dot)
        z = self.slope(q, x)
        # ż' = z' (iθ̇ + ė/(1 + e)), which also serves for any small change of q.
        return z * (1j * (theta_dot @ phi.T) + self._epsilon * (epsilon_dot @ psi.T) / np.abs(z))

    def _at(self, x: FloatArray | None) -> tuple[FloatArray, FloatArray]:
        return (self._phi, self._psi) if x is None else self._bases(x)

    def _bases(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        bending, axial = self._a_panel
        phi = axial_basis(bending, x, self._panels).value
        psi = axial_basis(axial, x, self._panels).slope
        return (phi, psi) if self._own is None else (phi @ self._own[0], psi @ self._own[1])

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
        turn = np.exp(1j * self._angle(q))
        slope = 1j * (1.0 + self._elongation(q)) * turn * self.weights
        return np.concatenate(
            (slope @ self._phi, (self._epsilon * self.weights * turn) @ self._psi), axis=-1
        )
