"""The reference data that come with the package: the file, its content, and its blades."""

from __future__ import annotations

import hashlib
import io
from dataclasses import dataclass, is_dataclass
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from analytic import AnyBlade, Beam, SpinUp
from analytic.arrays import FloatArray
from analytic.lazily import interpolate
from analytic.theory import BERNOULLI_EULER, Theory

from ..lazily import xr
from ..paper import RAMP_TIMES
from ..paper import SPEEDS as SPUN_UP
from .cases import CASES, VERSION, Asked, Case, spin_up_case, stated

FILE = Path(__file__).parent / "data" / "references.nc"

DIGEST = "7a34b5456f43c25c3f451f44cc187cedc4b0989500a9517d4312cefb4a66ae04"
"""SHA-256 of the file: all judgements stand on it, and no other file is taken."""

_REMEDY = "install rotbeam-exu again, or make them by python -m rotbeam_exu.verification.regenerate"

DURATION = 20.0
"""End of the shipped histories [s]."""


def spline(time: FloatArray, q: FloatArray) -> interpolate.BSpline:
    """Return the quintic spline through samples."""
    return interpolate.make_interp_spline(time, q, k=5)


def shipped_histories() -> dict[str, tuple[Case, Theory]]:
    """Return whose histories are shipped: the paper's spin-ups, and the benchmark's cases."""
    spin_ups = [SpinUp(omega=omega, ramp_time=time) for omega in SPUN_UP for time in RAMP_TIMES]
    found = [
        spin_up_case(Beam.reference(), one, DURATION, f"{one.omega:g}-{one.ramp_time:g}")
        for one in spin_ups
    ]
    known = {key(case, BERNOULLI_EULER) for case in found}
    own = [one for one in _by_theory() if one[0].asked is Asked.HISTORY and key(*one) not in known]
    return {_named(*one): one for one in [*((case, BERNOULLI_EULER) for case in found), *own]}


def shipped_tables() -> dict[str, tuple[Case, Theory]]:
    """Return whose frequencies and steady states are shipped."""
    asked = Asked.FREQUENCIES, Asked.STEADY
    return {_named(*one): one for one in _by_theory() if one[0].asked in asked}


def _by_theory() -> list[tuple[Case, Theory]]:
    return [(case, theory) for case in CASES.values() for theory in case.theories]


def _named(case: Case, theory: Theory) -> str:
    number = case.theories.index(theory)
    return f"{case.name} {number}" if number else case.name


def shipped_backbones() -> dict[str, tuple[AnyBlade, float]]:
    """Return the blades and speeds [rad/s] whose backbones are shipped, by the name of a case."""
    return {
        case.name: (case.blade, case.rotation.omega)
        for case in CASES.values()
        if case.oscillates and case.is_spun_up
    }


def column(case: Case, name: str, component: int) -> str:
    """Return the name of a component of a history; that of the first is the history's."""
    return f"{name} {case.columns[component]}" if component else name


def key(case: Case, theory: Theory) -> tuple[Any, ...]:
    """Return what makes a history, or a table."""
    asked = () if case.asked is Asked.HISTORY else (case.asked.name, case.speeds, case.count)
    inputs = (case.blade, case.motion, case.loads, case.amplitudes, *asked)
    return inputs if theory == BERNOULLI_EULER else (*inputs, theory)


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
    data : Dataset
        q over history and time, with bounds, in space each component a history; shift over backbone
        and amplitude; rows of frequencies and steady states over table, place and number.
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

    def _names(self, dimension: str) -> dict[str, str]:
        """Return the names along a dimension by what each thing was made of."""
        of, names = self.data[f"{dimension}_of"].to_numpy(), self.data[dimension].to_numpy()
        return dict(zip(of.tolist(), names.tolist(), strict=True))

    def history(self, case: Case, theory: Theory) -> tuple[interpolate.BSpline, float] | None:
        """Return q over time and its bound over max|q|; None if it is not here, or too short."""
        name = self._names("history").get(said(key(case, theory)))
        if name is None or case.duration > DURATION:
            return None
        names = [column(case, name, k) for k in range(len(case.columns))]
        here = self.data.sel(history=names)
        q = here["q"].to_numpy().T
        q = q if case.in_space else q[:, 0]
        return spline(here["time"].to_numpy(), q), float(here["bound"].max())

    @cached_property
    def _tables(self) -> dict[str, str]:
        return self._names("table")

    def row(self, case: Case, theory: Theory, speed: float) -> FloatArray | None:
        """Return the numbers of a table at a speed [rad/s]; None if they are not here.

        Of a history or a backbone the frequencies of a table of the same blade.
        """
        asked = Asked.STEADY if case.asked is Asked.STEADY else Asked.FREQUENCIES
        for own in CASES.values():
            alike = (own.blade, own.in_space, own.asked) == (case.blade, case.in_space, asked)
            name = self._tables.get(said(key(own, theory)))
            if alike and name and speed in own.speeds and case.count <= own.count:
                here = self.data["row"].sel(table=name).to_numpy()[own.speeds.index(speed)]
                return np.asarray(here[np.isfinite(here)])
        return None

    def bound(self, case: Case, theory: Theory) -> float | None:
        """Return the relative error of a table's numbers or of backbones; None if not here."""
        if case == CASES["B"] and theory == BERNOULLI_EULER:
            return self.frequency_bound
        name = self._tables.get(said(key(case, theory)))
        return None if name is None else float(self.data["table_bound"].sel(table=name))

    @cached_property
    def _backbones(self) -> dict[str, tuple[float, interpolate.CubicSpline]]:
        """ω_n and the curvature over a², by the inputs of a backbone."""
        a, found = self.data["amplitude"].to_numpy(), {}
        for of, name in self._names("backbone").items():
            here = self.data.sel(backbone=name)
            curvature = here["curvature"].to_numpy()
            known = np.isfinite(curvature)
            over_square = interpolate.CubicSpline(a[known] ** 2, curvature[known])
            found[of] = float(here["omega_n"]), over_square
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
        return float(self.data.attrs["frequency_bound"])


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
    data = xr.load_dataset(io.BytesIO(raw), engine="h5netcdf")
    if data.attrs["benchmark"] != VERSION:
        why = f"are of benchmark {data.attrs['benchmark']}, not {VERSION}"
        raise RuntimeError(f"the reference data {FILE} {why}: {_REMEDY}")
    return Shipped(data=data)


def amplitudes() -> FloatArray:
    """Return the peak |q|/L of shipped backbones: 0, and closer where resonances bend them.

    Each ends where a resonance bends it too sharply; the amplitudes of case B are among them.
    """
    parts = (0.0, 0.4, 0.02), (0.4, 0.5, 0.005), (0.5, 0.6, 0.0025), (0.6, 0.885, 0.005)
    return np.concatenate([low + np.arange(round((up - low) / d)) * d for low, up, d in parts])
