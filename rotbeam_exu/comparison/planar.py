"""Whether planar motion stays planar: over amplitude, over speed and over the section's shape."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from analytic import (
    AnyBlade,
    Beam,
    PlanarStability,
    Rectangle,
    StabilityLimit,
    linear_modes,
    stability_limit,
)
from analytic.exact.plane.planarity import growth_rates
from analytic.exact.plane.stability_limit import LARGEST
from analytic.input_checks import finite_values

from ..lazily import xr
from ..paper import SPEEDS
from ..verdict import beam_attributes

_OMEGA: dict[str, Any] = {"units": "rad/s", "long_name": "angular velocity ω"}
_AMPLITUDE: dict[str, Any] = {"units": "1", "long_name": "amplitude a = |q|/L of the planar orbit"}
_GROWTH: dict[str, Any] = {"units": "1/s", "long_name": "growth rate out of the plane"}


def planar_stability(found: PlanarStability, limit: StabilityLimit | None = None) -> xr.Dataset:
    """Return the stability of planar orbits over their amplitudes as a Dataset.

    Parameters
    ----------
    found : PlanarStability
    limit : StabilityLimit, optional
        As attributes: the amplitude from which on the plane is left, infinite if there is none, and
        the tongues below it.

    Returns
    -------
    Dataset
        `growth_rate`, `kind`, `modes`, `converged`, the orbits' `frequency` and the real and
        imaginary parts of the `multipliers`, over `a`.
    """
    known = {} if limit is None else {
        "limit": limit.amplitude, "limit_converged": int(limit.converged), "sentence": str(limit),
        "growth": limit.growth,
        "tongues": "; ".join(
            f"{one.low:.4g} to {one.high:.4g}: {one.growth:.2g}" for one in limit.tongues
        ),
    }  # fmt: skip
    both = np.stack((found.multipliers.real, found.multipliers.imag), axis=-1)
    return xr.Dataset(
        {
            "growth_rate": ("a", found.growth_rate, _GROWTH),
            "kind": ("a", list(found.kind), {"units": "1", "long_name": "how it grows"}),
            "modes": (
                "a",
                [" and ".join(modes) for modes in found.modes],
                {"units": "1", "long_name": "what grows"},
            ),
            "converged": ("a", found.converged, {"units": "1", "long_name": "converged"}),
            "frequency": (
                "a",
                found.frequency,
                {"units": "rad/s", "long_name": "frequency of the planar orbit"},
            ),
            "multipliers": (
                ("a", "multiplier", "part"),
                both,
                {"units": "1", "long_name": "Floquet multiplier out of the plane"},
            ),
        },
        coords={"a": ("a", found.amplitude, _AMPLITUDE), "part": ["real", "imaginary"]},
        attrs={
            **beam_attributes(found.blade),
            "omega": found.omega,
            "mode": found.mode,
            **known,
        },
    )


def growth_out_of_plane(
    blade: AnyBlade | None = None,
    *,
    omegas: Sequence[float] | None = None,
    amplitudes: Sequence[float] | None = None,
) -> xr.Dataset:
    """Return how fast planar orbits leave their plane, over speed and amplitude.

    The 600 points unless others are given take some 15 s.

    Parameters
    ----------
    blade : Blade, optional
        With a section out of the plane; by default the paper's beam as the rectangle that has its
        A and I.
    omegas : sequence of float, optional
        Rotation speeds [rad/s], by default 0 to 8.
    amplitudes : sequence of float, optional
        Peaks |q|/L, by default 0.01 to 0.4.

    Returns
    -------
    Dataset
        `growth_rate`, zero where stable, over (omega, a).
    """
    blade = Beam.reference().with_shape(Rectangle()) if blade is None else blade
    speeds, peaks = np.linspace(0.0, 8.0, 25), np.geomspace(0.01, 0.4, 24)
    if omegas is not None:
        speeds = finite_values("omegas", omegas, "rad/s")
    if amplitudes is not None:
        peaks = finite_values("amplitudes", amplitudes)
    rates = np.array([growth_rates(blade, omega, peaks) for omega in speeds.tolist()])
    return xr.Dataset(
        {"growth_rate": (("omega", "a"), rates, _GROWTH)},
        coords={"omega": ("omega", speeds, _OMEGA), "a": ("a", peaks, _AMPLITUDE)},
        attrs=beam_attributes(blade),
    )


def stability_limits(
    beam: AnyBlade | None = None,
    *,
    ratios: Sequence[float] = (2.0, 3.0, 4.0, 6.0, 9.0, 13.0, 18.5),
    omegas: Sequence[float] = SPEEDS,
    largest: float = LARGEST,
) -> xr.Dataset:
    """Return the amplitudes from which on rectangles leave the plane, over height/width and speed.

    Parameters
    ----------
    beam : Beam or Blade, optional
        By default the paper's; EA, EI and m are kept.
    ratios, omegas : sequence of float
        Height in the plane over width, and rotation speeds [rad/s].
    largest : float
        Largest |q|/L to look at.

    Returns
    -------
    Dataset
        `limit` |q|/L over (ratio, omega), infinite where the largest orbit stays in the plane.
    """
    beam = Beam.reference() if beam is None else beam
    blades = [beam.blade.with_shape(Rectangle(ratio=ratio)) for ratio in ratios]
    found = [[stability_limit(blade, w, largest=largest) for w in omegas] for blade in blades]
    return xr.Dataset(
        {
            "limit": (
                ("ratio", "omega"),
                [[limit.amplitude for limit in row] for row in found],
                {"units": "1", "long_name": "amplitude |q|/L from which on the plane is left"},
            )
        },
        coords={
            "ratio": ("ratio", list(ratios), {"units": "1", "long_name": "height over width h/b"}),
            "omega": ("omega", list(omegas), _OMEGA),
        },
        attrs=beam_attributes(beam),
    )


def modes_in_space(
    blade: AnyBlade | None = None, *, omegas: Sequence[float] | None = None, count: int = 2
) -> xr.Dataset:
    """Return lag, flap and torsional frequencies over the speed.

    Returns
    -------
    Dataset
        `frequency` [rad/s] over (plane, mode, omega).
    """
    blade = Beam.reference().with_shape(Rectangle()) if blade is None else blade
    speeds = np.linspace(0.0, 8.0, 17) if omegas is None else np.asarray(omegas, dtype=float)
    families = [
        [linear_modes(blade, w, count).frequencies for w in speeds.tolist()],
        [linear_modes(blade, w, count, plane="flap").frequencies for w in speeds.tolist()],
        [linear_modes(blade, w, count, plane="torsion").frequencies for w in speeds.tolist()],
    ]
    return xr.Dataset(
        {
            "frequency": (
                ("plane", "omega", "mode"),
                np.array(families),
                {"units": "rad/s", "long_name": "natural frequency"},
            )
        },
        coords={
            "plane": ["lag", "flap", "torsion"],
            "omega": ("omega", speeds, _OMEGA),
            "mode": np.arange(1, count + 1),
        },
        attrs=beam_attributes(blade),
    )
