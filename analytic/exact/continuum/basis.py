"""Strains of the blade in space: functions orthonormal in its stiffness, and its slices' masses.

As in the plane, the strains follow from moments and forces that are polynomials, or mass times
polynomials, in a frame without twist. Twist, kinks and steps of the section cause none in them, but
where they couple forces or jump aside: there answers make further functions.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ...arrays import FloatArray, evaluated, slope_of
from ...quadrature import Grid
from ...shape_functions import shape_functions
from ...station_section import about_centers
from ...theory import Theory
from .answers import Answers, beside
from .unit import SpaceUnit, trapeze_of

_MORE = 10  # points on each cell beyond twice the functions: frames turn with the sine of angles
_FEW = 4  # on each of many short cells, which turn less
_MANY_CELLS = 8


@dataclass(frozen=True, eq=False)
class Masses:
    """Masses of the slices at the grid's points, and point masses, in the frame without twist."""

    places: FloatArray  # (masses,), as mass and drag
    mass: FloatArray
    offset: FloatArray  # (3, masses), from the line to the center of mass
    inertia: FloatArray  # A about the center of mass, (3, 3, masses)
    carried: FloatArray  # C, the same against the clamp's rotation, (3, 3, masses)
    whole: FloatArray  # 1 where A takes part in all spin, 0 where in that relative to the clamp
    drag: FloatArray | None

    @cached_property
    def whole_on_line(self) -> bool:
        """Whether all masses are points on the line."""
        return not self.offset.any() and not self.turns

    @cached_property
    def turns(self) -> bool:
        """Whether there is inertia against rotation."""
        return bool(self.inertia.any() or self.carried.any())


@dataclass(frozen=True, eq=False)
class Strains:
    """Functions at some places, and the unloaded blade there."""

    gamma: FloatArray  # Γ, (3, places, n)
    K: FloatArray  # K, (3, places, n)
    initial: FloatArray  # K of the unloaded blade, without the twist, (3, places)
    twist: FloatArray  # κ01 that tension acts on, (places,)
    trapeze: FloatArray  # k² of the trapeze effect, zero without it, (places,)

    @cached_property
    def trapezes(self) -> bool:
        """Whether twist shortens the axis."""
        return bool(self.trapeze.any() and self.K[0].any())


@dataclass(frozen=True, eq=False)
class StrainFunctions:
    """Functions for the strains of a blade by a theory, as many on every panel.

    Coordinates stand in the order κ3 and κ2 in pairs, κ1, ε, γ2, γ3, answers; a larger set of each
    begins with a smaller one.
    """

    blade: SpaceUnit
    theory: Theory
    slenderness: float  # μ
    bending: int  # functions a panel for each curvature of bending
    torsion: int  # for κ1
    axial: int  # for ε and each γ
    answers: Answers | None = None

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
        """Functions of each family: both curvatures, κ1, ε, γ2, γ3, answers."""
        bending, torsion, axial, shear = self.counts
        answers = 0 if self.answers is None else self.answers.count
        return bending, torsion, axial, shear // 2, shear // 2, answers

    @property
    def size(self) -> int:
        """Number of coordinates."""
        return sum(self.families)

    @property
    def reach(self) -> tuple[int, ...]:
        """Numbers of polynomials, with those that are made up for."""
        counts = self.bending, self.torsion, self.axial
        return counts if self.answers is None else self.answers.reach

    def refined(
        self, caused: FloatArray | None = None, seen: float | None = None
    ) -> StrainFunctions:
        """Return half as many functions again, one more at least; of a table see `beside`."""
        if self.blade.answers:
            return replace(self, answers=beside(self, caused, seen))
        bending, torsion, axial = (
            n + max(n // 2, 1) for n in (self.bending, self.torsion, self.axial)
        )
        return replace(self, bending=bending, torsion=torsion, axial=axial)

    @cached_property
    def grid(self) -> Grid:
        """Points at which fields are evaluated."""
        # More with each refinement, so that its change tells the error of these sums as well.
        if self.answers is not None:
            return self.answers.grid
        few = max(_FEW, self.bending // 3) if self.blade.answers else _FEW
        more = _MORE if self.blade.cells.size <= _MANY_CELLS else few
        return self.blade.grid(2 * self.bending, more, of_fields=True)

    @property
    def uncoupled(self) -> bool:
        """Whether lag and axial motion go without flap and torsion."""
        return self.blade.half_turn and self.blade.mirrored

    @cached_property
    def odd(self) -> NDArray[np.bool_] | None:
        """True for coordinates that time reversal turns around, (n,); None without a reversal."""
        if self.blade.half_turn or self.blade.mirrored:
            return self.odd_by(mirror=not self.blade.half_turn)
        return None

    def odd_by(self, *, mirror: bool) -> NDArray[np.bool_]:
        """Return the same of the half turn about the blade, or of the mirror through the axis."""
        bending, torsion, axial, shear = self.counts
        answers = np.empty(0) if self.answers is None else self.answers.odd[int(mirror)]
        if not mirror:
            kinds = [np.ones(bending), np.zeros(torsion + axial), np.ones(shear), answers]
        else:
            # Set for flap the section's own planes change places, those of the root frame do not.
            lag = np.tile([True, False], bending // 2)
            across = np.repeat([True, False], shear // 2)
            kinds = [lag, np.ones(torsion), np.zeros(axial), across, answers]
        return np.concatenate(kinds).astype(bool)

    def _sections(self, x: FloatArray) -> FloatArray:
        """Return forces or strains in the frame without twist over those in sections."""
        turned = np.zeros((x.size, 6, 6))
        turned[:, :3, :3] = turned[:, 3:, 3:] = np.moveaxis(self.blade.section_frames(x), -1, 0)
        return turned

    def flexibility(self, x: FloatArray) -> FloatArray:
        """Return strains over forces in the frame without twist, (places, 6, 6)."""
        turned = self._sections(x)
        soft = self.blade.flexibility(x, self.theory, self.slenderness)
        return np.asarray(turned @ soft @ np.swapaxes(turned, 1, 2))

    def elastic(self, x: FloatArray, forces: FloatArray) -> FloatArray:
        """Return the part of forces (places, 6, count) in that frame that strains answer."""
        turned = self._sections(x)
        back = np.swapaxes(turned, 1, 2)
        return np.asarray(turned @ (self.blade.elastic(x, self.theory) @ (back @ forces)))

    def _forces(self, x: FloatArray) -> FloatArray:
        """Return forces and moments in that frame, (places, 6, n), polynomials or mass times these.

        Those of a family have one component, but of answers; those of bending M3 and M2 in turn.
        """
        blade, bending = self.blade, self.counts[0]
        moments = shape_functions(blade, bending // 2)
        result = np.zeros((x.size, 6, self.size))
        result[:, 5, 0:bending:2] = result[:, 4, 1:bending:2] = moments.forces(x)
        if self.answers is not None:
            result[..., sum(self.counts) :] = self.answers.at(x)
        for rows, columns in self._blocks[1:]:
            if rows == [3]:
                result[:, 3, columns] = blade.torques(columns.stop - columns.start, x)
            else:
                along = shape_functions(blade, self.axial * blade.panel_count, "axial")
                result[:, rows[0], columns] = along.forces(x)
        return result

    @cached_property
    def _blocks(self) -> list[tuple[list[int], slice]]:
        """The components of the families that there are, and their coordinates."""
        ends = np.cumsum((0, *self.families[:-1])).tolist()
        kinds = zip(([4, 5], [3], [0], [1], [2]), pairwise(ends), strict=True)
        return [(rows, slice(*ends)) for rows, ends in kinds if ends[1] > ends[0]]

    @cached_property
    def _energy_grid(self) -> Grid:
        """Points at which energies are evaluated: answers are known at those of fields."""
        return self.grid if self.blade.answers else self.blade.grid(2 * self.bending, 14)

    @cached_property
    def _orthonormal(self) -> tuple[FloatArray, FloatArray]:
        """The matrix that makes each family orthonormal, and the stiffness of all, (n, n) each."""
        grid = self._energy_grid
        soft = grid.weights[:, None, None] * self.flexibility(grid.points)
        forces = self._forces(grid.points)
        turn = np.diag(np.repeat([0.0, 1.0], [sum(self.counts), self.families[-1]]))
        for rows, block in self._blocks:
            root = np.linalg.cholesky(soft[:, rows][:, :, rows])
            columns = np.swapaxes(root, 1, 2) @ forces[:, rows, block]
            turn[block, block] = _triangle(columns.reshape(-1, columns.shape[-1]))
        forces = forces @ turn
        stiffness = np.einsum("pik,pil->kl", forces, soft @ forces, optimize=True)
        for _, block in self._blocks:
            stiffness[block, block] = np.eye(block.stop - block.start)
        return turn, stiffness

    @property
    def stiffness(self) -> FloatArray:
        """The elastic energy is ½ q·K q, (n, n): the identity where the section couples nothing."""
        return self._orthonormal[1]

    @cached_property
    def damping(self) -> FloatArray:
        """The viscous resistance to q̇ (n, n) of moments about the center of tension and forces."""
        grid = self._energy_grid
        soft = self.flexibility(grid.points)
        return self.viscous(grid, soft, self.forces(grid.points))

    def viscous(self, grid: Grid, soft: FloatArray, forces: FloatArray) -> FloatArray:
        """Return the same by forces of functions at a grid, with strains over forces `soft`."""
        rates = np.sqrt(self.blade.damping.of_strains)
        if not rates.any():
            return np.zeros((self.size, self.size))
        # Strains under forces where the section does not bend: what is left are the moments'.
        beside, bends = soft[:, :3, 3:], np.linalg.pinv(soft[:, 3:, 3:], hermitian=True)
        along = soft[:, :3, :3] - beside @ bends @ np.swapaxes(beside, 1, 2)
        turned = self._sections(grid.points)
        share = turned @ (rates[:, None] * np.swapaxes(turned, 1, 2))
        held = np.zeros_like(soft)
        held[:, :3, :3], held[:, 3:, 3:] = along, bends
        held *= grid.weights[:, None, None]
        bent = soft[:, 3:] @ forces
        acting = share @ np.concatenate((forces[:, :3], bent), axis=1)
        return np.asarray(np.einsum("pik,pil->kl", acting, held @ acting, optimize=True))

    def forces(self, x: FloatArray) -> FloatArray:
        """Return forces and moments of the functions at `x`, (places, 6, n)."""
        return np.asarray(self._forces(x) @ self._orthonormal[0])

    def at(self, x: FloatArray) -> Strains:
        """Return the functions at material points `x`."""
        soft = self.flexibility(x)
        # In memory the places come last, as in all fields.
        conjugate = (soft @ self.forces(x)).transpose(1, 2, 0).copy()
        strains = np.swapaxes(conjugate, 1, 2)
        return self.on_line(x, soft, strains[:3], strains[3:])

    @cached_property
    def on_grid(self) -> Strains:
        """The functions at the points of the grid."""
        return self.at(self.grid.points)

    @cached_property
    def soft(self) -> FloatArray:
        """Strains over forces at the grid, (points, 6, 6)."""
        return self.flexibility(self.grid.points)

    @cached_property
    def hard(self) -> FloatArray:
        """Forces over strains at the grid, (points, 6, 6); 1 over those that stay zero."""
        rigid = self.soft.diagonal(axis1=1, axis2=2) == 0.0
        return np.asarray(np.linalg.inv(self.soft + np.eye(6) * rigid[:, None]))

    @cached_property
    def to_centers(self) -> FloatArray:
        """Strains at the centers less those of the line, over curvatures, (points, 3, 3)."""
        return about_centers(self.hard)[0][:, :3, 3:]

    def trapeze(self, soft: FloatArray) -> FloatArray:
        """Return k² of the trapeze effect, or zero, where strains over forces are `soft`."""
        return trapeze_of(soft) if self.theory.trapeze else np.zeros(len(soft))

    def on_line(self, x: FloatArray, soft: FloatArray, gamma: FloatArray, K: FloatArray) -> Strains:
        """Return functions at `x`, where strains over forces are `soft`, with the line there."""
        return Strains(
            gamma=gamma,
            K=K,
            initial=self.blade.bent(x),
            twist=slope_of(self.blade.line.twist, x) * (self.theory.trapeze is True),
            trapeze=self.trapeze(soft),
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
        places = np.concatenate((x, positions))
        turned = blade.section_frames(places)
        center, (A, C) = np.zeros((3, places.size)), np.zeros((2, 3, 3, places.size))
        center[:, : x.size], J = blade.inertia_about(x, self.slenderness)
        whole, A[:, :, : x.size] = np.ones_like(places), weights * J
        if not (blade.turns or self.theory.rotary_inertia):
            C, whole[: x.size] = float(bool(self.theory.trapeze)) * A, 0.0
            A[1:, 1:] = 0.0
        center[1:, x.size :], A[2, 2, x.size :] = centers.T, inertias
        air = blade.damping.external
        return Masses(
            places=places,
            mass=np.concatenate((weights * mass, lumped)),
            offset=np.einsum("ijp,jp->ip", turned, center),
            inertia=np.einsum("ikp,klp,jlp->ijp", turned, A, turned),
            carried=np.einsum("ikp,klp,jlp->ijp", turned, C, turned),
            whole=whole,
            drag=np.concatenate((air * weights, np.zeros_like(lumped))) if air else None,
        )


def _triangle(columns: FloatArray) -> FloatArray:
    """Return the upper triangular matrix that makes columns orthonormal, positive ones first."""
    factor = np.linalg.qr(columns, mode="r")
    return np.asarray(np.linalg.inv(factor) * np.sign(np.diag(factor)))
