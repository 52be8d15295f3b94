"""The columns of a run: all that it gives, in SI units, as seen from the clamp."""

from __future__ import annotations

import numpy as np

from analytic.arrays import FloatArray
from analytic.lazily import interpolate

from ..labels import dataset, labeled
from ..lazily import xr
from ..runs.shape import shape_of
from .case import RunCase
from .rotating_beam import RotatingBeam
from .section_loads import section_loads, to_clamp
from .solver import Trajectory
from .units import Units


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
    values |= _clamp_loads(case, trajectory, angle, *ends, to_clamp(model, blade))
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

    `root` is of its node, `line` of the clamp; `turn` is that of `to_clamp`.
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
