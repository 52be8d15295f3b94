"""The reference data that come with the package: the file, its content, and its blades."""

from __future__ import annotations

import hashlib
import io
from collections.abc import Mapping
from dataclasses import dataclass, is_dataclass
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from analytic import AnyBlade, Beam, SpinUp
from analytic.arrays import FloatArray
from analytic.lazily import interpolate

from ..lazily import h5py
from ..paper import RAMP_TIMES
from ..paper import SPEEDS as SPUN_UP
from .cases import CASES, VERSION, Asked, Case, spin_up_case, stated

FILE = Path(__file__).parent / "data" / "references.nc"

DIGEST = "0ba10ced1247adbbac635b42d7b3fd46d6edf850deb1f073d763e09de5890e87"
"""SHA-256 of the file: all judgements stand on it, and no other file is taken."""

_REMEDY = "install rotbeam-exu again, or make them by python -m rotbeam_exu.verification.regenerate"

DURATION = 20.0
"""End of the shipped histories [s]."""


def spline(time: FloatArray, q: FloatArray) -> interpolate.BSpline:
    """Return the quintic spline through samples."""
    return interpolate.make_interp_spline(time, q, k=5)


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
        case.name: (case.blade, case.rotation.omega)
        for case in CASES.values()
        if case.oscillates and case.is_spun_up
    }


def key(case: Case) -> tuple[Any, ...]:
    """Return what makes a history."""
    return case.blade, case.motion, case.loads, case.amplitudes


def said(value: Any) -> str:
    """Return all numbers behind a history or a backbone, by which the file knows it."""
    if isinstance(value, tuple):
        return f"({', '.join(map(said, value))})"
    if not is_dataclass(value):
        return repr(value)
    parts = (f"{name}={said(part)}" for name, part in stated(value).items())
    return f"{type(value).__name__}({', '.join(parts)})"


@dataclass(frozen=True, kw_only=True, eq=False)
class Shipped:
    """The content of the file.

    Attributes
    ----------
    data : mapping of ndarray
        q over history and time, with bounds; shift over backbone and amplitude; first frequencies
        over speed. Read without xarray, whose import takes longer than a case.
    attrs : mapping
        The file's own attributes.
    """

    data: Mapping[str, FloatArray]
    attrs: Mapping[str, Any]

    @property
    def source(self) -> str:
        """One sentence: which file, made how and by which commit."""
        return (
            f"shipped with benchmark {self.attrs['benchmark']}: {FILE.name} "
            f"(SHA-256 {DIGEST[:12]}), {self.attrs['method']}, made at commit "
            f"{self.attrs['commit']}"
        )

    @cached_property
    def _histories(self) -> dict[str, int]:
        """Places of histories by what they were made of."""
        return {of: k for k, of in enumerate(self.data["history_of"].tolist())}

    def history(self, case: Case) -> tuple[interpolate.BSpline, float] | None:
        """Return q over time and its bound over max|q|; None if it is not here, or too short."""
        k = self._histories.get(said(key(case)))
        if k is None or case.duration > DURATION:
            return None
        return spline(self.data["time"], self.data["q"][k]), float(self.data["bound"][k])

    def first_frequency(self, blade: AnyBlade, speed: float) -> float | None:
        """Return ω_n [rad/s] in steady rotation; None if it is not here."""
        here = self.data["first_frequency"][self.data["speed"] == speed]
        return float(here[0]) if here.size and blade == CASES["L"].blade else None

    @cached_property
    def _backbones(self) -> dict[str, tuple[float, interpolate.CubicSpline]]:
        """ω_n and the curvature over a², by the inputs of a backbone."""
        a, found = self.data["amplitude"], {}
        of_each = (self.data[name] for name in ("backbone_of", "omega_n", "curvature"))
        for of, omega_n, curvature in zip(*of_each, strict=True):
            known = np.isfinite(curvature)
            over_square = interpolate.CubicSpline(a[known] ** 2, curvature[known])
            found[str(of)] = float(omega_n), over_square
        return found

    def frequency_at(self, blade: AnyBlade, speed: float, amplitude: float) -> float | None:
        """Return ω_NL [rad/s] at a peak |q|/L; None if it is not here."""
        omega_n, curvature = self._backbones.get(said((blade, speed)), (0.0, None))
        if curvature is None or not amplitude**2 <= curvature.x[-1]:
            return None
        return omega_n * (1.0 - float(curvature(amplitude**2)) * amplitude**2)

    @property
    def frequency_bound(self) -> float:
        """Relative error of all frequencies."""
        return float(self.attrs["frequency_bound"].item())


@lru_cache(maxsize=1)
def shipped() -> Shipped:
    """Return the shipped data; RuntimeError if they do not belong to this code."""
    try:
        raw = FILE.read_bytes()
    except OSError as error:
        why = f"cannot be read ({error})"
        raise RuntimeError(f"the reference data {FILE} {why}: {_REMEDY}") from error
    found = hashlib.sha256(raw).hexdigest()
    if found != DIGEST:
        why = f"were damaged or changed (SHA-256 {found[:12]}, not {DIGEST[:12]})"
        raise RuntimeError(f"the reference data {FILE} {why}: {_REMEDY}")
    with h5py.File(io.BytesIO(raw)) as file:
        text = h5py.check_string_dtype
        data = {name: (one.asstr() if text(one.dtype) else one)[()] for name, one in file.items()}
        attrs = dict(file.attrs)
    if attrs["benchmark"] != VERSION:
        why = f"are of benchmark {attrs['benchmark']}, not {VERSION}"
        raise RuntimeError(f"the reference data {FILE} {why}: {_REMEDY}")
    return Shipped(data=data, attrs=attrs)


def amplitudes() -> FloatArray:
    """Return the peak |q|/L of shipped backbones: 0, and closer where resonances bend them.

    Each ends where a resonance bends it too sharply; the amplitudes of case B are among them.
    """
    parts = (0.0, 0.4, 0.02), (0.4, 0.5, 0.005), (0.5, 0.6, 0.0025), (0.6, 0.885, 0.005)
    return np.concatenate([low + np.arange(round((up - low) / d)) * d for low, up, d in parts])
