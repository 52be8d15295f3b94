"""`rotbeam compare`: the data of Figures 14 and 15 and where each error comes from."""

from __future__ import annotations

from typing import Any

from .. import comparison
from ..files.results import save, save_tables, writable_folder
from .options import Results, Workers
from .output import new_console, print_columns
from .progress import counter
from .targets import listed, refuse_to_replace, telling_what_is_kept

_WORKERS, _RESULTS = Workers(), Results()


def compare(
    *,
    amplitude: float = 0.1,
    workers: Workers = _WORKERS,
    results: Results = _RESULTS,
) -> None:
    """Print all models' errors, and write Figures 14 and 15's data.

    Parameters
    ----------
    amplitude
        Amplitude over the length at which the models' budget is printed.
    """
    folder = writable_folder(results.out)
    console = new_console()
    models = comparison.model_budget(amplitudes=(amplitude,))
    refuse_to_replace(models, folder / "budget_models.nc", force=results.force)
    spin_ups = f"finished spin-ups are kept in the cache {workers.cache}"
    with telling_what_is_kept(lambda: spin_ups), counter(console, "spin-ups") as progress:
        options: dict[str, Any] = {
            "jobs": workers.jobs,
            "cache": workers.cache,
            "progress": progress,
        }
        data = {
            "figure_14": comparison.figure_14(**options),
            "figure_15": comparison.figure_15(),
            "budget_models": models,
            "budget_finite_elements": comparison.finite_element_budget(**options),
        }
    written = []
    for name, table in data.items():
        written.append(save(table, folder / f"{name}.nc"))
        written += save_tables(table, folder / f"{name}.csv")
    for omega in models["omega"].to_numpy():
        here = models.sel(omega=omega, a=amplitude)
        sources = here["source"].to_numpy().tolist()
        rows: dict[str, list[str]] = {"source": [*sources, "total"]}
        for model in here["model"].to_numpy():
            one = here.sel(model=model)
            errors = [*one["error"].to_numpy(), one["total"].item()]
            rows[str(model)] = [f"{error:+.1e}" for error in errors]
        print_columns(
            rows,
            "table",
            title=f"(ω_NL - exact)/ω_n at ω = {omega:g} rad/s, a = {amplitude:g}",
        )
    elements = data["budget_finite_elements"]
    frame = elements["error"].to_series().unstack("source").reset_index()
    print_columns(
        {
            "ω [rad/s]": frame["omega"].tolist(),
            "T [s]": frame["ramp_time"].tolist(),
            **{
                str(source): [f"{e:+.1e}" for e in frame[source]]
                for source in elements["source"].to_numpy()
            },
        },
        "table",
        title="16 elements, 1 ms: distance from the exact ω_NL/ω_n at the same amplitude",
    )
    console.print("written " + listed(written))
