"""Refinement until an answer changes by no more than a tolerance.

One rule for all: an answer that misses its tolerance comes with a warning, and one whose last
change is above 1e-3 is refused.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from .input_checks import positive
from .warning import warn

SizeT = TypeVar("SizeT")
ResultT = TypeVar("ResultT")

KNOWN = 1e-3
"""Largest change of the finest two solutions with which there is an answer."""
_FINEST = 1e-12  # least tolerance above round-off
ROUND_OFF = 1e-9
"""Largest change that is round-off once it no longer falls."""


def require_tolerance(tolerance: float | None, default: float) -> float:
    """Return a tolerance or the default; refuse one below round-off, and one above 1e-3."""
    if tolerance is None:
        return default
    if not _FINEST <= positive("tolerance", tolerance) <= KNOWN:
        raise ValueError(
            f"tolerance must be from {_FINEST:g}, which round-off allows, to {KNOWN:g}, got "
            f"{tolerance:g}"
        )
    return float(tolerance)


def settled(
    solve: Callable[[SizeT], ResultT],
    sizes: Iterator[SizeT],
    tolerance: float,
    of: Callable[[ResultT], ArrayLike],
    what: str,
    remedy: str,
    *,
    left: float | None = None,
    falls: float = 1.0,
) -> tuple[ResultT, ResultT, float]:
    """Return a result, the finer result that confirms it, and its error, the change between them.

    Parameters
    ----------
    solve : callable
        Solution on one size.
    sizes : iterator
        From coarse to fine; it ends with the finest that is allowed.
    tolerance : float
        The first two neighbors that differ by no more are the answer.
    of : callable
        Numbers of a solution that are compared; of logarithms the changes are relative.
    what, remedy : str
        Name of these numbers and advice, for the warning and the error.
    left : float, optional
        Largest change of the last two sizes that is taken without a warning. By default 1e-3 is
        taken, with one.
    falls : float
        Least factor by which the first refinement lessens the error, where trials have shown one.
        Where the change over it is within the tolerance, the second size is the answer.

    Raises
    ------
    ValueError
        If the last two sizes differ by more.
    """
    finest, change = solve(next(sizes)), math.inf
    for size in sizes:
        (coarser, finest), previous = (finest, solve(size)), change
        change = float(np.max(np.abs(np.subtract(of(finest), of(coarser)))))
        if change <= tolerance or previous <= 2.0 * change <= ROUND_OFF:
            break
        if previous == math.inf and max(change / falls, ROUND_OFF) <= tolerance:
            return finest, finest, max(change / falls, ROUND_OFF)
    judged(change, tolerance, what, remedy, left=left)
    return coarser, finest, change


def judged(
    change: float, tolerance: float, what: str, remedy: str, *, left: float | None = None
) -> None:
    """Warn of a change of the finest two solutions beyond the tolerance, or refuse it."""
    if change <= tolerance:
        return
    sentence = f"the finest two solutions differ by {change:.1e} in {what}"
    if change > (KNOWN if left is None else left):
        raise ValueError(f"{sentence}; {remedy}")
    if left is None:
        warn(f"{sentence}, more than the tolerance of {tolerance:g}: take a larger one, {remedy}")


def refined(
    size: SizeT, finer: Callable[[SizeT], SizeT], last: Callable[[SizeT], bool]
) -> Iterator[SizeT]:
    """Yield a size and ever finer ones, until one is the last."""
    yield size
    while not last(size):
        size = finer(size)
        yield size
