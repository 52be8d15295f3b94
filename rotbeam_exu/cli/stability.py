"""`rotbeam stability`: whether planar motion of a section stays in the plane."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

import analytic
from analytic.exact.plane.planarity import LEAST_GROWTH
from analytic.input_checks import positive, whole_number

from ..runs.attributes import beam_attributes
from .configuration import configured, omega_of
from .job import Job, drawn
from .options import Amplitudes, Results, Whole
from .output import new_console, print_columns, print_text
from .sections import SectionOptions

_RESULTS = Results()
_GIVEN = SectionOptions()
_AMPLITUDES = [0.02, 0.035, 0.05, 0.08, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6]


def stability(
    *,
    omega: float | None = None,
    shape: SectionOptions = _GIVEN,
    amplitude: Amplitudes = _AMPLITUDES,
    mode: Whole = 1,
    growth: float = LEAST_GROWTH,
    config: Path | None = None,
    results: Results = _RESULTS,
) -> None:
    """Tell whether motion in the plane of rotation stays in it.

    A sentence on the amplitude from which on it does not, a table over the amplitude, one of the
    narrow tongues below, netCDF, CSV and a figure.

    Parameters
    ----------
    omega
        Rotation speed [rad/s]; needed, unless [motion] of the file has it.
    amplitude
        Amplitudes of the planar orbits over the length, one or several; the limit is looked for up
        to the largest.
    mode
        In-plane mode from which the orbits grow.
    growth
        Growth out of the plane per radian of the orbit above which all orbits are beyond the limit.
    config
        TOML file with the beam, and if it likes with [motion]; without it, the paper's beam.

    Examples
    --------
    $ rotbeam stability --omega 2 --section rectangle --ratio 18.5
    $ rotbeam stability --omega 6 --section tube
    """
    from ..datasets import dataset_of

    whole_number("mode", mode)
    positive("growth", growth)
    file = configured(config)
    omega = omega_of(file, omega)
    blade = shape.required_of(file.beam)
    amplitudes = sorted(set(amplitude))
    asked = " ".join(f"{a:.17g}" for a in amplitudes)
    inputs = {**beam_attributes(blade), "omega": omega, "mode": mode, "amplitudes": asked}
    inputs["growth"] = growth

    def computed() -> tuple[analytic.PlanarStability, analytic.StabilityLimit]:
        found = analytic.planar_stability(blade, omega, amplitudes, mode)
        return found, analytic.stability_limit(
            blade, omega, mode, growth=growth, largest=amplitudes[-1]
        )

    Job(
        path=results.out / f"stability-{shape.name}-omega-{omega:g}-mode-{mode}",
        inputs=inputs,
        force=results.force,
        compute=computed,
        dataset=lambda pair: dataset_of(*pair).assign_attrs(inputs),
        table=lambda data: data.drop_vars(["multipliers", "part"]),
        show=lambda pair, _: _print(*pair),
        draw=drawn(lambda figures, data: figures.planar_stability(data)),
    ).run()


def _print(found: analytic.PlanarStability, limit: analytic.StabilityLimit) -> None:
    console = new_console()
    print_text(console, f"{limit}.")
    print_columns(
        {
            "|q|/L": [f"{a:g}" for a in found.amplitude],
            "growth [1/s]": [
                "-" if rate == 0.0 else f"{rate:.4g}{'' if sure else '!'}"
                for rate, sure in zip(found.growth_rate, found.converged, strict=True)
            ],
            "e-fold [periods]": [
                "-" if rate == 0.0 else f"{frequency / (2.0 * math.pi * rate):.3g}"
                for rate, frequency in zip(found.growth_rate, found.frequency, strict=True)
            ],
            "how": list(found.kind),
            "what": [" and ".join(modes) for modes in found.modes],
        },
        "table",
    )
    if not np.all(found.converged):
        print_text(console, "! not confirmed within 1 % by more functions and steps")
    _print_tongues(limit)


def _print_tongues(limit: analytic.StabilityLimit) -> None:
    if not limit.tongues:
        return
    print_columns(
        {
            "from |q|/L": [f"{tongue.low:.4g}" for tongue in limit.tongues],
            "to": [f"{tongue.high:.4g}" for tongue in limit.tongues],
            "growth per radian": [f"{tongue.growth:.2g}" for tongue in limit.tongues],
            "how": [tongue.kind for tongue in limit.tongues],
            "what": [" and ".join(tongue.modes) for tongue in limit.tongues],
        },
        "table",
        title="Tongues" + (" below the limit" if math.isfinite(limit.amplitude) else ""),
    )
