"""Bodies and forces of our own in Exudyn, over the coordinates of a row of nodes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from analytic.arrays import FloatArray
from analytic.lazily import sparse

from ..lazily import exudyn, items


class Assembly:
    """Places of the coordinates of equal elements, in a row of nodes, among all coordinates.

    Parameters
    ----------
    elements : int
        Elements in the row.
    inner : int
        Nodes that an element adds, one fewer than it has.
    per_node : int
        Coordinates of a node.
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
    mbs: exudyn.MainSystem,
    nodes: Sequence[exudyn.NodeIndex],
    mass: sparse.csr_array,
    force: Callable[[FloatArray], FloatArray],
    tangent: Callable[[FloatArray], FloatArray],
) -> None:
    """Add M e'' + f(e) = 0 over the coordinates e of `nodes`, reference included.

    `force` returns f, the gradient of the elastic energy, and `tangent` its derivative as
    triplets to be added up.
    """
    add_force(
        mbs, nodes, mass.shape[0],
        force=lambda t, e, rates: -force(e),
        derivatives=lambda t, e: [(tangent(e), -1.0, 0.0)],
        mass=mass,
    )  # fmt: skip


def add_force(
    mbs: exudyn.MainSystem,
    nodes: Sequence[exudyn.NodeIndex],
    size: int,
    *,
    force: Callable[[float, FloatArray, FloatArray], FloatArray],
    derivatives: Callable[[float, FloatArray], Sequence[tuple[FloatArray, float, float]]],
    mass: sparse.csr_array | None = None,
) -> None:
    """Add M e'' = f(t, e, e') over the coordinates e of `nodes`, (size,), reference included.

    `derivatives` returns parts, each a matrix as triplets to be added up, and the factors with
    which it stands in ∂f/∂e and in ∂f/∂e'. Without `mass` M is zero.
    """
    reference = np.concatenate([mbs.GetNodeParameter(n, "referenceCoordinates") for n in nodes])
    container = exudyn.MatrixContainer()
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


def triplets(matrix: sparse.csr_array) -> FloatArray:
    """Return (rows, columns, values) of a matrix, as Exudyn takes them."""
    entries = matrix.tocoo()
    return np.column_stack([entries.row, entries.col, entries.data]).astype(np.float64)
