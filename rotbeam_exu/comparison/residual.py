"""Residual amplitude after Eq. 1 over its ramp time: closed form, transient, finite elements."""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Callable

import numpy as np

from analytic import (
    AnyBlade,
    Beam,
    SpinUp,
    linear_modes,
    quiet_ramp_times,
    residual_amplitude,
)
from analytic.arrays import FloatArray
from analytic.description import describe
from analytic.input_checks import positive, whole_number

from ..fem.elements import Formulation, formulation
from ..fem.simulation import simulate
from ..labels import dataset
from ..lazily import xr
from ..runs.attributes import beam_attributes

_CURVE = 400
_SHORTEST = 0.8
"""Shortest ramp time, in periods at rest."""
_LARGEST = 0.9
"""Closed form beyond which the blade is thrown about, and nothing is measured."""
_STEPS = 2000
"""Steps in a period after the ramp."""


def residual(
    beam: AnyBlade | None = None,
    omega: float = 6.0,
    *,
    longest: float | None = None,
    points: int = 9,
    finite_element_points: int = 5,
    element: str | Formulation = "cable",
    elements: int = 16,
    progress: Callable[[int, int], None] | None = None,
) -> xr.Dataset:
    """Return the amplitude that Eq. 1 leaves over its ramp time.

    Parameters
    ----------
    beam : Beam or Blade, optional
        By default the paper's beam.
    omega : float
        Speed after the ramp [rad/s].
    longest : float, optional
        Longest ramp time [s], by default five periods of the blade at rest.
    points, finite_element_points : int
        Numbers of ramp times of exact transients and of finite element runs, or zero. They are
        evenly spaced, from where the closed form leaves 0.9 to the longest.
    element, elements
        As in `simulate`.
    progress : callable, optional
        Called with the transients and runs done and their number.

    Returns
    -------
    Dataset
        `linear` and `corrected` (by the backbone's action) over `ramp_time`, `exact` over
        `exact_ramp_time`, `finite_element` over `finite_element_ramp_time`, `quiet` over
        `quiet_ramp_time`: half peak to peak of the tip over L; `quiet` that of the first mode.
    """
    blade = Beam.reference() if beam is None else beam
    period = 2.0 * math.pi / blade.omega_0
    longest = 5.0 * period if longest is None else positive("longest", longest, "s")
    if longest <= _SHORTEST * period:
        raise ValueError(
            f"longest must be above {_SHORTEST:g} periods at rest, {_SHORTEST * period:.4g} s, got "
            f"{longest:g} s"
        )
    model = formulation(element)
    counts = [
        whole_number("points", points, least=0),
        whole_number("finite_element_points", finite_element_points, least=0),
    ]
    one = SpinUp(omega=omega, ramp_time=longest)
    curve = np.linspace(_SHORTEST * period, longest, _CURVE)
    linear = residual_amplitude(blade, one, curve)
    corrected = residual_amplitude(blade, one, curve, corrected=True)
    calm = curve[linear <= _LARGEST].min(initial=longest)
    exact_at, elements_at = (np.linspace(calm, longest, count) for count in counts)
    done = itertools.count(1)

    def measured(measure: Callable[[SpinUp], float], times: FloatArray) -> list[float]:
        left = []
        for T in times.tolist():
            left.append(measure(SpinUp(omega=omega, ramp_time=T)))
            if progress is not None:
                progress(next(done), sum(counts))
        return left

    exact = measured(
        lambda ramp: residual_amplitude(blade, ramp, exact=True, tolerance=1e-5), exact_at
    )
    runs = measured(lambda ramp: _of_elements(blade, ramp, model, elements), elements_at)
    quiet = quiet_ramp_times(blade, omega, longest=longest)
    left = "amplitude left over L, "
    by_backbone = f"{left}closed form, corrected by the backbone"
    ramp_time = "ramp time T [s]"
    return dataset(
        {
            "linear": ("ramp_time", linear, f"{left}closed form"),
            "corrected": ("ramp_time", corrected, by_backbone),
            "exact": ("exact_ramp_time", exact, f"{left}exact transient"),
            "finite_element": ("finite_element_ramp_time", runs, f"{left}finite elements"),
            "quiet": ("quiet_ramp_time", quiet.left, f"{left}quiet ramps"),
        },
        {
            "ramp_time": (curve, ramp_time),
            "exact_ramp_time": (exact_at, ramp_time),
            "finite_element_ramp_time": (elements_at, ramp_time),
            "quiet_ramp_time": (quiet.ramp_times, ramp_time),
        },
        {
            **beam_attributes(blade),
            "omega": omega,
            "longest": longest,
            "element": model.name,
            "element_options": json.dumps(describe(model)),
            "elements": elements,
        },
    )


def _of_elements(blade: AnyBlade, ramp: SpinUp, element: Formulation, elements: int) -> float:
    """Return half peak to peak over L in the first period after the ramp, of a run."""
    period = 2.0 * math.pi / float(linear_modes(blade, ramp.omega, 1).frequencies[0])
    step = min(period / _STEPS, ramp.ramp_time / _STEPS)
    duration = step * math.ceil((ramp.ramp_time + 1.1 * period) / step)
    run = simulate(blade, ramp, element=element, elements=elements, duration=duration, step=step)
    q = run["q"].sel(time=slice(ramp.ramp_time, None)).to_numpy()
    return float(np.ptp(q)) / (2.0 * blade.length)
