"""`rotbeam animate`: the spinning beam as a moving picture."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from cyclopts import Parameter

from analytic import linear_response, spin_up_response
from analytic.input_checks import positive, whole_number

from ..files.results import whole_file
from .job import require_writable
from .motion import (
    Config,
    RampTime,
    SteadySpeed,
    chosen_times,
    configured,
    motion_of,
    slower_than_paper,
)  # fmt: skip
from .options import Flag, Whole
from .output import bar, print_text


def animate(
    *,
    omega: SteadySpeed = None,
    ramp_time: RampTime = None,
    duration: float | None = None,
    rate: Whole = 20,
    slow_motion: float | None = None,
    beside: Literal["linear"] | None = None,
    config: Config = None,
    out: Annotated[Path | None, Parameter(alias="-o")] = None,
    force: Flag = False,
) -> None:
    """Write the spin-up as GIF or MP4.

    Inertial and rotating view, and q over time.

    The film shows the exact beam to scale; a beam faster than the paper's is slowed down.

    Parameters
    ----------
    duration
        End of the motion [s].
    rate
        Pictures a second of the film.
    slow_motion
        Seconds of the film per second of the motion.
    beside
        Show the linear model in a floating frame beside the exact beam: it diverges above the first
        natural frequency at rest.
    out
        File to write, .gif, or .mp4 where ffmpeg is installed.
    force
        Replace a file that is there.

    Examples
    --------
    $ rotbeam animate
    $ rotbeam animate --omega 6 --ramp-time 3 --duration 4 --rate 10 -o film.gif
    $ rotbeam animate --omega 4 --ramp-time 3 --duration 6 --beside linear
    """
    whole_number("rate", rate)
    file = configured(config)
    beam = file.beam
    spin_up = motion_of(file, omega=omega, ramp_time=ramp_time).spin_up
    usual = max(chosen_times(beam, 12.0)[0], 2.0 * spin_up.ramp_time)
    known = file.numerics.get("duration", usual) if duration is None else duration
    duration = positive("duration", known, "s")
    slower = max(1.0, float(f"{1.0 / slower_than_paper(beam):.1e}"))
    slower = slower if slow_motion is None else positive("slow_motion", slow_motion)
    pictures = duration * slower * rate
    if pictures < 1.0:
        raise ValueError(
            f"{duration:g} s at {rate:g} pictures a second, {slower:g} times slower, are one "
            f"picture: take a rate or a slow motion {math.ceil(2.0 / pictures)} times as large"
        )
    name = f"spin-up-omega-{spin_up.omega:g}-ramp-{spin_up.ramp_time:g}"
    target = out or Path(name + ("-beside-linear.gif" if beside else ".gif"))

    from ..figures import animation

    animation.check_format(target)
    require_writable(target, force=force)
    times = np.arange(0.0, duration * (1.0 + 1e-12), 1.0 / (rate * slower))
    points = np.linspace(0.0, beam.length, 41)
    with bar("integrating"):
        response = spin_up_response(beam, spin_up, times, tolerance=1e-5, points=points)
        linear = linear_response(beam, spin_up, times, points=points) if beside else None
    with bar("drawing") as drawn, whole_file(target) as partial:
        animation.save_animation(
            response, partial, beside=linear, rate=rate, progress=lambda n: drawn(n, times.size)
        )
    print_text(
        f"written {target}, {target.stat().st_size / 1e6:.1f} MB, "
        f"{spin_up.omega:g} rad/s in {spin_up.ramp_time:g} s, to {times[-1]:g} s"
        + ("" if slower == 1.0 else f", {slower:g} times slower"),
    )
