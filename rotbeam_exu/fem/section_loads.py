"""Loads in the sections of a run, by d'Alembert's principle, as those of the exact blade.

From all loads f outboard and the mesh's own accelerations A. With the section's axes d and its
second moments of mass G,

    F = ∫ (f - m A) dx,      M = ∫ [r × (f - m A) - Σ G_kl d_k × d̈_l] dx - r_s × F.
"""

from __future__ import annotations

import math

import numpy as np

from analytic import Blade
from analytic.arrays import FloatArray, few_at_once
from analytic.exact.continuum.planar_kinematics import set_at
from analytic.exact.continuum.state import SectionLoads
from analytic.exact.continuum.unit import space_unit
from analytic.lazily import sparse
from analytic.quadrature import gauss_points

from .case import RunCase
from .elements.formulation import Formulation
from .loading import is_on_span, turned_wrench
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
    masses, model, blade = _Masses(case, units, built, stations), case.model, case.blade
    parts = [
        masses.loads(time[one], *(state[one] for state in states)) for one in few_at_once(time.size)
    ]
    place, section, force, moment = map(np.concatenate, zip(*parts, strict=True))
    turn = to_clamp(model, blade)
    place[..., 0] -= built.blade.hub_radius
    if not model.leaves_plane:  # not computed: what holds the blade in its plane
        force[..., 2] = moment[..., :2] = 0.0
    return SectionLoads(
        blade=blade,
        stations=blade.length * stations,
        place=units.length * place @ turn.T,
        section=turn @ section,
        force=units.energy / units.length * force,
        moment=units.energy * moment,
    )


def to_clamp(model: Formulation, blade: Blade) -> FloatArray:
    """Return the rotation (3, 3) from the axes of the model to those of the clamp.

    A blade in its plane is set as a whole, one in space along its sections.
    """
    return model.line_frame(blade).T if model.twists else set_at(blade.unit.angle)


class _Masses:
    """Points of a blade by which its inertia and its loads are added up, then its stations."""

    def __init__(
        self, case: RunCase, units: Units, built: RotatingBeam, stations: FloatArray
    ) -> None:
        blade, model, count = built.blade, case.model, len(built.nodes)
        self._case, self._units, self._model, self._beam = case, units, model, blade
        nodes = (count - 1) // case.elements + 1
        mesh = Mesh(blade=blade, elements=case.elements, nodes_of_element=nodes)
        ends = np.union1d(np.union1d(mesh.places / blade.length, mesh.stations), stations)
        inner, weights = gauss_points(_POINTS)
        dx = np.outer(np.diff(ends), weights).ravel()
        x = (ends[:-1, None] + np.outer(np.diff(ends), inner)).ravel()
        at, none = mesh.along(x), np.zeros(1)
        # Behind the points of the blade come its point masses, points of loads, and the tip.
        bodies = [(one.position, one.mass, one.inertia) for one in blade.point_masses]
        self._on_span = []
        for load in filter(is_on_span, units.loads(case.loads)):
            points, weights = load.points(blade.length * ends)
            first = x.size + len(bodies)
            at_points = slice(first, first + points.size)
            self._on_span.append((load, at_points, weights[:, None]))
            bodies += [(point, 0.0, 0.0) for point in points]
        places, masses, inertias = np.array(bodies).reshape(-1, 3).T
        self._x = np.concatenate((x, places / blade.length, none + 1.0))
        self._weights = {
            "mass": np.concatenate((at.mass_per_length * dx, masses, none)),
            "length": np.concatenate((dx, 0.0 * masses, none)),
            "tip": np.concatenate((0.0 * dx, 0.0 * masses, none + 1.0)),
        }
        # Inertia of what turns in its plane is that of a mass along the second axis.
        self._second = np.zeros((self._x.size, 3, 3))
        self._second[x.size : -1, 1, 1] = inertias
        everywhere = np.append(self._x, stations)
        self._arms = np.zeros((everywhere.size, 3))
        if model.twists:
            unit = space_unit(blade)
            self._arms = blade.length * unit.inertia_about(everywhere, blade.slenderness)[0].T
            _, inertia = unit.inertia_about(x, blade.slenderness)
            second = 0.5 * np.trace(inertia) * np.eye(3)[..., None] - inertia
            scale = blade.mass_per_length * blade.length**2
            self._second[: x.size] = np.moveaxis(scale * second * dx, -1, 0)
        elif model.theory.rotary_inertia:
            self._second[: x.size, 1, 1] = at.rotary_inertia * dx
        self._outboard = ((self._x > stations[:, None]) | (self._x == 1.0)).astype(float)
        spread = model.spread(mesh.places, case.elements, blade.length * everywhere)
        self._spread = sparse.csr_array(spread.reshape(-1, spread.shape[2] * spread.shape[3]))

    def loads(self, time: FloatArray, *states: FloatArray) -> tuple[FloatArray, ...]:
        """Return places, sections, forces and moments of the stations, of states as above."""
        case, model, count, per_unit = self._case, self._model, self._x.size, self._units.time
        e, relative, rates, change = (self._along(state) for state in states)
        angle, turning = case.rotation.angle(time), np.zeros(3)
        if case.frame == "inertial":
            change = model.turned(change, -angle)
        else:
            setting = 0.0 if model.twists else self._beam.unit.angle
            rates, turning = relative, np.array([0.0, math.sin(setting), math.cos(setting)])
        W = np.multiply.outer(per_unit * case.rotation.rate(time), turning)[:, None]
        W_dot = np.multiply.outer(per_unit**2 * case.rotation.acceleration(time), turning)[:, None]
        line, v, r, v_frame, a = (
            self._vectors(one)
            for one in (
                model.line(self._arms, e),
                model.line(self._arms, e, relative),
                e,
                rates,
                change,
            )
        )
        a = a + np.cross(W, 2.0 * v_frame + np.cross(W, r)) + np.cross(W_dot, r)
        f = -self._weights["mass"][:, None] * a[:, :count]
        on_line = -self._beam.damping.external * self._weights["length"][:, None] * v[:, :count]
        for load in self._units.loads(case.loads):
            if load.acts_on not in (None, "span"):
                phase = (load.frequency or 0.0) * time / per_unit
                force = load.force(phase, angle, model.setting(self._beam))
                parts = np.stack((force.real, force.imag, load.lift(phase)), axis=-1)
                push = self._weights[load.acts_on][:, None] * parts[:, None]
                total = f if load.acts_on == "mass" else on_line
                total += push
        section, moments = model.sections(e), np.zeros_like(f)
        for span_load, at, weights in self._on_span:
            x = self._beam.length * self._x[at]
            wrench = span_load.wrench(span_load.phase_at(time / per_unit), x)
            turn = section[:, at] if span_load.following else model.line_frame(self._beam)
            for total, part in zip(
                (on_line, moments), turned_wrench(weights * wrench, turn), strict=True
            ):
                total[:, at] += part
        couple = np.cross(r[:, :count], f) + np.cross(line[:, :count], on_line) + moments
        f = f + on_line
        if self._second.any():
            ahead, d, behind = (
                np.swapaxes(model.sections(e + h * rates + 0.5 * h**2 * change)[:, :count], -1, -2)
                for h in (_INSTANT, 0.0, -_INSTANT)
            )
            # In its plane only Euler's acceleration turns a section; a set ancf3 has ρI s²w² more.
            d_ddot = (ahead - 2.0 * d + behind) / _INSTANT**2 + np.cross(W_dot[:, None], d)
            couple -= np.cross(d, self._second @ d_ddot).sum(axis=-2)
        place, section = line[:, count:], section[:, count:]
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
