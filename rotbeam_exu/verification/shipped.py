"""The reference data that come with the package: the file, its content, and its blades."""

from __future__ import annotations

import hashlib
import io
from collections.abc import Mapping
from dataclasses import dataclass, fields, is_dataclass
from functools import cached_property, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from analytic import Blade
from analytic.arrays import FloatArray
from analytic.lazily import interpolate
from analytic.theory import BERNOULLI_EULER, Theory

from ..lazily import h5py
from .case import Asked, Case
from .cases import CASES, VERSION

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

FILE = Path(__file__).parent / "data" / "references.nc"

DIGEST = "d98e0255fee1a0c86a86ff95c1e6b04a0a897abdaa6e184c23d93b75a5e8fa94"
"""SHA-256 of the file: all judgements stand on it, and no other file is taken."""

_REMEDY = "install rotbeam-exu again, or make them by tools/references.py of the repository"

_LONG = 4000  # letters of a part: a digest stands for more, of tables of stations

DURATION = 20.0
"""End of the shipped histories [s]."""


def spline(time: FloatArray, q: FloatArray) -> interpolate.BSpline:
    """Return the quintic spline through samples."""
    return interpolate.make_interp_spline(time, q, k=5)


def key(case: Case, theory: Theory) -> tuple[object, ...]:
    """Return what makes a history, or a table."""
    table = () if case.asked is Asked.HISTORY else (case.asked.name, case.speeds, case.count)
    starts = *(case.kick,) * bool(case.kick), *("settled",) * case.settled
    inputs = (case.blade, case.motion, case.loads, case.amplitudes, *table, *starts)
    theory = case.theory_of(theory)
    return inputs if theory == BERNOULLI_EULER else (*inputs, theory)


def _stated(value: DataclassInstance | type[DataclassInstance]) -> dict[str, object]:
    """Return the fields of a value by name, without fields that are empty by default.

    A blade that learns to have more then states the same as before.
    """
    parameters = (one for one in fields(value) if one.init)  # others follow from these
    parts = ((one.name, getattr(value, one.name), one.default) for one in parameters)
    return {name: part for name, part, default in parts if part != default or not _is_nothing(part)}


def _is_nothing(part: object) -> bool:
    if isinstance(part, tuple):
        return all(map(_is_nothing, part))
    return not (_stated(part) if is_dataclass(part) else part)


def said(value: object) -> str:
    """Return what is behind a history or a backbone, all numbers, by which the file knows it."""
    if isinstance(value, tuple):
        text = f"({', '.join(map(said, value))})"
    elif is_dataclass(value):
        parts = (f"{name}={said(part)}" for name, part in _stated(value).items())
        text = f"{type(value).__name__}({', '.join(parts)})"
    else:
        text = repr(value)
    return text if len(text) < _LONG else hashlib.sha256(text.encode()).hexdigest()


@dataclass(frozen=True, kw_only=True, eq=False)
class Shipped:
    """The content of the file.

    Attributes
    ----------
    data : mapping of ndarray
        q over history and time, with bounds, in space each component a history; shift over backbone
        and amplitude; rows of frequencies and steady states over table, place and number. Read
        without xarray, whose import takes longer than a case.
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
    def _of(self) -> dict[str, dict[str, int]]:
        """Places of histories and tables by what they were made of."""
        return {
            name: {of: k for k, of in enumerate(self.data[f"{name}_of"].tolist())}
            for name in ("history", "table")
        }

    def history(
        self, case: Case, theory: Theory = BERNOULLI_EULER
    ) -> tuple[interpolate.BSpline, float] | None:
        """Return q over time and its bound over max|q|; None if it is not here, or too short."""
        k = self._of["history"].get(said(key(case, theory)))
        if k is None or case.duration > DURATION:
            return None
        q = case.joined(self.data["q"][k : k + len(case.columns)])
        return spline(self.data["time"], q), float(self.data["bound"][k])

    def row(self, case: Case, theory: Theory, speed: float) -> FloatArray | None:
        """Return the numbers of a table at a speed [rad/s]; None if they are not here.

        Of a history or a backbone the frequencies of a table of the same blade.
        """
        quantity = Asked.STEADY if case.asked is Asked.STEADY else Asked.FREQUENCIES
        for case_here in CASES.values():
            alike = (case_here.blade, case_here.columns, case_here.asked) == (
                case.blade,
                case.columns,
                quantity,
            )
            alike = alike and (quantity is Asked.FREQUENCIES or case_here.loads == case.loads)
            if not alike or speed not in case_here.speeds or case.count > case_here.count:
                continue
            k = self._of["table"].get(said(key(case_here, theory)))
            if k is not None:
                here = self.data["row"][k, case_here.speeds.index(speed)]
                return np.asarray(here[np.isfinite(here)])
        return None

    def bound(self, case: Case, theory: Theory) -> float | None:
        """Return the relative error of a table's numbers or of backbones; None if not here."""
        if case == CASES["B"] and theory == BERNOULLI_EULER:
            return self.frequency_bound
        k = self._of["table"].get(said(key(case, theory)))
        return None if k is None else float(self.data["table_bound"][k])

    @cached_property
    def _backbones(self) -> dict[str, tuple[float, interpolate.CubicSpline]]:
        """ω_n and the curvature over a², by the inputs of a backbone."""
        a, backbones = self.data["amplitude"], {}
        of_each = (self.data[name] for name in ("backbone_of", "omega_n", "curvature"))
        for of, omega_n, curvature in zip(*of_each, strict=True):
            finite = np.isfinite(curvature)
            over_square = interpolate.CubicSpline(a[finite] ** 2, curvature[finite])
            backbones[str(of)] = float(omega_n), over_square
        return backbones

    def frequency_at(self, blade: Blade, speed: float, amplitude: float) -> float | None:
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
    digest = hashlib.sha256(raw).hexdigest()
    if digest != DIGEST:
        why = f"were damaged or changed (SHA-256 {digest[:12]}, not {DIGEST[:12]})"
        raise RuntimeError(f"the reference data {FILE} {why}: {_REMEDY}")
    with h5py.File(io.BytesIO(raw)) as file:
        text = h5py.check_string_dtype
        data = {name: (one.asstr() if text(one.dtype) else one)[()] for name, one in file.items()}
        attrs = dict(file.attrs)
    if attrs["benchmark"] != VERSION:
        why = f"are of benchmark {attrs['benchmark']}, not {VERSION}"
        raise RuntimeError(f"the reference data {FILE} {why}: {_REMEDY}")
    return Shipped(data=data, attrs=attrs)
