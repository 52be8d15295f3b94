"""`rotbeam animate`: the spinning beam as a moving picture, or as files for ParaView."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from cyclopts import Parameter

from analytic import linear_response, spin_up_response
from analytic.input_checks import whole_number

from ..files.results import load
from ..files.vtk import corners, save_vtk
from ..runs.attributes import beam_of
from .job import Flag, require_writable
from .motion import slower_than_paper
from .options import Number, Whole
from .output import bar, print_text
from .request import Request, uses

_SEEN = 1e-4
"""Error of the film's places over the largest deflection, below a tenth of its lines."""


@uses("speed", "ramp_time", "duration", "theory")
def animate(
    request: Request,
    *,
    rate: Whole = 20,
    beside: Literal["linear"] | None = None,
    run: Path | None = None,
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
        Show the linear model in a floating frame beside the exact beam: it diverges above the first
        natural frequency at rest.
    run
        Show a finite element run instead of the exact beam: the file of `rotbeam run --stations`.
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
    $ rotbeam animate --omega 4 --duration 4 -o film.pvd --height .04 --width .002
    """
    whole_number("rate", rate)
    kept = None if run is None else load(run)
    if kept is None:
        blade, spin_up = request.blade, request.motion.spin_up
        speed, ramp = spin_up.omega, spin_up.ramp_time
        duration = request.motion.duration
    elif request.options or request.config or beside:
        raise ValueError(
            "--run shows a run as it is: leave out --omega, --ramp-time, --duration, --beside, "
            "--theory and --config"
        )
    else:
        blade, speed, ramp = beam_of(kept.attrs), kept.attrs["omega"], kept.attrs["ramp_time"]
        duration = float(kept["time"][-1])
    slower = max(1.0, float(f"{1.0 / slower_than_paper(blade):.1e}"))
    pictures = duration * slower * rate
    if pictures < 1.0:
        raise ValueError(
            f"{duration:g} s at {rate:g} pictures a second, {slower:g} times slower, are one "
            f"picture: take a rate {math.ceil(2.0 / pictures)} times as large"
        )
    name = f"spin-up-omega-{speed:g}-ramp-{ramp:g}"
    target = out or Path(name + ("-beside-linear.gif" if beside else ".gif"))

    from ..datasets import dataset_of
    from ..figures import animation

    corners(blade, np.linspace(0.0, blade.length, 41), height, width)
    if target.suffix != ".pvd":
        animation.check_format(target)
    require_writable(target, force=force)
    linear = None
    if kept is None:
        times = np.arange(0.0, duration * (1.0 + 1e-12), 1.0 / (rate * slower))
        points = np.linspace(0.0, blade.length, 41)
        with bar("integrating"):
            exact = spin_up_response(
                blade, spin_up, times, tolerance=_SEEN, points=points, theory=request.theory
            )
            data = dataset_of(exact)
            if beside:
                linear = dataset_of(linear_response(blade, spin_up, times, points=points))
    else:
        sampled = float(kept["time"][1] - kept["time"][0])
        data = kept.isel(time=slice(None, None, max(1, round(1.0 / (rate * slower * sampled)))))
    end, count = float(data["time"][-1]), data.sizes["time"]
    if target.suffix == ".pvd":
        save_vtk(data, target, height=height, width=width)
    else:
        with bar("drawing") as drawn:
            animation.save_animation(
                data, target, beside=linear, rate=rate, progress=lambda n: drawn(n, count)
            )
    size = sum(file.stat().st_size for file in (target, *target.with_suffix("").glob("*.vtu")))
    print_text(
        f"written {target}, {size / 1e6:.1f} MB, {speed:g} rad/s in {ramp:g} s, to {end:g} s"
        + ("" if slower == 1.0 else f", {slower:g} times slower"),
    )
