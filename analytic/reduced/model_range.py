"""Ranges of the reduced models, and warnings beyond them with the numbers that say so."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import FloatArray
from ..beam import AnyBlade
from ..input_checks import finite_array, not_negative
from ..unit_blade import UNIFORM
from ..warning import warn
from .any_blade import blade_oscillator
from .variants import Variant

_PAPER_SPEED_RATIO = 2.0
"""The paper ends at 8 rad/s, about twice ω_n there, and expects higher modes beyond (Sec. 6)."""
_RESONANCE_BAND = 0.1
_NOTICEABLE_SHIFT = 2e-4
"""Shift of λ_ω by the extension: 1 % of its size, which is about 0.02 at rest and when fast."""
_NOTICEABLE_STRETCH = 2e-3
"""Relative change of ω_n by the extension."""
_FASTEST = 500.0
"""w̄ up to which FrM and `periodic_orbits` have enough functions, of slender beams."""


_MEANT = {3: 0.2, 5: 0.4}
"""Amplitudes up to which a model is meant, by its order: the paper's own bound, and FrM5's."""


def amplitudes_within(a: ArrayLike, largest: float, beyond: str, order: int) -> FloatArray:
    """Return amplitudes as floats; refuse negative ones, those above 1, and from `largest` on.

    `beyond` is the sentence on an amplitude that is too large, with a place for it. Above the range
    of a model of that `order` the caller's caller is warned.
    """
    amplitude = finite_array("amplitude", a)
    if amplitude.size == 0:
        return amplitude
    low, high = float(amplitude.min()), float(amplitude.max())
    not_negative("amplitude", low, remedy="the phase, not the sign, turns the start around")
    if high > 1.0:
        raise ValueError(f"amplitude is the tip's over L and at most 1, got {high}: meters?")
    if high >= largest:
        raise ValueError(f"{beyond.format(f'{high:g}')}: keep it below {largest:.6g}")
    if high > _MEANT[order]:
        bound = {3: "the paper's own bound for the reduced models", 5: "beyond which a⁶ counts"}
        warn(
            f"amplitude {high:g} is above {_MEANT[order]:g}, {bound[order]}; backbone_curve and "
            f"periodic_orbits go on for as long as there is an orbit"
        )
    return amplitude


def better_model(w_bar: float) -> str:
    """Return what goes further than a one-mode model at w̄, as the end of a sentence."""
    return "take FrM" if w_bar <= _FASTEST else "rotate slower"


def warn_beyond_range(
    beam: AnyBlade,
    omega: float,
    variant: Variant,
    w_n: float,
    lambda_omega: float,
) -> None:
    """Warn where modes or extension that `variant` leaves out matter, or modes are resonant."""
    scale = beam.frequency_scale
    w_bar = omega / scale
    if omega >= beam.burst_speed:
        warn(
            f"omega = {omega:g} rad/s is above {beam.burst_speed:.6g} rad/s, at which the rotation "
            f"stretches this beam without bound: {variant.name} does not know of it and oscillates "
            f"about a steady state that the beam does not have; rotate slower"
        )
    elif variant.coriolis:
        _warn_if_extended(beam, w_bar, lambda_omega)
        others = blade_oscillator(beam.unit, w_bar, True).others
        warn_if_resonant(w_n * scale, scale * np.array(others))
    elif beam.unit == UNIFORM and omega > _PAPER_SPEED_RATIO * beam.omega_0:
        # The rotating beam's first frequency is never below ω0, so it is needed only here. Beyond
        # what its basis resolves, the values there are lower bounds, of the ratio as well.
        at = min(w_bar, _FASTEST)
        mode = blade_oscillator(UNIFORM, at, False)
        first, second = scale * mode.oscillator.w_n, scale * mode.others[0]
        if at * scale > _PAPER_SPEED_RATIO * first:
            more, above = ("more than ", "above ") if w_bar > at else ("", "")
            warn(
                f"omega = {omega:g} rad/s is {more}{at * scale / first:.2f} times the rotating "
                f"beam's first frequency ({above}{first:.4g} rad/s): beyond "
                f"{_PAPER_SPEED_RATIO:g}, where the paper ends, the second mode ({above}"
                f"{second:.4g} rad/s), which {variant.name} leaves out, matters; "
                f"{better_model(w_bar)}"
            )


def _warn_if_extended(beam: AnyBlade, w_bar: float, lambda_omega: float) -> None:
    """Warn where the extension, which FrM leaves out, changes λ_ω or ω_n noticeably."""
    mu = beam.slenderness
    # A hub adds to the tension, and so to the stretch, and less to what ω_n loses by it.
    hub = beam.unit.hub
    shift, stretch = 4.0 * mu, mu * w_bar**2 * (1.0 + 2.0 * hub)
    size = f"up to μ w_bar² (1 + {2.0 * hub:.3g})" if hub else "about μ w_bar²"
    if shift > _NOTICEABLE_SHIFT or stretch > _NOTICEABLE_STRETCH:
        warn(
            f"FrM is inextensible, but this beam has the slenderness μ = I/(AL²) = {mu:.2g}: its "
            f"λ_ω is higher than FrM's {lambda_omega:.4f} by about 4μ = {shift:.1e}, and its ω_n "
            f"lower by {size} = {stretch:.1e} of it; take periodic_orbits"
        )


def warn_if_resonant(omega_n: float, others: ArrayLike) -> None:
    """Warn where 2ω_n comes within 10 % of one of the `others` [rad/s]: FrM divides by the gap.

    A uniform cantilever never gets there: its ω_2 stays above 3 times 2ω_n at any rotation speed.
    """
    for other in np.atleast_1d(np.asarray(others, dtype=np.float64)):
        gap = other / (2.0 * omega_n) - 1.0
        if abs(gap) < _RESONANCE_BAND:
            warn(
                f"2ω_n = {2.0 * omega_n:.4g} rad/s is {abs(gap):.1%} from another mode at "
                f"{other:.4g} rad/s: FrM's elimination of that mode fails near resonance; take "
                f"periodic_orbits"
            )
