"""`rotbeam run`: the main job, one spin-up."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter
from rich.console import Console
from rich.progress import Progress

from analytic.warning import warn

from ..lazily import xr
from ..runs.check import SimulationError
from .configuration import configured, motion_of
from .job import Job, UnfinishedError, drawn
from .motion import refuse_rest
from .options import Discretization, NoFigure, Results, given
from .output import new_console, print_line

if TYPE_CHECKING:
    from ..fem.case import Case
    from ..runs.oscillation import SteadyOscillation
    from .assessment import Assessment

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

    console = new_console()
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
    path = results.out / name

    def computed() -> xr.Dataset:
        if config is not None:
            where = "(where not given, the paper's, scaled by ω_0)"
            print_line(console, "motion", f"{motion} {where}")
        return _computed(case, console)

    def shown(data: xr.Dataset, _: xr.Dataset) -> Assessment:
        steady = _measured(data, path)
        assessment = assess(case, steady)
        print_inputs(console, case, title)
        print_results(console, data, steady, assessment)
        if before is not None:
            print_line(console, "repeats", f"{recorded}: {likeness(data, before)}")
        return assessment

    found = Job(
        path=path, inputs=case.describe(), force=results.force, compute=computed,
        dataset=lambda data: data, show=shown,
        draw=None if no_figure else drawn(lambda figures, data: figures.spin_up(data)[0]),
    ).run()  # fmt: skip
    for sentence in found.warnings(case.elements, case.step):
        warn(sentence)


def _measured(data: xr.Dataset, path: Path) -> SteadyOscillation:
    """Measure what is safe on file; a window that is too short loses nothing."""
    from ..runs.oscillation import steady_oscillation

    try:
        return steady_oscillation(data)
    except ValueError as error:
        raise RuntimeError(f"{error}; the run itself is in {path}.nc") from error


def _computed(case: Case, console: Console) -> xr.Dataset:
    from ..fem.simulation import run_case

    try:
        with Progress(console=console, transient=True, disable=not console.is_terminal) as bar:
            task = bar.add_task("spinning up", total=1.0)
            return run_case(case, progress=lambda done: bar.update(task, completed=done))
    except SimulationError as error:
        if error.run is None:
            raise
        raise UnfinishedError(error.run, "computed") from error
