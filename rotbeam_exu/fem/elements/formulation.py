"""What a beam formulation must offer to be driven, solved and judged."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar, Protocol

import numpy as np

from analytic.arrays import FloatArray

from ..lazily import exudyn

TurningNode = tuple[int, float]
"""A node, by its place in the chain, and the inertia [kg m²] against rotation of its slope."""


@dataclass(frozen=True, kw_only=True)
class Chain:
    """A beam laid along the x axis in an Exudyn system.

    Parameters
    ----------
    nodes : tuple of NodeIndex
        Nodes from the clamped root to the free tip.
    bodies : tuple of ObjectIndex
        Objects that report their elastic energy as their potential energy, where they do.
    elastic_energy : callable, optional
        The elastic energy [J], (samples,), from the coordinates of the nodes, reference included,
        (samples, nodes, n), where Exudyn's objects do not report it.
    turning : tuple of TurningNode
        Nodes whose slopes, coordinates 2 and 3, get an inertia: no constant mass matrix holds it,
        and `drive` adds it.
    dissipation : callable, optional
        The power [W], (samples,), that the viscosity of the beam takes, from coordinates and rates
        of the nodes (samples, nodes, n) in any one frame, where the beam has viscosity.
    """

    nodes: tuple[exudyn.NodeIndex, ...]
    bodies: tuple[exudyn.ObjectIndex, ...] = ()
    elastic_energy: Callable[[FloatArray], FloatArray] | None = None
    turning: tuple[TurningNode, ...] = ()
    dissipation: Callable[[FloatArray, FloatArray], FloatArray] | None = None


class Formulation(Protocol):
    """A planar beam element: its chain, its clamp and what its coordinates mean.

    A formulation is a frozen dataclass whose fields are its options, and inherits from
    `analytic.description.Described`, as kinds of nodes do: its class and its options say how to
    make it again. The coordinates of a node are those that Exudyn integrates, reference
    values included, here as arrays of shape (..., nodes, n). A rotation by θ takes them, and
    mass matrix and elastic forces with them, to exp(θJ) e + θ a: J turns positions and slopes,
    a adds to angles. One that lays any `Blade` says so by ``takes_blades = True``, and by
    ``takes_viscosity = True`` if with its bending and axial damping; to others only the uniform
    beam is given, and blades without. One that moves in space, out of the plane of rotation too,
    has ``leaves_plane = True``. Of the solver one may ask for ``new_jacobians = True``, in each
    step, and for another ``spectral_radius`` than 0.9 in the inertial frame.
    """

    name: ClassVar[str]
    """What the user calls it."""
    summary: ClassVar[str]
    """One line that names the formulation."""
    quarter_turn: ClassVar[FloatArray]
    """Generator J of a rotation of one node's coordinates, (n, n); zero for angles."""
    angles: ClassVar[FloatArray]
    """The vector a, (n,): one for coordinates that are angles of the section, else zero."""
    fixed_at_root: ClassVar[tuple[int, ...]]
    """Root coordinates held at their reference values, whatever the angle."""

    @property
    def order(self) -> float | None:
        """Order of convergence in the length of the elements; None if it is not known."""

    @property
    def shear_share(self) -> float | None:
        """k_s GA over EA of a beam that shears and has rotary inertia, else None."""

    @property
    def meshes(self) -> tuple[int, ...]:
        """Numbers of elements on which it is judged; none of half, the same and twice as many."""

    @property
    def starts_in_motion(self) -> bool:
        """Whether the state of a beam says all of its coordinates."""

    def __hash__(self) -> int:
        """Equal options, equal hash: a formulation is a value."""

    def lay(self, mbs: exudyn.MainSystem, beam: Any, elements: int) -> Chain:
        """Add nodes and elements for `beam` to `mbs`."""

    def clamp(self, angle: float) -> tuple[FloatArray, FloatArray]:
        """Return C (m, n) and d (m,) of the constraints C e = d that turn the root's e to θ."""

    def coordinates(self, x: FloatArray, state: Any) -> tuple[FloatArray, FloatArray]:
        """Return coordinates and rates (nodes, n) of a beam in `state`, a BeamState.

        Its nodes are at `x` [m] from the axis.
        """

    def axial_strain(self, beam: Any, coordinates: FloatArray) -> FloatArray:
        """Axial strain [-] along the beam, (..., points), of coordinates (..., nodes, n)."""

    def divergence_speed(self, beam: Any, elements: int) -> float:
        """Speed [rad/s] above which the model diverges, infinite where its strains are exact."""


class NoDivergence:
    """The answer of formulations that describe large deformation exactly."""

    takes_blades: ClassVar[bool] = False
    takes_viscosity: ClassVar[bool] = False
    order: float | None = None
    shear_share: float | None = None
    meshes: tuple[int, ...] = ()
    starts_in_motion: bool = True

    def divergence_speed(self, beam: Any, elements: int) -> float:
        """Return infinity: divergence is an artifact of linear elastic frames (Sec. 1)."""
        return math.inf


def turned(element: Formulation, coordinates: FloatArray, angle: FloatArray) -> FloatArray:
    """Return exp(θJ) e + θ a of coordinates (samples, nodes, n), `angle` θ (samples,) [rad]."""
    return turned_velocities(element, coordinates, angle) + angle[:, None, None] * element.angles


def turned_velocities(
    element: Formulation, velocities: FloatArray, angle: FloatArray
) -> FloatArray:
    """Return exp(θJ) v = v + sin θ J v + (1 - cos θ) J² v of vectors (samples, nodes, n)."""
    once = velocities @ element.quarter_turn.T
    twice = once @ element.quarter_turn.T
    sine, versine = np.sin(angle)[:, None, None], (1.0 - np.cos(angle))[:, None, None]
    return velocities + sine * once + versine * twice


def radial(element: Formulation) -> FloatArray:
    """Return one for coordinates along the clamp's line, which J turns across it, else 0, (n,)."""
    return np.asarray((element.quarter_turn > 0.0).any(axis=0), dtype=np.float64)


def spun(element: Formulation, coordinates: FloatArray) -> FloatArray:
    """Return J e + a, the velocities of a rotation at 1 rad/s, of coordinates (..., nodes, n)."""
    return coordinates @ element.quarter_turn.T + element.angles
