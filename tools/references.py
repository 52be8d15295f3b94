"""Make the shipped reference data: part of `make references`.

What the file has of a blade, motion, loads and theory stays, to the last bit; --all computes it
anew, in more than half an hour, most of it the kicked tube and the real blades. Look at what moved,
and by how much against the bounds, before committing it.
"""

from __future__ import annotations

import hashlib
import re
import subprocess
import sys
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import xarray as xr
from rich.progress import track

from analytic import AmplitudeNotReachedError, Beam, Blade, SpinUp, periodic_orbits
from analytic.arrays import FloatArray
from analytic.input_checks import RotbeamWarning
from analytic.lazily import interpolate
from analytic.theory import BERNOULLI_EULER, Theory
from rotbeam_exu.paper import RAMP_TIMES, SPEEDS
from rotbeam_exu.verification import shipped
from rotbeam_exu.verification.case import Asked, Case
from rotbeam_exu.verification.cases import CASES, VERSION, spin_up_case
from rotbeam_exu.verification.references import Sampled, row_of, sampled_history

SPACING = 5e-3
"""Time between the shipped samples [s]."""

TOLERANCES = {"S1+g": 2e-6, "K": 1e-7, "W+N": 3e-7, "W+I": 3e-7}
"""Tolerance of q over max|q|, 1e-8 of others: what sets in at once moves high modes."""

_WORST = 1e-8  # relative error of ω_NL between the points of a backbone
_QUANTUM = 1e-12  # of max|q|, to which samples are rounded so that they compress
_OF_ERROR = 1e-3  # of the error of a column, the same where it is more


def shipped_histories() -> dict[str, tuple[Case, Theory]]:
    """Return whose histories are shipped: the paper's spin-ups, and the benchmark's cases."""
    spin_ups = [SpinUp(omega=omega, ramp_time=time) for omega in SPEEDS for time in RAMP_TIMES]
    found = [
        spin_up_case(Beam.reference(), one, shipped.DURATION, f"{one.omega:g}-{one.ramp_time:g}")
        for one in spin_ups
    ]
    known = {shipped.key(case, BERNOULLI_EULER) for case in found}
    own = [
        one
        for one in _by_theory()
        if one[0].asked is Asked.HISTORY and shipped.key(*one) not in known
    ]
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


def shipped_backbones() -> dict[str, tuple[Blade, float]]:
    """Return the blades and speeds [rad/s] whose backbones are shipped, by the name of a case."""
    return {
        case.name: (case.blade, case.rotation.omega)
        for case in CASES.values()
        if case.oscillates and case.is_spun_up
    }


class Kept:
    """What a file has already, by what it was made of; nothing without a file."""

    def __init__(self, data: xr.Dataset | None) -> None:
        self.data = xr.Dataset() if data is None else data
        self._of = {
            name: {of: k for k, of in enumerate(self.data[f"{name}_of"].to_numpy().tolist())}
            for name in ("history", "table", "backbone")
            if data is not None
        }

    def _places(self, kind: str, made_of: list[str]) -> list[int] | None:
        places = [self._of.get(kind, {}).get(one) for one in made_of]
        return None if None in places else [k for k in places if k is not None]

    def history(self, case: Case, theory: Theory) -> Sampled:
        """Return a history, computed where it is new."""
        made_of = [_of(case, theory, k) for k in range(len(case.columns))]
        if (k := self._places("history", made_of)) is None:
            return history(case, theory)
        q = case.joined(self.data["q"].to_numpy()[k])
        return Sampled(self.data["time"].to_numpy(), q, float(self.data["bound"][k[0]]))

    def table(self, case: Case, theory: Theory) -> tuple[FloatArray, float]:
        """Return the rows of a table and their error, computed where they are new."""
        if (k := self._places("table", [_of(case, theory)])) is None:
            return table(case, theory)
        rows = self.data["row"].to_numpy()[k[0]]
        rows = rows[np.isfinite(rows).any(axis=1)]
        return rows[:, np.isfinite(rows[0])], float(self.data["table_bound"][k[0]])

    def backbone(self, blade: Blade, speed: float) -> tuple[float, FloatArray, float]:
        """Return ω_n, the curvature and the error of a backbone, computed where it is new."""
        if (k := self._places("backbone", [shipped.said((blade, speed))])) is None:
            return backbone(blade, speed)
        found = (self.data[name].to_numpy()[k[0]] for name in ("omega_n", "curvature"))
        return *found, float(self.data.attrs["frequency_bound"])


def dataset(commit: str, kept: Kept) -> xr.Dataset:
    """Return all shipped data; the commit made those that are not kept."""
    cases = shipped_histories()
    found = {name: kept.history(*cases[name]) for name in track(list(cases), "histories")}
    columns = [(name, k) for name, (case, _) in cases.items() for k in range(len(case.columns))]
    tables = {name: kept.table(*one) for name, one in shipped_tables().items()}
    of_tables = shipped_tables().values()
    places = shipped_backbones()
    curves = {name: kept.backbone(*places[name]) for name in track(list(places), "backbones")}
    errors = [error for *_, error in curves.values()]
    first = next(iter(found.values()))
    commits = [*kept.data.attrs.get("commit", commit).split(", "), commit]
    described = {
        "q": ("of the tip, across the turning line of the clamp; of real blades moments", "m, N m"),
        "bound": ("error of q over max|q|, interpolation by a quintic spline included", "1"),
        "history_of": ("blade, motion, loads and orbit", ""),
        "backbone_of": ("blade and speed", ""),
        "omega_n": ("natural frequency", "rad/s"),
        "curvature": ("(1 - ω_NL/ω_n)/a², a cubic spline over a²", "1"),
        "row": ("natural frequencies, or lag, flap and twist of the tip", "rad/s, or m and rad"),
        "table_bound": ("relative error of a table", "1"),
        "table_of": ("what is asked, blade, speeds and theory", ""),
        "time": ("time", "s"),
        "amplitude": ("a, peak |q| over the length", "1"),
        "place": ("number of the speed", "1"),
        "number": ("number of the frequency, or of the component", "1"),
    }
    widest = [max(one[0].shape[axis] for one in tables.values()) for axis in (0, 1)]
    padded = np.full((len(tables), *widest), np.nan)
    for into, (rows, _) in zip(padded, tables.values(), strict=True):
        into[: rows.shape[0], : rows.shape[1]] = rows
    data = xr.Dataset(
        {
            "q": (("history", "time"), [np.atleast_2d(found[name].q.T)[k] for name, k in columns]),
            "bound": ("history", [found[name].error for name, _ in columns]),
            "history_of": ("history", [_of(*cases[name], k) for name, k in columns]),
            "omega_n": ("backbone", [one[0] for one in curves.values()]),
            "backbone_of": ("backbone", [shipped.said(places[name]) for name in curves]),
            "curvature": (("backbone", "amplitude"), [one[1] for one in curves.values()]),
            "row": (("table", "place", "number"), padded),
            "table_bound": ("table", [bound for _, bound in tables.values()]),
            "table_of": ("table", [_of(*one) for one in of_tables]),
        },
        {
            "history": [_component(cases[name][0], name, k) for name, k in columns],
            "time": first.time, "backbone": list(curves), "amplitude": amplitudes(),
            "table": list(tables), "place": np.arange(widest[0]), "number": np.arange(widest[1]),
        },
        {
            "title": "Reference data of the rotating beam benchmark",
            "benchmark": VERSION,
            "license": "CC-BY-4.0, https://creativecommons.org/licenses/by/4.0/",
            "method": "the exact beam by Radau collocation of order 15 and by harmonic balance",
            "commit": ", ".join(dict.fromkeys(commits)),
            "frequency_bound": max(errors),
        },
    )  # fmt: skip
    for name, (text, unit) in described.items():
        data[name].attrs = {"long_name": text, "units": unit}
    return data


def _of(case: Case, theory: Theory, component: int = 0) -> str:
    """Return what a history or a table was made of; components after the first are told apart."""
    return _component(case, shipped.said(shipped.key(case, theory)), component)


def _component(case: Case, name: str, component: int) -> str:
    return f"{name} {case.columns[component]}" if component else name


def table(case: Case, theory: Theory) -> tuple[FloatArray, float]:
    """Compute the rows of a table over its speeds, and the largest relative error."""
    rows = [row_of(case, theory, speed) for speed in case.speeds]
    return np.array([row for row, _ in rows]), max(error for _, error in rows)


def history(case: Case, theory: Theory) -> Sampled:
    """Compute one history, rounded."""
    tolerance = TOLERANCES.get(case.name, 1e-8)
    case = replace(case, duration=shipped.DURATION)
    found = sampled_history(case, theory, tolerance=tolerance, spacing=SPACING)
    # A power of two, so that rounding leaves trailing zeros in the mantissa.
    share = max(_QUANTUM, _OF_ERROR * found.error)
    quantum = 2.0 ** np.floor(np.log2(share * np.abs(found.q).max(axis=0)))
    return Sampled(time=found.time, q=np.round(found.q / quantum) * quantum, error=found.error)


def amplitudes() -> FloatArray:
    """Return the peak |q|/L of shipped backbones: 0, and closer where resonances bend them.

    Each ends where a resonance bends it too sharply; the amplitudes of case B are among them.
    """
    parts = (0.0, 0.4, 0.02), (0.4, 0.5, 0.005), (0.5, 0.6, 0.0025), (0.6, 0.885, 0.005)
    return np.concatenate([low + np.arange(round((up - low) / d)) * d for low, up, d in parts])


def backbone(blade: Blade, speed: float) -> tuple[float, FloatArray, float]:
    """Compute ω_n, the curvature at `amplitudes`, and the relative error of ω_NL.

    The error is the spline's, halfway between its points, and the change by half as many functions
    again. Beyond the amplitude where the spline's error exceeds _WORST, or orbits are not reached,
    the curvature is NaN.
    """
    at = amplitudes()
    halfway = 0.5 * (at[2:] + at[1:-1])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RotbeamWarning)  # a resonance that is known to be near
        try:
            found = periodic_orbits(blade, speed, np.concatenate((at[1:], halfway)))
        except AmplitudeNotReachedError as error:
            if error.part is None:
                raise
            found = error.part
        finer = periodic_orbits(blade, speed, at[10:60:10], functions=24)
    values = (1.0 - found.frequency / found.omega_n) / found.amplitude**2
    of = {round(float(a), 9): float(c) for a, c in zip(found.amplitude, values, strict=True)}
    of[0.0] = found.lambda_omega
    known = np.array([of.get(round(a, 9), np.nan) for a in at.tolist()])
    between = np.array([of.get(round(a, 9), np.nan) for a in halfway.tolist()])
    count = int(np.isfinite(known).cumprod().sum())  # up to the first that was not reached
    while True:
        spline = interpolate.CubicSpline(at[:count] ** 2, known[:count])
        halves = slice(count - 2)
        errors = np.abs((spline(halfway[halves] ** 2) - between[halves]) * halfway[halves] ** 2)
        # NaN is no good either.
        bad = np.flatnonzero(~(errors <= _WORST))
        if bad.size == 0:
            break
        count = int(bad[0]) + 2
    known[count:] = np.nan
    same = [int(np.abs(found.amplitude - a).argmin()) for a in finer.amplitude]
    by_functions = np.abs(finer.frequency / found.frequency[same] - 1.0)
    return found.omega_n, known, float(errors.max() + by_functions.max())


def write(data: xr.Dataset) -> None:
    """Write the file of the package, and its digest into the code that reads it."""
    packed = {name: {"zlib": True, "complevel": 9, "shuffle": True} for name in ("q", "curvature")}
    shipped.FILE.parent.mkdir(exist_ok=True)
    data.to_netcdf(shipped.FILE, engine="h5netcdf", encoding=packed)
    found = hashlib.sha256(shipped.FILE.read_bytes()).hexdigest()
    code = Path(shipped.__file__).read_text(encoding="utf-8")
    code = re.sub(r'^DIGEST = "[0-9a-f]*"', f'DIGEST = "{found}"', code, flags=re.MULTILINE)
    Path(shipped.__file__).write_text(code, encoding="utf-8")


if __name__ == "__main__":
    # The commit is told dirty if something is not in it.
    described = ["git", "-C", str(Path(__file__).parent), "describe", "--always", "--dirty"]
    commit = subprocess.run([*described, "--abbrev=12"], capture_output=True, text=True, check=True)
    old = None if "--all" in sys.argv else xr.load_dataset(shipped.FILE, engine="h5netcdf")
    write(dataset(commit.stdout.strip(), Kept(old)))
