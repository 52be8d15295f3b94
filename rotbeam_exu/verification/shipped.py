"""The reference data that come with the package: the file, what it holds, and for which blades."""

from __future__ import annotations

import hashlib
import io
from dataclasses import dataclass, fields, is_dataclass
from functools import cached_property, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from analytic import AnyBlade, Beam, SpinUp
from analytic.arrays import FloatArray
from analytic.lazily import interpolate

from ..paper import RAMP_TIMES
from ..paper import SPEEDS as SPUN_UP
from .cases import CASES, VERSION, Asked, Case, spin_up_case
from .sampled import spline

if TYPE_CHECKING:
    import xarray as xr

FILE = Path(__file__).parent / "data" / "references.nc"

DIGEST = "0ba10ced1247adbbac635b42d7b3fd46d6edf850deb1f073d763e09de5890e87"
"""SHA-256 of the file: all verdicts stand on it, and no other is taken."""

_REMEDY = "install rotbeam-exu again, or make them by python -m rotbeam_exu.verification.regenerate"

DURATION = 20.0
"""Of the shipped histories [s]."""


def shipped_histories() -> dict[str, Case]:
    """Return the cases whose histories are shipped: the paper's spin-ups, and the benchmark's."""
    spin_ups = [SpinUp(omega=omega, ramp_time=time) for omega in SPUN_UP for time in RAMP_TIMES]
    found = [
        spin_up_case(Beam.reference(), one, DURATION, f"{one.omega:g}-{one.ramp_time:g}")
        for one in spin_ups
    ]
    known = {key(case) for case in found}
    own = [case for case in CASES.values() if case.asked is Asked.HISTORY]
    return {case.name: case for case in (*found, *(one for one in own if key(one) not in known))}


def shipped_backbones() -> dict[str, tuple[AnyBlade, float]]:
    """Return the blades and speeds [rad/s] whose backbones are shipped, by the name of a case."""
    return {
        case.name: (case.blade, case.motion.omega)
        for case in CASES.values()
        if case.oscillates and case.motion is not None and not case.amplitudes
    }


def key(case: Case) -> tuple[Any, ...]:
    """Return what makes a history."""
    return case.blade, case.motion, case.loads, case.amplitudes


def said(value: Any) -> str:
    """Return all numbers behind a history or a backbone, by which the file knows it.

    What is nothing by default is left out: a blade that learns to have more stays the same.
    """
    if isinstance(value, tuple):
        return f"({', '.join(map(said, value))})"
    if not is_dataclass(value):
        return repr(value)
    parts = ((one.name, getattr(value, one.name), one.default) for one in fields(value))
    stated = [f"{name}={said(part)}" for name, part, default in parts if part or part != default]
    return f"{type(value).__name__}({', '.join(stated)})"


@dataclass(frozen=True, kw_only=True, eq=False)
class Shipped:
    """What the file holds.

    Attributes
    ----------
    data : Dataset
        q over history and time, with bounds; shift over backbone and amplitude; first frequencies
        over speed.
    """

    data: xr.Dataset

    @property
    def source(self) -> str:
        """One sentence: which file, made how and by which commit."""
        attrs = self.data.attrs
        return (
            f"shipped with benchmark {attrs['benchmark']}: {FILE.name} "
            f"(SHA-256 {DIGEST[:12]}), {attrs['method']}, made at commit {attrs['commit']}"
        )

    @cached_property
    def _places(self) -> dict[tuple[Any, ...], str]:
        of = dict(zip(*self._listed("history"), strict=True))
        return {
            key(case): name
            for name, case in shipped_histories().items()
            if of.get(name) == said(key(case))
        }

    def _listed(self, dimension: str) -> tuple[list[str], list[str]]:
        """Return the names along a dimension, and what each was made of."""
        return self.data[dimension].to_numpy().tolist(), self.data[
            f"{dimension}_of"
        ].to_numpy().tolist()

    def history(self, case: Case) -> tuple[interpolate.BSpline, float] | None:
        """Return q over time and its bound over max|q|; None if it is not here, or too short."""
        name = self._places.get(key(case))
        if name is None or case.duration > DURATION:
            return None
        here = self.data.sel(history=name)
        return spline(here["time"].to_numpy(), here["q"].to_numpy()), float(here["bound"])

    @cached_property
    def _frequencies(self) -> dict[tuple[AnyBlade, float], float]:
        blade, column = CASES["L"].blade, self.data["first_frequency"]
        speeds = column["speed"].to_numpy().tolist()
        return {(blade, w): value for w, value in zip(speeds, column.to_numpy(), strict=True)}

    def first_frequency(self, blade: AnyBlade, speed: float) -> float | None:
        """Return ω_n [rad/s] in steady rotation; None if it is not here."""
        found = self._frequencies.get((blade, speed))
        return None if found is None else float(found)

    @cached_property
    def _backbones(self) -> dict[tuple[AnyBlade, float], tuple[float, interpolate.CubicSpline]]:
        """ω_n and the curvature over a², by blade and speed."""
        a, of = self.data["amplitude"].to_numpy(), dict(zip(*self._listed("backbone"), strict=True))
        found = {}
        for name, place in shipped_backbones().items():
            if of.get(name) == said(place):
                here = self.data.sel(backbone=name)
                curvature = here["curvature"].to_numpy()
                known = np.isfinite(curvature)
                found[place] = (
                    float(here["omega_n"]),
                    interpolate.CubicSpline(a[known] ** 2, curvature[known]),
                )
        return found

    def frequency_at(self, blade: AnyBlade, speed: float, amplitude: float) -> float | None:
        """Return ω_NL [rad/s] at a peak |q|/L; None if it is not here."""
        found = self._backbones.get((blade, speed))
        if found is None:
            return None
        omega_n, curvature = found
        if not 0.0 <= amplitude**2 <= curvature.x[-1]:
            return None
        return omega_n * (1.0 - float(curvature(amplitude**2)) * amplitude**2)

    @property
    def frequency_bound(self) -> float:
        """Relative error of all frequencies."""
        return float(self.data.attrs["frequency_bound"])


@lru_cache(maxsize=1)
def shipped() -> Shipped:
    """Return the shipped data; RuntimeError if they are not those of this code."""
    import xarray as xr  # noqa: PLC0415

    try:
        raw = FILE.read_bytes()
    except OSError as error:
        raise RuntimeError(
            f"the reference data {FILE} cannot be read ({error}): {_REMEDY}"
        ) from error
    found = hashlib.sha256(raw).hexdigest()
    if found != DIGEST:
        raise RuntimeError(
            f"the reference data {FILE} were damaged or changed (SHA-256 {found[:12]}, not "
            f"{DIGEST[:12]}): {_REMEDY}"
        )
    data = xr.load_dataset(io.BytesIO(raw), engine="h5netcdf")
    if data.attrs["benchmark"] != VERSION:
        raise RuntimeError(
            f"the reference data {FILE} are of benchmark {data.attrs['benchmark']}, not {VERSION}: "
            f"{_REMEDY}"
        )
    return Shipped(data=data)


def amplitudes() -> FloatArray:
    """Return the peak |q|/L of shipped backbones: 0, and closer where resonances bend them.

    Each ends where a resonance bends it too sharply; those of case B are among them.
    """
    parts = (0.0, 0.4, 0.02), (0.4, 0.5, 0.005), (0.5, 0.6, 0.0025), (0.6, 0.885, 0.005)
    return np.concatenate([low + np.arange(round((up - low) / d)) * d for low, up, d in parts])
