"""`rotbeam stability`: whether planar motion of a section stays in the plane."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Literal

import numpy as np

from analytic import AnyBlade, Beam, Blade, OutOfPlane, planar_stability, stability_limit
from analytic.input_checks import whole_number

from .. import comparison
from ..files.beam_file import load_beam
from ..files.results import save, writable_folder
from ..verdict import beam_attributes
from .cost import require_affordable
from .options import Amplitudes, Results, Whole
from .output import new_console, print_columns
from .targets import listed, refuse_to_replace

_SECONDS_PER_ORBIT = 0.1
"""From below."""
_RESULTS = Results()
_AMPLITUDES = [0.02, 0.035, 0.05, 0.08, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6]

Shape = Literal["rectangle", "tube", "given"]


def stability(
    *,
    omega: float,
    section: Shape = "given",
    ratio: float | None = None,
    poisson_ratio: float = 0.3,
    amplitude: Amplitudes = _AMPLITUDES,
    mode: Whole = 1,
    config: Path | None = None,
    results: Results = _RESULTS,
) -> None:
    """Tell whether motion in the plane of rotation stays in it.

    A sentence, a table over the amplitude, netCDF, CSV and a figure.

    Parameters
    ----------
    omega
        Rotation speed [rad/s].
    section
        The section out of the plane: a rectangle, a thin tube, or that of the file given.
    ratio
        Height in the plane over width of the rectangle, whose material and size follow the beam's
        EA, EI and mass; without it, the rectangle that has the beam's A and I.
    poisson_ratio
        Poisson's ratio, for the torsional stiffness.
    amplitude
        Amplitudes of the planar orbits over the length, one or several; the least unstable one is
        looked for up to the largest.
    mode
        In-plane mode from which the orbits grow.
    config
        TOML file with the beam; without it, the paper's beam.

    Examples
    --------
    $ rotbeam stability --omega 2 --section rectangle --ratio 18.5
    $ rotbeam stability --omega 6 --section tube
    """
    whole_number("mode", mode)
    require_affordable(
        f"{len(amplitude)} orbits",
        seconds=_SECONDS_PER_ORBIT * len(amplitude),
        remedy="take fewer amplitudes",
    )
    beam = Beam.reference() if config is None else load_beam(config)
    blade = _shaped(beam, section, ratio, poisson_ratio)
    amplitudes = sorted(set(amplitude))
    shape = section if ratio is None else f"{section}-{ratio:g}"
    path = writable_folder(results.out) / f"stability-{shape}-omega-{omega:g}-mode-{mode}"
    asked = " ".join(f"{a:.17g}" for a in amplitudes)
    inputs = {**beam_attributes(blade), "omega": omega, "mode": mode, "amplitudes": asked}
    files = path.with_name(f"{path.name}.nc"), path.with_name(f"{path.name}.csv")
    refuse_to_replace(inputs, *files, force=results.force)
    found = planar_stability(blade, omega, amplitudes, mode)
    limit = stability_limit(blade, omega, mode, largest=amplitudes[-1])
    data = comparison.planar_stability(found, limit).assign_attrs(inputs)
    written = [save(data, files[0]), save(data.drop_vars(["multipliers", "part"]), files[1])]

    from .. import figures  # noqa: PLC0415  (matplotlib is the slowest import)

    written += figures.save_figure(figures.planar_stability(data), path)
    console = new_console()
    console.print(f"{limit}.")
    print_columns(
        {
            "|q|/L": [f"{a:g}" for a in found.amplitude],
            "growth [1/s]": [
                "-" if rate == 0.0 else f"{rate:.4g}{'' if sure else ' !'}"
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
        title="! not converged" if np.any(~found.converged) else "",
    )
    console.print("written " + listed(written))


def _shaped(beam: AnyBlade, section: Shape, ratio: float | None, poisson_ratio: float) -> AnyBlade:
    """Return the blade with the section out of the plane that was asked for."""
    if ratio is not None and section != "rectangle":
        raise ValueError(f"--ratio is of a rectangle, and --section is {section}: leave it out")
    if section == "tube":
        return beam.with_out_of_plane(OutOfPlane.circle(poisson_ratio))
    if section == "rectangle" and ratio is not None:
        return beam.with_out_of_plane(OutOfPlane.rectangle(ratio, poisson_ratio))
    if section == "rectangle":
        if not isinstance(beam, Beam):
            raise ValueError(
                "a blade has EA and EI, but no area that tells its width: give --ratio, height in "
                "the plane over width"
            )
        return beam.rectangle(poisson_ratio=poisson_ratio)
    if not isinstance(beam, Blade) or beam.section.out_of_plane is None:
        raise ValueError(
            "what the section is out of the plane is unknown: give --section rectangle or "
            "--section tube, or [blade.section.out_of_plane] in --config"
        )
    return beam
