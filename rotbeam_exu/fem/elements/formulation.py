"""The base of beam formulations: all that driving, solving and judging them needs."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np

from analytic import Blade
from analytic.arrays import FloatArray
from analytic.blade_checks import require_blade, require_planar
from analytic.description import Described
from analytic.exact.continuum.planar_kinematics import in_plane_of_bending
from analytic.input_checks import finite_number, positive
from analytic.lazily import sparse
from analytic.motion import Rotation
from analytic.theory import Theory

from ..lazily import exudyn, items
from ..mesh import cells, lagrange
from .energy_body import TurningNode, spins

POISSON_RATIO = 0.3
"""Default ν of beams that shear; the paper gives neither ν nor a shear modulus."""

SHEAR_CORRECTION = 5.0 / 6.0
"""Default k_s of a rectangle whose section stays plane; an element may have reason for another."""


@dataclass(frozen=True, kw_only=True)
class Chain:
    """A beam along the x axis in an Exudyn system.

    Parameters
    ----------
    nodes : tuple of NodeIndex
        From the clamped root to the free tip.
    bodies : tuple of ObjectIndex
        Elements of Exudyn, which report their elastic energy as their potential energy.
    elastic_energy : callable, optional
        That of bodies of our own [J], (samples,), by the coordinates of the nodes, reference
        included, (samples, nodes, n).
    turning : tuple of TurningNode
        Nodes whose slopes, coordinates 2 and 3, get an inertia: no constant mass matrix holds it.
    dissipation : callable, optional
        The power [W], (samples,), that viscosity takes, by coordinates and rates of the nodes in
        any one frame.
    """

    nodes: tuple[exudyn.NodeIndex, ...]
    bodies: tuple[exudyn.ObjectIndex, ...] = ()
    elastic_energy: Callable[[FloatArray], FloatArray] | None = None
    turning: tuple[TurningNode, ...] = ()
    dissipation: Callable[[FloatArray, FloatArray], FloatArray] | None = None

    def reference(self, mbs: exudyn.MainSystem) -> FloatArray:
        """Return the reference coordinates, (nodes, n)."""
        return np.array([mbs.GetNodeParameter(n, "referenceCoordinates") for n in self.nodes])


class Formulation(Described, abstract=True):
    """A beam element: its chain, its clamp, what its coordinates mean, and its abilities.

    A formulation is a frozen dataclass whose fields are its options; its class and its options say
    how to make it again. It inherits from a kind of node (`node_kinds`), by which it lives in the
    plane or in space, and defines `lay` and `axial_strain`. The coordinates of a node are Exudyn's,
    reference values included, as arrays of shape (..., nodes, n). A rotation by θ about the axis
    takes them, and mass matrix and elastic forces with them, to exp(θJ) e + θ a: J turns positions
    and slopes, a adds to angles.
    """

    name: ClassVar[str]
    """Name that the user gives; of a class that says none its own, never that of its base."""

    takes_blades: ClassVar[bool] = False
    """Whether it models any `Blade`, not the uniform beam alone."""
    takes_viscosity: ClassVar[bool] = False
    """Whether it has bending and axial damping."""
    leaves_plane: ClassVar[bool] = False
    """Whether it lives in space: z is across the plane of rotation."""
    takes_wrenches: ClassVar[bool] = False
    """Whether moments act on its nodes, too: it then has `torques`."""
    twists: ClassVar[bool] = False
    """Whether its sections turn about the axis."""
    constant_mass: ClassVar[bool] = True
    """Whether the mass matrix of all coordinates is constant, as the rotating frame asks for."""
    new_jacobians: ClassVar[bool] = False
    """Whether the solver is to make a new Jacobian in each step."""
    spectral_radius: ClassVar[float] = 0.9
    """Spectral radius of the generalized-α integrator in the inertial frame."""

    node: ClassVar[str]
    """Exudyn's class of the nodes."""
    straight: ClassVar[tuple[float, ...]]
    """Reference coordinates of a node of the straight beam, but for its x, the first."""
    quarter_turn: ClassVar[FloatArray]
    """Generator J of a rotation of one node's coordinates, (n, n); zero for angles."""
    pace: ClassVar[FloatArray | float] = 1.0
    """Angle by which J turns coordinates over that of the rotation, (n,): half for Euler's."""
    angles: ClassVar[FloatArray]
    """The vector a, (n,): one for coordinates that are angles of the section, else zero."""
    clamped: ClassVar[tuple[int, ...]]
    """Root coordinates, besides its place, that the clamp holds at the angle zero."""
    joint: ClassVar[tuple[int, ...]] = ()
    """Axes that a GenericJoint of the root with a rigid body holds; none if it has no frame."""

    def __init_subclass__(cls, **rest: Any) -> None:
        super().__init_subclass__(**rest)
        cls.name = vars(cls).get("name", cls.__name__)

    @property
    def order(self) -> float | None:
        """Order of convergence in the length of the elements; None if it is not known."""
        return None

    @property
    def meshes(self) -> tuple[int, ...]:
        """Numbers of elements on which it is judged; if none, half, the same and twice as many."""
        return ()

    @property
    def starts_in_motion(self) -> bool:
        """Whether the state of a beam says all of its coordinates."""
        return True

    @property
    def shear_share(self) -> float | None:
        """k_s GA over EA of a beam that shears and has rotary inertia, else None."""
        return None

    @property
    def theory(self) -> Theory:
        """Theory of its beam."""
        sheared = self.shear_share is not None
        return Theory(shear=self.shear_share, rotary_inertia=sheared, trapeze=not self.leaves_plane)

    def theory_of(self, blade: Blade) -> Theory:
        """Theory of its beam where it models a blade; a table of stations has its own shear."""
        table = blade.table and self.shear_share is not None
        return replace(self.theory, shear=True) if table else self.theory

    def lay(self, mbs: exudyn.MainSystem, blade: Any, elements: int) -> Chain:
        """Add nodes and elements for `blade` to `mbs`."""
        raise NotImplementedError

    def add_nodes(
        self, mbs: exudyn.MainSystem, positions: FloatArray
    ) -> tuple[exudyn.NodeIndex, ...]:
        """Add the nodes of the straight beam at `positions` along the x axis."""
        node = getattr(items, self.node)
        return tuple(mbs.AddNode(node(referenceCoordinates=[x, *self.straight])) for x in positions)

    @property
    def dimensions(self) -> int:
        """Dimensions of the space in which it lives; as many coordinates come first, of r."""
        return 3 if self.leaves_plane else 2

    def held(self, root: FloatArray) -> FloatArray:
        """Return the directions (m, n) of the root's coordinates that the clamp holds at rest."""
        return np.eye(root.size)[list(self.clamped)]

    def clamp(self, root: FloatArray) -> Callable[[float], tuple[FloatArray, FloatArray]]:
        """Return the function of θ that gives C (m, n) and d (m,) of constraints C e = d.

        They turn the root by θ from its reference coordinates `root` (n,).
        """
        held = self.held(root)
        once = held @ self.quarter_turn.T
        twice = once @ self.quarter_turn.T
        start, ahead = held @ root, held @ self.angles

        def at(angle: float) -> tuple[FloatArray, FloatArray]:
            turn = self.pace * angle
            rows = held + np.sin(turn) * once + (1.0 - np.cos(turn)) * twice
            return rows, start + angle * ahead

        return at

    def coordinates(self, state: Any) -> tuple[FloatArray, FloatArray]:
        """Return coordinates and rates (nodes, n) of a blade in `state`, a BladeState.

        Its places are those of the nodes from the axis.
        """
        raise NotImplementedError

    def axial_strain(self, blade: Any, coordinates: FloatArray) -> FloatArray:
        """Axial strain [-] along the beam, (..., points), of coordinates (..., nodes, n)."""
        raise NotImplementedError

    def arms(self, blade: Any, elements: int) -> FloatArray:
        """Return the places of the nodes from the blade's line in axes of the section, (nodes, 3).

        One zero for all here, where nodes are on the line.
        """
        return np.zeros((1, 3))

    def line(self, arms: FloatArray, *state: FloatArray) -> FloatArray:
        """Return what nodes on the blade's line would have: coordinates or, of both, the rates.

        Arrays are (..., nodes, n).
        """
        return state[-1]

    def onto_nodes(
        self, arms: FloatArray, coordinates: FloatArray, forces: FloatArray
    ) -> FloatArray:
        """Return forces on the nodes, (..., nodes, n), of forces on the blade's line."""
        return forces

    def torques(self, coordinates: FloatArray, moments: FloatArray) -> FloatArray:
        """Return forces on what turns the nodes, behind r, of moments (..., nodes, 3) on them."""
        raise NotImplementedError

    def divergence_speed(self, blade: Any, elements: int) -> float:
        """Speed [rad/s] above which the model diverges; infinite where its strains are exact."""
        return math.inf

    def require_section(self, blade: Blade) -> None:
        """Refuse a blade whose line or section the element does not model."""
        require_blade(blade)
        table = blade.table
        remedy = "element='space_exact', on the command line --element space_exact"
        if blade.point_masses:
            remedy = "analytic.spin_up_response, or on the command line rotbeam reference"
        if table:
            raise ValueError(
                f"element {self.name!r} bends in one plane, and by a table of stations this blade "
                f"bends in flap and lag and twists: take {remedy}"
            )
        require_planar(blade, f"element {self.name!r} is for", remedy)

    def setting(self, blade: Blade) -> float:
        """Cosine of the angle between the plane in which J turns and that of rotation."""
        return blade.unit.setting

    def line_frame(self, blade: Blade) -> FloatArray:
        """Return the axes of the clamp in columns, (dimensions, dimensions), at the angle zero."""
        return np.eye(self.dimensions)

    def add_spin_forces(
        self, mbs: exudyn.MainSystem, chain: Chain, blade: Any, rotation: Rotation
    ) -> None:
        """Add the inertial forces of the rotating frame on coordinates without constant mass."""

    def root_moment(self, root: FloatArray, force: FloatArray) -> FloatArray:
        """Return the moment (samples, 3) about the root of a force on its coordinates.

        Both (samples, n). Here of nodes in the plane, about z.
        """
        turning = slice(self.dimensions, None)
        about_z = np.sum(self.spun(root)[:, turning] * force[:, turning], axis=1)
        return np.asarray(about_z[:, None] * [0.0, 0.0, 1.0])

    def sections(self, coordinates: FloatArray) -> FloatArray:
        """Return the axes of the sections in columns, (..., 3, 3), of coordinates (..., n).

        Here of nodes in the plane whose coordinates 2 and 3 are a vector of the section.
        """
        z, (_, *straight) = coordinates[..., 2] + 1j * coordinates[..., 3], self.straight
        return in_plane_of_bending(np.angle(z / complex(*straight)), 0.0)

    def spread(self, places: FloatArray, elements: int, s: FloatArray) -> FloatArray:
        """Return the matrix (places, n, nodes, n) to the coordinates a node would have at `s`.

        From those of nodes of elements at `places`; both are from the clamp. Lagrange's.
        """
        degree = (places.size - 1) // elements
        cell, xi = cells(places[::degree], s)
        weights = np.zeros((s.size, places.size))
        at = degree * cell[:, None] + np.arange(degree + 1)
        np.put_along_axis(weights, at, lagrange(xi, degree), axis=1)
        return np.asarray(np.einsum("sk,ij->sikj", weights, np.eye(self.angles.size)))

    @property
    def radial(self) -> FloatArray:
        """One for coordinates along the clamp's line, which J turns across it, else 0, (n,)."""
        return np.asarray((self.quarter_turn > 0.0).any(axis=0), dtype=np.float64)

    def spun(self, coordinates: FloatArray) -> FloatArray:
        """Return J e + a, the rates of a rotation at 1 rad/s, of coordinates (..., nodes, n)."""
        return self.pace * (coordinates @ self.quarter_turn.T) + self.angles

    def turned(self, vectors: FloatArray, angle: FloatArray) -> FloatArray:
        """Return exp(θJ) v = v + sin θ J v + (1 - cos θ) J² v of vectors (samples, nodes, n).

        `angle` is θ (samples,) [rad]; to coordinates that are angles θ a comes in addition.
        """
        once = vectors @ self.quarter_turn.T
        twice = once @ self.quarter_turn.T
        angle = self.pace * angle[:, None, None]
        return vectors + np.sin(angle) * once + (1.0 - np.cos(angle)) * twice

    def energy_and_momentum(
        self,
        blade: Any,
        mass: sparse.csr_array,
        turning: tuple[TurningNode, ...],
        coordinates: FloatArray,
        velocities: FloatArray,
        rate: FloatArray,
    ) -> tuple[FloatArray, FloatArray]:
        """Return the kinetic energy T and the angular momentum L_z = ∂T/∂w about the axis.

        Of coordinates (samples, nodes, n) in the frame of the clamp, of velocities by its axes that
        are absolute in the plane of bending, and of the speed w. With c = cos ψ and s = sin ψ,
        these contain a rotation by c w. Normal to the plane a point moves by s w times its distance
        x along the clamp's line.
        """
        samples, setting = rate.size, self.setting(blade)
        v = velocities.reshape(samples, -1)
        along = (coordinates * self.radial).reshape(samples, -1)
        momentum = v @ mass
        about_normal = np.sum(self.spun(coordinates).reshape(samples, -1) * momentum, axis=1)
        twice = np.sum(v * momentum, axis=1)
        for inertia, spin in spins(turning, coordinates, velocities):
            about_normal += inertia * spin
            twice += inertia * spin**2
        normal = (1.0 - setting**2) * rate * np.sum(along * (along @ mass), axis=1)
        return 0.5 * (twice + rate * normal), setting * about_normal + normal


def rate_of(
    strain: Callable[[Any], Any], coordinates: FloatArray, velocities: FloatArray
) -> FloatArray:
    """Return the rate of an analytic function of coordinates, to round-off: an imaginary step."""
    return np.asarray(strain(coordinates + 1e-30j * velocities).imag / 1e-30)


class Sheared:
    """An element with the options ν and k_s, G = E/(2 (1 + ν))."""

    poisson_ratio: float
    shear_correction: float

    def __post_init__(self) -> None:
        if not -1.0 < finite_number("poisson_ratio", self.poisson_ratio) < 0.5:
            raise ValueError(
                f"poisson_ratio must lie between -1 and 0.5, got {self.poisson_ratio!r}"
            )
        positive("shear_correction", self.shear_correction)

    @property
    def shear_share(self) -> float:
        """k_s G A over EA."""
        return self.shear_correction / (2.0 * (1.0 + self.poisson_ratio))
