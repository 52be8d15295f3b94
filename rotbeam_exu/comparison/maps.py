"""Maps over the speed: λ_ω over the hub radius, in lag and in flap, and growth out of the plane."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from analytic import AnyBlade, Beam, Rectangle
from analytic.exact.plane.planarity import growth_rates
from analytic.input_checks import finite_values
from analytic.reduced.any_blade import blade_oscillator

from ..labels import GROWTH, OMEGA, ORBIT, dataset
from ..lazily import xr
from ..runs.attributes import beam_attributes

_W_BAR = "speed ω̄ = ω/√(EI/ρAL⁴)"


def softening_map(beam: AnyBlade | None = None) -> xr.Dataset:
    """Return λ_ω of FrM and ω_2/ω_n of a blade on hubs of many radii, at many speeds.

    Inextensible, by the closed form of `analytic.reduced.any_blade`. Near whole numbers of ω_2/ω_n
    an internal resonance bends the backbone, and λ_ω tells of the smallest amplitudes only.

    Parameters
    ----------
    beam : Beam or Blade, optional
        By default the paper's beam; its own hub radius is replaced.

    Returns
    -------
    Dataset
        `lambda_omega` and `ratio` = ω_2/ω_n over R/L from 0 to 5 and w̄ = ω/√(EI/ρAL⁴) from 0 to
        10, (hub_ratio, w_bar).
    """
    blade = Beam.reference() if beam is None else beam
    # Closer where the hub is small: the map turns there.
    hubs, speeds = 5.0 * np.linspace(0.0, 1.0, 33) ** 2, np.linspace(0.0, 10.0, 41)
    coefficients, ratios = np.empty((2, hubs.size, speeds.size))
    for i, hub in enumerate(hubs.tolist()):
        unit = blade.with_hub_radius(hub * blade.length).unit
        for j, w_bar in enumerate(speeds.tolist()):
            found = blade_oscillator(unit, w_bar, coriolis=True)
            coefficients[i, j] = found.oscillator.lambda_omega
            ratios[i, j] = found.others[0] / found.oscillator.w_n
    dims = ("hub_ratio", "w_bar")
    return dataset(
        {
            "lambda_omega": (dims, coefficients, "λ_ω"),
            "ratio": (dims, ratios, "second over first frequency"),
        },
        {"hub_ratio": (hubs, "hub radius R/L"), "w_bar": (speeds, _W_BAR)},
    )


def softening_by_plane(beam: AnyBlade | None = None) -> xr.Dataset:
    """Return λ_ω of FrM of lag alone and of flap alone, over the speed.

    Flap alone is the blade set at a right angle: it bends out of the plane of rotation only, whose
    Coriolis force then does nothing and whose centrifugal force does not soften the deflection. It
    is rigid in lag; the lag of a real blade is driven at twice the frequency, and λ_ω of its flap
    has a pole where 2ω_flap = ω_lag.

    Parameters
    ----------
    beam : Beam or Blade, optional
        By default the paper's beam; its own setting angle is replaced.

    Returns
    -------
    Dataset
        `lambda_omega` over (plane, w_bar), w̄ = ω/√(EI/ρAL⁴) from 0 to 10.
    """
    blade = Beam.reference() if beam is None else beam
    speeds = np.linspace(0.0, 10.0, 101)
    planes = {"lag": 0.0, "flap": 0.5 * np.pi}
    coefficients = []
    for angle in planes.values():
        unit = blade.with_setting_angle(angle).unit
        found = [blade_oscillator(unit, w_bar, coriolis=True) for w_bar in speeds.tolist()]
        coefficients.append([one.oscillator.lambda_omega for one in found])
    return dataset(
        {"lambda_omega": (("plane", "w_bar"), coefficients, "λ_ω")},
        {"plane": list(planes), "w_bar": (speeds, _W_BAR)},
    )


def growth_out_of_plane(
    blade: AnyBlade | None = None,
    *,
    omegas: Sequence[float] | None = None,
    amplitudes: Sequence[float] | None = None,
    damping: float = 0.005,
) -> xr.Dataset:
    """Return how fast planar orbits leave their plane, over speed and amplitude.

    The 6600 points unless others are given take four minutes. Tongues between them are missed.

    Parameters
    ----------
    blade : Blade, optional
        With a section out of the plane; by default the paper's beam as the rectangle that has its
        A and I.
    omegas : sequence of float, optional
        Rotation speeds [rad/s], by default 0 to 8.
    amplitudes : sequence of float, optional
        Peaks |q|/L, by default 0.01 to 0.5.
    damping : float
        Damping ratio of all modes of flap and torsion.

    Returns
    -------
    Dataset
        `growth_rate`, where stable the least decay rate, below zero (zero without damping), NaN
        where no orbit was found, over (omega, a).
    """
    blade = Beam.reference().with_shape(Rectangle()) if blade is None else blade
    given = np.linspace(0.0, 8.0, 81) if omegas is None else omegas
    speeds = finite_values("omegas", given, "rad/s")
    # Closer where the tongues are.
    near, far = np.geomspace(0.01, 0.1, 72), np.geomspace(0.11, 0.5, 10)
    peaks = np.concatenate((near, far)) if amplitudes is None else np.asarray(amplitudes)
    rates = np.array([growth_rates(blade, omega, peaks, damping) for omega in speeds.tolist()])
    return dataset(
        {"growth_rate": (("omega", "a"), rates, GROWTH)},
        {"omega": (speeds, OMEGA), "a": (peaks, ORBIT)},
        {**beam_attributes(blade), "damping": damping},
    )
