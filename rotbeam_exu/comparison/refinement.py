"""Errors of a mesh and a step: frequencies and a spin-up on several of them, and one fit to all."""

from __future__ import annotations

import itertools
import json
import math
import os
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from analytic import spin_up_response
from analytic.arrays import FloatArray
from analytic.exact.linear.modes import driven_modes
from analytic.input_checks import positive, whole_number

from ..fem.case import RunCase
from ..fem.linearization import natural_frequencies
from ..labels import dataset
from ..lazily import xr
from ..runs.attributes import blade_attributes, versions
from ..runs.check import SimulationError
from ..sweeps.cases import Cache, cache_of
from ..sweeps.grid import solved
from ..verification.convergence import converged
from ..verification.judgement import FLOOR

_IN_STEP = 2.0
"""Order of the integrators."""


def refinement(
    case: RunCase,
    *,
    count: int = 3,
    tolerance: float = 1e-4,
    exact: bool = True,
    jobs: int | None = None,
    cache: str | os.PathLike[str] | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> xr.Dataset:
    """Return the errors of frequencies and of a spin-up by mesh and step, and which to take.

    The spin-up runs on half, the same and twice the elements, and on half of them with half and a
    quarter of the step; frequencies also have four times the elements.

    Parameters
    ----------
    case : RunCase
        The mesh and the step that are asked about, two elements or more.
    count : int
        Number of frequencies.
    tolerance : float
        Wished error: of frequencies, and of q(t) over its largest size.
    exact : bool
        Whether to compute the exact answers, too.
    jobs, cache, progress
        As of `rotbeam_exu.sweep`; the frequencies of a mesh are a case too, and are kept.

    Returns
    -------
    Dataset
        Over `mesh` and `mode`: frequency [rad/s] and its error, from the limit of the fit. Over
        `mode`: the uncertainty of that limit, the order observed, and the limit's distance from
        the exact frequency. Over `run`: elements, step [s], error of q(t) by the fit, with its
        parts of mesh and step, and distance from the exact q(t). For all: the uncertainty of q(t),
        its orders, and elements and step [s] for the tolerance. All errors are relative; NaN is
        what is not known.

    Raises
    ------
    ValueError
        If an input is refused.
    SimulationError
        If a run fails; the sentence says which.
    """
    tolerance = positive("tolerance", tolerance)
    n, h = whole_number("elements", case.elements, least=2), case.step
    meshes = [n // 2, n, 2 * n, 4 * n]
    # As `converged` has them: the finest mesh last, on each the smallest step.
    resolutions = [(n // 2, h), (n // 2, h / 2.0), (n // 2, h / 4.0), (n, h), (2 * n, h)]
    store = None if cache is None else cache_of(cache, case.model)
    pieces, counted = len(meshes) + len(resolutions), itertools.count(1)

    def one_more() -> None:
        if progress is not None:
            progress(next(counted), pieces)

    frequencies = np.array([_frequencies(case, size, count, store, one_more) for size in meshes])
    modes = [
        converged(meshes, None, one / one[-1], noise=FLOOR, declared=(case.model.order, None))
        for one in frequencies.T
    ]
    time, q = _spun_up(case, resolutions, jobs, store, one_more)
    scale = np.abs(q[-1]).max()
    elements, steps = zip(*resolutions, strict=True)
    declared = case.model.order, _IN_STEP
    runs = converged(elements, steps, q / scale, noise=FLOOR, declared=declared)
    off, apart = np.full(len(q), math.nan), np.full(len(modes), math.nan)
    if exact:
        theory = case.model.theory_of(case.blade)
        true = driven_modes(case.blade, case.omega, len(modes), theory=theory)
        # Else flap, lag and torsion would have to be sorted.
        if case.model.leaves_plane <= true.model.twists:
            apart = (
                np.array([one.limit for one in modes]) * frequencies[-1] / true.frequencies - 1.0
            )
        motion: Any = case.spin_up  # a change of the speed
        response = spin_up_response(
            case.blade, motion, time, tolerance=max(0.1 * tolerance, 1e-8),
            theory=theory, loads=case.loads,
        )  # fmt: skip
        off = np.abs(q - response.q).max(axis=1) / scale
    needed = [_size(meshes, one.in_mesh, one.powers[0], tolerance) for one in modes]
    # Half of the error of q(t) is the mesh's.
    needed.append(_size(meshes[:3], runs.in_mesh[[0, 3, 4]], runs.powers[0], 0.5 * tolerance))
    finer = _size(1.0 / runs.steps[:3], runs.in_step[:3], runs.powers[1], 0.5 * tolerance)
    fitting = case.duration / math.ceil(case.duration * finer * (1.0 - 1e-9))
    return dataset(
        {
            "frequency": (
                ("mesh", "mode"), frequencies, "natural frequency in steady rotation [rad/s]"
            ),
            "frequency_error": (
                ("mesh", "mode"), np.transpose([one.errors for one in modes]),
                "relative error by the fit",
            ),
            "frequency_uncertainty": (
                "mode", [one.bar for one in modes], "relative uncertainty of the limit"
            ),
            "frequency_order": (
                "mode", [one.orders["mesh"].value for one in modes], "observed order in the mesh"
            ),
            "exact_distance": ("mode", apart, "relative distance of the limit from the exact"),
            "elements": ("run", list(elements), "elements"),
            "step": ("run", list(steps), "step [s]"),
            "error": ("run", runs.errors, "error of q(t) over its largest size, by the fit"),
            "in_mesh": ("run", runs.in_mesh, "part of the mesh in it"),
            "in_step": ("run", runs.in_step, "part of the step in it"),
            "exact_error": ("run", off, "distance of q(t) from the exact one, the same way"),
            "uncertainty": ((), runs.bar, "uncertainty of the limit of q(t)"),
            "order": ((), runs.orders["mesh"].value, "observed order of q(t) in the mesh"),
            "order_in_step": ((), runs.orders["step"].value, "observed order in the step"),
            "recommended_elements": ((), math.ceil(max(needed)), "elements for the tolerance"),
            "recommended_step": ((), fitting, "step for the tolerance [s]"),
        },
        {"mesh": (meshes, "elements"), "mode": (np.arange(1, len(modes) + 1), "mode")},
        {**case.describe(), "tolerance": tolerance, "versions": json.dumps(versions())},
    )  # fmt: skip


def _frequencies(
    case: RunCase, elements: int, count: int, store: Cache | None, one_more: Callable[[], None]
) -> FloatArray:
    """Return the first natural frequencies of a mesh [rad/s], of the cache or computed."""
    described = case.describe()
    inputs = {
        **blade_attributes(case.blade),
        **{name: described[name] for name in ("omega", "element", "element_options")},
        "elements": elements,
        "frequencies": count,
    }
    stored = store.get(inputs) if store else None
    if stored is None:
        frequencies = natural_frequencies(
            case.blade, case.omega, element=case.element, elements=elements, count=count
        )
        stored = dataset({"frequency": ("mode", frequencies, "natural frequency [rad/s]")}, {})
        if store:
            store.put(inputs, stored)
    one_more()
    return stored["frequency"].to_numpy()


def _spun_up(
    case: RunCase,
    resolutions: list[tuple[int, float]],
    jobs: int | None,
    store: Cache | None,
    one_more: Callable[[], None],
) -> tuple[FloatArray, FloatArray]:
    """Return the times of the first run [s], and q(t) of all at these [m], (runs, times)."""
    cases: dict[tuple[float, float], RunCase] = {
        (n, h): replace(case, elements=n, step=h) for n, h in resolutions
    }
    histories: dict[tuple[float, float], xr.DataArray] = {}
    for at, result in solved(cases, store, None, jobs):
        if result.attrs["failure"]:
            which = f"{at[0]} elements with a step of {at[1]:g} s"
            raise SimulationError(f"{which}: {result.attrs['failure']}")
        histories[at] = result["q"]
        one_more()
    time = histories[resolutions[0]]["time"].to_numpy()
    # Samples of other runs lie elsewhere, at least 200 in a period: a spline keeps nine digits.
    return time, np.array(
        [CubicSpline(histories[at]["time"], histories[at])(time) for at in resolutions]
    )


def _size(
    sizes: Sequence[float] | FloatArray, parts: FloatArray, power: float, tolerance: float
) -> float:
    """Return the mesh, or 1/step, at which a part of the error meets the tolerance.

    Between runs by their errors, beyond the finest by a power; of what is coarser than the coarsest
    run nothing is known.
    """
    errors = np.maximum.accumulate(np.abs(parts)[::-1])  # the finest first
    if errors[0] > tolerance:
        return float(sizes[-1] * (errors[0] / tolerance) ** (1.0 / power))
    return math.exp(np.interp(math.log(tolerance), np.log(errors), np.log(sizes)[::-1]))
