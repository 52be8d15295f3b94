"""Eq. 41 of the paper's kind of beam: uniform, clamped at the axis, in the paper's variants."""

from __future__ import annotations

import math

from ..beam import AnyBlade
from .lagrangian import energy_coefficients
from .model_range import better_model
from .oscillator import Oscillator
from .variants import Variant


def uniform_oscillator(beam: AnyBlade, omega: float, variant: Variant) -> Oscillator:
    """Return Eq. 41 at ω [rad/s].

    Raises
    ------
    ValueError
        If the variant has no oscillation at that speed.
    """
    w_bar = omega / beam.frequency_scale
    coefficients = energy_coefficients(variant.shape_at(w_bar), variant.axial)
    square = coefficients.omega_n_squared(w_bar, beam.slenderness)
    if square <= 0.0:
        raise ValueError(
            f"{variant.name} has no oscillation at omega = {omega:g} rad/s: ω_n² = {square:.4g} "
            f"EI/(mL³) there; lower omega, or {better_model(w_bar)}"
        )
    return Oscillator(w_n=math.sqrt(square), g1=coefficients.g1(w_bar), g2=coefficients.g2)
