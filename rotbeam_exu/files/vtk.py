"""A blade over time for ParaView: VTK's XML files of unstructured grids, written by hand.

A line, or the solid body of a rectangular section; numbers are binary, so that none is rounded.
"""

from __future__ import annotations

import base64
from collections.abc import Mapping
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np

from analytic.arrays import FloatArray
from analytic.input_checks import positive

from ..lazily import xr
from ..runs.shape import in_space
from .results import whole_file, writable_folder

_LINE, _HEXAHEDRON = 3, 12  # VTK's numbers of cells
_CORNERS = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
"""Of a section around its axis, over height and width."""


def save_vtk(
    data: xr.Dataset, path: Path, *, height: float | None = None, width: float | None = None
) -> Path:
    """Write a blade over time as `path`, .pvd, and one .vtu for each time in a folder beside it.

    Seen from outside, where `data` has the angle of the clamp. Every point has the station [m], the
    axes of its section (normal, chord, thickness), `force` [N] and `moment` [N m] by these axes,
    and the strain there; of a `Beam`, whose Young's modulus is known, the stress [Pa] too.

    Parameters
    ----------
    data : Dataset
        With stations: a run of `simulate` with stations=, what `dataset_of` makes of a
        SpinUpResponse with points, or `rotbeam_exu.runs.shape.shape_of` of section loads.
    path : Path
    height, width : float, optional
        Of a rectangular section along its chord, which is in the plane of bending, and across it
        [m]. With both the blade is drawn as a body, else as a line.

    Raises
    ------
    ValueError
        If the ending is another, or the data have no sections.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from analytic import Beam, SpinUp, spin_up_response
    >>> from rotbeam_exu import dataset_of
    >>> from rotbeam_exu.files.vtk import save_vtk
    >>> motion = SpinUp(omega=2.0, ramp_time=1.0)
    >>> found = spin_up_response(Beam.reference(), motion, [0.0, 0.5, 1.0], points=[0.0, 4.0, 8.0])
    >>> with TemporaryDirectory() as folder:
    ...     written = save_vtk(dataset_of(found), Path(folder) / "blade.pvd")
    ...     print(*sorted(file.name for file in (written.parent / "blade").iterdir()))
    blade-0000.vtu blade-0001.vtu blade-0002.vtu
    """
    if path.suffix != ".pvd":
        raise ValueError(f"cannot write {path.name!r}: the ending must be .pvd")
    if "section" not in data or data.sizes["station"] < 2:
        raise ValueError(
            "nothing to write for ParaView: give simulate stations=, or spin_up_response points=, "
            "at least two along the blade"
        )
    if "time" not in data.dims:
        data = data.expand_dims("time")
    offsets = np.zeros((1, 2))
    if height is not None and width is not None:
        sides = positive("height", height, "m"), positive("width", width, "m")
        offsets = _CORNERS * sides
    place, section = in_space(data)
    folder = path.with_suffix("")
    writable_folder(folder)
    names = [f"{folder.name}/{folder.name}-{n:04d}.vtu" for n in range(data.sizes["time"])]
    cells = _cells(data.sizes["station"], len(offsets))
    for n, name in enumerate(names):
        points, values = _points(data.isel(time=n), place[n], section[n], offsets)
        with whole_file(path.parent / name) as partial:
            partial.write_text(_grid(points, cells, values), encoding="ascii")
    sets = (
        f'<DataSet timestep="{time!r}" file={quoteattr(name)}/>\n'
        for time, name in zip(data["time"].to_numpy().tolist(), names, strict=True)
    )
    with whole_file(path) as partial:
        partial.write_text(_file("Collection", "".join(sets)), encoding="utf-8")
    return path


def _points(
    data: xr.Dataset, place: FloatArray, section: FloatArray, offsets: FloatArray
) -> tuple[FloatArray, dict[str, FloatArray]]:
    """Return the points (stations corners, 3) and the values at them by name."""
    y, z = offsets.T
    kappa = data["curvature"].to_numpy()
    strain = data["strain"].to_numpy()[:, None] + np.outer(kappa[:, 1], z)
    strain -= np.outer(kappa[:, 2], y)
    at_stations = {
        "station": data["station"].to_numpy(),
        **{name: section[..., k] for k, name in enumerate(data["along"].to_numpy().tolist())},
        "force": data["force"].to_numpy(),
        "moment": data["moment"].to_numpy(),
    }
    values = {name: np.repeat(one, len(y), axis=0) for name, one in at_stations.items()}
    values["strain"] = strain.ravel()
    if "beam_youngs_modulus" in data.attrs:
        values["stress"] = data.attrs["beam_youngs_modulus"] * values["strain"]
    corners = place[:, None] + offsets @ np.swapaxes(section[..., 1:], -1, -2)
    return corners.reshape(-1, 3), values


def _cells(stations: int, corners: int) -> Mapping[str, np.ndarray]:
    """Return the cells between stations as VTK has them: lines, or bodies of eight corners."""
    first = corners * np.arange(stations - 1)[:, None]
    connectivity = first + np.arange(2 * corners)
    count = len(connectivity)
    return {
        "connectivity": connectivity.ravel(),
        "offsets": 2 * corners * np.arange(1, count + 1),
        "types": np.full(count, _LINE if corners == 1 else _HEXAHEDRON, np.uint8),
    }


def _grid(
    points: FloatArray, cells: Mapping[str, np.ndarray], values: Mapping[str, FloatArray]
) -> str:
    """Return a .vtu file."""
    parts = (
        _part("Points", {"place": points}), _part("Cells", cells), _part("PointData", values)
    )  # fmt: skip
    piece = f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{cells["types"].size}">\n'
    return _file("UnstructuredGrid", f"{piece}{''.join(parts)}</Piece>\n")


def _part(title: str, arrays: Mapping[str, np.ndarray]) -> str:
    return f"<{title}>\n{''.join(_array(*one) for one in arrays.items())}</{title}>\n"


def _array(name: str, values: np.ndarray) -> str:
    """Return an array in base64, behind its number of bytes."""
    kind = {"f": "Float64", "i": "Int64", "u": "UInt8"}[values.dtype.kind]
    content = values.astype(values.dtype.newbyteorder("<")).tobytes()
    text = base64.b64encode(np.array(len(content), "<u8").tobytes() + content).decode()
    parts = "" if values.ndim == 1 else f' NumberOfComponents="{values.shape[1]}"'
    return f'<DataArray type="{kind}" Name="{name}"{parts} format="binary">{text}</DataArray>\n'


def _file(kind: str, content: str) -> str:
    return (
        '<?xml version="1.0"?>\n'
        f'<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n'
        f"<{kind}>\n{content}</{kind}>\n</VTKFile>\n"
    )
