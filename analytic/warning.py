"""The warnings of both packages, apart from what needs NumPy."""

from __future__ import annotations

import sys
import warnings
from typing import Any


class RotbeamWarning(UserWarning):
    """Input or a result that is legal but probably not intended.

    All warnings of both packages are of this class, and silenced by it.

    Examples
    --------
    >>> import warnings
    >>> from analytic import Beam, RotbeamWarning, linear_modes
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("ignore", RotbeamWarning)
    ...     modes = linear_modes(Beam.reference(), 60.0, 1)  # no rpm
    >>> print(f"{modes.frequencies[0]:.3f} rad/s")
    10.270 rad/s
    """


def warn(sentence: str) -> None:
    """Warn at the caller's line: the nearest that is in neither package."""
    frame, level = sys._getframe(1), 2
    while frame.f_back and frame.f_globals["__name__"].split(".")[0] in ("analytic", "rotbeam_exu"):
        frame, level = frame.f_back, level + 1
    warnings.warn(sentence, RotbeamWarning, stacklevel=level)


class PartialError(RuntimeError):
    """An error with the `part` of its result that there is, None if there is none."""

    def __init__(self, message: str, part: Any = None) -> None:
        super().__init__(message)
        self.part = part
