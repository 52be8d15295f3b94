"""`rotbeam sensitivity`: what each number of a blade does to its frequencies, loads and motion."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from cyclopts import Parameter

import analytic
from analytic.exact.driven.response import SpinUpResponse
from analytic.exact.linear.families import LinearModes
from analytic.exact.linear.steady_state import SteadyState
from analytic.input_checks import rotation_speed, whole_number
from analytic.warning import warn

from .job import Flag, Results
from .motion import chosen_motion
from .options import Number, Numbers, Whole, Workers
from .output import bar, formatted, print_columns, print_text
from .request import Request, uses

if TYPE_CHECKING:
    from analytic.arrays import FloatArray
    from analytic.sensitivity import Sensitivity, Spread

_SAMPLES = 501  # of a spin-up
_DIGITS = 7  # of percents; derivatives have no more


@uses(
    "section", "theory", "tolerance", "motion.omega", "ramp_time", "duration", "loads",
    "uncertainty",
)  # fmt: skip
def sensitivity(
    request: Request,
    *,
    omega: Number | None = None,
    count: Whole = 4,
    steady: Flag = False,
    spin_up: Flag = False,
    amplitude: Numbers = None,
    rows: Whole = 15,
    scatter: Annotated[tuple[str, ...], Parameter(consume_multiple=True)] = (),
    length: Number | None = None,
    samples: Whole = 0,
    workers: Workers = Workers(),
    out: Annotated[Path | None, Parameter(alias="-o")] = None,
    force: Flag = False,
) -> None:
    """Print what each number does to a blade's modes and motion.

    Of the exact blade. Stiffness, mass, offsets and twist of a table at each of its stations, too;
    those first that change a frequency most. Of a spin-up numbers of the whole blade.

    Parameters
    ----------
    omega
        Rotation speed [rad/s]; unless given, that of the file, or zero.
    count
        Number of modes.
    steady
        Of the steady state under the loads instead: its tip, and force and moment on the clamp.
    spin_up
        Of the spin-up, from the steady state under the loads, instead: the largest values of its
        tip and root loads, and the swing after the ramp. Files have them over time, too.
    amplitude
        Of free orbits of lag 1 with these peaks over the length instead.
    rows
        Largest number of rows of stations that are printed; netCDF and CSV have all.
    scatter
        Standard deviations, pairs of a number of the whole blade and its deviation, relative or in
        its unit, as EI3=0.05 m=0.03; unless given, [uncertainty] of the file. Prints the scatter
        that comes of it, and where it is from.
    length
        Correlation length of the scatter along the blade [m]; unless given, all stations are off
        together.
    samples
        Number of random blades that are solved anew, to see whether the first order is enough.
    out
        Folder for netCDF and CSV; without it none is written.
    force
        Replace a result of other inputs that has the same name.

    Examples
    --------
    $ rotbeam sensitivity --omega 6
    $ rotbeam sensitivity --omega 6 --scatter EI3=0.05 m=0.03
    $ rotbeam sensitivity --steady --omega 6 --section rectangle
    $ rotbeam sensitivity --omega 6 --amplitude 0.1 0.3
    $ rotbeam sensitivity --spin-up --omega 6 --ramp-time 3 --duration 6
    $ rotbeam sensitivity --omega 6 --section rectangle --count 3 -o results
    """
    from analytic.sensitivity import sampled, spread
    from analytic.sensitivity import sensitivity as sensitivity_of

    names = "omega", "ramp_time", "duration"
    given = {name: request.values[name] for name in names if name in request.values}
    given |= {} if omega is None else {"omega": omega}
    speed = rotation_speed(given.get("omega", 0.0))
    whole_number("rows", rows, least=0)
    whole_number("samples", samples, least=0)
    deviations, correlated = request.scatter(scatter, length)
    kinds = {"steady": steady, "spin-up": spin_up, "amplitude": amplitude}
    chosen = [name for name, asked in kinds.items() if asked]
    if len(chosen) > 1:
        raise ValueError(f"--{' and --'.join(chosen)} are of different answers: keep one")
    if {"ramp_time", "duration"} & {*request.options} and not spin_up:
        raise ValueError("--ramp-time and --duration are of a spin-up: give --spin-up as well")
    if request.loads and not (steady or spin_up):
        warn("this command does not use [[loads]] without --steady or --spin-up")
    blade, theory = request.blade, request.theory
    settings: Any = {"theory": theory, "tolerance": request.tolerance}
    with bar("answer and derivatives"):
        answer: Any
        if amplitude:
            answer = analytic.periodic_orbits(blade, speed, amplitude, theory=theory)
        elif steady:
            answer = analytic.steady_state(blade, speed, loads=request.loads, **settings)
        elif spin_up:
            motion = chosen_motion(blade, **given)
            speed, times = motion.spin_up.omega, np.linspace(0.0, motion.duration, _SAMPLES)
            answer = analytic.spin_up_response(
                blade, motion.spin_up, times, loads=request.loads, start="steady", **settings
            )
        else:
            answer = analytic.linear_modes(blade, speed, count, **settings)
        found = sensitivity_of(answer)
    scattered = spread(found, deviations, correlated) if deviations else None
    if out is None:
        _print(found, rows)
    else:
        from ..datasets import dataset_of

        Results(out=out, force=force).job(
            "-".join(("sensitivity", *chosen, f"omega-{speed:g}")),
            dataset_of(found),
            show=lambda *_: _print(found, rows),
            draw=lambda figures, _: (
                figures.over_time(scattered)
                if scattered and spin_up
                else figures.tornado(found, "largest tip y" if spin_up else None)
            ),
        )
    if scattered:
        several = None
        if samples:
            from ..runs.attributes import theory_attributes
            from ..sweeps.cases import kept_workers

            of = {
                **{one.name: np.asarray(one.value).tolist() for one in found.parameters},
                **theory_attributes(theory),
                "outputs": [*found.outputs],
                "values": found.values.tolist(),
            }
            with (
                workers.counted("samples", "samples") as how,
                kept_workers(of, most=samples, **how) as pool,
            ):
                several = sampled(answer, deviations, correlated, count=samples, executor=pool)
        _print_spread(found, scattered, several)


def _print_spread(found: Sensitivity, result: Spread, samples: FloatArray | None) -> None:
    few = slice(_printed(found))
    of_samples = {}
    if samples is not None:
        off = np.nanstd(samples[:, few], axis=0)
        of_samples = {f"± of {len(samples)} samples": formatted(off, ".3g")}
    shares = zip(result.parameters, result.shares[few].T, strict=True)
    print_columns(
        {
            **_values(found),
            "±": formatted(result.deviations[few], ".3g"),
            **of_samples,
            "± [%]": formatted(100.0 * result.relative[few], ".3g"),
            **{f"of {name} [%]": formatted(100.0 * of, ".1f") for name, of in shares},
        },
        title="Standard deviations, and shares in their squares",
    )


def _values(found: Sensitivity) -> dict[str, list[str]]:
    """Return columns of what was computed."""
    if isinstance(found.answer, LinearModes):
        return {"mode": [*found.outputs], "ω [rad/s]": formatted(found.values, ".5g")}
    few = slice(_printed(found))
    names = [*map(_title, found.outputs[few], found.units[few])]
    return {"number": names, "value": formatted(found.values[few], ".6g")}


def _printed(found: Sensitivity) -> int:
    """Return how many numbers are printed: of a motion those that are of no instant."""
    motion = isinstance(found.answer, SpinUpResponse)
    return sum(not (motion and " at " in name) for name in found.outputs)


def _title(output: str, unit: str) -> str:
    return f"{output} [{unit}]"


def _print(found: Sensitivity, rows: int) -> None:
    """Print changes of the whole blade and of what matters most at stations.

    Those of frequencies in percent.
    """
    changes = found.derivatives * [one.step for one in found.parameters]
    groups: tuple[tuple[str, slice], ...]
    if isinstance(found.answer, LinearModes):
        changes *= 100.0 / found.values[:, None]
        titles, groups = [*found.outputs], (("frequencies [%]", slice(None)),)
    else:
        print_columns(_values(found), title=f"Answer at {found.omega:g} rad/s")
        short = [name.removeprefix("largest ") for name in found.outputs]
        titles = [*map(_title, short, found.units)]
        half = len(titles) // 2
        groups = (("frequency", slice(half)), ("softening", slice(half, None)))
        if isinstance(found.answer, SteadyState | SpinUpResponse):
            largest = "largest " * isinstance(found.answer, SpinUpResponse)
            parts = {"tip": (0, 4), "force": (4, 7), "moment": (7, 10)}
            groups = tuple((f"{largest}{what}", slice(*rows)) for what, rows in parts.items())
            groups += (("swing", slice(10, 11)),) * ("swing after the ramp" in found.outputs)
    stations = [k for k, one in enumerate(found.parameters) if one.family]
    whole = np.setdiff1d(np.arange(len(found.parameters)), stations).tolist()
    for what, some in groups:
        of = changes[some]
        largest = np.abs(of).max(axis=0)
        first = sorted(stations, key=lambda k: -largest[k])[:rows]
        for title, places in (("the whole blade", whole), ("one station", first)):
            several = [found.parameters[k] for k in places]
            if not several:
                continue
            print_columns(
                {
                    "number": [one.name for one in several],
                    "change": [one.change for one in several],
                    **{
                        name: [f"{round(value, _DIGITS) + 0.0:+.3g}" for value in row.tolist()]
                        for name, row in zip(titles[some], of[:, places], strict=True)
                    },
                },
                title=f"Change of the {what} by a change of {title}, at {found.omega:g} rad/s",
            )
        if len(first) < len(stations):
            print_text(f"{len(stations) - len(first)} more numbers of stations change less")
