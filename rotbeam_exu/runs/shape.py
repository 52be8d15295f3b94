"""The shape of a blade over time as labeled data, of exact answers and of runs alike."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from analytic.arrays import FloatArray
from analytic.beam import AnyBlade
from analytic.exact.beam.section_loads import SectionLoads, in_plane_of_bending
from analytic.exact.space.unit import space_unit
from analytic.input_checks import not_negative
from analytic.profiles import evaluated
from analytic.theory import BERNOULLI_EULER

from ..lazily import xr
from .attributes import beam_attributes, beam_of

_OVER = ("time", "station")


def shape_of(found: SectionLoads) -> xr.Dataset:
    """Return sections over `time` and `station` [m], in the plane and in space with the same dims.

    `place` [m] is in the frame that turns with the clamp, by `direction` x along the clamp, y in
    the direction of rotation, and z. `section` has the axes of the sections there, by `along`:
    normal, chord (in the plane of bending) and thickness. By the same axes are `force` [N] and
    `moment` [N m] of the outboard on the inboard part, and `curvature` [1/m], the twist first.
    `strain` is that of the axis. Strains are what force and moment cause in the elastic section.
    A steady state has no `time`.
    """
    force, moment = _whole(found)
    strain, curvature = _strains(found.blade, found.stations, force, moment)
    over = _OVER[-(found.place.ndim - 1) :]
    by_axis = (*over, "along")
    named = {
        "place": ((*over, "direction"), found.place, "m", "place in the frame of the clamp"),
        "section": (
            (*over, "direction", "along"), found.section, "1", "axes of the section"
        ),
        "force": (by_axis, force, "N", "force on the inboard part"),
        "moment": (by_axis, moment, "N m", "moment on the inboard part"),
        "strain": (over, strain, "1", "strain of the axis"),
        "curvature": (by_axis, curvature, "1/m", "elastic twist and curvatures"),
    }  # fmt: skip
    station = "station", found.stations, {"units": "m", "long_name": "distance from the clamp"}
    return xr.Dataset(
        {
            name: (dims, values, {"units": unit, "long_name": label})
            for name, (dims, values, unit, label) in named.items()
        },
        {
            "station": station,
            "direction": ["x", "y", "z"],
            "along": ["normal", "chord", "thickness"],
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
    section = data.get("section", np.eye(3))
    return place, turn[:, None] @ np.asarray(section)


def outer_strain(data: xr.Dataset, height: float, width: float = 0.0) -> xr.DataArray:
    """Return the largest strain in the corners of the sections, over time and station.

    |ε| + |κ| h/2, in space + |κ| b/2 of the other curvature; times Young's modulus the largest
    stress along the blade. Of an ellipse the sum is an upper bound.

    Parameters
    ----------
    data : Dataset
        With stations.
    height, width : float
        Of the section along its chord, which is in the plane of bending, and across it [m].
    """
    height, width = not_negative("height", height, "m"), not_negative("width", width, "m")
    bent = abs(data["curvature"])
    chord, thickness = (bent.sel(along=one, drop=True) for one in ("chord", "thickness"))
    strain: xr.DataArray = abs(data["strain"]) + 0.5 * (height * thickness + width * chord)
    strain.attrs = {"units": "1", "long_name": "largest strain in the section"}
    return strain


def _whole(found: SectionLoads) -> tuple[FloatArray, FloatArray]:
    """Return force and moment with three components each; in the plane others are zero."""
    if found.force.shape[-1] == 3:
        return found.force, found.moment
    zero = np.zeros_like(found.moment)
    return (
        np.stack((found.force[..., 0], found.force[..., 1], zero), axis=-1),
        np.stack((zero, zero, found.moment), axis=-1),
    )


def _strains(
    blade: AnyBlade, x: FloatArray, force: FloatArray, moment: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return ε (..., stations) and κ [1/m] (..., stations, 3) that force and moment cause."""
    at, section, L = x / blade.length, blade.blade.section, blade.length
    EI = blade.bending_stiffness
    if section.knows_space:
        soft = space_unit(blade).flexibility(at, BERNOULLI_EULER, blade.slenderness)
    else:
        out: Any = section.out_of_plane
        soft = np.zeros((at.size, 6, 6))
        soft[:, 0, 0] = blade.slenderness / evaluated(blade.unit.axial, at)
        soft[:, 5, 5] = 1.0 / evaluated(blade.unit.bending, at)
        soft[:, 4, 4] = soft[:, 5, 5] / out.bending_ratio if out else 0.0
    loads = np.concatenate((force * L**2 / EI, moment * L / EI), axis=-1)
    strains = (soft @ loads[..., None])[..., 0]
    return strains[..., 0], strains[..., 3:] / L
