"""Histories of the exact beam as samples that a spline joins, with what both leave unknown."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from analytic import SpinUp, Theory, periodic_orbits, spin_up_response
from analytic.arrays import FloatArray
from analytic.lazily import interpolate

from .cases import Case

_BEYOND = 20  # samples beyond the end, for a last step that is longer


@dataclass(frozen=True, kw_only=True, eq=False)
class Sampled:
    """A history of the tip, sampled.

    Attributes
    ----------
    time, q : ndarray (samples,)
        [s], [m].
    error : float
        Over max|q|: of the samples by the next coarser computation, and of the spline by the
        computation halfway between them.
    """

    time: FloatArray
    q: FloatArray
    error: float


def spline(time: FloatArray, q: FloatArray) -> interpolate.BSpline:
    """Return the quintic spline through samples."""
    return interpolate.make_interp_spline(time, q, k=5)


def sampled_history(
    case: Case, theory: Theory, *, tolerance: float = 1e-6, spacing: float | None = None
) -> Sampled:
    """Compute the history of a case.

    Parameters
    ----------
    case : Case
        That asks for a history.
    theory : Theory
    tolerance : float
        Largest error of a spin-up over max|q|; orbits are known to their residual.
    spacing : float, optional
        Of the samples [s]; without it, some 400 of them in a period.

    Raises
    ------
    RuntimeError
        If the tolerance or the orbit is not reached.
    ValueError
        If theory has no answer, as for a blade that rotation tears.
    """
    assert case.motion is not None
    if spacing is None:
        spacing = 0.015 / max(case.blade.omega_0, case.motion.omega / 3.0)
    count = math.ceil(case.duration / spacing) + _BEYOND
    time = 0.5 * spacing * np.arange(2 * count + 1, dtype=np.float64)
    if isinstance(case.motion, SpinUp):
        found = spin_up_response(
            case.blade, case.motion, time, tolerance=tolerance, loads=case.loads, theory=theory
        )
        q, error = found.q, found.error
    else:
        orbit = periodic_orbits(case.blade, case.motion.omega, case.amplitudes, theory=theory)
        q, error = case.blade.length * orbit.response(time, 0), float(orbit.residual.max())
    between = spline(time[::2], q[::2])(time[1::2]) - q[1::2]
    error += float(np.abs(between).max() / np.abs(q).max())
    return Sampled(time=time[::2], q=q[::2], error=error)
