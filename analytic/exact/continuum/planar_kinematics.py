"""Shapes of the blade: from coordinates of angle and strains to places, slopes and rates."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ...arrays import ComplexArray, FloatArray
from ...shape_functions import shape_functions
from ...unit_blade import UnitBlade

_MORE = 3  # points on each cell: functions of low degree still make fields that are not, exp(iθ)


class Kinematics:
    """Functions for θ, e and γ, and the shape that their coordinates q = (c, d) make.

    θ = Σ c_k φ_k with φ_k(0) = 0, and the strains are e + iγ = Σ d_k Ψ_k, with √μ ψ_k for e and
    then i√(μ/σ) ψ_k for γ, those of GA: orthonormal in the blade's own stiffness, their moments and
    forces polynomials. Samples in time come first in every array.
    """

    def __init__(
        self,
        slenderness: float,
        bending: int,
        axial: int,
        blade: UnitBlade,
        shear: float | None = None,
    ) -> None:
        self.slenderness = slenderness  # μ
        # Functions for θ, e and γ, as many on each of the blade's panels.
        self.bending = bending
        self.axial = axial
        self.shear = 0 if shear is None else axial
        self.shear_ratio = shear  # σ, GA over EA at the root; None of normal sections
        self.families = bending, axial, self.shear
        self.size = sum(self.families)
        self.blade = blade
        self._across = shape_functions(blade, bending)
        self._along = shape_functions(blade, axial, "axial")
        sliding = blade if blade.shear is None else replace(blade, axial=blade.shear)
        self._sliding = shape_functions(sliding, axial, "axial")
        more = 0 if blade.cells.size == 2 else _MORE
        # Fields are evaluated at Gauss points, 2 bending on one cell.
        self.grid = blade.grid(2 * self._across.a_panel, more, of_fields=True)
        self.points, self.weights = self.grid.points, self.grid.weights
        self._phi, self._psi = self._bases(self.points)

    @property
    def odd(self) -> NDArray[np.bool_]:
        """Coordinates that change their sign in the mirror image of a shape, (n,): of θ and γ."""
        return np.repeat([True, False, True], [self.bending, self.axial, self.shear])

    @property
    def integrals_at_points(self) -> FloatArray:
        """Matrix from values at the Gauss points to the integrals from the clamp up to each."""
        return self.grid.integral(self.points)

    def split(self, q: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Split the last axis into the coordinates of θ and the coordinates of the strains."""
        return q[..., : self.bending], q[..., self.bending :]

    def _angle(self, q: FloatArray) -> FloatArray:
        return q[..., : self.bending] @ self._phi.T

    def _strain(self, q: FloatArray) -> FloatArray | ComplexArray:
        """Return e + iγ at the Gauss points, real without shear: (samples, points)."""
        strain: FloatArray | ComplexArray = q[..., self.bending :] @ self._psi.T
        return strain

    def bent(self, q: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the curvature ϑ', e and e' at the Gauss points, each (samples, points)."""
        theta, strains = self.split(q)
        turned, stretched = self._bends
        change = strains[..., : self.axial] @ stretched.T
        return theta @ turned.T, self._strain(q).real, change

    @cached_property
    def _bends(self) -> tuple[FloatArray, FloatArray]:
        """φ_k' and √μ ψ_k' at the Gauss points, each (points, functions)."""
        stretched = math.sqrt(self.slenderness) * self._along.elongation_slope(self.points)
        return self._across.strain(self.points), stretched

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

    def _at(self, x: FloatArray | None) -> tuple[FloatArray, FloatArray | ComplexArray]:
        return (self._phi, self._psi) if x is None else self._bases(x)

    def _bases(self, x: FloatArray) -> tuple[FloatArray, FloatArray | ComplexArray]:
        """Return φ_k and Ψ_k at `x`, each (points, functions)."""
        phi = self._across.once(x)
        psi = math.sqrt(self.slenderness) * self._along.strain(x)
        if self.shear_ratio is None:
            return phi, psi
        across = math.sqrt(self.slenderness / self.shear_ratio) * self._sliding.strain(x)
        return phi, np.hstack([psi, 1j * across])

    def integrated(self, slope: ComplexArray, x: FloatArray) -> ComplexArray:
        """Return the integral from the clamp to `x` of a slope given at the Gauss points."""
        return slope @ self.grid.integral(x).T

    def places(self, q: FloatArray, x: FloatArray) -> FloatArray:
        """Return the places of material points `x`, (samples, points, 3), as `standing` does."""
        z = self.integrated(self.slope(q), x)
        return np.asarray(parts_of(z) @ set_at(self.blade.angle)[:, :2].T)

    def standing(self, q: FloatArray, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return places (samples, points, 3) and sections (samples, points, 3, 3) of points `x`.

        In the frame of the clamp; axes of sections in columns.
        """
        angle = self.split(q)[0] @ self._bases(x)[0].T
        return self.places(q, x), in_plane_of_bending(angle, self.blade.angle)

    def slopes(
        self, q: FloatArray, q_dot: FloatArray, x: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return the derivatives of places to `x`, (samples, points, 3), and their rates."""
        axes = set_at(self.blade.angle)[:, :2].T
        slope, rate = (parts_of(z) @ axes for z in (self.slope(q, x), self.slope_rate(q, q_dot, x)))
        return slope, rate

    def moved(
        self, q: FloatArray, shapes: ComplexArray, x: FloatArray
    ) -> tuple[ComplexArray, ComplexArray]:
        """Return how small changes (count, n) move and turn points, (3, points, count) each."""
        parts = [self.integrated(self.slope_rate(q, one), x) for one in (shapes.real, shapes.imag)]
        plane = np.array([[z.real, z.imag] for z in np.swapaxes(parts, 1, 2)])
        axes, turn = set_at(self.blade.angle), self._bases(x)[0] @ shapes[..., : self.bending].T
        moved = np.tensordot(axes[:, :2], plane[0] + 1j * plane[1], 1)
        return moved, np.multiply.outer(axes[:, 2], turn)

    def tip(self, q: FloatArray) -> FloatArray:
        """Return the tip's place in the plane of bending, along and across, (samples, 2)."""
        return parts_of(self.slope(q) @ self.weights)

    def tip_turn(self, q: FloatArray) -> FloatArray:
        """Return zero, (samples,): in its plane a beam does not twist."""
        return np.zeros(len(q))

    def tip_rate(self, q: FloatArray, q_dot: FloatArray) -> FloatArray:
        """Return the tip's velocity in the rotating frame, (samples, 2)."""
        return parts_of(self.slope_rate(q, q_dot) @ self.weights)

    def tip_gradient(self, q: FloatArray) -> FloatArray:
        """Return the derivatives of the tip's place to the coordinates, (samples, 2, n)."""
        turn = np.exp(1j * self._angle(q)) * self.weights
        turning = 1j * (1.0 + self._strain(q)) * turn
        return parts_of(np.hstack((turning @ self._phi, turn @ self._psi))).swapaxes(1, 2)


def parts_of(z: ComplexArray) -> FloatArray:
    """Return real and imaginary part along one more axis, the last."""
    return np.ascontiguousarray(z).view(np.float64).reshape(*z.shape, 2)


def in_plane_of_bending(angle: FloatArray, setting: float) -> FloatArray:
    """Return the sections (..., 3, 3) of a planar blade set at ψ, turned by θ (...), both [rad].

    In columns, in the frame of the clamp.
    """
    turn = np.zeros((*angle.shape, 3, 3))
    turn[..., 0, 0] = turn[..., 1, 1] = np.cos(angle)
    turn[..., 1, 0] = np.sin(angle)
    turn[..., 0, 1] = -turn[..., 1, 0]
    turn[..., 2, 2] = 1.0
    return set_at(setting) @ turn


def set_at(setting: float) -> FloatArray:
    """Return the rotation (3, 3) about the blade by its setting angle [rad]."""
    c, s = math.cos(setting), math.sin(setting)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
