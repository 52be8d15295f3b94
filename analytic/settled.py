"""Refinement until it changes nothing."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

SizeT = TypeVar("SizeT")
FoundT = TypeVar("FoundT")


def settled(
    solve: Callable[[SizeT], FoundT],
    sizes: Iterator[SizeT],
    tolerance: float,
    of: Callable[[FoundT], ArrayLike],
    what: str,
    remedy: str,
    *,
    left: float = 0.0,
) -> tuple[FoundT, FoundT, float]:
    """Return a result, the finer result that confirms it, and the largest change.

    They are the first two in a row whose numbers `of` a result agree to the tolerance; logarithms
    give relative changes. Of all sizes the last two may differ by what is `left`; by more they are
    refused in a sentence that says in `what` and ends on the `remedy`.
    """
    found, change = solve(next(sizes)), math.inf
    for size in sizes:
        before, found = found, solve(size)
        change = float(np.max(np.abs(np.subtract(of(found), of(before)))))
        if change <= tolerance:
            return before, found, change
    if change > left:
        raise ValueError(f"the finest two solutions differ by {change:.1e} in {what}; {remedy}")
    return before, found, change


def refined(
    size: SizeT, finer: Callable[[SizeT], SizeT], last: Callable[[SizeT], bool]
) -> Iterator[SizeT]:
    """Yield a size and ever finer ones, until one is the last."""
    yield size
    while not last(size):
        size = finer(size)
        yield size
