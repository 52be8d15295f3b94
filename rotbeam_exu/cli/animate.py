"""`rotbeam animate`: the spinning beam as a moving picture."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from rich.console import Console
from rich.progress import Progress

from analytic import Beam, SpinUp, spin_up_response
from analytic.input_checks import positive, whole_number

from ..config import load_beam
from ..storage import whole_file, writable_folder


def animate(
    *,
    omega: float = 6.0,
    ramp_time: float = 3.0,
    duration: float = 12.0,
    rate: int = 20,
    config: Path | None = None,
    out: Path | None = None,
) -> None:
    """Write the beam's spin-up as GIF or MP4: inertial and rotating view, and q over time.

    The response is that of the exact beam, in real time and to scale.

    Parameters
    ----------
    omega
        Steady angular velocity [rad/s].
    ramp_time
        Time from rest to the steady angular velocity, T in Eq. 1 [s].
    duration
        End of the motion [s].
    rate
        Pictures a second.
    config
        TOML file with the beam; without it, the paper's beam.
    out
        File to write, .gif, or .mp4 where ffmpeg is installed.
    """
    whole_number("rate", rate)
    duration = positive("duration", duration, "s")
    beam = Beam.reference() if config is None else load_beam(config)
    spin_up = SpinUp(omega=omega, ramp_time=ramp_time)
    target = out or Path(f"spin-up-omega-{omega:g}-ramp-{ramp_time:g}.gif")
    writable_folder(target.parent)

    from ..figures import animation  # noqa: PLC0415  (matplotlib is the slowest import)

    animation.check_format(target)
    console = Console(highlight=False, soft_wrap=True)
    times = np.arange(0.0, duration * (1.0 + 1e-12), 1.0 / rate)
    with Progress(console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task("integrating", total=None)
        response = spin_up_response(
            beam, spin_up, times, tolerance=1e-5, points=np.linspace(0.0, beam.length, 41)
        )
        bar.update(task, description="drawing", total=times.size)
        with whole_file(target) as partial:
            animation.save_animation(
                response, partial, rate=rate, progress=lambda n: bar.update(task, completed=n)
            )
    console.print(f"{target}, {target.stat().st_size / 1e6:.1f} MB, {times[-1]:g} s")
