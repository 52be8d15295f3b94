"""The exact orbits that the Explorer shows at one speed: a series in a² through some of them.

A slider has more amplitudes than a series needs orbits. Harmonic k of anything at the amplitude a,
over a for odd k, is an analytic function of a²: polynomials through Chebyshev's points give all of
them, unless a resonance keeps them from converging.
"""

from __future__ import annotations

import contextlib
import warnings
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from analytic import AmplitudeNotReachedError, AnyBlade, Orbits, periodic_orbits
from analytic.input_checks import RotbeamWarning

from ..lazily import xr

TIP_HARMONICS = 20
"""Harmonics of q/L kept; from the twelfth on they are below 4e-6."""
_AXIS_HARMONICS = 7  # those beyond are below 2e-4 of the length, a twentieth of a pixel
_AXIS_POINTS = 13
_ORBITS = 16  # that a series goes through
_CONVERGED = 1e-6  # its last coefficients: of ω_NL/ω_n, and of the length

_NONE = {"units": "1"}
_FREQUENCY = {"units": "rad/s"}

Floats = NDArray[np.float64]


def exact_orbits(beam: AnyBlade, omega: float, amplitudes: tuple[float, ...]) -> xr.Dataset:
    """Return what is shown of the exact orbits at one speed; a pure function, for any executor."""
    wanted = np.array(amplitudes)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", RotbeamWarning)
        tables = None
        if wanted.size > 1.5 * _ORBITS:
            at = wanted.max() * np.sqrt(0.5 + 0.5 * chebyshev.chebpts1(_ORBITS))
            with contextlib.suppress(AmplitudeNotReachedError):  # in a resonance
                backbone = periodic_orbits(beam, omega, at)
                tables = in_between(backbone, wanted)
        if tables is None:
            backbone, tables = _those_found(beam, omega, wanted)
    along: Any = ("a", "k", "point")
    return xr.Dataset(
        {
            "exact_omega_n": ((), backbone.omega_n, _FREQUENCY),
            "exact_lambda_omega": ((), backbone.lambda_omega, _NONE),
            "exact_frequency": ("a", backbone.omega_n * tables["ratio"][:, 0], _FREQUENCY),
            "harmonics": (("a", "harmonic"), tables["tip"], _NONE),
            "axis_x": (along, tables["axis_x"], _NONE),
            "axis_y": (along, tables["axis_y"], _NONE),
            "note": ((), "; ".join(str(warning.message) for warning in caught)),
        },
        coords={"omega": omega, "a": ("a", list(amplitudes), _NONE)},
    )


def _those_found(beam: AnyBlade, omega: float, wanted: Floats) -> tuple[Orbits, dict[str, Floats]]:
    """Return the orbits themselves, NaN for those that are not found."""
    try:
        backbone = periodic_orbits(beam, omega, wanted)
    except AmplitudeNotReachedError as error:
        if error.orbits is None:
            raise
        backbone = error.orbits
    found = np.abs(wanted[:, None] - backbone.amplitude).min(axis=1) < 1e-6
    tables = {}
    for name, values in _tables(backbone).items():
        tables[name] = np.full((wanted.size, *values.shape[1:]), np.nan)
        tables[name][found] = values
    return backbone, tables


def _tables(backbone: Orbits) -> dict[str, Floats]:
    """Return ω_NL/ω_n and harmonics of the tip and of the axis, (orbits, harmonics, ...)."""
    count = min(TIP_HARMONICS, backbone.harmonics.shape[1])
    tip = np.pad(backbone.harmonics[:, :count], ((0, 0), (0, TIP_HARMONICS - count)))
    axes = [_axis_harmonics(*_axis(backbone, i)) for i in range(backbone.amplitude.size)]
    axis_x, axis_y = (np.array(parts) for parts in zip(*axes, strict=True))
    ratio = (backbone.frequency / backbone.omega_n)[:, None]
    return {"ratio": ratio, "tip": tip, "axis_x": axis_x, "axis_y": axis_y}


def in_between(backbone: Orbits, wanted: Floats) -> dict[str, Floats] | None:
    """Return the same at other amplitudes, None where a series has not converged."""
    a, top = backbone.amplitude, float(wanted.max())
    at, onto = (chebyshev.chebvander(2.0 * (x / top) ** 2 - 1.0, a.size - 1) for x in (a, wanted))
    tables = {}
    for name, values in _tables(backbone).items():
        odd = (np.arange(values.shape[1]) + (1 if name == "tip" else 0)) % 2
        odd = odd.reshape(1, -1, *[1] * (values.ndim - 2))
        column = (-1, *[1] * (values.ndim - 1))
        even_in_a = values / a.reshape(column) ** odd
        coefficients = np.linalg.solve(at, even_in_a.reshape(a.size, -1))
        if np.abs(coefficients[-2:]).max() > _CONVERGED:
            return None
        found = (onto @ coefficients).reshape(wanted.size, *values.shape[1:])
        tables[name] = found * wanted.reshape(column) ** odd
    return tables


def _axis(backbone: Any, i: int) -> tuple[Floats, Floats]:
    """Axis over L at the midpoints of half a period, which symmetry makes enough."""
    length = backbone.beam.length
    phase = np.pi * (np.arange(32) + 0.5) / 32
    x, y = backbone.axis(i, np.linspace(0.0, length, _AXIS_POINTS), phase)
    return x / length, y / length


def _axis_harmonics(x: Floats, y: Floats) -> tuple[Floats, Floats]:
    """Cosine coefficients of x and sine coefficients of y, (k, points), k from 0."""
    count = len(x)
    angle = np.multiply.outer(np.arange(_AXIS_HARMONICS + 1), np.pi * (np.arange(count) + 0.5))
    cosines = 2.0 / count * np.cos(angle / count) @ x
    cosines[0] *= 0.5
    return cosines, 2.0 / count * np.sin(angle / count) @ y
