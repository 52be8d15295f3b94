"""`rotbeam run`: the main job, one spin-up."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter
from rich.console import Console
from rich.progress import Progress

from analytic.warning import warn

from ..files.results import save, writable_folder
from ..lazily import xr
from ..verdict import SimulationError
from .configuration import configured, motion_of
from .motion import refuse_rest
from .options import Discretization, NoFigure, Results, given
from .output import new_console, print_line, print_written
from .targets import free_name, listed, refuse_to_replace, telling_what_is_kept

if TYPE_CHECKING:
    from ..fem.case import Case
    from ..oscillation import SteadyOscillation

_DISCRETIZATION, _RESULTS = Discretization(), Results()


def run(
    *,
    omega: float | None = None,
    ramp_time: float | None = None,
    discretization: Discretization = _DISCRETIZATION,
    config: Path | None = None,
    recorded: Annotated[Path | None, Parameter(name="--from")] = None,
    no_figure: NoFigure = False,
    results: Results = _RESULTS,
) -> None:
    """Spin a beam up in Exudyn and measure what oscillation is left.

    Writes netCDF, CSV and a figure. Without options it is the paper's beam, 6 rad/s in 3 s; for
    another beam speed, times and step follow its ω_0.

    Parameters
    ----------
    omega
        Steady angular velocity [rad/s].
    ramp_time
        Time from rest to the steady angular velocity, T in Eq. 1 [s].
    config
        TOML file with the beam, and if it likes with [motion] and [numerics]; options come first.
    recorded
        Repeat the run in this file exactly, and say whether it came out the same.

    Examples
    --------
    $ rotbeam run
    $ rotbeam run --omega 4 --ramp-time 2.5 --frame rotating --elements 32 -o fine
    $ rotbeam run --config beam.toml --element exact --option nodes=3 --no-figure
    $ rotbeam run --from results/cable-16-omega-6-ramp-3.nc
    """
    from .assessment import assess
    from .repeat import likeness, recorded_case, recorded_title
    from .summary import print_inputs, print_results

    if recorded is not None:
        others = given(omega=omega, ramp_time=ramp_time, config=config)
        if others or discretization != _DISCRETIZATION:
            raise ValueError(
                "--from repeats a run exactly: leave --config and the options of motion and "
                "discretization out"
            )
        case, before = recorded_case(recorded)
        name, title = recorded.stem, recorded_title(case)
    else:
        file, before = configured(config), None
        numerics = discretization.over(file.numerics)
        motion = motion_of(
            file, omega=omega, ramp_time=ramp_time, duration=numerics.duration, step=numerics.step
        )
        refuse_rest(motion.spin_up.omega)
        case, title = numerics.case(file.beam, motion), numerics.title
        name = f"{numerics.name}-omega-{case.omega:g}-ramp-{case.ramp_time:g}"
    path = writable_folder(results.out) / name
    refuse_to_replace(case.describe(), *_data_files(path), force=results.force)
    console = new_console()
    if config is not None:
        print_line(console, "motion", f"{motion} (where not given, the paper's, scaled by ω_0)")
    written: list[Path] = []
    with telling_what_is_kept(lambda: f"kept: {listed(written)}" if written else ""):
        data, steady = _measured(case, path, written, console)
        if not no_figure:
            from .. import figures

            written += figures.save_figure(figures.spin_up(data)[0], path)
        assessment = assess(case, steady)
    print_inputs(console, case, title)
    print_results(console, data, steady, assessment)
    if before is not None:
        print_line(console, "repeats", f"{recorded}: {likeness(data, before)}")
    print_written(console, written)
    for sentence in assessment.warnings(case.elements, case.step):
        warn(sentence)


def _measured(
    case: Case, path: Path, written: list[Path], console: Console
) -> tuple[xr.Dataset, SteadyOscillation]:
    """Compute, save, then measure: what was computed is safe before anything else is tried."""
    from ..oscillation import steady_oscillation

    try:
        data = _computed(case, console)
    except SimulationError as error:
        if error.run is None:
            raise
        failed = error.run.assign_attrs(verdict=f"failed: {error}")
        name = free_name(failed, path.parent, f"{path.name}-failed")
        written += [save(failed, file) for file in _data_files(path.with_name(name))]
        raise RuntimeError(
            f"{error}; what was computed is in {written[0]}, marked failed"
        ) from error
    written += [save(data, file) for file in _data_files(path)]
    try:
        return data, steady_oscillation(data)
    except ValueError as error:
        raise RuntimeError(f"{error}; the run itself is in {written[0]}") from error


def _data_files(path: Path) -> tuple[Path, Path]:
    # Appended, not replaced: a name may have a point in it.
    return path.with_name(f"{path.name}.nc"), path.with_name(f"{path.name}.csv")


def _computed(case: Case, console: Console) -> xr.Dataset:
    from ..fem.simulation import run_case

    with Progress(console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task("spinning up", total=1.0)
        return run_case(case, progress=lambda done: bar.update(task, completed=done))
