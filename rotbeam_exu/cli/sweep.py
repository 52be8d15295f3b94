"""`rotbeam sweep`: the paper's grid of spin-ups."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any, Literal

from cyclopts import Parameter
from rich.console import Console
from rich.progress import MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from analytic import Beam

from ..cluster import dask_executor
from ..comparison.backbones import PAPER_RAMP_TIMES
from ..comparison.theory import PAPER_SPEEDS
from ..config import load_beam
from ..solver import Frame
from ..storage import save, writable_folder
from ..sweeps import failures
from ..sweeps import sweep as run_sweep
from .options import chosen_formulation
from .output import print_columns

Values = Annotated[list[float], Parameter(consume_multiple=True)]


def sweep(
    *,
    omega: Values = list(PAPER_SPEEDS),  # noqa: B006
    ramp_time: Values = list(PAPER_RAMP_TIMES),  # noqa: B006
    element: str = "cable",
    option: list[str] | None = None,
    elements: int = 16,
    step: float = 1e-3,
    duration: float = 15.0,
    frame: Frame = "inertial",
    jobs: int | None = None,
    executor: Literal["processes", "dask"] = "processes",
    scheduler: str | None = None,
    cache: Path = Path("results/cache"),
    shard: str = "1/1",
    history: Annotated[bool, Parameter(negative=())] = False,
    config: Path | None = None,
    out: Path = Path("results"),
) -> None:
    """Spin the beam up over a grid of speeds and ramp times; failed cases stay on record.

    Parameters
    ----------
    omega
        Steady angular velocities [rad/s].
    ramp_time
        Ramp times T [s].
    element
        Beam formulation.
    option
        Option of the formulation as name=value; may be given again for another.
    elements
        Number of elements.
    step
        Step size of the integrator [s].
    duration
        End of the runs [s].
    frame
        Coordinates of the model.
    jobs
        Processes at a time; by default the cores.
    executor
        Where the cases run: processes here, or a Dask cluster.
    scheduler
        Address of the Dask scheduler, as tcp://host:8786.
    cache
        Folder with one file per finished case, from which a stopped sweep resumes.
    shard
        Part k of n of the grid, as 1/4, for job arrays that share a cache.
    history
        Also keep q over time.
    config
        TOML file with the beam; without it, the paper's beam.
    out
        Folder for the results.
    """
    beam = Beam.reference() if config is None else load_beam(config)
    model = chosen_formulation(element, option)
    folder = writable_folder(out)
    part = _shard(shard)
    if executor == "dask" and scheduler is None:
        raise ValueError("the Dask executor needs --scheduler ADDRESS, as tcp://host:8786")
    console = Console(highlight=False, soft_wrap=True)
    pool, client = dask_executor(str(scheduler)) if executor == "dask" else (None, None)
    try:
        with counter(console, "spin-ups") as progress:
            result = run_sweep(
                beam,
                omegas=omega,
                ramp_times=ramp_time,
                element=model,
                elements=elements,
                duration=duration,
                step=step,
                frame=frame,
                executor=pool,
                jobs=jobs,
                cache=cache,
                progress=progress,
                on_error="record",
                shard=part,
                history=history,
            )
    finally:
        if client is not None:
            client.close()
    name = f"sweep-{element}-{elements}" + ("" if part == (1, 1) else f"-shard-{part[0]}-{part[1]}")
    measured = result.drop_dims("time", errors="ignore")
    written = [save(result, folder / f"{name}.nc"), save(measured, folder / f"{name}.csv")]
    rows = measured.to_dataframe().reset_index()
    columns: dict[str, Any] = {
        "ω [rad/s]": rows["omega"],
        "T [s]": rows["ramp_time"],
        "amplitude a/L": rows["amplitude"],
        "ω_NL [rad/s]": rows["frequency"],
        "±": rows["frequency_error"],
        "ω_NL/ω_n": rows["frequency"] / rows["omega_n"],
        "verdict": rows["verdict"],
    }
    print_columns({title: values.tolist() for title, values in columns.items()}, "table")
    for cause, count in failures(result).items():
        console.print(f"failed {count} ×: {cause} …")
    console.print("written " + ", ".join(str(path) for path in written))


def _shard(text: str) -> tuple[int, int]:
    part, _, parts = text.partition("/")
    if not (part.isdecimal() and parts.isdecimal()):
        raise ValueError(f"shard must read k/n, as 1/4, got {text!r}")
    return int(part), int(parts)


@contextmanager
def counter(console: Console, title: str) -> Iterator[Callable[[int, int], None]]:
    """Show how many of a number of things are done, on a terminal."""
    with Progress(
        *Progress.get_default_columns(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn(""),
        console=console,
        transient=True,
        disable=not console.is_terminal,
    ) as bar:
        task = bar.add_task(title, total=None)

        def progress(done: int, number: int) -> None:
            bar.update(task, completed=done, total=number)

        yield progress
