"""Another blade whose strains are those of a solution: how its energies change with its numbers.

A mode is a stationary point of the averaged Lagrangian (Whitham 1965), a steady state one of the
amended potential. So their first change with a number of the blade is that of the energies alone,
with the strains as they are; sums of velocities and strains along the blade, taken once, give it
for every stiffness and mass.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..arrays import FloatArray
from ..blade import Blade
from ..exact.continuum.basis import Masses, StrainFunctions, Strains
from ..exact.continuum.discretization import Model
from ..exact.continuum.loading import loaded
from ..exact.continuum.planar_rotation import blade_continuum
from ..exact.continuum.rotation import SteadyBlade
from ..exact.continuum.space import SpaceContinuum
from ..exact.continuum.unit import space_unit
from ..load import Load
from ..quadrature import Grid
from ..station_section import hat
from ..theory import Theory


@dataclass(frozen=True, eq=False, kw_only=True)
class FrozenFunctions(StrainFunctions):
    """The strains of a solution's functions in another blade, in the units of the solution's."""

    of: StrainFunctions
    force: float  # the units of this blade's stiffness and mass over those of the solution's
    inertia: float

    @cached_property
    def counts(self) -> tuple[int, int, int, int]:
        """Functions in all, as of the solution."""
        return self.of.counts

    @cached_property
    def grid(self) -> Grid:
        """Points at which fields are evaluated, as of the solution."""
        return self.of.grid

    @cached_property
    def kept(self) -> FloatArray:
        """Strains of this blade's line over those of the solution's, (points, 6, 6).

        The curvatures are the same, and the strains at the centers of tension and shear: there a
        theory may keep them rigid, and where centers move apart little else would do.
        """
        result = np.tile(np.eye(6), (self.grid.points.size, 1, 1))
        result[:, :3, 3:] = self.of.to_centers - self.to_centers
        return result

    @cached_property
    def on_grid(self) -> Strains:
        """The solution's functions at the grid, on the unloaded line of this blade."""
        of = self.of.on_grid
        fields = np.einsum("pij,jpn->ipn", self.kept, np.concatenate((of.gamma, of.K)))
        return self.on_line(self.grid.points, self.soft, fields[:3], fields[3:])

    @property
    def stiff(self) -> FloatArray:
        """Stiffness against strains with weights, in the solution's units, (points, 6, 6)."""
        return np.asarray(self.force * self.grid.weights[:, None, None] * self.hard)

    @cached_property
    def stiffness(self) -> FloatArray:
        """The elastic energy is ½ q·K q, (n, n)."""
        fields = np.concatenate((self.on_grid.gamma, self.on_grid.K))
        parts = np.einsum("ipk,pij,jpl->kl", fields, self.stiff, fields, optimize=True)
        return np.asarray(parts)

    @cached_property
    def damping(self) -> FloatArray:
        """The viscous resistance of this blade to q̇, (n, n)."""
        fields = np.moveaxis(np.concatenate((self.on_grid.gamma, self.on_grid.K)), 1, 0)
        own = self.viscous(self.grid, self.soft, self.hard @ fields)
        return np.asarray(math.sqrt(self.force * self.inertia) * own)

    @cached_property
    def masses(self) -> Masses:
        """Masses of this blade in the units of the solution's."""
        own = super().masses
        return Masses(
            places=own.places, mass=self.inertia * own.mass, offset=own.offset,
            inertia=self.inertia * own.inertia, carried=self.inertia * own.carried,
            whole=own.whole,
            drag=None if own.drag is None else math.sqrt(self.force * self.inertia) * own.drag,
        )  # fmt: skip


def frozen(functions: StrainFunctions, of: Blade, blade: Blade) -> FrozenFunctions:
    """Return the functions of a solution, of the blade `of`, in another blade."""
    return FrozenFunctions(
        blade=space_unit(blade), theory=functions.theory, slenderness=blade.slenderness,
        bending=functions.bending, torsion=functions.torsion, axial=functions.axial,
        answers=functions.answers, of=functions,
        force=blade.bending_stiffness / of.bending_stiffness,
        inertia=blade.mass_per_length / of.mass_per_length,
    )  # fmt: skip


def frozen_blade(steady: SteadyBlade, of: Blade, blade: Blade) -> SteadyBlade:
    """Return the equations of another blade in space, at the speed and loads of the blade `of`."""
    model = SpaceContinuum(frozen(steady.model.functions, of, blade))
    return replace(steady, model=model, near=steady.equilibrium, given=None)


def model_of(
    model: Model, of: Blade, theory: Theory, blade: Blade, loads: Sequence[Load] = ()
) -> tuple[Model, Blade]:
    """Return the discretization of another blade with the same coordinates, and its units' blade.

    In space with the same strains, in the units of the blade `of`.
    """
    if isinstance(model, SpaceContinuum):
        return SpaceContinuum(frozen(model.functions, of, blade)), of
    bending, axial, *_ = model.families
    return blade_continuum(blade, theory, bending, axial, loaded(loads, blade)), blade


@dataclass(frozen=True)
class Kernels:
    """Sums over states of squares of strains and velocities along the blade.

    Of every sum strains (sums, points, 6, 6), velocities of the line and spins in space
    (sums, masses, 6, 6), and the spins against which sections and the clamp have inertia
    (sums, masses, 3, 3): all in the frame without twist. `trapeze` (sums, points) is the work of
    tension over k² by which twist shortens the axis, `twisted` its change with the twist κ01;
    `forced` (sums, points, 3, 6) are forces times strains; `pulled` (sums, masses, 4) is the work
    of loads per mass, on the line and on each component of an offset.
    """

    strains: FloatArray
    velocities: FloatArray
    turns: FloatArray
    carried: FloatArray
    trapeze: FloatArray
    twisted: FloatArray
    forced: FloatArray
    pulled: FloatArray

    def energies(self, functions: FrozenFunctions) -> tuple[FloatArray, FloatArray]:
        """Return elastic less kinetic energy and work, of the points of the grid and of the masses.

        Each (sums, ...); their sum is that of the blade.
        """
        masses = functions.masses
        onto = np.zeros((masses.places.size, 3, 6))
        onto[:, :, :3] = np.eye(3)
        onto[:, :, 3:] = -hat(masses.offset.T)  # ω × ρ = -ρ × ω
        inert = masses.mass[:, None, None] * np.swapaxes(onto, 1, 2) @ onto
        kinetic = np.einsum("kpij,pij->kp", self.velocities, inert)
        kinetic += np.einsum("kpij,ijp->kp", self.turns, masses.inertia)
        kinetic += np.einsum("kpij,ijp->kp", self.carried, masses.carried)
        hung = np.concatenate((np.ones((1, masses.places.size)), masses.offset))
        kinetic += 2.0 * masses.mass * np.einsum("kpi,ip->kp", self.pulled, hung)
        kept = functions.kept
        stiff = np.swapaxes(kept, 1, 2) @ functions.stiff @ kept
        elastic = np.einsum("kpij,pij->kp", self.strains, stiff)
        elastic -= 2.0 * np.einsum("kpij,pij->kp", self.forced, kept[:, :3])
        shortened = self.trapeze * functions.trapeze(functions.soft)
        return 0.5 * elastic + shortened, -0.5 * kinetic
