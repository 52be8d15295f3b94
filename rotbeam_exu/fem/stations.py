"""Stations of a run: where its sections are, how they stand, and the loads in them.

Loads follow from d'Alembert's principle, as those of the exact blade: from all loads f outboard and
the mesh's own accelerations A. With the section's axes d and its second moments of mass G,

    F = ∫ (f - m A) dx,      M = ∫ [r × (f - m A) - Σ G_kl d_k × d̈_l] dx - r_s × F.
"""

from __future__ import annotations

import math

import numpy as np

from analytic.arrays import FloatArray, few_at_once
from analytic.exact.beam.kinematics import set_at
from analytic.exact.beam.state import SectionLoads
from analytic.exact.space.unit import space_unit
from analytic.lazily import sparse
from analytic.quadrature import gauss_points
from analytic.theory import Theory

from .case import RunCase
from .mesh import Mesh
from .rotating_beam import RotatingBeam
from .units import Units

_POINTS = 4  # between two ends, by which a cable's mass matrix is exact
_INSTANT = 1e-4  # of √(mL³/EI), for the differences that tell how sections turn


def section_loads(
    case: RunCase, units: Units, built: RotatingBeam, stations: FloatArray, time: FloatArray,
    *states: FloatArray,
) -> SectionLoads:  # fmt: skip
    """Return the sections of a run at `stations` over L and times [s], and the loads in them [SI].

    `states` (samples, nodes, n) are coordinates, rates relative to the clamp and absolute ones, by
    the axes of the clamp; and accelerations of the case's frame by its axes.
    """
    masses, model, beam = _Masses(case, units, built, stations), case.model, case.beam
    parts = [
        masses.loads(time[one], *(state[one] for state in states)) for one in few_at_once(time.size)
    ]
    place, section, force, moment = map(np.concatenate, zip(*parts, strict=True))
    # A blade in its plane is set as a whole, one in space along its sections.
    to_clamp = model.line_frame(built.beam).T if model.twists else set_at(beam.setting_angle)
    place[..., 0] -= built.beam.hub_radius
    if not model.leaves_plane:
        force, moment = force[..., :2], moment[..., 2]
    return SectionLoads(
        blade=beam,
        stations=beam.length * stations,
        place=units.length * place @ to_clamp.T,
        section=to_clamp @ section,
        force=units.energy / units.length * force,
        moment=units.energy * moment,
    )


class _Masses:
    """Points of a blade by which its inertia and its loads are added up, then its stations."""

    def __init__(
        self, case: RunCase, units: Units, built: RotatingBeam, stations: FloatArray
    ) -> None:
        beam, model, count = built.beam, case.model, len(built.nodes)
        self._case, self._units, self._model, self._beam = case, units, model, beam
        ends = np.union1d(np.linspace(0.0, 1.0, count), stations)
        inner, weights = gauss_points(_POINTS)
        dx = np.outer(np.diff(ends), weights).ravel()
        x = (ends[:-1, None] + np.outer(np.diff(ends), inner)).ravel()
        at, none = Mesh(blade=beam, elements=1).along(x), np.zeros(1)
        # Behind the points of the blade come those of its point masses, and the tip.
        bodies = [(one.position, one.mass, one.inertia) for one in beam.point_masses]
        places, masses, inertias = np.array(bodies).reshape(-1, 3).T
        self._x = np.concatenate((x, places / beam.length, none + 1.0))
        self._weights = {
            "mass": np.concatenate((at.mass_per_length * dx, masses, none)),
            "length": np.concatenate((dx, 0.0 * masses, none)),
            "tip": np.concatenate((0.0 * dx, 0.0 * masses, none + 1.0)),
        }
        # Inertia of what turns in its plane is that of a mass along the second axis.
        self._second = np.zeros((self._x.size, 3, 3))
        self._second[x.size : -1, 1, 1] = inertias
        if model.twists:
            _, own = space_unit(beam).inertia_about(
                x, Theory(rotary_inertia=True), beam.slenderness
            )
            second = 0.5 * np.trace(own) * np.eye(3)[..., None] - own
            unit = beam.mass_per_length * beam.length**2
            self._second[: x.size] = np.moveaxis(unit * second * dx, -1, 0)
        elif model.theory.rotary_inertia:
            self._second[: x.size, 1, 1] = at.rotary_inertia * dx
        self._outboard = ((self._x > stations[:, None]) | (self._x == 1.0)).astype(float)
        spread = model.spread(count, case.elements, beam.length, np.append(self._x, stations))
        self._spread = sparse.csr_array(spread.reshape(-1, spread.shape[2] * spread.shape[3]))

    def loads(self, time: FloatArray, *states: FloatArray) -> tuple[FloatArray, ...]:
        """Return places, sections, forces and moments of the stations, of states as above."""
        case, model, count, per_unit = self._case, self._model, self._x.size, self._units.time
        e, relative, rates, change = (self._along(state) for state in states)
        angle, turning = case.rotation.angle(time), np.zeros(3)
        if case.frame == "inertial":
            change = model.turned(change, -angle)
        else:
            setting = 0.0 if model.twists else self._beam.setting_angle
            rates, turning = relative, np.array([0.0, math.sin(setting), math.cos(setting)])
        W = np.multiply.outer(per_unit * case.rotation.rate(time), turning)[:, None]
        W_dot = np.multiply.outer(per_unit**2 * case.rotation.acceleration(time), turning)[:, None]
        r, v, v_frame, a = (self._vectors(one) for one in (e, relative, rates, change))
        a = a + np.cross(W, 2.0 * v_frame + np.cross(W, r)) + np.cross(W_dot, r)
        f = -self._weights["mass"][:, None] * a[:, :count]
        f -= self._beam.damping.external * self._weights["length"][:, None] * v[:, :count]
        for load in self._units.loads(case.loads):
            if load.acts_on is not None:
                phase = (load.frequency or 0.0) * time / per_unit
                push = load.force(phase, angle, model.setting(self._beam))[:, None]
                f[..., 0] += self._weights[load.acts_on] * push.real
                f[..., 1] += self._weights[load.acts_on] * push.imag
                f[..., 2] += self._weights[load.acts_on] * load.lift(phase)[:, None]
        couple, section = np.cross(r[:, :count], f), model.sections(e)
        if self._second.any():
            ahead, d, behind = (
                np.swapaxes(model.sections(e + h * rates + 0.5 * h**2 * change)[:, :count], -1, -2)
                for h in (_INSTANT, 0.0, -_INSTANT)
            )
            # In its plane only Euler's acceleration turns a section; a set ancf3 has ρI s²w² more.
            d_ddot = (ahead - 2.0 * d + behind) / _INSTANT**2 + np.cross(W_dot[:, None], d)
            couple -= np.cross(d, self._second @ d_ddot).sum(axis=-2)
        place, section = r[:, count:], section[:, count:]
        force = self._outboard @ f
        moment = self._outboard @ couple - np.cross(place, force)
        force, moment = ((one[..., None, :] @ section)[..., 0, :] for one in (force, moment))
        return place, section, force, moment

    def _along(self, state: FloatArray) -> FloatArray:
        """Return coordinates or rates at all points and stations, (samples, places, n)."""
        flat = np.asarray((self._spread @ state.reshape(len(state), -1).T).T)
        return flat.reshape(len(state), -1, state.shape[-1])

    def _vectors(self, e: FloatArray) -> FloatArray:
        """Return the vectors (..., 3) that come first in coordinates or rates."""
        result = np.zeros((*e.shape[:-1], 3))
        result[..., : self._model.dimensions] = e[..., : self._model.dimensions]
        return result
