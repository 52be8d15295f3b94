"""A run in space as a picture, by Exudyn's own ray tracer, which needs no display."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import exudyn
import numpy as np
import xarray as xr
from exudyn import graphics
from exudyn.itemInterface import ObjectGround, VObjectGround
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from analytic.arrays import FloatArray
from analytic.input_checks import finite_array

_WIDTH = 0.05
"""Height of the drawn sections over L: as drawn to scale a slender blade is a hair."""

_Color = tuple[float, float, float, float]

_FLOOR: _Color = (0.86, 0.86, 0.84, 1.0)

_COLORS: tuple[_Color, ...] = (
    (0.12, 0.36, 0.60, 1.0),
    (0.16, 0.55, 0.50, 1.0),
    (0.55, 0.62, 0.22, 1.0),
    (0.88, 0.60, 0.15, 1.0),
    (0.78, 0.25, 0.20, 1.0),
)


_FLOOR_SIZE = 1.1
"""Half the length of the floor, a square below all that the blade can reach, over L."""


def ray_traced(
    run: xr.Dataset,
    times: Sequence[float],
    *,
    size: tuple[int, int] = (1200, 700),
) -> NDArray[np.uint8]:
    """Return a picture of the blade at some times, an RGB array (height, width, 3).

    Seen from the clamp's frame, whose plane of rotation is the floor, with all that the blade can
    reach; early times are blue, late ones red. Sections are drawn as strips of one height, along
    the axis that is in the plane at rest, so that bending in the plane and twist are seen.

    Parameters
    ----------
    run : Dataset
        As made by `simulate` with element="space_exact".
    times : sequence of float
        When [s]; the nearest samples are drawn.
    size : tuple of int
        Of the picture, width and height [pixels].

    Raises
    ------
    ValueError
        If the run does not say how its sections stand.

    Examples
    --------
    >>> from analytic import Beam, SpinUp, Tube
    >>> from rotbeam_exu import simulate
    >>> from rotbeam_exu.fem.picture import ray_traced
    >>> tube = Beam.reference().with_shape(Tube())
    >>> motion = SpinUp(omega=2.0, ramp_time=1.0)
    >>> settings = {"element": "space_exact", "elements": 4, "duration": 1.5, "step": 5e-3}
    >>> run = simulate(tube, motion, **settings)
    >>> ray_traced(run, times=[0.5, 1.0, 1.5], size=(320, 200)).shape
    (200, 320, 3)
    """
    if "upright" not in run:
        raise ValueError(
            "the run does not say how its sections stand, as the cable's have no direction: "
            "simulate it with element='space_exact'"
        )
    at = finite_array("times", times, "s").ravel()
    length = float(run.attrs["beam_length"])
    frames = run[["axis", "upright"]].sel(time=at, method="nearest")
    shown = [
        _strip(axis, upright, 0.5 * _WIDTH * length, _COLORS[k])
        for axis, upright, k in zip(
            frames["axis"].to_numpy(),
            frames["upright"].to_numpy(),
            np.linspace(0, len(_COLORS) - 1, at.size).round().astype(int),
            strict=True,
        )
    ]
    ends = length * np.array([-_FLOOR_SIZE, _FLOOR_SIZE])
    floor = _surface(np.array([[[x, y, -0.15 * length] for y in ends] for x in ends]), _FLOOR)
    return _rendered([floor, *shown], length, size)


def _strip(axis: FloatArray, upright: FloatArray, half: float, color: _Color) -> dict[str, Any]:
    """Return the strip along `axis` (nodes, 3), its height across to `upright`."""
    along = np.gradient(axis, axis=0)
    across = np.cross(upright, along)
    across *= half / np.linalg.norm(across, axis=1, keepdims=True)
    nodes = np.arange(len(axis))
    edges = CubicSpline(nodes, np.stack((axis - across, axis + across), axis=1))
    return _surface(edges(np.linspace(0, nodes[-1], 8 * nodes[-1] + 1)), color)


def _surface(points: FloatArray, color: _Color) -> dict[str, Any]:
    """Return the triangles between two rows of points, (nodes, 2, 3)."""
    first = 2 * np.arange(len(points) - 1)[:, None]
    triangles = np.concatenate([first + np.array([0, 1, 3]), first + np.array([0, 3, 2])])
    data: dict[str, Any] = graphics.FromPointsAndTrigs(
        points.reshape(-1, 3), triangles, list(color)
    )
    return data


def _rendered(
    surfaces: Sequence[dict[str, Any]], length: float, size: tuple[int, int]
) -> NDArray[np.uint8]:
    """Return the picture of the surfaces of a blade of `length`."""
    container = exudyn.SystemContainer()
    try:
        mbs = container.AddSystem()
        mbs.AddObject(ObjectGround(visualization=VObjectGround(graphicsData=list(surfaces))))
        mbs.Assemble()
        settings = container.visualizationSettings
        settings.view0.window.renderWindowSize = list(size)
        settings.view0.scene.drawCoordinateSystem = False
        settings.view0.window.showComputationInfo = False
        settings.general.showSolverInformation = False
        settings.openGL.multiSampling = 2
        settings.raytracer.multiSampling = 3
        settings.raytracer.numberOfThreads = 1
        settings.raytracer.advanced.showText = False
        container.renderer.ZoomAll()
        container.renderer.SetModelView(
            zoom=0.66 * length,
            rotationVector=[-0.95, 0.0, 0.0],
            centerPoint=[0.0, -0.13 * length, 0.0],
        )
        return np.asarray(container.renderer.RedrawAndGetImage(useRaytracer=True))
    finally:
        container.Reset()
