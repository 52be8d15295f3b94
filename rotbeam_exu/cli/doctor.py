"""`rotbeam doctor`: whether this installation works."""

from __future__ import annotations

import time
from importlib import metadata

from analytic import Beam, SpinUp, campbell

from .. import figures
from ..fem.simulation import simulate, versions
from ..figures.judgement import svg
from .output import new_console


def doctor() -> None:
    """Print versions, draw a figure, run a short spin-up.

    Examples
    --------
    $ rotbeam doctor
    """
    console = new_console()
    for name, version in versions().items():
        console.print(f"{name:<14}{version}")
    started = time.perf_counter()
    # Drawn as all figures are: a matplotlib that is too old fails here, not after a long run.
    try:
        svg(figures.campbell(campbell(Beam.reference(), (0.0, 4.0, 8.0), count=1, orders=1)))
    except Exception as error:
        raise RuntimeError(
            f"matplotlib {metadata.version('matplotlib')} cannot draw a figure ({error}); try "
            "pip install --upgrade matplotlib"
        ) from error
    console.print(f"{'figure':<14}drawn in {time.perf_counter() - started:.2f} s")
    started = time.perf_counter()
    run = simulate(
        Beam.reference(), SpinUp(omega=2.0, ramp_time=0.5), elements=4, duration=1.0, step=5e-3
    )
    console.print(f"{'spin-up':<14}{run.attrs['verdict']} in {time.perf_counter() - started:.2f} s")
