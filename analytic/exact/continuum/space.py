"""The exact blade in space: geometrically exact, in flap, lag and torsion, twisted and coned.

Unit length, EI3 = 1 and m = 1 at the root, time τ = t √(EI3/mL⁴). The root frame b turns with the
clamp at w (sin β, 0, cos β): b1 along the blade, b2 in the direction of rotation (lag), b3 up
(flap), β the precone. R(x) carries b to a frame that bends and twists with the blade but has no
twist of its own; the section is turned in it by χ(x), setting and twist, about the axis. With the
material strains Γ and K in that frame

    r' = R Γ,      R' = R K̂,      Γ = (1 + ε, γ2, γ3) - ½k² e1 (κ1² - κ01²) + offsets,

and coordinates q of ε, γ, K that are orthonormal in the section's stiffness, the elastic energy is
½ q·q. k² = (EI2 + EI3)/EA is the trapeze effect: the mean fiber keeps its length, so that twist
shortens the axis. With the spin ω' = R K̇ relative to b, d'Alembert's principle reads

    q_k + ∫ (A_c · δr_c + [J α + Ω × J Ω] · δφ) dm = 0,    δφ' = R δK,   δr' = δφ × r' + R δΓ,

A_c, Ω = ω + W and α being those in space, W the clamp's spin. So turn slices that have rotary
inertia. Without it their kinetic energy is ½ J11 ω1² + ½ W·J W: J11 resists the relative spin ω1
about the axis, and W × J W is the propeller moment, if the theory has it. All integrals from the
clamp are one matrix, all beyond a point its transpose with the weights: so mass and stiffness are
symmetric, and the Jacobi integral is kept. The plane is the subset κ3, ε, γ2. Strains as
coordinates: Su and Cesnik (2011).
"""

from __future__ import annotations

import math
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from ...arrays import ComplexArray, FloatArray
from ...blade import Blade
from ...methods.system import Tangent
from ...theory import Theory
from .changes import Changes, Rates, State
from .space_kinematics import SpaceKinematics
from .span import Span
from .state import Driven, flap_of_kick
from .vectors import cross, turned, turned_back

_IN_CACHE = 30_000
"""Numbers per component of a field of derivatives that are computed at once: a megabyte."""


class SpaceContinuum(SpaceKinematics):
    """Galerkin discretization of the exact blade in polynomials of its moments and forces.

    Samples in time come first in the coordinates (samples, n); residual and tangent are as those
    of `Continuum`, of which it has the coordinates.
    """

    gauges: ClassVar[tuple[str, ...]] = ("lag", "flap")
    softening_orbits: ClassVar[int] = 3  # λ_ω changes fast near a pole, as where lag meets 2 flap
    most_functions: ClassVar[int] = 80  # for each curvature
    twists: ClassVar[bool] = True
    stiff: ClassVar[bool] = True
    has_dear_tangent: ClassVar[bool] = True
    """Whether one costs many residuals, so that it serves in the steps of time after it."""

    def inertia(self, at: State, vector: FloatArray, *, carried: bool = False) -> FloatArray:
        """Return R A Rᵀ times vectors (3, ..., masses), or R C Rᵀ of what the clamp carries."""
        of = self.masses.carried if carried else self.masses.inertia
        return turned(at.frame_m, turned(of, turned_back(at.frame_m, vector)))

    def _forces(
        self, at: State, motion: Rates, by: Driven
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return m a at the masses, and F and M on the grid, with weights."""
        push, follow = by.push, self._following(at, by)
        body = 0.0 if push is None else push[1][..., :1]
        pulled = self.masses.mass * (motion.acceleration - body)
        if not self.masses.turns:
            rotary = np.zeros_like(pulled)
        else:
            W = self.clamp(by)[0]
            rotary = (
                self.inertia(at, motion.turn_rate)
                + cross(motion.turn, self.inertia(at, motion.turn))
                + cross(W, self.inertia(at, W, carried=True))
            )
        held = pulled
        if self.masses.drag is not None:
            held = pulled + self.masses.drag * motion.velocity_m
        force = -self.integrals.beyond(held)
        if push is not None:
            force += push[0]
        for span, acting in follow:
            force += span.beyond(acting[:, 0])
        twist = rotary + cross(at.offset_m, pulled)
        self.at_points(twist)[:] -= cross(at.slope, force)
        moment = -self.integrals.beyond(twist)
        if push is not None:
            moment += push[2]
        for span, acting in follow:
            moment += span.beyond(acting[:, 1])
        return pulled, force, moment

    def _following(self, at: State, by: Driven) -> list[tuple[Span, FloatArray]]:
        """Return force and moment of loads that follow, (3, 2, samples, places), in b."""
        return [(span, turned(span.sections(at.K)[:, :, None], part)) for span, part in by.follow]

    def residual(
        self, q: FloatArray, q_dot: FloatArray, q_ddot: FloatArray, by: Driven
    ) -> FloatArray:
        """Return the virtual work (samples, n) of all forces on the basis functions.

        A push (3, 3, samples, points) is the load beyond each Gauss point, times its weight, the
        acceleration that another one gives to all masses, and the couple beyond each point.
        What follows the sections is apart from it.
        """
        at = self._state(q)
        motion = self._motion(at, q_dot, q_ddot, by)
        _, force, moment = self._forces(at, motion, by)
        return self._work(at, q, q_dot, force, moment)

    def section_loads(
        self, x: FloatArray, q: FloatArray, q_dot: FloatArray, q_ddot: FloatArray, by: Driven
    ) -> tuple[FloatArray, FloatArray]:
        """Return force and moment at `x` in the section's axes, each (samples, places, 3).

        By d'Alembert, of all inertia and all loads beyond.
        """
        at = self._state(q)
        motion = self._motion(at, q_dot, q_ddot, by)
        onto = self.functions.grid.interpolation(x).T / self.weights[:, None]
        sections = self.blade.section_frames(x)[:, :, None]
        force, moment = (
            np.moveaxis(turned_back(sections, turned_back(at.frame, one) @ onto), 0, -1)
            for one in self._forces(at, motion, by)[1:]
        )
        return force, moment

    def forces_caused(
        self, q: FloatArray, q_dot: FloatArray, q_ddot: FloatArray, by: Driven
    ) -> FloatArray:
        """Return the forces on the strains of a table a motion causes, (points, 6, samples)."""
        inner = self.on_strains(q, q_dot, q_ddot, by) / self.weights
        return self.functions.elastic(self.points, np.moveaxis(inner, 2, 0))

    def on_strains(
        self, q: FloatArray, q_dot: FloatArray, q_ddot: FloatArray, by: Driven
    ) -> FloatArray:
        """Return forces on the strains that a motion causes, (6, samples, points), with weights."""
        at = self._state(q)
        motion = self._motion(at, q_dot, q_ddot, by)
        return np.concatenate(self._on_strains(at, *self._forces(at, motion, by)[1:]))

    def shortening(self, q: FloatArray) -> FloatArray:
        """Return by how much twist shortens the axis over k² of the trapeze effect."""
        twist = self._strains(q)[1][0]
        return np.asarray(0.5 * twist * (twist + 2.0 * self.strains.twist))

    def _on_strains(
        self, at: State, force: FloatArray, moment: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return force and moment in the frame without twist, and twist's share of the force."""
        inner_force, inner_moment = turned_back(at.frame, force), turned_back(at.frame, moment)
        twist = at.K[0] + self.strains.twist
        inner_moment[0] -= self.strains.trapeze * twist * inner_force[0]
        return inner_force, inner_moment

    def _work(
        self, at: State, q: FloatArray, q_dot: FloatArray, force: FloatArray, moment: FloatArray
    ) -> FloatArray:
        strains = self.strains
        inner_force, inner_moment = self._on_strains(at, force, moment)
        work = np.sum(inner_moment @ strains.K + inner_force @ strains.gamma, axis=0)
        held = q @ self.functions.stiffness + q_dot @ self.functions.damping
        return np.asarray(held - work)

    def tangent(self, q: FloatArray, q_dot: FloatArray, q_ddot: FloatArray, by: Driven) -> Tangent:
        """Return the residual and its derivatives to q, q̇ and q̈ for (samples, n) coordinates."""
        at = self._state(q)
        motion = self._motion(at, q_dot, q_ddot, by)
        forces, following = self._forces(at, motion, by), self._following(at, by)
        clamp = [np.broadcast_to(of, (3, len(q), 1)) for of in self.clamp(by)[:2]]
        matrices = np.empty((3, *q.shape, q.shape[1]))
        few = max(1, _IN_CACHE // (q.shape[1] * self.points.size))
        for first in range(0, len(q), few):
            # Fields have the samples before the last axis.
            some = (..., slice(first, first + few), slice(None))
            here, moving = State(*(of[some] for of in at)), Rates(*(of[some] for of in motion))
            change = Changes(self, here, moving, *(of[some] for of in clamp))
            mass, damping, stiffness = change.matrices()
            stiffness += change.geometric(*(of[some] for of in forces))
            for span, acting in following:
                stiffness -= change.following(span.running.of, acting[some])
            matrices[:, first : first + few] = mass, damping, stiffness
        mass, damping, stiffness = matrices
        stiffness += self.functions.stiffness
        damping += self.functions.damping
        return Tangent(self._work(at, q, q_dot, *forces[1:]), stiffness, damping, mass)

    @property
    def bending(self) -> int:
        """Number of functions for each curvature."""
        return self.functions.reach[0] * self.blade.panel_count

    def needed(self, q: FloatArray, within: float) -> int:
        """Return the functions for each curvature that states (samples, n) need.

        By their last degrees the coordinates are to fall below the share `within` of the largest,
        as they do from half of the degrees on.
        """
        bending, torsion = self.families[:2]
        degrees = self.functions.bending
        parts = np.split(np.abs(q).max(axis=0), (bending, bending + torsion))[: 1 + bool(torsion)]
        sizes = np.max([part.reshape(degrees, -1).max(axis=1) for part in parts], axis=0)
        sizes = np.maximum.accumulate(sizes[::-1])[::-1]
        least, last = within * sizes[0], sizes[-2]
        if last <= least:
            return self.bending
        fall = np.log(sizes[degrees // 2 - 1] / last) / (degrees - 1 - degrees // 2)
        more = min(np.ceil(np.log(last / least) / fall) if fall else np.inf, degrees)
        return int((degrees + more) * self.functions.blade.panel_count)

    @property
    def trapeze(self) -> bool | Literal["elastic"]:
        """Whether twist shortens the axis, as the theory has it."""
        return self.functions.theory.trapeze

    def tip_gradient(self, q: FloatArray) -> FloatArray:
        """Return the derivatives of the tip's place to the coordinates, (samples, 3, n)."""
        return np.moveaxis(self.changes(q).slope @ self.weights, 0, 1)

    @property
    def setting(self) -> float:
        """1: loads in the plane of rotation act in it, however the blade is set."""
        return 1.0

    @property
    def tolerance(self) -> float:
        """Relative change of the frequencies from one basis to the next."""
        return self.blade.tolerance

    @property
    def tail(self) -> float:
        """As of `Care`."""
        return self.blade.tail

    @property
    def extends(self) -> bool:
        """Whether tension stretches the axis."""
        return self.functions.theory.extension

    @property
    def uncoupled(self) -> bool:
        """Whether flap and torsion go without lag."""
        return self.functions.uncoupled

    @property
    def resolved(self) -> int:
        """Number of modes that the functions resolve: half of those for each curvature."""
        return self.bending

    @property
    def blocks(self) -> list[NDArray[np.bool_]]:
        """Coordinates of lag and axial motion, which the plane's mirror keeps, and the others."""
        across = self.functions.odd_by(mirror=False) ^ self.functions.odd_by(mirror=True)
        return [~across, across]

    def beyond(self, blade: Blade, theory: Theory) -> str | None:
        """Return None: no motion is beyond its own, as that out of a plane is."""
        del blade, theory
        return None

    def skews(self, rate: float) -> bool:
        """Whether Coriolis forces or its shape give a swing even harmonics."""
        return abs(rate) > 1e-9 or not self.blade.half_turn

    def family(self, gauge: str) -> str:
        """Return the family of modes that move the tip along the gauge."""
        return gauge

    def reversal(self, component: int, mirror: bool) -> NDArray[np.bool_] | None:
        """Return coordinates that time reversal turns around, (n,); None without a reversal.

        Nor where the gauge is not among them: of blades with precone the lag is, flap is not.
        """
        if component == 2 and not self.blade.half_turn:
            return None
        return self.functions.odd_by(mirror=True) if mirror else self.functions.odd

    def push(self, force: ComplexArray, acts_on: str, lift: FloatArray | float = 0.0) -> FloatArray:
        """Return a force in the plane of rotation and along its axis, as `residual` takes it.

        Both (samples,). Along the hub's radius, in the direction of rotation and up, from where
        the precone tilts it into the root frame. What acts on mass pulls at its centers.
        """
        cone = self.blade.line.precone
        c, s = math.cos(cone), math.sin(cone)
        parts = (c * force.real + s * lift, force.imag, c * lift - s * force.real)
        result = np.zeros((3, 3, force.size, self.points.size))
        if acts_on == "mass":
            result[1] = np.stack(parts)[..., None]
        else:
            result[0] = np.multiply.outer(np.stack(parts), self.outboard[acts_on])
        return result

    def span(self, stations: tuple[float, ...]) -> Span:
        """Return where a load on the span acts."""
        if stations not in self._spans:
            self._spans[stations] = Span(self.functions.grid, stations, self.blade)
        return self._spans[stations]

    def push_on(self, span: Span, acting: FloatArray) -> FloatArray:
        """Return force and moment (3, 2, samples, places) of a dead load, as a push."""
        result = np.zeros((3, 3, acting.shape[2], self.points.size))
        result[0], result[2] = span.beyond(acting[:, 0]), span.beyond(acting[:, 1])
        return result

    def moved(
        self, q: FloatArray, shapes: ComplexArray, x: FloatArray
    ) -> tuple[ComplexArray, ComplexArray]:
        """Return how small changes (count, n) move and turn points, (3, points, count) each."""
        change, onto = self.changes(q[None]), self.functions.grid.integral(x)
        place, turn = (
            onto @ np.swapaxes(shapes @ field[:, 0], 1, 2) for field in (change.slope, change.bend)
        )
        return place, turn

    def shares(self, q: FloatArray, shapes: ComplexArray) -> FloatArray:
        """Return the shares of flap, lag, torsion and axial motion in their kinetic energy."""
        change, masses = self.changes(q[None]), self.masses
        moved = np.abs(shapes @ change.center[:, 0]) ** 2 @ masses.mass
        frame = self._state(q[None]).frame_m[:, :, 0]
        spin = np.einsum("ijp,ikp->jkp", frame, shapes @ change.turn_m[:, 0])  # in R's axes
        turning = np.einsum("ikp,ijp,jkp->k", spin.conj(), masses.inertia, spin).real
        twist = np.abs(spin[0]) ** 2 @ masses.inertia[0, 0]
        # Rotary inertia of bending goes with lag and flap.
        across = moved[1] + moved[2]
        more = 1.0 + (turning - twist) / np.where(across > 0.0, across, 1.0)
        parts = np.stack((more * moved[2], more * moved[1], twist, moved[0]), axis=-1)
        return np.asarray(parts / parts.sum(axis=1, keepdims=True))

    def struck(self, speed: float) -> FloatArray:
        """Return the rates (n,) of a straight blade that flaps as `kicked_state` has it."""
        bending = -speed * flap_of_kick(self.points, 2)
        rates: FloatArray = np.linalg.lstsq(self.strains.K[1], bending)[0]
        return rates

    def refined(
        self, caused: FloatArray | None = None, seen: float | None = None
    ) -> SpaceContinuum:
        """Return the discretization on more functions; of a table also of the forces `caused`."""
        return SpaceContinuum(self.functions.refined(caused, seen))

    @property
    def answers(self) -> bool:
        """Whether answers make functions, as of tables."""
        return self.blade.answers

    def kinetic_energy(self, q: FloatArray, q_dot: FloatArray) -> FloatArray:
        """Return the kinetic energy relative to the root frame, (samples,)."""
        at = self._state(q)
        none = np.zeros_like(q)
        motion = self._motion(at, q_dot, none, Driven(0.0))
        velocity = motion.velocity_m + cross(motion.spin_m, at.offset_m)
        return np.asarray(0.5 * self._energy(at, velocity, motion.spin_m))

    def amended_potential(self, q: FloatArray, rate: float) -> FloatArray:
        """Return V - T0, which with the kinetic energy is the Jacobi integral, (samples,)."""
        at = self._state(q)
        W, _, hub = self.clamp(Driven(rate))
        carried = cross(W, hub + at.place_m + at.offset_m)
        spin = np.broadcast_to(W, carried.shape)
        return np.asarray(
            0.5 * np.sum(q * (q @ self.functions.stiffness), axis=-1)
            - 0.5 * self._energy(at, carried, self.masses.whole * spin)
            - 0.5 * np.sum(spin * self.inertia(at, spin, carried=True), axis=(0, 2))
        )

    def _energy(self, at: State, velocity: FloatArray, spin: FloatArray) -> FloatArray:
        energy = np.sum(velocity**2, axis=0) @ self.masses.mass
        return np.asarray(energy + np.sum(spin * self.inertia(at, spin), axis=(0, 2)))

    def changes(self, q: FloatArray) -> Changes:
        """Return the derivatives about states `q` (samples, n) at rest."""
        at, still = self._state(q), np.zeros_like(q)
        motion = self._motion(at, still, still, Driven(0.0))
        return Changes(self, at, motion, *self.clamp(Driven(0.0))[:2])
