"""Loads on a chain and its external damping, in either frame, and the power they bring.

As in `analytic.exact.driven.transient` a load is a complex force in the frame of the clamp, with
its real part along the blade, and one along the axis of rotation. It acts per mass, per length, or
on the tip. A ripple of the speed is no force but part of the clamp's rotation. External damping is
-d ṙ per length with the velocity relative to the clamp,

    f = -D (e' - θ' (J e + a)),      D = d ∫SᵀS dx,

where e' of the rotating frame is relative already; D is a mass matrix of constant density, without
point masses.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from analytic import Blade
from analytic.arrays import FloatArray
from analytic.lazily import sparse
from analytic.loads import Load
from analytic.motion import Rotation

from ..runs import Frame
from .elements.energy_body import add_force, triplets
from .elements.formulation import Chain, Formulation
from .lazily import exudyn
from .solver import mass_matrix


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
        forces = [(load, load.acts_on) for load in loads if load.acts_on is not None]
        external = blade.damping.external
        size, per_node = mass.shape[0], model.angles.size
        of_length = sparse.csr_array(mass.shape)
        if external or any(onto == "length" for _, onto in forces):
            section = replace(blade.section, mass_per_length=1.0, rotary_inertia=0.0)
            light = replace(blade.with_section(section), point_masses=())
            of_length = mass_matrix(model, light, elements)
        at_tip = sparse.diags_array(np.repeat([0.0, 1.0], [size - per_node, per_node]))
        acted_on = {"mass": mass, "length": of_length, "tip": at_tip}
        # Unit translations along and across the blade, and up.
        shifts = np.tile(np.eye(model.dimensions, per_node), size // per_node)
        self._pushes = [(load, np.asarray(shifts @ acted_on[onto])) for load, onto in forces]
        self._drag, self._model, self._setting = external * of_length, model, model.setting(blade)

    def __bool__(self) -> bool:
        return bool(self._pushes) or self._drag.nnz > 0

    def forces(self, t: FloatArray, angle: FloatArray, setting: float | None = None) -> FloatArray:
        """Return the nodal forces of all loads in the frame of the clamp, (samples, n).

        As they would be if the blade were set otherwise, where a `setting` is given.
        """
        total = np.zeros((t.size, self._drag.shape[0]))
        setting = self._setting if setting is None else setting
        for load, onto in self._pushes:
            phase = (load.frequency or 0.0) * t
            force = load.force(phase, angle, setting)
            parts = np.stack([force.real, force.imag, load.lift(phase)], axis=1)
            total += parts[:, : len(onto)] @ onto
        return total

    def power(self, t: FloatArray, angle: FloatArray, velocities: FloatArray) -> FloatArray:
        """Return the power (samples,) that loads bring and external damping takes.

        Velocities (samples, nodes, n) are relative to the frame of the clamp, by its axes.
        """
        v = velocities.reshape(t.size, -1)
        return np.asarray(np.sum((self.forces(t, angle) - v @ self._drag) * v, axis=1))

    def add(self, mbs: exudyn.MainSystem, chain: Chain, rotation: Rotation, frame: Frame) -> None:
        """Put loads and external damping on the chain, whose clamp follows `rotation`."""
        inertial = frame == "inertial"
        turn = sparse.kron(sparse.eye_array(len(chain.nodes)), self._model.quarter_turn)
        turning = (self._drag @ turn).tocsr()
        drag_triplets, turning_triplets = triplets(self._drag), triplets(turning)

        @lru_cache(maxsize=1)
        def acting(t: float) -> FloatArray:
            angle = np.array([rotation.angle(t)])
            forces = self.forces(np.array([t]), angle)
            if not inertial:
                return forces.ravel()
            return self._model.turned(forces.reshape(1, len(chain.nodes), -1), angle).ravel()

        def frame_rate(t: float) -> float:
            """Return the rate at which velocities of the clamp's frame turn in the coordinates."""
            return rotation.rate(t) if inertial else 0.0

        def force(t: float, e: FloatArray, rates: FloatArray) -> FloatArray:
            return np.asarray(acting(t) + frame_rate(t) * (turning @ e) - self._drag @ rates)

        def derivatives(t: float, e: FloatArray) -> list[tuple[FloatArray, float, float]]:
            return [(drag_triplets, 0.0, -1.0), (turning_triplets, frame_rate(t), 0.0)]

        add_force(mbs, chain.nodes, force=force, derivatives=derivatives)
