"""Curves and maps: what a ramp leaves over its time, and λ_ω and growth over the speed."""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Callable, Sequence

import numpy as np

from analytic import Beam, Blade, Rectangle, SpinUp, quiet_ramp_times, residual_amplitude
from analytic.arrays import FloatArray
from analytic.description import describe
from analytic.exact.free.planar_orbits import growth_rates
from analytic.input_checks import finite_values, positive, whole_number
from analytic.reduced.any_blade import blade_oscillator
from analytic.spin_up.modes_over_speed import excited_mode, period_of
from analytic.warning import warn

from ..fem.elements import Formulation, formulation
from ..fem.simulation import simulate
from ..labels import GROWTH, OMEGA, ORBIT, dataset
from ..lazily import xr
from ..runs.attributes import blade_attributes, theory_attributes

_W_BAR = "speed ω̄ = ω/√(EI/ρAL⁴)"
_CURVE = 400
_SHORTEST = 0.8
"""Shortest ramp time, in periods at rest."""
_LARGEST = 0.9
"""Closed form beyond which the blade is thrown about, and nothing is measured."""
_LARGEST_IN_SPACE = 0.25  # where a transient takes minutes beyond it
_TOLERANCE = 1e-5  # of exact transients
_STEPS = 1000
"""Steps in a period after the ramp."""


def residual(
    blade: Blade | None = None,
    omega: float = 6.0,
    *,
    mode: str | int = "lag 1",
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
    blade : Blade, optional
        By default the paper's beam.
    omega : float
        Speed after the ramp [rad/s].
    mode : str or int
        As for `analytic.residual_amplitude`.
    longest : float, optional
        Longest ramp time [s], by default five periods of the blade at rest.
    points, finite_element_points : int
        Numbers of ramp times of exact transients and of finite element runs, or zero. They are
        evenly spaced, from where the closed form leaves 0.9, in space 0.25, to the longest.
    element, elements
        As in `simulate`; the theory is that of the element.
    progress : callable, optional
        Called with the transients and runs done and their number.

    Returns
    -------
    Dataset
        Half peak to peak of the tip over L along the mode's motion: `linear`, `corrected` (by the
        backbone's action; NaN of other modes than lag 1, and of blades in space) and `all_modes`
        over `ramp_time`, `exact` over `exact_ramp_time`, `finite_element` over
        `finite_element_ramp_time`, `quiet` over `quiet_ramp_time`; `linear` and `quiet` are of the
        mode alone.
    """
    blade = Beam.reference() if blade is None else blade
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
    theory = model.theory_of(blade)
    mode = excited_mode(blade, omega, mode, theory)
    linear = residual_amplitude(blade, one, curve, mode=mode, theory=theory)
    corrected = np.full(_CURVE, np.nan)
    if blade.is_planar and mode == "lag 1":
        corrected = residual_amplitude(blade, one, curve, theory=theory, corrected=True)
    together = residual_amplitude(blade, one, curve, mode=mode, theory=theory, all_modes=True)
    swing, largest = together, _LARGEST
    if not blade.is_planar:
        ways = [
            together
            if of == mode
            else residual_amplitude(blade, one, curve, mode=of, theory=theory, all_modes=True)
            for of in ("flap 1", "lag 1")
        ]
        swing, largest = np.hypot(*ways), _LARGEST_IN_SPACE
    calm = float(curve[swing <= largest].min(initial=longest))
    shortest = None if blade.is_planar else calm
    exact_at, elements_at = (np.linspace(calm, longest, count) for count in counts)

    def more(done: int, count: int) -> None:
        if progress is not None:
            progress(done, count + sum(counts))

    quiet = quiet_ramp_times(
        blade,
        omega,
        mode=mode,
        theory=theory,
        shortest=shortest,
        longest=longest,
        tolerance=_TOLERANCE,
        progress=more,
    )
    found, done = quiet.ramp_times.size, itertools.count(quiet.ramp_times.size + 1)

    def measured(measure: Callable[[SpinUp], float], times: FloatArray) -> list[float]:
        left = []
        for T in times.tolist():
            try:
                left.append(measure(SpinUp(omega=omega, ramp_time=T)))
            except RuntimeError as error:
                warn(f"a ramp of {T:.4g} s is not among the results: {error}")
                left.append(math.nan)
            more(next(done), found)
        return left

    exact = measured(
        lambda ramp: residual_amplitude(
            blade, ramp, mode=mode, theory=theory, exact=True, tolerance=_TOLERANCE
        ),
        exact_at,
    )
    runs = measured(lambda ramp: _of_elements(blade, ramp, mode, model, elements), elements_at)
    left = "amplitude left over L, "
    by_backbone = f"{left}closed form, corrected by the backbone"
    ramp_time = "ramp time T [s]"
    return dataset(
        {
            "linear": ("ramp_time", linear, f"{left}closed form"),
            "corrected": ("ramp_time", corrected, by_backbone),
            "all_modes": ("ramp_time", together, f"{left}closed form of all modes"),
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
            **blade_attributes(blade),
            "omega": omega,
            **theory_attributes(theory),
            "mode": mode,
            "longest": longest,
            "element": model.name,
            "element_options": json.dumps(describe(model)),
            "elements": elements,
        },
    )


def _of_elements(
    blade: Blade, ramp: SpinUp, mode: str, element: Formulation, elements: int
) -> float:
    """Return half peak to peak over L in the first period after the ramp, of a run."""
    period = period_of(blade, ramp.omega, element.theory_of(blade), mode)
    step = min(period / _STEPS, ramp.ramp_time / _STEPS)
    duration = step * math.ceil((ramp.ramp_time + 1.1 * period) / step)
    run = simulate(blade, ramp, element=element, elements=elements, duration=duration, step=step)
    name = "w" if mode.startswith("flap") else "q"
    q = run[name].sel(time=slice(ramp.ramp_time, None)).to_numpy()
    return float(np.ptp(q)) / (2.0 * blade.length)


def softening_map(blade: Blade | None = None) -> xr.Dataset:
    """Return λ_ω of FrM and ω_2/ω_n of a blade on hubs of many radii, at many speeds.

    Inextensible, by the closed form of `analytic.reduced.any_blade`. Near whole numbers of ω_2/ω_n
    an internal resonance bends the backbone, and λ_ω is that of the smallest amplitudes only.

    Parameters
    ----------
    blade : Blade, optional
        By default the paper's beam; its own hub radius is replaced.

    Returns
    -------
    Dataset
        `lambda_omega` and `ratio` = ω_2/ω_n over R/L from 0 to 5 and w̄ = ω/√(EI/ρAL⁴) from 0 to
        10, (hub_ratio, w_bar).
    """
    blade = Beam.reference() if blade is None else blade
    # Closer where the hub is small: the map turns there.
    hubs, speeds = 5.0 * np.linspace(0.0, 1.0, 33) ** 2, np.linspace(0.0, 10.0, 41)
    coefficients, ratios = np.empty((2, hubs.size, speeds.size))
    for i, hub in enumerate(hubs.tolist()):
        unit = blade.with_hub_radius(hub * blade.length).unit
        for j, w_bar in enumerate(speeds.tolist()):
            solution = blade_oscillator(unit, w_bar, coriolis=True)
            coefficients[i, j] = solution.oscillator.lambda_omega
            ratios[i, j] = solution.others[0] / solution.oscillator.w_n
    dims = ("hub_ratio", "w_bar")
    return dataset(
        {
            "lambda_omega": (dims, coefficients, "λ_ω"),
            "ratio": (dims, ratios, "second over first frequency"),
        },
        {"hub_ratio": (hubs, "hub radius R/L"), "w_bar": (speeds, _W_BAR)},
    )


def growth_out_of_plane(
    blade: Blade | None = None,
    *,
    omegas: Sequence[float] | None = None,
    amplitudes: Sequence[float] | None = None,
    damping: float = 0.005,
) -> xr.Dataset:
    """Return how fast planar orbits leave their plane, over speed and amplitude.

    The 6600 points unless others are given take four minutes. Tongues between them are missed.

    Parameters
    ----------
    blade : Blade, optional
        With a section out of the plane; by default the paper's beam as the rectangle that has its
        A and I.
    omegas : sequence of float, optional
        Rotation speeds [rad/s], by default 0 to 8.
    amplitudes : sequence of float, optional
        Peaks |q|/L, by default 0.01 to 0.5.
    damping : float
        Damping ratio of all modes of flap and torsion.

    Returns
    -------
    Dataset
        `growth_rate`, where stable the least decay rate, below zero (zero without damping), NaN
        where no orbit was found, over (omega, a).
    """
    blade = Beam.reference().with_shape(Rectangle()) if blade is None else blade
    given = np.linspace(0.0, 8.0, 81) if omegas is None else omegas
    speeds = finite_values("omegas", given, "rad/s")
    # Closer where the tongues are.
    near, far = np.geomspace(0.01, 0.1, 72), np.geomspace(0.11, 0.5, 10)
    peaks = np.concatenate((near, far)) if amplitudes is None else np.asarray(amplitudes)
    rates = np.array([growth_rates(blade, omega, peaks, damping) for omega in speeds.tolist()])
    return dataset(
        {"growth_rate": (("omega", "a"), rates, GROWTH)},
        {"omega": (speeds, OMEGA), "a": (peaks, ORBIT)},
        {**blade_attributes(blade), "damping": damping},
    )
