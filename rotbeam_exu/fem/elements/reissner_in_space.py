"""Exudyn's geometrically exact beam in space: two nodes, sheared and twisted."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, ClassVar

import numpy as np

from analytic import Blade
from analytic.arrays import FloatArray
from analytic.exact.continuum.unit import space_unit
from analytic.lazily import spatial
from analytic.motion import Rotation
from analytic.quadrature import gauss_points

from ..lazily import exudyn, items
from ..mesh import Mesh
from .energy_body import Assembly, add_force
from .formulation import POISSON_RATIO, SHEAR_CORRECTION, Chain, Sheared
from .node_kinds import FrameNodes, directors, require_bare, turning_rate

_INNER, _ = gauss_points(2)
"""Where Exudyn integrates the inertia against rotation, with equal weights, as measured."""


@dataclass(frozen=True, kw_only=True)
class SpaceExact(Sheared, FrameNodes):
    """ObjectBeamGeometricallyExact: two nodes that carry r and the section, shear-deformable.

    The screw from one node to the other, less that of the unloaded blade, is the strain, constant
    in the element; velocities and turning rates are linear. The nodes stand on the unloaded line
    and along its sections: a blade may have twist, precone, prebend, sweep and a setting angle.
    Sections have their inertia and the propeller moment, but not the trapeze effect. Damping is
    external only, for Exudyn ignores that of strains; centers of mass and tension are on the line.

    Parameters
    ----------
    poisson_ratio, shear_correction : float
        ν and k_s of the shear stiffness k_s A E/(2 (1 + ν)).

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
    new_jacobians: ClassVar[bool] = True  # half the time
    # With 0.9 short waves of the Euler parameters grow, and Newton's method then gives up.
    spectral_radius: ClassVar[float] = 0.6

    @property
    def meshes(self) -> tuple[int, ...]:
        """Seven frequencies of a blade are decided with the last one."""
        return 16, 32, 64, 128

    def require_section(self, blade: Blade) -> None:
        """Refuse a table of stations, kinks, centers off the line, and an unknown torsion."""
        require_bare(self, blade)
        section, line = blade.section, blade.line
        if section.at_stations or line.kinks:
            raise ValueError(
                "element 'space_exact' takes sections by their ratios on a smooth line, and this "
                f"blade has {'kinks' if line.kinks else 'a table of stations'}: take "
                "analytic.spin_up_response, or on the command line rotbeam reference"
            )
        out = section.out_of_plane
        torsion = None if out is None else out.torsion_ratio
        if torsion is None or math.isinf(torsion):
            raise ValueError(
                "element 'space_exact' twists, and the torsion_ratio of this blade is "
                f"{'unknown' if torsion is None else 'infinite'}: give a number by "
                "blade.with_section_out_of_plane(bending_ratio, torsion_ratio) or "
                "blade.with_shape(Tube()), or take element='space_cable' where bending_ratio is 1"
            )
        if any(line.mass_offset) or any(line.tension_offset):
            raise ValueError(
                "element 'space_exact' has its centers of mass and of tension on its line, and "
                "this blade has offsets: take blade.with_offsets(), which has none, or "
                "analytic.spin_up_response"
            )

    def lay(self, mbs: exudyn.MainSystem, blade: Blade, elements: int) -> Chain:
        """Add `elements` beams of equal length on the unloaded line."""
        row = _Row(self, blade, elements)
        nodes = tuple(
            mbs.AddNode(items.NodeRigidBodyEP(referenceCoordinates=one)) for one in row.reference
        )
        bodies = []
        for i, pair in enumerate(pairwise(nodes)):
            data: Any = exudyn.BeamSection()
            data.stiffnessMatrix = np.diag(row.stiffness[i])
            data.inertia = np.diag(row.inertia[i])
            data.massPerLength = row.mass[i]
            body = items.ObjectBeamGeometricallyExact(
                nodeNumbers=list(pair), length=row.length, sectionData=data
            )
            bodies.append(mbs.AddObject(body))
        return Chain(nodes=nodes, bodies=tuple(bodies))

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
        """Strain along the normal of the sections, of each element."""
        return _Row(self, blade, coordinates.shape[-2] - 1).stretch(coordinates)

    def energy_and_momentum(
        self, blade: Blade, mass: Any, turning: Any, coordinates: FloatArray,
        velocities: FloatArray, rate: FloatArray,
    ) -> tuple[FloatArray, FloatArray]:  # fmt: skip
        """Return both, of sections whose turning rates are linear over the elements."""
        row, states = _Row(self, blade, coordinates.shape[-2] - 1), (coordinates, velocities)
        _, spin, inertia = row.turning(*(row.add.gather(e.reshape(len(e), -1)) for e in states))
        moment = (inertia @ spin[..., None])[..., 0]
        kinetic, momentum = super().energy_and_momentum(blade, mass, turning, *states, rate)
        kinetic += 0.25 * row.length * np.sum(spin * moment, axis=(1, 2, 3))
        return kinetic, momentum + 0.5 * row.length * np.sum(moment[..., 2], axis=(1, 2))


_TURNS = [3, 4, 5, 6, 10, 11, 12, 13]
"""Coordinates of an element that are Euler parameters."""

_STEP = 1e-5
"""Step of central differences of Euler parameters, which are of the size of one."""

_STEPS = _STEP * np.stack((np.eye(14)[_TURNS], -np.eye(14)[_TURNS]))


class _Row:
    """A row of elements: its unloaded line, sections, strains and inertia against rotation.

    Stiffness (elements, 6) is EA, GA, GA, GJ, EI out of the plane and EI in it; inertia
    (elements, 3) is ρI_p, ρI out of the plane and ρI in it [kg m].
    """

    def __init__(self, element: SpaceExact, blade: Blade, elements: int) -> None:
        mesh, unit = Mesh(blade=blade, elements=elements), space_unit(blade)
        self.length, frame = mesh.length, element.line_frame(blade)
        place, sections = unit.unloaded(np.linspace(0.0, 1.0, elements + 1))
        r = blade.length * (unit.clamp + place) @ frame.T
        p = spatial.transform.Rotation.from_matrix(frame @ sections).as_quat()[:, [3, 0, 1, 2]]
        self.reference = np.hstack((r, p))
        at = mesh.sections
        EA, EI, self.mass = at.axial_stiffness, at.bending_stiffness, at.mass_per_length
        GA, bent = element.shear_share * EA, unit.flap * EI
        self.stiffness = np.stack((EA, GA, GA, unit.torsion * EI, bent, EI), axis=1)
        inner, weights = gauss_points(8)
        x = (np.arange(elements)[:, None] + inner).ravel() / elements
        _, about = unit.inertia_about(x, blade.slenderness)
        means = weights @ np.diagonal(about).reshape(elements, -1, 3)
        self.inertia = blade.mass_per_length * blade.length**2 * means
        self.add = Assembly(elements, inner=1, per_node=7)
        self._unloaded = self._pitches(self.reference)

    def stretch(self, coordinates: FloatArray) -> FloatArray:
        """Return the axial strain, (..., elements)."""
        return (self._pitches(coordinates) - self._unloaded) / self.length

    def _pitches(self, coordinates: FloatArray) -> FloatArray:
        """Return the first of the logarithms in SE(3) of the motions from node to node."""
        r, turn = coordinates[..., :3], directors(coordinates[..., 3:])
        to_local = np.swapaxes(turn[..., :-1, :, :], -1, -2)
        d = (to_local @ np.diff(r, axis=-2)[..., None])[..., 0]
        psi = _rotation_vector(to_local @ turn[..., 1:, :, :])
        angle = np.maximum(np.linalg.norm(psi, axis=-1, keepdims=True), 1e-4)
        # u = d - ψ×d/2 + [1 - (ψ/2) cot(ψ/2)]/ψ² ψ×(ψ×d)
        across = np.cross(psi, d)
        bent = (1.0 - 0.5 * angle / np.tan(0.5 * angle)) / angle**2
        return np.asarray((d - 0.5 * across + bent * np.cross(psi, across))[..., 0])

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
        inertia = (at * self.inertia[:, None, None, :]) @ np.swapaxes(at, -1, -2)
        return turn, _VALUES @ ends, inertia

    def spin_forces(self, e: FloatArray, rates: FloatArray, w: float, w_dot: float) -> FloatArray:
        """Return the forces (..., elements, 14) of a frame that turns about z at w on its sections.

        J (ω + W)' + (ω + W) × J (ω + W) is their balance; Exudyn has J ω' + ω × J ω of it.
        """
        turn, spin, inertia = self.turning(e, rates)
        W, W_dot = np.array([[0.0, 0.0, w], [0.0, 0.0, w_dot]])

        def times(vector: FloatArray) -> FloatArray:
            return np.asarray((inertia @ vector[..., None])[..., 0])

        torque = np.cross(spin, times(spin)) - np.cross(spin + W, times(spin + W))
        torque -= times(W_dot + np.cross(W, spin))
        ends = 0.5 * self.length * _VALUES.T @ torque
        p = e.reshape(*e.shape[:-1], 2, 7)[..., 3:]
        local = (np.swapaxes(turn, -1, -2) @ ends[..., None])[..., 0]
        forces = np.zeros((*p.shape[:-1], 7))
        forces[..., 3] = -2.0 * np.sum(p[..., 1:] * local, axis=-1)
        forces[..., 4:] = 2.0 * (p[..., :1] * local + np.cross(p[..., 1:], local))
        return forces.reshape(*e.shape[:-1], 14)


_VALUES = np.stack((1.0 - _INNER, _INNER), axis=1)
"""Linear functions of both nodes at the Gauss points, (points, nodes)."""


def _rotation_vector(turn: FloatArray) -> FloatArray:
    """Return the rotation vectors (..., 3) of rotations (..., 3, 3)."""
    flat = spatial.transform.Rotation.from_matrix(turn.reshape(-1, 3, 3)).as_rotvec()
    return np.asarray(flat.reshape(turn.shape[:-1]))
