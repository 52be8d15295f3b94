"""Strains of the blade in space: functions orthonormal in its stiffness, and its slices' masses.

As in the plane, the strains follow from moments and forces that are polynomials, or mass times
polynomials, in a frame without twist. Twist, kinks and steps of the section cause none in them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...arrays import FloatArray
from ...profiles import evaluated, slope_of
from ...quadrature import Grid
from ...shape_functions import ShapeFunctions, shape_functions
from ...theory import Theory
from .unit import SpaceUnit
from .vectors import about_axis

_MORE = 10  # points on each cell beyond twice the functions: frames turn with the sine of angles


@dataclass(frozen=True, eq=False)
class Masses:
    """Masses of the slices at the grid's points, and the point masses.

    Attributes
    ----------
    places, mass : ndarray (masses,)
    offset : ndarray (3, masses)
        From the line to the center of mass, in the frame without twist.
    inertia : ndarray (3, 3, masses)
        About the center of mass, in the same.
    drag : ndarray (masses,) or None
    """

    places: FloatArray
    mass: FloatArray
    offset: FloatArray
    inertia: FloatArray
    drag: FloatArray | None

    @cached_property
    def whole_on_line(self) -> bool:
        """Whether all masses are points on the line."""
        return not self.offset.any() and not self.turns

    @cached_property
    def turns(self) -> bool:
        """Whether there is inertia against rotation."""
        return bool(self.inertia.any())


@dataclass(frozen=True, eq=False)
class Strains:
    """Functions at some places, and the unloaded blade there.

    Attributes
    ----------
    gamma, K : ndarray (3, places, n)
        Γ and K.
    initial : ndarray (3, places)
        K of the unloaded blade, without the twist.
    twist : ndarray (places,)
        κ01.
    trapeze : ndarray (places,)
        k² of the trapeze effect, zero without it.
    """

    gamma: FloatArray
    K: FloatArray
    initial: FloatArray
    twist: FloatArray
    trapeze: FloatArray

    @cached_property
    def trapezes(self) -> bool:
        """Whether twist shortens the axis."""
        return bool(self.trapeze.any() and self.K[0].any())


@dataclass(frozen=True)
class StrainFunctions:
    """Functions for the strains of a blade by a theory, as many on every panel.

    Coordinates stand in the order κ3 and κ2 in pairs, κ1, ε, γ2, γ3; a larger set of each begins
    with a smaller one.

    Parameters
    ----------
    blade : SpaceUnit
    theory : Theory
    slenderness : float
        μ.
    bending, torsion, axial : int
        Functions a panel for each curvature of bending, for κ1, and for ε and each γ.
    """

    blade: SpaceUnit
    theory: Theory
    slenderness: float
    bending: int
    torsion: int
    axial: int

    @cached_property
    def counts(self) -> tuple[int, int, int, int]:
        """Functions in all: of bending, of torsion, of extension, and of shear."""
        panels, theory = self.blade.panel_count, self.theory
        twists = self.torsion if self.blade.twists else 0
        axial = self.axial * panels
        return (
            2 * self.bending * panels, twists * panels,
            axial * theory.extension, 2 * axial * (theory.shear is not None),
        )  # fmt: skip

    @property
    def families(self) -> tuple[int, ...]:
        """Functions of each family: both curvatures, κ1, ε, γ2, γ3."""
        bending, torsion, axial, shear = self.counts
        return bending, torsion, axial, shear // 2, shear // 2

    @property
    def size(self) -> int:
        """Number of coordinates."""
        return sum(self.counts)

    def refined(self) -> StrainFunctions:
        """Return half as many functions again, one more at least."""
        more = (n + max(n // 2, 1) for n in (self.bending, self.torsion, self.axial))
        return StrainFunctions(self.blade, self.theory, self.slenderness, *more)

    @cached_property
    def grid(self) -> Grid:
        """Points at which fields are evaluated."""
        return self.blade.grid(2 * self.bending, _MORE, of_fields=True)

    @cached_property
    def viscosity(self) -> FloatArray:
        """Damping of each coordinate, (n,)."""
        bend, stretch, _ = self.blade.damping
        bending, torsion, axial, shear = self.counts
        return np.repeat([bend, stretch, 0.0], [bending + torsion, axial, shear])

    @cached_property
    def odd(self) -> np.ndarray | None:
        """True for coordinates that time reversal turns around, (n,); None without a reversal."""
        bending, torsion, axial, shear = self.counts
        lag = np.tile([True, False], bending // 2)
        across = np.repeat([True, False], shear // 2)
        if self.blade.half_turn:
            kinds = [np.ones(bending), np.zeros(torsion + axial), np.ones(shear)]
        elif self.blade.mirrored:
            # Set for flap the section's own planes change places, those of the root frame do not.
            kinds = [lag, np.ones(torsion), np.zeros(axial), across]
        else:
            return None
        return np.concatenate(kinds).astype(bool)

    def _turned(self, x: FloatArray) -> FloatArray:
        """Return the section's frame in that without twist, (3, 3, places)."""
        return about_axis(self.blade.angle + evaluated(self.blade.line.twist, x))

    def _flexibility(self, x: FloatArray, power: float) -> FloatArray:
        """Return a power of the flexibility against (κ2, κ3), (places, 2, 2)."""
        EI3 = evaluated(self.blade.bending, x)
        turned = self._turned(x)[1:, 1:]
        own = np.stack((self.blade.flap * EI3, EI3)) ** -power
        return np.asarray(np.einsum("ikp,kp,jkp->pij", turned, own, turned))

    def _moments(self, count: int) -> ShapeFunctions:
        return shape_functions(self.blade, count * self.blade.panel_count)

    @cached_property
    def _own(self) -> tuple[FloatArray, FloatArray]:
        """The triangular matrices that make bending and torsion orthonormal."""
        grid = self.blade.grid(2 * self.bending, 14)
        root = np.sqrt(grid.weights)
        bent = root[:, None, None] * self._bent(grid.points, 0.5)
        flat = np.moveaxis(bent, 1, 0).reshape(-1, bent.shape[-1])
        if not self.counts[1]:
            return _triangle(flat), np.zeros((0, 0))
        GJ = self.blade.torsion * evaluated(self.blade.bending, grid.points)
        twisted = (root / np.sqrt(GJ))[:, None] * self._moments(self.torsion).forces(grid.points)
        return _triangle(flat), _triangle(twisted)

    def _bent(self, x: FloatArray, power: float) -> FloatArray:
        """Return the flexibility times pairs of moments about d3 and d2, (places, 2, 2n)."""
        forces, soft = self._moments(self.bending).forces(x), self._flexibility(x, power)
        pairs = np.stack((soft[:, :, 1:] * forces[:, None], soft[:, :, :1] * forces[:, None]), -1)
        return np.asarray(pairs.reshape(x.size, 2, -1))

    def at(self, x: FloatArray) -> Strains:
        """Return the functions at material points `x`."""
        blade, theory = self.blade, self.theory
        bending, torsion, axial, shear = self.counts
        gamma, K = np.zeros((2, 3, x.size, self.size))
        bent, twisted = self._own
        turned = self._turned(x)
        K[1:, :, :bending] = np.moveaxis(self._bent(x, 1.0) @ bent, 1, 0)
        EI3, EA = evaluated(blade.bending, x), evaluated(blade.axial, x)
        if torsion:
            GJ = blade.torsion * EI3[:, None]
            K[0, :, bending : bending + torsion] = (
                self._moments(self.torsion).forces(x) / GJ @ twisted
            )
        # The mean strain is that at the center of tension, (y, z) from the line.
        y, z = blade.line.tension_offset
        local = np.einsum("jip,jpk->ipk", turned, K)
        gamma[0] = y * local[2] - z * local[1]
        if axial or shear:
            along = shape_functions(blade, self.axial * blade.panel_count, "axial").strain(x)
            along = math.sqrt(self.slenderness) * along
            start = bending + torsion
            if axial:
                gamma[0, :, start : start + axial] += along
            if shear:
                half, start = shear // 2, start + axial
                across = along / math.sqrt(theory.shear or 1.0)
                gamma[1, :, start : start + half] = gamma[2, :, start + half :] = across
        bows = np.stack(
            (np.zeros_like(x), evaluated(blade.line.prebend, x), evaluated(blade.line.sweep, x))
        )
        k2 = self.slenderness * (1.0 + blade.flap) * EI3 / EA
        return Strains(
            gamma=gamma,
            K=K,
            initial=np.einsum("ijp,jp->ip", turned, bows),
            twist=slope_of(blade.line.twist, x),
            trapeze=k2 if theory.trapeze else np.zeros_like(x),
        )

    @cached_property
    def masses(self) -> Masses:
        """Masses and inertias of the slices and the point masses."""
        blade, x, weights = self.blade, self.grid.points, self.grid.weights
        positions, lumped, inertias, centers = (
            (np.array(kind) for kind in zip(*blade.bodies, strict=True))
            if blade.bodies
            else (np.empty(0), np.empty(0), np.empty(0), np.empty((0, 2)))
        )
        mass = evaluated(blade.mass, x)
        j1, j2, j3 = weights * self._inertias(x, mass)
        places = np.concatenate((x, positions))
        turned = self._turned(places)
        own = np.zeros((3, places.size))
        own[1:] = np.concatenate((np.tile(blade.line.mass_offset, (x.size, 1)), centers)).T
        none = np.zeros_like(inertias)
        J = np.stack([np.concatenate(pair) for pair in ((j1, none), (j2, none), (j3, inertias))])
        air = blade.damping[2]
        return Masses(
            places=places,
            mass=np.concatenate((weights * mass, lumped)),
            offset=np.einsum("ijp,jp->ip", turned, own),
            inertia=np.einsum("ikp,kp,jkp->ijp", turned, J, turned),
            drag=np.concatenate((air * weights, none)) if air else None,
        )

    def _inertias(self, x: FloatArray, mass: FloatArray) -> FloatArray:
        """Return j1, j2, j3 of the slices, (3, places)."""
        blade, theory = self.blade, self.theory
        solid = mass * evaluated(blade.bending, x) / evaluated(blade.axial, x)
        told = evaluated(blade.rotary, x)
        if blade.told_rotary:
            j3 = told
        elif theory.rotary_inertia or theory.trapeze:
            # A polar inertia that is told is parted as 1 to r.
            own = self.slenderness if blade.polar is None else blade.polar / (1.0 + blade.flap)
            j3 = own * solid
        else:
            j3 = np.zeros_like(x)
        j2 = blade.flap * j3
        polar = j2 + j3 if blade.polar is None or not j3.any() else blade.polar * solid
        return np.stack((polar, j2, j3))


def _triangle(columns: FloatArray) -> FloatArray:
    """Return the upper triangular matrix that makes columns orthonormal, positive ones first."""
    factor = np.linalg.qr(columns, mode="r")
    return np.asarray(np.linalg.inv(factor) * np.sign(np.diag(factor)))
