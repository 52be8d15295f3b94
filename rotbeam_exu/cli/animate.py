"""`rotbeam animate`: the spinning beam as a moving picture, or as files for ParaView."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Literal, NamedTuple

import numpy as np
from cyclopts import Parameter

from analytic import Blade, linear_modes, linear_response, spin_up_response
from analytic.input_checks import whole_number

from ..files.results import load
from ..files.vtk import corners, save_vtk
from ..lazily import xr
from ..runs.attributes import beam_of
from ..runs.shape import vibration_of
from .job import Flag, require_writable
from .motion import slower_than_paper
from .options import Number, Whole
from .output import bar, print_text
from .request import Request, uses

_POINTS = 41  # along the blade
_MODES = 12  # among which one is shown
_PERIOD = 2.0  # [s] of the film for a period of a mode
_SEEN = 1e-4
"""Error of the film's places over the largest deflection, below a tenth of its lines."""


@uses("speed", "ramp_time", "duration", "theory")
def animate(
    request: Request,
    *,
    rate: Whole = 20,
    beside: Literal["linear"] | None = None,
    run: Path | None = None,
    mode: str | None = None,
    height: Number | None = None,
    width: Number | None = None,
    out: Annotated[Path | None, Parameter(alias="-o")] = None,
    force: Flag = False,
) -> None:
    """Write the spin-up as GIF or MP4, or as PVD for ParaView.

    Inertial and rotating view, and q over time; of a blade in space from above and from the side.

    The film shows the exact beam to scale; a beam faster than the paper's is slowed down.

    Parameters
    ----------
    rate
        Frames per second of the film.
    beside
        Show the linear model in a floating frame next to the exact beam: it diverges above the
        first natural frequency at rest.
    run
        Show a finite element run instead of the exact beam: the file of `rotbeam run --stations`.
    mode
        Show a mode of vibration in steady rotation instead, as "flap 1": two periods, the largest
        displacement of the tip a tenth of the length.
    height
        Height of a rectangular section, in the plane of bending [m]. With `--width` a .pvd has a
        body with the strain in its corners, without both a line.
    width
        Its width [m].
    out
        File to write, .gif, .mp4 where ffmpeg is installed, or .pvd with a folder of .vtu.
    force
        Replace a file that is there.

    Examples
    --------
    $ rotbeam animate
    $ rotbeam animate --omega 6 --ramp-time 3 --duration 4 --rate 10 -o film.gif
    $ rotbeam animate --omega 4 --ramp-time 3 --duration 6 --beside linear
    $ rotbeam animate --config blade.toml --mode "flap 2"
    $ rotbeam animate --omega 4 --duration 4 -o film.pvd --height .04 --width .002
    """
    whole_number("rate", rate)
    if run is not None:
        if request.options or request.config or beside or mode:
            raise ValueError(
                "--run shows a run as it is: leave out --omega, --ramp-time, --duration, --beside, "
                "--mode, --theory and --config"
            )
        film = _of_run(load(run), rate)
    elif mode is not None:
        if beside:
            raise ValueError("--mode shows a mode alone: leave out --beside")
        film = _of_mode(request, mode, rate)
    else:
        film = _of_spin_up(request, rate, beside=beside is not None)
    target = out or Path(f"{film.name}.gif")

    from ..figures import animation

    corners(film.blade, np.linspace(0.0, film.blade.length, _POINTS), height, width)
    if target.suffix != ".pvd" or mode is not None:
        animation.check_format(target)
    require_writable(target, force=force)
    data, linear = film.made()
    end, count = float(data["time"][-1]), data.sizes["time"]
    slower = float(f"{1.0 / (rate * float(data['time'][1] - data['time'][0])):.2g}")
    if target.suffix == ".pvd":
        save_vtk(data, target, height=height, width=width)
    else:
        with bar("drawing") as drawn:
            animation.save_animation(
                data, target, beside=linear, rate=rate, progress=lambda n: drawn(n, count)
            )
    size = sum(file.stat().st_size for file in (target, *target.with_suffix("").glob("*.vtu")))
    print_text(
        f"written {target}, {size / 1e6:.1f} MB, {film.words}, to {end:g} s"
        + ("" if slower == 1.0 else f", {slower:g} times slower"),
    )


class _Film(NamedTuple):
    """A film to be made: its blade, name and words, and the function that makes its data."""

    blade: Blade
    name: str
    words: str
    made: Callable[[], tuple[xr.Dataset, xr.Dataset | None]]


def _slower(blade: Blade, duration: float, rate: int) -> float:
    """Return how much slower than in time a film is, and refuse one of a single picture."""
    slower = max(1.0, float(f"{1.0 / slower_than_paper(blade):.1e}"))
    pictures = duration * slower * rate
    if pictures < 1.0:
        raise ValueError(
            f"{duration:g} s at {rate:g} pictures a second, {slower:g} times slower, are one "
            f"picture: take a rate {math.ceil(2.0 / pictures)} times as large"
        )
    return slower


def _of_run(kept: xr.Dataset, rate: int) -> _Film:
    blade, speed, ramp = beam_of(kept.attrs), kept.attrs["omega"], kept.attrs["ramp_time"]
    slower = _slower(blade, float(kept["time"][-1]), rate)
    sampled = float(kept["time"][1] - kept["time"][0])
    every = max(1, round(1.0 / (rate * slower * sampled)))
    name, words = _named(speed, ramp)
    return _Film(blade, name, words, lambda: (kept.isel(time=slice(None, None, every)), None))


def _of_spin_up(request: Request, rate: int, *, beside: bool) -> _Film:
    blade, spin_up, duration = request.blade, request.motion.spin_up, request.motion.duration
    slower = _slower(blade, duration, rate)
    name, words = _named(spin_up.omega, spin_up.ramp_time)

    def made() -> tuple[xr.Dataset, xr.Dataset | None]:
        from ..datasets import dataset_of

        times = np.arange(0.0, duration * (1.0 + 1e-12), 1.0 / (rate * slower))
        points = np.linspace(0.0, blade.length, _POINTS)
        with bar("integrating"):
            exact = spin_up_response(
                blade, spin_up, times, tolerance=_SEEN, points=points, theory=request.theory
            )
            data = dataset_of(exact)
            if not beside:
                return data, None
            return data, dataset_of(linear_response(blade, spin_up, times, points=points))

    return _Film(blade, name + "-beside-linear" * beside, words, made)


def _of_mode(request: Request, mode: str, rate: int) -> _Film:
    blade, omega = request.blade, request.motion.spin_up.omega

    def made() -> tuple[xr.Dataset, None]:
        with bar("modes"):
            modes = linear_modes(blade, omega, _MODES, theory=request.theory)
        points = np.linspace(0.0, blade.length, _POINTS)
        return vibration_of(modes, mode, points, pictures=math.ceil(_PERIOD * rate)), None

    name = f"{mode.replace(' ', '-')}-omega-{omega:g}"
    return _Film(blade, name, f"{mode} at {omega:g} rad/s", made)


def _named(omega: float, ramp_time: float) -> tuple[str, str]:
    """Return name and words of a spin-up."""
    name = f"spin-up-omega-{omega:g}-ramp-{ramp_time:g}"
    return name, f"{omega:g} rad/s in {ramp_time:g} s"
