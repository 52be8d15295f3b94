"""Data of Figures 5 and 14: frequency against amplitude, measured, modeled and exact."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal

import numpy as np
from numpy.linalg import norm

from analytic import Beam, periodic_orbits, reduced_model

from ..labels import AMPLITUDE, OMEGA, dataset, labeled
from ..lazily import xr
from ..paper import MODELS, RAMP_TIMES, SPEEDS
from ..runs import Frame
from ..runs.attributes import blade_attributes
from ..sweeps.grid import sweep
from .theory import RATIO, beyond_range

_FITTED = 0.6
"""Amplitude up to which Figure 5's curves are fitted: beyond, a⁶ counts too."""

Mesh = Literal["paper", "converged"]

_MESHES: dict[str, tuple[int, Frame]] = {"paper": (16, "inertial"), "converged": (64, "rotating")}

_SAFETY = 1.25
"""Roache's factor (1994) on errors of discretization whose order is known, not observed."""


def finite_element_points(
    blade: Beam,
    mesh: Mesh,
    *,
    omegas: Sequence[float] = SPEEDS,
    ramp_times: Sequence[float] = RAMP_TIMES,
    step: float = 1e-3,
    **options: Any,
) -> xr.Dataset:
    """Amplitude, ratio ω_NL/ω_n and their errors over (omega, ramp_time), of finite elements.

    `ω_n` is that of the same mesh; `estimator_error` is the estimator's share in the error of the
    ratio. Options are those of `sweep`.
    """
    elements, frame = _MESHES[mesh]
    grid: dict[str, Any] = {"omegas": omegas, "ramp_times": ramp_times, "frame": frame, **options}

    def measured(elements: int, step: float) -> tuple[xr.Dataset, xr.Dataset]:
        runs = sweep(blade, elements=elements, step=step, **grid)
        linear = runs["omega_n"]
        ratio, error = runs["frequency"] / linear, runs["frequency_error"] / linear
        bar = xr.Dataset({"amplitude": runs["amplitude_error"], "ratio": error})
        return xr.Dataset({"amplitude": runs["amplitude"], "ratio": ratio}), bar

    points, bar = measured(elements, step)
    coarse_step, _ = measured(elements, 2.0 * step)
    coarse_mesh, _ = measured(elements // 2, 2.0 * step)
    # The step's error is of second order, the mesh's of fourth.
    to_zero_step = (points - coarse_step) / 3.0
    mesh_left = abs(coarse_step - coarse_mesh) / 15.0
    step_left, steps = abs(to_zero_step), f"step {1e3 * step:g} ms"
    if mesh == "converged":
        points, step_left = points + to_zero_step, 0.1 * step_left
        steps = f"steps of {1e3 * step:g} and {2e3 * step:g} ms extrapolated to zero"
    error = _SAFETY * (step_left + mesh_left) + bar
    for name, label in {"amplitude": AMPLITUDE, "ratio": RATIO}.items():
        points[name].attrs = labeled(label)
        whole = labeled(f"error of the {name}: step, mesh and estimator")
        points[f"{name}_error"] = error[name].assign_attrs(whole)
    alone = labeled("error of the ratio: estimator alone")
    points["estimator_error"] = bar["ratio"].assign_attrs(alone)
    numerics = f"{elements} cable elements, {frame} frame, {steps}"
    points.attrs = {**blade_attributes(blade), "mesh": mesh, "meshes": numerics}
    return points


def figure_5(**options: Any) -> xr.Dataset:
    """Finite element points and the least-squares curves 1 - λ_ω a² - κ a⁴ (Fig. 5).

    The paper draws parabolas; over its amplitudes, up to 0.84, none fits: least squares then give
    a λ_ω a third or more too large at 6 and 8 rad/s. The curves are fitted for a < 0.6.

    Returns
    -------
    Dataset
        The points of the paper's mesh over (omega, ramp_time). `lambda_omega` and `quartic` κ over
        omega, with `lambda_omega_error`: the points' own errors, plus the standard error by their
        scatter. The curves `fit` over (omega, a), up to a = 0.6. The exact backbone is `exact`
        over `exact_amplitude`, (omega, node), up to the largest point of each speed. Options are
        those of `figure_14`.
    """
    blade = Beam.reference()
    points = finite_element_points(blade, "paper", **options)
    fit = _fitted(points)
    a = xr.DataArray(np.linspace(0.0, _FITTED, 61), dims="a", attrs=labeled(AMPLITUDE))
    curve = 1.0 - fit["lambda_omega"] * a**2 - fit["quartic"] * a**4
    data = points.merge(fit).assign(fit=curve.assign_attrs(labeled(RATIO))).assign_coords(a=a)
    top = points["amplitude"].max("ramp_time")
    peaks = top * xr.DataArray(np.linspace(0.0, 1.0, 25), dims="node")
    orbits = [
        periodic_orbits(blade, omega, row[1:])
        for omega, row in zip(points["omega"].to_numpy().tolist(), peaks.to_numpy(), strict=True)
    ]
    exact = [np.append(1.0, backbone.frequency / backbone.omega_n) for backbone in orbits]
    return data.assign(exact_amplitude=peaks, exact=(peaks.dims, exact, labeled(RATIO)))


def _fitted(points: xr.Dataset) -> xr.Dataset:
    """Return λ_ω, κ and the error of λ_ω by least squares: ratio = 1 - λ_ω a² - κ a⁴ to _FITTED."""
    fits = []
    for omega in points["omega"]:
        here = points.sel(omega=omega)
        inside = (here["amplitude"] < _FITTED).to_numpy()
        square = here["amplitude"].to_numpy()[inside] ** 2
        columns = np.stack([square, square**2], axis=1)
        drop = 1.0 - here["ratio"].to_numpy()[inside]
        inverse = np.linalg.pinv(columns)
        solution = inverse @ drop
        free = square.size - solution.size
        scatter = np.sum((drop - columns @ solution) ** 2) / free if free > 0 else np.nan
        # Errors of step and mesh have one sign at all points of a speed: no square root of a sum.
        of_points = np.abs(inverse[0]) @ here["ratio_error"].to_numpy()[inside]
        fits.append([*solution, of_points + np.sqrt(scatter) * norm(inverse[0])])
    values = np.array(fits)
    return dataset(
        {
            "lambda_omega": ("omega", values[:, 0], "λ_ω"),
            "quartic": ("omega", values[:, 1], "a⁴ coefficient"),
            "lambda_omega_error": ("omega", values[:, 2], "error of λ_ω"),
        },
        {"omega": points["omega"]},
    )


def figure_14(
    blade: Beam | None = None,
    *,
    omegas: Sequence[float] = SPEEDS,
    ramp_times: Sequence[float] = RAMP_TIMES,
    amplitudes: Sequence[float] = tuple(np.linspace(0.02, 0.6, 30).round(3).tolist()),
    meshes: Sequence[Mesh] = ("paper", "converged"),
    **options: Any,
) -> xr.Dataset:
    """Backbones of all models, the exact one, and the finite element points (Fig. 14).

    Parameters
    ----------
    blade : Blade, optional
        By default the paper's.
    omegas, ramp_times : sequences of float
        Grid of the spin-ups [rad/s], [s].
    amplitudes : sequence of float
        Peaks |q|/L of the curves.
    meshes : sequence of {"paper", "converged"}
        "paper": 16 elements, inertial frame, step 1 ms; the error is the whole distance to a step
        of zero, from steps of 1 and 2 ms. "converged": 64 elements, rotating frame, the same steps
        extrapolated to zero; the error is a tenth of the extrapolation. Both add a fifteenth of the
        change by half the elements, for a mesh error of fourth order, and the estimator's own.
    **options
        `step`, the smaller one [s], for a beam that is faster or slower than the paper's;
        `duration`, `jobs`, `executor`, `cache`, `progress`, as for `sweep`.

    Returns
    -------
    Dataset
        `backbone`, ω_NL/ω_n [-] by Eq. 63, over (model, omega, a), model "exact" included;
        `linear_frequency` ω_n [rad/s] over (model, omega); amplitude, ratio and their errors over
        (mesh, omega, ramp_time). Every amplitude is the peak of |q|/L; Eq. 63 is taken at its first
        harmonic. `as_printed` is Eq. 63 with a itself for the first harmonic, as the paper draws
        it.
    """
    blade = blade or Beam.reference()
    grid: dict[str, Any] = {"omegas": omegas, "ramp_times": ramp_times, **options}
    by_mesh = [finite_element_points(blade, mesh, **grid) for mesh in meshes]
    points = xr.concat(by_mesh, dim="mesh")
    points["mesh"] = ("mesh", list(meshes), labeled("finite element mesh"))
    return points.merge(backbones(blade, omegas, amplitudes)).assign_attrs(
        mesh="", meshes="; ".join(one.attrs["meshes"] for one in by_mesh)
    )


def backbones(blade: Beam, omegas: Sequence[float], amplitudes: Sequence[float]) -> xr.Dataset:
    """Backbones of the reduced models by Eq. 63, and the exact one, over (model, omega, a).

    Over the peak of |q|/L, and as printed: over the first harmonic of the models, which is called
    by the same letter.
    """
    names = (*MODELS, "exact")
    a = list(amplitudes)
    ratio = np.empty((2, len(names), len(omegas), len(a)))
    linear = np.empty((len(names), len(omegas)))
    with beyond_range():
        for j, omega in enumerate(omegas):
            for i, name in enumerate(MODELS):
                model = reduced_model(blade, omega, name)
                linear[i, j] = model.omega_n
                both = np.array([model.first_harmonic(a), a])
                ratio[:, i, j] = model.frequency(both) / model.omega_n
            exact = periodic_orbits(blade, omega, a)
            linear[-1, j] = exact.omega_n
            ratio[:, -1, j] = exact.frequency / exact.omega_n
    dims = ("model", "omega", "a")
    return dataset(
        {
            "backbone": (dims, ratio[0], RATIO),
            "as_printed": (dims, ratio[1], RATIO),
            "linear_frequency": (dims[:2], linear, "natural frequency ω_n [rad/s]"),
        },
        {"model": (list(names), "model"), "omega": (list(omegas), OMEGA), "a": (a, AMPLITUDE)},
    )
