"""Loads on a chain and its external damping, in either frame, and the power they bring.

As in `analytic.exact.driven.transient` a load is a complex force in the frame of the clamp, with
its real part along the blade, and one along the axis of rotation. It acts per mass, per length, or
on the tip. Forces and moments on the span go to the nodes by functions that are linear in each
element. A ripple of the speed is no force but part of the clamp's rotation. External damping is
-d ṙ per length with the velocity relative to the clamp,

    f = -D (e' - θ' (J e + a)),      D = d ∫SᵀS dx,

where e' of the rotating frame is relative already; D is a mass matrix of constant density, without
point masses.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from typing import TypeGuard

import numpy as np

from analytic import Blade
from analytic.arrays import FloatArray
from analytic.lazily import sparse, spatial
from analytic.loads import Load
from analytic.motion import Rotation
from analytic.span_loads import SpanLoad

from ..runs import Frame
from .elements.energy_body import add_force, triplets
from .elements.formulation import Chain, Formulation
from .lazily import exudyn
from .mesh import Mesh, cells
from .solver import mass_matrix

_STEP = 1e-6
"""Step of central differences of Euler parameters, which are of the size of one."""


def is_on_span(load: Load) -> TypeGuard[SpanLoad]:
    """Return whether a load is a force and a moment on the span."""
    return load.acts_on == "span"


def turned_wrench(wrench: FloatArray, turn: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return force and moment (..., 3) of a wrench (..., 6), turned by rotations (..., 3, 3)."""
    force, moment = ((turn @ part[..., None])[..., 0] for part in np.split(wrench, 2, axis=-1))
    return force, moment


class _OnSpan:
    """A load on the span, on the nodes of a mesh."""

    def __init__(self, model: Formulation, blade: Blade, elements: int, load: SpanLoad) -> None:
        mesh = Mesh(blade=blade, elements=elements)
        self._model, self._load, self._frame = model, load, model.line_frame(blade)
        self._x, weights = load.points(mesh.places)
        cell, xi = cells(mesh.places, self._x)
        self._onto = np.zeros((mesh.places.size, self._x.size))
        for node, share in ((cell, 1.0 - xi), (cell + 1, xi)):
            np.add.at(self._onto, (node, np.arange(self._x.size)), share * weights)

    def forces(
        self, t: FloatArray, coordinates: FloatArray, arms: FloatArray, angle: FloatArray
    ) -> FloatArray:
        """Return nodal forces (samples, nodes, n)."""
        at_points = self._load.wrench(self._load.phase_at(t), self._x)
        wrench = np.einsum("np,spk->snk", self._onto, at_points)
        turn = self._model.sections(coordinates)
        if not self._load.following:
            axis = np.multiply.outer(angle, [0.0, 0.0, 1.0])
            about = spatial.transform.Rotation.from_rotvec(axis).as_matrix()
            turn = (about @ self._frame)[:, None]
        on_line = np.zeros(coordinates.shape)
        on_line[..., :3], moments = turned_wrench(wrench, turn)
        on_nodes = self._model.onto_nodes(arms, coordinates, on_line)
        on_nodes[..., 3:] += self._model.torques(coordinates, moments)
        return on_nodes


class Loading:
    """Consistent loads and external damping: all that acts on a chain besides its inertia.

    The mass matrix includes point masses; loads are in the units of the beam.
    """

    def __init__(
        self,
        model: Formulation,
        blade: Blade,
        elements: int,
        mass: sparse.csr_array,
        loads: Sequence[Load],
    ) -> None:
        forces = [(load, load.acts_on) for load in loads if load.acts_on not in (None, "span")]
        self._spans = [_OnSpan(model, blade, elements, one) for one in loads if is_on_span(one)]
        external = blade.damping.external
        size, per_node = mass.shape[0], model.angles.size
        of_length = sparse.csr_array(mass.shape)
        if external or any(onto == "length" for _, onto in forces):
            section = blade.section.of_unit_mass()
            # Without mass, point masses keep their nodes.
            weightless = [replace(one, mass=0.0, inertia=0.0) for one in blade.point_masses]
            light = replace(blade.with_section(section), point_masses=tuple(weightless))
            of_length = mass_matrix(model, light, elements)
        at_tip = sparse.diags_array(np.repeat([0.0, 1.0], [size - per_node, per_node]))
        acted_on = {"mass": mass, "length": of_length, "tip": at_tip}
        # Unit translations along and across the blade, and up.
        shifts = np.tile(np.eye(model.dimensions, per_node), size // per_node)
        self._pushes = [
            (load, onto == "mass", np.asarray(shifts @ acted_on[onto])) for load, onto in forces
        ]
        self._drag, self._model, self._setting = external * of_length, model, model.setting(blade)
        self._arms = model.arms(blade, elements)

    def __bool__(self) -> bool:
        return bool(self._pushes or self._spans) or self._drag.nnz > 0

    def _pushed(
        self, t: FloatArray, angle: FloatArray, setting: float
    ) -> tuple[FloatArray, FloatArray]:
        """Return the loads on the mass and on the line, in the frame of the clamp, (samples, n)."""
        on_mass, on_line = np.zeros((2, t.size, self._drag.shape[0]))
        for load, of_mass, onto in self._pushes:
            phase = (load.frequency or 0.0) * t
            force = load.force(phase, angle, setting)
            parts = np.stack([force.real, force.imag, load.lift(phase)], axis=1)
            total = on_mass if of_mass else on_line
            total += parts[:, : len(onto)] @ onto
        return on_mass, on_line

    def _onto_nodes(self, coordinates: FloatArray, on_line: FloatArray) -> FloatArray:
        forces = self._model.onto_nodes(self._arms, coordinates, on_line.reshape(coordinates.shape))
        return forces.reshape(on_line.shape)

    def forces(
        self, t: FloatArray, angle: FloatArray, coordinates: FloatArray,
        setting: float | None = None,
    ) -> FloatArray:  # fmt: skip
        """Return the nodal forces of all loads in the frame of the clamp, (samples, n).

        Of coordinates (samples, nodes, n) there. As they would be if the blade were set otherwise,
        where a `setting` is given.
        """
        setting = self._setting if setting is None else setting
        on_mass, on_line = self._pushed(t, angle, setting)
        return on_mass + self._onto_nodes(coordinates, on_line) + self._on_span(t, coordinates)

    def _on_span(
        self, t: FloatArray, coordinates: FloatArray, angle: FloatArray | float = 0.0
    ) -> FloatArray:
        """Return nodal forces (samples, n) of loads on the span, on axes ahead by an angle."""
        result = np.zeros(coordinates.shape)
        for one in self._spans:
            result += one.forces(t, coordinates, self._arms, np.broadcast_to(angle, t.shape))
        return result.reshape(t.size, -1)

    def slopes(self, t: float, coordinates: FloatArray, angle: float = 0.0) -> FloatArray:
        """Return derivatives of the forces of loads on the span to coordinates (nodes, n).

        As triplets, by central differences: a force changes with its own node's turn alone.
        """
        nodes, n = coordinates.shape
        turns = n - self._model.dimensions
        steps = _STEP * np.eye(n)[-turns:, None]
        ahead, behind = (
            self._on_span(np.full(turns, t), coordinates + sign * steps, angle)
            for sign in (1.0, -1.0)
        )
        values = ((ahead - behind) / (2.0 * _STEP)).reshape(turns, nodes, n)
        column, node, row = np.indices(values.shape)
        places = node * n + row, node * n + self._model.dimensions + column
        return np.column_stack([one.ravel() for one in (*places, values)])

    def power(
        self, t: FloatArray, angle: FloatArray, coordinates: FloatArray, velocities: FloatArray
    ) -> FloatArray:
        """Return the power (samples,) that loads bring and external damping takes.

        Coordinates and velocities (samples, nodes, n) are relative to the frame of the clamp, by
        its axes.
        """
        v = velocities.reshape(t.size, -1)
        at_line = self._model.line(self._arms, coordinates, velocities).reshape(t.size, -1)
        on_mass, on_line = self._pushed(t, angle, self._setting)
        power = (on_mass + self._on_span(t, coordinates)) * v
        power += (on_line - at_line @ self._drag) * at_line
        return np.asarray(np.sum(power, axis=1))

    def add(self, mbs: exudyn.MainSystem, chain: Chain, rotation: Rotation, frame: Frame) -> None:
        """Put loads and external damping on the chain, whose clamp follows `rotation`."""
        inertial = frame == "inertial"
        turn = sparse.kron(sparse.eye_array(len(chain.nodes)), self._model.quarter_turn)
        turning = (self._drag @ turn).tocsr()
        drag_triplets, turning_triplets = triplets(self._drag), triplets(turning)

        @lru_cache(maxsize=1)
        def acting(t: float) -> tuple[FloatArray, FloatArray]:
            angle = np.array([rotation.angle(t)])
            on_mass, on_line = self._pushed(np.array([t]), angle, self._setting)
            if not inertial:
                return on_mass.ravel(), on_line.ravel()
            turned = [
                self._model.turned(one.reshape(1, len(chain.nodes), -1), angle).ravel()
                for one in (on_mass, on_line)
            ]
            return turned[0], turned[1]

        def frame_rate(t: float) -> float:
            """Return the rate at which velocities of the clamp's frame turn in the coordinates."""
            return rotation.rate(t) if inertial else 0.0

        def force(t: float, e: FloatArray, rates: FloatArray) -> FloatArray:
            at, moving = (one.reshape(len(chain.nodes), -1) for one in (e, rates))
            line = self._model.line(self._arms, at).ravel()
            line_rates = self._model.line(self._arms, at, moving).ravel()
            on_mass, on_line = acting(t)
            on_line = on_line + frame_rate(t) * (turning @ line) - self._drag @ line_rates
            on_nodes = on_mass + self._onto_nodes(at, on_line)
            if self._spans:
                ahead = rotation.angle(t) if inertial else 0.0
                on_nodes = on_nodes + self._on_span(np.array([t]), at[None], ahead)[0]
            return on_nodes

        def derivatives(t: float, e: FloatArray) -> list[tuple[FloatArray, float, float]]:
            parts = [(drag_triplets, 0.0, -1.0), (turning_triplets, frame_rate(t), 0.0)]
            if self._spans:
                ahead = rotation.angle(t) if inertial else 0.0
                parts.append((self.slopes(t, e.reshape(len(chain.nodes), -1), ahead), 1.0, 0.0))
            return parts

        add_force(mbs, chain.nodes, force=force, derivatives=derivatives)
