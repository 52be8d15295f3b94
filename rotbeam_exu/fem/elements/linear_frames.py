"""Linear elasticity in floating frames: one for the whole beam, or substructures in a row.

A substructure is a Bernoulli-Euler beam of cubic finite elements, cells, whose strain energy
½ u·K u is quadratic in displacements u seen from a frame that floats with it. Positions r and
slopes r' of its nodes are the coordinates, so r = r_0 + R(α) (X + u) is interpolated as in an ANCF
element. The kinetic energy is then exact with a constant mass matrix, neighbors connect rigidly by
sharing a node, and all local modes are in. Only the strains are linear, in each frame. Its angle α
is the angle of the tangent at the first node, or of the chord from the first to the last.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from analytic import Beam
from analytic.arrays import FloatArray
from analytic.blade_checks import require_planar
from analytic.input_checks import whole_number
from analytic.lazily import linalg, optimize

from ..lazily import exudyn
from ..mesh import HERMITE, scales
from .energy_body import Assembly, add_energy_body
from .formulation import Chain
from .node_kinds import QUARTER_TURN, SlopeNodes

FloatingFrame = Literal["tangent", "pinned"]


class _LinearFrames(SlopeNodes, abstract=True):
    """Linear frames; `row` says how a beam is cut into them."""

    def row(self, blade: Beam, elements: int) -> FrameRow:
        """Return the beam cut into frames."""
        raise NotImplementedError

    def lay(self, mbs: exudyn.MainSystem, blade: Beam, elements: int) -> Chain:
        """Add one body for the whole beam, along the x axis."""
        row = self.row(blade, elements)
        nodes = self.add_nodes(mbs, row.reference[::4])
        add_energy_body(mbs, nodes, row.mass, row)
        return Chain(nodes=nodes, elastic_energy=row.energy)

    def axial_strain(self, blade: Beam, coordinates: FloatArray) -> FloatArray:
        """∂u_x/∂x in the frames, at their nodes: the strain of the model."""
        row = self.row(blade, self._elements(coordinates.shape[-2]))
        local = row.local(coordinates.reshape(*coordinates.shape[:-2], -1))[0]
        strain = local.reshape(*local.shape[:-1], -1, 4)[..., 2] - 1.0
        return np.asarray(strain.reshape(*coordinates.shape[:-2], -1))

    def divergence_speed(self, blade: Beam, elements: int) -> float:
        """Speed [rad/s] at which the rotating steady state loses its stability.

        With gyroscopic forces only, the state is stable as long as the stiffness T - ω²M about
        it is positive definite; where its lowest eigenvalue passes zero, one mode diverges. Of one
        tangent frame that is ω0; a fully nonlinear model has no such speed (Sec. 1).
        """
        require_planar(blade)
        row = self.row(blade, whole_number("elements", elements))
        lower = 0.5 * blade.omega_0
        while (upper := 1.5 * lower) and row.lowest_eigenvalue(upper) > 0.0:
            lower = upper
        return float(optimize.brentq(row.lowest_eigenvalue, lower, upper, rtol=1e-10))

    def _elements(self, nodes: int) -> int:
        return nodes - 1


@dataclass(frozen=True, kw_only=True)
class Linear(_LinearFrames):
    """One linear floating frame, clamped to the root: the model of Sec. 1 that must diverge.

    M q̈ + 2 θ' G q̇ + (K - θ'² M + θ'' M J) q = θ'² M X - θ'' M J X, with constant matrices, all
    modes of the mesh and axial motion. Nothing in K knows of the centrifugal tension, so the first
    bending mode diverges for ω > ω0, at the rate √(ω² - ω0²): Eq. 45 without its stiffening.

    Examples
    --------
    >>> from analytic import Beam
    >>> from rotbeam_exu.fem.linearization import Linearization
    >>> from rotbeam_exu.fem.elements import Linear
    >>> print(f"{Linearization.of(Beam.reference(), 6.0, Linear()).growth_rate:.4f} 1/s")
    5.2471 1/s
    """

    name: ClassVar[str] = "linear"
    order = 4.0

    def row(self, blade: Beam, elements: int) -> FrameRow:
        """Return one frame with `elements` cells."""
        return FrameRow(blade, 1, elements, "tangent")


@dataclass(frozen=True, kw_only=True)
class Substructures(_LinearFrames):
    """Linear floating frames in a row, as many as `elements` (Valverde and García-Vallejo, 2009).

    Rotations between the frames bring the nonlinearity in piece by piece: each number of frames
    has its divergence speed, and the more frames, the higher.

    Parameters
    ----------
    frame : {"tangent", "pinned"}
        What each frame follows: the tangent at its first node, or the chord of its end nodes.
    cells : int
        Cubic finite elements in each frame; for `divergence_speed` two are within 5e-4 of many
        with tangent frames, and within 1 % with pinned ones.

    Examples
    --------
    >>> from analytic import Beam
    >>> from rotbeam_exu.fem.elements import Substructures
    >>> for n in (1, 2, 4):
    ...     print(f"{n}: {Substructures().divergence_speed(Beam.reference(), n):.4f} rad/s")
    1: 2.9106 rad/s
    2: 4.4510 rad/s
    4: 8.3581 rad/s
    """

    frame: FloatingFrame = "tangent"
    cells: int = 2

    name: ClassVar[str] = "substructures"
    order = 2.0

    def __post_init__(self) -> None:
        if self.frame not in ("tangent", "pinned"):
            raise ValueError(f"unknown frame {self.frame!r}; known are 'tangent' and 'pinned'")
        whole_number("cells", self.cells)

    def row(self, blade: Beam, elements: int) -> FrameRow:
        """Return `elements` frames."""
        return FrameRow(blade, elements, self.cells, self.frame)

    def _elements(self, nodes: int) -> int:
        return (nodes - 1) // self.cells


class FrameRow:
    """Energy, forces and tangent of frames in a row, all at once, with mass and steady state."""

    def __init__(self, blade: Beam, frames: int, cells: int, frame: FloatingFrame) -> None:
        length = blade.length / (frames * cells)
        mass, stiffness = _cell(blade, length)
        inside = Assembly(cells, inner=1, per_node=4)
        self.assembly = Assembly(frames, inner=cells, per_node=4)
        self.mass = Assembly(frames * cells, inner=1, per_node=4).matrix(mass)
        self._stiffness = inside.matrix(stiffness).toarray()
        along = length * np.arange(self.assembly.nodes)
        self.reference = np.array([[x, 0.0, 1.0, 0.0] for x in along]).ravel()
        self._shape = self.reference[: inside.size]  # X of every frame
        # The angle of a frame is that of the vector p = P e.
        self._direction = np.zeros((2, inside.size))
        if frame == "tangent":
            self._direction[:, 2:4] = np.eye(2)
        else:
            self._direction[:, :2], self._direction[:, -4:-2] = -np.eye(2), np.eye(2)

    def local(self, coordinates: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return X + u (..., frames, n), the rotations R (..., frames, 2, 2) and the vectors p."""
        e = self.assembly.gather(coordinates)
        p = e @ self._direction.T
        x, y = np.moveaxis(p / np.hypot(p[..., :1], p[..., 1:]), -1, 0)
        rotation = np.stack([np.stack([x, -y], axis=-1), np.stack([y, x], axis=-1)], axis=-2)
        vectors = e.reshape(*e.shape[:-1], -1, 2).copy()
        vectors[..., ::2, :] -= vectors[..., :1, :]  # r - r_0, for round-off's sake
        return (vectors @ rotation).reshape(e.shape), rotation, p

    def energy(self, coordinates: FloatArray) -> FloatArray:
        """Return the elastic energy (samples,) of coordinates (samples, nodes, 4)."""
        u = self.local(coordinates.reshape(coordinates.shape[0], -1))[0] - self._shape
        return 0.5 * np.asarray(np.sum((u @ self._stiffness) * u, axis=(1, 2)))

    def force(self, e: FloatArray) -> FloatArray:
        """Return the gradient of the energy, R g - m ∇α with g = K u and m = g·J(X + u)."""
        local, rotation, p = self.local(e)
        g = (local - self._shape) @ self._stiffness
        moment = np.sum(g * _quarter(local), axis=1)
        per_frame = _turned(rotation, g) - moment[:, None] * self._angle_gradient(p)
        return self.assembly.vector(per_frame)

    def tangent(self, e: FloatArray) -> FloatArray:
        """Return the derivative of the force as triplets.

        AᵀKA + w∇αᵀ + ∇αwᵀ - (g·(X + u)) ∇α∇αᵀ - m∇²α with A = Rᵀ - J(X + u)∇αᵀ and w = R J g.
        """
        local, rotation, p = self.local(e)
        g = (local - self._shape) @ self._stiffness
        gradient = self._angle_gradient(p)
        frames, size = local.shape
        A = np.zeros((frames, size // 2, 2, size // 2, 2))
        A[:, np.arange(size // 2), :, np.arange(size // 2), :] = rotation.swapaxes(1, 2)
        A = A.reshape(frames, size, size) - _outer(_quarter(local), gradient)
        mixed = _outer(_turned(rotation, _quarter(g)), gradient)
        x, y = p.T
        bend = np.array([[2 * x * y, y**2 - x**2], [y**2 - x**2, -2 * x * y]]) / (x**2 + y**2) ** 2
        second = np.einsum("ia,ijf,jb->fab", self._direction, bend, self._direction)
        moment = np.sum(g * _quarter(local), axis=1)
        along = np.sum(g * local, axis=1)
        return self.assembly.triplets(
            A.swapaxes(1, 2) @ self._stiffness @ A
            + mixed
            + mixed.swapaxes(1, 2)
            - along[:, None, None] * _outer(gradient, gradient)
            - moment[:, None, None] * second
        )

    def lowest_eigenvalue(self, omega: float) -> float:
        """Return the lowest eigenvalue [1/s²] of T - ω²M about the steady state at `omega`."""
        free = np.delete(np.arange(self.assembly.size), (0, 1, 3))
        mass = self.mass.toarray()
        e = self.reference.copy()
        # The stretched beam is straight: the frames do not turn and two steps solve it.
        for _ in range(2):
            effective = self._tangent_matrix(e) - omega**2 * mass
            residual = self.force(e) - omega**2 * mass @ e
            e[free] -= np.linalg.solve(effective[np.ix_(free, free)], residual[free])
        effective = self._tangent_matrix(e) - omega**2 * mass
        pair = effective[np.ix_(free, free)], mass[np.ix_(free, free)]
        return float(linalg.eigh(*pair, eigvals_only=True, subset_by_index=[0, 0])[0])

    def _tangent_matrix(self, e: FloatArray) -> FloatArray:
        values = self.tangent(e)[:, 2].reshape(*self.assembly.index.shape, -1)
        return np.asarray(self.assembly.matrix(values).toarray(), dtype=np.float64)

    def _angle_gradient(self, p: FloatArray) -> FloatArray:
        """∇α = Pᵀ J p/|p|², (frames, n)."""
        return np.asarray(_quarter(p) / np.sum(p**2, axis=1, keepdims=True) @ self._direction)


def _outer(a: FloatArray, b: FloatArray) -> FloatArray:
    return a[:, :, None] * b[:, None, :]


def _quarter(vectors: FloatArray) -> FloatArray:
    """J v of vectors packed in the last axis."""
    pairs = vectors.reshape(*vectors.shape[:-1], -1, 2)
    return np.asarray((pairs @ QUARTER_TURN.T).reshape(vectors.shape))


def _turned(rotation: FloatArray, vectors: FloatArray) -> FloatArray:
    """R v of vectors packed in the last axis, one R for each row."""
    pairs = vectors.reshape(vectors.shape[0], -1, 2)
    return np.asarray((pairs @ rotation.swapaxes(1, 2)).reshape(vectors.shape))


def _cell(blade: Beam, length: float) -> tuple[FloatArray, FloatArray]:
    """Mass and linear stiffness matrix (8, 8) of a cubic cell of `length`, exactly integrated."""
    scale = scales(length)

    def products(order: int) -> FloatArray:
        shapes = [b.deriv(order) if order else b for b in HERMITE]
        table = [[(a * b).integ()(1.0) for b in shapes] for a in shapes]
        return np.array(table) * np.outer(scale, scale) * length ** (1 - 2 * order)

    mass = blade.mass_per_length * np.kron(products(0), np.eye(2))
    axial = blade.axial_stiffness * np.kron(products(1), np.diag([1.0, 0.0]))
    bending = blade.bending_stiffness * np.kron(products(2), np.diag([0.0, 1.0]))
    return np.asarray(mass, dtype=np.float64), np.asarray(axial + bending, dtype=np.float64)
