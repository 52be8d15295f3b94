"""A blade over time for ParaView: VTK's XML files, a line, a body or a surface."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import ArrayLike, NDArray

from analytic import Beam, Blade
from analytic.arrays import FloatArray

from ..lazily import xr
from ..runs.attributes import beam_of
from ..runs.shape import in_space, offsets_of, sides_of, strain_at
from .results import whole_file, writable_folder

_LINE, _POLYGON, _QUAD, _HEXAHEDRON = 3, 7, 9, 12  # VTK's numbers of cells
_CORNERS = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])  # over height and width


def save_vtk(
    data: xr.Dataset,
    path: Path,
    *,
    height: ArrayLike | None = None,
    width: ArrayLike | None = None,
    points: ArrayLike | None = None,
    youngs_modulus: ArrayLike | None = None,
) -> Path:
    """Write a blade over time as `path`, .pvd, and one .vtu for each time in a folder next to it.

    Seen from outside, where `data` has the angle of the clamp. Points have the station [m], the
    axes of its section (normal, chord, thickness), `force` [N] and `moment` [N m] by these axes,
    and the strain there; with a Young's modulus, which a `Beam` knows, the stress [Pa] too.

    Parameters
    ----------
    data : Dataset
        A run of `simulate` with stations, what `dataset_of` makes of a SpinUpResponse with points,
        or `rotbeam_exu.runs.shape.shape_of` of section loads.
    path : Path
    height, width : float or array_like (stations,), optional
        Of a rectangular section along its chord, which is in the plane of bending, and across it
        [m]. With both the blade is drawn as a body, with neither as a line.
    points : array_like (points, 2) or (stations, points, 2), optional
        In place of them, (c2, c3) [m] around the section, as of an airfoil: the blade is drawn as
        its surface.
    youngs_modulus : float or array_like (points,) or (stations, points), optional
        E [N/m²] at the points or corners.

    Raises
    ------
    ValueError
        If the ending is another, there are no sections at two stations, one side is missing, or it
        varies and one number is given for it, or there are less than three points.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from analytic import Beam, SpinUp, spin_up_response
    >>> from rotbeam_exu import dataset_of
    >>> from rotbeam_exu.files.vtk import save_vtk
    >>> motion = SpinUp(omega=2.0, ramp_time=1.0)
    >>> found = spin_up_response(Beam.reference(), motion, [0.5, 1.0], points=[0.0, 4.0, 8.0])
    >>> with TemporaryDirectory() as folder:
    ...     written = save_vtk(dataset_of(found), Path(folder) / "blade.pvd")
    ...     print(*sorted(file.name for file in (written.parent / "blade").iterdir()))
    blade-0000.vtu blade-0001.vtu
    """
    if path.suffix != ".pvd":
        raise ValueError(f"cannot write {path.name!r}: the ending must be .pvd")
    if "section" not in data or data.sizes["station"] < 2:
        raise ValueError(
            "nothing to write for ParaView: give simulate stations=, or spin_up_response points=, "
            "at least two along the blade"
        )
    data = data if "time" in data.dims else data.expand_dims("time")
    blade, at = beam_of(data.attrs), data["station"].to_numpy()
    if points is None:
        offsets = corners(blade, at, height, width)
    elif height is not None or width is not None:
        raise ValueError("points, or height and width, define the section: leave one out")
    elif (offsets := offsets_of(blade, at, points)).shape[1] < 3:
        raise ValueError("the surface of a blade needs three points of each section, or more")
    if youngs_modulus is None and isinstance(blade, Beam):
        youngs_modulus = blade.youngs_modulus
    there = strain_at(data, offsets, youngs_modulus)
    folder, sets = path.with_suffix(""), ""
    writable_folder(folder)
    for n, standing in enumerate(zip(*in_space(data), strict=True)):
        name = f"{folder.name}/{folder.name}-{n:04d}.vtu"
        with whole_file(path.parent / name) as partial:
            now = data.isel(time=n), there.isel(time=n)
            text = _grid(*now, *standing, offsets, hollow=points is not None)
            partial.write_text(text, encoding="ascii")
        sets += f'<DataSet timestep="{data["time"][n].item()!r}" file={quoteattr(name)}/>\n'
    with whole_file(path) as partial:
        partial.write_text(_file("Collection", sets), encoding="utf-8")
    return path


def corners(
    blade: Blade, at: FloatArray, height: ArrayLike | None, width: ArrayLike | None
) -> FloatArray:
    """Return the corners of the sections from their axis [m], (stations, 4, 2).

    Without sides the axis alone, (stations, 1, 2).
    """
    if height is None and width is None:
        return np.zeros((at.size, 1, 2))
    if height is None or width is None:
        missing = "height" if height is None else "width"
        raise ValueError(f"a body has a height and a width: give {missing} too, or leave both out")
    sides = sides_of(blade, at, height=height, width=width)
    if not sides.all():
        raise ValueError("a body has a height and a width above zero: leave both out for a line")
    return np.asarray(_CORNERS * sides[:, None])


def _grid(
    data: xr.Dataset, there: xr.Dataset, place: FloatArray, section: FloatArray,
    offsets: FloatArray, *, hollow: bool,
) -> str:  # fmt: skip
    """Return a .vtu of points at `offsets` (stations, corners, 2) from the axis, and its cells."""
    corners, cells = offsets.shape[1], len(place) - 1
    values = {name: data[name].to_numpy() for name in ("station", "force", "moment")}
    values |= {
        name: section[..., k] for k, name in enumerate(data["section_axis"].to_numpy().tolist())
    }
    values = {name: np.repeat(one, corners, axis=0) for name, one in values.items()}
    values |= {str(name): one.to_numpy().ravel() for name, one in there.data_vars.items()}
    points = place[:, None] + offsets @ np.swapaxes(section[..., 1:], -1, -2)
    if hollow:  # a strip of quadrilaterals around each cell, and both ends
        around = np.arange(corners)
        ring = np.stack([around, np.roll(around, -1)])
        sides = np.concatenate((ring, ring[::-1] + corners)).T.ravel()
        joined = np.concatenate(
            (
                around,
                (corners * np.arange(cells)[:, None] + sides).ravel(),
                corners * cells + around,
            )
        )
        sizes = np.repeat([corners, 4, corners], [1, corners * cells, 1])
        kind = np.repeat([_POLYGON, _QUAD, _POLYGON], [1, corners * cells, 1]).astype(np.uint8)
    else:
        joined = (corners * np.arange(cells)[:, None] + np.arange(2 * corners)).ravel()
        sizes = np.full(cells, 2 * corners)
        kind = np.full(cells, _LINE if corners == 1 else _HEXAHEDRON, np.uint8)
    ends = np.cumsum(sizes)
    return _file(
        "UnstructuredGrid",
        f'<Piece NumberOfPoints="{corners * len(place)}" NumberOfCells="{kind.size}">\n'
        + _part("Points", {"place": points.reshape(-1, 3)})
        + _part("Cells", {"connectivity": joined, "offsets": ends, "types": kind})
        + _part("PointData", values)
        + "</Piece>\n",
    )


def _part(title: str, arrays: Mapping[str, NDArray[Any]]) -> str:
    """Return arrays in base64, each behind its number of bytes, so that none is rounded."""
    text = ""
    for name, values in arrays.items():
        kind = {"f": "Float64", "i": "Int64", "u": "UInt8"}[values.dtype.kind]
        content = values.astype(values.dtype.newbyteorder("<")).tobytes()
        coded = base64.b64encode(len(content).to_bytes(8, "little") + content).decode()
        parts = ' NumberOfComponents="3"' if values.ndim == 2 else ""
        text += f'<DataArray type="{kind}" Name="{name}"{parts} format="binary">{coded}'
        text += "</DataArray>\n"
    return f"<{title}>\n{text}</{title}>\n"


def _file(kind: str, content: str) -> str:
    return (
        '<?xml version="1.0"?>\n'
        f'<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n'
        f"<{kind}>\n{content}</{kind}>\n</VTKFile>\n"
    )
