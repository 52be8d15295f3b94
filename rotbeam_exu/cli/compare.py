"""`rotbeam compare`: the data of Figures 14 and 15, and where each model's error comes from."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from analytic import AnyBlade, Beam

from .. import paper
from ..lazily import require_exudyn, xr
from ..runs.attributes import beam_attributes
from .job import Job, refuse_to_replace
from .motion import ChosenMotion, chosen_speeds, chosen_times, configured, grid_motion, motion_of
from .options import RESULTS, WORKERS, Results, Workers
from .output import formatted, print_columns


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
    file = configured(config)
    beam = _uniform(file.beam)
    mine = {} if config is None else beam_attributes(beam)
    omegas = chosen_speeds(beam, *paper.SPEEDS)
    ramp_times = chosen_times(beam, *paper.RAMP_TIMES, digits=4)
    models = comparison.model_budget(beam, omegas=omegas, amplitudes=(amplitude,))
    path = results.out / "budget_models.nc"
    refuse_to_replace(models.assign_attrs(mine), path, force=results.force)
    motion, main = _even(grid_motion(beam, omegas, ramp_times)), motion_of(file)
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
        }  # fmt: skip
    for name, table in data.items():
        _write(table.assign_attrs(mine), name, results)
    _print_models(models, amplitude)


def _write(data: xr.Dataset, name: str, results: Results) -> None:
    Job(
        path=results.out / name, inputs=data, force=results.force, compute=lambda: data,
        show=lambda *_: None,
    ).run()  # fmt: skip


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
        errors = here["error"].to_pandas().T
        errors.loc["total"] = here["total"].to_pandas()
        columns = {model: formatted(errors[model], "+.1e") for model in errors}
        print_columns(
            {"source": list(errors.index), **columns},
            title=f"(ω_NL - exact)/ω_n at ω = {omega:g} rad/s, a = {amplitude:g}",
        )
