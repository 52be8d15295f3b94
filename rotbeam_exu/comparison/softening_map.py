"""λ_ω over hub radius and speed, in lag and in flap, and where the second mode meets harmonics."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from analytic import AnyBlade, Beam
from analytic.reduced.any_blade import blade_oscillator

from ..lazily import xr


def softening_map(
    beam: AnyBlade | None = None,
    *,
    hub_ratios: Sequence[float] | None = None,
    w_bars: Sequence[float] | None = None,
) -> xr.Dataset:
    """Return λ_ω of FrM and ω_2/ω_n of a blade on hubs of many radii, at many speeds.

    Inextensible, by the closed form of `analytic.reduced.any_blade`. Near whole numbers of ω_2/ω_n
    an internal resonance bends the backbone, and λ_ω tells of the smallest amplitudes only.

    Parameters
    ----------
    beam : Beam or Blade, optional
        By default the paper's beam; its own hub radius is replaced.
    hub_ratios : sequence of float, optional
        R/L, by default 0 to 5.
    w_bars : sequence of float, optional
        w̄ = ω/√(EI/ρAL⁴), by default 0 to 10.

    Returns
    -------
    Dataset
        `lambda_omega` and `ratio` = ω_2/ω_n over (hub_ratio, w_bar).
    """
    blade = Beam.reference() if beam is None else beam
    hubs = np.linspace(0.0, 5.0, 21) if hub_ratios is None else np.asarray(hub_ratios)
    speeds = np.linspace(0.0, 10.0, 31) if w_bars is None else np.asarray(w_bars)
    coefficients, ratios = np.empty((2, hubs.size, speeds.size))
    for i, hub in enumerate(hubs.tolist()):
        unit = blade.with_hub_radius(hub * blade.length).unit
        for j, w_bar in enumerate(speeds.tolist()):
            found = blade_oscillator(unit, w_bar, coriolis=True)
            coefficients[i, j] = found.oscillator.lambda_omega
            ratios[i, j] = found.others[0] / found.oscillator.w_n
    dims = ("hub_ratio", "w_bar")
    return xr.Dataset(
        {
            "lambda_omega": (dims, coefficients, {"units": "1", "long_name": "λ_ω"}),
            "ratio": (dims, ratios, {"units": "1", "long_name": "second over first frequency"}),
        },
        coords={
            "hub_ratio": ("hub_ratio", hubs, {"units": "1", "long_name": "hub radius R/L"}),
            "w_bar": ("w_bar", speeds, {"units": "1", "long_name": "speed ω/√(EI/ρAL⁴)"}),
        },
    )


def softening_by_plane(
    beam: AnyBlade | None = None, *, w_bars: Sequence[float] | None = None
) -> xr.Dataset:
    """Return λ_ω of FrM of lag alone and of flap alone, over the speed.

    Flap alone is the blade set at a right angle: it bends out of the plane of rotation only, whose
    Coriolis force then does nothing and whose centrifugal force does not soften the deflection. It
    is rigid in lag; the lag of a real blade is driven at twice the frequency, and λ_ω of its flap
    has a pole where 2ω_flap = ω_lag.

    Parameters
    ----------
    beam : Beam or Blade, optional
        By default the paper's beam; its own setting angle is replaced.
    w_bars : sequence of float, optional
        w̄ = ω/√(EI/ρAL⁴), by default 0 to 10.

    Returns
    -------
    Dataset
        `lambda_omega` over (plane, w_bar).
    """
    blade = Beam.reference() if beam is None else beam
    speeds = np.linspace(0.0, 10.0, 101) if w_bars is None else np.asarray(w_bars)
    planes = {"lag": 0.0, "flap": 0.5 * np.pi}
    coefficients = [
        [
            blade_oscillator(
                blade.with_setting_angle(angle).unit, w_bar, coriolis=True
            ).oscillator.lambda_omega
            for w_bar in speeds.tolist()
        ]
        for angle in planes.values()
    ]
    return xr.Dataset(
        {
            "lambda_omega": (
                ("plane", "w_bar"),
                np.array(coefficients),
                {"units": "1", "long_name": "λ_ω"},
            )
        },
        coords={
            "plane": list(planes),
            "w_bar": ("w_bar", speeds, {"units": "1", "long_name": "speed ω/√(EI/ρAL⁴)"}),
        },
    )
