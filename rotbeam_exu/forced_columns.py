"""Forced responses as labeled data."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import Any

import numpy as np

from analytic import AmplitudeNotReachedError, AnyBlade
from analytic.exact.driven.forced_orbits import ForcedResponse, SpaceForcedResponse
from analytic.exact.free.orbits import Orbits
from analytic.loads import Load

from .lazily import xr
from .result_columns import GROWTH, SWINGS, dataset
from .runs.attributes import beam_attributes, loads_attributes
from .runs.versions import versions


def of_forced(response: ForcedResponse) -> xr.Dataset:
    """Return `_curve`, and where the section is known what grows out of the plane, and a sentence.

    On as many functions and steps as `planar_stability` begins with.
    """
    data = _curve(response)
    if response.beam.blade.section.out_of_plane is None:
        return data
    try:
        found = response.out_of_plane(confirm=False)
    except ValueError as unknown:
        reason = f"Whether the response stays in its plane is not known: {unknown}"
        return data.assign_attrs(planar=reason)
    growth = {
        "growth_rate": ("point", found.growth_rate, GROWTH),
        "kind": ("point", list(found.kind), "how it grows"),
    }
    return data.merge(dataset(growth, {})).assign_attrs(planar=str(found))


def _curve(response: ForcedResponse) -> xr.Dataset:
    """Return it over the points of the curve in order; q/L = Σ cosine cos kφ + sine sin kφ.

    `mark` is "start", "end", "peak", "dip", "fold" or nothing. The backbone, but under gravity, is
    over its orbits.
    """
    weight = response.load.varied == "speed"
    swept = "rotation speed ω" if weight else "drive frequency ν"
    # The weight across the blade is greatest, and negative, at θ = 0.
    phase = f"lag of the first harmonic of q behind {'cos θ' if weight else 'the load'} [rad]"
    harmonics = ("point", "harmonic")
    variables: dict[str, tuple[Any, Any, str]] = {
        "frequency": ("point", response.frequency, f"{swept} [rad/s]"),
        "amplitude": ("point", response.amplitude, "amplitude |q|/L"),
        "phase": ("point", response.phase, phase),
        "stable": ("point", response.stable, "whether disturbances in the plane decay"),
        "mark": ("point", _marks(response), "what is special about the point"),
        "cosine": (harmonics, response.harmonics.real, "q/L over cos kφ"),
        "sine": (harmonics, -response.harmonics.imag, "q/L over sin kφ"),
    }
    backbone: Orbits | None = None
    if not weight:
        try:
            backbone = response.backbone.orbits(np.linspace(0.0, response.amplitude.max(), 13)[1:])
        except AmplitudeNotReachedError as error:
            backbone = error.orbits  # what of it is reached
    if backbone is not None:
        free = np.append(backbone.omega_n, backbone.frequency)
        label = "frequency of the free, undamped orbit [rad/s]"
        variables["backbone_frequency"] = ("orbit", free, label)
        peaks = np.append(0.0, backbone.amplitude)
        variables["backbone_amplitude"] = ("orbit", peaks, "amplitude |q|/L")
    inputs = response_inputs(
        response.beam, response.load, None if weight else float(response.omega[0])
    )
    known = {"residual": float(response.residual.max()), "versions": json.dumps(versions())}
    return dataset(variables, {}, {**inputs, **known})


def of_forced_in_space(response: SpaceForcedResponse) -> xr.Dataset:
    """Return it as in the plane; q is the gauge, lag, flap and twist are the tip's amplitudes."""
    data = _curve(response)
    data["stable"].attrs["long_name"] = "whether disturbances decay"
    swings = {name: ("point", getattr(response, name), label) for name, label in SWINGS.items()}
    return data.merge(dataset(swings, {}))


def response_inputs(beam: AnyBlade, load: Load, omega: float | None) -> dict[str, Any]:
    """Return beam, damping, load and, unless it is swept, ω [rad/s] as attributes of a response."""
    return {
        **beam_attributes(beam),
        **{f"damping_{name}": value for name, value in asdict(beam.damping).items()},
        **loads_attributes([load]),
        "load": type(load).__name__,
        "load_size": load.size,
        "load_symbol": load.symbol,
        "load_unit": load.unit,
        **({} if omega is None else {"omega": omega}),
    }


def _marks(response: ForcedResponse) -> list[str]:
    marks = [mark if mark in ("fold", "peak") else "" for mark in response.marks]
    for i in np.flatnonzero(np.array(marks) == "peak").tolist():
        marks[i] = "dip" if response.amplitude[i] < response.amplitude[i - 1] else "peak"
    marks[0], marks[-1] = "start", "end"
    return marks
