"""The class of all warnings, apart from what needs NumPy."""

from __future__ import annotations


class RotbeamWarning(UserWarning):
    """Input or a result that is legal but probably not what was meant.

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
