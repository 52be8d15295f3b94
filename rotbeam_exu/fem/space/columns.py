"""The columns of a run in space: those of the plane, and what leaves it."""

from __future__ import annotations

from typing import cast

import numpy as np

from analytic import AnyBlade

from ...lazily import xr
from ..case import Case
from ..columns import in_si
from ..elements.formulation import spun
from ..rotating_beam import RotatingBeam
from ..solver import Trajectory
from ..units import Units
from .elements import SpaceFormulation


def space_columns(
    case: Case, units: Units, beam: AnyBlade, built: RotatingBeam, trajectory: Trajectory
) -> xr.Dataset:
    """Return the samples of a run; `beam` is the case's in `units`, as is the trajectory."""
    model = cast(SpaceFormulation, case.model)
    # Counted, not added up: the times of the steps asked for.
    time = case.step * np.rint(trajectory.time * units.time / case.step)
    coordinates, absolute = trajectory.coordinates, trajectory.velocities
    angle, rate = case.rotation.angle(time), units.time * case.rotation.rate(time)
    if case.frame == "inertial":
        coordinates, absolute = (model.turned(part, -angle) for part in (coordinates, absolute))
    else:
        absolute = absolute + rate[:, None, None] * spun(model, coordinates)
    kinetic, momentum = model.energy_and_momentum(built, beam, coordinates, absolute)
    elastic = trajectory.elastic_energy
    root, tip, tip_rate = coordinates[:, 0], coordinates[:, -1], absolute[:, -1]
    seen = (tip[:, 0] + 1j * tip[:, 1]) * np.exp(1j * angle)
    gradient, target = model.clamp(0.0)
    place = np.array([beam.length * beam.unit.hub, 0.0, 0.0])
    strain = np.abs(model.axial_strain(beam, coordinates)).max(axis=1)
    values = {
        "q": (tip[:, 1], "m", "tip displacement q"),
        "q_dot": (tip_rate[:, 1] - rate * tip[:, 0], "m/s", "tip velocity dq/dt"),
        "w": (tip[:, 2], "m", "tip displacement out of the plane"),
        "w_dot": (tip_rate[:, 2], "m/s", "tip velocity out of the plane"),
        "tip_x": (seen.real, "m", "tip position along inertial x"),
        "tip_y": (seen.imag, "m", "tip position along inertial y"),
        "angle": (angle, "rad", "angle of the clamp"),
        "kinetic_energy": (kinetic, "J", "kinetic energy"),
        "elastic_energy": (elastic, "J", "elastic energy"),
        "jacobi_energy": (kinetic + elastic - rate * momentum, "J", "Jacobi energy E - ω L_z"),
        "clamp_residual": (
            np.linalg.norm(root[:, :3] - place, axis=1), "m", "position error of the clamp"
        ),
        "direction_residual": (
            np.abs(root @ gradient.T - target).max(axis=1), "1", "direction error of the clamp"
        ),
        "axial_strain": (strain, "1", "largest axial strain along the beam"),
    }  # fmt: skip
    twist = model.twist(coordinates)
    if twist is not None:
        values["twist"] = (twist, "rad", "twist of the tip's section about its normal")
    run = in_si(time, units, values)
    run["axis"] = (
        ("time", "node", "direction"),
        units.length * coordinates[..., :3],
        {"units": "m", "long_name": "positions of the nodes in the frame of the clamp"},
    )
    upright = model.upright(coordinates)
    if upright is not None:
        run["upright"] = (
            ("time", "node", "direction"),
            upright,
            {"units": "1", "long_name": "axis of the sections that stands up at rest"},
        )
    return run.assign_coords(direction=["x", "y", "z"])
