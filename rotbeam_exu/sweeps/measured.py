"""The table of a sweep: measured numbers of its cases, and q over time."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from ..fem.case import RunCase
from ..labels import OMEGA, dataset
from ..lazily import xr
from ..runs.oscillation import OSCILLATION
from ..runs.versions import versions

MEASURED = {**OSCILLATION, "omega_n": "natural frequency ω_n of the mesh [rad/s]"}
"""Quantities measured of a case, with their labels."""


def collect(
    cases: dict[tuple[float, float], RunCase],
    results: dict[tuple[float, float], xr.Dataset],
    history: bool,
) -> xr.Dataset:
    """Return the table of a sweep, as `sweep` describes it, with all results so far."""
    omegas = list(dict.fromkeys(omega for omega, _ in cases))
    ramp_times = list(dict.fromkeys(ramp_time for _, ramp_time in cases))
    shape = (len(omegas), len(ramp_times))
    dims = ("omega", "ramp_time")
    columns: dict[str, Any] = {name: np.full(shape, np.nan) for name in MEASURED}
    verdict = np.full(shape, "pending", dtype=object)
    failure = np.full(shape, "", dtype=object)
    for i, j in np.ndindex(shape):
        result = results.get((omegas[i], ramp_times[j]))
        if result is None:
            continue
        verdict[i, j], failure[i, j] = result.attrs["verdict"], result.attrs["failure"]
        if not result.attrs["failure"]:
            for name, column in columns.items():
                column[i, j] = result.attrs[name]
    first = next(iter(cases.values())).describe()
    data = dataset(
        {
            **{name: (dims, column, MEASURED[name]) for name, column in columns.items()},
            "verdict": (dims, verdict.astype(str), "verdict"),
            "failure": (dims, failure.astype(str), "why a case failed"),
        },
        {"omega": (omegas, OMEGA), "ramp_time": (ramp_times, "ramp time T [s]")},
        {
            **{k: v for k, v in first.items() if k not in dims},
            "versions": json.dumps(versions()),
        },
    )
    if history:
        data = data.merge(_histories(omegas, ramp_times, results))
    return data


def _histories(
    omegas: list[float],
    ramp_times: list[float],
    results: dict[tuple[float, float], xr.Dataset],
) -> xr.Dataset:
    """Return q over (omega, ramp_time, time), NaN where a case has none."""
    known = {point: result["q"] for point, result in results.items() if "q" in result}
    if not known:
        return xr.Dataset()
    # Samples of different cases need not coincide.
    times = np.unique(np.concatenate([q["time"].to_numpy() for q in known.values()]))
    values = np.full((len(omegas), len(ramp_times), times.size), np.nan)
    for (omega, ramp_time), q in known.items():
        at = np.searchsorted(times, q["time"].to_numpy())
        values[omegas.index(omega), ramp_times.index(ramp_time), at] = q.to_numpy()
    some = next(iter(known.values()))
    return xr.Dataset(
        {"q": (("omega", "ramp_time", "time"), values, some.attrs)},
        coords={"time": ("time", times, some["time"].attrs)},
    )
