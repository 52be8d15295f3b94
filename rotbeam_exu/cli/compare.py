"""`rotbeam compare`: the data of Figures 14 and 15 and where each error comes from."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from analytic import AnyBlade, Beam

from .. import paper
from ..fem.lazily import require_exudyn
from ..files.results import writable_folder
from ..lazily import xr
from ..runs.attributes import beam_attributes
from .job import refuse_to_replace, saved
from .motion import (
    ChosenMotion,
    chosen_speeds,
    chosen_times,
    configured,
    grid_motion,
    motion_of,
)
from .options import RESULTS, WORKERS, Results, Workers
from .output import formatted, print_columns, print_note, print_written


def compare(
    *,
    amplitude: float = 0.1,
    config: Path | None = None,
    workers: Workers = WORKERS,
    results: Results = RESULTS,
) -> None:
    """Print all models' errors, and write Figures 14 and 15's data.

    Speeds, ramps and step of another uniform beam follow its ω_0.

    Parameters
    ----------
    amplitude
        Amplitude over the length at which the models' budget is printed.
    config
        TOML file with the beam; without it, the paper's beam. Its [motion] is that of Figure 15,
        its [numerics] is not used.

    Examples
    --------
    $ rotbeam compare --jobs 2
    $ rotbeam compare --config beam.toml --amplitude 0.2 -o mine
    """
    from .. import comparison

    require_exudyn()
    folder = writable_folder(results.out)
    file = configured(config)
    beam = _uniform(file.beam)
    mine = {} if config is None else beam_attributes(beam)
    omegas = chosen_speeds(beam, *paper.SPEEDS)
    ramp_times = chosen_times(beam, *paper.RAMP_TIMES, digits=4)
    models = comparison.model_budget(beam, omegas=omegas, amplitudes=(amplitude,))
    models = models.assign_attrs(mine)
    refuse_to_replace(models, folder / "budget_models.nc", force=results.force)
    motion = _even(grid_motion(beam, omegas, ramp_times))
    main = motion_of(file)
    with workers.counted("spin-ups") as progress:
        options: dict[str, Any] = {
            "omegas": omegas, "ramp_times": ramp_times, "duration": motion.duration,
            "step": motion.step, "jobs": workers.jobs, "cache": workers.cache, "progress": progress,
        }  # fmt: skip
        data = {
            "figure_14": comparison.figure_14(beam, **options),
            "figure_15": comparison.figure_15(
                beam, omega=main.spin_up.omega, ramp_time=main.spin_up.ramp_time,
                duration=main.duration, step=main.step,
            ),
            "budget_models": models,
            "budget_finite_elements": comparison.finite_element_budget(beam, **options),
        }  # fmt: skip
    written: list[Path] = []
    for name, table in data.items():
        written += saved(table.assign_attrs(mine), folder / name)
    _print_models(models, amplitude)
    _print_elements(data["budget_finite_elements"], motion.step)
    print_written(written)


def _uniform(beam: AnyBlade) -> Beam:
    """Return the uniform beam; refuse a blade, which the paper's models do not describe."""
    known = beam.uniform
    if known is None:
        raise ValueError(
            "the paper's models, which compare needs, are for the uniform beam of [beam] only: for "
            "a [blade] take rotbeam backbone --variant FrM --exact"
        )
    return known


def _even(motion: ChosenMotion) -> ChosenMotion:
    """Return the motion with an even number of steps, for twice the step has to fit as well."""
    steps = round(motion.duration / motion.step)
    return replace(motion, step=motion.duration / (steps + 1)) if steps % 2 else motion


def _print_models(models: xr.Dataset, amplitude: float) -> None:
    for omega in models["omega"].to_numpy():
        here = models.sel(omega=omega, a=amplitude)
        sources = here["source"].to_numpy().tolist()
        rows: dict[str, list[str]] = {"source": [*sources, "total"]}
        for model in here["model"].to_numpy():
            one = here.sel(model=model)
            errors = [*one["error"].to_numpy(), one["total"].item()]
            rows[str(model)] = formatted(errors, "+.1e")
        print_columns(
            rows,
            title=f"(ω_NL - exact)/ω_n at ω = {omega:g} rad/s, a = {amplitude:g}",
        )


def _print_elements(elements: xr.Dataset, step: float) -> None:
    frame = elements["error"].to_series().unstack("source").reset_index()
    print_columns(
        {
            "ω [rad/s]": frame["omega"].tolist(),
            "T [s]": frame["ramp_time"].tolist(),
            **{
                str(source): formatted(frame[source], "+.1e")
                for source in elements["source"].to_numpy()
            },
        },
        title=(
            f"16 elements, {1e3 * step:g} ms: distance from the exact ω_NL/ω_n at its amplitude"
        ),
    )
    if np.isnan(elements["error"]).any():
        print_note("-: the amplitude is above 0.6, where the budget ends")
