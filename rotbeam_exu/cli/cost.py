"""What would not fit into memory or end in time is refused by an estimate, before it starts."""

from __future__ import annotations

_LARGEST_MEMORY = 8e9
"""Bytes."""

_DAY = 86400.0


def require_affordable(
    what: str, *, memory: float = 0.0, seconds: float = 0.0, days: float = 1.0, remedy: str
) -> None:
    """Refuse what needs more than 8 GB or more than some days, estimated from below.

    Parameters
    ----------
    what
        What is asked for, with its number.
    memory, seconds
        Estimates [bytes, s].
    days
        The longest that is let through [d].
    remedy
        What to do instead.
    """
    if memory > _LARGEST_MEMORY:
        raise ValueError(
            f"{what} would take about {memory / 1e9:.3g} GB of memory, more than "
            f"{_LARGEST_MEMORY / 1e9:g} GB: {remedy}"
        )
    if seconds > days * _DAY:
        raise ValueError(
            f"{what} would take about {seconds / _DAY:.3g} days, more than {days:g}: {remedy}"
        )
