"""Refinement until it changes no more than a tolerance, or an answer with the change that is left.

One rule for all: an answer short of its tolerance comes with a warning; one that is not known to
1e-3 is refused.
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
FoundT = TypeVar("FoundT")

KNOWN = 1e-3
"""Change of the finest two solutions beyond which there is no answer."""
_FINEST = 1e-12  # the least tolerance that round-off leaves in reach
ROUND_OFF = 1e-9
"""Change below which one that no longer falls is round-off."""


def require_tolerance(tolerance: float | None, default: float) -> float:
    """Return a tolerance, or that by default; refuse one out of reach, and one of no digits."""
    if tolerance is None:
        return default
    if not _FINEST <= positive("tolerance", tolerance) <= KNOWN:
        raise ValueError(
            f"tolerance must be from {_FINEST:g}, which round-off allows, to {KNOWN:g}, got "
            f"{tolerance:g}"
        )
    return float(tolerance)


def settled(
    solve: Callable[[SizeT], FoundT],
    sizes: Iterator[SizeT],
    tolerance: float,
    of: Callable[[FoundT], ArrayLike],
    what: str,
    remedy: str,
    *,
    left: float | None = None,
) -> tuple[FoundT, FoundT, float]:
    """Return a result, the finer result that confirms it, and the largest change.

    They are the first two in a row whose numbers `of` a result agree to the tolerance; logarithms
    give relative changes. Of all sizes the last two may differ by 1e-3, with a warning; or by what
    is `left`, without. By more they are refused. Both sentences say in `what`, and end on the
    `remedy`.
    """
    found, change = solve(next(sizes)), math.inf
    for size in sizes:
        (before, found), last = (found, solve(size)), change
        change = float(np.max(np.abs(np.subtract(of(found), of(before)))))
        if change <= tolerance or last <= 2.0 * change <= ROUND_OFF:
            break
    judged(change, tolerance, what, remedy, left=left)
    return before, found, change


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
