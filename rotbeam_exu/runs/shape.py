"""The shape of a blade over time as labeled data, of exact answers and of runs alike."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from analytic.arrays import FloatArray, evaluated, slope_of
from analytic.exact.beam.kinematics import in_plane_of_bending
from analytic.exact.beam.state import SectionLoads
from analytic.exact.space.unit import space_unit, trapeze_of
from analytic.input_checks import not_negative
from analytic.theory import BERNOULLI_EULER

from ..labels import dataset
from ..lazily import xr
from .attributes import beam_attributes, beam_of


def shape_of(found: SectionLoads) -> xr.Dataset:
    """Return sections over `time` and `station` [m], in the plane and in space with the same dims.

    `place` [m] is in the frame that turns with the clamp, by `direction` x along the clamp, y in
    the direction of rotation, and z. `section` has the axes of the sections there, by
    `section_axis` normal, chord (in the plane of bending) and thickness. By the same axes are
    `force` [N] and `moment` [N m] of the outboard on the inboard part, and `curvature` [1/m], the
    twist first. `strain` is that of the axis. Strains are what force and moment cause in the
    elastic section. A steady state has no `time`.

    Examples
    --------
    >>> from analytic import Beam, periodic_orbits
    >>> from rotbeam_exu.runs.shape import outer_strain, shape_of
    >>> orbits = periodic_orbits(Beam.reference(), omega=6.0, amplitudes=[0.3])
    >>> shape = shape_of(orbits.section_loads(0, [0.0, 4.0, 8.0], phase=[0.0, 1.57]))
    >>> print(dict(shape.sizes), outer_strain(shape, height=0.0367).max().round(5).item())
    {'time': 2, 'station': 3, 'direction': 3, 'section_axis': 3} 0.00428
    """
    force, moment = found.force, found.moment
    if force.shape[-1] == 2:  # in its plane
        force = force @ np.eye(2, 3)
        moment = np.multiply.outer(moment, [0.0, 0.0, 1.0])
    strains = _strains(found, force, moment)
    over = ("time", "station")[-found.place.ndim + 1 :]
    by_axis = (*over, "section_axis")
    return dataset(
        {
            "place": ((*over, "direction"), found.place, "place in the frame of the clamp [m]"),
            "section": ((*over, "direction", "section_axis"), found.section, "section's axes"),
            "force": (by_axis, force, "force on the inboard part [N]"),
            "moment": (by_axis, moment, "moment on the inboard part [N m]"),
            "strain": (over, strains[..., 0], "strain of the axis"),
            "curvature": (by_axis, strains[..., 3:], "elastic twist and curvatures [1/m]"),
        },
        {
            "station": (found.stations, "distance from the clamp [m]"),
            "direction": ["x", "y", "z"],
            "section_axis": ["normal", "chord", "thickness"],
        },
        beam_attributes(found.blade),
    )


def in_space(data: xr.Dataset) -> tuple[FloatArray, FloatArray]:
    """Return places (times, stations, 3) and sections (times, stations, 3, 3) seen from outside.

    From the axis of rotation, z along it; x is the clamp's line at the angle zero. Without an
    `angle` in the data the clamp rests there.
    """
    blade = beam_of(data.attrs).blade
    angle = data["angle"].to_numpy() if "angle" in data else np.zeros(data.sizes["time"])
    c, s = math.cos(blade.line.precone), math.sin(blade.line.precone)
    turn = in_plane_of_bending(angle, 0.0) @ np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])
    hub = blade.hub_radius * np.array([c, 0.0, -s])
    place = (data["place"].to_numpy() + hub) @ np.swapaxes(turn, -1, -2)
    return place, turn[:, None] @ np.asarray(data.get("section", np.eye(3)))


def outer_strain(data: xr.Dataset, height: float, width: float = 0.0) -> xr.DataArray:
    """Return the largest strain of rectangular sections over time and station, in a corner.

    |ε| + |κ| h/2, in space + |κ| b/2 of the other curvature. Times E it is the largest stress.

    Parameters
    ----------
    data : Dataset
        With stations.
    height, width : float
        Of the section along its chord, which is in the plane of bending, and across it [m].
    """
    sides = not_negative("width", width, "m"), not_negative("height", height, "m")
    bent = (abs(data["curvature"].isel(section_axis=[1, 2])) * sides).sum("section_axis")
    strain: xr.DataArray = abs(data["strain"]) + 0.5 * bent
    return strain.assign_attrs(units="1", long_name="largest strain in the section")


def _strains(found: SectionLoads, force: FloatArray, moment: FloatArray) -> FloatArray:
    """Return ε, γ and κ [1/m], (..., stations, 6), that force and moment cause."""
    blade, EI, L = found.blade, found.blade.bending_stiffness, found.blade.length
    at, section = found.stations / L, blade.blade.section
    if section.knows_space:
        soft = space_unit(blade).flexibility(at, BERNOULLI_EULER, blade.slenderness)
    else:
        out: Any = section.out_of_plane
        soft = np.zeros((at.size, 6, 6))
        soft[:, 0, 0] = blade.slenderness / evaluated(blade.unit.axial, at)
        soft[:, 5, 5] = 1.0 / evaluated(blade.unit.bending, at)
        soft[:, 4, 4] = soft[:, 5, 5] / out.bending_ratio if out else 0.0
    loads = np.concatenate((force * L**2 / EI, moment * L / EI), axis=-1)
    shortening: Any = 0.0
    if found.trapeze and section.knows_space:
        # N acts on ε + ½k²(κ1² - κ01²): k²Nκ1 of the torque is its own.
        twist, k2 = slope_of(blade.blade.line.in_units(L).twist, at), trapeze_of(soft)
        pull = k2 * loads[..., 0]
        free = np.sum(soft[:, 3] * loads, axis=-1)
        change = (free - soft[:, 3, 3] * pull * twist) / (1.0 + soft[:, 3, 3] * pull)
        loads[..., 3] -= pull * (twist + change)
        shortening = 0.5 * k2 * change * (2.0 * twist + change)
    strains = (soft @ loads[..., None])[..., 0]
    strains[..., 0] -= shortening
    return np.asarray(strains / np.repeat([1.0, L], 3))
