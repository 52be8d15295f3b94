"""The line of a blade through key points, as BeamDyn's and HAWC2's files have it, and back."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from analytic import Blade, Section
from analytic.arrays import FloatArray, stations
from analytic.exact.continuum.unit import space_unit
from analytic.lazily import integrate, interpolate
from analytic.parts import STRAIGHT, Line
from analytic.section import OutOfPlane

_ROUNDS, _CLOSE = 60, 1e-12  # over the length
_ON_A_LINE = 1e-9  # of the largest curvature
_ANY = Section(
    axial_stiffness=1.0, bending_stiffness=1.0, mass_per_length=1.0,
    out_of_plane=OutOfPlane(bending_ratio=1.0, torsion_ratio=1.0),
)  # fmt: skip
"""A section for the unloaded line, which has no part in it."""


def line_through(points: FloatArray, angles: FloatArray) -> tuple[float, Line]:
    """Return the length [m] and the line through key points, with sections twisted there.

    The curvatures are linear between the points, as those of a cubic spline; the line leaves the
    clamp along axis 1, and its last two cells are one piece.

    Parameters
    ----------
    points : array (points, 3)
        [m], from the clamp, along axis 1 of the root, its chord and its thickness.
    angles : array (points,)
        Twist [rad]: the thickness of a section is normal to the line and, seen along axis 1, turned
        by it, from the chord to the thickness.

    Raises
    ------
    ValueError
        If no line is found, as through points that turn back.
    """
    if not points[:, 1:].any():
        return float(points[-1, 0]), Line(twist=_pairs(points[:, 0], angles))
    at = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))))
    bows, twist = np.zeros((at.size, 2)), angles.copy()
    for _ in range(_ROUNDS):
        line = Line(twist=_pairs(at, twist), prebend=_pairs(at, bows[:, 0]),
                    sweep=_pairs(at, bows[:, 1]))  # fmt: skip
        places, axes = unloaded(Blade(length=at[-1], section=_ANY, line=line), at)
        missed = points - places
        wanted = np.stack([np.zeros_like(angles), -np.sin(angles), np.cos(angles)], axis=1)
        wanted[:, 0] = -np.sum(wanted * axes[:, :, 0], axis=1) / axes[:, 0, 0]
        turn = np.arctan2(*(sign * np.sum(wanted * axes[:, :, k], axis=1)
                            for sign, k in ((-1.0, 1), (1.0, 2))))  # fmt: skip
        if max(np.abs(missed).max() / at[-1], np.abs(turn).max()) < _CLOSE:
            return float(at[-1]), replace(
                line, twist=_sparse(at, twist), prebend=_sparse(at, bows[:, 0]),
                sweep=_sparse(at, bows[:, 1]),
            )  # fmt: skip
        spline = interpolate.CubicSpline(at, missed, bc_type=((1, np.zeros(3)), "not-a-knot"))
        # Turning φ of the line moves it by φ × t a length: φ = t × m', of which κ is the slope.
        t = axes[:, :, 0]
        slope = bows[:, 1:] * axes[:, :, 1] - bows[:, :1] * axes[:, :, 2]
        turning = np.cross(t, spline(at, 2)) + np.cross(slope, spline(at, 1))
        bows = bows + np.einsum("pij,pi->pj", axes, turning)[:, 1:]
        # In axes of the section, too, the last two cells are one piece.
        share = (at[-1] - at[-3]) / (at[-2] - at[-3])
        bows[-1] = bows[-3] + share * (bows[-2] - bows[-3])
        twist = twist + turn
        beyond = integrate.cumulative_trapezoid(np.sum(missed * slope, axis=1), at, initial=0)
        at = at + np.sum(missed * t, axis=1) - beyond
        if not np.all(np.diff(at) > 0.0):
            break
    raise ValueError(
        "no line goes through the key points: let them ascend along the blade, and bend by less "
        "than half a turn"
    )


def key_points(blade: Blade) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return places along the line [m], points and angles of `line_through` there.

    At the stations of section and line, and midway where the line is curved, so that it is found
    again, or where there are less than three.
    """
    line = blade.line
    inner = [x for one in (line.twist, line.prebend, line.sweep) for x in stations(one)]
    at = np.unique([0.0, blade.length, *getattr(blade.section, "x", ()), *inner])
    if at.size < 3 or replace(line, twist=0.0, precone=0.0) != STRAIGHT:
        at = np.sort(np.concatenate((at, 0.5 * (at[1:] + at[:-1]))))
    places, axes = unloaded(replace(blade, setting_angle=0.0), at)
    return at, places, np.unwrap(np.arctan2(-axes[:, 1, 2], axes[:, 2, 2]))


def unloaded(blade: Blade, at: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the unloaded line [m] at places [m], (places, 3), and its sections' axes."""
    places, axes = space_unit(blade).unloaded(at / blade.length)
    return blade.length * places, axes


def _pairs(at: FloatArray, values: FloatArray) -> tuple[tuple[float, float], ...]:
    return tuple(zip(at.tolist(), values.tolist(), strict=True))


def _sparse(at: FloatArray, values: FloatArray) -> tuple[tuple[float, float], ...]:
    """Return stations of a profile without those on the straight line between their neighbors."""
    between = values[:-2] + np.diff(at)[:-1] / (at[2:] - at[:-2]) * (values[2:] - values[:-2])
    off = np.abs(values[1:-1] - between) > _ON_A_LINE * np.abs(values).max()
    kept = np.concatenate(([True], off, [True]))
    return _pairs(at[kept], values[kept])
