"""`rotbeam sweep`: the paper's grid of spin-ups."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

from cyclopts import Parameter

from .. import paper
from ..files.beam_file import RunFile
from ..lazily import xr
from .driving import Driving
from .job import Results
from .motion import chosen_speeds, chosen_times, configured, grid_motion, refuse_rest
from .options import Discretization, Workers
from .output import formatted, print_columns, print_text

Values = Annotated[list[float] | None, Parameter(consume_multiple=True)]


def sweep(
    *,
    omega: Values = None,
    ramp_time: Values = None,
    discretization: Discretization = Discretization(),
    driving: Driving = Driving(),
    workers: Workers = Workers(),
    config: Path | None = None,
    results: Results = Results(),
) -> None:
    """Spin the beam up over a grid of speeds and ramp times.

    The default is the paper's grid. Failed cases stay on record and end in exit code 1; a sweep
    that was stopped goes on where it stopped.

    Parameters
    ----------
    omega
        Steady angular velocities [rad/s].
    ramp_time
        Ramp times T [s].
    config
        TOML file with the beam, and optionally [numerics]; a speed or ramp time in its [motion] is
        the grid's only one, unless others are given.

    Examples
    --------
    $ rotbeam sweep
    $ rotbeam sweep --omega 4 6 --ramp-time 2.5 3 --step 2e-3 -o quick
    $ rotbeam sweep --config beam.toml --cache runs --jobs 1
    """
    from ..sweeps.grid import sweep as run_sweep

    file = configured(config)
    beam = driving.dampings.on(file.beam)
    numerics = discretization.over(file.numerics)
    omegas, ramp_times = _grid(file, omega, ramp_time)
    refuse_rest(*omegas)
    motion = grid_motion(beam, omegas, ramp_times, duration=numerics.duration, step=numerics.step)
    count = len(omegas) * len(ramp_times)
    one = numerics.case(beam, motion, driving.chosen(file.loads))

    def computed() -> xr.Dataset:
        if config is not None:
            speeds, times = (", ".join(f"{x:g}" for x in of) for of in (omegas, ramp_times))
            print_text(f"ω = {speeds} rad/s, T = {times} s (by default the benchmark's ω/ω_0)")
        with workers.counted("spin-ups") as how:
            return run_sweep(
                beam, omegas=omegas, ramp_times=ramp_times, element=one.element,
                elements=one.elements, duration=one.duration, step=one.step, frame=one.frame,
                loads=one.loads, on_error="record", **how,
            )  # fmt: skip

    name, grid = f"sweep-{numerics.name}", {"omega": omegas, "ramp_time": ramp_times}
    failed = results.job(name, {**one.describe(), **grid}, computed, _print)
    if failed:
        raise RuntimeError(
            f"{failed} of {count} spin-ups failed; why is above, and as `failure` in "
            f"{results.out / name}.nc"
        )


def _grid(file: RunFile, omega: Values, ramp_time: Values) -> tuple[list[float], list[float]]:
    """Return the values given, or the one of the file's [motion], or the paper's, scaled."""
    if omega is None:
        known = file.motion.get("omega")
        omega = chosen_speeds(file.beam, *paper.SPEEDS) if known is None else [known]
    if ramp_time is None:
        known = file.motion.get("ramp_time")
        scaled = chosen_times(file.beam, *paper.RAMP_TIMES, digits=4)
        ramp_time = scaled if known is None else [known]
    return omega, ramp_time


def _print(result: xr.Dataset, _: xr.Dataset) -> int:
    """Print the result, and why cases failed; return how many did."""
    from ..sweeps.grid import failures

    rows = result.to_dataframe().reset_index()
    columns: dict[str, Any] = {
        "ω [rad/s]": rows["omega"],
        "T [s]": rows["ramp_time"],
        "amplitude a/L": rows["amplitude"],
        "ω_NL [rad/s]": rows["frequency"],
        "±": formatted(rows["frequency_error"], ".1e"),
        "ω_NL/ω_n": rows["frequency"] / rows["omega_n"],
        "verdict": rows["verdict"],
    }
    known = result.attrs
    print_columns(
        {title: list(values) for title, values in columns.items()},
        title=f"{known['elements']} {known['element']} elements, {known['frame']} frame, "
        f"step {known['step']:g} s, to {known['duration']:g} s",
    )
    failed = failures(result)
    for sentence, points in failed.items():
        where = "; ".join(f"ω = {omega:g} rad/s, T = {time:g} s" for omega, time in points)
        print_text(f"failed at {where}: {sentence}")
    return sum(map(len, failed.values()))
