"""The paper's own element, Eqs. 2-12: three nodes, quadratic, shear-deformable."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar, Literal

import numpy as np

from analytic import Blade
from analytic.arrays import FloatArray
from analytic.quadrature import gauss_points

from ..lazily import exudyn
from ..mesh import Mesh, lagrange
from .energy_body import Assembly, add_energy_body, add_point_masses
from .formulation import POISSON_RATIO, Chain, Sheared
from .node_kinds import SectionSlopeNodes

Law = Literal["uncoupled", "coupled"]

# An invariant is ½ z·Q z - constant in z = (r_x, r_y, r_xy), the vectors of the axis:
# (|r_x|² - 1)/2, r_x·r_xy, |r_xy|²/2, (|r_y|² - 1)/2, r_x·r_y, r_y·r_xy.
_PAIRS = ((0, 0), (0, 2), (2, 2), (1, 1), (0, 1), (1, 2))
_CONSTANT = np.array([0.5, 0.0, 0.0, 0.5, 0.0, 0.0])


_FORMS: FloatArray = np.zeros((6, 3, 2, 3, 2))
for _form, (_a, _b) in zip(_FORMS, _PAIRS, strict=True):
    _form[_a, :, _b] = _form[_b, :, _a] = np.eye(2)
_FORMS = _FORMS.reshape(6, 6, 6)


@dataclass(frozen=True, kw_only=True)
class Ancf3(Sheared, SectionSlopeNodes):
    """García-Vallejo, Mikkola and Escalona's element (2007), in its plane form; Eqs. 2-12.

    Nodes carry r and the section's slope r_y = ∂r/∂y (Eq. 2, with the slopes of the nodes i, j and
    k: the print repeats i). Strains are Green-Lagrange's (Eq. 10), of a section h × b that has the
    beam's A and I, integrated exactly over the section and at two Gauss points along the element.
    The mass matrix (Eq. 9) is exact and holds the section's rotary inertia. A blade has its own
    section at these points: with taper or without, frequencies converge to fourth order. Where it
    has no rotary inertia it takes that of a homogeneous section; at a setting angle sections are
    laminae in the plane of bending. The clamp holds r = 0 besides r_y (Eq. 14): 16 elements have
    132 - 4 = 128 degrees of freedom, where the paper counts 130.

    Parameters
    ----------
    law : {"uncoupled", "coupled"}
        σ_xx = E ε_xx, σ_yy = E ε_yy without Poisson's coupling, or St. Venant-Kirchhoff's law in
        plane stress. The latter locks: bending wants ε_yy to vary over the section, r_y cannot.
    poisson_ratio : float
        ν, in G = E/(2(1 + ν)) and in the coupled law; the paper gives none.
    shear_correction : float
        k_s in σ_xy = 2 k_s G ε_xy; one, the plain continuum, unless asked otherwise.

    Examples
    --------
    >>> from analytic import Beam
    >>> from rotbeam_exu import natural_frequencies
    >>> from rotbeam_exu.fem.elements import Ancf3
    >>> for ratio in (0.3, 0.0):
    ...     element = Ancf3(poisson_ratio=ratio)
    ...     print(natural_frequencies(Beam.reference(), 6.0, element=element, elements=8).round(4))
    [ 3.7304 23.0123 56.7249]
    [ 3.7305 23.0126 56.7268]
    """

    law: Law = "uncoupled"
    poisson_ratio: float = POISSON_RATIO
    shear_correction: float = 1.0

    name: ClassVar[str] = "ancf3"
    order = 4.0
    takes_blades: ClassVar[bool] = True

    def __post_init__(self) -> None:
        if self.law not in ("uncoupled", "coupled"):
            raise ValueError(f"unknown law {self.law!r}; known are 'uncoupled' and 'coupled'")
        super().__post_init__()

    @property
    def meshes(self) -> tuple[int, ...]:
        """At 8 rad/s its order shows from 16 on; where it locks, coarse meshes say so."""
        return (8, 16, 32, 64) if self.starts_in_motion else ()

    @property
    def starts_in_motion(self) -> bool:
        """No state says how thick its sections are, which the coupled law would need."""
        return self.law != "coupled"

    def lay(self, mbs: exudyn.MainSystem, blade: Blade, elements: int) -> Chain:
        """Add one body for all `elements` along the x axis, and the masses."""
        mesh = Mesh(blade=blade, elements=elements, nodes_of_element=3)
        body = _Row(self, mesh)
        nodes = self.add_nodes(mbs, mesh.positions)
        add_energy_body(mbs, nodes, body.assembly.matrix(_mass(mesh)), body)
        turning = add_point_masses(mbs, nodes, mesh)
        return Chain(nodes=nodes, elastic_energy=body.energy, turning=turning)

    def axial_strain(self, blade: Blade, coordinates: FloatArray) -> FloatArray:
        """|r_x| - 1 at the Gauss points of the axis."""
        elements = (coordinates.shape[-2] - 1) // 2
        row = _Row(self, Mesh(blade=blade, elements=elements))
        z = row.vectors(coordinates.reshape(*coordinates.shape[:-2], -1))
        strain = np.hypot(z[..., 0], z[..., 1]) - 1.0
        return np.asarray(strain.reshape(*coordinates.shape[:-2], -1))

    def moduli(self, EA: FloatArray, EI: FloatArray) -> FloatArray:
        """Return D (..., 6, 6) of the energy per length ½ g·D g in the six invariants g, Eq. 12.

        Of sections with axial and bending stiffness `EA` and `EI`, (...). With a, b, c the first
        three invariants, ε_xx = a + y b + y² c over the section; ε_yy is the fourth, and 2 ε_xy
        the fifth plus y times the last. ∫E(1, y², y⁴) dA = EA, EI, EA h⁴/80 with h² = 12 EI/EA.
        """
        nu = self.poisson_ratio if self.law == "coupled" else 0.0
        plane = 1.0 / (1.0 - nu**2)
        shear = self.shear_share
        d = np.zeros((*EA.shape, 6, 6))
        for i, j, value in (
            (0, 0, plane * EA), (0, 2, plane * EI), (0, 3, plane * nu * EA), (1, 1, plane * EI),
            (2, 2, plane * 1.8 * EI**2 / EA), (2, 3, plane * nu * EI), (3, 3, plane * EA),
            (4, 4, shear * EA), (5, 5, shear * EI),
        ):  # fmt: skip
            d[..., i, j] = d[..., j, i] = value
        return d


class _Row:
    """Energy, forces and tangent of a row of elements, at all Gauss points at once."""

    def __init__(self, element: Ancf3, mesh: Mesh) -> None:
        self.assembly = Assembly(mesh.elements, inner=2, per_node=4)
        self._shape = _axis_vectors()
        # r_x and r_xy go with 1/l; (elements, points, 6).
        self._per = np.repeat(mesh.lengths[:, None, None], 6, axis=2)
        self._per = np.where([1, 1, 0, 0, 1, 1], 1.0 / self._per, 1.0)
        section = mesh.sections_at(gauss_points(2)[0])
        # The weight of either Gauss point; (elements, points, 6, 6).
        self._moduli = (
            0.5
            * mesh.lengths[:, None, None, None]
            * element.moduli(section.axial_stiffness, section.bending_stiffness)
        )

    def vectors(self, coordinates: FloatArray) -> FloatArray:
        """Return z = (r_x, r_y, r_xy) at the Gauss points, (..., elements, points, 6)."""
        flat = self.assembly.gather(coordinates) @ self._shape.reshape(-1, 12).T
        return np.asarray(flat.reshape(*flat.shape[:-1], 2, 6) * self._per)

    def energy(self, coordinates: FloatArray) -> FloatArray:
        """Return the elastic energy (samples,) of coordinates (samples, nodes, 4)."""
        invariants = self._strains(coordinates.reshape(coordinates.shape[0], -1))[0]
        return 0.5 * np.asarray(np.sum(self._stresses(invariants) * invariants, axis=(1, 2, 3)))

    def force(self, e: FloatArray) -> FloatArray:
        """Return the gradient of the energy, Bᵀ Σ (D g)_i Q_i z."""
        invariants, slopes = self._strains(e)
        conjugate = (self._stresses(invariants)[..., None, :] @ slopes)[..., 0, :]
        flat = (self._per * conjugate).reshape(-1, 12)
        return self.assembly.vector(flat @ self._shape.reshape(12, 12))

    def tangent(self, e: FloatArray) -> FloatArray:
        """Return the derivative of the force, Bᵀ [Gᵀ D G + Σ (D g)_i Q_i] B with G = (Q_i z)."""
        invariants, slopes = self._strains(e)
        inner = np.swapaxes(slopes, -1, -2) @ self._moduli @ slopes
        inner += np.tensordot(self._stresses(invariants), _FORMS, axes=1)
        inner *= self._per[..., :, None] * self._per[..., None, :]
        return self.assembly.triplets(
            np.einsum("pia,jpik,pkb->jab", self._shape, inner, self._shape, optimize=True)
        )

    def _stresses(self, invariants: FloatArray) -> FloatArray:
        """Return D g, (..., elements, points, 6)."""
        return np.asarray((self._moduli @ invariants[..., None])[..., 0])

    def _strains(self, e: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the invariants g (..., points, 6) and their gradients Q_i z (..., 6, 6)."""
        z = self.vectors(e)
        slopes = (z @ _FORMS.reshape(-1, 6).T).reshape(*z.shape, 6)
        return 0.5 * (slopes @ z[..., None])[..., 0] - _CONSTANT, slopes


@lru_cache
def _axis_vectors() -> FloatArray:
    """B (points, 6, 12) of (r_x, r_y, r_xy) = B e of Eqs. 3-7 at y = 0, l = 1, two Gauss points."""
    xi = gauss_points(2)[0]
    values, slopes = lagrange(xi, 2), lagrange(xi, 2, 1)
    rows = np.zeros((2, 3, 3, 2))  # points, vectors, nodes, r or r_y
    rows[:, 0, :, 0], rows[:, 1, :, 1], rows[:, 2, :, 1] = slopes, values, slopes
    return np.asarray(np.kron(rows.reshape(2, 3, 6), np.eye(2)), dtype=np.float64)


def _mass(mesh: Mesh) -> FloatArray:
    """Mass matrices (elements, 12, 12), Eq. 9, with ρI for the slopes."""
    xi, weights = gauss_points(5)  # exact for tapers, whose sections vary by x⁴ at most
    section, values = mesh.sections_at(xi), lagrange(xi, 2)
    mass = np.zeros((mesh.elements, 3, 2, 3, 2))  # nodes, r or r_y
    for kind, density in enumerate((section.mass_per_length, section.rotary_inertia)):
        mass[:, :, kind, :, kind] = np.einsum("pa,pb,ep->eab", values, values, density * weights)
    blocks = mesh.lengths[:, None, None] * mass.reshape(mesh.elements, 6, 6)
    return np.asarray(np.kron(blocks, np.eye(2)[None]), dtype=np.float64)
