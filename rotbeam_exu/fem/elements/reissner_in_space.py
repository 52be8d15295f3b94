"""Exudyn's geometrically exact beam in space: two nodes, sheared and twisted."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, ClassVar

import numpy as np

from analytic import AnyBlade
from analytic.arrays import FloatArray
from analytic.exact.beam.space import require_out_of_plane
from analytic.lazily import Lazily

from ..frame import Frame
from ..lazily import exudyn, items
from ..mesh import Mesh
from .formulation import Chain, Formulation
from .node_kinds import ABOUT_Z
from .section import POISSON_RATIO, SHEAR_CORRECTION, Sheared

_turns = Lazily("scipy.spatial.transform")

_HALF_TURN = np.array(
    [[0.0, 0.0, 0.0, -1.0], [0.0, 0.0, -1.0, 0.0], [0.0, 1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]]
)
"""Product of the unit vector along z with Euler parameters, as a quaternion from the left."""


class FrameNodes(Formulation, abstract=True):
    """Nodes carry r and the Euler parameters p of the section, whose first axis is its normal."""

    leaves_plane: ClassVar[bool] = True
    node: ClassVar[str] = "NodeRigidBodyEP"
    straight: ClassVar[tuple[float, ...]] = (0.0, 0.0, 1.0, 0.0, 0.0, 0.0)
    quarter_turn: ClassVar[FloatArray] = np.block(
        [[ABOUT_Z, np.zeros((3, 4))], [np.zeros((4, 3)), 0.5 * _HALF_TURN]]
    )
    angles: ClassVar[FloatArray] = np.zeros(7)
    fixed_at_root: ClassVar[tuple[int, ...]] = (0, 1, 2)

    def clamp(self, angle: float) -> tuple[FloatArray, FloatArray]:
        """Give p = (cos θ/2, 0, 0, sin θ/2); |p| = 1 holds one of them."""
        gradient = np.zeros((3, 7))
        gradient[0, 4] = gradient[1, 5] = 1.0
        gradient[2, 3], gradient[2, 6] = -math.sin(0.5 * angle), math.cos(0.5 * angle)
        return gradient, np.zeros(3)

    def turned(self, vectors: FloatArray, angle: FloatArray) -> FloatArray:
        """Return r and p (samples, nodes, 7), rates too, turned about z by angles (samples,)."""
        half, p = 0.5 * angle[:, None, None], vectors[..., 3:]
        return np.concatenate(
            (
                _about_z(vectors[..., :3], angle[:, None]),
                np.cos(half) * p + np.sin(half) * (p @ _HALF_TURN.T),
            ),
            axis=-1,
        )

    def coordinates(self, x: FloatArray, state: Any) -> tuple[FloatArray, FloatArray]:
        """Positions and p of a section turned by φ in the plane and tilted out of it by β.

        tan β = w'/|r'| of the planar r'.
        """
        slope = (1.0 + state.u_slope) + 1j * state.v_slope
        rate = state.u_slope_dot + 1j * state.v_slope_dot
        phi = np.angle(slope) - state.shear_angle
        phi_dot = (rate / slope).imag - state.shear_angle_dot
        tan = state.w_slope / np.abs(slope)
        tan_dot = state.w_slope_dot / np.abs(slope) - tan * (rate / slope).real
        beta, beta_dot = np.arctan(tan), tan_dot / (1.0 + tan**2)
        c, s, C, S = (f(0.5 * a) for a in (phi, beta) for f in (np.cos, np.sin))
        p = np.stack((c * C, s * S, -c * S, s * C), axis=1)
        by_phi = np.stack((-s * C, c * S, s * S, c * C), axis=1)
        by_beta = np.stack((-c * S, s * C, -c * C, -s * S), axis=1)
        p_dot = 0.5 * (phi_dot[:, None] * by_phi + beta_dot[:, None] * by_beta)
        r = np.stack((x + state.u, state.v, state.w), axis=1)
        r_dot = np.stack((state.u_dot, state.v_dot, state.w_dot), axis=1)
        return np.concatenate((r, p), axis=1), np.concatenate((r_dot, p_dot), axis=1)


@dataclass(frozen=True, kw_only=True)
class SpaceExact(Sheared, FrameNodes):
    """ObjectBeamGeometricallyExact: two nodes that carry r and the section, shear-deformable.

    The screw from one node to the other is the strain, constant in the element; velocities and
    turning rates are linear. Exudyn ignores its damping.

    Parameters
    ----------
    poisson_ratio, shear_correction : float
        ν and k_s of the shear stiffness k_s A E/(2 (1 + ν)).
    """

    poisson_ratio: float = POISSON_RATIO
    shear_correction: float = SHEAR_CORRECTION

    name: ClassVar[str] = "exact"
    summary: ClassVar[str] = "geometrically exact beam in space, two nodes, shear and torsion"
    order = 2.0
    takes_blades: ClassVar[bool] = True
    frames: ClassVar[tuple[Frame, ...]] = ("inertial",)
    new_jacobians: ClassVar[bool] = True  # half the time
    # With 0.9 short waves of the Euler parameters grow, and Newton's method then gives up.
    spectral_radius: ClassVar[float] = 0.6

    def require_section(self, blade: AnyBlade) -> None:
        """Refuse a section whose torsion is not a finite number."""
        torsion = require_out_of_plane(blade).torsion_ratio
        if torsion is None or math.isinf(torsion):
            raise ValueError(
                "element 'exact' twists, and the torsion_ratio of this blade is "
                f"{'unknown' if torsion is None else 'infinite'}: take a number for it, as "
                "blade.with_shape(Tube()) has, or element='cable' where bending_ratio is 1"
            )

    def lay(self, mbs: exudyn.MainSystem, beam: AnyBlade, elements: int) -> Chain:
        """Add `elements` beams of equal length along the x axis."""
        mesh = Mesh(blade=beam, elements=elements)
        nodes = self.add_nodes(mbs, mesh.positions)
        stiffness, inertia = self._stiffness(mesh), _inertia(mesh)
        for i, pair in enumerate(pairwise(nodes)):
            data: Any = exudyn.BeamSection()
            data.stiffnessMatrix = np.diag(stiffness[i])
            data.inertia = np.diag(inertia[i])
            data.massPerLength = mesh.sections.mass_per_length[i]
            mbs.AddObject(
                items.ObjectBeamGeometricallyExact(
                    nodeNumbers=list(pair), length=mesh.length, sectionData=data
                )
            )

        def energy(coordinates: FloatArray) -> FloatArray:
            squares = _strains(mesh.length, coordinates) ** 2
            return np.asarray(0.5 * mesh.length * np.sum(stiffness * squares, axis=(1, 2)))

        return Chain(nodes=nodes, elastic_energy=energy)

    def axial_strain(self, beam: AnyBlade, coordinates: FloatArray) -> FloatArray:
        """Strain along the normal of the sections, of each element."""
        elements = coordinates.shape[-2] - 1
        return _strains(beam.length / elements, coordinates)[..., 0]

    def energy_and_momentum(
        self, beam: AnyBlade, mass: Any, turning: Any, coordinates: FloatArray,
        velocities: FloatArray, rate: FloatArray,
    ) -> tuple[FloatArray, FloatArray]:  # fmt: skip
        """Return both for velocities and turning rates linear over the elements."""
        mesh = Mesh(blade=beam, elements=coordinates.shape[-2] - 1)
        m, inertia = mesh.sections.mass_per_length[:, None], _inertia(mesh)
        r, v = coordinates[..., :3], velocities[..., :3]
        spin = turning_rate(coordinates[..., 3:], velocities[..., 3:])
        axis = directors(coordinates[..., 3:])[..., 2, :]  # z by the axes of the section
        around = np.stack((-r[..., 1], r[..., 0]), axis=-1)
        kinetic = 0.5 * (_linear(v, m, v) + _linear(spin, inertia, spin))
        momentum = _linear(around, m, v[..., :2]) + _linear(axis, inertia, spin)
        return mesh.length * kinetic, mesh.length * momentum

    def twist(self, coordinates: FloatArray) -> FloatArray:
        """Return how far the section has turned from upright."""
        upright = directors(coordinates[:, -1, 3:])[:, 2]
        return np.unwrap(np.arctan2(upright[:, 1], upright[:, 2]))

    def upright(self, coordinates: FloatArray) -> FloatArray:
        """Return the third axis of the sections."""
        return directors(coordinates[..., 3:])[..., 2]

    def _stiffness(self, mesh: Mesh) -> FloatArray:
        """Return EA, GA, GA, GJ, EI out of the plane and EI in it, (elements, 6)."""
        out = require_out_of_plane(mesh.blade)
        EA, EI = mesh.sections.axial_stiffness, mesh.sections.bending_stiffness
        GA = self.shear_share * EA
        assert out.torsion_ratio is not None  # see `require_section`
        return np.stack((EA, GA, GA, out.torsion_ratio * EI, out.bending_ratio * EI, EI), axis=1)


def _linear(left: FloatArray, density: FloatArray, right: FloatArray) -> FloatArray:
    """Return the sums (samples,) over elements of unit length of ∫ left·density right.

    Of vectors (samples, nodes, 3) linear in between, with a density (elements, 3 or 1).
    """
    a, b, c, d = left[:, :-1], left[:, 1:], right[:, :-1], right[:, 1:]
    return np.asarray(np.sum(density * ((a + b) * (c + d) + a * c + b * d), axis=(1, 2)) / 6.0)


def _inertia(mesh: Mesh) -> FloatArray:
    """Return ρI_p, ρI out of the plane and ρI in it [kg m], (elements, 3)."""
    blade, out, at = mesh.blade, require_out_of_plane(mesh.blade), mesh.sections
    own = at.mass_per_length * at.bending_stiffness / at.axial_stiffness
    if out.polar_inertia is None:
        polar = (1.0 + out.bending_ratio) * own
    else:
        at_root = blade.slenderness * blade.mass_per_length * blade.length**2
        polar = out.polar_inertia * own / at_root
    return np.stack((polar, out.bending_ratio * at.rotary_inertia, at.rotary_inertia), axis=1)


def _strains(length: float, coordinates: FloatArray) -> FloatArray:
    """Return the six strains (..., elements, 6): stretch, shears, torsion, curvatures.

    The logarithm in SE(3) of the motion from one node to the other, relative to the straight
    element, over its length.
    """
    r, turn = coordinates[..., :3], directors(coordinates[..., 3:])
    to_local = np.swapaxes(turn[..., :-1, :, :], -1, -2)
    d = (to_local @ np.diff(r, axis=-2)[..., None])[..., 0]
    relative = to_local @ turn[..., 1:, :, :]
    psi = _turns.Rotation.from_matrix(relative.reshape(-1, 3, 3)).as_rotvec().reshape(d.shape)
    angle = np.maximum(np.linalg.norm(psi, axis=-1, keepdims=True), 1e-4)
    # u = d - ψ×d/2 + [1 - (ψ/2) cot(ψ/2)]/ψ² ψ×(ψ×d)
    across = np.cross(psi, d)
    bent = (1.0 - 0.5 * angle / np.tan(0.5 * angle)) / angle**2
    u = d - 0.5 * across + bent * np.cross(psi, across)
    u[..., 0] -= length
    return np.concatenate((u, psi), axis=-1) / length


def directors(p: FloatArray) -> FloatArray:
    """Return the rotations (..., 3, 3) of Euler parameters (..., 4), whatever their norm."""
    flat = _turns.Rotation.from_quat(p.reshape(-1, 4)[:, [1, 2, 3, 0]]).as_matrix()
    return np.asarray(flat.reshape(*p.shape[:-1], 3, 3))


def turning_rate(p: FloatArray, p_dot: FloatArray) -> FloatArray:
    """Return the angular velocity (..., 3) by the axes of the section, 2 p* ∘ ṗ."""
    scalar, vector = p[..., :1], p[..., 1:]
    rate, turning = p_dot[..., :1], p_dot[..., 1:]
    return np.asarray(2.0 * (scalar * turning - rate * vector - np.cross(vector, turning)))


def _about_z(vectors: FloatArray, angle: FloatArray) -> FloatArray:
    """Return vectors (..., 3) turned about z by `angle` (...)."""
    seen = (vectors[..., 0] + 1j * vectors[..., 1]) * np.exp(1j * angle)
    return np.stack((seen.real, seen.imag, vectors[..., 2]), axis=-1)
