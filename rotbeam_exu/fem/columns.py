"""The columns of a run: everything it is asked for, in SI units, as seen from the clamp."""

from __future__ import annotations

import numpy as np

from analytic import AnyBlade
from analytic.arrays import FloatArray
from analytic.lazily import interpolate

from ..lazily import xr
from .case import Case
from .elements import Formulation
from .rotating_beam import RotatingBeam
from .solver import Trajectory
from .units import Units


def columns(
    case: Case, units: Units, beam: AnyBlade, built: RotatingBeam, trajectory: Trajectory
) -> xr.Dataset:
    """Return the samples of a run; `beam` is the case's in `units`, as is the trajectory."""
    model, setting = case.model, beam.unit.setting
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
    root, tip, tip_rate = coordinates[:, 0], coordinates[:, -1], absolute[:, -1]
    x, y = tip[:, 0], tip[:, 1]
    # Out of the plane of rotation the deflection has a share that is not seen there.
    seen = (x + 1j * setting * y) * np.exp(1j * angle)
    gradient, target = model.clamp(0.0)
    place = root[:, list(model.fixed_at_root)]
    place = place - beam.hub_radius * np.eye(1, place.shape[1])
    strain = np.abs(model.axial_strain(beam, coordinates)).max(axis=1)
    values = {
        "q": (y, "m", "tip displacement q"),
        "q_dot": (tip_rate[:, 1] - setting * rate * x, "m/s", "tip velocity dq/dt"),
    }
    if model.leaves_plane:
        values["w"] = tip[:, 2], "m", "tip displacement out of the plane"
        values["w_dot"] = tip_rate[:, 2], "m/s", "tip velocity out of the plane"
    values |= {
        "tip_x": (seen.real, "m", "tip position along inertial x"),
        "tip_y": (seen.imag, "m", "tip position along inertial y"),
        "angle": (angle, "rad", "angle of the clamp"),
        "kinetic_energy": (kinetic, "J", "kinetic energy"),
        "elastic_energy": (elastic, "J", "elastic energy"),
        "jacobi_energy": (kinetic + elastic - rate * momentum, "J", "Jacobi energy E - ω L_z"),
        "clamp_residual": (np.linalg.norm(place, axis=1), "m", "position error of the clamp"),
        "direction_residual": (
            np.abs(root @ gradient.T - target).max(axis=1), "1", "direction error of the clamp"
        ),
        "axial_strain": (strain, "1", "largest axial strain along the beam"),
    }  # fmt: skip
    if case.exchanges_energy:
        t = time / units.time
        relative = absolute - setting * rate[:, None, None] * model.spun(coordinates)
        power = built.loading.power(t, angle, relative)
        if built.chain.dissipation is not None:
            power = power - built.chain.dissipation(coordinates, relative)
        power -= units.time**2 * case.rotation.acceleration(time) * momentum
        supplied = _integral(t, power)
        values["supplied_energy"] = supplied, "J", "supplied share of the Jacobi energy"
    if (twist := model.twist(coordinates)) is not None:
        values["twist"] = twist, "rad", "twist of the tip's section about its normal"
    scale = {"m": units.length, "m/s": units.velocity, "J": units.energy}
    run = xr.Dataset(
        {
            name: ("time", scale.get(unit, 1.0) * column, {"units": unit, "long_name": label})
            for name, (column, unit, label) in values.items()
        },
        coords={"time": ("time", time, {"units": "s", "long_name": "time"})},
    )
    return _with_directions(run, model, units, coordinates) if model.leaves_plane else run


def _with_directions(
    run: xr.Dataset, model: Formulation, units: Units, coordinates: FloatArray
) -> xr.Dataset:
    """Return the run in space with how the blade lies: its axis, and its sections where known."""
    dims = ("time", "node", "direction")
    label = "positions of the nodes in the frame of the clamp"
    axis = units.length * coordinates[..., :3]
    run["axis"] = dims, axis, {"units": "m", "long_name": label}
    if (upright := model.upright(coordinates)) is not None:
        label = "axis of the sections that stands up at rest"
        run["upright"] = dims, upright, {"units": "1", "long_name": label}
    return run.assign_coords(direction=["x", "y", "z"])


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
