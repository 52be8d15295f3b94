"""Exudyn's geometrically exact beam in space: two nodes, sheared and twisted."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, ClassVar

import numpy as np

from analytic import Blade
from analytic.arrays import FloatArray
from analytic.exact.continuum.unit import SpaceUnit, space_unit
from analytic.lazily import spatial
from analytic.motion import Rotation
from analytic.quadrature import gauss_points
from analytic.station_section import hat

from ..lazily import exudyn, items
from ..mesh import Mesh, cells
from .energy_body import Assembly, add_force, add_mass, add_point_masses
from .formulation import POISSON_RATIO, SHEAR_CORRECTION, Chain, Sheared
from .node_kinds import FrameNodes, cross, directors, onto_parameters, require_light, turning_rate
from .screw import Screw, times

_INNER, _ = gauss_points(2)
"""Where Exudyn integrates the inertia against rotation, with equal weights, as measured."""


@dataclass(frozen=True, kw_only=True)
class SpaceExact(Sheared, FrameNodes):
    """ObjectBeamGeometricallyExact: two nodes that carry r and the section, shear-deformable.

    The screw from one node to the other, less that of the unloaded blade, is the strain, constant
    in the element; velocities and turning rates are linear. The nodes stand along the sections of
    the unloaded blade, at their centers of mass, to which stiffness and inertia are moved: a blade
    may have twist, precone, prebend, sweep, a setting angle, offsets of its centers, a table of
    stations, or point masses at the centers of mass. It may have kinks; one about both axes of
    sections that bend more easily about one of them leaves an error of first order. Exudyn's
    section couples no strains: what of the stiffness is off the diagonal is a force of our own,
    called from Exudyn. Sections have their inertia and the propeller moment, but not the trapeze
    effect. Exudyn ignores its section's damping: viscosity is a force of our own too.

    Parameters
    ----------
    poisson_ratio, shear_correction : float
        ν and k_s of the shear stiffness k_s A E/(2 (1 + ν)); a table of stations has its own.

    Examples
    --------
    >>> from analytic import Beam
    >>> from rotbeam_exu import natural_frequencies
    >>> blade = Beam.reference().with_section_out_of_plane(0.0625, 0.08)
    >>> blade = blade.with_twist(0.5).with_precone(0.04)
    >>> print(natural_frequencies(blade, 6.0, element="space_exact", elements=16).round(3))
    [ 3.728  6.243 15.91 ]
    """

    poisson_ratio: float = POISSON_RATIO
    shear_correction: float = SHEAR_CORRECTION

    name: ClassVar[str] = "space_exact"
    order = 2.0
    takes_blades: ClassVar[bool] = True
    takes_viscosity: ClassVar[bool] = True
    new_jacobians: ClassVar[bool] = True  # half the time
    # With 0.9 short waves of the Euler parameters grow, and Newton's method then gives up.
    spectral_radius: ClassVar[float] = 0.6

    @property
    def meshes(self) -> tuple[int, ...]:
        """Seven frequencies of a blade are decided with the last one."""
        return 16, 32, 64, 128

    def require_section(self, blade: Blade) -> None:
        """Refuse point masses that turn with their section, and an unknown torsion."""
        require_light(self, blade)
        if blade.table:
            return
        out = blade.section.out_of_plane
        torsion = None if out is None else out.torsion_ratio
        if torsion is None or math.isinf(torsion):
            raise ValueError(
                "element 'space_exact' twists, and the torsion_ratio of this blade is "
                f"{'unknown' if torsion is None else 'infinite'}: give a number by "
                "blade.with_section_out_of_plane(bending_ratio, torsion_ratio) or "
                "blade.with_shape(Tube()), or take element='space_cable' where bending_ratio is 1"
            )

    def lay(self, mbs: exudyn.MainSystem, blade: Blade, elements: int) -> Chain:
        """Add `elements` beams on the unloaded line."""
        row = _Row(self, blade, elements)
        nodes = tuple(
            mbs.AddNode(items.NodeRigidBodyEP(referenceCoordinates=one)) for one in row.reference
        )
        bodies = []
        for i, pair in enumerate(pairwise(nodes)):
            data: Any = exudyn.BeamSection()
            data.stiffnessMatrix = np.diag(np.diag(row.stiffness[i]))
            data.inertia = row.inertia[i]
            data.massPerLength = row.mass[i]
            body = items.ObjectBeamGeometricallyExact(
                nodeNumbers=list(pair), length=row.lengths[i], sectionData=data
            )
            bodies.append(mbs.AddObject(body))
        add_point_masses(mbs, nodes, row.mesh, self.dimensions)
        if row.uneven.any():
            places = np.diag([1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0])
            add_mass(mbs, nodes, row.add.matrix(np.asarray(np.kron(row.uneven, places), float)))
        viscous = row.dissipation if row.viscosity.any() else None
        coupled = row.coupled_energy if row.coupling.any() else None
        if coupled or viscous:

            def derivatives(t: float, e: FloatArray) -> list[tuple[FloatArray, float, float]]:
                # In motion Newton's method does without that of viscous forces by the place.
                parts = [(row.add.triplets(row.slope(e)), -1.0, 0.0)] if coupled else []
                if viscous:
                    parts.append((row.add.triplets(row.viscous(e)), 0.0, -1.0))
                return parts

            add_force(
                mbs, nodes,
                force=lambda t, e, rates: -row.add.vector(
                    row.own_force(row.add.gather(e), row.add.gather(rates) if viscous else None)
                ),
                derivatives=derivatives,
            )  # fmt: skip
        return Chain(nodes=nodes, bodies=tuple(bodies), elastic_energy=coupled, dissipation=viscous)

    def arms(self, blade: Blade, elements: int) -> FloatArray:
        """Return the places of the centers of mass, (nodes, 3)."""
        return _Row(self, blade, elements).arms

    def add_spin_forces(
        self, mbs: exudyn.MainSystem, chain: Chain, blade: Blade, rotation: Rotation
    ) -> None:
        """Add the inertial forces of the rotating frame on the Euler parameters."""
        row = _Row(self, blade, len(chain.nodes) - 1)
        add = row.add

        def force(t: float, e: FloatArray, rates: FloatArray) -> FloatArray:
            w, w_dot = rotation.rate(t), rotation.acceleration(t)
            return add.vector(row.spin_forces(add.gather(e), add.gather(rates), w, w_dot))

        def derivatives(t: float, e: FloatArray) -> list[tuple[FloatArray, float, float]]:
            w, w_dot, at = rotation.rate(t), rotation.acceleration(t), add.gather(e)

            def slope(by_place: float, by_rate: float) -> FloatArray:
                # About rest: in motion Newton's method does without the rest.
                steps = _STEPS[..., None, :]
                ahead, behind = row.spin_forces(at + by_place * steps, by_rate * steps, w, w_dot)
                result = np.zeros((*at.shape, 14))
                result[:, :, _TURNS] = np.moveaxis(ahead - behind, 0, -1) / (2.0 * _STEP)
                return add.triplets(result)

            return [(slope(1.0, 0.0), 1.0, 0.0), (slope(0.0, 1.0), 0.0, 1.0)]

        add_force(mbs, chain.nodes, force=force, derivatives=derivatives)

    def axial_strain(self, blade: Blade, coordinates: FloatArray) -> FloatArray:
        """Strain along the normal, the mean of each section: its normal force over its EA.

        That of the line would be of bending, where the line is far from the tension centers.
        """
        row = _Row(self, blade, coordinates.shape[-2] - 1)
        strain = row.strains(row.add.gather(coordinates.reshape(*coordinates.shape[:-2], -1)))
        force = np.sum(row.stiffness[:, 0] * strain, axis=-1)
        return np.asarray(row.compliance * force)

    def energy_and_momentum(
        self, blade: Blade, mass: Any, turning: Any, coordinates: FloatArray,
        velocities: FloatArray, rate: FloatArray,
    ) -> tuple[FloatArray, FloatArray]:  # fmt: skip
        """Return both, of sections whose turning rates are linear over the elements."""
        row, states = _Row(self, blade, coordinates.shape[-2] - 1), (coordinates, velocities)
        _, spin, inertia = row.turning(*(row.add.gather(e.reshape(len(e), -1)) for e in states))
        moment = (inertia @ spin[..., None])[..., 0]
        kinetic, momentum = super().energy_and_momentum(blade, mass, turning, *states, rate)
        kinetic += 0.25 * np.sum(spin * moment, axis=(2, 3)) @ row.lengths
        return kinetic, momentum + 0.5 * np.sum(moment[..., 2], axis=2) @ row.lengths


_TURNS = [3, 4, 5, 6, 10, 11, 12, 13]
"""Coordinates of an element that are Euler parameters."""

_STEP = 1e-5
"""Step of central differences of Euler parameters, which are of the size of one."""

_BESIDE = 1e-9
"""Distance from a kink over the length, at which sections are those of one side."""

_STEPS = _STEP * np.stack((np.eye(14)[_TURNS], -np.eye(14)[_TURNS]))


class _Row:
    """A row of elements: its unloaded blade, sections, strains and inertia against rotation.

    Stiffness and, over the length, viscosity (elements, 6, 6), with strains in the order ε, γ2, γ3,
    κ1, κ2, κ3, and inertia (elements, 3, 3) are about the centers of mass, which are at `arms`
    (nodes, 3) from the line in axes of the section; `compliance` (elements,) is the mean of 1/EA.
    """

    def __init__(self, element: SpaceExact, blade: Blade, elements: int) -> None:
        mesh, unit = Mesh(blade=blade, elements=elements), space_unit(blade)
        self.mesh, self.lengths = mesh, mesh.lengths
        frame, L = element.line_frame(blade), blade.length
        theory = element.theory_of(blade)

        def weight(x: FloatArray) -> FloatArray:
            # Of the energy of moments that go with (1 - x)², as those of a load on all the blade.
            return np.asarray((1.0 - x) ** 4)[:, None, None]

        def soft(x: FloatArray) -> FloatArray:
            onto = np.tile(np.eye(6), (x.size, 1, 1))
            onto[:, :3, 3:] = -hat(unit.inertia_about(x, blade.slenderness)[0].T)
            at = unit.flexibility(x, theory, blade.slenderness)
            return weight(x) * (onto @ at @ np.swapaxes(onto, 1, 2))

        def stretched(x: FloatArray) -> FloatArray:
            # Where centers jump, the mean of an element's flexibility is mostly of bending.
            at = unit.flexibility(x, theory, blade.slenderness)
            return np.asarray(1.0 / np.linalg.inv(at)[:, :1, :1])

        def spread(x: FloatArray) -> FloatArray:
            xi = cells(mesh.ends, x)[1]
            both = np.stack((1.0 - xi, xi), axis=1)
            return mesh.along(x).mass_per_length[:, None, None] * both[:, :, None] * both[:, None]

        def about(x: FloatArray) -> FloatArray:
            return np.moveaxis(unit.inertia_about(x, blade.slenderness)[1], -1, 0)

        lever = np.repeat([1.0, L], 3)
        scale = blade.bending_stiffness / L**2 * np.outer(lever, lever)
        self.stiffness = scale * np.linalg.inv(mesh.mean(soft) / mesh.mean(weight))
        self.compliance = mesh.mean(stretched)[:, 0, 0] * L**2 / blade.bending_stiffness
        self.coupling = self.stiffness * (1.0 - np.eye(6))
        rates = np.sqrt(blade.damping.of_strains)
        self.viscosity = _viscosity(self.stiffness, rates) / self.lengths[:, None, None]
        self.mass = mesh.sections.mass_per_length
        # Of functions of both ends; those of the mean mass are Exudyn's.
        even = np.multiply.outer(self.mass, [[2.0, 1.0], [1.0, 2.0]]) / 6.0
        uneven = mesh.mean(spread) - even
        round_off = np.abs(uneven) < 1e-12 * even
        self.uneven = np.where(round_off, 0.0, uneven) * self.lengths[:, None, None]
        self.inertia = blade.mass_per_length * L**2 * mesh.mean(about)
        self.arms = L * unit.inertia_about(mesh.ends, blade.slenderness)[0].T
        place, sections = unit.unloaded(mesh.ends)
        sections = frame @ _halfway(unit, mesh.ends, sections)
        r = L * (unit.clamp + place) @ frame.T + (sections @ self.arms[..., None])[..., 0]
        p = spatial.transform.Rotation.from_matrix(sections).as_quat()[:, [3, 0, 1, 2]]
        self.reference = np.hstack((r, p))
        self.add = Assembly(elements, inner=1, per_node=7)
        self._unloaded: FloatArray = np.zeros(6)
        self._unloaded = self.strains(self.add.gather(self.reference.ravel()))

    def _strained(self, between: Screw) -> FloatArray:
        return between.logarithm / self.lengths[:, None] - self._unloaded

    def strains(self, e: FloatArray) -> FloatArray:
        """Return the strains (..., elements, 6) of coordinates (..., elements, 14)."""
        return self._strained(Screw.of(e))

    def coupled_energy(self, coordinates: FloatArray) -> FloatArray:
        """Return the energy (samples,) of the stiffness off the diagonal, ½ l ε·C ε."""
        strain = self.strains(self.add.gather(coordinates.reshape(len(coordinates), -1)))
        stress = times(self.coupling, strain)
        return np.asarray(0.5 * np.sum(strain * stress, axis=-1) @ self.lengths)

    def own_force(self, e: FloatArray, rates: FloatArray | None = None) -> FloatArray:
        """Return the gradient (..., elements, 14) of the same and, with rates, viscous forces."""
        between = Screw.of(e)
        stress = times(self.coupling, self._strained(between))
        if rates is None:
            return between.onto_ends(stress)
        change = between.slopes()
        stress += times(self.viscosity, times(change, rates))
        return times(np.swapaxes(change, -1, -2), stress)

    def viscous(self, e: FloatArray) -> FloatArray:
        """Return the derivative (elements, 14, 14) of the viscous forces by the rates."""
        change = Screw.of(self.add.gather(e)).slopes()
        return np.asarray(np.swapaxes(change, -1, -2) @ self.viscosity @ change)

    def dissipation(self, coordinates: FloatArray, velocities: FloatArray) -> FloatArray:
        """Return the power (samples,) that viscosity takes."""
        e, rates = (self.add.gather(v.reshape(len(v), -1)) for v in (coordinates, velocities))
        rate = times(Screw.of(e).slopes(), rates)
        return np.asarray(np.sum(rate * times(self.viscosity, rate), axis=(-2, -1)))

    def slope(self, e: FloatArray) -> FloatArray:
        """Return the derivative (elements, 14, 14) of `own_force` at rest at all coordinates."""
        at, steps = self.add.gather(e), _STEP * np.eye(14)[:, None]
        change = self.own_force(at + steps) - self.own_force(at - steps)
        return np.moveaxis(change, 0, -1) / (2.0 * _STEP)

    def turning(
        self, e: FloatArray, rates: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return frames of the ends, and spins and inertias at both Gauss points, in space's axes.

        From coordinates and rates of the elements (..., elements, 14).
        """
        p, p_dot = (v.reshape(*v.shape[:-1], 2, 7)[..., 3:] for v in (e, rates))
        turn = directors(p)
        ends = (turn @ turning_rate(p, p_dot)[..., None])[..., 0]
        psi = _rotation_vector(np.swapaxes(turn[..., 0, :, :], -1, -2) @ turn[..., 1, :, :])
        part = spatial.transform.Rotation.from_rotvec(
            (_INNER[:, None] * psi[..., None, :]).reshape(-1, 3)
        )
        at = turn[..., :1, :, :] @ part.as_matrix().reshape(*psi.shape[:-1], 2, 3, 3)
        inertia = at @ self.inertia[:, None] @ np.swapaxes(at, -1, -2)
        return turn, _VALUES @ ends, inertia

    def spin_forces(self, e: FloatArray, rates: FloatArray, w: float, w_dot: float) -> FloatArray:
        """Return the forces (..., elements, 14) of a frame that turns about z at w on its sections.

        J (ω + W)' + (ω + W) × J (ω + W) is their balance; Exudyn has J ω' + ω × J ω of it.
        """
        turn, spin, inertia = self.turning(e, rates)
        W, W_dot = np.array([[0.0, 0.0, w], [0.0, 0.0, w_dot]])

        torque = cross(spin, times(inertia, spin)) - cross(spin + W, times(inertia, spin + W))
        torque -= times(inertia, W_dot + cross(W, spin))
        ends = 0.5 * self.lengths[:, None, None] * _VALUES.T @ torque
        p = e.reshape(*e.shape[:-1], 2, 7)[..., 3:]
        local = (np.swapaxes(turn, -1, -2) @ ends[..., None])[..., 0]
        forces = np.zeros((*p.shape[:-1], 7))
        forces[..., 3:] = onto_parameters(p, local)
        return forces.reshape(*e.shape[:-1], 14)


def _viscosity(stiffness: FloatArray, rates: FloatArray) -> FloatArray:
    """Return the viscous resistance (elements, 6, 6) to rates of strains, by the six √η.

    As of the exact blade: of forces, and of moments about the centers of tension and shear.
    """
    forces, root = stiffness[:, :3], np.diag(rates)
    free = np.linalg.inv(forces[:, :, :3])  # strains over forces where nothing bends
    resisting = np.swapaxes(forces, 1, 2) @ root[:3, :3] @ free @ root[:3, :3] @ forces
    bends = stiffness - np.swapaxes(forces, 1, 2) @ free @ forces  # of curvatures alone
    return np.asarray(resisting + root @ bends @ root)


def _halfway(unit: SpaceUnit, ends: FloatArray, sections: FloatArray) -> FloatArray:
    """Return the sections of nodes, at a kink halfway between both sides: errors there cancel."""
    at = np.array([x for x, *_ in unit.line.kinks])
    nodes = np.flatnonzero(np.isclose(ends, at[:, None], rtol=0.0, atol=_BESIDE).any(axis=0))
    if not nodes.size:
        return sections
    before, after = (unit.unloaded(ends[nodes] + side)[1] for side in (-_BESIDE, _BESIDE))
    turn = spatial.transform.Rotation.from_rotvec(
        0.5 * _rotation_vector(np.swapaxes(before, -1, -2) @ after)
    )
    sections = sections.copy()
    sections[nodes] = before @ turn.as_matrix()
    return sections


_VALUES = np.stack((1.0 - _INNER, _INNER), axis=1)
"""Linear functions of both nodes at the Gauss points, (points, nodes)."""


def _rotation_vector(turn: FloatArray) -> FloatArray:
    """Return the rotation vectors (..., 3) of rotations (..., 3, 3)."""
    flat = spatial.transform.Rotation.from_matrix(turn.reshape(-1, 3, 3)).as_rotvec()
    return np.asarray(flat.reshape(turn.shape[:-1]))
