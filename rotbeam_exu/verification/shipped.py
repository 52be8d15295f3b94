"""The reference data that come with the package: the file, what it holds, and for which blades."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from functools import cached_property, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.interpolate import BSpline, CubicSpline

from analytic import AnyBlade, Beam, SpinUp

from ..paper import RAMP_TIMES
from ..paper import SPEEDS as SPUN_UP
from .cases import CASES, VERSION, Asked, Case, spin_up_case
from .sampled import spline

if TYPE_CHECKING:
    import xarray as xr

FILE = Path(__file__).parent / "data" / "references.nc"

DURATION = 20.0
"""Of the shipped histories [s]."""


def shipped_histories() -> dict[str, Case]:
    """Return the cases whose histories are shipped: the paper's spin-ups, and the benchmark's."""
    spin_ups = [SpinUp(omega=omega, ramp_time=time) for omega in SPUN_UP for time in RAMP_TIMES]
    found = [
        spin_up_case(Beam.reference(), one, DURATION, f"{one.omega:g}-{one.ramp_time:g}")
        for one in spin_ups
    ]
    known = {_key(case) for case in found}
    own = [case for case in CASES.values() if case.asked is Asked.HISTORY]
    return {case.name: case for case in (*found, *(one for one in own if _key(one) not in known))}


def shipped_backbones() -> dict[str, tuple[AnyBlade, float]]:
    """Return the blades and speeds [rad/s] whose backbones are shipped, by the name of a case."""
    return {
        case.name: (case.blade, case.motion.omega)
        for case in CASES.values()
        if case.oscillates and case.motion is not None and not case.amplitudes
    }


def _key(case: Case) -> tuple[Any, ...]:
    """Return what makes a history."""
    return case.blade, case.motion, case.loads, case.amplitudes


@dataclass(frozen=True, kw_only=True, eq=False)
class Shipped:
    """What the file holds.

    Attributes
    ----------
    data : Dataset
        q over history and time, with bounds; shift over backbone and amplitude; first frequencies
        over speed.
    digest : str
        SHA-256 of the file.
    """

    data: xr.Dataset
    digest: str

    @property
    def source(self) -> str:
        """One sentence: which file, made how and by which commit."""
        attrs = self.data.attrs
        return (
            f"shipped with benchmark {attrs['benchmark']}: {FILE.name} "
            f"(SHA-256 {self.digest[:12]}), {attrs['method']}, made at commit {attrs['commit']}"
        )

    @cached_property
    def _places(self) -> dict[tuple[Any, ...], str]:
        names = set(self.data["history"].to_numpy().tolist())
        return {_key(case): name for name, case in shipped_histories().items() if name in names}

    def history(self, case: Case) -> tuple[BSpline, float] | None:
        """Return q over time and its bound over max|q|; None if it is not here, or too short."""
        name = self._places.get(_key(case))
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
    def _backbones(self) -> dict[tuple[AnyBlade, float], tuple[float, CubicSpline]]:
        a = self.data["amplitude"].to_numpy()
        return {
            place: (
                float(self.data["omega_n"].sel(backbone=name)),
                CubicSpline(a**2, self.data["curvature"].sel(backbone=name).to_numpy()),
            )
            for name, place in shipped_backbones().items()
        }

    def frequency_at(self, blade: AnyBlade, speed: float, amplitude: float) -> float | None:
        """Return ω_NL [rad/s] at a peak |q|/L; None if it is not here."""
        found = self._backbones.get((blade, speed))
        if found is None or not 0.0 <= amplitude <= float(self.data["amplitude"][-1]):
            return None
        omega_n, curvature = found
        return omega_n * (1.0 - float(curvature(amplitude**2)) * amplitude**2)

    @property
    def frequency_bound(self) -> float:
        """Relative error of all frequencies."""
        return float(self.data.attrs["frequency_bound"])


@lru_cache(maxsize=1)
def shipped() -> Shipped:
    """Return the shipped data; RuntimeError if they cannot be read or are of another benchmark."""
    import xarray as xr  # noqa: PLC0415

    try:
        raw = FILE.read_bytes()
        data = xr.load_dataset(FILE, engine="h5netcdf")
    except OSError as error:
        raise RuntimeError(
            f"the reference data {FILE} cannot be read ({error}): install rotbeam-exu again, or "
            f"make them by python -m rotbeam_exu.verification.regenerate"
        ) from error
    if data.attrs["benchmark"] != VERSION:
        raise RuntimeError(
            f"the reference data {FILE} are of benchmark {data.attrs['benchmark']}, not {VERSION}: "
            f"make them by python -m rotbeam_exu.verification.regenerate"
        )
    return Shipped(data=data, digest=hashlib.sha256(raw).hexdigest())


def amplitudes() -> np.ndarray:
    """Return the peak |q|/L of shipped backbones: 0, and closer where a resonance is near.

    At 2 rad/s one begins to bend the backbone beyond 0.5; those of case B are among them.
    """
    parts = np.arange(20) * 0.02, 0.4 + np.arange(20) * 0.005, 0.5 + np.arange(41) * 0.0025
    return np.concatenate(parts)
