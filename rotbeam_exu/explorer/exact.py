"""The exact orbits that the Explorer shows at one speed."""

from __future__ import annotations

import warnings

import numpy as np

from analytic import AmplitudeNotReachedError, AnyBlade, periodic_orbits
from analytic.arrays import FloatArray
from analytic.input_checks import RotbeamWarning

from ..datasets import AMPLITUDE, dataset
from ..lazily import xr

TIP_HARMONICS = 20
"""Harmonics of q/L kept; from the twelfth on they are below 4e-6."""
_AXIS_HARMONICS = 7  # those beyond are below 2e-4 of the length, a twentieth of a pixel
_AXIS_POINTS = 13


def exact_orbits(beam: AnyBlade, omega: float, amplitudes: tuple[float, ...]) -> xr.Dataset:
    """Return what is shown of the exact orbits at one speed; a pure function, for any executor.

    NaN for orbits that are not found.
    """
    wanted = np.array(amplitudes)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", RotbeamWarning)
        try:
            backbone = periodic_orbits(beam, omega, wanted)
        except AmplitudeNotReachedError as error:
            if error.backbone is None:
                raise
            backbone = error.backbone
    found = np.abs(wanted[:, None] - backbone.amplitude).min(axis=1) < 1e-6

    def at_all(values: FloatArray) -> FloatArray:
        whole = np.full((wanted.size, *values.shape[1:]), np.nan)
        whole[found] = values
        return whole

    tip = backbone.harmonics[:, :TIP_HARMONICS]
    tip = np.pad(tip, ((0, 0), (0, TIP_HARMONICS - tip.shape[1])))
    # The midpoints of half a period, which symmetry makes enough.
    phase = np.pi * (np.arange(32) + 0.5) / 32
    points = np.linspace(0.0, beam.length, _AXIS_POINTS)
    axes = [
        _axis_harmonics(*backbone.axis(i, points, phase)) for i in range(backbone.amplitude.size)
    ]
    axis_x, axis_y = (np.array(parts) / beam.length for parts in zip(*axes, strict=True))
    along = ("a", "k", "point")
    orbits = dataset(
        {
            "exact_omega_n": ((), backbone.omega_n, "natural frequency ω_n [rad/s]"),
            "exact_lambda_omega": ((), backbone.lambda_omega, "λ_ω"),
            "exact_frequency": ("a", at_all(backbone.frequency), "frequency ω_NL [rad/s]"),
            "harmonics": (("a", "harmonic"), at_all(tip), "q/L over sin kφ"),
            "axis_x": (along, at_all(axis_x), "x/L over cos kφ"),
            "axis_y": (along, at_all(axis_y), "y/L over sin kφ"),
            "note": ((), "; ".join(str(warning.message) for warning in caught), "warnings"),
        },
        {"a": (list(amplitudes), AMPLITUDE)},
    )
    return orbits.assign_coords(omega=omega)


def _axis_harmonics(x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Cosine coefficients of x and sine coefficients of y, (k, points), k from 0."""
    count = len(x)
    angle = np.multiply.outer(np.arange(_AXIS_HARMONICS + 1), np.pi * (np.arange(count) + 0.5))
    cosines = 2.0 / count * np.cos(angle / count) @ x
    cosines[0] *= 0.5
    return cosines, 2.0 / count * np.sin(angle / count) @ y
