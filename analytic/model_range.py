"""Where a reduced model is used beyond its range, with the numbers that say so."""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import ArrayLike

from .beam import Beam
from .coriolis import rotating_frequencies
from .input_checks import RotbeamWarning
from .variants import Variant

_PAPER_SPEED_RATIO = 2.0
"""The paper ends at 8 rad/s, about twice ω_n there, and expects higher modes beyond (Sec. 6)."""
_RESONANCE_BAND = 0.1


def warn_beyond_range(beam: Beam, omega: float, variant: Variant, w_n: float) -> None:
    """Warn where modes that `variant` leaves out matter, or those it eliminates are resonant."""
    scale = beam.frequency_scale
    if variant.coriolis:
        warn_if_resonant(w_n * scale, rotating_frequencies(omega / scale)[1:] * scale)
    elif omega > _PAPER_SPEED_RATIO * beam.omega_0:
        # The rotating beam's first frequency is never below ω0, so it is needed only here.
        first, second = rotating_frequencies(omega / scale, 2) * scale
        if omega > _PAPER_SPEED_RATIO * first:
            warnings.warn(
                f"omega = {omega:g} rad/s is {omega / first:.2f} times the rotating beam's first "
                f"frequency ({first:.4g} rad/s): beyond {_PAPER_SPEED_RATIO:g}, where the paper "
                f"ends, the second mode ({second:.4g} rad/s), which {variant.name} leaves out, "
                f"matters; take FrM",
                RotbeamWarning,
                stacklevel=3,
            )


def warn_if_resonant(omega_n: float, others: ArrayLike) -> None:
    """Warn where 2ω_n comes within 10 % of one of the `others` [rad/s]: FrM divides by the gap.

    A uniform cantilever never gets there: its ω_2 stays above 3 times 2ω_n at any rotation speed.
    """
    for other in np.atleast_1d(np.asarray(others, dtype=np.float64)):
        gap = other / (2.0 * omega_n) - 1.0
        if abs(gap) < _RESONANCE_BAND:
            warnings.warn(
                f"2ω_n = {2.0 * omega_n:.4g} rad/s is {abs(gap):.1%} from another mode at "
                f"{other:.4g} rad/s: FrM's elimination of that mode fails near resonance; take "
                f"periodic_orbits",
                RotbeamWarning,
                stacklevel=4,
            )
