"""Exudyn's beam elements in space: a cable without torsion, and the geometrically exact beam."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, ClassVar, Protocol

import numpy as np
from scipy.spatial.transform import Rotation as Turn

from analytic import AnyBlade
from analytic.arrays import FloatArray
from analytic.exact.beam.space import require_out_of_plane
from analytic.quadrature import gauss_points

from ..elements import Chain, Formulation, require_formulation
from ..elements.formulation import NoDivergence
from ..elements.hermite import shapes
from ..elements.section import POISSON_RATIO, SHEAR_CORRECTION, checked_shear, shear_share
from ..frame import Frame
from ..kinetics import energy_and_momentum
from ..lazily import exudyn, items
from ..mesh import ElementSection, Mesh
from ..rotating_beam import RotatingBeam
from .nodes import FrameNodes, SpaceSlopeNodes, directors, turning_rate

_LOBATTO = ((0.0, 1.0 / 6.0), (0.5, 2.0 / 3.0), (1.0, 1.0 / 6.0))
_GAUSS = tuple(zip(*gauss_points(2), strict=True))


class SpaceFormulation(Formulation, Protocol):
    """A beam element in space: a `Formulation` whose plane is that of rotation, and z across it."""

    leaves_plane: ClassVar[bool]
    frames: ClassVar[tuple[Frame, ...]]
    """The frames in which it can be solved."""

    def require_section(self, blade: AnyBlade) -> None:
        """Refuse a blade whose section out of the plane the element does not model."""

    def turned(self, coordinates: FloatArray, angle: FloatArray) -> FloatArray:
        """Return coordinates or rates (samples, nodes, n) turned about z by angles (samples,)."""

    def energy_and_momentum(
        self, built: RotatingBeam, blade: AnyBlade, coordinates: FloatArray, velocities: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return the kinetic energy and the angular momentum about z, (samples,).

        Of coordinates and absolute velocities (samples, nodes, n) by the axes of one frame.
        """

    def twist(self, coordinates: FloatArray) -> FloatArray | None:
        """Return the twist [rad] of the tip's section about its normal, (samples,), if any."""

    def upright(self, coordinates: FloatArray) -> FloatArray | None:
        """Return the axis of the sections that is along z at rest, (samples, nodes, 3), if any."""


@dataclass(frozen=True, kw_only=True)
class SpaceCable(SpaceSlopeNodes, NoDivergence):
    """ObjectANCFCable: nodes carry r and r'; no torsion, and one EI for all directions."""

    name: ClassVar[str] = "cable"
    takes_blades: ClassVar[bool] = True
    leaves_plane: ClassVar[bool] = True
    frames: ClassVar[tuple[Frame, ...]] = ("inertial", "rotating")
    new_jacobians: ClassVar[bool] = True  # half the time
    summary: ClassVar[str] = "ANCF cable in space, cubic, one EI, no torsion"

    def require_section(self, blade: AnyBlade) -> None:
        """Refuse a section that bends otherwise out of the plane than in it."""
        ratio = require_out_of_plane(blade, torsion=False).bending_ratio
        if abs(ratio - 1.0) > 1e-9:
            raise ValueError(
                f"element 'cable' bends alike in all directions, and this blade {ratio:.4g} times "
                "as stiffly out of the plane as in it: take element='exact', or "
                "blade.with_section_out_of_plane(bending_ratio=1.0)"
            )

    def lay(self, mbs: exudyn.MainSystem, beam: AnyBlade, elements: int) -> Chain:
        """Add `elements` cables of equal length along the x axis."""
        mesh = Mesh(blade=beam, elements=elements)
        nodes = tuple(
            mbs.AddNode(items.NodePointSlope1(referenceCoordinates=[x, 0.0, 0.0, 1.0, 0.0, 0.0]))
            for x in mesh.positions
        )
        for pair, section in zip(pairwise(nodes), mesh.sections(), strict=True):
            mbs.AddObject(
                items.ObjectANCFCable(
                    nodeNumbers=list(pair),
                    length=mesh.length,
                    massPerLength=section.mass_per_length,
                    bendingStiffness=section.bending_stiffness,
                    axialStiffness=section.axial_stiffness,
                    useReducedOrderIntegration=2,
                )
            )
        return Chain(nodes=nodes, elastic_energy=lambda e: _cable_energy(mesh, e))

    def axial_strain(self, beam: AnyBlade, coordinates: FloatArray) -> FloatArray:
        """|r'| - 1 at the nodes."""
        return np.asarray(np.linalg.norm(coordinates[..., 3:], axis=-1) - 1.0)

    def energy_and_momentum(
        self, built: RotatingBeam, blade: AnyBlade, coordinates: FloatArray, velocities: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return what the constant mass matrix makes of them."""
        return energy_and_momentum(built, coordinates, velocities, np.zeros(len(coordinates)), 1.0)

    def twist(self, coordinates: FloatArray) -> None:
        """Return None: its sections have no direction."""

    def upright(self, coordinates: FloatArray) -> None:
        """Return None: its sections have no direction."""


def _cable_energy(mesh: Mesh, coordinates: FloatArray) -> FloatArray:
    """Return the elastic energy (samples,) as Exudyn integrates it, with κ = |r'×r''|/|r'|²."""
    samples, nodes, _ = coordinates.shape
    vectors = coordinates.reshape(samples, nodes, 2, 3)
    ends = np.concatenate((vectors[:, :-1], vectors[:, 1:]), axis=2)
    sections = list(mesh.sections())
    EA = np.array([section.axial_stiffness for section in sections])
    EI = np.array([section.bending_stiffness for section in sections])
    energy = np.zeros(samples)
    for xi, weight in _LOBATTO:
        slope = np.einsum("k,seki->sei", shapes(xi, mesh.length, 1), ends)
        energy += 0.5 * weight * (np.linalg.norm(slope, axis=-1) - 1.0) ** 2 @ EA
    for xi, weight in _GAUSS:
        slope, second = (
            np.einsum("k,seki->sei", shapes(xi, mesh.length, order), ends) for order in (1, 2)
        )
        bent = np.sum(np.cross(slope, second) ** 2, axis=-1) / np.sum(slope**2, axis=-1) ** 2
        energy += 0.5 * weight * bent @ EI
    return mesh.length * energy


@dataclass(frozen=True, kw_only=True)
class SpaceExact(FrameNodes, NoDivergence):
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
    takes_blades: ClassVar[bool] = True
    leaves_plane: ClassVar[bool] = True
    frames: ClassVar[tuple[Frame, ...]] = ("inertial",)
    new_jacobians: ClassVar[bool] = True  # half the time
    # With 0.9 short waves of the Euler parameters grow, and Newton's method then gives up.
    spectral_radius: ClassVar[float] = 0.6
    summary: ClassVar[str] = "geometrically exact beam in space, two nodes, shear and torsion"

    def __post_init__(self) -> None:
        checked_shear(self.poisson_ratio, self.shear_correction)

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
        nodes = tuple(
            mbs.AddNode(
                items.NodeRigidBodyEP(referenceCoordinates=[x, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0])
            )
            for x in mesh.positions
        )
        for pair, section in zip(pairwise(nodes), mesh.sections(), strict=True):
            data: Any = exudyn.BeamSection()
            data.stiffnessMatrix = np.diag(self._stiffness(beam, section))
            data.inertia = np.diag(_inertia(beam, section))
            data.massPerLength = section.mass_per_length
            mbs.AddObject(
                items.ObjectBeamGeometricallyExact(
                    nodeNumbers=list(pair), length=mesh.length, sectionData=data
                )
            )
        return Chain(nodes=nodes, elastic_energy=lambda e: self._elastic_energy(mesh, e))

    def axial_strain(self, beam: AnyBlade, coordinates: FloatArray) -> FloatArray:
        """Strain along the normal of the sections, of each element."""
        elements = coordinates.shape[-2] - 1
        return _strains(beam.length / elements, coordinates)[..., 0]

    def energy_and_momentum(
        self, built: RotatingBeam, blade: AnyBlade, coordinates: FloatArray, velocities: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return those of velocities and turning rates linear over the elements."""
        mesh = Mesh(blade=blade, elements=coordinates.shape[-2] - 1)
        sections = list(mesh.sections())
        m = np.array([section.mass_per_length for section in sections])[:, None]
        inertia = np.array([_inertia(blade, section) for section in sections])
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

    def _stiffness(self, blade: AnyBlade, section: ElementSection) -> list[float]:
        """Return EA, GA, GA, GJ, EI out of the plane and EI in it."""
        out = require_out_of_plane(blade)
        EA, EI = section.axial_stiffness, section.bending_stiffness
        GA = shear_share(self.poisson_ratio, self.shear_correction) * EA
        assert out.torsion_ratio is not None  # see `require_section`
        return [EA, GA, GA, out.torsion_ratio * EI, out.bending_ratio * EI, EI]

    def _elastic_energy(self, mesh: Mesh, coordinates: FloatArray) -> FloatArray:
        stiffness = np.array([self._stiffness(mesh.blade, s) for s in mesh.sections()])
        strains = _strains(mesh.length, coordinates)
        return np.asarray(0.5 * mesh.length * np.sum(stiffness * strains**2, axis=(1, 2)))


def _linear(left: FloatArray, density: FloatArray, right: FloatArray) -> FloatArray:
    """Return the sums (samples,) over elements of unit length of ∫ left·density right.

    Of vectors (samples, nodes, 3) linear in between, with a density (elements, 3 or 1).
    """
    a, b, c, d = left[:, :-1], left[:, 1:], right[:, :-1], right[:, 1:]
    return np.asarray(np.sum(density * ((a + b) * (c + d) + a * c + b * d), axis=(1, 2)) / 6.0)


def _inertia(blade: AnyBlade, section: ElementSection) -> tuple[float, float, float]:
    """Return ρI_p, ρI out of the plane and ρI in it [kg m]."""
    out = require_out_of_plane(blade)
    own = section.mass_per_length * section.bending_stiffness / section.axial_stiffness
    if out.polar_inertia is None:
        polar = (1.0 + out.bending_ratio) * own
    else:
        at_root = blade.slenderness * blade.mass_per_length * blade.length**2
        polar = out.polar_inertia * own / at_root
    return polar, out.bending_ratio * section.rotary_inertia, section.rotary_inertia


def _strains(length: float, coordinates: FloatArray) -> FloatArray:
    """Return the six strains (..., elements, 6): stretch, shears, torsion, curvatures.

    The logarithm in SE(3) of the motion from one node to the other, less that of the straight
    element, over its length.
    """
    r, turn = coordinates[..., :3], directors(coordinates[..., 3:])
    to_local = np.swapaxes(turn[..., :-1, :, :], -1, -2)
    d = (to_local @ np.diff(r, axis=-2)[..., None])[..., 0]
    relative = to_local @ turn[..., 1:, :, :]
    psi = Turn.from_matrix(relative.reshape(-1, 3, 3)).as_rotvec().reshape(d.shape)
    angle = np.maximum(np.linalg.norm(psi, axis=-1, keepdims=True), 1e-4)
    # u = d - ψ×d/2 + [1 - (ψ/2) cot(ψ/2)]/ψ² ψ×(ψ×d)
    across = np.cross(psi, d)
    bent = (1.0 - 0.5 * angle / np.tan(0.5 * angle)) / angle**2
    u = d - 0.5 * across + bent * np.cross(psi, across)
    u[..., 0] -= length
    return np.concatenate((u, psi), axis=-1) / length


SPACE_FORMULATIONS: dict[str, type[Any]] = {cls.name: cls for cls in (SpaceCable, SpaceExact)}
"""The class of each formulation in space, a frozen dataclass whose fields are its options."""


def space_formulation(element: str | SpaceFormulation) -> SpaceFormulation:
    """Return the formulation in space called `element`, or the one that it is."""
    if not isinstance(element, str):
        require_formulation(element)
        return element
    if element not in SPACE_FORMULATIONS:
        names = ", ".join(repr(name) for name in SPACE_FORMULATIONS)
        raise ValueError(f"unknown element in space {element!r}; known are {names}")
    found: SpaceFormulation = SPACE_FORMULATIONS[element]()
    return found
