"""Eq. 41 of the paper's kind of beam: uniform, clamped at the axis, in any variant."""

from __future__ import annotations

import math

from ..beam import AnyBlade
from .coriolis import coriolis_coupling
from .lagrangian import energy_coefficients
from .model_range import better_model
from .oscillator import Oscillator
from .rotating_mode import RotatingMode
from .variants import Variant


def uniform_oscillator(beam: AnyBlade, omega: float, variant: Variant) -> tuple[Oscillator, float]:
    """Return Eq. 41 at ω [rad/s], and the tip displacement per x·dx/dτ of all other modes.

    Raises
    ------
    ValueError
        If the variant has no oscillation at that speed.
    """
    w_bar = omega / beam.frequency_scale
    shape = variant.shape_at(w_bar)
    coefficients = energy_coefficients(shape, variant.axial)
    square = coefficients.omega_n_squared(w_bar, beam.slenderness)
    if square <= 0.0:
        raise ValueError(
            f"{variant.name} has no oscillation at omega = {omega:g} rad/s: ω_n² = {square:.4g} "
            f"EI/(mL³) there; lower omega, or {better_model(w_bar)}"
        )
    g2, tip = coefficients.g2, 0.0
    if variant.coriolis and isinstance(shape, RotatingMode):
        coupling = coriolis_coupling(shape)
        g2, tip = g2 + coupling.g2, coupling.tip
    return Oscillator(w_n=math.sqrt(square), g1=coefficients.g1(w_bar), g2=g2), tip
