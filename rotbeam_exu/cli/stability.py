"""`rotbeam stability`: whether planar motion of a section stays in the plane."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

import analytic
from analytic.blade_checks import require_planar, undamped
from analytic.input_checks import not_negative

from ..files.result_tables import parts
from ..lazily import xr
from .job import Results
from .options import Amplitudes, Number
from .output import bar, formatted, print_columns, print_text
from .request import Request, uses

if TYPE_CHECKING:
    from analytic.exact.free.stability_limit import StabilityLimit
    from analytic.exact.stability.growth import GrowthOutOfPlane

_AMPLITUDES = [0.02, 0.035, 0.05, 0.08, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6]


@uses("omega", "section", "theory")
def stability(
    request: Request,
    *,
    amplitude: Amplitudes = _AMPLITUDES,
    mode: str = "lag 1",
    damping_ratio: Number = 0.0,
    results: Results = Results(),
) -> None:
    """Find whether motion in the plane of rotation stays in it.

    Prints the limit of the amplitude, above which all orbits grow by more than 0.01 per radian, or
    with damping at all, a table over the amplitude, and one of the narrow tongues
    below the limit; writes netCDF, CSV and a figure.

    Parameters
    ----------
    amplitude
        Amplitudes of the planar orbits over the length, one or several; the limit is searched up
        to the largest.
    mode
        Mode of lag from which the orbits grow, as "lag 1".
    damping_ratio
        Damping ratio of all modes of flap and torsion, besides the damping of the file's blade.

    Examples
    --------
    $ rotbeam stability --omega 2 --section rectangle --ratio 18.5
    $ rotbeam stability --omega 6 --section tube
    $ rotbeam stability --omega 2 --section rectangle --damping-ratio 0.005
    """
    not_negative("damping-ratio", damping_ratio)
    blade, omega = request.blade, request.omega
    require_planar(blade, "planar motion is of", "rotbeam backbone, whose orbits are in space")
    if blade.section.out_of_plane is None and not blade.section.knows_space:
        raise ValueError(
            "the section out of the plane is unknown: give --section rectangle or --section tube, "
            "or [blade.section.out_of_plane] in --config"
        )
    amplitudes = sorted(set(amplitude))
    digits = " ".join(f"{a:.17g}" for a in amplitudes)
    inputs = request.inputs(omega=omega, mode=mode, amplitudes=digits, damping_ratio=damping_ratio)
    theory = request.theory

    def computed() -> tuple[GrowthOutOfPlane, StabilityLimit, xr.Dataset]:
        with bar("growth out of the plane"):
            limit = analytic.stability_limit(
                blade, omega, mode, largest=amplitudes[-1], damping=damping_ratio, theory=theory
            )
            orbits = analytic.periodic_orbits(
                undamped(blade), omega, amplitudes, mode, theory=request.theory
            )
            growth = orbits.out_of_plane(damping_ratio, blade_damping=blade.damping)
        return growth, limit, xr.Dataset(attrs={**inputs, "sentence": str(limit)})

    results.job(
        f"stability-{request.section}-omega-{omega:g}-{mode.replace(' ', '-')}", inputs, computed,
        lambda results, _: _print(*results[:2]),
        table=lambda data: parts(data)["growth_rate"],
        draw=lambda figures, data: figures.planar_stability(data),
    )  # fmt: skip


def _print(growth: GrowthOutOfPlane, limit: StabilityLimit) -> None:
    print_text(f"{limit}.")
    rate = np.where(growth.growth_rate == 0.0, np.nan, growth.growth_rate)
    print_columns(
        {
            "|q|/L": formatted(growth.amplitude, "g"),
            "growth [1/s]": [
                f"{text}{'' if sure else '!'}"
                for text, sure in zip(formatted(rate, ".4g"), growth.converged, strict=True)
            ],
            "e-fold [periods]": formatted(growth.frequency / (2.0 * math.pi * rate), ".3g"),
            "how": list(growth.kind),
            "what": [" and ".join(modes) for modes in growth.modes],
        },
    )
    if not np.all(growth.converged):
        print_text("! not confirmed within 1 % by more functions and steps")
    if not limit.tongues:
        return
    print_columns(
        {
            "from |q|/L": formatted((tongue.low for tongue in limit.tongues), ".4g"),
            "to": formatted((tongue.high for tongue in limit.tongues), ".4g"),
            "growth per radian": formatted((tongue.growth for tongue in limit.tongues), ".2g"),
            "how": [tongue.kind for tongue in limit.tongues],
            "what": [" and ".join(tongue.modes) for tongue in limit.tongues],
        },
        title="Tongues" + (" below the limit" if math.isfinite(limit.amplitude) else ""),
    )
