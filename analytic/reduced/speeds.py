"""Speeds at which a model changes: it diverges, or hardening turns into softening."""

from __future__ import annotations

import math

import numpy as np

from ..beam import Beam, require_planar
from ..lazily import optimize
from .lagrangian import energy_coefficients
from .model import model_at
from .shapes import CantileverMode
from .variants import Variant, variant_named

_HIGHEST_SPEED_RATIO = 4.0


def softening_speed(beam: Beam, variant: str | Variant = "FrM") -> float | None:
    """Return the speed [rad/s] at which the model turns from hardening to softening.

    FrM, and with it the exact inextensible beam, does so at Ω = ω/ω0 = 1.02190; the exact
    extensible one a little earlier, the paper's at 2.97214 rad/s or Ω = 1.02162. None if λ_ω does
    not rise through zero up to Ω = 4: such a model softens, or hardens, at every speed of interest.

    Examples
    --------
    >>> from analytic import Beam
    >>> from analytic.reduced.speeds import softening_speed
    >>> print(f"{softening_speed(Beam.reference(), 'FrM'):.4f} rad/s")
    2.9730 rad/s
    """
    require_planar(beam)
    setting = variant_named(variant) if isinstance(variant, str) else variant

    def lambda_omega(speed_ratio: float) -> float:
        return model_at(beam, speed_ratio * beam.omega_0, setting).lambda_omega

    speeds = np.linspace(0.0, _HIGHEST_SPEED_RATIO, 21)
    softens = np.array([lambda_omega(s) > 0.0 for s in speeds])
    turns = np.flatnonzero(~softens[:-1] & softens[1:])
    if turns.size == 0:
        return None
    first = turns[0]
    ratio = optimize.brentq(lambda_omega, speeds[first], speeds[first + 1], xtol=1e-12)
    return float(ratio) * beam.omega_0


def divergence_speed(beam: Beam) -> float:
    """Return the speed [rad/s] at which the linear model, Eq. 45, becomes unstable: Ω = 1.

    Examples
    --------
    >>> from analytic import Beam
    >>> from analytic.reduced.speeds import divergence_speed
    >>> print(f"{divergence_speed(Beam.reference()):.4f} rad/s")
    2.9092 rad/s
    """
    require_planar(beam)
    linear = energy_coefficients(CantileverMode(), "none")
    return math.sqrt(-linear.bending / linear.spin) * beam.frequency_scale
