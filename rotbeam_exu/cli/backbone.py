"""`rotbeam backbone`: nonlinear frequencies of the reduced models and of the exact beam."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from cyclopts import Parameter

import analytic
from analytic import Blade
from analytic.blade_checks import require_planar, undamped
from analytic.warning import warn

from .job import Flag
from .options import Numbers, Whole
from .output import Format, bar, print_columns, print_note
from .request import Request, uses

if TYPE_CHECKING:
    from analytic.exact.free.orbits import Orbits
    from analytic.reduced.model import ReducedModel

Refusal = tuple[str, str]
"""A model's name, and why it has no answer."""


@uses("omega", "theory")
def backbone(
    request: Request,
    *,
    amplitude: Numbers = None,
    variant: str | None = None,
    all_variants: Flag = False,
    exact: Flag = False,
    mode: str = "lag 1",
    functions: Whole = 16,
    form: Annotated[Format, Parameter(name="--format")] = "table",
) -> None:
    """Print the frequency over the amplitude, reduced and exact.

    The coefficients of the models, then their frequencies. Where a model has no answer there is a
    dash, and the reason below.

    Parameters
    ----------
    amplitude
        Amplitudes over the length, one or several; by default 0.05 to 0.2, and 0.01 to 0.04 of a
        blade from a table of stations.
    variant
        CI, CE, FrI, FrE, P3, P4, P5 of the paper; FrC, FrM or FrM5 of ours. Without one, the exact
        backbone, and of a blade in its plane FrM.
    all_variants
        Every variant, one below the other.
    exact
        Add the exact backbone to a variant, by harmonic balance on the exact beam.
    mode
        Mode from which the exact backbone grows; beyond 1 it comes alone, too.
    functions
        Functions that resolve the exact beam along its length, at least.
    form
        A table for the reader, or CSV with all digits.

    Examples
    --------
    $ rotbeam backbone --omega 6
    $ rotbeam backbone --omega 6 --all-variants --exact
    $ rotbeam backbone --omega 6 --variant FrM --amplitude 0.05 0.1 --format csv
    $ rotbeam backbone --omega 6 --mode "lag 2" --amplitude 0.02 0.05
    """
    blade, omega, theory = _free(request.blade), request.omega, request.theory
    if amplitude is None:
        amplitude = [(1 if blade.table else 5) * n / 100 for n in range(1, 5)]
    if mode != "lag 1" and (variant is not None or all_variants):
        raise ValueError("the reduced models are of lag 1: leave the variants out, or --mode")
    variants = list(analytic.VARIANTS) if all_variants else [variant] if variant else []
    if variants:
        require_planar(
            blade, "the reduced models are of", "the exact backbone: leave the variants out"
        )
    names = variants or (["FrM"] if mode == "lag 1" and blade.is_planar else [])
    exact = exact or not variants
    if theory != analytic.Theory() and not exact:
        raise ValueError(f"{theory} is a theory of the exact beam: add --exact")
    models, refused = _reduced(blade, omega, names)
    if variants and not models:
        raise ValueError("; ".join(_grouped(refused)))
    orbits, failure = None, ""
    if exact:
        orbits, failure = _exact(blade, omega, amplitude, mode, functions=functions, theory=theory)
    columns = _frequencies(models, amplitude, refused)
    if orbits is not None:
        columns |= _exact_columns(orbits, amplitude, len(models))
    if form == "table" and models:
        _print_coefficients(models, orbits, omega)
    print_columns(columns, form, title="" if models else str(orbits))
    if form == "table" and models:
        print_note(
            "a/L is the first harmonic of q in Eq. 63, its peak in Eq. 41 and of the exact beam; "
            "λ_ω > 0 softens"
            + ("; FrM5 has Eq. 63 with -κ (a/L)⁴" if any(model.kappa for model in models) else "")
        )
    # Only what is named must be had.
    if refused and variant:
        raise ValueError("; ".join(_grouped(refused)))
    for sentence in _grouped(refused):
        warn(f"no answer: {sentence}")
    if failure:
        raise RuntimeError(failure)


def _free(blade: Blade) -> Blade:
    """Return the blade without its damping, and say so."""
    if blade.damping:
        warn("free orbits have no damping: these are of the blade without its damping")
    return undamped(blade)


def _reduced(
    blade: Blade, omega: float, names: list[str]
) -> tuple[list[ReducedModel], list[Refusal]]:
    """Return the models of the blade, and why it has no others."""
    models, refused = [], []
    for name in names:
        try:
            models.append(analytic.reduced_model(blade, omega, name))
        except ValueError as error:
            refused.append((name, str(error)))
    return models, refused


def _grouped(refused: list[Refusal]) -> list[str]:
    """Return one sentence for all models that were refused for the same reason."""
    kinds: dict[str, list[Refusal]] = {}
    for name, sentence in refused:
        kinds.setdefault(sentence.replace(name, "#"), []).append((name, sentence))
    return [f"{', '.join(dict(group))}: {group[0][1]}" for group in kinds.values()]


def _exact(
    blade: Blade, omega: float, amplitude: list[float], mode: str, **how: Any
) -> tuple[Orbits, str]:
    """Return the orbits that were found, and why others were not."""
    try:
        with bar("exact orbits"):
            return analytic.periodic_orbits(blade, omega, amplitude, mode, **how), ""
    except analytic.AmplitudeNotReachedError as error:
        if error.part is None:
            raise
        return error.part, str(error)


def _frequencies(
    models: list[ReducedModel], amplitude: list[float], refused: list[Refusal]
) -> dict[str, list[Any]]:
    """Return the columns of the models, and add to `refused` why some have no number."""

    def number(frequency: Callable[[Any], Any], a: float, name: str) -> float:
        try:
            return float(frequency(a))
        except ValueError as error:
            refused.append((name, str(error)))
            return math.nan

    rows = []
    for model in models:
        name = model.variant.name
        for a in amplitude:
            both = [number(one, a, name) for one in (model.frequency, model.exact_frequency)]
            rows.append((name, a, *both, both[0] / model.omega_n))
    titles = "variant", "amplitude a/L", "Eq. 63 [rad/s]", "Eq. 41 exactly [rad/s]", "Eq. 63 / ω_n"
    columns = map(list, zip(*rows, strict=True))
    return dict(zip(titles, columns, strict=True)) if rows else {titles[1]: list(amplitude)}


def _exact_columns(orbits: Orbits, amplitude: list[float], models: int) -> dict[str, list[float]]:
    frequencies = [
        orbits.frequency[near[0]] if near.size else math.nan
        for a in amplitude
        for near in [np.flatnonzero(np.isclose(orbits.amplitude, a, rtol=1e-6))]
    ]
    columns = {"exact beam [rad/s]": frequencies * max(models, 1)}
    if not models:
        columns["exact/ω_n"] = [frequency / orbits.omega_n for frequency in frequencies]
    return columns


def _print_coefficients(models: list[ReducedModel], orbits: Orbits | None, omega: float) -> None:
    """Print one row of coefficients for each model, and one for the exact beam."""
    columns: dict[str, list[str]] = {"variant": [model.variant.name for model in models]}
    for title, name, form in (
        ("ω_n\n[rad/s]", "omega_n", ".6f"), ("stiffness g1,\nEq. 41", "g1", ".6g"),
        ("inertia g2,\nEq. 41", "g2", ".6g"), ("softening λ_ω,\nEq. 64", "lambda_omega", ".6f"),
        ("harmonic 3 λ_x,\nEq. 65", "lambda_x", ".6f"), ("κ", "kappa", ".6f"),
    ):  # fmt: skip
        columns[title] = [format(getattr(model, name), form) for model in models]
        if orbits is not None:
            of_any_mode = name in ("omega_n", "lambda_omega")
            columns[title].append(format(getattr(orbits, name), form) if of_any_mode else "-")
    if orbits is not None:
        columns["variant"].append("exact")
    columns["κ"] = [kappa if kappa.strip("0.") else "-" for kappa in columns["κ"]]
    if set(columns["κ"]) == {"-"}:
        del columns["κ"]
    whose = models[0].variant.name if len(models) == 1 else f"{len(models)} models"
    speed = models[0].speed_ratio
    print_columns(columns, title=f"{whose} at ω = {omega:g} rad/s (Ω = {speed:.4g})")
