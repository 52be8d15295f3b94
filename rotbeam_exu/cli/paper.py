"""`rotbeam figure`, `rotbeam table` and `rotbeam compare`: the paper, and its models' errors."""

from __future__ import annotations

from dataclasses import replace

import analytic

from .. import paper
from ..fem.lazily import require_exudyn
from ..files.results import writable_folder
from ..lazily import xr
from ..runs.attributes import blade_attributes
from .job import Results, refuse_to_replace
from .motion import ChosenMotion, chosen_speeds, chosen_times, grid_motion
from .options import Number, Workers, numbered
from .output import formatted, print_columns, print_note
from .request import Request, uses

_SWEPT = (5, 14)  # figures whose data come from sweeps


def figure(
    number: str,
    /,
    *,
    workers: Workers = Workers(),
    results: Results = Results(),
    style: str = "house",
) -> None:
    """Make a figure of the paper: data, pictures and caption.

    Figures show the paper's beam. For your own beam take run, respond, compare or explore.

    Parameters
    ----------
    number
        3, 4, 5, 8 to 15, or all. Figures 1, 2, 6 and 7 are drawings.
    style
        house: PNG and PDF; journal: a journal's column width, PDF and SVG; grey: that in greys.

    Examples
    --------
    $ rotbeam figure 9
    $ rotbeam figure 14 --jobs 2 -o paper
    """
    from .. import figures

    with figures.style(style):
        for n in numbered("figure", number, sorted(figures.PAPER_FIGURES)):
            _make(n, workers, results)


def _make(n: int, workers: Workers, results: Results) -> None:
    from .. import comparison, figures

    name = f"figure_{n}"
    writable_folder(results.out)
    with workers.counted(f"figure {n}") as how:
        data = getattr(comparison, name)(**how if n in _SWEPT else {})
    results.job(
        name, data, draw=lambda figures, data: getattr(figures, name)(data),
        caption=f"Figure {n}. {figures.caption(n, data)}",
    )  # fmt: skip


def table(number: str, /) -> None:
    """Print a table of the paper, as printed and as derived.

    Differences and errata are marked; the marks are explained below the table.

    Parameters
    ----------
    number
        1 to 5, or all.

    Examples
    --------
    $ rotbeam table 3
    $ rotbeam table all
    """
    names = ("quantity", "printed", "derived", "difference", "note")
    for result in map(analytic.paper_table, numbered("table", number, range(1, 6))):
        columns = {name: [getattr(row, name) for row in result.rows] for name in names}
        notes = [note for note in dict.fromkeys(columns["note"]) if note]
        marks = {note: chr(ord("a") + i) for i, note in enumerate(notes)}
        columns["note"] = [marks.get(note, "") for note in columns["note"]]
        print_columns(columns, title=f"Table {result.number}: {result.title}")
        for note, mark in marks.items():
            print_note(f"{mark}: {note}")


@uses("motion")
def compare(
    request: Request,
    *,
    amplitude: Number = 0.1,
    workers: Workers = Workers(),
    results: Results = Results(),
) -> None:
    """Print all models' errors, and write Figures 14 and 15's data.

    Speeds, ramps and step of another uniform beam follow its ω_0; [motion] of its file is that of
    Figure 15.

    Parameters
    ----------
    amplitude
        Amplitude over the length at which the models' budget is printed.

    Examples
    --------
    $ rotbeam compare --jobs 2
    $ rotbeam compare --config beam.toml --amplitude 0.2 -o mine
    """
    from .. import comparison

    require_exudyn()
    blade = request.blade
    if not isinstance(blade, analytic.Beam):
        raise ValueError(
            "the paper's models, which compare needs, are for the uniform beam of [beam] only: for "
            "a [blade] take rotbeam backbone"
        )
    mine = blade_attributes(blade) if request.config else {}
    omegas = chosen_speeds(blade, *paper.SPEEDS)
    ramp_times = chosen_times(blade, *paper.RAMP_TIMES, digits=4)
    motion, main = _even(grid_motion(blade, omegas, ramp_times)), request.motion
    models = comparison.model_budget(blade, omegas=omegas, amplitudes=(amplitude,))
    target = results.out / "budget_models.nc"
    refuse_to_replace(models.assign_attrs(mine), target, force=results.force)
    with workers.counted("spin-ups") as how:
        data = {
            "figure_14": comparison.figure_14(
                blade, omegas=omegas, ramp_times=ramp_times, duration=motion.duration,
                step=motion.step, **how,
            ),
            "figure_15": comparison.figure_15(
                blade, omega=main.spin_up.omega, ramp_time=main.spin_up.ramp_time,
                duration=main.duration, step=main.step,
            ),
            "budget_models": models,
        }  # fmt: skip
    for name, dataset in data.items():
        results.job(name, dataset.assign_attrs(mine))
    _print_models(models, amplitude)


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
