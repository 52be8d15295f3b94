"""Bodies and forces of our own in Exudyn, over the coordinates of a row of nodes or of one.

Point masses on nodes that carry slopes have an inertia J against rotation. The angle ϑ of a node is
that of its slope p, and T = ½Jϑ̇² with ϑ̇ = g·ṗ, g = (-p_y, p_x)/|p|². A constant mass J of the
slope, T = ½J|ṗ|², is no substitute: its centrifugal force stretches the blade at a point, the more
so the finer the mesh, and frequencies drift off it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from analytic.arrays import FloatArray
from analytic.lazily import sparse

from ..lazily import exudyn, items
from ..mesh import Mesh


class Assembly:
    """Places of the coordinates of equal elements, in a row of nodes, among all coordinates.

    An element adds `inner` nodes, one fewer than it has.
    """

    def __init__(self, elements: int, inner: int, per_node: int) -> None:
        self.nodes = inner * elements + 1
        self.size = self.nodes * per_node
        within = np.arange((inner + 1) * per_node)
        self.index = np.arange(elements)[:, None] * inner * per_node + within
        shape = (elements, within.size, within.size)
        self._rows = np.broadcast_to(self.index[:, :, None], shape).ravel()
        self._columns = np.broadcast_to(self.index[:, None, :], shape).ravel()

    def gather(self, coordinates: FloatArray) -> FloatArray:
        """Return element coordinates (..., elements, n) of all coordinates (..., size)."""
        return coordinates[..., self.index]

    def vector(self, per_element: FloatArray) -> FloatArray:
        """Add up element vectors (elements, n) to one (size,)."""
        total = np.bincount(self.index.ravel(), per_element.ravel(), self.size)
        return total.astype(np.float64, copy=False)

    def triplets(self, per_element: FloatArray) -> FloatArray:
        """Return (rows, columns, values), to be added up, of element matrices (elements, n, n)."""
        return np.column_stack([self._rows, self._columns, per_element.ravel()])

    def matrix(self, per_element: FloatArray) -> sparse.csr_array:
        """Add up element matrices (elements, n, n), or one for all, to one (size, size)."""
        shape = (*self.index.shape, self.index.shape[1])
        values = np.broadcast_to(per_element, shape).ravel()
        place: tuple[NDArray[np.int64], ...] = (self._rows, self._columns)
        return sparse.coo_array((values, place), shape=(self.size, self.size)).tocsr()


def add_energy_body(
    mbs: exudyn.MainSystem, nodes: Sequence[exudyn.NodeIndex], mass: sparse.csr_array, row: Any
) -> None:
    """Add M e'' + f(e) = 0 over the coordinates e of `nodes`, reference included.

    `row.force` returns f, the gradient of the elastic energy, and `row.tangent` its derivative as
    triplets to be added up.
    """
    add_force(
        mbs, nodes,
        force=lambda t, e, rates: -row.force(e),
        derivatives=lambda t, e: [(row.tangent(e), -1.0, 0.0)],
        mass=mass,
    )  # fmt: skip


def add_force(
    mbs: exudyn.MainSystem,
    nodes: Sequence[exudyn.NodeIndex],
    *,
    force: Callable[[float, FloatArray, FloatArray], FloatArray],
    derivatives: Callable[[float, FloatArray], Sequence[tuple[FloatArray, float, float]]],
    mass: sparse.csr_array | None = None,
) -> None:
    """Add M e'' = f(t, e, e') over the coordinates e of `nodes`, reference included.

    `derivatives` returns parts, each a matrix as triplets to be added up, and the factors with
    which it stands in ∂f/∂e and in ∂f/∂e'. Without `mass` M is zero.
    """
    reference = np.concatenate([mbs.GetNodeParameter(n, "referenceCoordinates") for n in nodes])
    size, container = reference.size, exudyn.MatrixContainer()
    container.SetWithSparseMatrix(sparse.csr_matrix((size, size) if mass is None else mass))

    def applied(mbs: Any, t: float, item: int, q: Any, q_t: Any) -> FloatArray:
        return force(t, reference + np.asarray(q), np.asarray(q_t))

    def jacobian(
        mbs: Any, t: float, item: int, q: Any, q_t: Any, factor_q: float, factor_q_t: float
    ) -> Any:
        rows = []
        for part, by_q, by_q_t in derivatives(t, reference + np.asarray(q)):
            rows.append(part.copy())
            rows[-1][:, 2] *= -(factor_q * by_q + factor_q_t * by_q_t)
        matrix = exudyn.MatrixContainer()
        matrix.SetWithSparseMatrix(np.vstack(rows), size, size)
        return matrix

    mbs.AddObject(
        items.ObjectGenericODE2(
            nodeNumbers=list(nodes),
            massMatrix=container,
            forceUserFunction=applied,
            jacobianUserFunction=jacobian,
        )
    )


def add_mass(
    mbs: exudyn.MainSystem, nodes: Sequence[exudyn.NodeIndex], mass: sparse.csr_array
) -> None:
    """Add M e'' over the coordinates e of `nodes`."""
    container = exudyn.MatrixContainer()
    container.SetWithSparseMatrix(sparse.csr_matrix(mass))
    mbs.AddObject(items.ObjectGenericODE2(nodeNumbers=list(nodes), massMatrix=container))


def triplets(matrix: sparse.csr_array) -> FloatArray:
    """Return (rows, columns, values) of a matrix, as Exudyn takes them."""
    entries = matrix.tocoo()
    return np.column_stack([entries.row, entries.col, entries.data]).astype(np.float64)


TurningNode = tuple[int, float]
"""A node, by its place in the chain, and the inertia [kg m²] against rotation of its slope."""

_SLOPE = slice(2, 4)
"""The coordinates of a node that are its slope."""


def add_point_masses(
    mbs: exudyn.MainSystem, nodes: tuple[exudyn.NodeIndex, ...], mesh: Mesh, dimensions: int = 2
) -> tuple[TurningNode, ...]:
    """Add the masses, and return the nodes whose slopes are to be given an inertia."""
    body = items.ObjectMassPoint2D if dimensions == 2 else items.ObjectMassPoint
    for node, one in mesh.lumped():
        if one.mass:
            mbs.AddObject(body(nodeNumber=nodes[node], mass=one.mass))
    return tuple((node, one.inertia) for node, one in mesh.lumped() if one.inertia)


def add_point_inertias(
    mbs: exudyn.MainSystem,
    nodes: Sequence[exudyn.NodeIndex],
    turning: Iterable[TurningNode],
    acceleration: Callable[[float], float],
) -> None:
    """Add J (ϑ̈ + α) to the angles of the turning nodes of a chain.

    α(t) is the angular acceleration of the frame about the normal of the plane of bending.
    """
    for node, inertia in turning:
        _add_inertia(mbs, nodes[node], inertia, acceleration)


def _add_inertia(
    mbs: exudyn.MainSystem, node: Any, inertia: float, acceleration: Callable[[float], float]
) -> None:
    reference = np.array(mbs.GetNodeParameter(node, "referenceCoordinates"))[_SLOPE]

    def angle_gradient(q: Any) -> tuple[FloatArray, FloatArray]:
        p = reference + np.asarray(q)[_SLOPE]
        return p, np.array([-p[1], p[0]]) / (p @ p)

    def mass(mbs: Any, t: float, item: int, q: Any, q_t: Any) -> FloatArray:
        matrix = np.zeros((4, 4))
        gradient = angle_gradient(q)[1]
        matrix[_SLOPE, _SLOPE] = inertia * np.outer(gradient, gradient)
        return matrix

    def force(mbs: Any, t: float, item: int, q: Any, q_t: Any) -> FloatArray:
        p, gradient = angle_gradient(q)
        rate = np.asarray(q_t)[_SLOPE]
        # ϑ̈ = g·p̈ + ġ·ṗ
        turning = acceleration(t) - 2.0 * (p @ rate) * (gradient @ rate) / (p @ p)
        result = np.zeros(4)
        result[_SLOPE] = -inertia * turning * gradient
        return result

    mbs.AddObject(
        items.ObjectGenericODE2(
            nodeNumbers=[node], massMatrixUserFunction=mass, forceUserFunction=force
        )
    )


def spins(
    turning: Iterable[TurningNode], coordinates: FloatArray, velocities: FloatArray
) -> list[tuple[float, FloatArray]]:
    """Return J and ϑ̇ (samples,) of each turning node, from arrays (samples, nodes, 4)."""
    result = []
    for node, inertia in turning:
        p, rate = coordinates[:, node, _SLOPE], velocities[:, node, _SLOPE]
        across = p[:, 0] * rate[:, 1] - p[:, 1] * rate[:, 0]
        result.append((inertia, across / np.sum(p**2, axis=1)))
    return result
