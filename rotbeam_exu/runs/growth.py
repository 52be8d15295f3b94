"""Growth out of the plane of rotation of a run in space: a rate from its envelope."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from analytic.arrays import FloatArray

from ..lazily import xr
from .oscillation import frequency_guess

SMALL = 1e-2
"""Deflection out of the plane over L up to which the growth is that of small motion."""

_DECADES = 3.0
"""Powers of ten below it over which the growth is measured, at most."""


@dataclass(frozen=True, kw_only=True)
class GrowthRate:
    """Growth out of the plane; see `growth_rate_of`.

    Attributes
    ----------
    rate : float
        Of the envelope [1/s]; negative where it decays.
    decades : float
        Powers of ten over which it was measured.
    period : float
        Of the oscillation in the plane [s].
    """

    rate: float
    decades: float
    period: float


def growth_rate_of(run: xr.Dataset) -> GrowthRate:
    """Return how fast the motion out of the plane grows, from its envelope.

    The envelope is the root mean square over a whole period of the oscillation in the plane, of w
    and w_dot/Ω, at every sample. What its logarithm gains in whole periods is averaged over the
    last three powers of ten up to a hundredth of the length: what does not grow has been left
    behind by then.

    Parameters
    ----------
    run : Dataset
        As made by `simulate` with an element in space, over at least two periods of the
        oscillation in the plane.

    Raises
    ------
    ValueError
        If the run has no w, is shorter than two periods, has no oscillation in the plane, or grows
        too fast to be measured.

    Examples
    --------
    >>> import numpy as np
    >>> import xarray as xr
    >>> from rotbeam_exu.runs.growth import growth_rate_of
    >>> time = np.linspace(0.0, 40.0, 4001)
    >>> w = 1e-6 * np.exp(0.5 * time)  # stands for a run in space
    >>> tip = {"q": np.sin(3.0 * time), "w": w, "w_dot": 0.5 * w}
    >>> run = xr.Dataset(
    ...     {name: ("time", values) for name, values in tip.items()},
    ...     coords={"time": time},
    ...     attrs={"ramp_time": 0.0, "beam_length": 8.0},
    ... )
    >>> print(f"{growth_rate_of(run).rate:.4f} 1/s")
    0.5000 1/s
    """
    for name in ("q", "w", "w_dot"):
        if name not in run:
            raise ValueError(
                f"the run has no {name}: simulate it with an element in space, as 'space_exact'"
            )
    ramp_time, length = float(run.attrs["ramp_time"]), float(run.attrs["beam_length"])
    steady = run.sel(time=run["time"] >= ramp_time)
    time, q = steady["time"].to_numpy(), steady["q"].to_numpy() / length
    period = 2.0 * math.pi / frequency_guess(time - time[0], q, ramp_time)
    if time[-1] - time[0] < 2.0 * period:
        raise ValueError(
            f"a growth needs two periods of {period:.4g} s after the ramp, and the run has "
            f"{time[-1] - time[0]:.4g} s: take a duration above "
            f"{ramp_time + 2.0 * period:.4g} s"
        )
    w, w_dot = steady["w"].to_numpy(), steady["w_dot"].to_numpy()
    squares = (w / length) ** 2 + (w_dot / length * period / (2.0 * math.pi)) ** 2
    envelope, at = _over_a_period(time, squares, period)
    rate, fitted = _fitted(at, envelope, period)
    return GrowthRate(rate=rate, decades=fitted, period=period)


def _over_a_period(
    time: FloatArray, squares: FloatArray, period: float
) -> tuple[FloatArray, FloatArray]:
    """Return the root of the mean over a period from each sample on, and those times."""
    steps = 0.5 * np.diff(time) * (squares[1:] + squares[:-1])
    # Sums of positive numbers over many decades: each window anew, not as a difference of two.
    ends = np.searchsorted(time, time + period)
    starts = np.flatnonzero(ends < time.size)
    mean = np.array([steps[i : ends[i]].sum() for i in starts]) / period
    return np.sqrt(mean), time[starts]


def _fitted(time: FloatArray, envelope: FloatArray, period: float) -> tuple[float, float]:
    """Return the rate at which the envelope grows [1/s], and over how many decades.

    The mean of ln A(t + kT) - ln A(t) over kT, with k whole periods about half of the range:
    within a period the envelope of a growing motion is no straight line.
    """
    above = np.flatnonzero(envelope > SMALL)
    end = int(above[0]) if above.size else envelope.size
    logarithm = np.log(np.maximum(envelope[:end], np.finfo(float).tiny))
    lower = logarithm[-1] - _DECADES * math.log(10.0) if end else math.inf
    start = int(np.flatnonzero(logarithm >= lower)[0]) if end else 0
    span = time[end - 1] - time[start]
    if end < 2 or span <= period:
        raise ValueError(
            f"the motion out of the plane grows through the last {_DECADES:g} powers of ten below "
            f"{SMALL:g} of the length in less than a period: start with a smaller kick"
        )
    lag = max(1, int(0.5 * span / period)) * period
    later = np.interp(time[start:end] + lag, time[:end], logarithm, right=np.nan)
    rate = float(np.nanmean(later - logarithm[start:]) / lag)
    return rate, float((logarithm[-1] - logarithm[start]) / math.log(10.0))
