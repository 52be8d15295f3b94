"""Columns of most kinds of result, whose numbers are attributes of theirs.

Other kinds have a function in `datasets`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from operator import attrgetter
from typing import Any

import numpy as np

from analytic.exact.free.branches import BackboneBranch
from analytic.exact.free.curve import BackboneCurve
from analytic.exact.free.leaving import LeavingBranch
from analytic.exact.free.orbits import Orbits
from analytic.exact.free.stability_limit import StabilityLimit
from analytic.exact.linear.campbell import Campbell
from analytic.exact.linear.families import FAMILIES, LinearModes
from analytic.exact.linear.steady_state import SteadyState
from analytic.exact.stability.growth import GrowthOutOfPlane
from analytic.reduced.tables import PaperTable
from analytic.sensitivity import Fit, Sensitivity
from analytic.spin_up.quiet import QuietRamps
from analytic.theory import Theory

from .labels import GROWTH, OMEGA, ORBIT, dataset
from .lazily import xr
from .runs.attributes import blade_attributes, theory_attributes
from .runs.oscillation import OSCILLATION, SteadyOscillation

Dims = str | tuple[str, ...]
Column = tuple[Dims, str, Callable[[Any], Any]]
"""Dims, label with unit, and how the values come from the result."""


def of_columns(
    columns: Mapping[str, Column], inputs: tuple[str, ...], result: object
) -> xr.Dataset:
    """Return the Dataset of a result; modes and harmonics count from 1.

    `known` are the attributes about all of it; its blade and theory are kept where it has them.
    """
    about = blade_attributes(result.blade) if hasattr(result, "blade") else {}
    if isinstance(theory := getattr(result, "theory", None), Theory):
        about |= theory_attributes(theory)
    data = dataset(
        {name: (dims, of(result), label) for name, (dims, label, of) in columns.items()},
        {},
        {**about, **{name: getattr(result, name) for name in inputs}},
    )
    counted = {"mode", "harmonic"} & set(data.dims) - set(data.coords)
    parts = {"part": ["real", "imaginary"]} if "part" in data.dims else {}
    return data.assign_coords(
        parts | {name: np.arange(1, data.sizes[name] + 1) for name in counted}
    )


def _named(name: str, dims: Dims, label: str) -> Column:
    return dims, label, attrgetter(name)


def _part(name: str, k: int, dims: Dims, label: str) -> Column:
    return dims, label, lambda result: getattr(result, name)[..., k]


def _each(what: str, name: str, label: str, kind: type | None = float) -> Column:
    """Return a column over the crossings, the tongues or the rows of a result."""
    of, all_of = attrgetter(name), attrgetter(f"{what}s")
    return what, label, lambda result: np.array([*map(of, all_of(result))], kind)


def _columns(dims: Dims, **labels: str) -> dict[str, Column]:
    """Return columns that have the names of the result's attributes."""
    return {name: _named(name, dims, label) for name, label in labels.items()}


SWINGS = {
    "lag": "half the way of the tip in lag over L",
    "flap": "half the way of the tip in flap over L",
    "twist": "half the swing of the tip's section [rad]",
}
"""Amplitudes of the tip in space, with their labels."""

_ORBITS = _columns(
    "orbit",
    amplitude="peak amplitude |q|/L",
    frequency="nonlinear frequency ω_NL [rad/s]",
    frequency_error="relative error of ω_NL",
    first_harmonic="first harmonic of q/L",
    residual="residual of the equations of motion",
    jacobi_drift="drift of the Jacobi integral",
) | {"sine": _named("harmonics", ("orbit", "harmonic"), "q/L over sin kφ")}
_OF_ORBITS = ("omega", "mode", "omega_n", "lambda_omega", "lambda_omega_error")
_POINTS = _columns("point", amplitude="peak amplitude |q|/L", frequency="frequency [rad/s]") | {
    "mark": ("point", "what is special about the point", lambda result: [*result.marks])
}
_NAMES: Column = ("mode", "mode", lambda result: [*result.names])
_FREQUENCY = {"frequency": _named("frequencies", "mode", "natural frequency [rad/s]")}

COLUMNS: dict[type, tuple[dict[str, Column], tuple[str, ...]]] = {
    Orbits: (_ORBITS | _columns("orbit", **SWINGS), _OF_ORBITS),
    BackboneBranch: (
        _POINTS | _columns("point", piece="0 on the main path, then the tongue's number"),
        ("omega", "mode"),
    ),
    LeavingBranch: (
        _POINTS | _columns("point", **SWINGS), ("omega", "mode", "periods", "ended")
    ),
    BackboneCurve: (
        {
            "ratio": _named("series.coef", "coefficient", "ω_NL/ω_n, of Chebyshev's series in a²"),
            "first_harmonic": _named(
                "first.coef", "coefficient", "first harmonic over the peak, of the same series"
            ),
        },
        ("omega", "mode", "omega_n", "holds_up_to", "error"),
    ),
    Sensitivity: (
        {
            "output": ("output", "number of the answer", lambda result: [*result.outputs]),
            "output_value": _named("values", "output", "its value, in its unit"),
            "output_unit": ("output", "its unit", lambda result: [*result.units]),
            "parameter": ("parameter", "parameter", lambda result: [*result.names]),
            "value": _each("parameter", "value", "value, in its unit"),
            "unit": _each("parameter", "unit", "unit of the parameter", str),
            "derivative": _named(
                "derivatives", ("output", "parameter"), "change of the output over the parameter's"
            ),
            "relative": _named("relative", ("output", "parameter"), "the same of relative changes"),
        },
        ("omega",),
    ),
    Fit: (
        {
            "parameter": ("parameter", "number of the blade", lambda result: [*result.names]),
            "unit": _each("parameter", "unit", "its unit", str),
            **_columns(
                "parameter", before="before", values="after", deviations="standard deviation"
            ),
            "covariance": _named("covariance", ("parameter", "with"), "covariance of the values"),
            "measured": ("measured", "what was measured", lambda result: [*result.labels]),
            "value": ("measured", "its value", lambda r: [one.value for one in r.measured]),
            "measured_unit": ("measured", "its unit", lambda r: [one.unit for one in r.measured]),
            **_columns(
                "measured", computed="what the blade has",
                residuals="computed less measured, over standard deviations",
            ),
        },
        ("misfit", "unknown"),
    ),
    LinearModes: (
        {"mode": _NAMES} | _FREQUENCY | {
            f"{name}_share": _part("shares", k, "mode", f"share of {name} in the kinetic energy")
            for k, name in enumerate(FAMILIES)
        },
        ("omega", "error"),
    ),
    SteadyState: (
        {
            f"tip_{axis}": _part("tip", k, (), f"tip from the clamp, {axis} of its frame [m]")
            for k, axis in enumerate("xyz")
        } | _columns((), twist="turn of the tip's section by the load [rad]"),
        ("omega", "force", "moment", "gravity", "error"),
    ),
    QuietRamps: (
        {"ramp_time": _named("ramp_times", "ramp", "quiet ramp time T [s]")} | _columns(
            "ramp", left="amplitude left over L", linear="the same by the closed form"
        ),
        ("omega",),
    ),
    SteadyOscillation: (
        _columns((), **OSCILLATION)
        | _columns("harmonic", harmonics="amplitude of the harmonic over L"),
        ("cycles",),
    ),
    GrowthOutOfPlane: (
        {
            "a": _named("amplitude", "a", ORBIT),
            "growth_rate": _named("growth_rate", "a", GROWTH),
            "kind": ("a", "how it grows", lambda result: list(result.kind)),
            "modes": ("a", "what grows", lambda result: list(map(" and ".join, result.modes))),
            "converged": _named("converged", "a", "converged"),
            "frequency": _named("frequency", "a", "frequency of the planar orbit [rad/s]"),
            "multipliers": (
                ("a", "multiplier", "part"), "Floquet multiplier out of the plane",
                lambda one: np.stack((one.multipliers.real, one.multipliers.imag), axis=-1),
            ),
        },
        ("omega", "mode"),
    ),
    StabilityLimit: (
        {
            "limit": _named("amplitude", (), "amplitude |q|/L above which planar orbits leave"),
            "limit_growth": _named("growth", (), "growth exponent that counts [1/rad]"),
            "limit_converged": _named("converged", (), "whether the limit is settled"),
            "tongue_low": _each("tongue", "low", "amplitude |q|/L, from"),
            "tongue_high": _each("tongue", "high", "amplitude |q|/L, to"),
            "tongue_growth": _each("tongue", "growth", "growth exponent [1/rad]"),
        },
        ("omega", "mode"),
    ),
    Campbell: (
        {
            "omega": _named("omegas", "omega", OMEGA),
            "mode": _NAMES,
            "frequency": _named("frequencies", ("omega", "mode"), "frequency [rad/s]"),
            "crossing_mode": (
                "crossing", "mode that crosses k ω",
                lambda diagram: np.array([one.mode for one in diagram.crossings], str),
            ),
            "crossing_order": _each("crossing", "order", "order k", int),
            "crossing_omega": _each("crossing", "omega", OMEGA),
            "crossing_frequency": _each("crossing", "frequency", "frequency [rad/s]"),
        },
        ("error",),
    ),
    PaperTable: (
        {
            name: _each("row", name, name, None)
            for name in ("quantity", "printed", "derived", "difference", "note")
        },
        ("number", "title"),
    ),
}  # fmt: skip
"""Columns, and the attributes about all of a result, by kind."""
