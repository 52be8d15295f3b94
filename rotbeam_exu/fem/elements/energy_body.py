"""A body of our own in Exudyn: constant mass matrix, elastic forces from a vectorized energy."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from analytic.arrays import FloatArray
from analytic.lazily import sparse

from ..lazily import exudyn, items


class Assembly:
    """Where the coordinates of equal elements, in a row of nodes, stand in the whole.

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
    reference = np.concatenate([mbs.GetNodeParameter(n, "referenceCoordinates") for n in nodes])
    container = exudyn.MatrixContainer()
    container.SetWithSparseMatrix(sparse.csr_matrix(mass))

    def applied(mbs: Any, t: float, item: int, q: Any, q_t: Any) -> FloatArray:
        return -force(reference + np.asarray(q))

    def jacobian(
        mbs: Any, t: float, item: int, q: Any, q_t: Any, factor_q: float, factor_q_t: float
    ) -> Any:
        triplets = tangent(reference + np.asarray(q))
        triplets[:, 2] *= factor_q
        matrix = exudyn.MatrixContainer()
        matrix.SetWithSparseMatrix(triplets, *mass.shape)
        return matrix

    mbs.AddObject(
        items.ObjectGenericODE2(
            nodeNumbers=list(nodes),
            massMatrix=container,
            forceUserFunction=applied,
            jacobianUserFunction=jacobian,
        )
    )
