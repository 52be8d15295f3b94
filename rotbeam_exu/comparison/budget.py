"""The error budget: where each model's frequency error comes from, as differences of results."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np

from analytic import VARIANTS, Beam, Variant, periodic_orbits, reduced_model
from analytic.arrays import FloatArray

from ..labels import AMPLITUDE, OMEGA, dataset
from ..lazily import xr
from ..paper import MODELS, RAMP_TIMES, SPEEDS
from ..sweeps.grid import sweep
from .backbones import finite_element_points, measured_ratio
from .theory import beyond_range

SOURCES = (
    "linear frequency",
    "perturbation",
    "shape",
    "elongation",
    "foreshortening",
    "Coriolis modes",
    "extensibility and higher order",
)
"""Sources of a reduced model's error, in the order in which they are taken away."""


def model_budget(
    beam: Beam | None = None,
    *,
    omegas: Sequence[float] = SPEEDS,
    amplitudes: Sequence[float] = (0.05, 0.1, 0.15, 0.2),
) -> xr.Dataset:
    """Frequency error of CI, CE, FrI, FrE, FrC and FrM, source by source.

    Each model is changed into the exact one step by step. A source is the difference of the
    frequencies before and after its step; the sources add up to the whole error. The first are the
    linear frequency (both relative to the model's own ω_n), the perturbation (Eq. 63 less Eq. 41
    solved exactly from the peak a) and the shape (cantilever's mode for the rotating one). Then
    come the elongation (sine for the static solution), the foreshortening (-v'²/2 for -v'²/2 -
    v'⁴/8), the Coriolis modes (FrC less FrM), and the rest between FrM and the exact beam.

    Returns
    -------
    Dataset
        `error`, (ω_NL - ω_NL,exact)/ω_n,exact [-], over (model, source, omega, a), and `total`
        over (model, omega, a); a is the peak of |q|/L in all of them.
    """
    beam = beam or Beam.reference()
    a = list(amplitudes)
    error = np.empty((len(MODELS), len(SOURCES), len(omegas), len(a)))
    total = np.empty((len(MODELS), len(omegas), len(a)))
    with beyond_range():
        for j, omega in enumerate(omegas):
            exact = periodic_orbits(beam, omega, a)
            for i, name in enumerate(MODELS):
                stages = [reduced_model(beam, omega, stage) for stage in _stages(VARIANTS[name])]
                model = stages[0]
                perturbed = model.frequency(model.first_harmonic(a))
                ratios = [perturbed / model.omega_n]
                ratios += [stage.exact_frequency(a) / stage.omega_n for stage in stages]
                ratios.append(exact.frequency / exact.omega_n)
                steps = [before - after for before, after in pairwise(ratios)]
                total[i, j] = (perturbed - exact.frequency) / exact.omega_n
                error[i, :, j] = [total[i, j] - sum(steps), *steps]
    label = "error of ω_NL over ω_n"
    return dataset(
        {
            "error": (("model", "source", "omega", "a"), error, label),
            "total": (("model", "omega", "a"), total, label),
        },
        {
            "model": (list(MODELS), "model"),
            "source": (list(SOURCES), "source of error"),
            "omega": (list(omegas), OMEGA),
            "a": (a, AMPLITUDE),
        },
    )


def _stages(variant: Variant) -> list[Variant]:
    """Return the model, and the models that follow as one fault after another is taken away."""
    rotating = replace(variant, shape="rotating")
    static = replace(rotating, axial="static") if variant.axial == "sine" else rotating
    consistent = replace(static, axial="consistent")
    return [variant, rotating, static, consistent, VARIANTS["FrM"]]


def finite_element_budget(
    beam: Beam | None = None,
    *,
    omegas: Sequence[float] = SPEEDS,
    ramp_times: Sequence[float] = RAMP_TIMES,
    largest_amplitude: float = 0.6,
    step: float = 1e-3,
    **options: Any,
) -> xr.Dataset:
    """Distance of the paper's mesh from the exact backbone, step and mesh apart.

    The distance of a point is its ratio less the exact one at its own amplitude, positive where
    the point is too high. Step: 16 elements at `step` [s] less the same with the step extrapolated
    to zero. Mesh: that less 64 elements, step to zero. Rest: what those still differ. The three
    add up to the distance, and step and mesh have opposite signs: their sum may vanish where
    neither does. Estimator: the uncertainty ± of the frequency's estimate, not a part of the sum.
    Amplitudes are half peak to peak on both sides.

    Returns
    -------
    Dataset
        `error` [-] over (source, omega, ramp_time) and `amplitude` [-] of the paper's mesh; NaN
        where the amplitude is above `largest_amplitude`.
    """
    beam = beam or Beam.reference()
    grid: dict[str, Any] = {"omegas": omegas, "ramp_times": ramp_times, **options}
    paper = finite_element_points(beam, mesh="paper", step=step, **grid)
    twice = sweep(beam, elements=16, step=2.0 * step, frame="inertial", **grid)
    measured = paper[["amplitude", "ratio"]]
    no_step = measured + (measured - measured_ratio(twice)) / 3.0
    converged = finite_element_points(beam, mesh="converged", step=step, **grid)
    whole, mesh, rest = (
        _distance(beam, at, largest_amplitude) for at in (paper, no_step, converged)
    )
    sources = ["step", "mesh", "rest", "estimator"]
    error = [whole - mesh, mesh - rest, rest, paper["estimator_error"].to_numpy()]
    label = "ω_NL/ω_n less the exact one; ± for the estimator"
    found = dataset(
        {"error": (("source", "omega", "ramp_time"), error, label)},
        {"source": (sources, "source of error")},
    )
    return found.assign(amplitude=paper["amplitude"])


def _distance(beam: Beam, points: xr.Dataset, largest_amplitude: float) -> FloatArray:
    """ω_NL/ω_n of points less the exact one at the same speed and amplitude, NaN if too large."""
    amplitude, ratio = points["amplitude"].to_numpy(), points["ratio"].to_numpy()
    distance = np.full(ratio.shape, np.nan)
    for i, omega in enumerate(points["omega"].to_numpy()):
        inside = amplitude[i] <= largest_amplitude
        if inside.any():
            exact = periodic_orbits(beam, float(omega), amplitude[i, inside])
            distance[i, inside] = ratio[i, inside] - exact.frequency / exact.omega_n
    return distance
