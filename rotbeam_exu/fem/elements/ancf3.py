"""The paper's own element, Eqs. 2-12: three nodes, quadratic, shear-deformable."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar, Literal

import exudyn
import numpy as np
from exudyn.itemInterface import NodePoint2DSlope1

from analytic import Beam
from analytic.arrays import FloatArray

from .energy_body import Assembly, add_energy_body
from .formulation import Chain, NoDivergence
from .node_kinds import SectionSlopeNodes
from .section import POISSON_RATIO, checked_shear, rectangle, shear_modulus

Law = Literal["uncoupled", "coupled"]

# An invariant is ½ z·Q z - constant in z = (r_x, r_y, r_xy), the vectors of the axis:
# (|r_x|² - 1)/2, r_x·r_xy, |r_xy|²/2, (|r_y|² - 1)/2, r_x·r_y, r_y·r_xy.
_PAIRS = ((0, 0), (0, 2), (2, 2), (1, 1), (0, 1), (1, 2))
_CONSTANT = np.array([0.5, 0.0, 0.0, 0.5, 0.0, 0.0])


def _quadratic_forms() -> FloatArray:
    forms = np.zeros((len(_PAIRS), 3, 3))
    for form, (a, b) in zip(forms, _PAIRS, strict=True):
        form[a, b] = form[b, a] = 1.0
    return np.asarray(np.kron(forms, np.eye(2)), dtype=np.float64)


_FORMS = _quadratic_forms()


@dataclass(frozen=True, kw_only=True)
class Ancf3(SectionSlopeNodes, NoDivergence):
    """García-Vallejo, Mikkola and Escalona's element (2007), in its plane form; Eqs. 2-12.

    Nodes carry r and the section's slope r_y = ∂r/∂y (Eq. 2, whose three slopes are those of the
    nodes i, j and k: the print repeats i). Strains are Green-Lagrange's (Eq. 10), of a section
    h × b that has the beam's A and I, integrated exactly over the section and at two Gauss points
    along the element. The mass matrix (Eq. 9) is exact and holds the section's rotary inertia.
    The clamp holds r = 0 besides r_y (Eq. 14): 16 elements have 132 - 4 = 128 degrees of freedom,
    where the paper counts 130.

    Parameters
    ----------
    law : {"uncoupled", "coupled"}
        σ_xx = E ε_xx, σ_yy = E ε_yy without Poisson's coupling, or St. Venant-Kirchhoff's law in
        plane stress. The latter locks: bending wants ε_yy to vary over the section, r_y cannot.
    poisson_ratio : float
        ν, in G = E/(2(1 + ν)) and in the coupled law; the paper gives none.
    shear_correction : float
        k_s in σ_xy = 2 k_s G ε_xy; one, the plain continuum, unless asked otherwise.
    """

    law: Law = "uncoupled"
    poisson_ratio: float = POISSON_RATIO
    shear_correction: float = 1.0

    name: ClassVar[str] = "ancf3"
    summary: ClassVar[str] = "the paper's ANCF element, three nodes, quadratic, shear-deformable"

    def __post_init__(self) -> None:
        if self.law not in ("uncoupled", "coupled"):
            raise ValueError(f"unknown law {self.law!r}; known are 'uncoupled' and 'coupled'")
        checked_shear(self.poisson_ratio, self.shear_correction)

    def lay(self, mbs: exudyn.MainSystem, beam: Beam, elements: int) -> Chain:
        """Add one body for all `elements`, of equal length, along the x axis."""
        body = _Row(self, beam, elements)
        nodes = tuple(
            mbs.AddNode(NodePoint2DSlope1(referenceCoordinates=[x, 0.0, 0.0, 1.0]))
            for x in np.linspace(0.0, beam.length, body.assembly.nodes)
        )
        mass = body.assembly.matrix(_mass(beam, elements))
        add_energy_body(mbs, nodes, mass, body.force, body.tangent)
        return Chain(nodes=nodes, elastic_energy=body.energy)

    def axial_strain(self, beam: Beam, coordinates: FloatArray) -> FloatArray:
        """|r_x| - 1 at the Gauss points of the axis."""
        elements = (coordinates.shape[-2] - 1) // 2
        z = _Row(self, beam, elements).vectors(coordinates.reshape(*coordinates.shape[:-2], -1))
        strain = np.hypot(z[..., 0], z[..., 1]) - 1.0
        return np.asarray(strain.reshape(*coordinates.shape[:-2], -1))

    def moduli(self, beam: Beam) -> FloatArray:
        """Return D (6, 6) of the energy per length ½ g·D g in the six invariants g, Eq. 12.

        With a, b, c the first three, ε_xx = a + y b + y² c over the section; ε_yy is the fourth,
        and 2 ε_xy the fifth plus y times the last. ∫(1, y², y⁴) dA = A, I, Ah⁴/80.
        """
        area, inertia = beam.area, beam.second_moment
        fourth = area * rectangle(beam)[0] ** 4 / 80.0
        nu = self.poisson_ratio if self.law == "coupled" else 0.0
        modulus = beam.youngs_modulus / (1.0 - nu**2)
        shear = self.shear_correction * shear_modulus(beam, self.poisson_ratio)
        d = np.zeros((6, 6))
        d[:4, :4] = modulus * np.array(
            [
                [area, 0.0, inertia, nu * area],
                [0.0, inertia, 0.0, 0.0],
                [inertia, 0.0, fourth, nu * inertia],
                [nu * area, 0.0, nu * inertia, area],
            ]
        )
        d[4, 4], d[5, 5] = shear * area, shear * inertia
        return d


class _Row:
    """Energy, forces and tangent of a row of elements, at all Gauss points at once."""

    def __init__(self, element: Ancf3, beam: Beam, elements: int) -> None:
        self.assembly = Assembly(elements, inner=2, per_node=4)
        length = beam.length / elements
        self._shape = _axis_vectors(length)
        self._moduli = 0.5 * length * element.moduli(beam)  # the weight of either Gauss point

    def vectors(self, coordinates: FloatArray) -> FloatArray:
        """Return z = (r_x, r_y, r_xy) at the Gauss points, (..., elements, points, 6)."""
        flat = self.assembly.gather(coordinates) @ self._shape.reshape(-1, 12).T
        return flat.reshape(*flat.shape[:-1], 2, 6)

    def energy(self, coordinates: FloatArray) -> FloatArray:
        """Return the elastic energy (samples,) of coordinates (samples, nodes, 4)."""
        invariants = self._strains(coordinates.reshape(coordinates.shape[0], -1))[0]
        return 0.5 * np.asarray(np.sum((invariants @ self._moduli) * invariants, axis=(1, 2, 3)))

    def force(self, e: FloatArray) -> FloatArray:
        """Return the gradient of the energy, Bᵀ Σ (D g)_i Q_i z."""
        invariants, slopes = self._strains(e)
        stresses = invariants @ self._moduli
        conjugate = (stresses[..., None, :] @ slopes)[..., 0, :]
        return self.assembly.vector(conjugate.reshape(-1, 12) @ self._shape.reshape(12, 12))

    def tangent(self, e: FloatArray) -> FloatArray:
        """Return the derivative of the force, Bᵀ [Gᵀ D G + Σ (D g)_i Q_i] B with G = (Q_i z)."""
        invariants, slopes = self._strains(e)
        inner = np.swapaxes(slopes, -1, -2) @ self._moduli @ slopes
        inner += np.tensordot(invariants @ self._moduli, _FORMS, axes=1)
        return self.assembly.triplets(
            np.einsum("pia,jpik,pkb->jab", self._shape, inner, self._shape, optimize=True)
        )

    def _strains(self, e: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the invariants g (..., points, 6) and their gradients Q_i z (..., 6, 6)."""
        z = self.vectors(e)
        slopes = (z @ _FORMS.reshape(-1, 6).T).reshape(*z.shape, 6)
        return 0.5 * (slopes @ z[..., None])[..., 0] - _CONSTANT, slopes


@lru_cache
def _axis_vectors(length: float) -> FloatArray:
    """B (points, 6, 12) of (r_x, r_y, r_xy) = B e from Eqs. 3-7 at y = 0, two Gauss points."""
    xi = 0.5 * (np.polynomial.legendre.leggauss(2)[0] + 1.0)
    values = np.stack([1 - 3 * xi + 2 * xi**2, 4 * xi - 4 * xi**2, 2 * xi**2 - xi], axis=1)
    slopes = np.stack([4 * xi - 3, 4 - 8 * xi, 4 * xi - 1], axis=1) / length
    rows = np.zeros((2, 3, 3, 2))  # points, vectors, nodes, r or r_y
    rows[:, 0, :, 0], rows[:, 1, :, 1], rows[:, 2, :, 1] = slopes, values, slopes
    return np.asarray(np.kron(rows.reshape(2, 3, 6), np.eye(2)), dtype=np.float64)


def _mass(beam: Beam, elements: int) -> FloatArray:
    """Mass matrix (12, 12) of an element, Eq. 9: exact, with ρI for the slopes."""
    length = beam.length / elements
    overlap = length / 30.0 * np.array([[4.0, 2.0, -1.0], [2.0, 16.0, 2.0], [-1.0, 2.0, 4.0]])
    section = beam.density * np.diag([beam.area, beam.second_moment])
    return np.asarray(np.kron(np.kron(overlap, section), np.eye(2)), dtype=np.float64)
