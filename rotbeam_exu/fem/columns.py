"""The columns of a run: everything it is asked for, in SI units, as seen from the clamp.

Loads in the sections follow from d'Alembert's principle, as those of the exact blade: from all
loads f outboard and the mesh's own accelerations A. With the section's axes d and its second
moments of mass G,

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
from analytic.lazily import interpolate, sparse
from analytic.quadrature import gauss_points

from ..labels import dataset, labeled
from ..lazily import xr
from ..runs.shape import shape_of
from .case import RunCase
from .elements.formulation import Formulation
from .loading import is_on_span, turned_wrench
from .mesh import Mesh
from .rotating_beam import RotatingBeam
from .solver import Trajectory
from .units import Units

_POINTS = 4  # between two ends, by which a cable's mass matrix is exact
_INSTANT = 1e-4  # of √(mL³/EI), for the differences that tell how sections turn


def columns(
    case: RunCase,
    units: Units,
    built: RotatingBeam,
    trajectory: Trajectory,
    stations: FloatArray,
) -> xr.Dataset:
    """Return the samples of a run, whose trajectory is in `units`; `stations` are over L."""
    model, blade, space = case.model, built.blade, case.model.leaves_plane
    # Counted, not added up: the times of the steps asked for.
    time = case.step * np.rint(trajectory.time * units.time / case.step)
    coordinates, absolute = trajectory.coordinates, trajectory.velocities
    elastic, setting = trajectory.elastic_energy, model.setting(blade)
    angle, rate = case.rotation.angle(time), units.time * case.rotation.rate(time)
    if case.frame == "inertial":
        coordinates = model.turned(coordinates, -angle) - angle[:, None, None] * model.angles
        absolute = model.turned(absolute, -angle)
    else:
        absolute = absolute + setting * rate[:, None, None] * model.spun(coordinates)
    kinetic, momentum = model.energy_and_momentum(
        blade, built.mass, built.chain.turning, coordinates, absolute, rate
    )
    relative = absolute - setting * rate[:, None, None] * model.spun(coordinates)
    # The lines of the nodes, by the axes of the clamp.
    frame, arms = model.line_frame(blade), model.arms(blade, case.elements)
    line, line_rates = model.line(arms, coordinates), model.line(arms, coordinates, relative)
    axis, moving = (e[..., : model.dimensions] @ frame for e in (line, line_rates))
    # Out of the plane of rotation the deflection has a share that is not seen there.
    inertial = line[:, -1, :2] @ [1.0, 1j * setting] * np.exp(1j * angle)
    off = coordinates[:, 0] - trajectory.reference[0]
    values = {
        "q": (axis[:, -1, 1], "tip displacement q [m]"),
        "q_dot": (moving[:, -1, 1], "tip velocity dq/dt [m/s]"),
    }
    if space:
        tip = axis[:, -1, 2] - (model.line(arms, trajectory.reference)[0, :3] @ frame)[2]
        values["w"] = tip, "tip displacement out of the plane [m]"
        values["w_dot"] = moving[:, -1, 2], "tip velocity out of the plane [m/s]"
    values |= {
        "tip_x": (inertial.real, "tip position along inertial x [m]"),
        "tip_y": (inertial.imag, "tip position along inertial y [m]"),
        "angle": (angle, "angle of the clamp [rad]"),
        "kinetic_energy": (kinetic, "kinetic energy [J]"),
        "elastic_energy": (elastic, "elastic energy [J]"),
        "jacobi_energy": (kinetic + elastic - rate * momentum, "Jacobi energy E - ω L_z [J]"),
        "clamp_residual": (
            np.linalg.norm(off[:, : model.dimensions], axis=1), "position error of the clamp [m]"
        ),
        "direction_residual": (
            np.abs(off @ model.held(trajectory.reference[0]).T).max(axis=1),
            "direction error of the clamp",
        ),
        "axial_strain": (
            np.abs(model.axial_strain(blade, coordinates)).max(axis=1),
            "largest axial strain along the beam",
        ),
    }  # fmt: skip
    ends = coordinates[:, 0], line[:, 0]
    values |= _clamp_loads(case, trajectory, angle, *ends, _to_clamp(model, blade))
    t, rate_dot = time / units.time, units.time**2 * case.rotation.acceleration(time)
    if setting != 1.0:
        across = _torque_across(built, setting, t, angle, coordinates, relative, rate, rate_dot)
        torque, label = values["clamp_torque"]
        values["clamp_torque"] = setting * torque + across, label
    if case.exchanges_energy:
        power = built.loading.power(t, angle, coordinates, relative) - rate_dot * momentum
        if built.chain.dissipation is not None:
            power = power - built.chain.dissipation(coordinates, relative)
        values["supplied_energy"] = _integral(t, power), "supplied share of the Jacobi energy [J]"
    if model.twists:
        before, turn = model.sections(trajectory.reference[-1]), model.sections(coordinates[:, -1])
        turned = twist(frame.T @ turn @ before.T @ frame)
        values["twist"] = turned, "twist of the tip's section about its normal [rad]"
    scale = {"m": units.length, "m/s": units.velocity, "J": units.energy}
    scale |= {"N": units.energy / units.length, "N m": units.energy}
    run = dataset(
        {
            name: ("time", scale.get(labeled(label)["units"], 1.0) * column, label)
            for name, (column, label) in values.items()
        },
        {"time": (time, "time [s]")},
    )
    if stations.size:
        states = coordinates, relative, absolute, trajectory.accelerations
        run = run.merge(shape_of(section_loads(case, units, built, stations, time, *states)))
    if space:
        axis_label = labeled("positions of the nodes in the frame of the clamp [m]")
        run["axis"] = ("time", "node", "direction"), units.length * axis, axis_label
        run = run.assign_coords(direction=["x", "y", "z"])
    return run


def _clamp_loads(
    case: RunCase, trajectory: Trajectory, angle: FloatArray, root: FloatArray, line: FloatArray,
    turn: FloatArray,
) -> dict[str, tuple[FloatArray, str]]:  # fmt: skip
    """Return what the blade exerts on the clamp, by the multipliers.

    `root` is of its node, `line` of the clamp; `turn` is that of `_to_clamp`.
    """
    model, count = case.model, case.model.dimensions
    onto = np.zeros_like(root)
    onto[:, :count] = trajectory.multipliers[:, :count]
    if case.frame == "inertial":
        onto = model.turned(onto[:, None], -angle)[:, 0]
    onto += trajectory.multipliers[:, count:] @ model.held(trajectory.reference[0])
    force = onto[:, :count] @ np.eye(count, 3)
    arm = (root - line)[:, :count] @ np.eye(count, 3)
    moment = model.root_moment(root, onto) + np.cross(arm, force)
    kinds = ("force", "N", force), ("moment", "N m", moment)
    values = {
        f"root_{kind}_{axis}": (column, f"{kind} of the blade on the clamp, {axis} [{unit}]")
        for kind, unit, loads in kinds
        for axis, column in zip("xyz", turn @ loads.T, strict=True)
    }
    torque = -np.sum(onto * model.spun(root), axis=1)
    values["clamp_torque"] = torque, "torque of the clamp about the axis of rotation [N m]"
    return values


def _torque_across(
    built: RotatingBeam,
    setting: float,
    t: FloatArray,
    angle: FloatArray,
    coordinates: FloatArray,
    relative: FloatArray,
    rate: FloatArray,
    rate_dot: FloatArray,
) -> FloatArray:
    """Return the torque of what holds a set blade in its plane of bending, (samples,).

    d(s²w∫x²dm)/dt, and the moment c s²w²∫xy dm of the centrifugal forces along the clamp's line,
    less that of the loads across the plane.
    """
    model, samples = built.model, rate.size
    x, x_dot, turned = (
        v.reshape(samples, -1)
        for v in (coordinates * model.radial, relative * model.radial, model.spun(coordinates))
    )
    second, change, mixed = (np.sum((x @ built.mass) * v, axis=1) for v in (x, x_dot, turned))
    along = rate_dot * second + 2.0 * rate * change + setting * rate**2 * mixed
    lever = model.spun(coordinates * model.radial).reshape(samples, -1)
    # A weight W in the plane of rotation acts with cW in that of bending; s²W = (1 + c)(W - cW).
    as_set = t, angle, coordinates
    weight = built.loading.forces(*as_set, 1.0) - built.loading.forces(*as_set)
    held = (1.0 + setting) * np.sum(lever * weight, axis=1)
    return np.asarray((1.0 - setting**2) * along - held)


def twist(turns: FloatArray) -> FloatArray:
    """Return how far rotations (samples, 3, 3) turn a section out of its upright [rad]."""
    return np.unwrap(np.arctan2(turns[:, 2, 1], turns[:, 2, 2]))


def _integral(time: FloatArray, power: FloatArray) -> FloatArray:
    """Return the integral from the start on by a spline, NaN from the first sample that is not."""
    finite = np.logical_and.accumulate(np.isfinite(power))
    count = np.count_nonzero(finite)
    result = np.full(time.size, np.nan)
    result[:1] = 0.0
    if count > 1:
        spline = interpolate.CubicSpline(time[:count], power[:count]).antiderivative()
        result[:count] = spline(time[:count])
    return result


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
    to_clamp = _to_clamp(model, blade)
    place[..., 0] -= built.blade.hub_radius
    if not model.leaves_plane:  # not computed: what holds the blade in its plane
        force[..., 2] = moment[..., :2] = 0.0
    return SectionLoads(
        blade=blade,
        stations=blade.length * stations,
        place=units.length * place @ to_clamp.T,
        section=to_clamp @ section,
        force=units.energy / units.length * force,
        moment=units.energy * moment,
    )


def _to_clamp(model: Formulation, blade: Blade) -> FloatArray:
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
