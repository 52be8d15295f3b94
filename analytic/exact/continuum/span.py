"""Places of a blade on which a load acts by a law along the span."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ...arrays import FloatArray
from ...quadrature import Grid, Running
from .vectors import Frames

if TYPE_CHECKING:
    from .unit import SpaceUnit

_LAW = 2  # points more on a cell, for a law that is linear there


class Span:
    """Places of a load, weights of their sum, and sections there; lengths over that of the blade.

    Parameters
    ----------
    grid : Grid
        Of the fields.
    stations : tuple of float
        As of a `Load`: between two of them the law is smooth.
    blade : SpaceUnit, optional
        Whose sections are wanted.
    """

    def __init__(
        self, grid: Grid, stations: tuple[float, ...], blade: SpaceUnit | None = None
    ) -> None:
        if len(stations) < 2:
            self.x, self.weights = np.array(stations or (1.0,)), np.ones(1)
        else:
            inner = np.array(stations)
            ends = np.union1d(inner, grid.ends[(grid.ends > inner[0]) & (grid.ends < inner[-1])])
            cell = np.searchsorted(grid.ends, 0.5 * (ends[1:] + ends[:-1])) - 1
            share = np.diff(ends) / np.diff(grid.ends)[cell]
            counts = np.ceil(grid.counts[cell] * np.sqrt(share)).astype(np.intp) + _LAW
            own = Grid(ends, counts)
            self.x, self.weights = own.points, own.weights
        self.running = Running(grid, self.x)
        self._grid, self._blade = grid, blade

    def beyond(self, acting: FloatArray) -> FloatArray:
        """Return sums of a load (..., places) beyond each point of the grid, times its weight."""
        return self.running.beyond(acting)

    @cached_property
    def _frames(self) -> tuple[Frames, FloatArray]:
        assert self._blade
        to_x = self._blade.running(self._grid, self.x)
        return Frames(to_x, self._blade.kinks), self._blade.section_frames(self.x)

    def sections(self, curvature: FloatArray) -> FloatArray:
        """Return the axes of the sections in the root frame, (3, 3, samples, places)."""
        frames, sections = self._frames
        own = frames.of(curvature)[..., self._grid.points.size :]
        return np.asarray(np.einsum("ijsp,jkp->iksp", own, sections))
