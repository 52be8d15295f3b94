"""What a beam formulation must offer to be driven, solved and judged."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import exudyn
import numpy as np
from numpy.typing import NDArray

from analytic import Beam, BeamState

FloatArray = NDArray[np.float64]

exudyn.config.printToConsole = False
# Without a display, an open renderer ends the process.
exudyn.special.userInterface.suppressRenderer = True


@dataclass(frozen=True, kw_only=True)
class Chain:
    """A beam laid along the x axis in an Exudyn system.

    Parameters
    ----------
    nodes : tuple of NodeIndex
        Nodes from the clamped root to the free tip.
    bodies : tuple of ObjectIndex
        Objects that report the elastic energy as their potential energy.
    """

    nodes: tuple[exudyn.NodeIndex, ...]
    bodies: tuple[exudyn.ObjectIndex, ...]


class Formulation(Protocol):
    """A planar beam element: its chain, its clamp and what its coordinates mean.

    The coordinates of a node are those that Exudyn integrates, reference values included, here
    as arrays of shape (..., nodes, coordinates per node).
    """

    @property
    def summary(self) -> str:
        """One line that names the formulation."""

    @property
    def fixed_at_root(self) -> tuple[int, ...]:
        """Root coordinates held at their reference values in the inertial frame."""

    @property
    def fixed_in_rotating_frame(self) -> tuple[int, ...]:
        """Root coordinates held at their reference values in the rotating frame."""

    @property
    def quarter_turn(self) -> FloatArray:
        """Generator J of a rotation of one node's coordinates, (coordinates, coordinates)."""

    def lay(self, mbs: exudyn.MainSystem, beam: Beam, elements: int) -> Chain:
        """Add nodes and elements for `beam` to `mbs`."""

    def coordinates(self, x: FloatArray, state: BeamState) -> tuple[FloatArray, FloatArray]:
        """Return coordinates and rates (nodes, n) of a beam in `state` at the nodes `x` [m]."""

    def turn(self, coordinates: FloatArray, angle: FloatArray) -> FloatArray:
        """Return `coordinates` (samples, nodes, n) of a beam turned by `angle` (samples,) [rad]."""

    def direction(self, root: FloatArray, sine: float, cosine: float) -> float:
        """Residual [-] of the root's direction against the angle given by its sine and cosine."""

    def direction_gradient(self, sine: float, cosine: float) -> FloatArray:
        """Return the derivative of `direction` with respect to the root's coordinates, (1, n)."""

    def axial_strain(self, coordinates: FloatArray) -> FloatArray:
        """Axial strain [-] at the nodes, (..., nodes)."""
