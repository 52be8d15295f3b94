"""The shape of a blade over time as labeled data, of exact answers and of runs alike."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from analytic import Blade
from analytic.arrays import FloatArray, evaluated, slope_of
from analytic.exact.continuum.planar_kinematics import in_plane_of_bending
from analytic.exact.continuum.state import SectionLoads
from analytic.exact.continuum.unit import space_unit, trapeze_of
from analytic.input_checks import (
    along,
    finite_array,
    points_of_beam,
    positive,
    require_offset,
    shown,
    whole_number,
)
from analytic.lazily import spatial
from analytic.theory import BERNOULLI_EULER

from ..labels import dataset
from ..lazily import xr
from .attributes import beam_of, blade_attributes

if TYPE_CHECKING:
    from analytic.exact.linear.families import LinearModes

_OVER = "time", "station"
_PLACE, _SECTION = "place in the frame of the clamp [m]", "section's axes"
_ALIKE = 0.01  # of a side, by which rounded stiffnesses may vary


def shape_of(loads: SectionLoads) -> xr.Dataset:
    """Return sections over `time` and `station` [m], in the plane and in space with the same dims.

    `place` [m] is in the frame that turns with the clamp, by `direction` x along the clamp, y in
    the direction of rotation, and z. `section` has the axes of the sections there, by
    `section_axis` normal, chord (in the plane of bending) and thickness. By the same axes are
    `force` [N] and `moment` [N m] of the outboard on the inboard part, and `curvature` [1/m], the
    twist first. `strain` is that of the axis. Strains are what force and moment cause in the
    elastic section. A steady state has no `time`. Where the section out of the plane of bending is
    unknown, the attribute `section_out_of_plane` says so, and loads out of it are zero.

    Examples
    --------
    >>> from analytic import Beam, periodic_orbits
    >>> from rotbeam_exu.runs.shape import outer_strain, shape_of
    >>> orbits = periodic_orbits(Beam.reference(), omega=6.0, amplitudes=[0.3])
    >>> shape = shape_of(orbits.section_loads(0, [0.0, 4.0, 8.0], phase=[0.0, 1.57]))
    >>> print(dict(shape.sizes), outer_strain(shape, height=0.0367).max().round(5).item())
    {'time': 2, 'station': 3, 'direction': 3, 'section_axis': 3} 0.00428
    """
    strains = _strains(loads)
    over = _OVER[-loads.place.ndim + 1 :]
    by_axis = (*over, "section_axis")
    return dataset(
        {
            "place": ((*over, "direction"), loads.place, _PLACE),
            "section": ((*over, "direction", "section_axis"), loads.section, _SECTION),
            "force": (by_axis, loads.force, "force on the inboard part [N]"),
            "moment": (by_axis, loads.moment, "moment on the inboard part [N m]"),
            "strain": (over, strains[..., 0], "strain of the axis"),
            "curvature": (by_axis, strains[..., 3:], "elastic twist and curvatures [1/m]"),
        },
        _coordinates(loads.stations),
        blade_attributes(loads.blade),
    )


def in_space(data: xr.Dataset) -> tuple[FloatArray, FloatArray]:
    """Return places (times, stations, 3) and sections (times, stations, 3, 3) seen from outside.

    From the axis of rotation, z along it; x is the clamp's line at the angle zero. Without an
    `angle` in the data the clamp rests there.
    """
    blade = beam_of(data.attrs)
    angle = data["angle"].to_numpy() if "angle" in data else np.zeros(data.sizes["time"])
    c, s = math.cos(blade.line.precone), math.sin(blade.line.precone)
    turn = in_plane_of_bending(angle, 0.0) @ np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])
    hub = blade.hub_radius * np.array([c, 0.0, -s])
    place = (data["place"].to_numpy() + hub) @ np.swapaxes(turn, -1, -2)
    return place, turn[:, None] @ np.asarray(data.get("section", np.eye(3)))


def strain_at(
    data: xr.Dataset, points: ArrayLike, youngs_modulus: ArrayLike | None = None
) -> xr.Dataset:
    """Return the strain over time, station and point, and with a modulus the stress [Pa].

    ε + κ2 c3 - κ3 c2, along the blade, of sections that stay plane.

    Parameters
    ----------
    data : Dataset
        With stations: of a run, or of an exact answer by `dataset_of` or `shape_of`.
    points : array_like (points, 2) or (stations, points, 2)
        (c2, c3) [m] from the blade's line along chord and thickness, the same at all stations or
        at each.
    youngs_modulus : float or array_like (points,) or (stations, points), optional
        E [N/m²] there.

    Raises
    ------
    ValueError
        If the shape is another, a point is farther than the blade is long, or E is not positive.

    Examples
    --------
    >>> from analytic import Beam, Rectangle, steady_state
    >>> from rotbeam_exu.runs.shape import shape_of, strain_at
    >>> strip = Beam.reference().with_shape(Rectangle())
    >>> loads = steady_state(strip, omega=6.0).section_loads([0.0, 4.0])
    >>> found = strain_at(shape_of(loads), [(0.018, 0.001), (-0.018, 0.001)], 7e10)
    >>> print(dict(found.sizes), (found["stress"].max() / 1e6).round(2).item(), "MPa")
    {'station': 2, 'point': 2} 3.24 MPa
    """
    place = data["station"]
    offsets = offsets_of(beam_of(data.attrs), np.atleast_1d(place.to_numpy()), points)
    over = (*place.dims, "point")
    c2, c3 = (xr.DataArray(offsets[..., k].reshape(*place.shape, -1), dims=over) for k in range(2))
    about_chord, about_thickness = (
        data["curvature"].isel(section_axis=k, drop=True) for k in (1, 2)
    )
    strain = data["strain"] + about_chord * c3 - about_thickness * c2
    columns = {"strain": strain.assign_attrs(units="1", long_name="strain at the point")}
    if youngs_modulus is not None:
        E = finite_array("youngs_modulus", youngs_modulus, "Pa")
        if E.min() <= 0.0 or E.shape not in ((), c2.shape, c2.shape[-1:]):
            raise ValueError(
                f"youngs_modulus must be positive, one number or as many as points, {c2.shape}, "
                f"got the shape {E.shape} from {E.min():g} Pa"
            )
        modulus = xr.DataArray(np.broadcast_to(E, c2.shape), dims=over)
        stress = (modulus * strain).transpose(*strain.dims)
        columns["stress"] = stress.assign_attrs(units="Pa", long_name="stress at the point")
    return xr.Dataset(columns, attrs=data.attrs)


def offsets_of(blade: Blade, at: FloatArray, points: ArrayLike) -> FloatArray:
    """Return (c2, c3) [m] of points of the sections at stations, (stations, points, 2)."""
    offsets = finite_array("points", points, "m")
    if offsets.ndim == 2:
        offsets = np.broadcast_to(offsets, (at.size, *offsets.shape))
    if offsets.ndim != 3 or offsets.shape[::2] != (at.size, 2) or not offsets.size:
        raise ValueError(
            f"points must be pairs (c2, c3) [m], (points, 2), or such at each of the {at.size} "
            f"stations, got the shape {np.shape(points)}"
        )
    require_offset("a point of a section", offsets, blade.length)
    return offsets


def outer_strain(data: xr.Dataset, height: ArrayLike, width: ArrayLike = 0.0) -> xr.DataArray:
    """Return the largest strain of rectangular sections over time and station, in a corner.

    |ε| + |κ| h/2, in space + |κ| b/2 of the other curvature. Times E it is the largest stress.

    Parameters
    ----------
    data : Dataset
        With stations.
    height, width : float or array_like (stations,)
        Of the section along its chord, which is in the plane of bending, and across it [m].

    Raises
    ------
    ValueError
        If one number is given for a blade whose height or width varies.
    """
    at = data["station"]
    sides = sides_of(beam_of(data.attrs), at.to_numpy(), width=width, height=height)
    by_axis = xr.DataArray(sides.reshape(*at.shape, 2), dims=(*at.dims, "section_axis"))
    bent = (abs(data["curvature"].isel(section_axis=[1, 2])) * by_axis).sum("section_axis")
    strain: xr.DataArray = abs(data["strain"]) + 0.5 * bent
    return strain.assign_attrs(units="1", long_name="largest strain in the section")


def sides_of(blade: Blade, at: FloatArray, **sides: ArrayLike) -> FloatArray:
    """Return `height` and `width` of rectangular sections at stations [m], (stations, sides).

    The height of a rectangle goes with √(EI/EA), the width with that of the other plane or, where
    it is not known, with EA over the height. One number is refused where this varies.
    """
    at, columns = np.atleast_1d(at), []
    for name, given in sides.items():
        side = along(name, given, at.size, "m")
        if side.min() < 0.0:
            raise ValueError(f"{name} must not be negative, got {side.min():g} m")
        relative = _relative(blade, name, at)
        if np.ndim(given) == 0 and side.any() and np.ptp(relative) > _ALIKE:
            raise ValueError(
                f"the {name} of this blade varies along it, by its stiffness to "
                f"{relative.min():.3g} of its largest: give {name} at each of the {at.size} "
                "stations, in an array"
            )
        columns.append(side)
    return np.stack(columns, axis=-1)


def _relative(blade: Blade, name: str, at: FloatArray) -> FloatArray:
    """Return the height or the width of a full rectangle, over its largest on the blade."""
    x = np.union1d(at / blade.length, np.linspace(0.0, 1.0, 41))
    soft, EA = _flexibility(blade, x), evaluated(blade.unit.axial, x)
    height, across = np.sqrt(1.0 / (soft[:, 5, 5] * EA)), soft[:, 4, 4]
    if name == "height":
        side = height
    else:
        side = np.sqrt(1.0 / (across * EA)) if across.all() else EA / height
    return np.asarray(side / side.max())


def _strains(inner: SectionLoads) -> FloatArray:
    """Return ε, γ and κ [1/m], (..., stations, 6), that force and moment cause."""
    blade, EI, L = inner.blade, inner.blade.bending_stiffness, inner.blade.length
    at, section = inner.stations / L, blade.section
    soft = _flexibility(blade, at)
    loads = np.concatenate((inner.force * L**2 / EI, inner.moment * L / EI), axis=-1)
    shortening: Any = 0.0
    if inner.trapeze and section.knows_space:
        # N acts on ε + ½k²(κ1² - κ01²): k²Nκ1 of the torque is its own.
        twist, k2 = slope_of(blade.line.in_units(L).twist, at), trapeze_of(soft)
        twist = twist * (inner.trapeze is True)
        pull = k2 * loads[..., 0]
        free = np.sum(soft[:, 3] * loads, axis=-1)
        change = (free - soft[:, 3, 3] * pull * twist) / (1.0 + soft[:, 3, 3] * pull)
        loads[..., 3] -= pull * (twist + change)
        shortening = 0.5 * k2 * change * (2.0 * twist + change)
    strains = (soft @ loads[..., None])[..., 0]
    strains[..., 0] -= shortening
    return np.asarray(strains / np.repeat([1.0, L], 3))


def _flexibility(blade: Blade, x: FloatArray) -> FloatArray:
    """Return the flexibility at `x` over L, (places, 6, 6), without dimensions.

    What is not known out of the plane is zero.
    """
    if blade.section.knows_space:
        return space_unit(blade).flexibility(x, BERNOULLI_EULER, blade.slenderness)
    out = blade.section.out_of_plane
    soft = np.zeros((x.size, 6, 6))
    soft[:, 0, 0] = blade.slenderness / evaluated(blade.unit.axial, x)
    soft[:, 5, 5] = 1.0 / evaluated(blade.unit.bending, x)
    soft[:, 4, 4] = soft[:, 5, 5] / out.bending_ratio if out else 0.0
    return soft


def vibration_of(
    modes: LinearModes, mode: str, points: ArrayLike, *, amplitude: float = 0.1, pictures: int = 40
) -> xr.Dataset:
    """Return a blade that vibrates in one mode about its steady rotation, for a film.

    For two periods, the small vibration drawn large; columns as of `shape_of`, with `angle`.

    Parameters
    ----------
    modes : LinearModes
    mode : str
        One of its names, as "flap 1".
    points : array_like (stations,)
        Distances from the clamp [m].
    amplitude : float
        Largest displacement of the tip over the length; of a tip that only turns, its angle [rad].
    pictures : int
        Times in a period.

    Raises
    ------
    ValueError
        If the modes do not have this name, or an argument is out of range.

    Examples
    --------
    >>> from analytic import Beam, Rectangle, linear_modes
    >>> from rotbeam_exu.runs.shape import vibration_of
    >>> modes = linear_modes(Beam.reference().with_shape(Rectangle()), omega=6.0, count=4)
    >>> data = vibration_of(modes, "flap 2", [0.0, 4.0, 8.0])
    >>> print(dict(data["place"].sizes), data["place"][0, -1].values.round(3))
    {'time': 80, 'station': 3, 'direction': 3} [8.  0.  0.8]
    """
    if mode not in modes.names:
        raise ValueError(f"mode must be one of {', '.join(modes.names)}, got {shown(mode)}")
    number, length = modes.names.index(mode), modes.blade.length
    size = positive("amplitude", amplitude)
    time = np.arange(2 * whole_number("pictures", pictures)) / pictures
    time *= 2.0 * math.pi / modes.frequencies[number]
    at, still = points_of_beam("points", points, length), modes.steady.equilibrium[None]
    place, section = modes.model.standing(still, at)
    turning = np.exp(1j * modes.frequencies[number] * time)
    moved = (turning[:, None, None] * size * modes.shapes(length * at)[..., number].T).real
    turn = spatial.transform.Rotation.from_rotvec(moved[..., 3].reshape(-1, 1) * [1.0, 0.0, 0.0])
    place = length * (place + moved[..., :3])
    section = turn.as_matrix().reshape(*place.shape, 3) @ section
    return dataset(
        {
            "place": ((*_OVER, "direction"), place, _PLACE),
            "section": ((*_OVER, "direction", "section_axis"), section, _SECTION),
            "angle": ("time", modes.omega * time, "angle of the clamp [rad]"),
            "q": ("time", place[:, -1, 1], "deflection of the tip [m]"),
        },
        {"time": (time, "time [s]"), **_coordinates(length * at)},
        {**blade_attributes(modes.blade), "omega": modes.omega, "ramp_time": 0.0, "mode": mode},
    )


def _coordinates(stations: FloatArray) -> dict[str, object]:
    return {
        "station": (stations, "distance from the clamp [m]"),
        "direction": ["x", "y", "z"],
        "section_axis": ["normal", "chord", "thickness"],
    }
