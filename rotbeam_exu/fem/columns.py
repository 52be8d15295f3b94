"""The columns of a run: everything it is asked for, in SI units, as seen from the clamp."""

from __future__ import annotations

import numpy as np

from analytic import AnyBlade
from analytic.arrays import FloatArray
from analytic.lazily import interpolate

from ..lazily import xr
from ..runs.shape import shape_of
from .case import RunCase
from .rotating_beam import RotatingBeam
from .solver import Trajectory
from .stations import section_loads
from .units import Units


def columns(
    case: RunCase,
    units: Units,
    beam: AnyBlade,
    built: RotatingBeam,
    trajectory: Trajectory,
    stations: FloatArray,
) -> xr.Dataset:
    """Return the samples of a run; `beam` is the case's in `units`, as is the trajectory.

    `stations` are over L.
    """
    model, setting, space = case.model, case.model.setting(beam), case.model.leaves_plane
    # Counted, not added up: the times of the steps asked for.
    time = case.step * np.rint(trajectory.time * units.time / case.step)
    coordinates, absolute = trajectory.coordinates, trajectory.velocities
    elastic = trajectory.elastic_energy
    angle, rate = case.rotation.angle(time), units.time * case.rotation.rate(time)
    if case.frame == "inertial":
        coordinates = model.turned(coordinates, -angle) - angle[:, None, None] * model.angles
        absolute = model.turned(absolute, -angle)
    else:
        absolute = absolute + setting * rate[:, None, None] * model.spun(coordinates)
    kinetic, momentum = model.energy_and_momentum(
        beam, built.mass, built.chain.turning, coordinates, absolute, rate
    )
    relative = absolute - setting * rate[:, None, None] * model.spun(coordinates)
    # The lines of the nodes, by the axes of the clamp.
    frame = model.line_frame(beam)
    axis, moving = (e[..., : model.dimensions] @ frame for e in (coordinates, relative))
    # Out of the plane of rotation the deflection has a share that is not seen there.
    seen = coordinates[:, -1, :2] @ [1.0, 1j * setting] * np.exp(1j * angle)
    reference = trajectory.reference[0]
    off = coordinates[:, 0] - reference
    strain = np.abs(model.axial_strain(beam, coordinates)).max(axis=1)
    values = {
        "q": (axis[:, -1, 1], "m", "tip displacement q"),
        "q_dot": (moving[:, -1, 1], "m/s", "tip velocity dq/dt"),
    }
    if space:
        tip = axis[:, -1, 2] - (reference[:3] @ frame)[2]
        values["w"] = tip, "m", "tip displacement out of the plane"
        values["w_dot"] = moving[:, -1, 2], "m/s", "tip velocity out of the plane"
    values |= {
        "tip_x": (seen.real, "m", "tip position along inertial x"),
        "tip_y": (seen.imag, "m", "tip position along inertial y"),
        "angle": (angle, "rad", "angle of the clamp"),
        "kinetic_energy": (kinetic, "J", "kinetic energy"),
        "elastic_energy": (elastic, "J", "elastic energy"),
        "jacobi_energy": (kinetic + elastic - rate * momentum, "J", "Jacobi energy E - ω L_z"),
        "clamp_residual": (
            np.linalg.norm(off[:, : model.dimensions], axis=1), "m", "position error of the clamp"
        ),
        "direction_residual": (
            np.abs(off @ model.held(reference).T).max(axis=1), "1", "direction error of the clamp"
        ),
        "axial_strain": (strain, "1", "largest axial strain along the beam"),
    }  # fmt: skip
    values |= _clamp_loads(case, trajectory, angle, coordinates[:, 0], frame)
    t, rate_dot = time / units.time, units.time**2 * case.rotation.acceleration(time)
    if setting != 1.0:
        across = _torque_across(built, setting, t, angle, coordinates, relative, rate, rate_dot)
        torque, unit, label = values["clamp_torque"]
        values["clamp_torque"] = setting * torque + across, unit, label
    if case.exchanges_energy:
        power = built.loading.power(t, angle, relative) - rate_dot * momentum
        if built.chain.dissipation is not None:
            power = power - built.chain.dissipation(coordinates, relative)
        values["supplied_energy"] = (
            _integral(t, power), "J", "supplied share of the Jacobi energy"
        )  # fmt: skip
    if model.twists:
        before, turn = model.sections(trajectory.reference[-1]), model.sections(coordinates[:, -1])
        turned = frame.T @ turn @ before.T @ frame
        values["twist"] = twist(turned), "rad", "twist of the tip's section about its normal"
    scale = {"m": units.length, "m/s": units.velocity, "J": units.energy}
    scale |= {"N": units.energy / units.length, "N m": units.energy}
    run = xr.Dataset(
        {
            name: ("time", scale.get(unit, 1.0) * column, {"units": unit, "long_name": label})
            for name, (column, unit, label) in values.items()
        },
        coords={"time": ("time", time, {"units": "s", "long_name": "time"})},
    )
    if stations.size:
        states = coordinates, relative, absolute, trajectory.accelerations
        run = run.merge(shape_of(section_loads(case, units, built, stations, time, *states)))
    if space:
        known = {"units": "m", "long_name": "positions of the nodes in the frame of the clamp"}
        run["axis"] = ("time", "node", "direction"), units.length * axis, known
        run = run.assign_coords(direction=["x", "y", "z"])
    return run


def _clamp_loads(
    case: RunCase, trajectory: Trajectory, angle: FloatArray, root: FloatArray, frame: FloatArray
) -> dict[str, tuple[FloatArray, str, str]]:
    """Return what the blade exerts on the clamp, whose axes are `frame`, by the multipliers."""
    model, count = case.model, case.model.dimensions
    onto = np.zeros_like(root)
    onto[:, :count] = trajectory.multipliers[:, :count]
    if case.frame == "inertial":
        onto = model.turned(onto[:, None], -angle)[:, 0]
    onto += trajectory.multipliers[:, count:] @ model.held(trajectory.reference[0])
    force, moment = onto[:, :count] @ frame, model.root_moment(root, onto)
    if model.leaves_plane:
        moment = moment @ frame
    kinds = (
        ("force", "N", "xyz"[:count], force),
        ("moment", "N m", "xyz"[-moment.shape[1] :], moment),
    )
    values = {
        f"root_{kind}_{axis}": (column, unit, f"{kind} of the blade on the clamp, {axis}")
        for kind, unit, axes, along in kinds
        for axis, column in zip(axes, along.T, strict=True)
    }
    torque = -np.sum(onto * model.spun(root), axis=1)
    values["clamp_torque"] = torque, "N m", "torque of the clamp about the axis of rotation"
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
    weight = built.loading.forces(t, angle, 1.0) - built.loading.forces(t, angle)
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
