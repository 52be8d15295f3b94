"""Stability of the steady rotation where it can be lost: linear elastic frames in a row."""

from __future__ import annotations

from collections.abc import Sequence

from analytic import Beam
from analytic.beam import require_planar
from analytic.input_checks import whole_number

from ..lazily import xr
from .elements.linear_frames import FloatingFrame, Substructures


def divergence_speed(
    beam: Beam, substructures: int, frame: FloatingFrame = "tangent", *, cells: int = 2
) -> float:
    """Return the speed [rad/s] above which a beam of linear substructures diverges.

    Where the lowest eigenvalue of the stiffness about the rotating steady state, centrifugal
    terms included, passes zero. One substructure with a tangent frame is the linear beam, whose
    divergence speed is ω0; a fully nonlinear model has none (Sec. 1).

    Parameters
    ----------
    beam : Beam
        The beam.
    substructures : int
        Number of substructures.
    frame : {"tangent", "pinned"}
        What their frames follow.
    cells : int
        Cubic finite elements in each; two are within 5e-4 of many with tangent frames, and
        within 1 % with pinned ones.

    Raises
    ------
    ValueError
        If an input is refused.

    Examples
    --------
    >>> from analytic import Beam
    >>> from rotbeam_exu.fem.stability import divergence_speed
    >>> for substructures in (1, 2, 4):
    ...     print(f"{substructures}: {divergence_speed(Beam.reference(), substructures):.4f} rad/s")
    1: 2.9106 rad/s
    2: 4.4510 rad/s
    4: 8.3581 rad/s
    """
    require_planar(beam)
    model = Substructures(frame=frame, cells=cells)
    return model.divergence_speed(beam, whole_number("substructures", substructures))


def divergence_speeds(beam: Beam, counts: Sequence[int], *, cells: int = 2) -> xr.Dataset:
    """Return the divergence speed [rad/s] of both frames over numbers of substructures.

    Returns
    -------
    Dataset
        `divergence_speed` over `frame` and `substructures`; attribute omega_0: the beam's [rad/s].
    """
    frames: tuple[FloatingFrame, ...] = ("tangent", "pinned")
    values = [[divergence_speed(beam, n, f, cells=cells) for n in counts] for f in frames]
    attrs = {"units": "rad/s", "long_name": "divergence speed"}
    return xr.Dataset(
        {"divergence_speed": (("frame", "substructures"), values, attrs)},
        coords={
            "frame": list(frames),
            "substructures": (
                "substructures", list(counts), {"long_name": "number of substructures"}
            ),
        },
        attrs={"omega_0": beam.omega_0, "cells": cells},
    )  # fmt: skip
