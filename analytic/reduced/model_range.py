"""Reduced models of a blade: their ranges, with warnings beyond them, and where they soften."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ..beam import Beam
from ..blade import Blade
from ..blade_checks import require_planar, require_undamped, warn_if_rpm
from ..input_checks import rotation_speed
from ..lazily import optimize
from ..threads import one_thread
from ..unit_blade import UNIFORM
from ..warning import warn
from .any_blade import blade_oscillator
from .lagrangian import energy_coefficients
from .model import ReducedModel
from .oscillator import Oscillator
from .variants import Variant, variant_named

_PAPER_SPEED_RATIO = 2.0
"""The paper ends at 8 rad/s, about twice ω_n there, and expects higher modes beyond (Sec. 6)."""
_RESONANCE_BAND = 0.1
_NOTICEABLE_SHIFT = 2e-4
"""Shift of λ_ω by the extension: 1 % of its size, which is about 0.02 at rest and when fast."""
_NOTICEABLE_STRETCH = 2e-3
"""Relative change of ω_n by the extension."""
_HIGHEST_SPEED_RATIO = 4.0


@one_thread
def reduced_model(blade: Blade, omega: float, variant: str | Variant = "FrE") -> ReducedModel:
    """Return a reduced model of the rotating beam, Eq. 41 with the coefficients of `variant`.

    Parameters
    ----------
    blade : Blade
    omega : float
        Rotation speed ω [rad/s], zero or positive.
    variant : str or Variant
        "CI", "CE", "FrI", "FrE", "P3", "P4", "P5" of the paper, "FrC", "FrM" or "FrM5" of ours, or
        any other setting of the switches. A blade that is not the paper's kind of beam takes ours.

    Raises
    ------
    ValueError
        If `omega` is negative or not finite, the variant unknown, or the model has no oscillation;
        if the variant leaves out something that the blade has, such as damping.

    Warns
    -----
    RotbeamWarning
        If the model is used beyond its range: ω above 2ω_n without the other modes, 2ω_n near
        another mode with them, or a beam so stocky or fast that FrM's missing extension shows. If ω
        is above the burst speed, or so large that it may be meant in rpm.

    Examples
    --------
    >>> from analytic import Beam, reduced_model
    >>> model = reduced_model(Beam.reference(), omega=6.0, variant="FrE")
    >>> round(model.omega_n, 6), round(model.lambda_omega, 5)
    (3.730549, 0.02355)
    """
    omega, variant = rotation_speed(omega), variant_named(variant)
    require_undamped(blade, "the reduced models have no damping")
    model = model_at(blade, omega, variant)
    warn_if_rpm(blade, omega)
    warn_beyond_range(model)
    return model


def model_at(blade: Blade, omega: float, variant: Variant) -> ReducedModel:
    """Return what `reduced_model` returns, without checks and warnings: for scans over ω."""
    w_bar = omega / blade.frequency_scale
    if variant.is_of_any_blade:
        oscillator = blade_oscillator(blade.unit, w_bar, variant.coriolis).oscillator
        return ReducedModel(blade=blade, omega=omega, variant=variant, oscillator=oscillator)
    if blade.unit != UNIFORM:
        raise ValueError(
            f"{variant.name} is for the uniform beam clamped at the axis, and this blade has "
            f"{blade.unit.differences}: take FrM"
        )
    energy = energy_coefficients(variant.shape_at(w_bar), variant.axial)
    square = energy.omega_n_squared(w_bar, blade.slenderness)
    if square <= 0.0:
        raise ValueError(
            f"{variant.name} has no oscillation at omega = {omega:g} rad/s: ω_n² = {square:.4g} "
            "EI/(mL³) there; lower omega, or take FrM"
        )
    oscillator = Oscillator(w_n=math.sqrt(square), g1=energy.g1(w_bar), g2=energy.g2)
    return ReducedModel(blade=blade, omega=omega, variant=variant, oscillator=oscillator)


def softening_speed(blade: Beam, variant: str | Variant = "FrM") -> float | None:
    """Return the speed [rad/s] at which the model turns from hardening to softening.

    FrM, and with it the exact inextensible beam, does so at Ω = ω/ω0 = 1.02190; the exact
    extensible one a little earlier, the paper's at 2.97214 rad/s or Ω = 1.02162. None if λ_ω does
    not rise through zero up to Ω = 4: such a model softens, or hardens, at every speed of interest.

    Examples
    --------
    >>> from analytic import Beam
    >>> from analytic.reduced.model_range import softening_speed
    >>> print(f"{softening_speed(Beam.reference(), 'FrM'):.4f} rad/s")
    2.9730 rad/s
    """
    require_planar(blade)
    setting = variant_named(variant)

    def lambda_omega(speed_ratio: float) -> float:
        return model_at(blade, speed_ratio * blade.omega_0, setting).lambda_omega

    speeds = np.linspace(0.0, _HIGHEST_SPEED_RATIO, 21)
    softens = np.array([lambda_omega(s) > 0.0 for s in speeds])
    turns = np.flatnonzero(~softens[:-1] & softens[1:])
    if turns.size == 0:
        return None
    first = turns[0]
    ratio = optimize.brentq(lambda_omega, speeds[first], speeds[first + 1], xtol=1e-12)
    return float(ratio) * blade.omega_0


def warn_beyond_range(model: ReducedModel) -> None:
    """Warn where modes or extension that a model leaves out matter, or modes are resonant."""
    blade, omega, variant = model.blade, model.omega, model.variant
    scale = blade.frequency_scale
    w_bar = omega / scale
    if omega >= blade.burst_speed:
        warn(
            f"omega = {omega:g} rad/s is above {blade.burst_speed:.6g} rad/s, at which the "
            f"rotation stretches this beam without bound: {variant.name} does not know of it and "
            "oscillates about a steady state that the beam does not have; rotate slower"
        )
    elif variant.coriolis:
        _warn_if_extended(blade, w_bar, model.lambda_omega)
        others = blade_oscillator(blade.unit, w_bar, True).others
        warn_if_resonant(model.omega_n, [scale * other for other in others])
    elif blade.unit == UNIFORM and omega > _PAPER_SPEED_RATIO * blade.omega_0:
        # The rotating beam's first frequency is never below ω0, so it is needed only here.
        mode = blade_oscillator(UNIFORM, w_bar, False)
        first, second = scale * mode.oscillator.w_n, scale * mode.others[0]
        if omega > _PAPER_SPEED_RATIO * first:
            warn(
                f"omega = {omega:g} rad/s is {omega / first:.2f} times the rotating beam's first "
                f"frequency ({first:.4g} rad/s): beyond {_PAPER_SPEED_RATIO:g}, where the paper "
                f"ends, the second mode ({second:.4g} rad/s), which {variant.name} leaves out, "
                "matters; take FrM"
            )


def _warn_if_extended(blade: Blade, w_bar: float, lambda_omega: float) -> None:
    """Warn where the extension, which FrM leaves out, changes λ_ω or ω_n noticeably."""
    mu = blade.slenderness
    # A hub adds to the tension, and so to the stretch, and less to what ω_n loses by it.
    hub = blade.unit.hub
    shift, stretch = 4.0 * mu, mu * w_bar**2 * (1.0 + 2.0 * hub)
    size = f"up to μ w_bar² (1 + {2.0 * hub:.3g})" if hub else "about μ w_bar²"
    if shift > _NOTICEABLE_SHIFT or stretch > _NOTICEABLE_STRETCH:
        warn(
            f"FrM is inextensible, but this beam has the slenderness μ = I/(AL²) = {mu:.2g}: its "
            f"λ_ω is higher than FrM's {lambda_omega:.4f} by about 4μ = {shift:.1e}, and its ω_n "
            f"lower by {size} = {stretch:.1e} of it; take periodic_orbits"
        )


def warn_if_resonant(omega_n: float, others: Sequence[float]) -> None:
    """Warn where 2ω_n comes within 10 % of one of the `others` [rad/s]: FrM divides by the gap.

    A uniform cantilever never gets there: its ω_2 stays above 3 times 2ω_n at any rotation speed.
    """
    for other in others:
        gap = other / (2.0 * omega_n) - 1.0
        if abs(gap) < _RESONANCE_BAND:
            warn(
                f"2ω_n = {2.0 * omega_n:.4g} rad/s is {abs(gap):.1%} from another mode at "
                f"{other:.4g} rad/s: FrM's elimination of that mode fails near resonance; take "
                f"periodic_orbits"
            )
