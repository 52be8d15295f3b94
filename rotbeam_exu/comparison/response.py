"""A response curve as a Dataset: what its figure draws, and what `rotbeam respond` writes."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import Any

import numpy as np

from analytic import AmplitudeNotReachedError, AnyBlade, Damping, ForcedResponse, Orbits
from analytic.damping import UNDAMPED
from analytic.loads import Load

from ..lazily import xr
from ..verdict import beam_attributes, loads_attributes
from ..versions import versions


def forced_response(response: ForcedResponse) -> xr.Dataset:
    """Return a response curve, its stability, and the backbone that it leans on.

    Parameters
    ----------
    response : ForcedResponse
        As `analytic.forced_response` returns it.

    Returns
    -------
    Dataset
        Over the points of the curve, in order, `frequency`, `amplitude`, `phase`, `stable` and
        `mark`: "start", "end", "peak", "dip", "fold" or nothing. `cosine` and `sine` over (point,
        harmonic), harmonic k in column k: q/L = Σ cosine cos kφ + sine sin kφ. But under gravity
        `backbone_frequency` and `backbone_amplitude` over (orbit,). The attributes hold beam,
        load, damping, versions and the largest residual.

    Warns
    -----
    RotbeamWarning
        If an internal resonance is near the backbone.
    """
    weight = response.load.by_angle
    omega = None if weight else float(response.omega[0])
    frequency = "rotation speed ω" if weight else "drive frequency ν"
    # The weight across the blade is greatest, and negative, at θ = 0.
    phase = f"lag of the first harmonic of q behind {'cos θ' if weight else 'the load'}"
    harmonics = ("point", "harmonic")
    data = xr.Dataset(
        {
            "frequency": ("point", response.frequency, _named(frequency, "rad/s")),
            "amplitude": ("point", response.amplitude, _named("amplitude |q|/L")),
            "phase": ("point", response.phase, _named(phase, "rad")),
            "stable": ("point", response.stable, _named("whether disturbances in the plane decay")),
            "mark": ("point", _marks(response), _named("what is special about the point")),
            "cosine": (harmonics, response.harmonics.real, _named("q/L over cos kφ")),
            "sine": (harmonics, -response.harmonics.imag, _named("q/L over sin kφ")),
        },
        attrs={
            **response_inputs(response.beam, response.load, omega),
            "residual": float(response.residual.max()),
            "versions": json.dumps(versions()),
        },
    )
    if weight:
        return data
    backbone = _backbone(response)
    if backbone is None:
        return data
    return data.assign(
        backbone_frequency=(
            "orbit",
            np.append(backbone.omega_n, backbone.frequency),
            _named("frequency of the free, undamped orbit", "rad/s"),
        ),
        backbone_amplitude=("orbit", np.append(0.0, backbone.amplitude), _named("amplitude |q|/L")),
    )


def response_inputs(beam: AnyBlade, load: Load, omega: float | None) -> dict[str, Any]:
    """Return beam, damping, load and, unless it is swept, ω [rad/s] as attributes of a response."""
    damping: Damping = getattr(beam, "damping", UNDAMPED)
    return {
        **beam_attributes(beam),
        **{f"damping_{name}": value for name, value in asdict(damping).items()},
        **loads_attributes([load]),
        "load": type(load).__name__,
        "load_size": load.size,
        "load_symbol": load.symbol,
        "load_unit": load.unit,
        **({} if omega is None else {"omega": omega}),
    }


def _backbone(response: ForcedResponse) -> Orbits | None:
    """Return the backbone, or what of it is reached."""
    try:
        return response.backbone.orbits(np.linspace(0.0, response.amplitude.max(), 13)[1:])
    except AmplitudeNotReachedError as error:
        reached: Orbits | None = error.orbits
        return reached


def _marks(response: ForcedResponse) -> list[str]:
    marks = [mark if mark in ("fold", "peak") else "" for mark in response.marks]
    for i in np.flatnonzero(np.array(marks) == "peak").tolist():
        marks[i] = "dip" if response.amplitude[i] < response.amplitude[i - 1] else "peak"
    marks[0], marks[-1] = "start", "end"
    return marks


def _named(long_name: str, unit: str = "1") -> dict[str, str]:
    return {"units": unit, "long_name": long_name}
