"""The columns of a run: everything it is asked for, in SI units, as seen from the clamp."""

from __future__ import annotations

import numpy as np

from analytic import AnyBlade
from analytic.arrays import FloatArray
from analytic.lazily import interpolate

from ..lazily import xr
from .case import Case
from .elements.formulation import spun, turned, turned_velocities
from .kinetics import energy_and_momentum
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
    coordinates, velocities = trajectory.coordinates, trajectory.velocities
    elastic = trajectory.elastic_energy
    angle, rate = case.rotation.angle(time), units.time * case.rotation.rate(time)
    if case.frame == "inertial":
        coordinates = turned(model, coordinates, -angle)
        absolute = turned_velocities(model, velocities, -angle)
    else:
        absolute = velocities + setting * rate[:, None, None] * spun(model, coordinates)
    kinetic, angular_momentum = energy_and_momentum(built, coordinates, absolute, rate, setting)
    x, y = coordinates[:, -1, 0], coordinates[:, -1, 1]
    # Out of the plane of rotation the deflection has a share that is not seen there.
    seen = (x + 1j * setting * y) * np.exp(1j * angle)
    root = coordinates[:, 0]
    gradient, target = model.clamp(0.0)
    values = {
        "q": (y, "m", "tip displacement q"),
        "q_dot": (absolute[:, -1, 1] - setting * rate * x, "m/s", "tip velocity dq/dt"),
        "tip_x": (seen.real, "m", "tip position along inertial x"),
        "tip_y": (seen.imag, "m", "tip position along inertial y"),
        "angle": (angle, "rad", "angle of the clamp"),
        "kinetic_energy": (kinetic, "J", "kinetic energy"),
        "elastic_energy": (elastic, "J", "elastic energy"),
        "jacobi_energy": (
            kinetic + elastic - rate * angular_momentum,
            "J",
            "Jacobi energy E - ω L_z",
        ),
        "clamp_residual": (
            np.hypot(root[:, 0] - beam.length * beam.unit.hub, root[:, 1]),
            "m",
            "position error of the clamp",
        ),
        "direction_residual": (
            np.abs(root @ gradient.T - target).max(axis=1),
            "1",
            "direction error of the clamp",
        ),
        "axial_strain": (
            np.abs(model.axial_strain(beam, coordinates)).max(axis=1),
            "1",
            "largest axial strain along the beam",
        ),
    }
    if case.exchanges_energy:
        relative = absolute - setting * rate[:, None, None] * spun(model, coordinates)
        power = _power(built, time / units.time, angle, coordinates, relative)
        power -= units.time**2 * case.rotation.acceleration(time) * angular_momentum
        supplied = _integral(time / units.time, power)
        values["supplied_energy"] = (supplied, "J", "supplied share of the Jacobi energy")
    return in_si(time, units, values)


def in_si(
    time: FloatArray, units: Units, values: dict[str, tuple[FloatArray, str, str]]
) -> xr.Dataset:
    """Return the columns, each with its unit and label, over time [s]."""
    scale = {"m": units.length, "m/s": units.velocity, "J": units.energy}
    return xr.Dataset(
        {
            name: ("time", scale.get(unit, 1.0) * column, {"units": unit, "long_name": label})
            for name, (column, unit, label) in values.items()
        },
        coords={"time": ("time", time, {"units": "s", "long_name": "time"})},
    )


def _power(
    built: RotatingBeam,
    time: FloatArray,
    angle: FloatArray,
    coordinates: FloatArray,
    relative: FloatArray,
) -> FloatArray:
    """Return the power (samples,) that loads bring, and damping takes."""
    power = built.loading.power(time, angle, relative)
    if built.chain.dissipation is not None:
        power = power - built.chain.dissipation(coordinates, relative)
    return power


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
