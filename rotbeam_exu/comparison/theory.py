"""Data of Figures 8 to 13, the reduced models by themselves, and the budget of their errors."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from itertools import pairwise

import numpy as np

from analytic import VARIANTS, Beam, Variant, periodic_orbits, reduced_model
from analytic.arrays import FloatArray
from analytic.input_checks import RotbeamWarning
from analytic.lazily import interpolate
from analytic.reduced.lagrangian import axial_model
from analytic.reduced.shapes import (
    CantileverMode,
    converged_degree,
    rotating_frequency,
    rotating_mode,
)

from ..labels import AMPLITUDE, OMEGA, dataset
from ..lazily import xr
from ..paper import MODELS, SPEEDS
from ..runs.attributes import blade_attributes

_SMALL = 0.03
"""Amplitude of an orbit whose harmonics give λ_x: its square times 0.08 is the error."""

_STRETCHED = 0.6
"""Share of the speed that stretches a beam without bound, up to which orbits are computed."""

_SPEED_RATIO = "speed ratio Ω = ω/ω0"
RATIO = "frequency ratio ω_NL/ω_n"


@contextmanager
def beyond_range() -> Iterator[None]:
    """Draw models beyond their range without a warning each: showing that is the purpose."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RotbeamWarning)
        yield


def figure_8() -> xr.Dataset:
    """Backbones of CI at Ω = 0, 1 and ∞, between which all others lie, and exact ones (Fig. 8).

    Returns
    -------
    Dataset
        `ratio` over (speed_ratio, amplitude), by Eq. 63; the last speed ratio, 1000, stands for ∞.
        `exact` over (exact_speed_ratio, exact_amplitude), at Ω = 0, 1 and 10.
    """
    blade = Beam.reference()
    amplitude = np.linspace(0.0, 0.4, 81)
    peaks = np.linspace(0.0, 0.4, 9)
    speed_ratios, exact_ratios = [0.0, 1.0, 1000.0], [0.0, 1.0, 10.0]
    with beyond_range():
        models = [reduced_model(blade, r * blade.omega_0, "CI") for r in speed_ratios]
        ratio = [model.frequency(amplitude) / model.omega_n for model in models]
        orbits = [periodic_orbits(blade, r * blade.omega_0, peaks[1:]) for r in exact_ratios]
    exact = [np.append(1.0, backbone.frequency / backbone.omega_n) for backbone in orbits]
    return dataset(
        {
            "ratio": (("speed_ratio", "amplitude"), ratio, RATIO),
            "exact": (("exact_speed_ratio", "exact_amplitude"), exact, RATIO),
        },
        {
            "speed_ratio": (speed_ratios, _SPEED_RATIO),
            "amplitude": (amplitude, "amplitude a = q/L"),
            "exact_speed_ratio": (exact_ratios, _SPEED_RATIO),
            "exact_amplitude": (peaks, "peak amplitude |q|/L"),
        },
        {"model": "CI", **blade_attributes(blade)},
    )


def figure_9() -> xr.Dataset:
    """λ_ω and λ_x of CI, and of the exact beam, against Ω (Fig. 9)."""
    blade = Beam.reference()
    models = {"CI": (blade, "CI"), "exact": (blade, "exact")}
    return _coefficients(models, "speed_ratio", 10.0, _SPEED_RATIO, blade.omega_0, points=201)


def figure_10() -> xr.Dataset:
    """λ_ω and λ_x of the cantilever's mode, polynomials and the exact beam against ω (Fig. 10)."""
    blade = Beam.reference()
    polynomials = {f"degree {n}": (blade, f"P{n}") for n in (3, 4, 5)}
    models = {"CI": (blade, "CI"), **polynomials, "exact": (blade, "exact")}
    return _coefficients(models, "omega", 30.0, OMEGA)


def figure_11() -> xr.Dataset:
    """λ_ω and λ_x of CE and of the exact beam against ω for several slendernesses μ (Fig. 11).

    The print does not say which μ it shows. Length, mass and bending stiffness are the beam's own;
    only the area, and with it EA = EI/(μL²), follows μ. The exact curves end at 0.6 of the speed
    that stretches the beam without bound.
    """
    blade = Beam.reference()
    beams = {}
    for mu in (1e-2, 1e-3, 1e-4, blade.slenderness):
        area = blade.second_moment / (mu * blade.length**2)
        name = f"μ = {mu:.4g}"
        beams[name] = replace(blade, area=area, density=blade.mass_per_length / area)
    models = {name: (other, "CE") for name, other in beams.items()}
    models |= {f"exact, {name}": (other, "exact") for name, other in beams.items()}
    data = _coefficients(models, "omega", 30.0, OMEGA)
    return data.assign_attrs(held="L, m and EI are held, EA = EI/(μL²)")


def figure_12() -> xr.Dataset:
    """Frobenius' natural frequency against the degree of its polynomials (Fig. 12)."""
    blade, degrees = Beam.reference(), range(8, 61, 2)
    scale = blade.frequency_scale
    estimate = np.full((len(SPEEDS), len(degrees)), np.nan)
    converged = np.empty(len(SPEEDS))
    for i, omega in enumerate(SPEEDS):
        w_bar = omega / scale
        converged[i] = scale * rotating_frequency(w_bar, converged_degree(w_bar))
        for j, degree in enumerate(degrees):
            try:
                estimate[i, j] = scale * rotating_frequency(w_bar, degree)
            except ValueError:
                continue  # so few terms that Eq. 86 has no root near the first frequency
    return dataset(
        {
            "omega_n": (("omega", "degree"), estimate, "natural frequency ω_n [rad/s]"),
            "converged": ("omega", converged, "converged natural frequency ω_n [rad/s]"),
        },
        {"omega": (list(SPEEDS), OMEGA), "degree": (list(degrees), "polynomial degree")},
        {"paper_degree": 36, **blade_attributes(blade)},
    )


def figure_13() -> xr.Dataset:
    """First mode shape at rest and in rotation (Fig. 13); speed 0 is the cantilever's."""
    blade = Beam.reference()
    eta = np.linspace(0.0, 1.0, 201)
    shapes = [CantileverMode().deflection(eta)]
    shapes += [rotating_mode(omega / blade.frequency_scale).deflection(eta) for omega in SPEEDS]
    return dataset(
        {"shape": (("omega", "eta"), shapes, "mode shape φ_v")},
        {"omega": ([0.0, *SPEEDS], OMEGA), "eta": (eta, "position η/L")},
        blade_attributes(blade),
    )


def _coefficients(
    models: dict[str, tuple[Beam, str]],
    name: str,
    last: float,
    label: str,
    scale: float = 1.0,
    points: int = 151,
) -> xr.Dataset:
    """λ_ω and λ_x over (model, axis), of variants and "exact"; NaN where nothing oscillates."""
    axis = np.linspace(0.0, last, points)
    values = np.full((2, len(models), points), np.nan)
    with beyond_range():
        for i, (blade, variant) in enumerate(models.values()):
            if variant == "exact":
                values[:, i] = _exact_coefficients(blade, scale * axis)
                continue
            for j, omega in enumerate((scale * axis).tolist()):
                try:
                    model = reduced_model(blade, omega, variant)
                except ValueError:
                    continue
                values[:, i, j] = model.lambda_omega, model.lambda_x
    dims = ("model", name)
    return dataset(
        {"lambda_omega": (dims, values[0], "λ_ω"), "lambda_x": (dims, values[1], "λ_x")},
        {"model": (list(models), "model"), name: (axis, label)},
        blade_attributes(Beam.reference()),
    )


def _exact_coefficients(blade: Beam, omegas: FloatArray) -> FloatArray:
    """λ_ω, and λ_x = h₃/h₁³ of a small orbit's harmonics (Eq. 65), over (2, omegas).

    Computed at 17 speeds, closer where λ_ω turns; a cubic spline between them is 1e-4 off at most.
    NaN near the speed that stretches the beam without bound, where orbits are slow to find.
    """
    nodes = np.linspace(0.0, 1.0, 17)
    fastest = min(float(omegas[-1]), _STRETCHED * blade.burst_speed)
    coefficients = []
    for node in nodes:
        orbits = periodic_orbits(blade, float(fastest * node**1.5), [_SMALL])
        first, third = orbits.harmonics[0, [0, 2]]
        coefficients.append((orbits.lambda_omega, third / first**3))
    curve = interpolate.CubicSpline(nodes, coefficients, extrapolate=False)
    return np.asarray(curve((omegas / fastest) ** (2.0 / 3.0)).T)


SOURCES = (
    "linear frequency", "perturbation", "shape", "elongation", "foreshortening", "Coriolis modes",
    "extensibility and higher order",
)  # fmt: skip
"""Sources of a reduced model's error, in the order in which they are taken away."""


def model_budget(
    blade: Beam | None = None,
    *,
    omegas: Sequence[float] = SPEEDS,
    amplitudes: Sequence[float] = (0.05, 0.1, 0.15, 0.2),
) -> xr.Dataset:
    """Frequency error of CI, CE, FrI, FrE, FrC and FrM, source by source.

    Each model is changed into the exact one step by step. A source is the difference of the
    frequencies before and after its step; the sources add up to the whole error. The first are the
    linear frequency (both relative to the model's own ω_n), the perturbation (Eq. 63 less Eq. 41
    solved exactly from the peak a) and the shape (cantilever's mode for the rotating one). Then
    come the elongation (its own for the static solution), the foreshortening (-v'²/2 for -v'²/2 -
    v'⁴/8), the Coriolis modes (FrC less FrM), and the rest between FrM and the exact beam.

    Returns
    -------
    Dataset
        `error`, (ω_NL - ω_NL,exact)/ω_n,exact [-], over (model, source, omega, a), and `total`
        over (model, omega, a); a is the peak of |q|/L in all of them.
    """
    blade = blade or Beam.reference()
    a = np.asarray(amplitudes)
    error = np.empty((len(MODELS), len(SOURCES), len(omegas), len(a)))
    total = np.empty((len(MODELS), len(omegas), len(a)))
    with beyond_range():
        for j, omega in enumerate(omegas):
            exact = periodic_orbits(blade, omega, a)
            for i, name in enumerate(MODELS):
                stages = [reduced_model(blade, omega, stage) for stage in _stages(VARIANTS[name])]
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
    stretches = axial_model(variant.axial).elongation is not None
    static = replace(rotating, axial="static") if stretches else rotating
    consistent = replace(static, axial="consistent")
    return [variant, rotating, static, consistent, VARIANTS["FrM"]]
